//! The page of one run of a stand-alone wedge: the wedge moving, its key numbers, figures, assumptions.

use maud::html;

use super::{data_of, doubts, ledger_note, moving, run_page, shown_in, side_by_side};
use crate::figures::CaseOutcome;
use crate::figures::run::exhibits;
use crate::run_folder::KeyNumber;
use crate::view::run::{Detail, Recording};

/// Returns the page as HTML; it needs nothing else to be shown.
///
/// # Errors
/// Errors of the JSON writer.
pub fn render(run: &CaseOutcome) -> Result<String, serde_json::Error> {
    let (case, summary) = (&run.0, &run.1.summary);
    let exhibits = exhibits(run);
    let data = data_of(
        summary.units,
        Recording::of_wedge(run, Detail::Thinned),
        &exhibits,
    )?;
    let numbers = KeyNumber::of_wedge(summary, Some(case.parameters.damping));
    let main = html! {
        (doubts(summary))
        (moving(&summary.name))
        section {
            h2 { "Key numbers" }
            (side_by_side::table(&[("value", numbers)], summary.units))
            (ledger_note(summary.ledger.largest_relative_residual, summary.solver.statistics.steps))
        }
        section {
            h2 { "Figures" }
            @for exhibit in &exhibits { (shown_in(exhibit, &exhibit.figure.to_svg(), None)) }
        }
        section { h2 { "Assumptions" } ul { @for text in &summary.assumptions { li { (text) } } } }
    };
    Ok(run_page(
        summary,
        (&case.title, &summary.program),
        "a stand-alone friction wedge",
        &main,
        &data,
    ))
}
