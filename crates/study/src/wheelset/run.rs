//! Running a wheelset.
//!
//! At each output time the seats of the wheels are checked. A wheel on the tip of its flange, on the edge of
//! its rim or off its rail has derailed: the run ends there, and this is its result.

use integrate::Options;
use mechanics::energy_balance::Entries;
use mechanics::output::Column;
use mechanics::system::System;
use quantity::{Kind, SixDigits};
use rolling::rig::Rig;
use wheelrail::loaded::Seat;

use super::WheelsetCase;
use super::columns::{RigReader, SIDES, columns};
use super::stability;
use super::summary::{Derailment, SCHEMA, WheelsetSummary};
use crate::models::ModelCase;
use crate::output_files::{OutputFiles, TableFormat};
use crate::result::RunResult;
use crate::run::{
    Beginning, Recorder, Row, RowTable, Run, RunCase, RunError, RunSettings, SavedRows, findings,
};
use crate::summary::{Stopped, SummaryValue};

/// The result of a run.
pub type WheelsetResult = RunResult<WheelsetSummary>;

/// Advice on a ledger that does not close.
const LOWER_THE_TOLERANCE: &str = "lower the relative tolerance";

/// A derailed wheel: its number, where it stands, time (s), distance (m).
#[derive(Clone, Copy, Debug)]
struct Derailed {
    wheel: usize,
    seat: Seat,
    time: f64,
    distance: f64,
}

/// Records a wheelset's run: its table, and where it derails.
pub struct WheelsetRecorder {
    reader: RigReader,
    rows: RowTable,
    derailed: Option<Derailed>,
}

impl RunCase for WheelsetCase {
    type Recorder = WheelsetRecorder;
    type Output = WheelsetResult;

    const WHERE_TO_LOOK: &'static str = "look at speed, load and springs";
    const WHAT_TO_TRY: &'static str = "try a lower relative tolerance, sprung rails, or softer springs";

    fn settings(&self) -> RunSettings<'_> {
        RunSettings {
            name: &self.wheelset.name,
            duration: self.duration,
            interval: self.wheelset.interval,
            units: self.wheelset.units,
            options: Options {
                relative_tolerance: self.wheelset.relative_tolerance,
                maximum_step: self.wheelset.longest_step(),
                ..Options::default()
            },
        }
    }

    fn begin(&self) -> Result<Beginning<WheelsetRecorder>, RunError> {
        let rig = Rig::new(&self.setup, self.wheelset.start)?;
        Ok(Beginning {
            system: rig.system.clone(),
            x: rig.start.clone(),
            start_warning: None,
            recorder: WheelsetRecorder {
                rows: RowTable::new(&columns(), |_| false),
                reader: RigReader::new(rig, self.setup.clone(), self.wheelset.nominal_radius()),
                derailed: None,
            },
        })
    }

    fn output(run: Run<Self>, stopped: Option<Stopped>) -> WheelsetResult {
        output(run, stopped)
    }
}

impl ModelCase for WheelsetCase {
    type Summary = WheelsetSummary;

    fn columns(&self) -> Result<Vec<Column>, RunError> {
        Ok(columns())
    }

    fn output_files(&self) -> OutputFiles {
        OutputFiles {
            tables: vec![TableFormat::Csv],
            ..OutputFiles::default()
        }
    }
}

impl Recorder for WheelsetRecorder {
    type Counts = SavedRows;

    fn counts(&self) -> SavedRows {
        self.rows.saved()
    }

    fn restore(&mut self, rows: SavedRows, _time: f64, times: &[f64]) -> Result<(), RunError> {
        self.rows.restore(rows, times)
    }

    fn row(&mut self, system: &mut System, row: &Row<'_>) -> Result<Entries, RunError> {
        let seen = system.observe(row.time, row.x);
        let entries = system.ledger_entries(&seen, row.start_energy);
        self.reader.read(&seen, &entries, self.rows.begin_row());
        self.rows.append(row.time)?;
        let seats = self.reader.rig().seats(&seen);
        if let Some(wheel) = seats.iter().position(|seat| *seat != Seat::OnRail) {
            self.derailed = Some(Derailed {
                wheel,
                seat: seats[wheel],
                time: row.time,
                distance: self.rows.row()[1],
            });
            let what = format!("a wheel has derailed at {} s", SixDigits(row.time));
            return Err(RunError::Derailed { what });
        }
        Ok(entries)
    }

    fn has_derailed(&self) -> bool {
        self.derailed.is_some()
    }
}

fn output(mut run: Run<WheelsetCase>, stopped: Option<Stopped>) -> WheelsetResult {
    let units = run.case.wheelset.units;
    let table = std::mem::take(&mut run.recorder.rows);
    let derailment = run.recorder.derailed.map(|found| Derailment {
        wheel: SIDES[found.wheel].to_owned(),
        seat: found.seat.word().to_owned(),
        time: found.time,
        distance: SummaryValue::new(found.distance, Kind::Length, units),
    });
    let mut ended = run.ended(stopped, &table, LOWER_THE_TOLERANCE);
    let ledger = run.last_ledger(&mut ended);
    let mut warnings = ended.warnings;
    warnings.extend(findings::warnings_of_rolling(&run));
    warnings.extend(run.case.wheelset.track.doubts.iter().cloned());
    let mut extremes = table.summary_extremes(units);
    extremes.retain(|name, _| !name.contains("_patch_"));
    let summary = WheelsetSummary {
        schema: SCHEMA.to_owned(),
        program: ended.program,
        name: run.case.wheelset.name.clone(),
        units,
        given: run.case.wheelset.given.clone(),
        complete: ended.complete,
        derailment,
        stopped: ended.stopped,
        failed: ended.failed,
        warnings,
        rows: ended.rows,
        hunting: stability::hunting(&run.case.wheelset),
        extremes,
        ledger,
        relative_tolerance: run.case.wheelset.relative_tolerance,
        statistics: ended.statistics,
        assumptions: run.case.assumptions(),
    };
    table.into_result(summary)
}
