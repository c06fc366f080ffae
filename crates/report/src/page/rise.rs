//! The pages of a survey of wedge rise: the table of an inspection rule, and the method.

use maud::{Markup, html};
use quantity::{Kind, System as Units};
use study::car::limits::Mark;
use study::rise::answer::Answer;
use study::rise::rigs::Rig;
use study::rise::{Question, Survey, inches, mph};

use super::table::{self, Head};
use super::{document, shown_in};
use crate::figures::digits;
use crate::figures::rise as figures;
use crate::rise_files::{
    Depends, FIGURE, METHOD, NAMES, bound, lowest, mm, own_answers, state_words, values,
};
use crate::rise_work::RiseFindings;
use crate::warp_files::KIP_INCH;

/// Returns the page of the answers: what an engineer of track or cars reads in two minutes.
#[must_use]
pub fn render(survey: &Survey, findings: &RiseFindings) -> String {
    let answers = own_answers(survey, findings);
    let depends = Depends::all(survey, findings);
    let main = html! {
        section {
            h2 id="answer" { "In short" }
            (short(survey, findings, &answers))
        }
        section {
            h2 id="limits" { "The rise at which each limit is reached" }
            (limits(survey, findings, &answers))
            p {
                "A limit is reached between the highest rise at which it is kept and the lowest one at \
                 which it is not, at the worst of the speeds that were looked at. Gauges show \
                 sixteenths of an inch."
            }
        }
        @for own in &depends {
            section {
                h2 { "What it depends on: " (survey.title(own.question)) }
                (conditions(survey, findings, own))
            }
        }
        @for own in [figures::limits(survey, findings), figures::rigs(survey, findings)] {
            (shown_in(&own, &own.figure.to_svg(), None))
        }
        section {
            h2 { "Before you use it" }
            ul {
                li { "All wedges of the car rise alike, unless a row says otherwise." }
                li { "Limits: " (survey.limits.title_with_edition()) ", " (survey.limits.source) "." }
                li {
                    "Tracks of the regimes are from memory, friction and crowns of wedge faces are \
                     guesses: check what your case says."
                }
                li { a href=(METHOD) { "The method" } ": runs, speeds, brackets, what was not looked at." }
            }
        }
    };
    let lead = format!(
        "{}: {} runs, wedge rise up to {} ({} mm).",
        title(survey),
        findings.known.len(),
        inches(survey.top),
        mm(survey.top)
    );
    document(
        &format!("What wedge rise costs: {}", survey.name),
        &lead,
        None,
        &main,
        None,
    )
}

fn title(survey: &Survey) -> String {
    match survey.car.title.as_str() {
        "" => survey.name.clone(),
        title => title.to_owned(),
    }
}

fn short(survey: &Survey, findings: &RiseFindings, answers: &[Answer]) -> Markup {
    let reached = answers
        .iter()
        .filter(|own| own.bracket.exceeded.is_some_and(|own| own > 0));
    let first = reached.min_by_key(|own| (own.bracket.exceeded, own.bracket.kept));
    let without: Vec<String> = answers
        .iter()
        .filter(|own| own.bracket.exceeded == Some(0))
        .map(|own| format!("{} at {}", survey.title(own.question), survey.at_speed(own)))
        .collect();
    html! {
        @match first {
            Some(own) => p {
                "The first limit that rise reaches is " strong { (survey.title(own.question)) } ": "
                strong { (own.words(survey.top)) } ", at " (survey.at_speed(own)) "."
            },
            None => p { "No limit that is kept without rise is reached up to " (inches(survey.top)) "." },
        }
        @if let Some(rise) = lowest(survey, findings) {
            p {
                "In all conditions that were looked at, what is kept without rise is kept up to "
                strong { (inches(rise)) " (" (mm(rise)) " mm)" } "."
            }
        }
        @if !without.is_empty() {
            p { "Exceeded without rise, so that no rise can be blamed: " (without.join("; ")) "." }
        }
    }
}

fn limits(survey: &Survey, findings: &RiseFindings, answers: &[Answer]) -> Markup {
    let heads = [
        Head::Words("what"),
        Head::Words("limit"),
        Head::Words("without rise"),
        Head::Words("reached at a rise"),
        Head::InUnit("kept up to", "mm"),
        Head::Words("at"),
        Head::Words("value there"),
    ];
    let rows = answers.iter().map(|own| {
        let [before, there] = values(survey, findings, own);
        let dash = |own: Option<String>| own.unwrap_or_else(|| "–".to_owned());
        [
            survey.title(own.question),
            format!("{}{}", bound(survey, own.question), mark(survey, own.question)),
            dash(before),
            own.words(survey.top),
            dash(own.bracket.kept.map(|own| mm(own).to_string())),
            survey.at_speed(own),
            dash(there),
        ]
    });
    table::wide(&heads, rows)
}

fn mark(survey: &Survey, question: Question) -> &'static str {
    match survey.limit(question).mark {
        Some(Mark::Remembered) => " (from memory)",
        Some(Mark::Guess) => " (a guess)",
        Some(Mark::Source | Mark::Derived) | None => "",
    }
}

fn conditions(survey: &Survey, findings: &RiseFindings, own: &Depends) -> Markup {
    let heads = [
        Head::Words("condition"),
        Head::Words("what it is"),
        Head::Words("reached at a rise"),
        Head::Words("without rise"),
        Head::Words("value there"),
    ];
    let base = survey.answer(&findings.known, &[], own.question);
    let rows = base.iter().chain(&own.answers).map(|answer| {
        let factor = match answer.state.as_slice() {
            [] => "the car".to_owned(),
            [one] => survey.levels[*one].factor.clone(),
            _ => "the worst two together".to_owned(),
        };
        let [before, there] = values(survey, findings, answer);
        let dash = |own: Option<String>| own.unwrap_or_else(|| "–".to_owned());
        let words = match answer.missing.is_empty() {
            true => answer.words(survey.top),
            false => format!(
                "{} ({} without a value)",
                answer.words(survey.top),
                answer.missing.len()
            ),
        };
        [
            factor,
            state_words(survey, &answer.state),
            words,
            dash(before),
            dash(there),
        ]
    });
    html! {
        p {
            "Each condition alone, at " (mph(own.speed)) " mph, the speed at which the car itself is \
             worst, to an eighth of an inch. A condition that moves the worst speed is worse than it \
             seems here."
        }
        (table::wide(&heads, rows))
    }
}

/// Returns the page of the method: what a reviewer asks for.
#[must_use]
pub fn method(survey: &Survey, findings: &RiseFindings) -> String {
    let regimes = survey.regimes.iter().enumerate().map(|(number, own)| {
        let mut speeds: Vec<u32> = survey
            .runs_of(&findings.known, &[], number)
            .map(|own| own.0.speed)
            .collect();
        speeds.sort_unstable();
        speeds.dedup();
        let speeds: Vec<String> = speeds.iter().map(|own| mph(*own).to_string()).collect();
        let count = survey.runs_of(&findings.known, &[], number).count();
        [
            own.name.replace('_', " "),
            own.title.clone(),
            own.source.clone(),
            speeds.join(", "),
            count.to_string(),
        ]
    });
    let unsound: Vec<(String, &str, &str)> = findings
        .known
        .iter()
        .filter(|own| own.1.status != "complete")
        .map(|(own, run)| (survey.name_of(own), run.status.as_str(), run.note.as_str()))
        .collect();
    let left = survey.left(&findings.known);
    let rigs = findings.rigs.iter().map(|own| {
        let (value, unit) = match (own.rig, own.value) {
            (_, None) => ("–".to_owned(), ""),
            (Rig::Warp, Some(value)) => (digits(1e-3 * value / KIP_INCH), "kip in/mrad"),
            (Rig::Damping, Some(value)) => (digits(value), "J a cycle"),
            (Rig::Hunting, Some(value)) => (digits(value * Kind::TravelSpeed.from_si(Units::Us)), "mph"),
        };
        [
            own.rig.name().to_owned(),
            inches(own.rise),
            value,
            unit.to_owned(),
            own.note.clone(),
        ]
    });
    let open = survey
        .answers(&findings.known)
        .into_iter()
        .filter(|own| own.bracket.is_open(2))
        .map(|own| {
            format!(
                "{}, {}",
                survey.state_name(&own.state),
                survey.title(own.question)
            )
        });
    let open: Vec<String> = open.collect();
    let main = html! {
        section {
            h2 { "What was run" }
            ol {
                li { "Every regime at all its speeds, without rise and at " (inches(survey.top)) "." }
                li { "Rises between, by quarters of an inch, at the speeds that leave least to a limit \
                    there." }
                li {
                    "Between the highest rise that keeps a limit and the lowest that does not: halves, \
                     down to a sixteenth of an inch; at other speeds that exceed it higher up: the rise \
                     just below."
                }
                li {
                    "Speeds half way to those beside the worst one, down to 2 mph: at the rise that is just \
                     kept, or, where less than half of a limit is left, at the rise that leaves least."
                }
                li {
                    "Each other condition alone, on the two limits of different regimes that are reached \
                     first, at the speed at which the car is worst, to an eighth of an inch."
                }
                li { "The worst two conditions of different factors together, on the first of these limits." }
            }
            p {
                "A run that ends in a derailment keeps no limit. A run without a value is told, and \
                 neither keeps nor exceeds. Cars start shaken: with what friction holds in service. All \
                 numbers of the plan (steps of rise and speed, two limits, two conditions) are choices."
            }
            (table::wide(
                &[
                    Head::Words("regime"), Head::Words("track"), Head::Words("source"),
                    Head::Words("speeds of the car itself (mph)"), Head::Numbers("runs"),
                ],
                regimes,
            ))
        }
        section {
            h2 { "What was not looked at" }
            @if left.is_empty() { p { "Nothing of the plan is left." } }
            @else { p { "No runs were left for: " (left.join(", ")) "." } }
            ul {
                li { "A resonance between two speeds that lie more than 2 mph apart and away from the \
                    worst one." }
                li { "Conditions at other speeds, on other limits, and more than two together." }
                li { "Wedges that rise by different amounts, tracks other than these." }
                @for own in &survey.limits.not_covered.clone().unwrap_or_default() {
                    li { (own.what) ": " (own.reason) "." }
                }
            }
            @if !open.is_empty() {
                p { "Wider than an eighth of an inch, since runs were used up: " (open.join("; ")) "." }
            }
        }
        section {
            h2 { "Runs that did not come to their end, or failed" }
            @if unsound.is_empty() { p { "None." } }
            @else {
                ul {
                    @for (name, status, note) in &unsound {
                        li { code { (name) } ": " (status) ". " (note) }
                    }
                }
            }
        }
        section {
            h2 { "The truck over rise" }
            p {
                "Warp: secant stiffness of the moment of both nests at 10 mrad, side frames moved against \
                 the bolster at the loaded height. Damping: the work of a cycle of the bolster, 0.5 in up \
                 and down at 2 rad/s. Hunting: the speed falls from 90 to 30 mph in 60 s on perfect \
                 track; where the wheelsets' amplitude falls below 0.05 in. A slower ramp gives a speed \
                 that is somewhat higher."
            }
            (table::wide(
                &[
                    Head::Words("rig"), Head::Words("rise"), Head::Numbers("value"), Head::Words("unit"),
                    Head::Words("note"),
                ],
                rigs,
            ))
        }
        section {
            h2 { "Files" }
            p {
                @for own in NAMES { a href=(own) { (own) } " " }
                "; the runs with their cases are in " code { "runs/" } ", figure " code { (FIGURE) } "."
            }
        }
    };
    let lead = format!("How the answers for {} were found.", survey.name);
    document(
        &format!("Wedge rise, the method: {}", survey.name),
        &lead,
        None,
        &main,
        None,
    )
}
