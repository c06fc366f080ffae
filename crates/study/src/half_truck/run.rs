//! Running a half-truck.

use std::collections::BTreeMap;
use std::ops::ControlFlow;

use integrate::{Integrator, Options};
use mechanics::body::COORDINATES;
use mechanics::connection::Law;
use mechanics::energy_balance::Entries;
use mechanics::motion::Motion;
use mechanics::output::Column;
use mechanics::system::{AtRest, ContactState, NoEquilibrium, StaticFriction, System};
use quantity::Kind;
use serde::{Deserialize, Serialize};
use wedge::outputs::CORNERS;
use wedge::parameters::Damping;

use super::columns::{Columns, input_motion, ledger_name};
use super::wedge_seen::friction_loss;
use super::yaw::YawSummary;
use super::{HalfTruckCase, HalfTruckResult, HalfTruckStart, HalfTruckSummary, SCHEMA, WedgeSummary};
use crate::contacts::{ContactTable, TakesCorners};
use crate::energy;
use crate::finite::{find, is_finite, residual_not_finite};
use crate::metrics::{Cycle, mean, window_of};
use crate::models::ModelCase;
use crate::progress;
use crate::run::{
    Beginning, Recorder, Row, RowTable, Run, RunCase, RunError, RunSettings, SavedRows, findings,
};
use crate::run_error::{check_finite, check_length, damaged};
use crate::summary::{Stopped, SummaryValue};

/// Returns the state at the start.
///
/// # Errors
/// There is no equilibrium.
pub fn start(system: &mut System, start: HalfTruckStart) -> Result<AtRest, NoEquilibrium> {
    let drawn = system.initial_state();
    match start {
        HalfTruckStart::Drawn => Ok(AtRest {
            state: drawn,
            warning: None,
        }),
        HalfTruckStart::Equilibrium => system.start_at_rest(0.0, &drawn, StaticFriction::Without),
    }
}

/// Runs a half-truck to its end. Returns the results; a run that cannot go on has incomplete results with the
/// reason.
///
/// # Errors
/// The run cannot begin.
pub fn run(case: &HalfTruckCase, progress: impl FnMut(f64)) -> Result<HalfTruckResult, RunError> {
    Ok(Run::new(case)?.finish(progress))
}

/// As [`run`], but asks after each step, with the time reached, whether to go on. If not, the answer says
/// why, and the result is incomplete for that reason.
///
/// # Errors
/// The run cannot begin.
pub fn run_while(
    case: &HalfTruckCase,
    progress: impl FnMut(f64) -> ControlFlow<String>,
) -> Result<HalfTruckResult, RunError> {
    Ok(Run::new(case)?.finish_while(progress))
}

/// Records a half-truck's run: its table, and the work of its wedges' friction.
pub struct HalfTruckRecorder {
    table: Columns,
    rows: RowTable,
    works: Works,
    /// The corners of wedges' bodies, by their names.
    points: Vec<String>,
    /// The connections that have contact states, by their numbers in the files.
    frictional: Vec<u32>,
    numbers: [Vec<u32>; 2],
    /// The corners of wedges' bodies, where they are asked for.
    contacts: Option<ContactTable>,
    /// The numbers of these bodies.
    wedges: std::ops::Range<usize>,
}

impl RunCase for HalfTruckCase {
    type Recorder = HalfTruckRecorder;
    type Output = HalfTruckResult;

    const WHERE_TO_LOOK: &'static str =
        "look for values that are out of proportion; `wedgelab nucars show` prints them as tables";
    const WHAT_TO_TRY: &'static str = progress::WHAT_TO_TRY_WITH_FILES;

    fn settings(&self) -> RunSettings<'_> {
        RunSettings {
            name: &self.name,
            duration: self.duration,
            interval: self.interval,
            units: self.units,
            options: Options {
                relative_tolerance: self.relative_tolerance,
                ..Options::default()
            },
        }
    }

    fn begin(&self) -> Result<Beginning<HalfTruckRecorder>, RunError> {
        let mut system = System::new(self.truck.model.clone())?;
        let AtRest {
            state: x,
            warning: start_warning,
        } = match self.start {
            HalfTruckStart::Equilibrium if !self.wedge_bodies.is_empty() => self.rest()?,
            other => start(&mut system, other)?,
        };
        let table = Columns::new(self, &system);
        let frictional = system.frictional_connections().iter();
        let faces = system.faces().iter().map(|face| &face.element);
        let points = faces.flat_map(|face| {
            let corners = 0..face.points.len();
            corners.map(|corner| match CORNERS.get(corner) {
                Some(corner) => format!("{}_{corner}", face.name),
                None => format!("{}_{}", face.name, corner + 1),
            })
        });
        Ok(Beginning {
            recorder: HalfTruckRecorder {
                rows: RowTable::new(table.columns(), |_| true),
                works: Works::new(self, &system),
                points: points.collect(),
                frictional: frictional.map(|place| self.truck.connections[*place]).collect(),
                numbers: [self.truck.bodies.clone(), self.truck.connections.clone()],
                contacts: None,
                wedges: self.truck.bodies.len()..self.truck.model.bodies.len(),
                table,
            },
            system,
            x,
            start_warning,
        })
    }

    fn output(run: Run<Self>, stopped: Option<Stopped>) -> HalfTruckResult {
        output(run, stopped)
    }
}

impl ModelCase for HalfTruckCase {
    type Summary = HalfTruckSummary;

    fn columns(&self) -> Result<Vec<Column>, RunError> {
        let beginning = self.begin()?;
        Ok(Columns::new(self, &beginning.system).columns().to_vec())
    }
}

impl HalfTruckCase {
    /// Returns the state of rest without friction, also on the faces of wedges' bodies; with it the bristles,
    /// which are not deflected there, hold nothing.
    fn rest(&self) -> Result<AtRest, RunError> {
        let mut model = self.truck.model.clone();
        for (.., face) in &mut model.faces {
            face.coefficient = 0.0;
        }
        Ok(start(&mut System::new(model)?, HalfTruckStart::Equilibrium)?)
    }
}

impl Recorder for HalfTruckRecorder {
    type Counts = HalfTruckCounts;

    fn counts(&self) -> HalfTruckCounts {
        HalfTruckCounts {
            table: self.rows.saved(),
            ..self.works.counts.clone()
        }
    }

    fn restore(&mut self, mut counts: HalfTruckCounts, time: f64, times: &[f64]) -> Result<(), RunError> {
        check_length("counts.works", counts.works.len(), self.works.wedges.len())?;
        counts
            .works
            .iter()
            .try_for_each(|work| check_finite("counts.works", *work))?;
        // Steps end at the time reached.
        if counts.reached.to_bits() != time.to_bits() {
            return damaged("counts.reached", counts.reached, format!("the time, {time} s"));
        }
        self.rows.restore(std::mem::take(&mut counts.table), times)?;
        self.works.counts = counts;
        Ok(())
    }

    fn step(&mut self, integrator: &Integrator<System>, system: &mut System, x: &mut [f64]) {
        self.works.add_step(integrator, system, x);
    }

    fn row(&mut self, system: &mut System, row: &Row<'_>) -> Result<Entries, RunError> {
        let seen = system.observe(row.time, row.x);
        self.table
            .read_since(row.start_energy, &seen, self.rows.begin_row());
        self.rows.append(row.time)?;
        if let Some(contacts) = &mut self.contacts {
            contacts.take(&seen, row.contact_states);
        }
        Ok(system.ledger_entries(&seen, row.start_energy))
    }

    fn contacts(&self, _: &System, contact_states: &[u8]) -> BTreeMap<String, String> {
        let (points, others) = contact_states.split_at(self.points.len().min(contact_states.len()));
        let words = |state: &u8| ContactState::from_number(*state).name().to_owned();
        let points = self.points.iter().cloned().zip(points.iter().map(words));
        let others = self.frictional.iter().zip(others.iter().map(words));
        let others = others.map(|(number, state)| (format!("connection_{number}"), state));
        points.chain(others).collect()
    }

    fn numbers(&self) -> [&[u32]; 2] {
        [&self.numbers[0], &self.numbers[1]]
    }
}

impl TakesCorners for HalfTruckRecorder {
    fn wedges(&self) -> Vec<usize> {
        self.wedges.clone().collect()
    }

    fn corners(&mut self) -> &mut Option<ContactTable> {
        &mut self.contacts
    }
}

fn output(mut run: Run<HalfTruckCase>, stopped: Option<Stopped>) -> HalfTruckResult {
    let table = std::mem::take(&mut run.recorder.rows);
    let mut ended = run.ended(stopped, &table, energy::WHAT_TO_DO_WITH_FILES);
    let (case, works, balance) = (&run.case, &run.recorder.works, &run.energy_balance);
    let joules = |value| SummaryValue::new(value, Kind::Energy, case.units);
    let mut wedges = BTreeMap::new();
    for place in case.wedges() {
        let mut own = wedge(case, &table, place);
        if ended.stopped.is_none() {
            own.add_work(case, works.per_cycle(place));
        }
        wedges.insert(case.truck.connections[place].to_string(), own);
    }
    let largest_displacements = largest_displacements(case, &table);
    let ledger = ledger(case, &run.system, &table);
    run.stop(&mut ended, not_finite(&wedges, &largest_displacements, &ledger));
    run.stop(&mut ended, residual_not_finite(balance.relative_residual()));
    let mut warnings = ended.warnings;
    warnings.extend(findings::warnings(&run));
    let yaw = super::yaw::summary(&case.truck, &table, case.units);
    warnings.extend(yaw.iter().filter(|yaw| yaw.is_missed()).map(YawSummary::warning));
    warnings.extend(jammed(&wedges));
    let summary = HalfTruckSummary {
        schema: SCHEMA.to_owned(),
        program: ended.program,
        name: case.name.clone(),
        title: case.title.clone(),
        units: case.units,
        complete: ended.complete,
        stopped: ended.stopped,
        failed: ended.failed,
        warnings,
        rows: ended.rows,
        yaw,
        wedges,
        largest_displacements,
        ledger,
        largest_stored_change: joules(balance.largest_stored_change),
        largest_residual: joules(balance.largest_residual),
        largest_residual_time: balance.largest_residual_time,
        admissible_residual: Some(joules(balance.admissible)),
        largest_relative_residual: balance.relative_residual(),
        statistics: ended.statistics,
        relative_tolerance: case.relative_tolerance,
        assumptions: case.assumptions.clone(),
    };
    table.into_result(summary)
}

/// Returns the first of these numbers that is not finite, in words.
fn not_finite(
    wedges: &BTreeMap<String, WedgeSummary>,
    displacements: &BTreeMap<String, SummaryValue>,
    ledger: &BTreeMap<String, SummaryValue>,
) -> Option<String> {
    let wedge = |wedge: &WedgeSummary| {
        let measures = [
            &wedge.energy_per_cycle,
            &wedge.equivalent_damping,
            &wedge.up,
            &wedge.down,
            &wedge.largest_normal_force,
        ];
        measures
            .into_iter()
            .flatten()
            .any(|measure| !is_finite(measure.value))
    };
    let wedges = wedges.iter().find(|(_, found)| wedge(found));
    let wedges = wedges.map(|(number, _)| format!("an average of wedge {number}"));
    let others = find(displacements).or_else(|| find(ledger));
    wedges.or(others.map(|name| format!("`{name}`")))
}

/// Returns the cycle of the vertical input, if it is one sine.
pub(crate) fn cycle(case: &HalfTruckCase) -> Option<Cycle> {
    match input_motion(&case.truck.model)? {
        Motion::Sine {
            amplitude,
            angular_frequency,
            ..
        } => Some(Cycle::sine(*amplitude, *angular_frequency)),
        _ => None,
    }
}

/// The work of each wedge's friction at the column over whole cycles, taken step by step from the dense
/// output (of massless ones by Simpson's rule: the input springs ring, which rows would miss; of bodies from
/// the ledger's loss).
struct Works {
    window: Option<(f64, f64, u32)>,
    wedges: Vec<usize>,
    /// Of a wedge's body the loss of its column among the quadratures.
    losses: Vec<Option<usize>>,
    counts: HalfTruckCounts,
    powers: [Vec<f64>; 3],
}

/// The counts along a half-truck's run.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct HalfTruckCounts {
    /// Work of each wedge's friction at the column in the averaging window, J.
    pub works: Vec<f64>,
    /// Until when it is taken, s.
    pub reached: f64,
    /// The rows, as far as the summary needs them: all.
    pub table: SavedRows,
}

impl Works {
    fn new(case: &HalfTruckCase, system: &System) -> Self {
        let wedges = case.wedges();
        let loss = |place: &usize| friction_loss(system, case.wedge_body(*place)?.faces[0]);
        let none = vec![0.0; wedges.len()];
        Self {
            window: cycle(case).and_then(|cycle| cycle.window(case.duration)),
            powers: [none.clone(), none.clone(), none.clone()],
            counts: HalfTruckCounts {
                works: none,
                ..HalfTruckCounts::default()
            },
            losses: wedges.iter().map(loss).collect(),
            wedges,
        }
    }

    /// Adds the part of the last step that lies in the window.
    fn add_step(&mut self, integrator: &Integrator<System>, system: &mut System, buffer: &mut [f64]) {
        let (from, to) = (self.counts.reached, integrator.time());
        self.counts.reached = to;
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
        if self.losses.iter().any(Option::is_some) {
            for (time, sign) in [(from, -1.0), (to, 1.0)] {
                integrator.interpolate_range(time, 0, buffer);
                let [_, _, _, quadratures] = system.layout().split(buffer);
                for (loss, work) in self.losses.iter().zip(&mut self.counts.works) {
                    *work += loss.map_or(0.0, |loss| sign * quadratures[loss]);
                }
            }
        }
        let [a, b, c] = &self.powers;
        for (index, work) in self.counts.works.iter_mut().enumerate() {
            *work += (to - from) / 6.0 * (a[index] + 4.0 * b[index] + c[index]);
        }
    }

    fn per_cycle(&self, place: usize) -> Option<f64> {
        let (_, _, cycles) = self.window?;
        let index = self.wedges.iter().position(|own| *own == place)?;
        Some(self.counts.works[index] / f64::from(cycles))
    }
}

/// Returns the largest displacements of the free bodies, without sign.
fn largest_displacements(case: &HalfTruckCase, table: &RowTable) -> BTreeMap<String, SummaryValue> {
    let mut largest = BTreeMap::new();
    let bodies = case.truck.bodies.iter().enumerate();
    let bodies = bodies.map(|(place, number)| (place, format!("body_{number}")));
    let own = case.wedge_bodies.iter();
    let own = own.map(|wedge| {
        (
            wedge.body,
            format!("wedge_{}", case.truck.connections[wedge.connection]),
        )
    });
    for (place, body) in bodies.chain(own) {
        let free = &case.truck.model.bodies[place].free;
        for (coordinate, name) in COORDINATES.iter().enumerate().filter(|(k, _)| free[*k]) {
            let column = format!("{body}_{name}");
            let values = table.column(&column);
            if values.is_empty() {
                continue;
            }
            let most = values.iter().fold(0.0, |most: f64, value| most.max(value.abs()));
            let kind = if coordinate < 3 { Kind::Length } else { Kind::Angle };
            largest.insert(column, SummaryValue::new(most, kind, case.units));
        }
    }
    largest
}

/// Returns the entries of the energy ledger at the end.
fn ledger(case: &HalfTruckCase, system: &System, table: &RowTable) -> BTreeMap<String, SummaryValue> {
    let mut ledger = BTreeMap::new();
    let names = [
        "kinetic_energy",
        "gravity_energy",
        "spring_energy",
        "coil_energy",
        "accumulator_energy",
        "contact_energy",
        "element_energy",
        "ledger_residual",
    ];
    let energy_terms = system
        .energy_terms()
        .iter()
        .map(|energy_term| ledger_name(energy_term.kind));
    for name in names.into_iter().chain(energy_terms) {
        if let Some(last) = table.column(name).last() {
            let last = SummaryValue::new(*last, Kind::Energy, case.units);
            ledger.insert(name.to_owned(), last);
        }
    }
    ledger
}

/// Returns the warning about wedges that jam.
fn jammed(wedges: &BTreeMap<String, WedgeSummary>) -> Option<String> {
    let jams = wedges.iter().filter(|(_, wedge)| wedge.jammed > 0.0);
    let jams: Vec<String> = jams
        .map(|(number, wedge)| format!("{number} ({:.1} %)", 100.0 * wedge.jammed))
        .collect();
    (!jams.is_empty()).then(|| {
        format!(
            "jammed wedges, with the share of the output times: {}; no steady sliding exists there, and \
             only the limit of the files holds the normal force",
            jams.join(", ")
        )
    })
}

/// Returns the averages of a wedge; all but those of the work of its friction.
fn wedge(case: &HalfTruckCase, table: &RowTable, place: usize) -> WedgeSummary {
    let (units, number) = (case.units, case.truck.connections[place]);
    let times = table.column("time");
    let column = |what: &str| table.column(&format!("wedge_{number}_{what}"));
    let jammed = column("jammed");
    let normal = column("column_normal_force");
    let mut summary = WedgeSummary {
        // The sum of nothing is minus zero.
        jammed: jammed.iter().sum::<f64>() / jammed.len().max(1) as f64 + 0.0,
        largest_normal_force: normal
            .iter()
            .copied()
            .max_by(f64::total_cmp)
            .map(|most| SummaryValue::new(most, Kind::Force, units)),
        ..WedgeSummary::default()
    };
    let damping = match (case.wedge_body(place), &case.truck.model.connections[place].law) {
        (Some(wedge), _) => wedge.damping,
        (None, Law::Wedge(law)) if law.coil_in_bolster => Damping::Constant,
        _ => Damping::Variable,
    };
    let Some(cycle) = cycle(case) else {
        return summary;
    };
    let friction = column("column_friction");
    let (input, rate) = (
        table.column("input_vertical"),
        table.column("input_vertical_rate"),
    );
    summary.window = window_of(damping).to_owned();
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

impl WedgeSummary {
    /// Adds the work of its friction in a cycle, J, if there are whole cycles.
    fn add_work(&mut self, case: &HalfTruckCase, work: Option<f64>) {
        let value = |value, kind| SummaryValue::new(value, kind, case.units);
        if let (Some(work), Some(cycle)) = (work, cycle(case)) {
            self.energy_per_cycle = Some(value(work, Kind::Energy));
            self.equivalent_damping = Some(value(cycle.equivalent_damping(work), Kind::Damping));
        }
    }
}
