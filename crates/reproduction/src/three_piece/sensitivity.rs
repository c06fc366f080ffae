//! Sensitivity of results to the stiffness of contacts and bristles, which is decided, not measured.

use serde::Serialize;
use study::truck::WEDGE_NAMES;
use study::truck::run::TruckResult;

use super::rigs::{INCH, KIP_INCH, POUND, Rigs, SENSITIVE, STIFFENED, at};

/// A result of a rig, and its changes.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Sensitivity {
    /// The rig.
    pub rig: &'static str,
    /// The result.
    pub answer: &'static str,
    /// Its unit.
    pub unit: &'static str,
    /// Its value with the stiffnesses of the case.
    pub value: f64,
    /// By how many percent contacts of twice the stiffness move it.
    pub contacts: f64,
    /// By how many percent bristles of twice the stiffness move it.
    pub bristles: f64,
}

/// A result of a rig: its key, its name, and the function that returns it.
type RigResult = (&'static str, &'static str, fn(&TruckResult) -> Option<f64>);

/// Returns the warp moment where 20 mrad are reached first, kip·in.
fn warp_moment(result: &TruckResult) -> Option<f64> {
    Some(at(result, "warp_moment", 4.5)?.abs() / KIP_INCH)
}

/// Returns the largest normal force of any column, lbf.
fn normal(result: &TruckResult) -> Option<f64> {
    let all = WEDGE_NAMES.iter().filter_map(|wedge| {
        let values = result.column(&format!("{wedge}_column_normal"))?;
        Some(values.iter().fold(0.0, |most: f64, force| most.max(*force)))
    });
    all.reduce(f64::max).map(|force| force / POUND)
}

/// Returns the loss of a cycle, in·lbf.
fn loss(result: &TruckResult) -> Option<f64> {
    let losses = &result.summary.cycles.losses;
    let units = result.summary.units;
    let joule = quantity::Kind::Energy.from_si(units);
    let sum: f64 = losses.values().map(|loss| loss.value / joule).sum();
    (!losses.is_empty()).then_some(sum / (POUND * INCH))
}

const WARP: [RigResult; 3] = [
    ("warp moment at 20 mrad", "kip·in", warp_moment),
    ("largest normal force of a column", "lbf", normal),
    ("energy lost in a cycle", "in·lbf", loss),
];

/// Returns all of them; those whose runs are missing are left out.
#[must_use]
pub fn sensitivities(rigs: &Rigs) -> Vec<Sensitivity> {
    let mut found = Vec::new();
    for (rig, ..) in SENSITIVE {
        let answers = if rig.starts_with("warp") {
            &WARP[..]
        } else {
            &WARP[1..]
        };
        for (answer, unit, value_of) in answers {
            let of = |key: &str| rigs.get(key).and_then(|(_, result)| value_of(result));
            let moved = STIFFENED.map(|(what, _)| of(&format!("{rig}, {what}")));
            if let (Some(value), [Some(contacts), Some(bristles)]) = (of(rig), moved) {
                let percent = |stiff: f64| 100.0 * (stiff / value - 1.0);
                found.push(Sensitivity {
                    rig,
                    answer,
                    unit,
                    value,
                    contacts: percent(contacts),
                    bristles: percent(bristles),
                });
            }
        }
    }
    found
}
