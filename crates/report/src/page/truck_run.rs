//! The page of one run of a truck: what it looks like, its loops, its wedges, its assumptions.

use maud::{Markup, html};
use quantity::Kind;
use study::losses::EnergySummary;
use study::losses::flow::words;
use study::losses::stroke::PARTS;
use study::summary::SummaryValue;
use study::truck::WEDGE_NAMES;
use study::truck::summary::TruckSummary;

use super::{data_of, doubts, ledger_note, moving, run_page, shown_in, side_by_side, statics};
use crate::figures::truck::{TruckRun, exhibits};
use crate::run_folder::KeyNumber;
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
    let data = data_of(summary.units, recording, &exhibits)?;
    let main = html! {
        (doubts(summary))
        (moving(&summary.name))
        section {
            h2 { "Key numbers" }
            (side_by_side::table(&[("value", KeyNumber::of_truck(summary))], summary.units))
        }
        section { h2 { "At the start" } (statics::section(&summary.statics, summary.units)) }
        section { h2 { "Wedges" } (wedges(summary)) }
        @if let Some(loss) = &summary.energy.loss {
            section { h2 { "Energy of a cycle" } (losses(&summary.energy, loss)) }
        }
        section {
            h2 { "Figures" }
            @for exhibit in &exhibits { (shown_in(exhibit, &exhibit.figure.to_svg(), None)) }
        }
        section { h2 { "Assumptions" } ul { @for text in &summary.assumptions { li { (text) } } } }
    };
    let what = "a three-piece truck with four wedges that have mass";
    Ok(run_page(
        summary,
        (&summary.title, &summary.program),
        what,
        &main,
        &data,
    ))
}

/// Returns the table of what is lost in a cycle, without what is less than a thousandth of it.
fn losses(energy: &EnergySummary, loss: &SummaryValue) -> Markup {
    let share = |own: Option<&SummaryValue>, of: f64| {
        own.map_or("–".to_owned(), |own| format!("{:.1}", 100.0 * own.value / of))
    };
    let large = |value: f64| value >= 1e-3 * loss.value;
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
        div.wide {
            table {
                thead {
                    tr {
                        th scope="col" { "lost in" }
                        th.number scope="col" { "energy" br; span.unit { (loss.unit) } }
                        @for state in ["sticking", "slipping"] {
                            th.number scope="col" { (state) br; span.unit { "%" } }
                        }
                        @for part in PARTS {
                            th.number scope="col" { (part.replace('_', ", ")) br; span.unit { "%" } }
                        }
                    }
                }
                tbody {
                    @for (name, own, total) in energy.by_size().into_iter().filter(|own| large(own.2)) {
                        tr {
                            th scope="row" { (words(name)) }
                            td.number { (format!("{total:.1}")) }
                            @for state in ["stick", "slip"] {
                                td.number { (share(own.by_state.get(state), total)) }
                            }
                            @for part in PARTS { td.number { (share(own.by_stroke.get(part), total)) } }
                        }
                    }
                    tr {
                        th scope="row" { "all" }
                        td.number { (format!("{:.1}", loss.value)) }
                        td.number {} td.number {}
                        @for part in PARTS { td.number { (share(energy.by_stroke.get(part), loss.value)) } }
                    }
                }
            }
        }
    }
}

/// Returns the table of a run's wedges.
fn wedges(summary: &TruckSummary) -> Markup {
    let [force, energy] = [Kind::Force, Kind::Energy].map(|kind| kind.label(summary.units));
    let cell = |value: Option<f64>| value.map_or("–".to_owned(), |value| format!("{value:.1}"));
    html! {
        p {
            "Normal force of the column at any output time; energy lost in friction in a cycle of the first \
             periodic motion, from its second one on."
            @if !summary.cycles.missing.is_empty() { " No energies: " (summary.cycles.missing) "." }
        }
        div.wide {
            table {
                thead {
                    tr {
                        th scope="col" { "wedge" }
                        th.number scope="col" { "column, least" br; span.unit { (force) } }
                        th.number scope="col" { "column, largest" br; span.unit { (force) } }
                        th.number scope="col" { "lost at the column" br; span.unit { (energy) } }
                        th.number scope="col" { "lost at the slope" br; span.unit { (energy) } }
                    }
                }
                tbody {
                    @for wedge in WEDGE_NAMES {
                        @let column = format!("{wedge}_column_normal_{}", Kind::Force.suffix(summary.units));
                        @let extremes = summary.extremes.get(&column);
                        tr {
                            th scope="row" { (wedge.replace('_', " ")) }
                            td.number { (cell(extremes.map(|found| found.minimum))) }
                            td.number { (cell(extremes.map(|found| found.maximum))) }
                            td.number { (cell(summary.cycles.loss_at(wedge, "column"))) }
                            td.number { (cell(summary.cycles.loss_at(wedge, "slope"))) }
                        }
                    }
                }
            }
        }
        (ledger_note(summary.ledger.largest_relative_residual, summary.statistics.steps))
    }
}
