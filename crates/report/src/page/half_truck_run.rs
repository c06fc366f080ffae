//! The page of one run of a half-truck: what it looks like, its wedges and their loops, its assumptions.

use maud::{Markup, html};
use quantity::Kind;
use study::contacts::ContactTable;
use study::half_truck::{HalfTruckCase, HalfTruckResult, HalfTruckSummary};
use study::summary::SummaryValue;

use super::table::{self, Head};
use super::{ledger_note, list, run_page, shown_in};
use crate::figures::{Exhibit, axis, curve};
use crate::view::run::{Detail, Recording};
use drawing::{Figure, Panel, distinct};

/// Returns the page as HTML; it needs nothing else to be shown. `contacts` are the corners of wedges that are
/// bodies.
///
/// # Errors
/// Errors of the JSON writer.
pub fn render(
    case: &HalfTruckCase,
    result: &HalfTruckResult,
    contacts: Option<&ContactTable>,
) -> Result<String, serde_json::Error> {
    let summary = &result.summary;
    let exhibit = loops(case, result);
    let recording = Recording::of_truck(case, result, contacts, Detail::Thinned);
    let kind = if case.wedge_bodies.is_empty() {
        "massless wedges"
    } else {
        "wedges that are bodies"
    };
    let sections = html! {
        section { h2 { "Wedges" } (wedges(summary)) }
        section { h2 { "Loops" } (shown_in(&exhibit, &exhibit.figure.to_svg(), None)) }
        @if !case.wedge_notes.is_empty() {
            section { h2 { "Wedges as bodies" } (list(&case.wedge_notes)) }
        }
    };
    let what = format!("a half-truck from files of NUCARS, with {kind}");
    run_page(
        summary,
        &summary.title,
        &what,
        (recording, std::slice::from_ref(&exhibit)),
        &sections,
    )
}

/// Friction and normal force of each wedge's column over its stroke.
#[must_use]
pub fn loops(case: &HalfTruckCase, result: &HalfTruckResult) -> Exhibit {
    let units = result.summary.units;
    let panel = |title: &str, what: &str| {
        Panel::new(
            title,
            axis("stroke", Kind::Length, units),
            axis("force", Kind::Force, units),
            case.wedges().into_iter().enumerate().map(|(number, place)| {
                let (colour, line) = distinct(number);
                let wedge = case.truck.connections[place];
                let [x, y] = ["stroke", what].map(|what| format!("wedge_{wedge}_{what}"));
                curve(result, &x, &y, (&format!("wedge {wedge}"), colour, line))
            }),
        )
    };
    Exhibit::new(
        format!("{}_loops", case.name),
        Figure::new(
            format!("{}: forces of the columns", case.name),
            "Wedge by wedge, over the vertical stroke of the bolster against the side frame: \
                      friction of the column on the side frame, positive up, and the column's normal force.",
            [
                panel("(a) friction", "column_friction"),
                panel("(b) normal force", "column_normal_force"),
            ],
        ),
    )
}

/// Returns the table of a run's wedges.
fn wedges(summary: &HalfTruckSummary) -> Markup {
    let [force, energy] = [Kind::Force, Kind::Energy].map(|kind| kind.label(summary.units));
    let cell = |value: &Option<SummaryValue>| {
        let value = value.as_ref().map(|value| format!("{:.1}", value.value));
        value.unwrap_or_else(|| "–".to_owned()).replace('-', "\u{2212}")
    };
    let heads = [
        Head::Words("wedge"),
        Head::InUnit("friction, up", force),
        Head::InUnit("friction, down", force),
        Head::InUnit("largest normal force", force),
        Head::InUnit("lost in a cycle", energy),
    ];
    let rows = summary.wedges.iter().map(|(number, wedge)| {
        [
            number.clone(),
            cell(&wedge.up),
            cell(&wedge.down),
            cell(&wedge.largest_normal_force),
            cell(&wedge.energy_per_cycle),
        ]
    });
    html! {
        p {
            "Column friction on the side frame, positive up: its mean while the input goes up, and while it \
             goes down; what it takes in a cycle."
        }
        (table::wide(&heads, rows))
        (ledger_note(summary))
    }
}
