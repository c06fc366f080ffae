//! What friction locks in at the start of a car's run: the normal forces of its wedges' columns and slopes.

use std::collections::BTreeMap;

use car::StartKind;
use quantity::{Kind, System as Units};
use serde::{Deserialize, Serialize};
use truck::{WEDGE_NAMES, WedgeLoads};

use super::columns::CarTable;
use super::sections::STARTS;
use crate::case::section::name_of;
use crate::summary::SummaryValue;

/// Normal forces of a wedge.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct NormalForces {
    /// Of its column.
    pub column: SummaryValue,
    /// Of its slope.
    pub slope: SummaryValue,
}

/// A wedge at the start.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct LockedIn {
    /// At the start.
    pub at_start: NormalForces,
    /// Before the shaking, in the equilibrium without friction; none of other starts.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub before_shaking: Option<NormalForces>,
}

/// Returns the wedges at the start by their names: `truck_1_leading_left`.
pub(super) fn summary(table: &CarTable, units: Units) -> BTreeMap<String, LockedIn> {
    let force = |value: f64| SummaryValue::new(value, Kind::Force, units);
    let of = |own: &WedgeLoads| NormalForces {
        column: force(own.column_normal),
        slope: force(own.slope_normal),
    };
    let before = table.car().before_shaking.as_ref();
    let mut found = BTreeMap::new();
    for (t, wedges) in table.wedges_at_start().iter().enumerate() {
        for (w, (name, own)) in WEDGE_NAMES.iter().zip(wedges).enumerate() {
            let wedge = LockedIn {
                at_start: of(own),
                before_shaking: before.map(|trucks| of(&trucks[t][w])),
            };
            found.insert(format!("truck_{}_{name}", t + 1), wedge);
        }
    }
    found
}

/// Returns the name of a start in cases.
pub(crate) fn name(kind: StartKind) -> &'static str {
    name_of(STARTS, &kind)
}

/// Returns the line about the columns at a start of this name; none of a summary without them.
pub(super) fn words(start: &str, wedges: &BTreeMap<String, LockedIn>) -> Option<String> {
    let range = |of: &dyn Fn(&LockedIn) -> Option<&NormalForces>| {
        let columns = wedges
            .values()
            .filter_map(|own| of(own).map(|forces| &forces.column));
        let unit = columns.clone().next()?.unit.clone();
        let values = columns.map(|own| own.value);
        let least = values.clone().reduce(f64::min)?;
        let most = values.reduce(f64::max)?;
        Some(match most - least <= 0.01 * most.abs() {
            true => format!("{most:.0} {unit}"),
            false => format!("{least:.0} to {most:.0} {unit}"),
        })
    };
    let at_start = range(&|own| Some(&own.at_start))?;
    Some(match (start, range(&|own| own.before_shaking.as_ref())) {
        (_, Some(before)) => format!(
            "Columns carry {at_start} at the start (shaken), {before} before the shaking (equilibrium \
             without friction)."
        ),
        ("equilibrium", None) => format!(
            "Columns carry {at_start} at the start (equilibrium, without friction: what is locked in then \
             lasts until wedges slip; start.kind = \"shaken\" has what friction holds in service)."
        ),
        (_, None) => format!("Columns carry {at_start} at the start ({start})."),
    })
}
