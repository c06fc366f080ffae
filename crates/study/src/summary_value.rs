//! Numbers with their units, as results have them.

use quantity::{Kind, System as Units};
use serde::{Deserialize, Serialize};

/// A number with its unit.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct SummaryValue {
    /// The number.
    pub value: f64,
    /// Its unit, such as `lbf·in`; empty for plain numbers.
    pub unit: String,
}

impl SummaryValue {
    /// Returns an SI value in output units.
    #[must_use]
    pub fn new(si: f64, kind: Kind, units: Units) -> Self {
        Self {
            value: si * kind.from_si(units),
            unit: kind.label(units).to_owned(),
        }
    }
}
