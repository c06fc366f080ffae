//! The page of one run of a truck: what it looks like, its loops, its wedges, its assumptions.

use maud::{Markup, html};
use quantity::Kind;
use study::truck::WEDGE_NAMES;
use study::truck::summary::TruckSummary;

use super::{Viewer, doubts, interactive, moving, run_page, shown_in};
use crate::figures::truck::{TruckRun, exhibits};
use crate::view::run::{Detail, Recording};

/// The page as HTML; it needs nothing else to be shown.
///
/// # Errors
/// What the writer of JSON says.
pub fn render(run: &TruckRun, viewer: Option<Viewer>) -> Result<String, serde_json::Error> {
    let summary = &run.result.summary;
    let exhibits = exhibits(run);
    let recording =
        || Recording::of_three_piece_truck(&run.case, &run.result, run.contacts.as_ref(), Detail::Thinned);
    let data = interactive(viewer, summary.units, recording, &exhibits)?;
    let main = html! {
        (doubts(summary))
        @if data.is_some() { (moving(&summary.name)) }
        section { h2 { "Wedges" } (wedges(summary)) }
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
        data,
    ))
}

/// The energy (output units) that the friction of a wedge's face takes in a cycle.
pub(super) fn loss(summary: &TruckSummary, wedge: &str, face: &str) -> Option<f64> {
    summary.cycles.loss_at(wedge, face)
}

/// The table of a run's wedges.
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
                            td.number { (cell(loss(summary, wedge, "column"))) }
                            td.number { (cell(loss(summary, wedge, "slope"))) }
                        }
                    }
                }
            }
        }
        p {
            "Energy ledger: its largest residual at any output time is "
            (format!("{:.1e}", summary.ledger.largest_relative_residual))
            " of the largest of work, losses and change of stored energy. " (summary.statistics.steps) " steps."
        }
    }
}
