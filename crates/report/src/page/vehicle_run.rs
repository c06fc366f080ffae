//! The page of one run of a vehicle.

use maud::{Markup, html};
use study::vehicle::VehicleCase;
use study::vehicle::run::VehicleResult;
use study::vehicle::summary::VehicleSummary;

use super::by_rules::by_rules;
use super::table::{self, Head};
use super::{figures, in_unit, ledger_note, run_page};
use crate::figures::digits;
use crate::figures::vehicle::exhibits;
use crate::view::run::{Detail, Recording};

/// Returns the page as HTML; it needs nothing else to be shown.
///
/// # Errors
/// Errors of the JSON writer.
pub fn render(case: &VehicleCase, result: &VehicleResult) -> Result<String, serde_json::Error> {
    let summary = &result.summary;
    let exhibits = exhibits(result);
    let recording = Recording::of_vehicle(case, result, Detail::Thinned);
    let sections = html! {
        (by_rules(summary))
        section { h2 { "Natural vibrations" } (vibrations(summary)) }
        section { h2 { "At the start" } (start(summary)) }
        section { h2 { "Energy" } (energy(summary)) }
        (figures(&exhibits))
    };
    run_page(
        summary,
        &summary.title,
        "a vehicle of bodies and elements",
        (recording, &exhibits),
        &sections,
    )
}

fn vibrations(summary: &VehicleSummary) -> Markup {
    html! {
        @if summary.vibrations.is_empty() {
            p { "Nothing vibrates about the rest." }
        } @else {
            p {
                "Of the equations linearized about the rest, or the nominal layout if the run starts \
                 there; what is open or slips there does not hold. A \
                 negative damping ratio grows."
            }
            table {
                thead {
                    tr {
                        th.number scope="col" { "frequency" br; span.unit { "Hz" } }
                        th.number scope="col" { "damping ratio" }
                    }
                }
                tbody {
                    @for own in &summary.vibrations {
                        tr {
                            td.number { (digits(own.frequency_hz)) }
                            td.number { (format!("{:.4}", own.damping_ratio)) }
                        }
                    }
                }
            }
        }
    }
}

fn start(summary: &VehicleSummary) -> Markup {
    let heads = [Head::Words("force"), Head::Numbers("at the start")];
    let rows = summary.forces_at_start.iter();
    let rows = rows.map(|(name, own)| [name.replace('_', " "), in_unit(own.value, &own.unit)]);
    html! {
        @if summary.forces_at_start.is_empty() {
            p { "No element carries a force." }
        } @else {
            (table::narrow(&heads, rows))
        }
    }
}

fn energy(summary: &VehicleSummary) -> Markup {
    html! {
        table {
            tbody {
                @for (name, own) in &summary.ledger.entries {
                    tr {
                        th scope="row" { (name.replace('_', " ")) }
                        td.number { (digits(own.value)) " " (own.unit) }
                    }
                }
            }
        }
        (ledger_note(summary))
    }
}
