//! The limits of a run on a track, on the terminal.

use study::car::limits::LimitCheck;
use study::car::statistics::NO_STATISTICS;
use study::summary::{ByRules, RunSummary};

use crate::run_folder::key_numbers::KeyNumber;
use crate::terminal::TerminalTable;

/// Returns the limits of a run on a track beside its worst values, and the note that explains the columns;
/// nothing of other runs.
pub(super) fn beside(summary: &dyn RunSummary) -> (TerminalTable, String) {
    let Some(own) = summary.by_rules() else {
        return (TerminalTable::new(1, &[]), String::new());
    };
    if own.limits.is_empty() {
        let why = summary
            .warnings()
            .iter()
            .find(|own| own.starts_with(NO_STATISTICS));
        let why = why.and_then(|own| own.strip_prefix(NO_STATISTICS));
        (
            TerminalTable::new(1, &[]),
            format!("No statistics{}.", why.unwrap_or_default()),
        )
    } else if own.limits.iter().any(|own| own.unfiltered) {
        (table(own.limits), format!("{}\n{UNFILTERED_NOTE}", note(own)))
    } else {
        (table(own.limits), note(own))
    }
}

/// Returns the worst values among the numbers that people compare first.
pub(super) fn key_numbers(limits: &[LimitCheck]) -> Vec<KeyNumber> {
    let numbers = limits.iter().map(|limit| {
        let at = limit.statistic.replace('_', " ");
        let window = format!("worst after settling, at {at}");
        KeyNumber::plain(&limit.quantity, window, limit.value, &limit.unit)
    });
    numbers.collect()
}

/// The note on values that no filter has passed.
const UNFILTERED_NOTE: &str = "\
Values without margin are raw: the rows are too far apart for the filter that their limit is for. Shorten \
simulation.output_interval.";

/// Returns the note that explains the columns of the table.
fn note(own: ByRules<'_>) -> String {
    format!(
        "Worst value of each kind, of filtered forces and accelerations, beside limits of {}.\n\
         A limit counts for its regimes only (summary.json names them). Margin: what is left, in parts\n\
         of it; of a least share, of the way from 100 %.",
        own.limits_of
    )
}

/// Returns the table of limits.
fn table(limits: &[LimitCheck]) -> TerminalTable {
    let mut table = TerminalTable::new(
        2,
        &[
            ("quantity", ""),
            ("worst at", ""),
            ("value", ""),
            ("limit", ""),
            ("margin", "%"),
        ],
    );
    for own in limits {
        let shown = |value: f64| match own.unit.as_str() {
            "" => format!("{value:.3}"),
            unit => format!("{value:.3} {unit}"),
        };
        table.row([
            own.quantity.clone(),
            own.worst_at(),
            shown(own.value),
            shown(own.limit),
            match own.unfiltered {
                true => "-".to_owned(),
                false => format!("{:.0}", 100.0 * own.margin),
            },
        ]);
    }
    table
}
