//! Measures that limits of rules are set for: the worst of the statistics of a run on a track, and figures of
//! the vehicle that formulas of limits take.

use std::collections::BTreeMap;

use quantity::Kind;

use super::Measure;
use crate::car::figures::CarFigures;
use crate::car::statistics::Statistic;
use crate::car::worst::WORST;

/// What figures of the vehicle are, in the order of [`CarFigures::NAMES`].
const FIGURES: [(Kind, &str); 6] = [
    (Kind::Force, "least static load of an axle on level track"),
    (Kind::Force, "greatest static load of an axle on level track"),
    (Kind::Force, "least static load of a wheel on level track"),
    (Kind::Force, "greatest static load of a wheel on level track"),
    (Kind::Angle, "least of the largest angles of the wheels' flanges"),
    (
        Kind::Dimensionless,
        "greatest friction of a wheel on its rail at the angle of its flange, where nothing slips",
    ),
];

/// Returns the measures of the worst statistics.
pub(super) fn worst() -> impl Iterator<Item = Measure> {
    WORST
        .iter()
        .map(|own| Measure::new(own.name, own.kind, own.text, false))
}

/// Returns the values of [`worst`], SI, of statistics in SI: `NaN` where there is none.
pub(super) fn values(statistics: &BTreeMap<String, Statistic>) -> Vec<f64> {
    // What limits compare is filtered: where rows are too far apart for that, there is no number.
    let found = WORST.iter().map(|own| {
        let found = own.of(statistics);
        found.filter(|found| found.filtered || !own.is_filtered())
    });
    found
        .map(|found| found.map_or(f64::NAN, |own| own.value.value))
        .collect()
}

/// Returns the measures of the figures of a vehicle. Linear wheels have no flanges.
pub(super) fn figures() -> impl Iterator<Item = Measure> {
    let all = CarFigures::NAMES.into_iter().zip(FIGURES);
    all.map(|(name, (kind, text))| Measure::new(name, kind, text, kind == Kind::Force))
}
