//! A run: a case being integrated, row by row, with a state that can be saved and continued.

use std::collections::BTreeMap;
use std::ops::ControlFlow;

use integrate::{Family, Integrator, Options, SetupError, State};
use mechanics::energy_balance::EnergyBalance;
use mechanics::output::Column;
use mechanics::plausibility::{Plausibility, PlausibilityRecord};
use mechanics::system::{ContactState, EnergyTermKind, System};
use serde::{Deserialize, Serialize};
use thiserror::Error;
use wedge::outputs::{CORNERS, FACES, Outputs};
use wedge::{BuildError, Wedge};

use crate::case::Case;
use crate::finite::is_finite;
use crate::metrics::Cycle;
use crate::progress::{self, INTERVALS, Pace};
use crate::result::{ContactEvent, RunResult};
use crate::rows::Rows;
use crate::summary::Stopped;

mod check;
mod summarize;

/// Version of [`RunState`].
pub const RUN_STATE_VERSION: u32 = 3;
/// How many events are listed at most.
pub const EVENT_CAP: usize = 500;

/// Why a run cannot begin or go on.
#[derive(Debug, Error)]
pub enum RunError {
    /// The parameters make no wedge.
    #[error(transparent)]
    Build(#[from] BuildError),
    /// The integrator cannot be set up.
    #[error(transparent)]
    Setup(#[from] SetupError),
    /// The integrator cannot go on, or the run hardly progresses ([`progress`]).
    #[error("{reason}; contacts: {contacts}")]
    Step {
        /// Why, with the state whose error is largest.
        reason: String,
        /// Contact states at that time, in words.
        contacts: String,
    },
    /// A column of the result is not finite.
    #[error(
        "`{column}` is {value} at {time} s, which is not a finite number: look for values out of all proportion"
    )]
    NotFinite {
        /// The column, without unit.
        column: String,
        /// Its value, SI.
        value: f64,
        /// The time, s.
        time: f64,
    },
    /// A saved state that this version cannot read.
    #[error("the saved run state has version {found}; this program reads version {RUN_STATE_VERSION}")]
    Version {
        /// The version found.
        found: u32,
    },
    /// A saved state has a member that no run of this case can have.
    #[error(
        "the saved run state is damaged: `{member}` is {found}; it must be {expected}. Continue from the state as it was saved, \
         or run the case from its start"
    )]
    Damaged {
        /// The member.
        member: &'static str,
        /// What it is.
        found: String,
        /// What it must be.
        expected: String,
    },
}

/// Everything needed to continue a run with the same bits.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct RunState {
    /// [`RUN_STATE_VERSION`].
    pub version: u32,
    /// States, quadratures, modes and controller memory.
    pub integrator: State,
    /// The next row to be written.
    pub next_row: u64,
    /// What has been counted so far.
    pub counts: Counts,
    /// What has been seen for the plausibility of the run.
    pub plausibility: PlausibilityRecord,
}

/// What is counted along a run.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Counts {
    /// Stored energy at the start, J.
    pub start_energy: f64,
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
    /// The energy balance at the output times.
    pub energy_balance: EnergyBalance,
    /// How far it has come, and with how many steps.
    pub pace: Pace,
    /// Whether the case file gave no values.
    pub nothing_given: bool,
}

/// A run under way.
pub struct Run {
    case: Case,
    rows: Rows,
    wedge: Wedge,
    outputs: Outputs,
    integrator: Integrator<System>,
    next_row: u64,
    counts: Counts,
    plausibility: Plausibility,
    probe_times: Vec<f64>,
    values: Vec<Vec<f64>>,
    buffer: Vec<f64>,
    row: Vec<f64>,
    contact_states: Vec<u8>,
    speeds: Vec<f64>,
}

impl Run {
    /// A run at its start.
    ///
    /// # Errors
    /// The parameters make no wedge, or the integrator refuses the start.
    pub fn new(case: &Case) -> Result<Self, RunError> {
        let mut wedge = Wedge::new(case.parameters.clone())?;
        let start = wedge.initial_state.clone();
        let start_energy = wedge.system.observe(0.0, &start).energies.total();
        let integrator = Integrator::new(wedge.system.clone(), options(case), 0.0, &start)?;
        let points = wedge.system.point_count();
        let counts = Counts {
            start_energy,
            crept: vec![0.0; points],
            creep_speeds: vec![0.0; points],
            events: vec![[0; 4]; FACES.len()],
            energy_balance: EnergyBalance::new(start_energy),
            nothing_given: case.nothing_given,
            ..Counts::default()
        };
        let plausibility = Plausibility::new(&mut wedge.system, 0.0, &start);
        let mut run = Self::assemble(case, wedge, integrator, (counts, plausibility), 0);
        run.emit_rows(true)?;
        Ok(run)
    }

    /// A run that goes on from a saved state of the same case. Rows written before are not repeated.
    ///
    /// # Errors
    /// The state belongs to another version or another case, or is damaged.
    pub fn resume(case: &Case, state: RunState) -> Result<Self, RunError> {
        if state.version != RUN_STATE_VERSION {
            return Err(RunError::Version { found: state.version });
        }
        let mut wedge = Wedge::new(case.parameters.clone())?;
        state.check(case, wedge.system.point_count())?;
        let start = &wedge.initial_state;
        let plausibility = Plausibility::resume(&mut wedge.system, 0.0, start, state.plausibility);
        let plausibility = plausibility.ok_or_else(check::implausible)?;
        let integrator = Integrator::resume(wedge.system.clone(), options(case), state.integrator)?;
        Ok(Self::assemble(
            case,
            wedge,
            integrator,
            (state.counts, plausibility),
            state.next_row,
        ))
    }

    fn assemble(
        case: &Case,
        wedge: Wedge,
        integrator: Integrator<System>,
        (counts, plausibility): (Counts, Plausibility),
        next_row: u64,
    ) -> Self {
        let outputs = Outputs::new(&wedge.parameters);
        let points = wedge.system.point_count();
        Self {
            probe_times: probe_times(case),
            values: vec![Vec::new(); outputs.columns().len()],
            buffer: vec![0.0; wedge.initial_state.len()],
            row: Vec::with_capacity(outputs.columns().len()),
            contact_states: integrator.discrete_states().to_vec(),
            speeds: vec![0.0; points],
            case: case.clone(),
            rows: Rows::of(&case.simulation),
            wedge,
            outputs,
            integrator,
            next_row,
            counts,
            plausibility,
        }
    }

    /// The case that is run.
    #[must_use]
    pub fn case(&self) -> &Case {
        &self.case
    }

    /// Time reached, s.
    #[must_use]
    pub fn time(&self) -> f64 {
        self.integrator.time()
    }

    /// Whether the end is reached.
    #[must_use]
    pub fn is_finished(&self) -> bool {
        self.time() >= self.case.simulation.duration
    }

    /// The state, to be continued by [`Run::resume`].
    #[must_use]
    pub fn state(&self) -> RunState {
        RunState {
            version: RUN_STATE_VERSION,
            integrator: self.integrator.state(),
            next_row: self.next_row,
            counts: self.counts.clone(),
            plausibility: self.plausibility.record().clone(),
        }
    }

    /// The columns of the result.
    #[must_use]
    pub fn columns(&self) -> &[Column] {
        self.outputs.columns()
    }

    /// One step of the integrator, with all rows and events that fall into it.
    ///
    /// # Errors
    /// The integrator cannot go on; what was computed is kept.
    pub fn advance(&mut self) -> Result<(), RunError> {
        let limit = self.rows.limit(self.next_row, &self.integrator);
        if let Err(error) = self.integrator.step_to(limit) {
            return Err(self.cannot_go_on(progress::describe(&error, |state| self.state_name(state))));
        }
        self.count_events();
        self.count_creep();
        self.probe();
        self.emit_rows(false)?;
        let short = INTERVALS * self.case.simulation.output_interval;
        let progresses = self.counts.pace.check(&self.integrator, short);
        progresses.map_err(|stalled| self.cannot_go_on(stalled.describe(|state| self.state_name(state))))
    }

    fn cannot_go_on(&self, reason: String) -> RunError {
        let contacts = self.contact_words();
        RunError::Step { reason, contacts }
    }

    fn state_name(&self, state: usize) -> String {
        progress::state_name(&self.wedge.system, state)
    }

    /// Runs to the end and gives the result; a run that cannot go on gives an incomplete result with the reason.
    #[must_use]
    pub fn finish(self, mut progress: impl FnMut(f64)) -> RunResult {
        self.finish_while(|time| {
            progress(time);
            ControlFlow::Continue(())
        })
    }

    /// As [`Run::finish`], but asks after each step, with the time reached, whether to go on. When not, it is
    /// told why, and the result is incomplete for that reason.
    #[must_use]
    pub fn finish_while(mut self, mut progress: impl FnMut(f64) -> ControlFlow<String>) -> RunResult {
        let mut reason = None;
        while reason.is_none() && !self.is_finished() {
            reason = match self.advance() {
                Ok(()) => progress(self.time())
                    .break_value()
                    .filter(|_| !self.is_finished()),
                Err(error) => Some(error.to_string()),
            };
        }
        let stopped = reason.map(|reason| Stopped {
            time: self.time(),
            reason,
            contacts: self.contact_states(),
        });
        self.result(stopped)
    }

    /// The result so far.
    #[must_use]
    pub fn result(mut self, stopped: Option<Stopped>) -> RunResult {
        let mut summary = summarize::summary(&mut self, stopped);
        if let Some(what) = summary.not_finite().filter(|_| summary.stopped.is_none()) {
            summary.complete = false;
            summary.stopped = Some(Stopped {
                time: self.time(),
                reason: format!("{what} is not a finite number: look for values out of all proportion"),
                contacts: self.contact_states(),
            });
        }
        RunResult {
            columns: self.outputs.columns().to_vec(),
            values: self.values,
            summary,
        }
    }

    /// Contact states by face and corner.
    #[must_use]
    pub fn contact_states(&self) -> BTreeMap<String, String> {
        self.integrator
            .discrete_states()
            .iter()
            .enumerate()
            .map(|(point, contact_state)| {
                let (face, corner) = place(point);
                (
                    format!("{face}_{corner}"),
                    ContactState::from_number(*contact_state).name().to_owned(),
                )
            })
            .collect()
    }

    fn contact_words(&self) -> String {
        let words: Vec<String> = self
            .contact_states()
            .into_iter()
            .map(|(place, contact_state)| format!("{place} {contact_state}"))
            .collect();
        words.join(", ")
    }

    fn count_events(&mut self) {
        for event in self.integrator.events() {
            let (face, corner) = place(event.index);
            let kind = match (
                ContactState::from_number(event.from),
                ContactState::from_number(event.to),
            ) {
                (_, ContactState::Open) => 0,
                (ContactState::Open, _) => 1,
                (_, ContactState::Stick) => 2,
                (_, ContactState::Slip) => 3,
            };
            self.counts.events[event.index / CORNERS.len()][kind] += 1;
            self.counts.event_total += 1;
            if self.counts.listed.len() < EVENT_CAP {
                self.counts.listed.push(ContactEvent {
                    time: event.time,
                    face: face.to_owned(),
                    corner: corner.to_owned(),
                    from: ContactState::from_number(event.from).name().to_owned(),
                    to: ContactState::from_number(event.to).name().to_owned(),
                });
            }
        }
    }

    /// Adds the creep of corners that were stuck at both ends of the step (trapezoidal rule).
    fn count_creep(&mut self) {
        let stuck = ContactState::Stick as u8;
        let (before, after) = (
            self.integrator.discrete_states_before_step(),
            self.integrator.discrete_states(),
        );
        let step = self.integrator.time() - self.integrator.previous_time();
        let any = before.iter().zip(after).any(|(a, b)| *a == stuck && *b == stuck);
        if !any {
            self.counts.creep_speeds.fill(0.0);
            return;
        }
        self.wedge.system.segment_like(self.integrator.problem());
        self.wedge
            .system
            .creep_speeds(self.integrator.time(), self.integrator.x(), &mut self.speeds);
        for point in 0..self.speeds.len() {
            if before[point] == stuck && after[point] == stuck {
                let mean = 0.5 * (self.counts.creep_speeds[point] + self.speeds[point]);
                self.counts.crept[point] += mean * step;
            }
        }
        self.counts.creep_speeds.copy_from_slice(&self.speeds);
    }

    /// Notes the friction losses at the ends of the averaging window.
    fn probe(&mut self) {
        while let Some(time) = self.probe_times.get(self.counts.probes.len()) {
            if *time > self.integrator.time() {
                return;
            }
            self.integrator.interpolate_range(*time, 0, &mut self.buffer);
            let losses = friction_losses(&self.wedge.system, &self.buffer);
            self.counts.probes.push(losses);
        }
    }

    /// Writes the rows whose time has been reached, with the contact modes of that time, up to one that is not finite.
    fn emit_rows(&mut self, first: bool) -> Result<(), RunError> {
        let rows = self.rows;
        // Most steps reach no row.
        if rows.time(self.next_row) > self.integrator.time() {
            return Ok(());
        }
        self.contact_states
            .copy_from_slice(self.integrator.discrete_states_before_step());
        if first {
            self.contact_states
                .copy_from_slice(self.integrator.discrete_states());
        }
        let mut seen_events = 0;
        while self.next_row < rows.count {
            let time = rows.time(self.next_row);
            if time > self.integrator.time() {
                break;
            }
            let events = self.integrator.events().iter().skip(seen_events);
            for event in events.take_while(|event| event.time <= time && !first) {
                self.contact_states[event.index] = event.to;
                seen_events += 1;
            }
            if first {
                self.buffer.copy_from_slice(self.integrator.x());
            } else {
                self.integrator.interpolate(time, &mut self.buffer);
            }
            self.wedge.system.segment_like(self.integrator.problem());
            let seen = self.wedge.system.observe(time, &self.buffer);
            self.row.clear();
            let start = self.counts.start_energy;
            let ledger = self.outputs.values(
                &self.wedge.system,
                &seen,
                &self.contact_states,
                start,
                &mut self.row,
            );
            if let Some(index) = self.row.iter().position(|value| !is_finite(*value)) {
                return Err(RunError::NotFinite {
                    column: self.outputs.columns()[index].name.clone(),
                    value: self.row[index],
                    time,
                });
            }
            for (column, value) in self.values.iter_mut().zip(&self.row) {
                column.push(*value);
            }
            self.counts.energy_balance.note(time, &ledger.entries());
            if !first {
                self.plausibility.note(&mut self.wedge.system, time, &self.buffer);
            }
            self.next_row += 1;
        }
        Ok(())
    }
}

/// The ends of the averaging window, s; none without one.
fn probe_times(case: &Case) -> Vec<f64> {
    let window = Cycle::of(&case.parameters).and_then(|cycle| cycle.window(case.simulation.duration));
    window.map_or(Vec::new(), |(start, end, _)| vec![start, end])
}

/// Energy lost in friction so far, J, by face.
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

/// Face and corner of a contact point.
fn place(point: usize) -> (&'static str, &'static str) {
    (FACES[point / CORNERS.len()], CORNERS[point % CORNERS.len()])
}

/// Steps a cycle, at least, of a method that damps the vibrations.
const STEPS_A_CYCLE: f64 = 200.0;

/// The integrator's settings of a case.
pub(crate) fn options(case: &Case) -> Options {
    let method = case.simulation.method;
    let maximum_step = match method.tableau().family {
        // Its steps are as long as the motion allows; rows and reversals are to be resolved. At 2 Hz steps of 0.01 s, fifty a cycle,
        // err by 1.3 % in branch forces, two hundred by 0.2 %.
        Family::DiagonallyImplicit => Cycle::of(&case.parameters)
            .map_or(f64::INFINITY, |cycle| cycle.period() / STEPS_A_CYCLE)
            .min(case.simulation.output_interval),
        _ => f64::INFINITY,
    };
    Options {
        relative_tolerance: case.simulation.relative_tolerance,
        maximum_step,
        ..Options::of(method)
    }
}
