//! A run that keeps its measures only.

use integrate::Integrator;
use mechanics::energy_balance::EnergyBalance;
use mechanics::plausibility::Plausibility;
use mechanics::quasi_static::Direction;
use mechanics::system::{Loads, System};
use wedge::outputs::{FACES, Ledger};
use wedge::resultants::Resultants;
use wedge::{BOLSTER, Wedge};

use super::clock::ContactClock;
use super::{Measures, place};
use crate::case::{Case, Simulation};
use crate::closed_form;
use crate::metrics::{Cycle, first_harmonic};
use crate::plausibility;
use crate::progress::{self, INTERVALS, Pace};
use crate::rows::Rows;
use crate::run::{RunError, friction_losses, options};

/// Why a run has no measures.
#[derive(Clone, Debug, PartialEq)]
pub enum Unmeasured {
    /// It could not begin.
    Refused(String),
    /// It could not go on.
    Stopped(String),
}

/// The measures of a run, and why they mean nothing if they do not.
#[derive(Clone, Debug, PartialEq)]
pub struct Judged {
    /// The measures.
    pub measures: Measures,
    /// Why the run is nonsense ([`plausibility::nonsense`]); `None` if it is not.
    pub nonsense: Option<String>,
}

/// Runs a case and measures it.
///
/// # Errors
/// The run cannot begin or does not come to its end.
pub fn measure(case: &Case) -> Result<Measures, Unmeasured> {
    judge(case).map(|judged| judged.measures)
}

/// Runs a case, measures it, and judges whether the measures mean something.
///
/// # Errors
/// The run cannot begin or does not come to its end.
pub fn judge(case: &Case) -> Result<Judged, Unmeasured> {
    let refused = |error: RunError| Unmeasured::Refused(error.to_string());
    let wedge = Wedge::new(case.parameters.clone()).map_err(|error| refused(error.into()))?;
    let mut integrator = Integrator::new(wedge.system.clone(), options(case), 0.0, &wedge.initial_state)
        .map_err(|error| refused(error.into()))?;
    let mut measuring = Measuring::new(&case.simulation, wedge, &integrator);
    let mut pace = Pace::of(&integrator);
    while integrator.time() < measuring.rows.end {
        let limit = measuring.rows.limit(measuring.next_row, &integrator);
        if let Err(error) = integrator.step_to(limit) {
            let name = |state| progress::state_name(integrator.problem(), state);
            return Err(stopped(&progress::describe(&error, name)));
        }
        measuring.after_step(&mut integrator);
        if let Err(stalled) = pace.check(&integrator, INTERVALS * case.simulation.output_interval) {
            let name = |state| progress::state_name(integrator.problem(), state);
            return Err(stopped(&stalled.describe(name)));
        }
    }
    let Simulation {
        output_interval,
        output_units,
        ..
    } = case.simulation;
    let (seen, system, balance) = (
        &measuring.plausibility,
        &measuring.wedge.system,
        &measuring.balance,
    );
    let nonsense = plausibility::nonsense(seen, system, balance, output_interval, output_units);
    Ok(Judged {
        measures: measuring.finish(&integrator),
        nonsense,
    })
}

fn stopped(why: &str) -> Unmeasured {
    Unmeasured::Stopped(format!("{why}; {}", progress::WHAT_TO_TRY))
}

/// The rows of a run, as far as measures need them.
#[derive(Debug, Default)]
struct Series {
    times: Vec<f64>,
    displacement: Vec<f64>,
    on_bolster: Vec<f64>,
}

/// What is measured of a run on its way.
struct Measuring {
    rows: Rows,
    wedge: Wedge,
    cycle: Option<Cycle>,
    /// The averaging window and its number of cycles.
    window: Option<(f64, f64, u32)>,
    clock: ContactClock,
    start_energy: f64,
    balance: EnergyBalance,
    plausibility: Plausibility,
    /// Friction losses at the ends of the window, by face, J.
    probes: Vec<[f64; 2]>,
    next_row: u64,
    buffer: Vec<f64>,
    loads: Loads,
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
    fn new(simulation: &Simulation, mut wedge: Wedge, integrator: &Integrator<System>) -> Self {
        let cycle = Cycle::of(&wedge.parameters);
        let rows = Rows::of(simulation);
        let window = cycle.and_then(|cycle| cycle.window(rows.end));
        let averaged = window.map_or((0.0, rows.end), |(start, end, _)| (start, end));
        let start = wedge.initial_state.clone();
        let start_energy = wedge.system.energies(0.0, &start).total();
        let mut this = Self {
            clock: ContactClock::new(integrator.discrete_states(), averaged),
            cycle,
            window,
            start_energy,
            balance: EnergyBalance::new(start_energy),
            plausibility: Plausibility::new(&mut wedge.system, 0.0, &start),
            probes: Vec::with_capacity(2),
            next_row: 0,
            rows,
            buffer: start,
            loads: Loads::default(),
            sums: [[0.0; 4]; 2],
            counts: [0; 2],
            peaks: [0.0; 6],
            peaks_from: averaged.0,
            events: 0,
            series: Series::default(),
            wedge,
        };
        this.observe_row(0.0);
        this.next_row = 1;
        this
    }

    /// Measures an accepted step.
    fn after_step(&mut self, integrator: &mut Integrator<System>) {
        let time = integrator.time();
        self.events += integrator.events().len() as u64;
        self.clock.step(integrator.events(), time);
        self.probe(integrator);
        self.wedge.system.segment_like(integrator.problem());
        while self.next_row < self.rows.count {
            let row = self.rows.time(self.next_row);
            if row > time {
                break;
            }
            integrator.interpolate(row, &mut self.buffer);
            self.observe_row(row);
            self.plausibility.note(&mut self.wedge.system, row, &self.buffer);
            self.next_row += 1;
        }
    }

    /// Notes the friction losses at the ends of the averaging window.
    fn probe(&mut self, integrator: &Integrator<System>) {
        let (start, end) = match self.window {
            Some((start, end, _)) => (start, end),
            None => return,
        };
        while let Some(time) = [start, end].get(self.probes.len()) {
            if *time > integrator.time() {
                return;
            }
            integrator.interpolate_range(*time, 0, &mut self.buffer);
            let losses = friction_losses(&self.wedge.system, &self.buffer);
            self.probes.push(losses);
        }
    }

    fn observe_row(&mut self, time: f64) {
        self.wedge.system.loads(time, &self.buffer, &mut self.loads);
        self.balance_row(time);
        let found = Resultants::of(self.wedge.parameters.damping, &self.loads);
        let bolster = &self.loads.bodies[BOLSTER];
        let (displacement, speed) = (bolster.travel.0[2], bolster.velocity.0[2]);
        let moments = found.moments.iter().flat_map(|moment| moment.0);
        let moments = moments.take(if time >= self.peaks_from { 6 } else { 0 });
        for (peak, moment) in self.peaks.iter_mut().zip(moments) {
            *peak = peak.max(moment.abs());
        }
        let Some(cycle) = self.cycle else { return };
        if let Some(up) = cycle.branch(self.wedge.parameters.damping, time, displacement, speed) {
            let branch = usize::from(up);
            let load = closed_form::load(&self.wedge.parameters, displacement);
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

    /// Takes the ledger of a row into account.
    fn balance_row(&mut self, time: f64) {
        let system = &mut self.wedge.system;
        let stored = system.energies(time, &self.buffer).total() - self.start_energy;
        let [_, _, _, quadratures] = system.layout().split(&self.buffer);
        let ledger = Ledger::new(system, stored, quadratures);
        self.balance.note(time, &ledger.entries());
    }

    /// The measures, after the last step.
    fn finish(&mut self, integrator: &Integrator<System>) -> Measures {
        let mut measures = Measures::NONE;
        let values = &mut measures.0;
        self.averages(values);
        values[place::PEAKS..place::PEAKS + 6].copy_from_slice(&self.peaks);
        for face in 0..FACES.len() {
            values[place::LIFT_OFF + face] = self.clock.lift_off[face];
            // A face that never touches has no share.
            values[place::STICK + face] = self.clock.sticking[face] / self.clock.touching[face];
        }
        let quasi_static = closed_form::wedge(&self.wedge.parameters);
        for (side, direction) in [Direction::Up, Direction::Down].into_iter().enumerate() {
            if let Some(slide) = quasi_static.slide(direction, quasi_static.branch(direction), 1.0) {
                values[place::QUASI_STATIC_RATIOS + side] = slide.column_normal * libm::cos(quasi_static.toe);
            }
        }
        let margins = [Direction::Down, Direction::Up]
            .map(|direction| quasi_static.jam_margin(direction, quasi_static.branch(direction)));
        values[place::JAM_MARGIN] = margins[0].min(margins[1]);
        values[place::JAM_MARGIN + 1..=place::JAM_MARGIN + 2].copy_from_slice(&margins);
        let (time, x) = (integrator.time(), integrator.x());
        let lost = friction_losses(&self.wedge.system, x);
        let (from, to, period) = match (self.window, self.probes.as_slice()) {
            (Some((start, end, _)), [from, to]) => (*from, *to, end - start),
            _ => ([0.0; 2], lost, time),
        };
        for face in 0..FACES.len() {
            values[place::WEAR + face] = (to[face] - from[face]) / period;
        }
        values[place::RESIDUAL] = self.balance.relative_residual();
        values[place::EVENTS] = self.events as f64;
        values[place::STEPS] = integrator.statistics().steps as f64;
        measures
    }

    fn averages(&self, values: &mut [f64; super::COUNT]) {
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
