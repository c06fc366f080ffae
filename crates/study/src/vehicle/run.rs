//! Running a vehicle.

use std::collections::BTreeMap;

use integrate::Problem;
use mechanics::energy_balance::Entries;
use mechanics::output::Column;
use mechanics::system::{Observation, System};
use quantity::Kind;
use vehicle::{Vehicle, View};

use super::VehicleCase;
use super::summary::{SCHEMA, VehicleDerailed, VehicleSummary, VibrationSummary};
use crate::energy;
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
    rows: RowTable,
    rates: Vec<f64>,
    /// The values of the channels at the start.
    start: Vec<f64>,
    /// Time (s), distance (m) and words of a wheel that left its rail.
    derailed: Option<(f64, f64, String)>,
    /// Kinetic energy at the start, J.
    kinetic_at_start: f64,
}

impl VehicleRecorder {
    fn new(vehicle: Vehicle) -> Self {
        let mut own = Self {
            rows: RowTable::new(&columns_of(&vehicle), |_| false),
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
        RunSettings::of(&self.name, &self.simulation)
    }

    fn begin(&self) -> Result<Beginning<VehicleRecorder>, RunError> {
        let vehicle = self.vehicle()?;
        Ok(Beginning {
            system: vehicle.system.clone(),
            x: vehicle.initial_state.clone(),
            start_warning: vehicle.start_warning.clone(),
            recorder: VehicleRecorder::new(vehicle),
        })
    }

    fn output(run: Run<Self>, stopped: Option<Stopped>) -> VehicleResult {
        output(run, stopped)
    }
}

impl ModelCase for VehicleCase {
    type Summary = VehicleSummary;

    fn columns(&self) -> Result<Vec<Column>, RunError> {
        Ok(columns_of(&self.vehicle()?))
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
        extremes: table.summary_extremes(units),
        ledger,
        method: run.case.simulation.method.to_string(),
        relative_tolerance: run.case.simulation.relative_tolerance,
        statistics: ended.statistics,
        assumptions: assumptions(&run.case),
    };
    table.into_result(summary)
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
    if description.bodies.iter().any(|own| own.free.contains(&true)) {
        words.push(
            "Natural vibrations are those of the equations linearized about the rest, or about the nominal \
             layout if the run starts there: what is open or has clearance there does not count."
                .to_owned(),
        );
    }
    words
}
