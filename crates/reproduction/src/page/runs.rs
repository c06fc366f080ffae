//! The table of runs, their assumptions, and their files.

use maud::{Markup, html};
use report::figures::{CaseOutcome, toe_style, yaw};
use report::page::{anchor, doubts};
use report::run_files;
use study::metrics::WINDOWS;
use study::summary::{Averages, SummaryValue};

use super::{Contents, FIGURES};

/// Returns the table of runs.
pub(super) fn table(outcomes: &[CaseOutcome]) -> Markup {
    let unit = |of: fn(&Averages) -> Option<&SummaryValue>| {
        let found = outcomes
            .iter()
            .find_map(|(_, result)| of(&result.summary.averages));
        found.map_or(String::new(), |measure| measure.unit.clone())
    };
    let (up, down) = (unit(Averages::force_up), unit(Averages::force_down));
    let energy = unit(Averages::side_frame_energy);
    let damping = unit(|own| own.equivalent_damping.as_ref());
    let cell = |measure: Option<&SummaryValue>| {
        measure.map_or("–".to_owned(), |measure| format!("{:.1}", measure.value))
    };
    if outcomes.is_empty() {
        return html! {};
    }
    html! {
        section {
            h2 id="runs" { "Runs" }
            p {
                "Each run gives the bolster a vertical motion and computes the wedge. Mean force: vertical \
                 wedge force (friction of the column on the side frame, positive up), averaged while the \
                 bolster goes up or down over the window that is named; \
                 " (WINDOWS) ". Energy per cycle: lost in friction at the \
                 side frame. Equivalent damping: that energy over π ω A². Ledger residual: the largest at \
                 any output time, over the largest of work, losses and change of stored energy; above 1e-3 \
                 a run has a warning, above 1e-2 it has failed."
            }
            div.wide {
                table {
                    thead {
                        tr {
                            th scope="col" { "run" }
                            th scope="col" { "damping" }
                            th scope="col" { "toe" }
                            th.number scope="col" { "yaw" br; span.unit { "rad" } }
                            th scope="col" { "window of mean force" }
                            th.number scope="col" { "mean force, up" br; span.unit { (up) } }
                            th.number scope="col" { "mean force, down" br; span.unit { (down) } }
                            th.number scope="col" { "energy per cycle" br; span.unit { (energy) } }
                            th.number scope="col" {
                                "equivalent damping" br; span.unit { (damping) }
                            }
                            th.number scope="col" { "ledger residual" br; span.unit { "relative" } }
                            th.number scope="col" { "steps" }
                        }
                    }
                    tbody {
                        @for (case, result) in outcomes {
                            @let summary = &result.summary;
                            tr {
                                th scope="row" {
                                    a href={ "#run-" (anchor(&case.name)) } { (case.name) }
                                }
                                td { (case.parameters.damping.name()) }
                                td.plain { (toe_style(case.parameters.toe).0) }
                                td.number { (yaw(case)) }
                                td { (summary.averages.window) }
                                td.number { (cell(summary.averages.force_up())) }
                                td.number { (cell(summary.averages.force_down())) }
                                td.number { (cell(summary.averages.side_frame_energy())) }
                                td.number { (cell(summary.averages.equivalent_damping.as_ref())) }
                                td.number { (format!("{:.1e}", summary.ledger.largest_relative_residual)) }
                                td.number { (summary.solver.statistics.steps) }
                            }
                        }
                    }
                }
            }
            @for (_, result) in outcomes { (doubts(&result.summary)) }
        }
    }
}

/// Returns the assumptions: those of all runs, then those of some.
pub(super) fn assumptions(contents: &Contents<'_>) -> Markup {
    let outcomes: Vec<&CaseOutcome> = contents.outcomes.iter().chain(contents.beyond).collect();
    let mut texts: Vec<(&str, Vec<&str>)> = Vec::new();
    for (case, result) in outcomes.iter().copied() {
        for text in &result.summary.assumptions {
            match texts.iter_mut().find(|(own, _)| *own == text.as_str()) {
                Some((_, runs)) => runs.push(&case.name),
                None => texts.push((text, vec![&case.name])),
            }
        }
    }
    let (all, some): (Vec<_>, Vec<_>) = texts
        .into_iter()
        .partition(|(_, runs)| runs.len() == outcomes.len());
    html! {
        section {
            h2 id="assumptions" { "Assumptions" }
            p {
                "The thesis is silent or contradicts itself in places. What these runs assume; each is a \
                 parameter of the case file."
            }
            h3 { "In all runs" }
            ul { @for (text, _) in &all { li { (text) } } }
            @if !some.is_empty() {
                h3 { "In some runs" }
                ul {
                    @for (text, runs) in &some {
                        li {
                            (text) " ("
                            @if runs.len() > 6 { (runs.len()) " runs" } @else { (runs.join(", ")) }
                            ")"
                        }
                    }
                }
            }
        }
    }
}

/// Returns the paragraph about the data's files.
pub(super) fn files(contents: &Contents<'_>) -> Markup {
    html! {
        section {
            h2 id="files" { "Files" }
            p {
                "Beside this page: \
                 " code { (FIGURES) "/" } " holds each figure as SVG and PNG; " code { "claims.json" }
                " the statements and verdicts; " code { "runs/" } " the data of each run."
            }
            div.wide {
                table {
                    thead { tr { th scope="col" { "run" } th scope="col" { "files" } } }
                    tbody {
                        @for (case, _) in contents.outcomes.iter().chain(contents.beyond) {
                            tr {
                                th scope="row" { (case.name) }
                                td {
                                    @for name in run_files::NAMES {
                                        a href={ "runs/" (case.name) "/" (name) } { (name) } " "
                                    }
                                }
                            }
                        }
                    }
                }
            }
        }
    }
}
