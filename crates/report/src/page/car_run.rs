//! The page of one run of a car: what it looks like, its limits and statistics, figures over the distance,
//! assumptions.

use maud::{Markup, html};
use study::car::summary::CarSummary;
use study::summary::{RunSummary, SummaryValue};

use super::{data_of, ledger_note, moving, run_page, shown_in, statics};
use crate::figures::car::{CarRun, exhibits};
use crate::figures::digits;
use crate::view::run::{Detail, Recording};

/// Returns the page as HTML; it needs nothing else to be shown.
///
/// # Errors
/// Errors of the JSON writer.
pub fn render(run: &CarRun) -> Result<String, serde_json::Error> {
    let summary = &run.result.summary;
    let exhibits = exhibits(run);
    let recording = Recording::of_car(&run.case, &run.result, run.motions.as_ref(), Detail::Thinned);
    let data = data_of(summary.units, recording, &exhibits)?;
    let main = html! {
        (super::doubts(summary))
        (moving(&summary.name))
        section { h2 { "Limits" } (limits(summary)) }
        section { h2 { "Statistics" } (statistics(summary)) }
        section {
            h2 { "Figures" }
            @for exhibit in &exhibits { (shown_in(exhibit, &exhibit.figure.to_svg(), None)) }
        }
        section { h2 { "At the start" } (statics::section(&summary.statics, summary.units)) }
        section { h2 { "Wedges" } (wedges(summary)) }
        section { h2 { "Assumptions" } ul { @for text in &summary.assumptions { li { (text) } } } }
    };
    let title_and_program = (summary.title.as_str(), summary.program.as_str());
    Ok(run_page(
        summary,
        title_and_program,
        "a freight car on track",
        &main,
        &data,
    ))
}

/// Returns the sentence above numbers that are not of the whole run.
fn partial(summary: &CarSummary) -> Markup {
    html! { @if let Some(text) = summary.outcome().numbers() { p.warning { (text) } } }
}

fn limits(summary: &CarSummary) -> Markup {
    html! {
        (partial(summary))
        p {
            "The worst value of each kind beside limits that are remembered of AAR M-1001, chapter XI: \
             check them against your edition of the standard. A limit counts for the regimes named. Margin: \
             what is left, in parts of the limit. Raw values, where rows are too far apart for the filter, \
             have none."
        }
        div.wide {
            table {
                thead {
                    tr {
                        th scope="col" { "quantity" } th scope="col" { "worst at" }
                        th.number scope="col" { "value" } th.number scope="col" { "limit" }
                        th.number scope="col" { "margin" } th scope="col" { "regimes" }
                    }
                }
                tbody {
                    @for own in &summary.limits {
                        tr {
                            th scope="row" { (own.quantity) }
                            td { (own.statistic.replace('_', " ")) }
                            td.number { (digits(own.value)) @if !own.unit.is_empty() { " " (own.unit) } }
                            td.number { (digits(own.limit)) @if !own.unit.is_empty() { " " (own.unit) } }
                            td.number {
                                @if own.unfiltered { "none: raw" }
                                @else { (format!("{:.0} %", 100.0 * own.margin)) }
                            }
                            td { (own.regimes) }
                        }
                    }
                }
            }
        }
    }
}

fn statistics(summary: &CarSummary) -> Markup {
    html! {
        (partial(summary))
        details {
            summary { "All statistics, raw and filtered" }
            div.wide {
                table {
                    thead {
                        tr {
                            th scope="col" { "statistic" } th.number scope="col" { "raw" }
                            th.number scope="col" { "filtered" } th.number scope="col" { "from (s)" }
                        }
                    }
                    tbody {
                        @for (name, own) in &summary.statistics {
                            tr {
                                th scope="row" {
                                    (name.replace('_', " "))
                                    @if !own.remark.is_empty() { " (" (own.remark) ")" }
                                }
                                td.number { (shown(own.raw.as_ref())) }
                                td.number { (shown(own.filtered.as_ref())) }
                                td.number { (own.time.map_or("–".to_owned(), digits)) }
                            }
                        }
                    }
                }
            }
        }
    }
}

/// Returns a value with its unit, a dash if there is none.
fn shown(value: Option<&SummaryValue>) -> String {
    value.map_or("–".to_owned(), |own| match own.unit.as_str() {
        "" => digits(own.value),
        unit => format!("{} {unit}", digits(own.value)),
    })
}

fn wedges(summary: &CarSummary) -> Markup {
    html! {
        p {
            "Energy that the friction of each wedge took at column and slope; its rise in its pocket at the \
             start, as a gauge shows it, the rise at which its control coil has no load there, and the rise \
             that its pocket holds; the normal forces of its column and its slope at the start."
        }
        @if let Some(start) = summary.start_in_words() { p { (start) } }
        div.wide {
            table {
                thead {
                    tr {
                        th scope="col" { "wedge" } th.number scope="col" { "friction energy" }
                        th.number scope="col" { "rise" } th.number scope="col" { "coil without load" }
                        th.number scope="col" { "pocket" }
                        th.number scope="col" { "column" } th.number scope="col" { "slope" }
                    }
                }
                tbody {
                    @for (name, own) in &summary.wedge_losses {
                        @let rise = summary.wedge_rise.get(name);
                        @let start = summary.locked_in.get(name).map(|own| &own.at_start);
                        tr {
                            th scope="row" { (name.replace('_', " ")) }
                            td.number { (shown(Some(own))) }
                            td.number { (shown(rise.map(|own| &own.at_start))) }
                            td.number { (shown(rise.and_then(|own| own.coil_without_load.as_ref()))) }
                            td.number { (shown(rise.map(|own| &own.pocket))) }
                            td.number { (shown(start.map(|own| &own.column))) }
                            td.number { (shown(start.map(|own| &own.slope))) }
                        }
                    }
                }
            }
        }
        (ledger_note(summary.ledger.largest_relative_residual, summary.solver.steps))
    }
}
