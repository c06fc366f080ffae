//! The page of one run of a car: what it looks like, its limits and statistics, figures over the distance,
//! assumptions.

use maud::{Markup, html};
use study::car::summary::CarSummary;

use super::by_rules::{by_rules, shown};
use super::table::{self, Head};
use super::{damage, figures, ledger_note, run_page, statics};
use crate::figures::car::{CarRun, exhibits};
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
        (by_rules(summary))
        (figures(&exhibits))
        section { h2 { "At the start" } (statics::section(&summary.statics, summary.units)) }
        section { h2 { "Wedges" } (wedges(summary)) }
        @if let Some(own) = &summary.damage { section { h2 { "Wear and fatigue" } (damage::section(own)) } }
        (damage::of_wedges(summary.wedge_wear.as_ref()))
    };
    run_page(
        summary,
        &summary.title,
        "a freight car on track",
        (recording, &exhibits),
        &sections,
    )
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
