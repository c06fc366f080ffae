//! Every built-in case beyond the thesis runs to its end without warnings and closes its energy ledger.
#![allow(clippy::unwrap_used, clippy::expect_used)]

#[path = "common/runs.rs"]
mod runs;

use study::case::{Case, builtin};

#[test]
fn all_cases_beyond_the_thesis_close_their_ledgers() {
    let thesis: Vec<&str> = builtin::thesis_names().collect();
    let cases: Vec<Case> = builtin::names()
        .filter(|name| !thesis.contains(name))
        .map(|name| builtin::case(name).unwrap())
        .collect();
    assert!(cases.len() > 30, "{}", cases.len());
    for (case, result) in cases.iter().zip(&runs::run_all(&cases, 2)) {
        let (summary, name) = (&result.summary, &case.name);
        assert!(summary.complete, "{name}: {:?}", summary.stopped);
        assert!(summary.warnings.is_empty(), "{name}: {:?}", summary.warnings);
        let residual = summary.ledger.largest_relative_residual;
        assert!(residual < 5e-6, "{name}: {residual:e}");
        // None is a matter of more than a moment.
        let attempts = summary.solver.statistics.steps + summary.solver.statistics.rejected();
        assert!(attempts < 6000, "{name}: {attempts} attempted steps");
        for (column, values) in result.columns.iter().zip(&result.values) {
            assert!(
                values.iter().all(|value| value.is_finite()),
                "{name}: {}",
                column.name
            );
        }
    }
}
