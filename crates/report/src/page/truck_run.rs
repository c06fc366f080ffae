//! The page of one run of a truck: what it looks like, its loops, its wedges, its assumptions.

use std::collections::BTreeMap;
use std::iter;

use maud::{Markup, html};
use quantity::Kind;
use study::losses::EnergySummary;
use study::losses::flow::words;
use study::losses::stroke::PARTS;
use study::summary::SummaryValue;
use study::truck::WEDGE_NAMES;
use study::truck::summary::TruckSummary;

use super::table::{self, Head};
use super::{damage, figures, ledger_note, run_page, side_by_side, statics};
use crate::figures::truck::{TruckRun, exhibits};
use crate::models::ReportSummary;
use crate::view::run::{Detail, Recording};

/// Returns the page as HTML; it needs nothing else to be shown.
///
/// # Errors
/// Errors of the JSON writer.
pub fn render(run: &TruckRun) -> Result<String, serde_json::Error> {
    let summary = &run.result.summary;
    let exhibits = exhibits(run);
    let recording =
        Recording::of_three_piece_truck(&run.case, &run.result, run.contacts.as_ref(), Detail::Thinned);
    let sections = html! {
        section {
            h2 { "Key numbers" }
            (side_by_side::table(&[("value", summary.key_numbers(None))], summary.units))
        }
        section { h2 { "At the start" } (statics::section(&summary.statics, summary.units)) }
        section { h2 { "Wedges" } (wedges(summary)) }
        @if let Some(loss) = &summary.energy.loss {
            section { h2 { "Energy of a cycle" } (losses(&summary.energy, loss)) }
        }
        (damage::of_wedges(summary.wedge_wear.as_ref()))
        (figures(&exhibits))
    };
    let what = "a three-piece truck with four wedges that have mass";
    run_page(summary, &summary.title, what, (recording, &exhibits), &sections)
}

/// Returns the table of what is lost in a cycle, without what is less than a thousandth of it.
fn losses(energy: &EnergySummary, loss: &SummaryValue) -> Markup {
    let share = |own: Option<&SummaryValue>, of: f64| {
        own.map_or("–".to_owned(), |own| format!("{:.1}", 100.0 * own.value / of))
    };
    let large = |value: f64| value >= 1e-3 * loss.value;
    let parts = PARTS.map(|part| part.replace('_', ", "));
    let mut heads = vec![Head::Words("lost in"), Head::InUnit("energy", &loss.unit)];
    heads.extend(["sticking", "slipping"].map(|state| Head::InUnit(state, "%")));
    heads.extend(parts.iter().map(|part| Head::InUnit(part, "%")));
    let row = |name: String, total: f64, states: [String; 2], by_stroke: &BTreeMap<String, SummaryValue>| {
        let parts = PARTS.map(|part| share(by_stroke.get(part), total));
        let numbers = iter::once(format!("{total:.1}")).chain(states).chain(parts);
        iter::once(name).chain(numbers)
    };
    let each = energy.by_size().into_iter().filter(|own| large(own.2));
    let each = each.map(|(name, own, total)| {
        let states = ["stick", "slip"].map(|state| share(own.by_state.get(state), total));
        row(words(name), total, states, &own.by_stroke)
    });
    let none = [String::new(), String::new()];
    let rows = each.chain([row("all".to_owned(), loss.value, none, &energy.by_stroke)]);
    html! {
        p {
            "Mean of " (energy.cycles) " whole cycles: lost by face and element, of each the share of \
             contact states and of the four parts of the stroke of what moves (rising or falling, in its \
             upper or lower half)."
            @if let Some(own) = &energy.equivalent {
                " Equivalent damping of all that is lost: " (format!("{:.1} ", own.damping.value))
                (own.damping.unit)
                @if let Some(ratio) = own.damping_ratio { (format!(", damping ratio {ratio:.3}")) }
                "."
            }
        }
        (table::wide(&heads, rows))
    }
}

/// Returns the table of a run's wedges.
fn wedges(summary: &TruckSummary) -> Markup {
    let [force, energy] = [Kind::Force, Kind::Energy].map(|kind| kind.label(summary.units));
    let cell = |value: Option<f64>| value.map_or("–".to_owned(), |value| format!("{value:.1}"));
    let heads = [
        Head::Words("wedge"),
        Head::InUnit("column, least", force),
        Head::InUnit("column, largest", force),
        Head::InUnit("lost at the column", energy),
        Head::InUnit("lost at the slope", energy),
    ];
    let rows = WEDGE_NAMES.map(|wedge| {
        let column = format!("{wedge}_column_normal_{}", Kind::Force.suffix(summary.units));
        let extremes = summary.extremes.get(&column);
        [
            wedge.replace('_', " "),
            cell(extremes.map(|found| found.minimum)),
            cell(extremes.map(|found| found.maximum)),
            cell(summary.cycles.loss_at(wedge, "column")),
            cell(summary.cycles.loss_at(wedge, "slope")),
        ]
    });
    html! {
        p {
            "Normal force of the column at any output time; energy lost in friction in a cycle of the first \
             periodic motion, from its second one on."
            @if !summary.cycles.missing.is_empty() { " No energies: " (summary.cycles.missing) "." }
        }
        (table::wide(&heads, rows))
        (ledger_note(summary))
    }
}
