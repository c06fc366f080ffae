//! The summary of a car's run.

use std::collections::BTreeMap;

use integrate::Statistics as Counters;
use quantity::System as Units;
use serde::{Deserialize, Serialize};

use super::limits::LimitCheck;
use super::locked_in::{self, LockedIn};
use super::statistics::Statistic;
use crate::damage::DamageSummary;
use crate::losses::EnergySummary;
use crate::metrics::Extremes;
use crate::outcome::RunEnd;
use crate::statics::StaticTable;
use crate::summary::{ByRules, LedgerSummary, Stopped, SummaryValue, by_rules, ledger, run_summary};
use crate::wear::mounted::WedgesWorn;
use crate::wedge_rise::RiseSummary;

/// The schema's name and version.
pub const SCHEMA: &str = "wedgelab.car/1";

/// The numbers of a run.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct CarSummary {
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
    /// The derailment, if a wheel left its rail: the run ends there, and is incomplete.
    pub derailed: Option<Derailed>,
    /// The reason for not using its numbers, which are kept: its energy ledger does not close to 1e-2.
    pub failed: Option<String>,
    /// Warnings about the numbers; empty for a sound run.
    pub warnings: Vec<String>,
    /// Number of rows.
    pub rows: usize,
    /// Distance along the track at the start and at the end.
    pub distance: [SummaryValue; 2],
    /// Speed at the start and at the end.
    pub speed: [SummaryValue; 2],
    /// Static load of each wheel by its name: `axle_1_left`.
    pub static_loads: BTreeMap<String, SummaryValue>,
    /// Statistics by name: see the table in docs/car.md.
    pub statistics: BTreeMap<String, Statistic>,
    /// The rule of the limits, its edition and source; empty in older summaries.
    #[serde(default)]
    pub limits_of: String,
    /// Limits of that rule beside the worst value of each.
    pub limits: Vec<LimitCheck>,
    /// Energy that the friction of each wedge took, by its name: `truck_1_leading_left`.
    pub wedge_losses: BTreeMap<String, SummaryValue>,
    /// Share of the rows after settling in which no point of a wedge's faces slips, by its name; none of
    /// massless wedges.
    #[serde(default)]
    pub wedge_locked: BTreeMap<String, f64>,
    /// Rises of the wedges at the start, by their names: `truck_1_leading_left`.
    #[serde(default)]
    pub wedge_rise: BTreeMap<String, RiseSummary>,
    /// The kind of the start: `equilibrium`, `nominal` or `shaken`.
    #[serde(default)]
    pub start: String,
    /// Normal forces of the wedges at the start, by their names: `truck_1_leading_left`.
    #[serde(default)]
    pub locked_in: BTreeMap<String, LockedIn>,
    /// The car at the start: weight, wheels, heights, coils.
    #[serde(default)]
    pub statics: StaticTable,
    /// Damage of wheels and rails by rolling; none of linear wheels and of older summaries.
    #[serde(default)]
    pub damage: Option<DamageSummary>,
    /// Wear of the wedges; none where they are massless, or before a distance is made.
    #[serde(default)]
    pub wedge_wear: Option<WedgesWorn>,
    /// Sources and sinks of the energy of the run.
    pub energy: EnergySummary,
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

run_summary!(
    CarSummary,
    |own| title: &own.title,
    ledger: ledger!(own.ledger, own.ledger.entries),
    solver: (own.solver.steps, own.relative_tolerance),
    derailed: own.end_of_derailed(),
    reached: own.end_distance(),
    {
        fn by_rules(&self) -> Option<ByRules<'_>> {
            Some(by_rules!(self))
        }
    }
);

impl CarSummary {
    /// Returns the line about what the start locks in; none of a summary without it.
    #[must_use]
    pub fn start_in_words(&self) -> Option<String> {
        locked_in::words(&self.start, &self.locked_in)
    }

    fn end_of_derailed(&self) -> Option<RunEnd> {
        self.derailed.as_ref().map(|own| RunEnd {
            time: own.time,
            reason: own.what.clone(),
            distance: self.end_distance(),
        })
    }

    fn end_distance(&self) -> Option<SummaryValue> {
        Some(self.distance[1].clone())
    }
}

/// The place at which a wheel left its rail.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Derailed {
    /// Time, s.
    pub time: f64,
    /// Distance of the wheel along the track.
    pub distance: SummaryValue,
    /// Axle, from the front, 1 to 4.
    pub axle: usize,
    /// `left` or `right`.
    pub side: String,
    /// In words.
    pub what: String,
}
