//! Running a half-truck.

use std::collections::BTreeMap;
use std::ops::ControlFlow;

use integrate::{Integrator, Options, SetupError};
use mechanics::body::COORDINATES;
use mechanics::energy_balance::{EnergyBalance, Entries};
use mechanics::motion::Motion;
use mechanics::plausibility::Plausibility;
use mechanics::system::NoEquilibrium;
use mechanics::system::{EnergyTermKind, ModelError, Observation, StaticFriction, System};
use quantity::Kind;
use thiserror::Error;

use super::table::{Table, input_motion};
use super::{SCHEMA, TruckCase, TruckResult, TruckStart, TruckSummary, WedgeSummary};
use crate::energy;
use crate::finite::{find, is_finite};
use crate::metrics::{Cycle, mean};
use crate::plausibility;
use crate::progress::{self, INTERVALS, Pace};
use crate::summary::{Stopped, SummaryValue};

/// Why a run cannot begin.
#[derive(Debug, Error)]
pub enum TruckError {
    /// The files make no system.
    #[error(transparent)]
    Model(#[from] ModelError),
    /// There is no equilibrium to start from.
    #[error("no static equilibrium was found to start from: {0}")]
    Equilibrium(#[from] NoEquilibrium),
    /// The integrator cannot be set up.
    #[error(transparent)]
    Setup(#[from] SetupError),
    /// A column of the result is not finite at the start.
    #[error(
        "`{column}` is {value} at the start, which is not a finite number: look for values out of all proportion"
    )]
    NotFinite {
        /// The column, without unit.
        column: String,
        /// Its value, SI.
        value: f64,
    },
}

/// The state at the start.
///
/// # Errors
/// There is no equilibrium.
pub fn start(system: &mut System, start: TruckStart) -> Result<Vec<f64>, NoEquilibrium> {
    let drawn = system.initial_state();
    match start {
        TruckStart::Drawn => Ok(drawn),
        TruckStart::Equilibrium => system.equilibrium(0.0, &drawn, StaticFriction::Without),
    }
}

/// Runs a half-truck to its end; a run that cannot go on gives an incomplete result with the reason.
///
/// # Errors
/// The run cannot begin.
pub fn run(case: &TruckCase, mut progress: impl FnMut(f64)) -> Result<TruckResult, TruckError> {
    let keep_on = |time| {
        progress(time);
        ControlFlow::Continue(())
    };
    run_while(case, keep_on)
}

/// As [`run`], but asks after each step, with the time reached, whether to go on. When not, it is told why,
/// and the result is incomplete for that reason.
///
/// # Errors
/// The run cannot begin.
pub fn run_while(
    case: &TruckCase,
    mut progress: impl FnMut(f64) -> ControlFlow<String>,
) -> Result<TruckResult, TruckError> {
    let mut system = System::new(case.truck.model.clone())?;
    let x = start(&mut system, case.start)?;
    let start_energy = system.observe(0.0, &x).energies.total();
    let table = Table::new(&case.truck, &system, &case.requests, start_energy);
    let options = Options {
        relative_tolerance: case.relative_tolerance,
        ..Options::default()
    };
    let mut works = Works::new(case);
    let mut integrator = Integrator::new(system.clone(), options, 0.0, &x)?;
    let mut values = vec![Vec::new(); table.columns.len()];
    let mut balance = EnergyBalance::new(start_energy);
    let mut plausibility = Plausibility::new(&mut system, 0.0, &x);
    table.read(&system.observe(0.0, &x), &mut values);
    if let Some((column, value)) = drop_not_finite(&table, &mut values) {
        return Err(TruckError::NotFinite { column, value });
    }
    let count = (case.duration / case.interval * (1.0 + 1e-12)).floor() as u64;
    let mut row = 1;
    let mut buffer = x;
    let mut stopped = None;
    let mut pace = Pace::of(&integrator);
    let numbers = [&*case.truck.bodies, &*case.truck.connections];
    let stop = |time: f64, reason: String| {
        Some(Stopped {
            time,
            reason,
            contacts: BTreeMap::new(),
        })
    };
    'steps: while row <= count {
        if let Err(error) = integrator.step_to(case.duration) {
            let name = |state| progress::truck_state_name(integrator.problem(), numbers, state);
            stopped = stop(integrator.time(), progress::describe(&error, name));
            break;
        }
        system.segment_like(integrator.problem());
        works.add_step(&integrator, &mut system, &mut buffer);
        while row <= count {
            let time = (row as f64 * case.interval).min(case.duration);
            if time > integrator.time() {
                break;
            }
            integrator.interpolate(time, &mut buffer);
            let seen = system.observe(time, &buffer);
            table.read(&seen, &mut values);
            if let Some((column, value)) = drop_not_finite(&table, &mut values) {
                stopped = stop(
                    time,
                    format!("`{column}` is {value}, which is not a finite number"),
                );
                break 'steps;
            }
            balance.note(time, &entries(&system, &seen, start_energy));
            plausibility.note(&mut system, time, &buffer);
            row += 1;
        }
        if let Err(stalled) = pace.check(&integrator, INTERVALS * case.interval)
            && row <= count
        {
            let name = |state| progress::truck_state_name(integrator.problem(), numbers, state);
            stopped = stop(integrator.time(), stalled.describe(name));
            break;
        }
        if let ControlFlow::Break(reason) = progress(integrator.time())
            && row <= count
        {
            stopped = stop(integrator.time(), reason);
            break;
        }
    }
    let (seen, scales) = (&plausibility, (case.interval, case.units));
    let implausible = plausibility::of_truck(seen, &system, numbers, &balance, scales);
    let joules = |value| SummaryValue::new(value, Kind::Energy, case.units);
    let mut result = TruckResult {
        columns: table.columns,
        values,
        summary: TruckSummary {
            schema: SCHEMA.to_owned(),
            program: concat!("wedgelab ", env!("CARGO_PKG_VERSION")).to_owned(),
            name: case.name.clone(),
            title: case.title.clone(),
            units: case.units,
            complete: stopped.is_none(),
            stopped,
            failed: energy::failure(&balance, energy::WHAT_TO_DO_WITH_FILES),
            warnings: energy::warning(&balance, energy::WHAT_TO_DO_WITH_FILES)
                .into_iter()
                .chain(implausible)
                .collect(),
            rows: 0,
            yaw: None,
            wedges: BTreeMap::new(),
            largest_displacements: BTreeMap::new(),
            ledger: BTreeMap::new(),
            largest_stored_change: joules(balance.largest_stored_change),
            largest_residual: joules(balance.largest_residual),
            largest_residual_time: balance.largest_residual_time,
            largest_relative_residual: balance.relative_residual(),
            statistics: integrator.statistics().clone(),
            relative_tolerance: case.relative_tolerance,
            assumptions: case.assumptions.clone(),
        },
    };
    summarize(case, &system, &works, &mut result);
    if let Some(what) = first_not_finite(&result.summary)
        && result.summary.stopped.is_none()
    {
        result.summary.complete = false;
        result.summary.stopped = stop(integrator.time(), format!("{what} is not a finite number"));
    }
    Ok(result)
}

/// Returns what the energy balance takes from an instant; `start` is the stored energy at the start, J.
fn entries(system: &System, seen: &Observation, start: f64) -> Entries {
    let mut entries = Entries {
        work: 0.0,
        losses: 0.0,
        stored_change: seen.energies.total() - start,
        residual: -seen.residual(start),
    };
    for (energy_term, value) in system.energy_terms().iter().zip(&seen.quadratures) {
        match energy_term.kind {
            EnergyTermKind::MotionWork => entries.work += value,
            // An entry of either sign, which is neither.
            EnergyTermKind::WedgeKinematics => {}
            _ => entries.losses += value,
        }
    }
    entries
}

/// Takes the last row away if one of its values is not finite; gives the column and the value.
fn drop_not_finite(table: &Table, values: &mut [Vec<f64>]) -> Option<(String, f64)> {
    let last = |column: &Vec<f64>| column.last().copied().unwrap_or(0.0);
    let index = values.iter().position(|column| !is_finite(last(column)))?;
    let value = last(&values[index]);
    for column in values.iter_mut() {
        column.pop();
    }
    Some((table.columns[index].name.clone(), value))
}

/// The first number of a summary that is not finite, in words.
fn first_not_finite(summary: &TruckSummary) -> Option<String> {
    let wedge = |wedge: &WedgeSummary| {
        let measures = [
            &wedge.energy_per_cycle,
            &wedge.up,
            &wedge.down,
            &wedge.largest_normal_force,
        ];
        measures
            .into_iter()
            .flatten()
            .any(|measure| !is_finite(measure.value))
    };
    let wedges = summary.wedges.iter().find(|(_, found)| wedge(found));
    let wedges = wedges.map(|(number, _)| format!("an average of wedge {number}"));
    let others = find(&summary.largest_displacements).or_else(|| find(&summary.ledger));
    let residual = !is_finite(summary.largest_relative_residual);
    let residual = residual.then(|| "the ledger's relative residual".to_owned());
    wedges.or(others.map(|name| format!("`{name}`"))).or(residual)
}

/// The cycle of the vertical input, if it is one sine.
fn cycle(case: &TruckCase) -> Option<Cycle> {
    match input_motion(&case.truck.model)? {
        Motion::Sine {
            amplitude,
            angular_frequency,
            ..
        } => Some(Cycle::sine(*amplitude, *angular_frequency)),
        _ => None,
    }
}

/// The work of each wedge's friction at the column over whole cycles, taken step by step from the dense output (Simpson's rule):
/// the input springs ring, which rows would miss.
struct Works {
    window: Option<(f64, f64, u32)>,
    wedges: Vec<usize>,
    works: Vec<f64>,
    reached: f64,
    powers: [Vec<f64>; 3],
}

impl Works {
    fn new(case: &TruckCase) -> Self {
        let wedges: Vec<usize> = case.truck.wedges().collect();
        let none = vec![0.0; wedges.len()];
        Self {
            window: cycle(case).and_then(|cycle| cycle.window(case.duration)),
            works: none.clone(),
            powers: [none.clone(), none.clone(), none],
            wedges,
            reached: 0.0,
        }
    }

    /// Adds the part of the last step that lies in the window.
    fn add_step(&mut self, integrator: &Integrator<System>, system: &mut System, buffer: &mut [f64]) {
        let (from, to) = (self.reached, integrator.time());
        self.reached = to;
        let Some((start, end, _)) = self.window else {
            return;
        };
        let (from, to) = (from.max(start), to.min(end));
        if to <= from {
            return;
        }
        for (time, powers) in [from, 0.5 * (from + to), to].into_iter().zip(&mut self.powers) {
            integrator.interpolate_range(time, 0, buffer);
            let wedges = &self.wedges;
            system.column_powers(time, buffer, |connection, power| {
                if let Some(index) = wedges.iter().position(|own| *own == connection) {
                    powers[index] = power;
                }
            });
        }
        let [a, b, c] = &self.powers;
        for (index, work) in self.works.iter_mut().enumerate() {
            *work += (to - from) / 6.0 * (a[index] + 4.0 * b[index] + c[index]);
        }
    }

    fn per_cycle(&self, place: usize) -> Option<f64> {
        let (_, _, cycles) = self.window?;
        let index = self.wedges.iter().position(|own| *own == place)?;
        Some(self.works[index] / f64::from(cycles))
    }
}

fn summarize(case: &TruckCase, system: &System, works: &Works, result: &mut TruckResult) {
    let units = case.units;
    let times = result.column("time").unwrap_or_default().to_vec();
    let mut wedges = BTreeMap::new();
    for place in case.truck.wedges() {
        let number = case.truck.connections[place];
        wedges.insert(number.to_string(), wedge(case, result, works, place));
    }
    let mut largest = BTreeMap::new();
    for (place, number) in case.truck.bodies.iter().enumerate() {
        let free = &case.truck.model.bodies[place].free;
        for (coordinate, name) in COORDINATES.iter().enumerate().filter(|(k, _)| free[*k]) {
            let column = format!("body_{number}_{name}");
            let Some(values) = result.column(&column) else {
                continue;
            };
            let most = values.iter().fold(0.0, |most: f64, value| most.max(value.abs()));
            let kind = if coordinate < 3 { Kind::Length } else { Kind::Angle };
            largest.insert(column, SummaryValue::new(most, kind, units));
        }
    }
    let mut ledger = BTreeMap::new();
    let names = [
        "kinetic_energy",
        "gravity_energy",
        "spring_energy",
        "coil_energy",
        "accumulator_energy",
        "ledger_residual",
    ];
    let energy_terms = system
        .energy_terms()
        .iter()
        .map(|energy_term| energy_term.kind.name());
    for name in names.into_iter().chain(energy_terms) {
        if let Some(last) = result.column(name).and_then(<[f64]>::last) {
            ledger.insert(name.to_owned(), SummaryValue::new(*last, Kind::Energy, units));
        }
    }
    let yaw = super::yaw::summary(&case.truck, result, units);
    let summary = &mut result.summary;
    if let Some(yaw) = yaw.as_ref().filter(|yaw| yaw.is_missed()) {
        summary.warnings.push(yaw.warning());
    }
    summary.yaw = yaw;
    let jams = wedges.iter().filter(|(_, wedge)| wedge.jammed > 0.0);
    let jams: Vec<String> = jams
        .map(|(number, wedge)| format!("{number} ({:.1} %)", 100.0 * wedge.jammed))
        .collect();
    if !jams.is_empty() {
        summary.warnings.push(format!(
            "jammed wedges, with the share of the output times: {}; no steady sliding exists there, and only the limit of \
             the files holds the normal force",
            jams.join(", ")
        ));
    }
    summary.rows = times.len();
    summary.wedges = wedges;
    summary.largest_displacements = largest;
    summary.ledger = ledger;
}

fn wedge(case: &TruckCase, result: &TruckResult, works: &Works, place: usize) -> WedgeSummary {
    use mechanics::connection::Law;
    use wedge::parameters::Damping;

    let (units, number) = (case.units, case.truck.connections[place]);
    let times = result.column("time").unwrap_or_default();
    let column = |what: &str| {
        let values = result.column(&format!("wedge_{number}_{what}"));
        values.unwrap_or_default()
    };
    let jammed = column("jammed");
    let normal = column("column_normal_force");
    let mut summary = WedgeSummary {
        jammed: jammed.iter().sum::<f64>() / jammed.len().max(1) as f64,
        largest_normal_force: normal
            .iter()
            .copied()
            .max_by(f64::total_cmp)
            .map(|most| SummaryValue::new(most, Kind::Force, units)),
        ..WedgeSummary::default()
    };
    let (Some(cycle), Law::Wedge(law)) = (cycle(case), &case.truck.model.connections[place].law) else {
        return summary;
    };
    let damping = if law.coil_in_bolster {
        Damping::Constant
    } else {
        Damping::Variable
    };
    let friction = column("column_friction");
    summary.energy_per_cycle = works
        .per_cycle(place)
        .filter(|_| result.summary.complete)
        .map(|energy| SummaryValue::new(energy, Kind::Energy, units));
    let (input, rate) = (
        result.column("input_vertical").unwrap_or_default(),
        result.column("input_vertical_rate").unwrap_or_default(),
    );
    let mut branches = [Vec::new(), Vec::new()];
    for (row, time) in times.iter().enumerate() {
        if let Some(up) = cycle.branch(damping, *time, input[row], rate[row]) {
            branches[usize::from(up)].push(row);
        }
    }
    let average =
        |rows: &[usize]| mean(friction, rows).map(|value| SummaryValue::new(value, Kind::Force, units));
    summary.down = average(&branches[0]);
    summary.up = average(&branches[1]);
    summary
}
