//! Finite or failed: a run with numbers that are not finite is no success.

use std::collections::BTreeMap;

use crate::metrics::Extremes;
use crate::summary::{Measure, Summary};

/// Largest size, SI, of a number that counts as finite: in other units it must not overflow either.
const LARGEST: f64 = 1e300;

/// Whether a number can be computed with and written in any unit.
pub(crate) fn is_finite(value: f64) -> bool {
    value.abs() <= LARGEST
}

/// Returns the first number of a summary that is not finite, in words.
pub(crate) fn first_not_finite(summary: &Summary) -> Option<String> {
    let averages = &summary.averages;
    let energies =
        find(&averages.energy_per_cycle).map(|place| format!("the energy per cycle at the {place}"));
    let means = find(&averages.up).or_else(|| find(&averages.down));
    let means = means.map(|column| format!("the mean of `{column}`"));
    let single = [
        ("the equivalent damping", &averages.equivalent_damping),
        ("the equivalent stiffness", &averages.equivalent_stiffness),
        (
            "the equivalent damping on the bolster",
            &averages.equivalent_damping_on_bolster,
        ),
    ];
    let single = single
        .into_iter()
        .find(|(_, measure)| measure.as_ref().is_some_and(|measure| !is_finite(measure.value)))
        .map(|(name, _)| name.to_owned());
    let extreme = |found: &Extremes| !(is_finite(found.minimum) && is_finite(found.maximum));
    let extremes = summary.extremes.iter().find(|(_, found)| extreme(found));
    let extremes = extremes.map(|(column, _)| format!("an extreme of `{column}`"));
    let ledger = find(&summary.ledger.entries).map(|entry| format!("the ledger's `{entry}`"));
    energies.or(means).or(single).or(extremes).or(ledger)
}

/// Returns the name of the first measure that is not finite.
pub(crate) fn find(measures: &BTreeMap<String, Measure>) -> Option<&str> {
    let found = measures.iter().find(|(_, measure)| !is_finite(measure.value));
    found.map(|(name, _)| name.as_str())
}
