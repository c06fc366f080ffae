//! The page of any runs, read back from their folders: seen moving, their key numbers side by side, their
//! curves over each other, limits, energy ledgers, what the numbers rest on, files.

use maud::{Markup, html};
use quantity::System as Units;
use study::each_summary;
use study::summary::SummaryValue;

use super::{anchor, document, moving_as, shown_in};
use crate::figures::side_by_side::exhibits;
use crate::figures::{Exhibit, capital, digits};
use crate::models::ReportSummary;
use crate::run_folder::{KeyNumber, RunFolder, Seen};
use crate::view::View;

/// Returns the page as HTML, which needs nothing else to be shown; `links` are the addresses of the runs'
/// folders from the page.
///
/// # Errors
/// Errors of the JSON writer.
pub fn render(runs: &[RunFolder], links: &[String]) -> Result<String, serde_json::Error> {
    let exhibits = exhibits(runs);
    let seen: Vec<Option<Seen>> = runs.iter().map(RunFolder::seen).collect();
    let have_scene: Vec<Option<bool>> = seen.iter().map(|seen| seen.as_ref().map(has_scene)).collect();
    let data = data(runs, seen, &exhibits)?;
    let (loops, others): (Vec<&Exhibit>, Vec<&Exhibit>) =
        exhibits.iter().partition(|own| own.name.contains("_loop"));
    let main = html! {
        (doubts(runs))
        (views(runs, &have_scene))
        section { h2 id="numbers" { "Key numbers" } (numbers(runs)) }
        @if !loops.is_empty() {
            section {
                h2 id="loops" { "Loops" } @for own in loops { (shown_in(own, &own.figure.to_svg(), None)) }
            }
        }
        (limits(runs))
        @if !others.is_empty() {
            section {
                h2 id="histories" { @if rolls(runs) { "Over time and distance" } @else { "Over time" } }
                @for own in others { (shown_in(own, &own.figure.to_svg(), None)) }
            }
        }
        section { h2 id="ledger" { "Energy ledger" } (ledger(runs)) }
        section { h2 id="assumptions" { "Assumptions" } (assumptions(runs)) }
        section { h2 id="files" { "Files" } (files(runs, links)) }
    };
    let labels: Vec<&str> = runs.iter().map(|run| run.label.as_str()).collect();
    let heading = match runs {
        [one] if !one.summary.shared().title().is_empty() => capital(one.summary.shared().title()),
        [one] => capital(&one.label),
        _ => format!("{} runs: {}", runs.len(), labels.join(", ")),
    };
    Ok(document(&heading, &lead(runs), None, &main, Some(&data)))
}

fn has_scene(seen: &Seen) -> bool {
    match seen {
        Seen::Made(own) => own.has_scene(),
        Seen::Kept(own) => own.has_scene(),
    }
}

fn rolls(runs: &[RunFolder]) -> bool {
    let rolls = |run: &RunFolder| each_summary!(&run.summary, own => own.over_distance());
    runs.iter().any(rolls)
}

/// Returns the data of the interactive part, JSON of [`View`].
fn data(
    runs: &[RunFolder],
    seen: Vec<Option<Seen>>,
    exhibits: &[Exhibit],
) -> Result<String, serde_json::Error> {
    let units = runs.first().map(RunFolder::units).unwrap_or_default();
    let (mut made, mut kept) = (Vec::new(), Vec::new());
    for own in seen.into_iter().flatten() {
        match own {
            Seen::Made(own) => made.push(*own),
            Seen::Kept(own) => kept.push(*own),
        }
    }
    View::new(units, made, exhibits).to_json_with(kept)
}

fn lead(runs: &[RunFolder]) -> Markup {
    let mut programs: Vec<&str> = runs.iter().map(|run| run.summary.shared().program()).collect();
    programs.dedup();
    html! {
        @for (number, run) in runs.iter().enumerate() {
            @let shared = run.summary.shared();
            @if number > 0 { br; }
            strong { (run.label) } ": " (run.what()) ", case " (shared.name())
            @if !shared.title().is_empty() && runs.len() > 1 { " (" (shared.title()) ")" }
            ", " (digits(run.table.times().last().copied().unwrap_or_default())) " s"
        }
        br;
        "Computed by " (programs.join(", ")) "."
        @if runs.iter().any(|run| run.units() != runs[0].units()) {
            " Numbers of all runs are shown in the units of " (runs[0].label) "."
        }
    }
}

/// Returns the list of what makes numbers doubtful, and of what does not fit together.
fn doubts(runs: &[RunFolder]) -> Markup {
    html! {
        @for run in runs {
            (super::doubts_about(&run.label, run.summary.shared()))
            @for note in &run.notes { p.warning { (run.label) ": " (note) } }
        }
    }
}

/// Returns the runs as they move; the first that has a 3D view is open.
fn views(runs: &[RunFolder], have_scene: &[Option<bool>]) -> Markup {
    let open = have_scene
        .iter()
        .position(|scene| *scene == Some(true))
        .or_else(|| have_scene.iter().position(Option::is_some));
    html! {
        section {
            h2 id="moving" { "Moving" }
            @for (number, (run, scene)) in runs.iter().zip(have_scene).enumerate() {
                @match scene {
                    Some(_) => (moving_as(&run.label, &run.label, open == Some(number))),
                    None => p { (run.label) ": no case.toml beside its result.csv says what it looks \
                                             like." },
                }
            }
        }
    }
}

/// Returns the heads of the columns of runs.
fn heads(runs: &[RunFolder]) -> Markup {
    html! { @for run in runs { th.number scope="col" { (run.label) } } }
}

/// Returns a number to four digits.
fn four(value: f64) -> String {
    let size = value.abs();
    let text = if size == 0.0 {
        "0".to_owned()
    } else if (1e-3..1e7).contains(&size) {
        let decimals = (3 - size.log10().floor() as i32).clamp(0, 6) as usize;
        format!("{value:.decimals$}")
    } else {
        format!("{value:.3e}")
    };
    text.replace('-', "\u{2212}")
}

/// Returns the difference from the first, in brackets.
fn over(value: f64, first: f64) -> Option<String> {
    let part = 100.0 * (value - first) / first.abs();
    part.is_finite()
        .then(|| format!("({part:+.1} %)").replace('-', "\u{2212}"))
}

fn numbers(runs: &[RunFolder]) -> Markup {
    let all: Vec<(&str, Vec<KeyNumber>)> = runs
        .iter()
        .map(|run| (run.label.as_str(), run.key_numbers()))
        .collect();
    html! {
        @if runs.len() > 1 {
            p {
                "From the runs' own summaries. In brackets: how much more than in " (runs[0].label)
                ". Where windows differ, each stands below its number."
            }
        } @else { p { "From the run's own summary." } }
        (table(&all, runs[0].units()))
    }
}

/// Returns the key numbers of runs with their names, in these units.
pub(super) fn table(all: &[(&str, Vec<KeyNumber>)], units: Units) -> Markup {
    let mut names: Vec<&str> = Vec::new();
    for number in all.iter().flat_map(|(_, numbers)| numbers) {
        if !names.contains(&number.what.as_str()) {
            names.push(&number.what);
        }
    }
    html! {
        div.wide {
            table {
                thead { tr {
                    th scope="col" { "number" } th scope="col" { "taken over" } th scope="col" { "unit" }
                    @for (label, _) in all { th.number scope="col" { (label) } }
                } }
                tbody {
                    @for name in names {
                        @let own: Vec<Option<&KeyNumber>> =
                            all.iter()
                                    .map(|(_, own)| own.iter().find(|number| number.what == name))
                                    .collect();
                        @let values: Vec<Option<SummaryValue>> =
                            own.iter().map(|one| one.map(|number| number.in_units(units))).collect();
                        @let window = own.iter().flatten().next().map_or("", |number| number.window.as_str());
                        @let same = own.iter().flatten().all(|number| number.window == window);
                        @let unit = values.iter().flatten().next().map_or("", |value| value.unit.as_str());
                        tr {
                            th scope="row" { (name) }
                            td { @if same { (window) } }
                            td.unit { (unit) }
                            @for (number, (value, own)) in values.iter().zip(&own).enumerate() {
                                td.number {
                                    (cell(value.as_ref(), values[0].as_ref().filter(|_| number > 0), unit))
                                    @if let (false, Some(own)) = (same, own) {
                                        br; span.unit.window { (own.window) }
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

/// Returns a number, with its unit where that is not the row's, and its difference from the first.
fn cell(value: Option<&SummaryValue>, first: Option<&SummaryValue>, unit: &str) -> Markup {
    let Some(value) = value else {
        return html! { "–" };
    };
    let other = value.unit != unit;
    let over = first
        .filter(|first| first.unit == value.unit)
        .and_then(|first| over(value.value, first.value));
    html! {
        (four(value.value))
        @if other { " " (value.unit) }
        @if let Some(over) = over { " " span.unit { (over) } }
    }
}

/// Limits of rules beside the worst values; nothing without cars.
fn limits(runs: &[RunFolder]) -> Markup {
    let cars: Vec<(&RunFolder, &[study::car::limits::LimitCheck])> = runs
        .iter()
        .map(|run| (run, run.summary.shared().limits()))
        .filter(|(_, limits)| !limits.is_empty())
        .collect();
    let mut rows: Vec<&study::car::limits::LimitCheck> = Vec::new();
    for limit in cars.iter().flat_map(|(_, limits)| limits.iter()) {
        if rows.iter().all(|other| other.quantity != limit.quantity) {
            rows.push(limit);
        }
    }
    html! {
        @if !cars.is_empty() {
            section {
                h2 id="limits" { "Limits" }
                p {
                    "The worst value of each kind beside the limits that each run names. A limit counts for \
                     the regimes named. In brackets: margin, what is left in parts of the limit."
                    @for (run, _) in &cars {
                        @if let Some(end) = run.summary.shared().outcome().end() {
                            " Those of " (run.label) " are of the part until " (end.place()) "."
                        }
                    }
                }
                div.wide {
                    table {
                        thead { tr {
                            th scope="col" { "quantity" } th scope="col" { "regimes" }
                            th.number scope="col" { "limit" }
                            @for (run, _) in &cars { th.number scope="col" { (run.label) } }
                        } }
                        tbody {
                            @for row in rows {
                                tr {
                                    th scope="row" { (row.quantity) }
                                    td { (row.regimes) }
                                    td.number {
                                        (four(row.limit)) @if !row.unit.is_empty() { " " (row.unit) }
                                    }
                                    @for (_, limits) in &cars {
                                        @match limits.iter().find(|own| own.quantity == row.quantity) {
                                            Some(own) => td.number {
                                                (four(own.value)) " "
                                                @if own.unfiltered {
                                                    "(raw)"
                                                } @else {
                                                    span.verdict
                                                        .fails[own.margin < 0.0]
                                                        .holds[own.margin >= 0.0]
                                                    {
                                                        (format!("({:.0} %)", 100.0 * own.margin)
                                                            .replace('-', "\u{2212}"))
                                                    }
                                                }
                                            },
                                            None => td.number { "–" },
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
}

fn ledger(runs: &[RunFolder]) -> Markup {
    let units = runs[0].units();
    let mut names: Vec<&str> = Vec::new();
    for run in runs {
        for name in run.summary.shared().ledger().entries.keys() {
            if !names.contains(&name.as_str()) {
                names.push(name);
            }
        }
    }
    let energy = |value: &SummaryValue| {
        let number = KeyNumber {
            what: String::new(),
            window: String::new(),
            value: value.clone(),
            kind: Some(quantity::Kind::Energy),
        };
        four(number.in_units(units).value)
    };
    html! {
        p {
            "Entries at the end of each run, in \
             " (quantity::Kind::Energy.label(units)) ". Relative residual: the largest at \
             any output time, over the largest of work, losses and change of stored energy; above 1e-3 a run \
             has a warning, above 1e-2 it has failed."
        }
        div.wide {
            table {
                thead { tr { th scope="col" { "entry" } (heads(runs)) } }
                tbody {
                    tr {
                        th scope="row" { "relative residual" }
                        @for run in runs {
                            td.number {
                                (format!("{:.1e}", run.summary.shared().largest_relative_residual())
                                    .replace('-', "\u{2212}"))
                            }
                        }
                    }
                    tr {
                        th scope="row" { "largest residual" }
                        @for run in runs {
                            @let own = run.summary.shared().ledger();
                            td.number {
                                (energy(own.largest_residual)) " "
                                span.unit { "at " (digits(own.largest_residual_time)) " s" }
                            }
                        }
                    }
                    tr {
                        th scope="row" { "steps, at a relative tolerance of" }
                        @for run in runs {
                            @let (steps, tolerance) = run.summary.shared().solver();
                            td.number { (steps) ", " (format!("{tolerance:e}").replace('-', "\u{2212}")) }
                        }
                    }
                    @for name in names {
                        tr {
                            th scope="row" { (name.replace('_', " ")) }
                            @for run in runs {
                                td.number {
                                    @match run.summary.shared().ledger().entries.get(name) {
                                        Some(value) => (energy(value)),
                                        None => "–",
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

fn assumptions(runs: &[RunFolder]) -> Markup {
    let mut texts: Vec<(&str, Vec<&str>)> = Vec::new();
    for run in runs {
        for text in run.summary.shared().assumptions() {
            match texts.iter_mut().find(|(own, _)| own == text) {
                Some((_, labels)) => labels.push(&run.label),
                None => texts.push((text, vec![&run.label])),
            }
        }
    }
    let (all, some): (Vec<_>, Vec<_>) = texts
        .into_iter()
        .partition(|(_, labels)| labels.len() == runs.len());
    html! {
        @if runs.len() > 1 && !all.is_empty() { h3 { "In all runs" } }
        ul { @for (text, _) in &all { li { (text) } } }
        @if !some.is_empty() {
            h3 { "In some runs" }
            ul { @for (text, labels) in &some { li { (text) " (" (labels.join(", ")) ")" } } }
        }
    }
}

fn files(runs: &[RunFolder], links: &[String]) -> Markup {
    html! {
        p { "The folders of the runs, as they lay when this page was made." }
        div.wide {
            table {
                thead { tr { th scope="col" { "run" } th scope="col" { "files" } } }
                tbody {
                    @for (run, link) in runs.iter().zip(links) {
                        tr id={ "files-" (anchor(&run.label)) } {
                            th scope="row" { (run.label) }
                            td { @for name in &run.files { a href={ (link) (name) } { (name) } " " } }
                        }
                    }
                }
            }
        }
    }
}
