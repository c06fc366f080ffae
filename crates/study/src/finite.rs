//! Finite or failed: a run with numbers that are not finite is no success.

use std::collections::BTreeMap;

use crate::summary::LedgerSummary;
use crate::summary_value::SummaryValue;

/// Largest size, SI, of a number that counts as finite: in other units it must not overflow either.
const LARGEST: f64 = 1e300;

/// Returns whether a number can be computed with and written in any unit.
pub(crate) fn is_finite(value: f64) -> bool {
    value.abs() <= LARGEST
}

/// Returns the name of the first measure that is not finite.
pub(crate) fn find(measures: &BTreeMap<String, SummaryValue>) -> Option<&str> {
    let found = measures.iter().find(|(_, measure)| !is_finite(measure.value));
    found.map(|(name, _)| name.as_str())
}

/// Returns what of an energy ledger is not a finite number, in words.
pub(crate) fn not_finite(ledger: &LedgerSummary) -> Option<String> {
    match find(&ledger.entries) {
        Some(name) => Some(format!("`{name}`")),
        None => residual_not_finite(ledger.largest_relative_residual),
    }
}

/// Returns the words of a relative residual of an energy ledger that is not finite.
pub(crate) fn residual_not_finite(residual: f64) -> Option<String> {
    (!is_finite(residual)).then(|| "the ledger's relative residual".to_owned())
}
