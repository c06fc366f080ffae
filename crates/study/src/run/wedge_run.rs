//! The records of a wedge's run: the output table, contact events, creep of sticking corners, friction losses
//! of whole cycles.

use std::collections::BTreeMap;

use integrate::{Family, Integrator, Options};
use mechanics::energy_balance::Entries;
use mechanics::output::Column;
use mechanics::plausibility::PlausibilityFinding;
use mechanics::system::{ContactState, EnergyTermKind, System};
use quantity::System as Units;
use serde::{Deserialize, Serialize};
use wedge::Wedge;
use wedge::outputs::{FACES, Outputs, PointNames};

use super::{Beginning, Recorder, Row, RowTable, Run, RunCase, RunError, RunSettings, SavedRows, summarize};
use crate::case::Case;
use crate::losses::stroke::Stroke;
use crate::losses::{EnergySummary, LossCounts, LossRecorder, Window};
use crate::metrics::Cycle;
use crate::models::ModelCase;
use crate::plausibility;
use crate::progress;
use crate::reader::CaseText;
use crate::result::RunResult;
use crate::summary::{ContactEvent, Stopped, Summary};

/// Largest number of listed events.
pub const EVENT_CAP: usize = 500;

/// The counts along a wedge's run.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Counts {
    /// Distance that each contact point has crept while stuck, m.
    pub crept: Vec<f64>,
    /// Creep speeds at the last step's end, m/s.
    pub creep_speeds: Vec<f64>,
    /// Counts by face: opens, closes, sticks, slips.
    pub events: Vec<[u64; 4]>,
    /// All events.
    pub event_total: u64,
    /// The first events.
    pub listed: Vec<ContactEvent>,
    /// Friction losses at the probes passed so far, J: for each probe (side frame, bolster).
    pub probes: Vec<[f64; 2]>,
    /// Losses by point, contact state and part of the stroke.
    pub losses: LossCounts,
    /// The rows, as far as the summary needs them.
    pub table: SavedRows,
}

/// Records a wedge's run.
pub struct WedgeRecorder {
    pub(super) wedge: Wedge,
    pub(super) outputs: Outputs,
    pub(super) points: PointNames,
    pub(super) rows: RowTable,
    pub(super) counts: Counts,
    /// The ends of the averaging window, s; none without one.
    probe_times: Vec<f64>,
    speeds: Vec<f64>,
    pub(super) losses: LossRecorder,
}

impl RunCase for Case {
    type Recorder = WedgeRecorder;
    type Output = RunResult;

    const WHERE_TO_LOOK: &'static str =
        "look for values that are out of proportion; `wedgelab case` has cases that run";
    const WHAT_TO_TRY: &'static str = progress::WHAT_TO_TRY;

    fn settings(&self) -> RunSettings<'_> {
        RunSettings {
            options: options(self),
            ..RunSettings::of(&self.name, &self.simulation)
        }
    }

    fn begin(&self) -> Result<Beginning<WedgeRecorder>, RunError> {
        let wedge = Wedge::new(self.parameters.clone())?;
        let outputs = Outputs::new(&wedge.parameters);
        let points = wedge.system.point_count();
        Ok(Beginning {
            system: wedge.system.clone(),
            x: wedge.initial_state.clone(),
            start_warning: wedge.start_warning.clone(),
            recorder: WedgeRecorder {
                points: PointNames::new(&wedge.parameters),
                rows: RowTable::new(outputs.columns(), |name| summarize::reads(self, name)),
                counts: Counts {
                    crept: vec![0.0; points],
                    creep_speeds: vec![0.0; points],
                    events: vec![[0; 4]; FACES.len()],
                    ..Counts::default()
                },
                probe_times: probe_times(self),
                losses: LossRecorder::new(&wedge.system, loss_window(self)),
                speeds: vec![0.0; points],
                outputs,
                wedge,
            },
        })
    }

    fn output(mut run: Run<Self>, stopped: Option<Stopped>) -> RunResult {
        let mut summary = summarize::summary(&mut run, stopped);
        if let Some(what) = summary.not_finite().filter(|_| summary.stopped.is_none()) {
            summary.complete = false;
            summary.stopped = Some(run.stopped(format!(
                "{what} is not a finite number: look for values out of all proportion"
            )));
        }
        run.recorder.rows.into_result(summary)
    }
}

impl ModelCase for Case {
    type Summary = Summary;

    const ENERGY: Option<fn(&Summary) -> &EnergySummary> = Some(|own| &own.energy);

    fn columns(&self) -> Result<Vec<Column>, RunError> {
        Ok(Outputs::new(&self.parameters).columns().to_vec())
    }

    fn text(&self) -> Option<&CaseText> {
        Some(&self.text)
    }
}

impl Run<Case> {
    /// Returns the columns of the result.
    #[must_use]
    pub fn columns(&self) -> &[Column] {
        self.recorder.outputs.columns()
    }
}

impl Recorder for WedgeRecorder {
    type Counts = Counts;

    fn counts(&self) -> Counts {
        Counts {
            losses: self.losses.counts(),
            table: self.rows.saved(),
            ..self.counts.clone()
        }
    }

    fn restore(&mut self, mut counts: Counts, time: f64, times: &[f64]) -> Result<(), RunError> {
        let probes = self.probe_times.iter().filter(|probe| **probe <= time).count();
        counts.check(&self.points, probes)?;
        self.losses.restore(counts.losses.clone(), time)?;
        self.rows.restore(std::mem::take(&mut counts.table), times)?;
        self.counts = counts;
        Ok(())
    }

    fn step(&mut self, integrator: &Integrator<System>, system: &mut System, x: &mut [f64]) {
        self.count_events(integrator);
        self.count_creep(integrator, system);
        self.probe(integrator, system, x);
        self.losses.step(integrator, system, x);
    }

    fn row(&mut self, system: &mut System, row: &Row<'_>) -> Result<Entries, RunError> {
        let seen = system.observe(row.time, row.x);
        let (states, values) = (row.contact_states, self.rows.begin_row());
        let ledger = self
            .outputs
            .values(system, &seen, states, row.start_energy, values);
        self.rows.append(row.time)?;
        Ok(ledger.entries())
    }

    fn describe(&self, system: &System, finding: &PlausibilityFinding, units: Units) -> String {
        plausibility::in_wedge(system, &self.points, finding, units)
    }

    fn contacts(&self, _: &System, contact_states: &[u8]) -> BTreeMap<String, String> {
        contact_states_in_words(&self.points, contact_states)
    }
}

impl WedgeRecorder {
    fn count_events(&mut self, integrator: &Integrator<System>) {
        for event in integrator.events() {
            let (face, corner) = self.points.face_and_name(event.index);
            let kind = match (
                ContactState::from_number(event.from),
                ContactState::from_number(event.to),
            ) {
                (_, ContactState::Open) => 0,
                (ContactState::Open, _) => 1,
                (_, ContactState::Stick) => 2,
                (_, ContactState::Slip) => 3,
            };
            self.counts.events[face][kind] += 1;
            self.counts.event_total += 1;
            if self.counts.listed.len() < EVENT_CAP {
                self.counts.listed.push(ContactEvent {
                    time: event.time,
                    face: FACES[face].to_owned(),
                    corner: corner.to_owned(),
                    from: ContactState::from_number(event.from).name().to_owned(),
                    to: ContactState::from_number(event.to).name().to_owned(),
                });
            }
        }
    }

    /// Adds the creep of corners that were stuck at both ends of the step (trapezoidal rule).
    fn count_creep(&mut self, integrator: &Integrator<System>, system: &mut System) {
        let stuck = ContactState::Stick as u8;
        let (before, after) = (
            integrator.discrete_states_before_step(),
            integrator.discrete_states(),
        );
        let step = integrator.time() - integrator.previous_time();
        let any = before.iter().zip(after).any(|(a, b)| *a == stuck && *b == stuck);
        if !any {
            self.counts.creep_speeds.fill(0.0);
            return;
        }
        system.creep_speeds(integrator.time(), integrator.x(), &mut self.speeds);
        for point in 0..self.speeds.len() {
            if before[point] == stuck && after[point] == stuck {
                let mean = 0.5 * (self.counts.creep_speeds[point] + self.speeds[point]);
                self.counts.crept[point] += mean * step;
            }
        }
        self.counts.creep_speeds.copy_from_slice(&self.speeds);
    }

    /// Notes the friction losses at the ends of the averaging window.
    fn probe(&mut self, integrator: &Integrator<System>, system: &System, x: &mut [f64]) {
        while let Some(time) = self.probe_times.get(self.counts.probes.len()) {
            if *time > integrator.time() {
                return;
            }
            integrator.interpolate_range(*time, 0, x);
            self.counts.probes.push(friction_losses(system, x));
        }
    }
}

/// Returns the ends of the averaging window, s; none without one.
fn probe_times(case: &Case) -> Vec<f64> {
    let window = Cycle::of(&case.parameters).and_then(|cycle| cycle.window(case.simulation.duration));
    window.map_or(Vec::new(), |(start, end, _)| vec![start, end])
}

/// Returns the whole cycles over which losses are taken: those of the averages.
fn loss_window(case: &Case) -> Option<Window> {
    let cycle = Cycle::of(&case.parameters)?;
    let (start, end, cycles) = cycle.window(case.simulation.duration)?;
    Some(Window {
        ends: [start, end],
        cycles,
        stroke: Stroke::of(&case.parameters.bolster.coordinates[2])?,
    })
}

/// Returns the energy lost in friction so far, J, by face.
pub(crate) fn friction_losses(system: &System, x: &[f64]) -> [f64; 2] {
    let [_, _, _, quadratures] = system.layout().split(x);
    let mut losses = [0.0; 2];
    for (energy_term, value) in system.energy_terms().iter().zip(quadratures) {
        if energy_term.kind == EnergyTermKind::FrictionLoss {
            losses[usize::from(energy_term.element != FACES[0])] += value;
        }
    }
    losses
}

/// Returns the contact states by face and point.
pub(crate) fn contact_states_in_words(
    points: &PointNames,
    contact_states: &[u8],
) -> BTreeMap<String, String> {
    let states = contact_states.iter().enumerate();
    states
        .map(|(point, state)| {
            let (face, name) = points.face_and_name(point);
            let state = ContactState::from_number(*state).name();
            (format!("{}_{name}", FACES[face]), state.to_owned())
        })
        .collect()
}

/// Steps a cycle, at least, of a method that damps the vibrations.
const STEPS_A_CYCLE: f64 = 200.0;

/// Returns the settings of the integrator for a case.
fn options(case: &Case) -> Options {
    let mut options = case.simulation.options();
    if case.simulation.method.tableau().family == Family::DiagonallyImplicit
        && let Some(cycle) = Cycle::of(&case.parameters)
    {
        // Its steps are as long as the motion allows; rows and reversals are to be resolved. At 2 Hz steps of
        // 0.01 s, fifty a cycle, err by 1.3 % in branch forces, two hundred by 0.2 %.
        options.maximum_step = options.maximum_step.min(cycle.period() / STEPS_A_CYCLE);
    }
    options
}
