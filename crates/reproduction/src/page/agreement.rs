//! The agreement of the models, and the table of the half-truck's runs.

use maud::{Markup, html};
use quantity::{Kind, System as Units};
use report::figures::{capital, digits};
use report::page::FAILED;
use study::energy;
use study::metrics::{WINDOWS, window_of};
use study::plausibility;
use study::summary::{RunSummary, SummaryValue};

use crate::agreement::{AgreementGroup, COMPONENT, TruckOutcome, mean_yaw, percent};

/// The comparison with the comparison program's wedges.
#[derive(Clone, Copy, Debug)]
pub struct Comparison<'c> {
    /// The agreement of the models.
    pub groups: &'c [AgreementGroup],
    /// All runs of the half-truck.
    pub trucks: &'c [TruckOutcome],
    /// Units of the numbers.
    pub units: Units,
}

/// The text before the tables.
const ABOUT: &str = "The thesis compares its wedge with types 6.8 and 6.9 of the comparison program, which \
                     are massless: friction of the column and coil in balance at every instant. No output \
                     of that program is at hand. What is compared here is our reading of these types, in \
                     the half-truck of the thesis's files: a bolster with load on two side frames, with \
                     four wedges, of which the leading left one (connection 127) is looked at. All with toe \
                     out.";

/// Returns the section; nothing without half-trucks.
pub(super) fn section(comparison: &Comparison<'_>) -> Markup {
    html! {
        section {
            h2 id="agreement" { "How far the models agree" }
            p { (ABOUT) }
            p {
                "Means: the column's friction on the side frame, positive up, over the branches in which \
                 the bolster goes up or down. Energy: lost at the column per cycle. Loop: the area of that \
                 friction over the wedge's displacement (stand-alone model) or the stroke (types). Closed \
                 form: eq. 5-1 put right, under the input's full stroke. In brackets: how much more than \
                 the stand-alone model."
            }
            @for group in comparison.groups { (agreement(group, comparison.units)) }
            @if !comparison.trucks.is_empty() { (trucks(comparison.trucks)) }
        }
    }
}

fn agreement(group: &AgreementGroup, units: Units) -> Markup {
    let yaw = if group.yawed { "with yaw" } else { "without yaw" };
    let kinds = [Kind::Force, Kind::Force, Kind::Energy, Kind::Energy];
    let window = window_of(group.damping);
    let names = [
        &format!("mean force up, {window}"),
        &format!("mean force down, {window}"),
        "energy per cycle",
        "loop area",
    ];
    html! {
        h3 { (capital(group.damping.name())) " damping, " (yaw) }
        div.wide {
            table {
                thead {
                    tr {
                        th scope="col" { "model" }
                        @for (name, kind) in names.into_iter().zip(kinds) {
                            th.number scope="col" { (name) br; span.unit { (kind.label(units)) } }
                        }
                    }
                }
                tbody {
                    @for numbers in &group.models {
                        @let over = numbers.over(&group.models[0]);
                        tr {
                            th scope="row" { (numbers.model.name()) }
                            @for ((value, kind), over) in numbers.values().into_iter().zip(kinds).zip(over) {
                                td.number {
                                    (digits(value * kind.from_si(units)))
                                    @if numbers.model != group.models[0].model { " (" (percent(over)) ")" }
                                }
                            }
                        }
                    }
                }
            }
        }
        @if !group.remarks.is_empty() {
            ul { @for remark in &group.remarks { li { (remark) } } }
        }
    }
}

fn trucks(trucks: &[TruckOutcome]) -> Markup {
    let unit = |of: fn(&TruckOutcome) -> Option<&SummaryValue>| {
        let found = trucks.iter().find_map(of);
        found.map_or(String::new(), |measure| measure.unit.clone())
    };
    let cell =
        |measure: Option<&SummaryValue>| measure.map_or("–".to_owned(), |m| format!("{:.1}", m.value));
    html! {
        h3 { "All runs of the half-truck" }
        p {
            "Wedge 127. Mean force: column friction on the side frame over the window that is named; "
            (WINDOWS) ". Type 6.8 has no angle: no toe and toe out are the same to it. The yawed input as \
             printed hardly yaws; as intended the springs against it are taken out, and a slow undamped \
             swing about the mean stays. Jammed: share of the time in which no steady sliding exists and \
             only the limit of the files holds the normal force. Ledger residual: the largest at any output \
             time, over the largest of work, losses and change of stored energy."
        }
        div.wide {
            table {
                thead {
                    tr {
                        th scope="col" { "run" }
                        th scope="col" { "window of mean force" }
                        th.number scope="col" { "mean force, up" br; span.unit { (unit(up)) } }
                        th.number scope="col" { "mean force, down" br; span.unit { (unit(down)) } }
                        th.number scope="col" { "energy per cycle" br; span.unit { (unit(energy)) } }
                        th.number scope="col" { "jammed" br; span.unit { "%" } }
                        th.number scope="col" { "largest normal force" br; span.unit { (unit(normal)) } }
                        th.number scope="col" { "mean yaw" br; span.unit { "rad" } }
                        th.number scope="col" { "ledger residual" br; span.unit { "relative" } }
                        th.number scope="col" { "steps" }
                    }
                }
                tbody {
                    @for outcome in trucks {
                        @let (entry, result) = outcome;
                        @let summary = &result.summary;
                        tr {
                            th scope="row" { (entry.name()) }
                            td { (window(outcome)) }
                            td.number { (cell(up(outcome))) }
                            td.number { (cell(down(outcome))) }
                            td.number { (cell(energy(outcome))) }
                            td.number {
                                @if let Some(wedge) = summary.wedges.get(COMPONENT) {
                                    (format!("{:.1}", 100.0 * wedge.jammed))
                                }
                            }
                            td.number { (cell(normal(outcome))) }
                            td.number {
                                @if let Some(yaw) = mean_yaw(result) {
                                    (format!("{yaw:.1e}").replace('-', "\u{2212}"))
                                }
                            }
                            td.number { (format!("{:.1e}", summary.largest_relative_residual)) }
                            td.number { (summary.statistics.steps) }
                        }
                    }
                }
            }
        }
        @for (entry, result) in trucks {
            @let outcome = result.summary.outcome();
            @if let (Some(_), Some(told)) = (outcome.end(), outcome.told()) {
                p.warning { (entry.name()) " " (told) }
            }
            @let warnings = &result.summary.warnings;
            @for warning in energy::among(warnings).chain(plausibility::among(warnings)) {
                p.warning { (entry.name()) ": " (warning) }
            }
            @if result.summary.failed.is_some() {
                p.warning { (entry.name()) (FAILED) }
            }
        }
    }
}

fn window((_, result): &TruckOutcome) -> &str {
    let wedge = result.summary.wedges.get(COMPONENT);
    wedge.map_or("", |wedge| &wedge.window)
}

fn up((_, result): &TruckOutcome) -> Option<&SummaryValue> {
    result.summary.wedges.get(COMPONENT)?.up.as_ref()
}

fn down((_, result): &TruckOutcome) -> Option<&SummaryValue> {
    result.summary.wedges.get(COMPONENT)?.down.as_ref()
}

fn energy((_, result): &TruckOutcome) -> Option<&SummaryValue> {
    result.summary.wedges.get(COMPONENT)?.energy_per_cycle.as_ref()
}

fn normal((_, result): &TruckOutcome) -> Option<&SummaryValue> {
    result
        .summary
        .wedges
        .get(COMPONENT)?
        .largest_normal_force
        .as_ref()
}
