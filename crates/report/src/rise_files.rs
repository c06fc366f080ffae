//! The files of `wedgelab rise`: its answers as JSON and as a table, all runs, a figure, and words.

use std::fmt::Write as _;
use std::io::{self, Write};
use std::path::Path;

use serde_json::{Value, json};
use staging::{FileError, Folder};
use study::car::limits::Bound;
use study::rise::answer::{Answer, of_limit};
use study::rise::bracket::{Bracket, SIXTEENTH};
use study::rise::rigs::Rig;
use study::rise::{Level, Question, Survey, inches, mph};

use crate::drawn::Drawn;
use crate::figures;
use crate::page::{self, FILE_NAME, in_unit};
use crate::rise_work::RiseFindings;

/// The page of the answers.
pub const PAGE: &str = FILE_NAME;
/// The page of the method.
pub const METHOD: &str = "method.html";
/// The answers.
pub const SUMMARY: &str = "rise.json";
/// The answers as a table: one limit in one condition a row.
pub const TABLE: &str = "rise.csv";
/// All runs: one limit of one run a row.
pub const RUNS_TABLE: &str = "runs.csv";
/// The figure.
pub const FIGURE: &str = "rise.svg";
/// The same as a picture.
pub const PICTURE: &str = "rise.png";
/// The result in words.
pub const WORDS: &str = "rise.txt";
/// All of them.
pub const NAMES: [&str; 8] = [PAGE, METHOD, SUMMARY, TABLE, RUNS_TABLE, FIGURE, PICTURE, WORDS];

/// Writes all of them into a folder.
///
/// # Errors
/// They cannot be written.
pub fn write(survey: &Survey, findings: &RiseFindings, path: &Path) -> Result<(), FileError> {
    let figure = Drawn::of(&figures::rise::limits(survey, findings).figure)?;
    let summary = summary(survey, findings);
    let text = |out: &mut dyn Write, text: String| out.write_all(text.as_bytes());
    Folder::check(path, &NAMES, true)?.write(|all| {
        all.add(PAGE, |out| text(out, page::rise::render(survey, findings)))?;
        all.add(METHOD, |out| text(out, page::rise::method(survey, findings)))?;
        all.add(SUMMARY, |out| Ok(serde_json::to_writer_pretty(out, &summary)?))?;
        all.add(TABLE, |out| write_table(survey, findings, out))?;
        all.add(RUNS_TABLE, |out| write_runs(survey, findings, out))?;
        figure.add(all, FIGURE, PICTURE)?;
        all.add(WORDS, |out| text(out, words(survey, findings)))
    })
}

/// What other conditions do to a question: each condition with its answer at the car's own worst speed.
pub struct Depends {
    /// The question.
    pub question: Question,
    /// The speed at which conditions are looked at, hundredths of a mile an hour.
    pub speed: u32,
    /// Conditions in the order in which they were looked at; then the worst two together.
    pub answers: Vec<Answer>,
}

impl Depends {
    /// Returns it of each question on which conditions were looked at.
    #[must_use]
    pub fn all(survey: &Survey, findings: &RiseFindings) -> Vec<Self> {
        let all = survey.governing(&findings.known).into_iter();
        let all = all.map(|(question, speed, _)| {
            let answers = survey.answers(&findings.known).into_iter();
            let own = answers.filter(|own| own.question == question && !own.state.is_empty());
            Self {
                question,
                speed,
                answers: own.collect(),
            }
        });
        all.filter(|own| !own.answers.is_empty()).collect()
    }
}

/// Returns the answers of the car itself.
#[must_use]
pub fn own_answers(survey: &Survey, findings: &RiseFindings) -> Vec<Answer> {
    let answers = survey.answers(&findings.known).into_iter();
    answers.filter(|own| own.state.is_empty()).collect()
}

/// Returns the conditions of a state in words.
#[must_use]
pub fn state_words(survey: &Survey, state: &[usize]) -> String {
    let levels: Vec<&Level> = state.iter().map(|own| &survey.levels[*own]).collect();
    match levels.as_slice() {
        [] => "as its case says".to_owned(),
        several => {
            let titles: Vec<&str> = several.iter().map(|own| own.condition.title.as_str()).collect();
            titles.join("; with: ")
        }
    }
}

/// Returns a limit with its side: `≥ 10 %`.
#[must_use]
pub fn bound(survey: &Survey, question: Question) -> String {
    let limit = survey.limit(question);
    let sign = match limit.bound {
        Bound::AtMost => "≤",
        Bound::AtLeast => "≥",
    };
    format!("{sign} {}", limit.value_in_words())
}

/// Returns the measured value without rise, and at the rise that is just exceeded or the highest one, with
/// their unit.
#[must_use]
pub fn values(survey: &Survey, findings: &RiseFindings, answer: &Answer) -> [Option<String>; 2] {
    let runs = || survey.runs_of(&findings.known, &answer.state, answer.question.regime);
    let limit = survey.limit(answer.question);
    let at = |rise: u32| {
        let found = runs().find(|(own, _)| own.speed == answer.speed && own.rise == rise)?;
        match found.1.derailed {
            true => Some("a wheel leaves its rail".to_owned()),
            false => of_limit(found.1, &limit.name)?
                .value
                .map(|own| in_unit(own, &limit.unit)),
        }
    };
    [at(0), at(answer.bracket.exceeded.unwrap_or(survey.top))]
}

fn bracket_json(bracket: &Bracket) -> Value {
    let rise = |own: Option<u32>| own.map(|own| json!({ "in": f64::from(own) / 16.0, "mm": mm(own) }));
    json!({
        "kept_up_to": rise(bracket.kept),
        "exceeded_from": rise(bracket.exceeded),
        "kept_again": bracket.again,
    })
}

/// Returns a rise in millimeters, to a hundredth.
#[must_use]
pub fn mm(rise: u32) -> f64 {
    (f64::from(rise) * SIXTEENTH * 1e5).round() / 100.0
}

/// Returns the answers as JSON.
#[must_use]
pub fn summary(survey: &Survey, findings: &RiseFindings) -> Value {
    let answers = survey.answers(&findings.known).into_iter().map(|own| {
        let limit = survey.limit(own.question);
        let speeds = own
            .speeds
            .iter()
            .map(|(speed, bracket)| json!({ "mph": mph(*speed), "bracket": bracket_json(bracket) }));
        json!({
            "condition": survey.state_name(&own.state),
            "regime": survey.regimes[own.question.regime].name,
            "limit": limit.name,
            "quantity": limit.quantity,
            "limit_mark": limit.mark.map(|mark| mark.name()),
            "answer": own.words(survey.top),
            "mph": mph(own.speed),
            "bracket": bracket_json(&own.bracket),
            "straight_between_in": own.straight.map(|own| own / 16.0),
            "speeds": speeds.collect::<Vec<_>>(),
            "runs_without_value": own.missing,
        })
    });
    let rigs = findings.rigs.iter().map(|own| {
        json!({
            "rig": own.rig,
            "rise_in": f64::from(own.rise) / 16.0,
            "value": own.value,
            "unit": si_unit(own.rig),
            "note": own.note,
        })
    });
    json!({
        "schema": "wedgelab-rise-1",
        "program": format!("wedgelab {}", env!("CARGO_PKG_VERSION")),
        "car": survey.name,
        "title": survey.car.title,
        "limits": survey.limits.title_with_edition(),
        "limits_source": survey.limits.source,
        "highest_rise_in": f64::from(survey.top) / 16.0,
        "runs": findings.known.len(),
        "left_to_look_at": survey.left(&findings.known),
        "answers": answers.collect::<Vec<_>>(),
        "rigs": rigs.collect::<Vec<_>>(),
    })
}

/// Returns the SI unit of what a rig says.
#[must_use]
pub fn si_unit(rig: Rig) -> &'static str {
    match rig {
        Rig::Warp => "N·m/rad",
        Rig::Damping => "J",
        Rig::Hunting => "m/s",
    }
}

/// Writes the table of the answers.
///
/// # Errors
/// The writer's.
pub fn write_table(survey: &Survey, findings: &RiseFindings, out: &mut dyn Write) -> io::Result<()> {
    let head = [
        "condition",
        "regime",
        "limit",
        "kept_up_to_in",
        "exceeded_from_in",
        "kept_up_to_mm",
        "exceeded_from_mm",
        "at_mph",
        "answer",
    ];
    let rows = survey.answers(&findings.known).into_iter().map(|own| {
        let rise = |own: Option<u32>| own.map_or(String::new(), |own| (f64::from(own) / 16.0).to_string());
        let metric = |own: Option<u32>| own.map_or(String::new(), |own| mm(own).to_string());
        let Bracket { kept, exceeded, .. } = own.bracket;
        vec![
            survey.state_name(&own.state),
            survey.regimes[own.question.regime].name.clone(),
            survey.limit(own.question).name.clone(),
            rise(kept),
            rise(exceeded),
            metric(kept),
            metric(exceeded),
            mph(own.speed).to_string(),
            own.words(survey.top),
        ]
    });
    write_csv(&head, rows, out)
}

/// Writes the table of all runs.
///
/// # Errors
/// The writer's.
pub fn write_runs(survey: &Survey, findings: &RiseFindings, out: &mut dyn Write) -> io::Result<()> {
    let head = [
        "condition",
        "regime",
        "speed_mph",
        "rise_in",
        "status",
        "derailed",
        "limit",
        "value",
        "limit_value",
        "unit",
        "margin",
        "note",
    ];
    let text = |own: Option<f64>| own.map_or(String::new(), |own| own.to_string());
    let rows = findings.known.iter().flat_map(|(wanted, run)| {
        let row = move |limit: &str, numbers: [String; 4]| {
            let [value, allowed, unit, margin] = numbers;
            vec![
                survey.state_name(&wanted.state),
                survey.regimes[wanted.regime].name.clone(),
                mph(wanted.speed).to_string(),
                (f64::from(wanted.rise) / 16.0).to_string(),
                run.status.clone(),
                run.derailed.to_string(),
                limit.to_owned(),
                value,
                allowed,
                unit,
                margin,
                run.note.clone(),
            ]
        };
        match run.limits.is_empty() {
            true => vec![row("", Default::default())],
            false => run
                .limits
                .iter()
                .map(|own| {
                    let numbers = [
                        text(own.value),
                        text(own.limit_value),
                        own.unit.clone(),
                        text(own.margin),
                    ];
                    row(&own.limit, numbers)
                })
                .collect(),
        }
    });
    write_csv(&head, rows, out)
}

fn write_csv(head: &[&str], rows: impl Iterator<Item = Vec<String>>, out: &mut dyn Write) -> io::Result<()> {
    let mut table = ::csv::Writer::from_writer(out);
    table.write_record(head)?;
    for row in rows {
        table.write_record(row)?;
    }
    table.flush()
}

/// Returns the result in words.
#[must_use]
pub fn words(survey: &Survey, findings: &RiseFindings) -> String {
    let mut text = String::new();
    let mut line = |own: String| {
        // Writing into a text cannot fail.
        let _ = writeln!(text, "{own}");
    };
    line(format!(
        "What wedge rise costs: {}, {} runs.",
        survey.name,
        findings.known.len()
    ));
    line(format!(
        "Limits: {}, {}.",
        survey.limits.title_with_edition(),
        survey.limits.source
    ));
    line(String::new());
    for own in own_answers(survey, findings) {
        let speed = survey.at_speed(&own);
        line(format!(
            "  {} {}: {}, at {speed}",
            survey.title(own.question),
            bound(survey, own.question),
            own.words(survey.top)
        ));
        if own.bracket.again {
            line("    kept again at a higher rise at this speed: other speeds are worse there".to_owned());
        }
        if !own.missing.is_empty() {
            line(format!("    without a value: {}", own.missing.join(", ")));
        }
    }
    for own in Depends::all(survey, findings) {
        line(String::new());
        line(format!(
            "{} at {} mph in other conditions:",
            survey.title(own.question),
            mph(own.speed)
        ));
        for answer in &own.answers {
            line(format!(
                "  {}: {}",
                survey.state_name(&answer.state).replace('_', " "),
                answer.words(survey.top)
            ));
        }
    }
    let left = survey.left(&findings.known);
    if !left.is_empty() {
        line(String::new());
        line(format!(
            "No runs were left for: {}. A greater --runs goes on in the same folder.",
            left.join(", ")
        ));
    }
    if let Some(rise) = lowest(survey, findings) {
        line(String::new());
        line(format!(
            "All limits that are kept without rise are kept up to {} ({} mm), in all conditions that were \
             looked at.",
            inches(rise),
            mm(rise)
        ));
    }
    text
}

/// Returns the highest rise up to which all limits that are kept without rise are kept, in all conditions
/// that were looked at; none if none is.
#[must_use]
pub fn lowest(survey: &Survey, findings: &RiseFindings) -> Option<u32> {
    let answers = survey.answers(&findings.known);
    let kept = answers.iter().filter(|own| own.bracket.exceeded != Some(0));
    kept.filter_map(|own| own.bracket.kept).min()
}
