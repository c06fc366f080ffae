//! The page of one wheelset's run.

use maud::{Markup, html};
use quantity::Kind;
use study::wheelset::WheelsetCase;
use study::wheelset::run::WheelsetResult;
use study::wheelset::summary::WheelsetSummary;

use super::{data_of, document, ledger_note, moving, shown_in};
use crate::figures::wheelset::exhibits;
use crate::view::run::{Detail, Recording};

/// Returns the page as HTML; it needs nothing else to be shown.
///
/// # Errors
/// Errors of the JSON writer.
pub fn render(case: &WheelsetCase, result: &WheelsetResult) -> Result<String, serde_json::Error> {
    let summary = &result.summary;
    let exhibits = exhibits(case, result);
    let recording = Recording::of_wheelset(case, result, Detail::Thinned);
    let data = data_of(summary.units, recording, &exhibits)?;
    let lead = format!(
        "The run {} of one wheelset under a carriage. Computed by {}.",
        summary.name, summary.program
    );
    let main = html! {
        (super::doubts(summary))
        (moving(&summary.name))
        section { h2 { "In numbers" } (numbers(summary)) }
        section {
            h2 { "Figures" }
            @for exhibit in &exhibits { (shown_in(exhibit, &exhibit.figure.to_svg(), None)) }
        }
        section {
            h2 { "Given" }
            table {
                tbody {
                    @for (name, value) in &summary.given { tr { th scope="row" { (name) } td { (value) } } }
                }
            }
        }
        section { h2 { "Assumptions" } ul { @for text in &summary.assumptions { li { (text) } } } }
    };
    let heading = format!("A wheelset on the track {}", case.wheelset.track.name);
    Ok(document(&heading, &lead, None, &main, Some(&data)))
}

/// Extremes of the wheels, and how the wheelset hunts.
fn numbers(summary: &WheelsetSummary) -> Markup {
    let force = Kind::Force.label(summary.units);
    let suffix = |kind: Kind| match kind.suffix(summary.units) {
        "" => String::new(),
        suffix => format!("_{suffix}"),
    };
    let of =
        |side: &str, what: &str, kind: Kind| summary.extremes.get(&format!("{side}_{what}{}", suffix(kind)));
    html! {
        div.wide {
            table {
                thead {
                    tr {
                        th scope="col" { "wheel" }
                        @for title in ["vertical, least", "vertical, largest", "lateral, largest"] {
                            th.number scope="col" { (title) br; span.unit { (force) } }
                        }
                        th.number scope="col" { "L/V, largest" }
                        th.number scope="col" { "wear number, largest" br; span.unit { (force) } }
                    }
                }
                tbody {
                    @for side in ["left", "right"] {
                        @let vertical = of(side, "vertical_force", Kind::Force);
                        @let lateral = of(side, "lateral_force", Kind::Force);
                        @let ratio = of(side, "lateral_over_vertical", Kind::Dimensionless);
                        @let wear = of(side, "wear_number", Kind::Force);
                        tr {
                            th scope="row" { (side) }
                            td.number { @if let Some(found) = vertical { (format!("{:.0}", found.minimum)) } }
                            td.number { @if let Some(found) = vertical { (format!("{:.0}", found.maximum)) } }
                            td.number { @if let Some(found) = lateral { (format!("{:.0}", found.maximum)) } }
                            td.number { @if let Some(found) = ratio { (format!("{:.3}", found.maximum)) } }
                            td.number { @if let Some(found) = wear { (format!("{:.1}", found.maximum)) } }
                        }
                    }
                }
            }
        }
        @if let Some(hunting) = &summary.hunting {
            p {
                "About steady rolling at this speed on straight perfect track the least damped lateral \
                 vibration has "
                (format!("{:.2}", hunting.frequency_hz)) " Hz and a damping ratio of "
                (format!("{:.3}", hunting.damping_ratio))
                @if hunting.damping_ratio < 0.0 { ": the wheelset hunts." } @else { ": it dies out." }
            }
        }
        (ledger_note(summary.ledger.largest_relative_residual, summary.statistics.steps))
    }
}
