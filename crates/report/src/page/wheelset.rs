//! The page of one wheelset's run.

use maud::{Markup, html};
use quantity::Kind;
use study::wheelset::WheelsetCase;
use study::wheelset::run::WheelsetResult;
use study::wheelset::summary::WheelsetSummary;

use super::table::{self, Head};
use super::{figures, ledger_note, run_page};
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
    let sections = html! {
        section { h2 { "In numbers" } (numbers(summary)) }
        (figures(&exhibits))
        section {
            h2 { "Given" }
            table {
                tbody {
                    @for (name, value) in &summary.given { tr { th scope="row" { (name) } td { (value) } } }
                }
            }
        }
    };
    let heading = format!("A wheelset on the track {}", case.wheelset.track.name);
    let what = "one wheelset under a carriage";
    run_page(summary, &heading, what, (recording, &exhibits), &sections)
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
    let heads = [
        Head::Words("wheel"),
        Head::InUnit("vertical, least", force),
        Head::InUnit("vertical, largest", force),
        Head::InUnit("lateral, largest", force),
        Head::Numbers("L/V, largest"),
        Head::InUnit("wear number, largest", force),
    ];
    let rows = ["left", "right"].map(|side| {
        let number = |value: Option<f64>, decimals: usize| {
            value.map_or(String::new(), |value| format!("{value:.decimals$}"))
        };
        let largest = |what: &str, kind: Kind| of(side, what, kind).map(|found| found.maximum);
        let least = of(side, "vertical_force", Kind::Force).map(|found| found.minimum);
        [
            side.to_owned(),
            number(least, 0),
            number(largest("vertical_force", Kind::Force), 0),
            number(largest("lateral_force", Kind::Force), 0),
            number(largest("lateral_over_vertical", Kind::Dimensionless), 3),
            number(largest("wear_number", Kind::Force), 1),
        ]
    });
    html! {
        (table::wide(&heads, rows))
        @if let Some(hunting) = &summary.hunting {
            p {
                "About steady rolling at this speed on straight perfect track the least damped lateral \
                 vibration has "
                (format!("{:.2}", hunting.frequency_hz)) " Hz and a damping ratio of "
                (format!("{:.3}", hunting.damping_ratio))
                @if hunting.damping_ratio < 0.0 { ": the wheelset hunts." } @else { ": it dies out." }
            }
        }
        (ledger_note(summary))
    }
}
