//! A run that keeps its measures only.

use std::collections::BTreeMap;
use std::ops::ControlFlow;

use integrate::Integrator;
use mechanics::energy_balance::Entries;
use mechanics::plausibility::PlausibilityFinding;
use mechanics::quasi_static::SlidingDirection;
use mechanics::system::{System, SystemLoads};
use quantity::System as Units;
use wedge::outputs::{FACES, Ledger, PointNames};
use wedge::parameters::Parameters;
use wedge::resultants::Resultants;
use wedge::{BOLSTER, Wedge};

use super::contact_times::ContactTimeCounter;
use super::{COUNT, Definitions, Measures, of_wedges, place};
use crate::case::Case;
use crate::closed_form;
use crate::metrics::{Cycle, first_harmonic};
use crate::models::{ModelCase, StudyCase};
use crate::outcome::{Outcome, RunEnd};
use crate::plausibility;
use crate::progress;
use crate::run::wedge_run::{contact_states_in_words, friction_losses};
use crate::run::{Beginning, Recorder, Row, Run, RunCase, RunError, RunSettings, findings};
use crate::summary::{RunSummary as _, Stopped};

/// Reasons why a run has no measures.
#[derive(Clone, Debug, PartialEq)]
pub enum Unmeasured {
    /// It could not begin.
    Refused(String),
    /// It could not go on.
    Stopped(String),
}

/// The measures of a run, and what they stand for.
#[derive(Clone, Debug, PartialEq)]
pub struct Judged {
    /// The measures; of a run that derailed, of the part until then.
    pub measures: Measures,
    /// The run's outcome, which is no stop; a run whose numbers are not to be used has failed.
    pub outcome: Outcome,
}

/// Runs a wedge and measures it.
///
/// # Errors
/// The run cannot begin or does not come to its end.
pub fn measure(case: &Case) -> Result<Measures, Unmeasured> {
    case.judge().map(|judged| judged.measures)
}

impl StudyCase for Case {
    fn cycle(&self) -> Option<Cycle> {
        Cycle::of(&self.parameters)
    }

    fn definitions(&self) -> Definitions {
        of_wedges().clone()
    }

    fn judge(&self) -> Result<Judged, Unmeasured> {
        let run = Run::new(&Measured(self)).map_err(|error| Unmeasured::Refused(error.to_string()))?;
        run.finish(|_| ())
    }
}

/// Runs a case to its end, or until it derails, and measures it; by `nonsense`, a run that means nothing has
/// failed.
///
/// # Errors
/// The run cannot begin or stops on its way.
pub(super) fn judged<C: ModelCase>(
    case: &C,
    nonsense: impl FnOnce(&Run<C>) -> Option<String>,
    measures: impl FnOnce(&C, &C::Output) -> Measures,
) -> Result<Judged, Unmeasured> {
    let mut run = Run::new(case).map_err(|error| Unmeasured::Refused(error.to_string()))?;
    let stopped = run.go_on_while(|_| ControlFlow::Continue(()));
    let nonsense = nonsense(&run);
    let result = run.result(stopped);
    let outcome = match (result.summary.outcome(), nonsense) {
        (Outcome::Stopped(end), _) => {
            return Err(Unmeasured::Stopped(format!("{}; {}", end.reason, C::WHAT_TO_TRY)));
        }
        (Outcome::Complete, Some(reason)) => Outcome::Failed(reason),
        (Outcome::Derailed(end), Some(reason)) => Outcome::Derailed(RunEnd {
            reason: format!("{}; {reason}", end.reason),
            ..end
        }),
        (outcome, _) => outcome,
    };
    Ok(Judged {
        measures: measures(case, &result),
        outcome,
    })
}

/// A wedge's case of which only measures are wanted.
#[derive(Clone, Copy)]
struct Measured<'c>(&'c Case);

impl RunCase for Measured<'_> {
    type Recorder = Measuring;
    type Output = Result<Judged, Unmeasured>;

    const WHERE_TO_LOOK: &'static str = Case::WHERE_TO_LOOK;
    const WHAT_TO_TRY: &'static str = progress::WHAT_TO_TRY;

    fn settings(&self) -> RunSettings<'_> {
        self.0.settings()
    }

    fn begin(&self) -> Result<Beginning<Measuring>, RunError> {
        let wedge = Wedge::new(self.0.parameters.clone())?;
        Ok(Beginning {
            recorder: Measuring::new(wedge.parameters, self.0.simulation.duration),
            system: wedge.system,
            x: wedge.initial_state,
            start_warning: wedge.start_warning,
        })
    }

    fn output(run: Run<Self>, stopped: Option<Stopped>) -> Self::Output {
        match stopped {
            Some(stopped) => {
                let reason = stopped.reason;
                Err(Unmeasured::Stopped(format!(
                    "{reason}; {}",
                    progress::WHAT_TO_TRY
                )))
            }
            None => Ok(Judged {
                outcome: findings::nonsense(&run).map_or(Outcome::Complete, Outcome::Failed),
                measures: run
                    .recorder
                    .finish(&run.integrator, run.energy_balance.relative_residual()),
            }),
        }
    }
}

/// The rows of a run, as far as measures need them.
#[derive(Debug, Default)]
struct Series {
    times: Vec<f64>,
    displacement: Vec<f64>,
    on_bolster: Vec<f64>,
}

/// The metrics of a run on its way.
struct Measuring {
    parameters: Parameters,
    cycle: Option<Cycle>,
    /// The averaging window and its number of cycles.
    window: Option<(f64, f64, u32)>,
    points: PointNames,
    contact_times: ContactTimeCounter,
    /// Friction losses at the ends of the window, by face, J.
    probes: Vec<[f64; 2]>,
    loads: SystemLoads,
    /// Sums and counts of the branches: down, up.
    sums: [[f64; 4]; 2],
    counts: [u64; 2],
    peaks: [f64; 6],
    /// Peaks count from here on, s: the release at the start is none of the motion's.
    peaks_from: f64,
    events: u64,
    series: Series,
}

impl Measuring {
    fn new(parameters: Parameters, duration: f64) -> Self {
        let cycle = Cycle::of(&parameters);
        let window = cycle.and_then(|cycle| cycle.window(duration));
        let averaged = window.map_or((0.0, duration), |(start, end, _)| (start, end));
        let points = PointNames::new(&parameters);
        Self {
            contact_times: ContactTimeCounter::new(averaged, points.range(0).end),
            points,
            cycle,
            window,
            probes: Vec::with_capacity(2),
            loads: SystemLoads::default(),
            sums: [[0.0; 4]; 2],
            counts: [0; 2],
            peaks: [0.0; 6],
            peaks_from: averaged.0,
            events: 0,
            series: Series::default(),
            parameters,
        }
    }
}

impl Recorder for Measuring {
    type Counts = ();

    fn counts(&self) {}

    fn restore(&mut self, (): (), _: f64, _: &[f64]) -> Result<(), RunError> {
        Ok(())
    }

    fn step(&mut self, integrator: &Integrator<System>, system: &mut System, x: &mut [f64]) {
        let time = integrator.time();
        self.events += integrator.events().len() as u64;
        self.contact_times.step(integrator.events(), time);
        // Friction losses at the ends of the averaging window.
        let Some((start, end, _)) = self.window else {
            return;
        };
        while let Some(time) = [start, end].get(self.probes.len()) {
            if *time > integrator.time() {
                return;
            }
            integrator.interpolate_range(*time, 0, x);
            self.probes.push(friction_losses(system, x));
        }
    }

    fn row(&mut self, system: &mut System, row: &Row<'_>) -> Result<Entries, RunError> {
        if row.time == 0.0 {
            self.contact_times.start(row.contact_states);
        }
        system.loads(row.time, row.x, &mut self.loads);
        self.observe_row(row.time);
        let stored = system.energies(row.time, row.x).total() - row.start_energy;
        let [_, _, _, quadratures] = system.layout().split(row.x);
        Ok(Ledger::new(system, stored, quadratures).entries())
    }

    fn describe(&self, system: &System, finding: &PlausibilityFinding, units: Units) -> String {
        plausibility::in_wedge(system, &self.points, finding, units)
    }

    fn contacts(&self, _: &System, contact_states: &[u8]) -> BTreeMap<String, String> {
        contact_states_in_words(&self.points, contact_states)
    }
}

impl Measuring {
    fn observe_row(&mut self, time: f64) {
        let found = Resultants::of(self.parameters.damping, &self.loads);
        let bolster = &self.loads.bodies[BOLSTER];
        let (displacement, speed) = (bolster.travel.0[2], bolster.velocity.0[2]);
        let moments = found.moments.iter().flat_map(|moment| moment.0);
        let moments = moments.take(if time >= self.peaks_from { 6 } else { 0 });
        for (peak, moment) in self.peaks.iter_mut().zip(moments) {
            *peak = peak.max(moment.abs());
        }
        let Some(cycle) = self.cycle else { return };
        if let Some(up) = cycle.branch(self.parameters.damping, time, displacement, speed) {
            let branch = usize::from(up);
            let load = closed_form::load(&self.parameters, displacement);
            let forces: [f64; 4] = [
                found.vertical,
                found.vertical_on_side_frame,
                found.longitudinal,
                load,
            ];
            for (sum, force) in self.sums[branch].iter_mut().zip(forces) {
                *sum += force;
            }
            self.counts[branch] += 1;
        }
        self.series.times.push(time);
        self.series.displacement.push(displacement);
        self.series.on_bolster.push(found.on_bolster.0.0[2]);
    }

    /// Returns the measures, after the last step; `residual` is the relative residual of the energy ledger.
    fn finish(&self, integrator: &Integrator<System>, residual: f64) -> Measures {
        let mut values = [f64::NAN; COUNT];
        self.averages(&mut values);
        values[place::PEAKS..place::PEAKS + 6].copy_from_slice(&self.peaks);
        for face in 0..FACES.len() {
            values[place::LIFT_OFF + face] = self.contact_times.lift_off[face];
            // A face that never touches has no share.
            values[place::STICK + face] =
                self.contact_times.sticking[face] / self.contact_times.touching[face];
        }
        let quasi_static = closed_form::wedge(&self.parameters);
        for (side, direction) in [SlidingDirection::Up, SlidingDirection::Down]
            .into_iter()
            .enumerate()
        {
            if let Some(slide) = quasi_static.slide(direction, quasi_static.branch(direction), 1.0) {
                values[place::QUASI_STATIC_RATIOS + side] = slide.column_normal * libm::cos(quasi_static.toe);
            }
        }
        let margins = [SlidingDirection::Down, SlidingDirection::Up]
            .map(|direction| quasi_static.jam_margin(direction, quasi_static.branch(direction)));
        values[place::JAM_MARGIN] = margins[0].min(margins[1]);
        values[place::JAM_MARGIN + 1..=place::JAM_MARGIN + 2].copy_from_slice(&margins);
        let (time, x) = (integrator.time(), integrator.x());
        let lost = friction_losses(integrator.problem(), x);
        let (from, to, period) = match (self.window, self.probes.as_slice()) {
            (Some((start, end, _)), [from, to]) => (*from, *to, end - start),
            _ => ([0.0; 2], lost, time),
        };
        for face in 0..FACES.len() {
            values[place::WEAR + face] = (to[face] - from[face]) / period;
        }
        values[place::RESIDUAL] = residual;
        values[place::EVENTS] = self.events as f64;
        values[place::STEPS] = integrator.statistics().steps as f64;
        Measures(values.to_vec())
    }

    fn averages(&self, values: &mut [f64; COUNT]) {
        let Some(cycle) = self.cycle else { return };
        for (branch, (sums, count)) in self.sums.iter().zip(self.counts).enumerate() {
            if count == 0 {
                continue;
            }
            let side = 1 - branch;
            let [means @ .., load] = sums;
            for (number, sum) in means.iter().enumerate() {
                values[place::MEANS + 2 * number + side] = sum / count as f64;
            }
            if *load > 0.0 {
                values[place::RATIOS + side] = means[2] / load;
            }
        }
        let (Some((start, end, cycles)), [from, to]) = (self.window, self.probes.as_slice()) else {
            return;
        };
        values[place::CYCLES] = f64::from(cycles);
        for face in 0..FACES.len() {
            values[place::ENERGY_PER_CYCLE + face] = (to[face] - from[face]) / f64::from(cycles);
        }
        values[place::EQUIVALENT_DAMPING] = cycle.equivalent_damping(values[place::ENERGY_PER_CYCLE]);
        let Series {
            times,
            displacement,
            on_bolster,
        } = &self.series;
        let window = (start, end);
        if let Some(found) = first_harmonic(times, displacement, on_bolster, cycle.angular_frequency, window)
        {
            values[place::EQUIVALENT_STIFFNESS] = found.stiffness;
            values[place::EQUIVALENT_DAMPING_ON_BOLSTER] = found.damping;
        }
    }
}
