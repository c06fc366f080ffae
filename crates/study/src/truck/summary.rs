//! The summary of a truck's run.

use std::collections::BTreeMap;

use integrate::Statistics;
use quantity::{Kind, System as Units};
use serde::{Deserialize, Serialize};
use truck::HALVES;

use crate::jam::JamMargins;
use crate::losses::EnergySummary;
use crate::metrics::Extremes;
use crate::statics::StaticTable;
use crate::summary::{LedgerSummary, Stopped, SummaryValue, ledger, run_summary};
use crate::wear::mounted::WedgesWorn;
use crate::wedge_rise::RiseSummary;

/// The schema's name and version.
pub const SCHEMA: &str = "wedgelab.three_piece_truck/1";

/// The numbers of a run.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct TruckSummary {
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
    /// The reason for not using its numbers, which are kept: its energy ledger does not close to 1e-2.
    pub failed: Option<String>,
    /// Warnings about the numbers; empty for a sound run.
    pub warnings: Vec<String>,
    /// Number of rows.
    pub rows: usize,
    /// Energies of whole cycles.
    pub cycles: Cycles,
    /// Warp stiffnesses: warp moment over warp angle where the angle is reached first, by the angle in mrad.
    pub warp_stiffness: BTreeMap<String, SummaryValue>,
    /// Margins of each wedge to lock-up, by its name.
    #[serde(default)]
    pub jam: BTreeMap<String, JamMargins>,
    /// Rises of the wedges at the start, by their names.
    #[serde(default)]
    pub wedge_rise: BTreeMap<String, RiseSummary>,
    /// Wear of the wedges; none where they are massless, or no motion repeats.
    #[serde(default)]
    pub wedge_wear: Option<WedgesWorn>,
    /// The truck at the start: its coils and wedges.
    #[serde(default)]
    pub statics: StaticTable,
    /// Least and greatest values of all columns, by their names with units.
    pub extremes: BTreeMap<String, Extremes>,
    /// The energy ledger at the end; losses by element.
    pub ledger: LedgerSummary,
    /// Sources and sinks of the energy of a cycle.
    #[serde(default)]
    pub energy: EnergySummary,
    /// The integration method.
    pub method: String,
    /// Its relative tolerance.
    pub relative_tolerance: f64,
    /// Counters of the integrator.
    pub statistics: Statistics,
    /// The assumptions of the numbers.
    pub assumptions: Vec<String>,
}

run_summary!(
    TruckSummary,
    |own| title: &own.title,
    ledger: ledger!(own.ledger, own.ledger.entries),
    solver: (own.statistics.steps, own.relative_tolerance)
);

/// Energies a cycle of the first periodic motion, over whole cycles after the first one.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Cycles {
    /// The reason if there are none, else empty.
    pub missing: String,
    /// Number of whole cycles.
    pub count: u32,
    /// Work of all prescribed motions per cycle.
    pub work: Option<SummaryValue>,
    /// Energy lost per cycle, by element and kind of loss.
    pub losses: BTreeMap<String, SummaryValue>,
}

impl Cycles {
    /// Returns the energy that friction takes at a wedge's face (`column` or `slope`) in a cycle, output
    /// units, whether the wedge is a body, two halves, or has no mass.
    #[must_use]
    pub fn loss_at(&self, wedge: &str, face: &str) -> Option<f64> {
        let [outboard, inboard] = HALVES.map(|half| format!("{wedge}_{half}_{face}_friction_loss"));
        let whole = [
            format!("{wedge}_{face}_friction_loss"),
            format!("{wedge}_wedge_{face}_loss"),
        ];
        let found = whole.iter().find_map(|name| self.losses.get(name));
        let found = found.map(|loss| loss.value);
        found.or_else(|| Some(self.losses.get(&outboard)?.value + self.losses.get(&inboard)?.value))
    }

    /// Returns the energy that friction takes at both faces of these wedges in a cycle, output units; `None`
    /// without whole cycles.
    #[must_use]
    pub fn loss_of_wedges(&self, wedges: &[&str]) -> Option<f64> {
        let faces = wedges
            .iter()
            .flat_map(|wedge| ["column", "slope"].map(|face| (wedge, face)));
        let losses = faces.filter_map(|(wedge, face)| self.loss_at(wedge, face));
        (self.count > 0).then(|| losses.sum())
    }
}

/// The angles at which warp stiffness is reported, mrad.
pub const WARP_ANGLES: [f64; 6] = [0.5, 1.0, 2.0, 5.0, 10.0, 20.0];

/// Returns the growth of a moment, or of a part of it (N·m), until the rows reach a warp angle (rad) first,
/// in either sense; positive where it resists, for on the bolster it has the sign of the warp angle then.
/// Straight between two rows, from the values at the row before the warp begins: what is there before any
/// warp is no part of its stiffness. `None` if the rows do not reach it.
#[must_use]
pub fn growth(angles: &[f64], moments: &[f64], angle: f64) -> Option<f64> {
    let first = angles.iter().position(|own| own.abs() > 1e-9)?.saturating_sub(1);
    let rest = moments[first];
    let rows = angles[first..].windows(2).zip(moments[first..].windows(2));
    for (angles, moments) in rows {
        if angles[1].abs() >= angle {
            let share = (angle - angles[0].abs()) / (angles[1].abs() - angles[0].abs());
            let moment = moments[0] + share * (moments[1] - moments[0]) - rest;
            return Some(moment * angles[1].signum());
        }
    }
    None
}

/// Returns warp moment over warp angle (N·m/rad) at an angle (rad), from its [`growth`].
#[must_use]
pub fn warp_stiffness(angles: &[f64], moments: &[f64], angle: f64) -> Option<f64> {
    Some(growth(angles, moments, angle)?.abs() / angle)
}

/// Returns the warp stiffnesses by the angle in mrad; those of angles that are not reached are left out.
#[must_use]
pub fn warp_stiffnesses(angles: &[f64], moments: &[f64], units: Units) -> BTreeMap<String, SummaryValue> {
    let stiffness = |angle: f64| {
        let value = warp_stiffness(angles, moments, 1e-3 * angle)?;
        Some((format!("{angle} mrad"), SummaryValue::per_radian(value, units)))
    };
    WARP_ANGLES.into_iter().filter_map(stiffness).collect()
}

impl SummaryValue {
    /// Returns a moment per angle (N·m/rad) in output units.
    #[must_use]
    pub fn per_radian(si: f64, units: Units) -> Self {
        let moment = Self::new(si, Kind::Moment, units);
        Self {
            unit: format!("{}/rad", moment.unit),
            ..moment
        }
    }
}
