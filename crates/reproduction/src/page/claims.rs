//! The thesis's statements with their verdicts.

use maud::{Markup, html};
use report::page::anchor;

use super::sensitivity::extent;
use crate::claims::{CONTRADICTIONS, ClaimGroup, ClaimRow, ClaimVerdict, Claims, REQUIRED, ShownValue};
use crate::sensitivity::{Extent, Sensitivity};

/// Returns what she found and what holds: of the conclusions, and of what her wedge must show, the statements
/// that hold over all that is open, or, without points of that, in these runs.
pub(super) fn held(claims: &Claims, sensitivity: Option<&Sensitivity>) -> Markup {
    if claims.claims.is_empty() {
        return html! {};
    }
    let counts = |row: &&ClaimRow| {
        let told = row.group == ClaimGroup::Conclusions || REQUIRED.contains(&row.id);
        told && match sensitivity.and_then(|found| found.statement(row.id)) {
            Some(statement) => matches!(statement.extent, Extent::Always | Extent::Mostly),
            None => row.verdict == ClaimVerdict::Holds,
        }
    };
    let how = match sensitivity {
        Some(_) => "always or mostly, over all that the thesis leaves open",
        None => "in these runs, with one choice of all that the thesis leaves open",
    };
    html! {
        section {
            h2 id="found" { "What she found, and what holds" }
            p {
                "Of her conclusions, and of what a wedge like hers must show, these hold " (how) ":"
            }
            ul {
                @for row in claims.claims.iter().filter(counts) {
                    li {
                        a href={ "#claim-" (anchor(row.id)) } { (row.statement) }
                        " (" (row.place) ")"
                    }
                }
            }
        }
    }
}

/// Returns what contradicts itself.
pub(super) fn contradictions(claims: &Claims) -> Markup {
    if claims.claims.is_empty() {
        return html! {};
    }
    html! {
        section {
            h2 id="contradicts" { "Where the thesis contradicts itself" }
            div.wide {
                table {
                    thead {
                        tr {
                            th scope="col" { "where" }
                            th scope="col" { "what it says" }
                            th scope="col" { "here" }
                        }
                    }
                    tbody {
                        @for own in CONTRADICTIONS {
                            tr { td { (own.places) } td { (own.says) } td { (own.here) } }
                        }
                    }
                }
            }
        }
    }
}

/// Returns the tables, one a group, folded; nothing without claims.
pub(super) fn tables(claims: &Claims, sensitivity: Option<&Sensitivity>) -> Markup {
    if claims.claims.is_empty() {
        return html! {};
    }
    html! {
        section {
            h2 id="claims" { "The thesis's statements, one by one" }
            @if let Some(found) = sensitivity {
                @let [always, mostly, seldom, never, open] = found.extents;
                p {
                    "What chapters 5 to 7 say of the stand-alone runs, in our words. Over \
                     " (found.points) " points of "
                    a href="#open" { "what the thesis leaves \
                                      open" } ", " strong { (always) } " statements hold always, "
                    strong { (mostly) } " mostly, "
                    strong { (seldom) } " seldom, " strong { (never) } " never, and "
                    strong { (open) } " cannot be decided from runs. These are the verdicts. What the runs \
                                       of this report show, with one choice of all that is open, stands \
                                       beside them:"
                }
            } @else {
                p {
                    "What chapters 5 to 7 say of the stand-alone runs, in our words, with one choice of all \
                     that the thesis leaves open; "
                    code { "wedgelab reproduce --sensitivity 200" } " says how far the verdicts hang on it."
                }
            }
            p {
                "These runs show that "
                strong { (claims.hold) } " statements hold, " strong { (claims.do_not) } " do not, and "
                strong { (claims.undecided) } " cannot be decided from these runs. Each has a predicate, \
                                               evaluated from the runs' tables when this page was made; \
                                               below it stands the code that was evaluated. A statement \
                                               that does not hold is a finding, not a fault of the page."
            }
            p {
                "Where the thesis gives no number: \u{201c}small\u{201d}, \u{201c}similar\u{201d} \
                 and \u{201c}close\u{201d} mean within 10 %, \u{201c}zero\u{201d} below 1 % of the peak. \
                 Chapter 5's vertical force is the one that its figures draw: the vertical force on the \
                 side frame, coil included; chapter 6's is the column's friction."
            }
            @for group in ClaimGroup::ALL {
                @let rows: Vec<&ClaimRow> = claims.claims.iter().filter(|row| row.group == group).collect();
                @if !rows.is_empty() { (table(group, &rows, sensitivity)) }
            }
        }
    }
}

fn table(group: ClaimGroup, rows: &[&ClaimRow], sensitivity: Option<&Sensitivity>) -> Markup {
    html! {
        details {
            summary { (group.title()) ": " (counted(rows)) }
            div.wide {
                table {
                    thead {
                        tr {
                            th scope="col" { "where" }
                            th scope="col" { "statement" }
                            th scope="col" { "predicate" }
                            @if sensitivity.is_some() { th scope="col" { "over what is open" } }
                            th scope="col" { "found, as decided" }
                            th scope="col" { "verdict, as decided" }
                        }
                    }
                    tbody {
                        @for row in rows {
                            tr id={ "claim-" (anchor(row.id)) } {
                                td { (row.place) }
                                td { (row.statement) }
                                td {
                                    (row.predicate)
                                    @if !row.code.is_empty() { br; code { (row.code) } }
                                }
                                @if let Some(found) = sensitivity {
                                    td {
                                        @if let Some(own) = found.statement(row.id) { (extent(own)) }
                                    }
                                }
                                td {
                                    @for (number, value) in row.values.iter().enumerate() {
                                        @if number > 0 { br; }
                                        (value.label) ":\u{a0}" (shown(value))
                                    }
                                }
                                td {
                                    span class={ "verdict " (class(row.verdict)) } { (row.verdict.words()) }
                                    @if !row.note.is_empty() { br; (row.note) }
                                }
                            }
                        }
                    }
                }
            }
        }
    }
}

/// Returns how many hold, do not, and are undecided.
fn counted(rows: &[&ClaimRow]) -> String {
    let count = |verdict| rows.iter().filter(|row| row.verdict == verdict).count();
    format!(
        "{} hold, {} do not, {} cannot be decided",
        count(ClaimVerdict::Holds),
        count(ClaimVerdict::DoesNot),
        count(ClaimVerdict::CannotBeDecided)
    )
}

fn class(verdict: ClaimVerdict) -> &'static str {
    match verdict {
        ClaimVerdict::Holds => "holds",
        ClaimVerdict::DoesNot => "fails",
        ClaimVerdict::CannotBeDecided => "open",
    }
}

/// Returns a value with its unit, to four digits.
fn shown(value: &ShownValue) -> String {
    let number = report::figures::digits(value.measure.value);
    match value.measure.unit.as_str() {
        "" => number,
        unit => format!("{number}\u{a0}{unit}"),
    }
}
