//! The page of an assessment: limits by regime, what is worst in 3D, figures over speed and distance, wedges.

use std::iter;

use maud::{Markup, html};
use quantity::System as Units;
use study::assessment::dependence::{Dependence, NEAR};
use study::assessment::{Assessment, LimitVerdict, counted, worst_run};
use study::car::limits::{Bound, Limit, Mark};
use study::records::Status;

use super::table::{self, Head};
use super::{document, in_unit, moving_as, shown_in};
use crate::assessment_files::{AssessmentFindings, NAMES, kind};
use crate::figures::assessment::over_speed;
use crate::figures::{Exhibit, capital, digits};
use crate::study_folder::TABLE_FILE;
use crate::view::View;

pub use against::{Against, AgainstError, Other};
pub use worst_run::TrackRun;

mod against;
mod worst_run;

/// The page's file name.
pub const FILE_NAME: &str = super::FILE_NAME;
/// Figures over the distance of the worst run of a regime.
const OVER_DISTANCE: [&str; 3] = ["wheel_loads", "l_over_v", "body_roll"];

/// The worst run of a regime.
#[derive(Clone, Debug)]
pub struct WorstRun {
    /// The number of the regime.
    pub regime: usize,
    /// The run.
    pub run: TrackRun,
    /// The folder of its files, from the page's folder.
    pub folder: String,
    /// The start of the worst, s, and its name.
    pub worst: Option<(f64, String)>,
}

/// Returns the page as HTML; it needs nothing else to be shown.
///
/// # Errors
/// Errors of the JSON writer.
pub fn render(
    assessment: &Assessment,
    findings: &AssessmentFindings,
    worst: &[WorstRun],
    against: Option<&Against>,
) -> Result<String, serde_json::Error> {
    let regimes = 0..assessment.regimes.len();
    let over_speeds: Vec<Exhibit> = regimes
        .clone()
        .map(|regime| over_speed(assessment, findings, regime))
        .collect();
    let over_distances: Vec<Vec<Exhibit>> = worst
        .iter()
        .map(|own| {
            let all = own.run.exhibits();
            let wanted = |exhibit: &Exhibit| OVER_DISTANCE.iter().any(|name| exhibit.name.ends_with(name));
            all.into_iter().filter(wanted).collect()
        })
        .collect();
    let shown = over_speeds.iter().chain(over_distances.iter().flatten());
    let data = View::new(
        Units::Us,
        worst
            .iter()
            .map(|own| own.run.around(own.worst.as_ref().map(|(time, _)| *time))),
        shown,
    )
    .to_json()?;
    let main = html! {
        (summary(assessment, findings))
        @for (condition, own) in assessment.conditions.iter().enumerate() {
            section {
                h2 id={ "condition-" (own.name) } { "Limits: " (own.title) }
                (limits(assessment, findings, condition, against))
            }
        }
        (depends(assessment, findings))
        @if assessment.conditions.len() > 1 { (conditions(assessment, findings)) }
        @for regime in regimes {
            @let own = &assessment.regimes[regime];
            section {
                h2 id={ "regime-" (own.name) } { (capital(&own.title)) }
                p {
                    "Regime " code { (own.name) } ", " (own.source) "."
                    @if !own.looks_at.is_empty() { " To look at: " (own.looks_at) "." }
                }
                (shown_in(&over_speeds[regime], &over_speeds[regime].figure.to_svg(), None))
                @for (own, drawn) in worst
                    .iter()
                    .zip(&over_distances)
                    .filter(|(own, _)| own.regime == regime)
                {
                    (worst_of(assessment, findings, own))
                    @for exhibit in drawn { (shown_in(exhibit, &exhibit.figure.to_svg(), None)) }
                }
            }
        }
        (coverage(assessment, findings))
        (files())
    };
    let about = match findings.refined.len() {
        0 => String::new(),
        count => format!(" ({count} of them at speeds about the worst ones, to 0.5 mph)"),
    };
    let lead = format!(
        "{}{about} of {}: {}, {}. Limits: {}, {}. Tracks of the regimes are from memory: check \
         them against your edition.",
        counted(findings.runs.len(), "run"),
        assessment.car,
        counted(assessment.regimes.len(), "regime"),
        counted(assessment.conditions.len(), "condition"),
        assessment.limits.title_with_edition(),
        assessment.limits.source,
    );
    let heading = format!("{}: {}", capital(kind(assessment, findings)), assessment.car);
    Ok(document(&heading, &lead, None, &main, Some(&data)))
}

fn summary(assessment: &Assessment, findings: &AssessmentFindings) -> Markup {
    let [kept, exceeded, unknown] = findings.counts();
    let unsound = findings
        .runs
        .iter()
        .filter(|run| run.status != Status::Complete.name());
    let unsound: Vec<_> = unsound.collect();
    let without = assessment.without_limits();
    html! {
        section {
            h2 id="summary" { "In short" }
            p {
                (kept) " limits are kept, " strong { (exceeded) " exceeded" }
                @if unknown > 0 { ", " (unknown) " unknown, because a run has no numbers" } "."
                @if !without.is_empty() { " No limit is set for " (without.join(", ").replace('_', " ")) "." }
            }
            @if !unsound.is_empty() {
                details open[unsound.len() < 10] {
                    summary { (unsound.len()) " runs did not come to the end of their track, or failed" }
                    ul {
                        @for run in &unsound {
                            li {
                                "run " (run.run) ", "
                                (assessment.regimes[run.regime].name.replace('_', " ")) ", "
                                (assessment.conditions[run.condition].name.replace('_', " ")) ", "
                                (run.speed) ": "
                                (run.status) ". " (run.note)
                            }
                        }
                    }
                }
            }
        }
    }
}

fn percent(margin: f64) -> String {
    format!("{:.0} %", 100.0 * margin).replace('-', "\u{2212}")
}

fn limits(
    assessment: &Assessment,
    findings: &AssessmentFindings,
    condition: usize,
    against: Option<&Against>,
) -> Markup {
    let own = findings.verdicts.iter().filter(|own| own.condition == condition);
    let other = |own: &LimitVerdict| {
        let key = [
            &assessment.regimes[own.regime].name,
            &assessment.conditions[own.condition].name,
            &assessment.limits.limits[own.limit].name,
        ];
        against?.others.iter().find(|other| other.key.iter().eq(key))
    };
    html! {
        div.wide {
            table {
                thead {
                    tr {
                        th scope="col" { "regime" } th scope="col" { "quantity" }
                        th.number scope="col" { "worst" } th.number scope="col" { "at" }
                        th.number scope="col" { "limit" } th.number scope="col" { "margin" }
                        th scope="col" { "verdict" }
                        @if let Some(against) = against {
                            th.number scope="col" { (against.name) } th.number scope="col" { "its margin" }
                        }
                    }
                }
                tbody {
                    @for own in own {
                        @let limit = &assessment.limits.limits[own.limit];
                        tr {
                            th scope="row" {
                                a href={ "#regime-" (assessment.regimes[own.regime].name) } {
                                    (assessment.regimes[own.regime].name.replace('_', " "))
                                }
                            }
                            td {
                                (assessment.quantity(limit))
                                @if !limit.remark.is_empty() { " (" (limit.remark) ")" }
                                @if let Some(from) = origin(limit) { br; small { (from) } }
                            }
                            td.number {
                                (own.worst.as_ref().map_or("–".to_owned(), |worst| {
                                    in_unit(worst.value, &limit.unit)
                                }))
                                @if own.worst.as_ref().is_some_and(|worst| worst.until_derailed) {
                                    " until it derailed"
                                }
                            }
                            td.number { (own.worst.as_ref().map_or("–", |worst| worst.speed.as_str())) }
                            td.number {
                                (match limit.bound { Bound::AtMost => "≤ ", Bound::AtLeast => "≥ " })
                                @match &own.worst {
                                    Some(worst) => (in_unit(worst.limit_value, &limit.unit)),
                                    None => (limit.value_in_words()),
                                }
                            }
                            td.number {
                                (own.worst.as_ref().map_or("–".to_owned(), |worst| percent(worst.margin)))
                            }
                            td { (said(own)) }
                            @if against.is_some() {
                                @match other(own) {
                                    Some(other) => {
                                        td.number { (in_unit(other.value, &other.unit)) }
                                        td.number { (percent(other.margin)) }
                                    }
                                    None => { td.number { "–" } td.number { "–" } }
                                }
                            }
                        }
                    }
                }
            }
        }
    }
}

/// Returns paragraph and mark of a limit.
fn origin(limit: &Limit) -> Option<String> {
    let mark = limit.mark.map(|mark| match mark {
        Mark::Source => "read in its source",
        Mark::Derived => "derived",
        Mark::Remembered => "from memory",
        Mark::Guess => "a guess",
    });
    let paragraph = Some(limit.paragraph.as_str()).filter(|own| !own.is_empty());
    let parts: Vec<&str> = [paragraph, mark].into_iter().flatten().collect();
    (!parts.is_empty()).then(|| parts.join(", "))
}

/// Returns a verdict in words.
fn said(own: &LimitVerdict) -> Markup {
    let by = own.turned_by();
    html! {
        @match own.word() {
            "exceeded" => strong { "exceeded" },
            word => (word),
        }
        @if !own.derailed.is_empty() { ": derailed at " (own.derailed.join(", ")) }
        @if !own.missing.is_empty() { "; no numbers at " (own.missing.join(", ")) }
        @if !by.is_empty() { "; " a href="#depends" { "turned by " (by.join(", ")) } }
    }
}

/// Returns what verdicts depend on: a row each verdict for which something was looked at.
fn depends(assessment: &Assessment, findings: &AssessmentFindings) -> Markup {
    let looked = |own: &&LimitVerdict| own.asked.is_some() || own.depends != Dependence::default();
    let rows = findings.verdicts.iter().filter(looked).filter_map(|own| {
        let worst = own.worst.as_ref()?;
        let limit = &assessment.limits.limits[own.limit];
        let unit = &limit.unit;
        let condition = match assessment.conditions.len() {
            1 => String::new(),
            _ => format!(
                ", {}",
                assessment.conditions[own.condition].name.replace('_', " ")
            ),
        };
        let asked = own.asked.as_ref().map(|own| {
            format!(
                "{} ({}) at {}",
                in_unit(own.value, unit),
                percent(own.margin),
                own.speed
            )
        });
        let start = own.depends.other_start.as_ref().map(|own| {
            let value = own.judged.value.map_or("–".to_owned(), |own| in_unit(own, unit));
            let margin = own.judged.margin.map_or(own.judged.verdict.to_owned(), percent);
            format!("{value} ({margin}) from {}", own.start)
        });
        let friction = own.depends.friction.as_ref();
        let friction = friction.map(|over| format!("{} (the run has {})", over.words(own.word()), over.own));
        let by = own.turned_by();
        let turned = if by.is_empty() {
            "nothing of these".to_owned()
        } else {
            by.join(", ")
        };
        let dash = |text: Option<String>| text.unwrap_or_else(|| "–".to_owned());
        Some([
            format!(
                "{}{condition}: {}",
                assessment.regimes[own.regime].name.replace('_', " "),
                assessment.quantity(limit)
            ),
            format!(
                "{} ({}) at {}",
                in_unit(worst.value, unit),
                percent(worst.margin),
                worst.speed
            ),
            dash(asked),
            dash(start),
            dash(friction),
            turned,
        ])
    });
    let rows: Vec<_> = rows.collect();
    html! {
        @if !rows.is_empty() {
            section {
                h2 id="depends" { "What verdicts depend on" }
                p {
                    "Each verdict's worst run, its margin in brackets; the worst of the regime's own speeds, "
                    "where another speed is worse; the same run from another start, where its margin is "
                    "within " (format!("{:.0}", 100.0 * NEAR)) " %; and over the friction of wheel on rail, "
                    "all coefficients in proportion: straight between the runs."
                }
                (table::wide(
                    &[
                        Head::Words("limit"),
                        Head::Words("worst run"),
                        Head::Words("given speeds alone"),
                        Head::Words("other start"),
                        Head::Words("friction"),
                        Head::Words("verdict turned by"),
                    ],
                    rows,
                ))
            }
        }
    }
}

/// Returns what the rule asks for beyond the limits, and why this is no certificate.
fn coverage(assessment: &Assessment, findings: &AssessmentFindings) -> Markup {
    let limits = &assessment.limits;
    let reasons = assessment.falls_short(&findings.verdicts);
    html! {
        section {
            h2 id="coverage" { "Covered, not covered" }
            p {
                (limits.title_with_edition()) ". " (capital(&limits.source)) "."
                @if reasons.is_empty() {
                    " All that the rule asks for is here, read in its source, and kept: a certificate."
                } @else {
                    " This is an assessment, no certificate: " (reasons.join("; ")) "."
                }
            }
            p {
                "Covered: "
                (limits.limits.iter().map(|own| assessment.quantity(own)).collect::<Vec<_>>().join("; ")) "."
            }
            @match limits.not_covered.as_deref() {
                None => p { "The file of limits does not say what the rule asks for beyond them." },
                Some([]) => {}
                Some(all) => {
                    p { "Not covered:" }
                    ul {
                        @for own in all {
                            li {
                                (own.what)
                                @if !own.paragraph.is_empty() { " (" (own.paragraph) ")" }
                                @if !own.reason.is_empty() { ": " (own.reason) }
                            }
                        }
                    }
                }
            }
        }
    }
}

/// Returns the least margin by regime and condition.
fn conditions(assessment: &Assessment, findings: &AssessmentFindings) -> Markup {
    let least = |regime: usize, condition: usize| {
        let own = findings
            .verdicts
            .iter()
            .filter(|own| own.regime == regime && own.condition == condition);
        let (mut least, mut derailed) = (f64::INFINITY, false);
        for verdict in own {
            derailed |= !verdict.derailed.is_empty();
            least = verdict
                .worst
                .as_ref()
                .map_or(least, |worst| least.min(worst.margin));
        }
        match (derailed, least.is_finite()) {
            (true, _) => "derailed".to_owned(),
            (false, true) => percent(least),
            (false, false) => "–".to_owned(),
        }
    };
    let names: Vec<String> = assessment
        .conditions
        .iter()
        .map(|own| own.name.replace('_', " "))
        .collect();
    let mut heads = vec![Head::Words("regime")];
    heads.extend(names.iter().map(|name| Head::Numbers(name)));
    let rows = assessment.regimes.iter().enumerate().map(|(regime, own)| {
        let margins = (0..assessment.conditions.len()).map(|condition| least(regime, condition));
        iter::once(own.name.replace('_', " "))
            .chain(margins)
            .collect::<Vec<_>>()
    });
    html! {
        section {
            h2 id="conditions" { "Conditions beside each other" }
            p { "The least margin of all limits of a regime, in parts of its limit." }
            (table::wide(&heads, rows))
        }
    }
}

/// Returns the worst run of a regime: what is worst, its wedges, where its files are.
fn worst_of(assessment: &Assessment, findings: &AssessmentFindings, own: &WorstRun) -> Markup {
    let Some(run) = worst_run(&findings.runs, own.regime) else {
        return html! {};
    };
    let heads = [
        Head::Words("wedge"),
        Head::Numbers("lost in friction"),
        Head::Numbers("no point slips"),
    ];
    let (summary, wedges) = (own.run.summary(), own.run.wedges());
    html! {
        h3 { "The worst run: " (run.speed) ", " (assessment.conditions[run.condition].title) }
        (super::doubts_about("The run", summary))
        p {
            @if let Some((time, what)) = &own.worst { "From " (digits(*time)) " s on: " (what) ". " }
            a href={ (own.folder) "/" (super::FILE_NAME) } { "All of this run" } "."
        }
        @if own.run.moves() { (moving_as(summary.name(), "The worst second, moving", own.regime == 0)) }
        @if !wedges.is_empty() { (table::wide(&heads, wedges)) }
    }
}

fn files() -> Markup {
    html! {
        section {
            h2 id="files" { "Files" }
            p {
                a href=(NAMES[1]) { (NAMES[1]) } " and " a href=(NAMES[0]) { (NAMES[0]) }
                ": a row each run and limit. " a href=(TABLE_FILE) { (TABLE_FILE) }
                ": all measures of each run. " a href=(NAMES[2]) { (NAMES[2]) } ": what this page says."
            }
        }
    }
}

/// Returns the worst value of a run with its time, that of the limit that is kept least.
#[must_use]
pub fn worst_second(assessment: &Assessment, regime: usize, run: &TrackRun) -> Option<(f64, String)> {
    let summary = run.summary();
    if let Some(own) = summary.derailed() {
        return Some((own.time, own.reason));
    }
    let name = &assessment.regimes[regime].name;
    let own = assessment.limits.limits.iter().filter(|limit| limit.is_for(name));
    let found = own.filter_map(|limit| {
        let check = summary.limits().iter().find(|own| own.name == limit.name)?;
        let what = format!("{}, {}", check.quantity, check.worst_at());
        Some((check.margin, check.time?, what))
    });
    let least = found.min_by(|a, b| a.0.total_cmp(&b.0));
    least.map(|(_, time, what)| (time, what))
}
