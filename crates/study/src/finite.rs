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

/// Returns what of an energy ledger, or of more measures, is not a finite number, in words.
pub(crate) fn not_finite(
    ledger: &LedgerSummary,
    more: Option<&BTreeMap<String, SummaryValue>>,
) -> Option<String> {
    let name = find(&ledger.entries).or_else(|| find(more?));
    let residual = !is_finite(ledger.largest_relative_residual);
    let what = match name {
        Some(name) => format!("`{name}`"),
        None if residual => "the ledger's relative residual".to_owned(),
        None => return None,
    };
    Some(format!("{what} is not a finite number"))
}
