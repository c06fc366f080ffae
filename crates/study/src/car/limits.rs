//! Limits that rules set, beside the worst statistic of each kind.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

use super::statistics::Statistic;
use crate::summary::SummaryValue;

const GRAVITY: f64 = 9.806_65;

/// A limit that rules set.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Limit {
    /// What is limited.
    pub quantity: String,
    /// Regimes that it is set for.
    pub regimes: String,
    /// The statistic that is worst.
    pub statistic: String,
    /// Its value: filtered, or raw where nothing is filtered.
    pub value: f64,
    /// The limit.
    pub limit: f64,
    /// Their unit.
    pub unit: String,
    /// By how much the limit is kept, in parts of it: negative where it is not.
    pub margin: f64,
}

/// A limit as rules state it: what it is, the regimes, the ending of its statistics, the limit, its unit, the
/// limit in SI of that unit, and whether values must lie above.
struct Stated {
    quantity: &'static str,
    regimes: &'static str,
    ending: &'static str,
    limit: f64,
    unit: &'static str,
    below: bool,
}

/// Remembered: AAR M-1001 chapter XI (1993; [later edition]).
const STATED: [Stated; 7] = [
    Stated {
        quantity: "wheel L/V that lasts for the hold time",
        regimes: "dynamic curving (0.8; later edition 1.0)",
        ending: "_l_over_v_time",
        limit: 1.0,
        unit: "",
        below: true,
    },
    Stated {
        quantity: "wheel L/V in curves, percentile",
        regimes: "constant curving (0.8)",
        ending: "_l_over_v_in_curves",
        limit: 0.8,
        unit: "",
        below: true,
    },
    Stated {
        quantity: "axle sum L/V that lasts for the hold time",
        regimes: "hunting, twist and roll, yaw and sway, dynamic curving (1.3; later edition 1.5)",
        ending: "_sum_l_over_v_time",
        limit: 1.5,
        unit: "",
        below: true,
    },
    Stated {
        quantity: "truck side L/V",
        regimes: "yaw and sway",
        ending: "_side_l_over_v",
        limit: 0.6,
        unit: "",
        below: true,
    },
    Stated {
        quantity: "least wheel load that lasts for the hold time",
        regimes: "twist and roll, pitch and bounce, dynamic curving, spiral",
        ending: "_least_load_time",
        limit: 10.0,
        unit: "%",
        below: false,
    },
    Stated {
        quantity: "body roll, greatest less least",
        regimes: "twist and roll, dynamic curving",
        ending: "body_roll_peak_to_peak",
        limit: 6.0,
        unit: "deg",
        below: true,
    },
    Stated {
        quantity: "lateral acceleration at a truck center, standard deviation",
        regimes: "hunting (later edition; 1993: 1.0 g, greatest less least)",
        ending: "_lateral_acceleration_deviation",
        limit: 0.13,
        unit: "g",
        below: true,
    },
];

/// Returns the limits beside the worst value of each, in the order of the table of rules.
#[must_use]
pub fn of(statistics: &BTreeMap<String, Statistic>) -> Vec<Limit> {
    let mut limits = Vec::new();
    for stated in &STATED {
        let sum = stated.ending.contains("_sum_");
        let own = statistics
            .iter()
            .filter(|(name, _)| name.ends_with(stated.ending) && (sum || !name.contains("_sum_")));
        let values = own.filter_map(|(name, own)| {
            let value = own.filtered.as_ref().or(own.raw.as_ref())?;
            Some((name, in_unit(value, stated.unit)))
        });
        let worse = |a: f64, b: f64| if stated.below { a > b } else { a < b };
        let worst = values.reduce(|worst, own| if worse(own.1, worst.1) { own } else { worst });
        let Some((name, value)) = worst else { continue };
        let margin = (stated.limit - value) / stated.limit;
        limits.push(Limit {
            quantity: stated.quantity.to_owned(),
            regimes: stated.regimes.to_owned(),
            statistic: name.clone(),
            value,
            limit: stated.limit,
            unit: stated.unit.to_owned(),
            margin: if stated.below { margin } else { -margin },
        });
    }
    limits
}

/// A value of a summary in the unit of a limit.
fn in_unit(value: &SummaryValue, unit: &str) -> f64 {
    match (value.unit.as_str(), unit) {
        ("rad", "deg") => value.value.to_degrees(),
        ("m/s²", "g") => value.value / GRAVITY,
        _ => value.value,
    }
}
