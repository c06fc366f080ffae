//! `truck.html`: what the report says of the three-piece truck.

use maud::{Markup, html};
use quantity::Kind;
use report::figures::{Exhibit, capital, digits};
use report::page::{self, anchor, document, doubts, shown_in};
use report::run_files;
use study::truck::WEDGE_NAMES;
use study::truck::run::TruckResult;

use crate::three_piece::{Basis, Check, Sensitivity, TruckFindings};

/// The page's file name.
pub const FILE_NAME: &str = "truck.html";

/// The contents of the page.
#[derive(Clone, Copy, Debug)]
pub struct TruckContents<'c> {
    /// The rigs.
    pub rigs: &'c [TruckResult],
    /// Findings from the rigs.
    pub findings: &'c TruckFindings,
    /// The figures.
    pub figures: &'c [(Exhibit, String)],
    /// The data of the interactive part, JSON of [`report::view::View`].
    pub view: &'c str,
}

/// Returns the page as HTML.
#[must_use]
pub fn render(contents: &TruckContents<'_>) -> String {
    let findings = contents.findings;
    let program = contents
        .rigs
        .first()
        .map_or("", |run| run.summary.program.as_str());
    let lead = format!(
        "A bolster, two side frames and four wedges that have mass, on spring nests and adapters, on rigs. \
         Every number here is computed from runs of this report. Computed by {program}."
    );
    let main = html! {
        p { a href=(page::FILE_NAME) { "The friction wedge alone, and the half-truck" } }
        section {
            h2 id="summary" { "In short" }
            @let (massless, others): (Vec<&Check>, Vec<&Check>) =
                findings.checks.iter().partition(|check| check.basis == Basis::MasslessWedge);
            p {
                (massless.iter().filter(|check| check.agrees).count()) " of " (massless.len())
                " numbers agree with massless wedges: their branches are reached only where toe makes the \
                 slope slide by more than the faces give, and in warp empirical springs stand for them. "
                (others.iter().filter(|check| check.agrees).count()) " of " (others.len())
                " others, from closed forms and an independent calculation, agree."
            }
            @let apart: Vec<&&Check> = others.iter().filter(|check| !check.agrees).collect();
            @if !apart.is_empty() {
                ul {
                    @for check in apart {
                        li { (capital(&check.what)) ": " (difference(check)) ". " (check.remark) }
                    }
                }
            }
            p { (sentence(&findings.sensitivities)) }
        }
        @for basis in Basis::ALL { (checks(basis, &findings.checks)) }
        (sensitivities(&findings.sensitivities))
        (energies(contents.rigs))
        section {
            h2 id="figures" { "Loops and states" }
            @for (exhibit, svg) in contents.figures { (shown_in(exhibit, svg, Some(super::FIGURES))) }
        }
        (runs(contents))
    };
    document(
        "The three-piece truck on its rigs",
        &lead,
        None,
        &main,
        Some(contents.view),
    )
}

fn percent(value: f64) -> String {
    let text = format!("{:+.1} %", value);
    if text == "-0.0 %" {
        "0.0 %".to_owned()
    } else {
        text.replace('-', "\u{2212}")
    }
}

/// Returns the difference from the expected value, in words.
fn difference(check: &Check) -> String {
    if check.expected == [0.0; 2] {
        return format!("{:.1e}", check.difference);
    }
    percent(100.0 * check.difference)
}

fn expected(check: &Check) -> String {
    let [low, high] = check.expected;
    if low == high {
        digits_of(low)
    } else {
        format!("{} to {}", digits_of(low), digits_of(high))
    }
}

/// Digits that show a difference of a thousandth.
fn digits_of(value: f64) -> String {
    let size = value.abs();
    if (1e-3..100.0).contains(&size) {
        let decimals = if size >= 10.0 { 2 } else { 4 };
        format!("{value:.decimals$}").replace('-', "\u{2212}")
    } else {
        digits(value)
    }
}

fn checks(basis: Basis, all: &[Check]) -> Markup {
    let own: Vec<&Check> = all.iter().filter(|check| check.basis == basis).collect();
    html! {
        @if !own.is_empty() {
            section {
                h2 { (basis.heading()) }
                @if basis == Basis::MasslessWedge {
                    p {
                        "Steady sliding of a wedge without mass under the coil's force of that moment (eq. \
                         5-1 of Steets 2007 put right), beside the truck's wedges where the bolster passes \
                         the middle of its stroke in the last cycle. Then the same rigs with massless \
                         wedges in the truck, in warp with NUCARS's empirical springs."
                    }
                }
                div.wide {
                    table {
                        thead {
                            tr {
                                th scope="col" { "what" }
                                th.number scope="col" { "found" }
                                th.number scope="col" { "expected" }
                                th scope="col" { "unit" }
                                th.number scope="col" { "difference" }
                                th scope="col" { "agrees" }
                                th scope="col" { "remark" }
                            }
                        }
                        tbody {
                            @for check in own {
                                tr {
                                    th scope="row" { (check.what) }
                                    td.number { (digits_of(check.found)) }
                                    td.number { (expected(check)) }
                                    td.unit { (check.unit) }
                                    td.number { (difference(check)) }
                                    td { @if check.agrees { "yes" } @else { "no" } }
                                    td { (check.remark) }
                                }
                            }
                        }
                    }
                }
            }
        }
    }
}

/// Returns the sentence on results that depend on stiffnesses that are decided, and by how much.
fn sentence(all: &[Sensitivity]) -> String {
    let most = |of: fn(&Sensitivity) -> f64| all.iter().max_by(|a, b| of(a).abs().total_cmp(&of(b).abs()));
    match (most(|own| own.contacts), most(|own| own.bristles)) {
        (Some(contacts), Some(bristles)) => format!(
            "Contacts of twice the stiffness move the answers by up to {} ({}: {}), bristles of twice the \
             stiffness by up to {} ({}: {}).",
            percent(contacts.contacts),
            contacts.rig,
            contacts.answer,
            percent(bristles.bristles),
            bristles.rig,
            bristles.answer
        ),
        _ => String::new(),
    }
}

fn sensitivities(all: &[Sensitivity]) -> Markup {
    html! {
        @if !all.is_empty() {
            section {
                h2 id="stiffness" { "What hangs on the stiffness of contacts and bristles" }
                p {
                    "Both are decided, not measured: 250,000 lbf/in a corner, 1,000,000 lbf/in a face. \
                     Where a nest locks, or a slope sticks, they are part of the answer."
                }
                div.wide {
                    table {
                        thead {
                            tr {
                                th scope="col" { "rig" }
                                th scope="col" { "answer" }
                                th.number scope="col" { "value" }
                                th scope="col" { "unit" }
                                th.number scope="col" { "contacts twice as stiff" }
                                th.number scope="col" { "bristles twice as stiff" }
                            }
                        }
                        tbody {
                            @for own in all {
                                tr {
                                    th scope="row" { (own.rig) }
                                    td { (own.answer) }
                                    td.number { (digits(own.value)) }
                                    td.unit { (own.unit) }
                                    td.number { (percent(own.contacts)) }
                                    td.number { (percent(own.bristles)) }
                                }
                            }
                        }
                    }
                }
            }
        }
    }
}

/// Energy lost a cycle by wedge and face.
fn energies(rigs: &[TruckResult]) -> Markup {
    let unit = rigs
        .first()
        .map_or("", |run| Kind::Energy.label(run.summary.units));
    let cell = |value: Option<f64>| {
        value.map_or("–".to_owned(), |value| {
            format!("{value:.0}").replace('-', "\u{2212}")
        })
    };
    html! {
        section {
            h2 id="energies" { "Energy a cycle takes, wedge by wedge" }
            p { "Lost in friction at column and slope, " (unit) " a cycle, from the second cycle on; drops \
                have none." }
            div.wide {
                table {
                    thead {
                        tr {
                            th scope="col" { "rig" }
                            @for wedge in WEDGE_NAMES {
                                th.number scope="col" {
                                    (wedge.replace('_', " ")) br; span.unit { "column, slope" }
                                }
                            }
                            th.number scope="col" { "all elements" }
                        }
                    }
                    tbody {
                        @for run in rigs {
                            @let summary = &run.summary;
                            @let losses = &summary.cycles.losses;
                            @if !losses.is_empty() {
                                tr {
                                    th scope="row" {
                                        a href={ "#run-" (anchor(&summary.name)) } { (summary.name) }
                                    }
                                    @for wedge in WEDGE_NAMES {
                                        td.number {
                                            (cell(summary.cycles.loss_at(wedge, "column"))) ", "
                                            (cell(summary.cycles.loss_at(wedge, "slope")))
                                        }
                                    }
                                    td.number { (cell(Some(losses.values().map(|loss| loss.value).sum()))) }
                                }
                            }
                        }
                    }
                }
            }
        }
    }
}

/// Returns the rigs: open one to see it move.
fn runs(contents: &TruckContents<'_>) -> Markup {
    html! {
        section {
            h2 id="runs" { "Rig by rig" }
            p { "Open a rig to see the truck move in 3D, with its plots on the same clock." }
            @for run in contents.rigs {
                @let summary = &run.summary;
                (doubts(summary))
                details id={ "run-" (anchor(&summary.name)) } data-run=(summary.name) {
                    summary { (summary.name) ": " (summary.title) }
                    p {
                        "Ledger residual " (format!("{:.1e}", summary.ledger.largest_relative_residual)) ", "
                        (summary.statistics.steps) " steps. Files: "
                        @for name in run_files::NAMES {
                            a href={ "runs/" (summary.name) "/" (name) } { (name) } " "
                        }
                    }
                }
            }
            p { "Rigs that reach lands, gibs, solid coils, pocket sides and adapter stops: \
                 " code { "wedgelab run NAME" } ", each with a \
                page of its own." }
        }
    }
}
