//! The page of one run of a stand-alone wedge: the wedge moving, its key numbers, figures, assumptions.

use maud::html;

use super::{figures, ledger_note, run_page, side_by_side};
use crate::figures::CaseOutcome;
use crate::figures::run::exhibits;
use crate::models::wedge::key_numbers;
use crate::view::run::{Detail, Recording};

/// Returns the page as HTML; it needs nothing else to be shown.
///
/// # Errors
/// Errors of the JSON writer.
pub fn render(run: &CaseOutcome) -> Result<String, serde_json::Error> {
    let (case, summary) = (&run.0, &run.1.summary);
    let exhibits = exhibits(run);
    let recording = Recording::of_wedge(run, Detail::Thinned);
    let numbers = key_numbers(summary, Some(case.parameters.damping));
    let sections = html! {
        section {
            h2 { "Key numbers" }
            (side_by_side::table(&[("value", numbers)], summary.units))
            (ledger_note(summary))
        }
        (figures(&exhibits))
    };
    run_page(
        summary,
        &case.title,
        "a stand-alone friction wedge",
        (recording, &exhibits),
        &sections,
    )
}
