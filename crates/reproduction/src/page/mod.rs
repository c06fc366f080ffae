//! The page of the reproduction, `index.html`: the thesis's runs, its statements with verdicts, all figures.
//! [`truck`] is the page of the three-piece truck beside it.

mod agreement;
mod claims;
mod overview;
mod runs;
mod sensitivity;
pub mod truck;

use maud::{Markup, html};
use report::figures::CaseOutcome;
use report::page::{anchor, document, shown_in};

use crate::claims::Claims;
use crate::sections::Section;
use crate::sensitivity::Sensitivity;

pub use agreement::Comparison;

/// The folder of the figures' files, beside the page.
pub const FIGURES: &str = "figures";

/// The contents of the page.
#[derive(Clone, Copy, Debug)]
pub struct Contents<'c> {
    /// The runs of the thesis.
    pub outcomes: &'c [CaseOutcome],
    /// The runs beyond it.
    pub beyond: &'c [CaseOutcome],
    /// The thesis's statements and what was found.
    pub claims: &'c Claims,
    /// The parts of the space of what the thesis leaves open in which they hold, if points of it were run.
    pub sensitivity: Option<&'c Sensitivity>,
    /// The figures.
    pub sections: &'c [Section],
    /// The data of the interactive part, JSON of [`report::view::View`].
    pub view: &'c str,
    /// The comparison with the comparison program's wedges, if there is one.
    pub comparison: Option<Comparison<'c>>,
    /// True if the page of the three-piece truck is in the same folder.
    pub truck: bool,
}

/// Returns the page as HTML.
#[must_use]
pub fn render(contents: &Contents<'_>) -> String {
    let program = contents
        .outcomes
        .iter()
        .chain(contents.beyond)
        .next()
        .map_or(String::new(), |(_, result)| result.summary.program.clone());
    let (open, folded): (Vec<&Section>, Vec<&Section>) =
        contents.sections.iter().partition(|section| !section.folded);
    let lead = html! {
        "One friction wedge of a three-piece truck between the column of the side frame and the slope of \
         the bolster: a rigid body with unilateral contact, stick-slip friction and its control coil. \
         Computed by "
        (program) "."
    };
    let nav = html! {
            ul {
                @if !(contents.outcomes.is_empty() && contents.beyond.is_empty()) {
                    li { a href="#short" { "In short" } }
                }
                @if !contents.outcomes.is_empty() { li { a href="#runs" { "Runs" } } }
                @if !contents.claims.claims.is_empty() { li { a href="#found" { "What she found, and what \
                holds" } } }
                @if contents.sensitivity.is_some() { li { a href="#open" { "What the thesis leaves open" } } }
                @if !contents.claims.claims.is_empty() {
                    li { a href="#contradicts" { "Where the thesis contradicts itself" } }
                    li { a href="#claims" { "The thesis's statements, one by one" } }
                }
                @if contents.comparison.is_some() { li { a href="#agreement" { "How far the models \
                                                                                agree" } } }
                @for section in &open { li { a href={ "#" (anchor(&section.id)) } { (section.title) } } }
                @if !folded.is_empty() { li { a href="#run-by-run" { "Run by run" } } }
                @if contents.truck { li { a href=(truck::FILE_NAME) { "The three-piece truck (a page of its \
                    own)" } } }
                li { a href="#assumptions" { "Assumptions" } }
                li { a href="#files" { "Files" } }
            }
    };
    let main = html! {
        (overview::section(contents))
        (runs::table(contents.outcomes))
        (claims::held(contents.claims, contents.sensitivity))
        @if let Some(found) = contents.sensitivity { (sensitivity::section(found)) }
        (claims::contradictions(contents.claims))
        (claims::tables(contents.claims, contents.sensitivity))
        @if let Some(comparison) = &contents.comparison { (agreement::section(comparison)) }
        @for section in &open {
            section {
                h2 id=(anchor(&section.id)) { (section.title) }
                (body(section))
            }
        }
        @if !folded.is_empty() {
            section {
                h2 id="run-by-run" { "Run by run" }
                p { "Open a run to see it move in 3D, with its plots on the same clock." }
                p {
                    "Of the thesis's runs, what the thesis does not show: the energy ledger, the state of \
                     each contact, the forces at the corners, how much of the contact sticks, and the power \
                     that wears the faces."
                }
                @for sections in folded.chunk_by(|a, b| a.group == b.group) {
                    @if !sections[0].group.is_empty() { h3 { (sections[0].group) } }
                    @for section in sections {
                        details id=(anchor(&section.id)) data-run=[section.run.as_deref()] {
                            summary { (section.title) }
                            (body(section))
                        }
                    }
                }
            }
        }
        (runs::assumptions(contents))
        (runs::files(contents))
    };
    document(
        "Friction wedge: the runs of Steets (2007)",
        &lead,
        Some(&nav),
        &main,
        Some(contents.view),
    )
}

fn body(section: &Section) -> Markup {
    html! {
        @if !section.intro.is_empty() { p { (section.intro) } }
        @for (exhibit, svg) in section.exhibits.iter().zip(&section.svgs) {
            (shown_in(exhibit, svg, Some(FIGURES)))
        }
    }
}
