//! Limits and statistics of a run on a track.

use maud::{Markup, html};
use study::summary::{ByRules, RunSummary, SummaryValue};

use super::in_unit;
use super::table::{self, Head};
use crate::figures::digits;

/// Returns the sections; nothing of a run on no track.
pub(super) fn by_rules(summary: &dyn RunSummary) -> Markup {
    html! {
        @if let Some(own) = summary.by_rules() {
            section { h2 { "Limits" } (limits(summary, own)) }
            section { h2 { "Statistics" } (statistics(summary, own)) }
        }
    }
}

/// Returns the sentence above numbers that are not of the whole run.
fn partial(summary: &dyn RunSummary) -> Markup {
    html! { @if let Some(text) = summary.outcome().numbers() { p.warning { (text) } } }
}

fn limits(summary: &dyn RunSummary, own: ByRules<'_>) -> Markup {
    let heads = [
        Head::Words("quantity"),
        Head::Words("worst at"),
        Head::Numbers("value"),
        Head::Numbers("limit"),
        Head::Numbers("margin"),
        Head::Words("regimes"),
    ];
    let rows = own.limits.iter().map(|own| {
        let margin = match own.unfiltered {
            true => "none: raw".to_owned(),
            false => format!("{:.0} %", 100.0 * own.margin),
        };
        [
            own.quantity.clone(),
            own.worst_at(),
            in_unit(own.value, &own.unit),
            in_unit(own.limit, &own.unit),
            margin,
            own.regimes.clone(),
        ]
    });
    html! {
        (partial(summary))
        p {
            "The worst value of each kind beside limits of " (own.limits_of) ". A limit counts for the \
             regimes named. Margin: \
             what is left, in parts of the limit; of a least share, of the way from 100 %. \
             Raw values, where rows are too far apart for the filter, \
             have none."
        }
        (table::wide(&heads, rows))
    }
}

fn statistics(summary: &dyn RunSummary, own: ByRules<'_>) -> Markup {
    let heads = [
        Head::Words("statistic"),
        Head::Numbers("raw"),
        Head::Numbers("filtered"),
        Head::Numbers("from (s)"),
    ];
    let rows = own.statistics.iter().map(|(name, own)| {
        let name = name.replace('_', " ");
        [
            match own.remark.as_str() {
                "" => name,
                remark => format!("{name} ({remark})"),
            },
            shown(own.raw.as_ref()),
            shown(own.filtered.as_ref()),
            own.time.map_or("–".to_owned(), digits),
        ]
    });
    html! {
        (partial(summary))
        details {
            summary { "All statistics, raw and filtered" }
            (table::wide(&heads, rows))
        }
    }
}

/// Returns a value with its unit, a dash if there is none.
pub(super) fn shown(value: Option<&SummaryValue>) -> String {
    value.map_or("–".to_owned(), |own| in_unit(own.value, &own.unit))
}
