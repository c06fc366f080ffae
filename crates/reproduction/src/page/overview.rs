//! The opening of the report of all runs: one run moving with its loop, its key numbers, and how many
//! statements hold.

use maud::{Markup, html};
use report::figures::{CaseOutcome, digits};
use report::page::anchor;
use report::run_folder::branch_window;
use study::summary::SummaryValue;

use super::Contents;

/// The run that is seen first where it is there: it lifts off, so that everything there is happens in it.
const FIRST: &str = "vdrun_toe_0_psi_0.012";

/// Returns the section; nothing without runs.
pub(super) fn section(contents: &Contents<'_>) -> Markup {
    let all = || contents.outcomes.iter().chain(contents.beyond);
    let named = all().find(|(case, _)| case.name == FIRST);
    let Some(first) = named.or_else(|| all().next()) else {
        return html! {};
    };
    let claims = contents.claims;
    let worst = all()
        .map(|(_, result)| result.summary.ledger.largest_relative_residual)
        .fold(0.0_f64, f64::max);
    let (name, numbers) = (&first.0.name, numbers(first));
    html! {
        section {
            h2 id="short" { "In short" }
            ul.tiles {
                @if !claims.claims.is_empty() {
                    li { a href="#claims" { strong { (claims.hold) " of " (claims.claims.len()) } }
                        span { "statements of the thesis hold in these runs; \
                                " (claims.do_not) " do not, " (claims.undecided)
                            " cannot be decided" } }
                }
                li { strong { (all().count()) } span { "runs of one wedge; largest residual of an energy \
                                                        ledger "
                    (format!("{worst:.0e}").replace('-', "\u{2212}")) } }
                @for (what, value) in &numbers {
                    li { strong { (digits(value.value)) " " (value.unit) } span { (what) } }
                }
            }
            p {
                "Forces and energy are those of the run " a href={ "#run-" (anchor(name)) } { (name) } " ("
                (first.0.title) "). Means are over " (branch_window(Some(first.0.parameters.damping)))
                "; the energy is the mean of " (first.1.summary.averages.cycles) " whole cycles."
                " Press play to see it move, or drag in a plot."
            }
            div data-shown=(name) {}
        }
    }
}

/// Means and energy of the run.
fn numbers((_, result): &CaseOutcome) -> Vec<(String, SummaryValue)> {
    let averages = &result.summary.averages;
    let mean = |branch: &str, value: Option<&SummaryValue>| {
        let what = format!("mean vertical wedge force, bolster going {branch}");
        value.map(|value| (what, value.clone()))
    };
    let energy = averages.side_frame_energy();
    let energy = energy.map(|value| {
        (
            "friction energy at the side frame per cycle".to_owned(),
            value.clone(),
        )
    });
    [
        mean("up", averages.force_up()),
        mean("down", averages.force_down()),
        energy,
    ]
    .into_iter()
    .flatten()
    .collect()
}
