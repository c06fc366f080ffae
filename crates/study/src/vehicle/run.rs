//! Running a vehicle.

use std::collections::BTreeMap;

use ::car::ClimbLimits;
use integrate::Problem;
use mechanics::energy_balance::Entries;
use mechanics::output::Column;
use mechanics::system::{Observation, System};
use quantity::Kind;
use vehicle::{OnTrack, Vehicle, View};

use super::VehicleCase;
use super::parts::parts;
use super::summary::{SCHEMA, VehicleDerailed, VehicleSummary, VibrationSummary};
use crate::car::assumptions::{of_contacts, of_drive, of_rules, of_support, of_wheels};
use crate::car::figures::CarFigures;
use crate::car::limits::{self, LimitCheck, LimitSet};
use crate::car::peaks;
use crate::car::run::in_curve;
use crate::car::statistics::filtered::{filtered, look_ahead, with_filtered};
use crate::car::statistics::{Histories, Parts, SIDES, Statistic, Statistics};
use crate::energy;
use crate::metrics::Extremes;
use crate::models::ModelCase;
use crate::output_files::OutputFiles;
use crate::progress;
use crate::reader::CaseText;
use crate::result::RunResult;
use crate::run::{
    Beginning, Recorder, Row, RowTable, Run, RunCase, RunError, RunSettings, SavedRows, findings,
};
use crate::summary::{Stopped, SummaryValue};

/// The result of a run.
pub type VehicleResult = RunResult<VehicleSummary>;

/// The columns of the energy ledger, after the channels.
const LEDGER: [(&str, &str); 4] = [
    (
        "work",
        "work of prescribed motions, loads and drives since the start",
    ),
    ("losses", "lost since the start"),
    ("stored_energy_change", "energy stored since the start"),
    ("energy_residual", "work less losses less stored energy"),
];

/// Records a vehicle's run.
#[derive(Debug)]
pub struct VehicleRecorder {
    vehicle: Vehicle,
    /// What statistics are taken of, and what its flanges climb at; none without a track.
    of_track: Option<(Parts, ClimbLimits)>,
    rows: RowTable,
    /// The same rows and those after them that filtered values depend on, where the run has looked ahead.
    ahead: Option<RowTable>,
    rates: Vec<f64>,
    /// The values of the channels at the start.
    start: Vec<f64>,
    /// Time (s), distance (m) and words of a wheel that left its rail.
    derailed: Option<(f64, f64, String)>,
    /// Kinetic energy at the start, J.
    kinetic_at_start: f64,
}

impl VehicleRecorder {
    fn new(case: &VehicleCase, vehicle: Vehicle) -> Self {
        let on = case.description.on_track.as_ref();
        let of_track = on.map(|on| {
            let climb = on.climb_limits();
            (parts(&case.description, on, &vehicle.static_loads), climb)
        });
        let need = |name: &str| of_track.as_ref().is_some_and(|(parts, _)| parts.need(name));
        let mut own = Self {
            rows: RowTable::new(&columns_of(&vehicle), need),
            ahead: None,
            of_track,
            rates: vec![0.0; vehicle.initial_state.len()],
            start: Vec::new(),
            kinetic_at_start: 0.0,
            derailed: None,
            vehicle,
        };
        let (mut system, x) = (own.vehicle.system.clone(), own.vehicle.initial_state.clone());
        own.kinetic_at_start = own.read(&mut system, 0.0, &x).energies.kinetic;
        own.start = own.rows.row()[1..].to_vec();
        own
    }

    /// Begins a row with time and channels; returns the observation.
    fn read(&mut self, system: &mut System, time: f64, x: &[f64]) -> Observation {
        let seen = system.observe(time, x);
        system.derivative(time, x, &mut self.rates);
        let view = View {
            seen: &seen,
            rates: &self.rates,
            system,
        };
        let row = self.rows.begin_row();
        row.push(time);
        for channels in &self.vehicle.channels {
            channels.read(&view, row);
        }
        seen
    }
}

/// Returns the columns of a vehicle's run: time, its channels, the energy ledger.
fn columns_of(vehicle: &Vehicle) -> Vec<Column> {
    let plain = |name: &str, kind: Kind, text: &str| Column::new(name, kind, "", text);
    let mut columns = vec![plain("time", Kind::Time, "time")];
    columns.extend(vehicle.columns().cloned());
    columns.extend(LEDGER.map(|(name, text)| plain(name, Kind::Energy, text)));
    columns
}

impl VehicleCase {
    /// Returns the vehicle at its start.
    ///
    /// # Errors
    /// Bodies and elements make no system, or there is no rest to start from.
    pub fn vehicle(&self) -> Result<Vehicle, RunError> {
        Ok(Vehicle::new(&self.description)?)
    }
}

impl RunCase for VehicleCase {
    type Recorder = VehicleRecorder;
    type Output = VehicleResult;

    const WHERE_TO_LOOK: &'static str =
        "look for values that are out of proportion; `wedgelab case` has vehicles that run";
    const WHAT_TO_TRY: &'static str = progress::WHAT_TO_TRY;

    fn settings(&self) -> RunSettings<'_> {
        let longest = self
            .description
            .on_track
            .as_ref()
            .map_or(f64::INFINITY, OnTrack::longest_step);
        RunSettings::of(&self.name, &self.simulation).with_steps_of(longest)
    }

    fn begin(&self) -> Result<Beginning<VehicleRecorder>, RunError> {
        let vehicle = self.vehicle()?;
        Ok(Beginning {
            system: vehicle.system.clone(),
            x: vehicle.initial_state.clone(),
            start_warning: vehicle.start_warning.clone(),
            recorder: VehicleRecorder::new(self, vehicle),
        })
    }

    fn look_ahead(&self) -> f64 {
        let rules = self.description.on_track.as_ref().map(|_| &self.rules);
        rules.map_or(0.0, |rules| look_ahead(rules, self.simulation.output_interval))
    }

    fn output(run: Run<Self>, stopped: Option<Stopped>) -> VehicleResult {
        output(run, stopped)
    }
}

impl ModelCase for VehicleCase {
    type Summary = VehicleSummary;

    fn columns(&self) -> Result<Vec<Column>, RunError> {
        let vehicle = self.vehicle()?;
        let raw = columns_of(&vehicle);
        Ok(match &self.description.on_track {
            Some(on) => {
                let parts = parts(&self.description, on, &vehicle.static_loads);
                with_filtered(&raw, &parts, &self.rules)
            }
            None => raw,
        })
    }

    fn output_files(&self) -> OutputFiles {
        self.output_files.clone()
    }

    fn text(&self) -> Option<&CaseText> {
        Some(&self.text)
    }
}

impl Recorder for VehicleRecorder {
    type Counts = SavedRows;

    fn counts(&self) -> SavedRows {
        self.rows.saved()
    }

    fn restore(&mut self, rows: SavedRows, _time: f64, times: &[f64]) -> Result<(), RunError> {
        self.rows.restore(rows, times)
    }

    fn see_ahead(&mut self, ahead: Self) {
        self.ahead = Some(ahead.rows);
    }

    fn row(&mut self, system: &mut System, row: &Row<'_>) -> Result<Entries, RunError> {
        let seen = self.read(system, row.time, row.x);
        let mut entries = system.ledger_entries(&seen, row.start_energy);
        entries.exchanged = seen.energies.kinetic - self.kinetic_at_start;
        let own = &entries;
        let values = [own.work, own.losses, own.stored_change, own.residual];
        self.rows.row().extend(values);
        self.rows.append(row.time)?;
        let mut axles = self.vehicle.axles.iter();
        if let Some((at, what)) = axles.find_map(|axle| axle.left_rail(&seen)) {
            self.derailed = Some((row.time, at, what.clone()));
            return Err(RunError::Derailed { what });
        }
        Ok(entries)
    }

    fn has_derailed(&self) -> bool {
        self.derailed.is_some()
    }
}

fn output(mut run: Run<VehicleCase>, stopped: Option<Stopped>) -> VehicleResult {
    let units = run.case.simulation.output_units;
    let table = std::mem::take(&mut run.recorder.rows);
    let mut ended = run.ended(stopped, &table, energy::WHAT_TO_DO);
    let ledger = run.last_ledger(&mut ended);
    let mut warnings = ended.warnings;
    warnings.extend(run.case.doubts.iter().cloned());
    warnings.extend(match run.case.description.on_track {
        Some(_) => findings::warnings_of_rolling(&run),
        None => findings::warnings_by_kind(&run),
    });
    let derailed = run
        .recorder
        .derailed
        .take()
        .map(|(time, at, what)| VehicleDerailed {
            time,
            distance: SummaryValue::new(at, Kind::Distance, units),
            what,
        });
    let reached = run.recorder.vehicle.axles.first().map(|axle| {
        let seen = run.system.observe(run.integrator.time(), run.integrator.x());
        SummaryValue::new(axle.state(&seen).distance, Kind::Distance, units)
    });
    let vibrations = run.recorder.vehicle.vibrations();
    if vibrations.is_err() {
        warnings.push("there are no natural vibrations: the rest cannot be linearized".to_owned());
    }
    let vibrations = vibrations.unwrap_or_default();
    let mut forces_at_start = BTreeMap::new();
    for (column, value) in table.columns()[1..].iter().zip(&run.recorder.start) {
        if column.kind == Kind::Force {
            let value = SummaryValue::new(*value, column.kind, units);
            forces_at_start.insert(column.name.clone(), value);
        }
    }
    let mut extremes = table.summary_extremes(units);
    let taken = statistics_of(&run, &table);
    warnings.extend(taken.warnings);
    for (column, values) in &taken.filtered {
        let own = Extremes::of(table.column("time"), values);
        extremes.extend(own.map(|own| own.named(column, units)));
    }
    let summary = VehicleSummary {
        schema: SCHEMA.to_owned(),
        program: ended.program,
        name: run.case.name.clone(),
        title: run.case.title.clone(),
        units,
        complete: ended.complete,
        stopped: ended.stopped,
        derailed,
        failed: ended.failed,
        warnings,
        rows: ended.rows,
        vibrations: vibrations.into_iter().map(VibrationSummary::of).collect(),
        forces_at_start,
        reached,
        speed: taken.speed,
        static_loads: taken.static_loads,
        statistics: taken.statistics,
        limits_of: taken.limits_of,
        limits: taken.limits,
        extremes,
        ledger,
        method: run.case.simulation.method.to_string(),
        relative_tolerance: run.case.simulation.relative_tolerance,
        solver: ended.statistics,
        assumptions: assumptions(&run.case),
    };
    let before = table.before();
    let mut result = table.into_result(summary);
    for (column, mut values) in taken.filtered {
        result.columns.push(column);
        result.values.push(values.split_off(before));
    }
    result
}

/// What rules ask of a run on a track.
#[derive(Default)]
struct Taken {
    statistics: BTreeMap<String, Statistic>,
    limits_of: String,
    limits: Vec<LimitCheck>,
    static_loads: BTreeMap<String, SummaryValue>,
    speed: Option<[SummaryValue; 2]>,
    /// Filtered columns.
    filtered: Vec<(Column, Vec<f64>)>,
    warnings: Vec<String>,
}

fn statistics_of(run: &Run<VehicleCase>, table: &RowTable) -> Taken {
    let (case, units) = (&run.case, run.case.simulation.output_units);
    let (Some(on), Some((parts, climb))) = (&case.description.on_track, &run.recorder.of_track) else {
        return Taken::default();
    };
    let long = run.recorder.ahead.as_ref().unwrap_or(table);
    let time = table.column("time");
    let histories = Histories {
        column: &|name| long.column(name),
        rows: time.len(),
        interval: case.simulation.output_interval,
        begin: case.settle,
        parts,
        climb: Some(climb),
        in_curve: &|distance| in_curve(&on.track.center_line, distance),
    };
    let mut own = Statistics::of(&histories, &case.rules, units);
    let method = case.simulation.method;
    peaks::remark(&mut own.values, method);
    let mut warnings = own.remarks.clone();
    warnings.extend(peaks::warning(table, parts, (method, units)));
    let loads = &run.recorder.vehicle.static_loads;
    if loads.is_empty() {
        let text = "there are no static loads of wheels: the vehicle has no rest on straight track, or it \
                    starts in its nominal layout without one; statistics in parts of them are left out";
        warnings.push(text.to_owned());
    }
    let figures = CarFigures::with(loads, Some(climb));
    let set = case.limits.as_deref().or(LimitSet::built_in().first());
    let of_wheels = parts.axles.iter().flat_map(|own| {
        let sides = SIDES.into_iter().zip(own.loads);
        sides.map(|(side, load)| {
            let load = SummaryValue::new(load, Kind::Force, units);
            (format!("{}_{side}", own.name), load)
        })
    });
    let speeds = table.column(&parts.speed);
    let ends = [speeds.first(), speeds.last()].map(|own| own.copied());
    Taken {
        limits_of: set.map_or_else(String::new, LimitSet::title_with_source),
        limits: set.map_or_else(Vec::new, |set| {
            limits::of(set, (&figures, &own.values), (&case.rules, units))
        }),
        static_loads: of_wheels.filter(|_| !loads.is_empty()).collect(),
        speed: match ends {
            [Some(first), Some(last)] => {
                Some([first, last].map(|own| SummaryValue::new(own, Kind::TravelSpeed, units)))
            }
            _ => None,
        },
        filtered: filtered(&own, (parts, &case.rules), table.columns(), time.len()),
        statistics: own.values,
        warnings,
    }
}

/// Returns the assumptions of a vehicle's numbers.
fn assumptions(case: &VehicleCase) -> Vec<String> {
    let description = &case.description;
    let mut words = vec![
        "Bodies are rigid; all that gives way is an element of the case.".to_owned(),
        "Angles are those of R = Ry(pitch) Rz(yaw) Rx(roll); rates of angles are angular velocities about \
         the fixed axes."
            .to_owned(),
    ];
    words.push(match description.start {
        vehicle::StartKind::Equilibrium => {
            "The run starts at rest with motions and loads held as at time zero, wedges and dry friction \
             without friction: what friction would hold depends on how the rest was reached."
                .to_owned()
        }
        vehicle::StartKind::Nominal => "The run starts in the nominal layout.".to_owned(),
    });
    if let Some(on) = &description.on_track {
        of_wheels(&case.text, &on.wheels, &mut words);
        if let Some(geometry) = on.wheels.geometry.first() {
            words.push(of_contacts(&on.wheels.laws, on.wheels.tables, geometry));
        }
        let sprung = "Each wheel has a piece of rail of its own on springs";
        words.push(of_support(on.support.as_ref(), sprung, description.gravity));
        let driven = description.bodies.get(on.driven.0 - 1);
        let driven = driven.map_or("the vehicle", |own| own.name.as_str());
        words.push(of_drive(&on.drive, &driven.replace('_', " ")));
        words.push(format!(
            "Statistics begin at {} s (start.settle); static loads are those of the rest on straight track.",
            case.settle
        ));
        words.push(of_rules(&case.rules));
    }
    if description.bodies.iter().any(|own| own.free.contains(&true)) {
        words.push(
            "Natural vibrations are those of the equations linearized about the rest, or about the nominal \
             layout if the run starts there: what is open or has clearance there does not count."
                .to_owned(),
        );
    }
    words
}
