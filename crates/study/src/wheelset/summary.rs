//! The summary of a wheelset's run.

use std::collections::BTreeMap;

use integrate::Statistics;
use quantity::{Kind, System as Units};
use serde::{Deserialize, Serialize};

use crate::metrics::Extremes;
use crate::outcome::RunEnd;
use crate::summary::{LedgerSummary, Stopped, SummaryValue, ledger, run_summary};

/// The schema's name and version.
pub const SCHEMA: &str = "wedgelab.wheelset/1";

/// The numbers of a run.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct WheelsetSummary {
    /// [`SCHEMA`].
    pub schema: String,
    /// Version of the program that wrote it.
    pub program: String,
    /// Name of the run.
    pub name: String,
    /// Units of the numbers.
    pub units: Units,
    /// The given values by name, in words.
    pub given: BTreeMap<String, String>,
    /// True if the run came to its end and its energy ledger closes to 1e-2.
    pub complete: bool,
    /// The derailment, if a wheel derailed: the run ends there.
    pub derailment: Option<Derailment>,
    /// Reason and time of the stop, if it could not go on.
    pub stopped: Option<Stopped>,
    /// The reason for not using its numbers, which are kept: its energy ledger does not close to 1e-2.
    pub failed: Option<String>,
    /// Warnings about the numbers; empty for a sound run.
    pub warnings: Vec<String>,
    /// Number of rows.
    pub rows: usize,
    /// The least damped vibration about steady rolling at this speed on straight perfect track.
    pub hunting: Option<Hunting>,
    /// Least and greatest values of all columns but those of patches, by their names with units.
    pub extremes: BTreeMap<String, Extremes>,
    /// The energy ledger at the end.
    pub ledger: LedgerSummary,
    /// Relative tolerance of the integrator.
    pub relative_tolerance: f64,
    /// Counters of the integrator.
    pub statistics: Statistics,
    /// The assumptions of the numbers.
    pub assumptions: Vec<String>,
}

run_summary!(
    WheelsetSummary,
    |own| ledger: ledger!(own.ledger, own.ledger.entries),
    solver: (own.statistics.steps, own.relative_tolerance),
    derailed: own.end_of_derailed(),
    reached: own.end_distance()
);

impl WheelsetSummary {
    fn end_of_derailed(&self) -> Option<RunEnd> {
        self.derailment.as_ref().map(|own| RunEnd {
            time: own.time,
            reason: own.words(),
            distance: Some(along_track(&own.distance)),
        })
    }

    /// Returns the distance along the track that was reached: a wheelset only rolls forward.
    fn end_distance(&self) -> Option<SummaryValue> {
        let unit = Kind::Length.label(self.units);
        let value = self.extremes.get(&format!("distance_{unit}"))?.maximum;
        Some(along_track(&SummaryValue {
            value,
            unit: unit.to_owned(),
        }))
    }
}

/// Returns a distance along the track, in feet instead of inches.
fn along_track(distance: &SummaryValue) -> SummaryValue {
    match distance.unit.as_str() {
        "in" => SummaryValue {
            value: distance.value / 12.0,
            unit: "ft".to_owned(),
        },
        _ => distance.clone(),
    }
}

/// A derailed wheel.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Derailment {
    /// The wheel: `left` or `right`.
    pub wheel: String,
    /// The part of the wheel on which it stands: `flange_tip`, `rim_edge` or `off_rail`.
    pub seat: String,
    /// The output time, s.
    pub time: f64,
    /// Distance along the track.
    pub distance: SummaryValue,
}

impl Derailment {
    /// Returns it in words.
    #[must_use]
    pub fn words(&self) -> String {
        let what = match self.seat.as_str() {
            "flange_tip" => "has climbed its rail and stands on the tip of its flange",
            "rim_edge" => "stands on the outer edge of its rim and is about to fall between the rails",
            _ => "is off its rail",
        };
        let SummaryValue { value, unit } = along_track(&self.distance);
        format!(
            "the {} wheel {what} at {value:.2} {unit} along the track, {:.4} s after the start",
            self.wheel, self.time
        )
    }
}

/// A vibration.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Hunting {
    /// Growth of its amplitude, 1/s: negative if it dies out.
    pub growth_per_s: f64,
    /// Frequency, Hz.
    pub frequency_hz: f64,
    /// Damping ratio: negative if it grows.
    pub damping_ratio: f64,
}

impl Hunting {
    /// Returns the vibration of an eigenvalue (1/s, rad/s).
    #[must_use]
    pub fn of([growth, frequency]: [f64; 2]) -> Self {
        Self {
            growth_per_s: growth,
            frequency_hz: frequency / (2.0 * std::f64::consts::PI),
            damping_ratio: -growth / libm::hypot(growth, frequency),
        }
    }
}
