//! The summary of a vehicle's run.

use std::collections::BTreeMap;
use std::f64::consts::PI;

use integrate::Statistics as Counters;
use quantity::System as Units;
use serde::de::Error;
use serde::{Deserialize, Deserializer, Serialize, Serializer};
use vehicle::Vibration;

use crate::car::limits::LimitCheck;
use crate::car::statistics::Statistic;
use crate::metrics::Extremes;
use crate::outcome::RunEnd;
use crate::summary::{ByRules, LedgerSummary, Stopped, SummaryValue, by_rules, ledger, run_summary};

/// The schema's name and version.
pub const SCHEMA: &str = "wedgelab.vehicle/1";

/// The numbers of a run.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(remote = "Self")]
pub struct VehicleSummary {
    /// [`SCHEMA`].
    pub schema: String,
    /// Version of the program that wrote it.
    pub program: String,
    /// The case's name.
    pub name: String,
    /// The case's title.
    pub title: String,
    /// Units of the numbers.
    pub units: Units,
    /// True if the run came to its end and its energy ledger closes to 1e-2.
    pub complete: bool,
    /// Reason and time of the stop, if it is incomplete.
    pub stopped: Option<Stopped>,
    /// The wheel that left its rail, if one did: the run ends there.
    #[serde(default)]
    pub derailed: Option<VehicleDerailed>,
    /// The reason for not using its numbers, which are kept: its energy ledger does not close to 1e-2.
    pub failed: Option<String>,
    /// Warnings about the numbers; empty for a sound run.
    pub warnings: Vec<String>,
    /// Number of rows.
    pub rows: usize,
    /// Natural vibrations about the rest, the slowest first.
    pub vibrations: Vec<VibrationSummary>,
    /// Forces of the elements at the start, by the names of their columns.
    pub forces_at_start: BTreeMap<String, SummaryValue>,
    /// Distance along the track of the first wheelset at the end, if it runs on one.
    #[serde(default)]
    pub reached: Option<SummaryValue>,
    /// Speed at the start and at the end, if it runs on a track.
    #[serde(default)]
    pub speed: Option<[SummaryValue; 2]>,
    /// Static load of each wheel on a track by its name: `leading_left`; none if there is no rest.
    #[serde(default)]
    pub static_loads: BTreeMap<String, SummaryValue>,
    /// Statistics of a vehicle on a track by name: see the table in docs/car.md.
    #[serde(default)]
    pub statistics: BTreeMap<String, Statistic>,
    /// The rule of the limits, its edition and source; empty without a track.
    #[serde(default)]
    pub limits_of: String,
    /// Limits of that rule beside the worst value of each.
    #[serde(default)]
    pub limits: Vec<LimitCheck>,
    /// Least and greatest values of all columns, by their names with units.
    pub extremes: BTreeMap<String, Extremes>,
    /// The energy ledger at the end; losses by element.
    pub ledger: LedgerSummary,
    /// The integration method.
    pub method: String,
    /// Its relative tolerance.
    pub relative_tolerance: f64,
    /// Counters of the integrator.
    pub solver: Counters,
    /// The assumptions of the numbers.
    pub assumptions: Vec<String>,
}

impl Serialize for VehicleSummary {
    fn serialize<S: Serializer>(&self, to: S) -> Result<S::Ok, S::Error> {
        Self::serialize(self, to)
    }
}

impl<'de> Deserialize<'de> for VehicleSummary {
    /// The counters of the solver were called `statistics` in earlier versions.
    fn deserialize<D: Deserializer<'de>>(from: D) -> Result<Self, D::Error> {
        let mut json = serde_json::Value::deserialize(from)?;
        if let Some(fields) = json.as_object_mut()
            && !fields.contains_key("solver")
            && let Some(counters) = fields.remove("statistics")
        {
            fields.insert("solver".to_owned(), counters);
        }
        Self::deserialize(json).map_err(D::Error::custom)
    }
}

run_summary!(
    VehicleSummary,
    |own| title: &own.title,
    ledger: ledger!(own.ledger, own.ledger.entries),
    solver: (own.solver.steps, own.relative_tolerance),
    derailed: own.derailed.as_ref().map(|own| RunEnd {
        time: own.time,
        reason: own.what.clone(),
        distance: Some(own.distance.clone()),
    }),
    reached: own.reached.clone(),
    {
        fn by_rules(&self) -> Option<ByRules<'_>> {
            (!self.limits_of.is_empty()).then(|| by_rules!(self))
        }
    }
);

/// A wheel that left its rail.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct VehicleDerailed {
    /// The output time, s.
    pub time: f64,
    /// Distance along the track.
    pub distance: SummaryValue,
    /// The wheel and the place, in words.
    pub what: String,
}

/// A natural vibration.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct VibrationSummary {
    /// Frequency, Hz.
    pub frequency_hz: f64,
    /// Damping ratio: negative if it grows.
    pub damping_ratio: f64,
}

impl VibrationSummary {
    /// Returns a vibration as a summary has it.
    #[must_use]
    pub fn of(own: Vibration) -> Self {
        Self {
            frequency_hz: own.frequency / (2.0 * PI),
            damping_ratio: own.damping_ratio(),
        }
    }
}
