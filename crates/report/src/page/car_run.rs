//! The page of one run of a car: what it looks like, its limits and statistics, figures over the distance,
//! assumptions.

use maud::{Markup, html};
use study::car::summary::CarSummary;
use study::car::worst::place_in_words;
use study::summary::{RunSummary, SummaryValue};

use super::table::{self, Head};
use super::{figures, in_unit, ledger_note, run_page, statics};
use crate::figures::car::{CarRun, exhibits};
use crate::figures::digits;
use crate::view::run::{Detail, Recording};

/// Returns the page as HTML; it needs nothing else to be shown.
///
/// # Errors
/// Errors of the JSON writer.
pub fn render(run: &CarRun) -> Result<String, serde_json::Error> {
    let summary = &run.result.summary;
    let exhibits = exhibits(run);
    let recording = Recording::of_car(&run.case, &run.result, run.motions.as_ref(), Detail::Thinned);
    let sections = html! {
        section { h2 { "Limits" } (limits(summary)) }
        section { h2 { "Statistics" } (statistics(summary)) }
        (figures(&exhibits))
        section { h2 { "At the start" } (statics::section(&summary.statics, summary.units)) }
        section { h2 { "Wedges" } (wedges(summary)) }
    };
    run_page(
        summary,
        &summary.title,
        "a freight car on track",
        (recording, &exhibits),
        &sections,
    )
}

/// Returns the sentence above numbers that are not of the whole run.
fn partial(summary: &CarSummary) -> Markup {
    html! { @if let Some(text) = summary.outcome().numbers() { p.warning { (text) } } }
}

fn limits(summary: &CarSummary) -> Markup {
    let heads = [
        Head::Words("quantity"),
        Head::Words("worst at"),
        Head::Numbers("value"),
        Head::Numbers("limit"),
        Head::Numbers("margin"),
        Head::Words("regimes"),
    ];
    let rows = summary.limits.iter().map(|own| {
        let margin = match own.unfiltered {
            true => "none: raw".to_owned(),
            false => format!("{:.0} %", 100.0 * own.margin),
        };
        [
            own.quantity.clone(),
            place_in_words(&own.statistic),
            in_unit(own.value, &own.unit),
            in_unit(own.limit, &own.unit),
            margin,
            own.regimes.clone(),
        ]
    });
    html! {
        (partial(summary))
        p {
            "The worst value of each kind beside limits of " (summary.limits_of) ". A limit counts for the \
             regimes named. Margin: \
             what is left, in parts of the limit; of a least share, of the way from 100 %. \
             Raw values, where rows are too far apart for the filter, \
             have none."
        }
        (table::wide(&heads, rows))
    }
}

fn statistics(summary: &CarSummary) -> Markup {
    let heads = [
        Head::Words("statistic"),
        Head::Numbers("raw"),
        Head::Numbers("filtered"),
        Head::Numbers("from (s)"),
    ];
    let rows = summary.statistics.iter().map(|(name, own)| {
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
fn shown(value: Option<&SummaryValue>) -> String {
    value.map_or("–".to_owned(), |own| in_unit(own.value, &own.unit))
}

fn wedges(summary: &CarSummary) -> Markup {
    let heads = [
        Head::Words("wedge"),
        Head::Numbers("friction energy"),
        Head::Numbers("rise"),
        Head::Numbers("coil without load"),
        Head::Numbers("pocket"),
        Head::Numbers("column"),
        Head::Numbers("slope"),
    ];
    let rows = summary.wedge_losses.iter().map(|(name, own)| {
        let rise = summary.wedge_rise.get(name);
        let start = summary.locked_in.get(name).map(|own| &own.at_start);
        [
            name.replace('_', " "),
            shown(Some(own)),
            shown(rise.map(|own| &own.at_start)),
            shown(rise.and_then(|own| own.coil_without_load.as_ref())),
            shown(rise.map(|own| &own.pocket)),
            shown(start.map(|own| &own.column)),
            shown(start.map(|own| &own.slope)),
        ]
    });
    html! {
        p {
            "Energy that the friction of each wedge took at column and slope; its rise in its pocket at the \
             start, as a gauge shows it, the rise at which its control coil has no load there, and the rise \
             that its pocket holds; the normal forces of its column and its slope at the start."
        }
        @if let Some(start) = summary.start_in_words() { p { (start) } }
        (table::wide(&heads, rows))
        (ledger_note(summary))
    }
}
