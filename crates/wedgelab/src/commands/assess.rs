//! `wedgelab assess`: a car in regimes, at speeds and in conditions, beside the limits of rules.

use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::process::ExitCode;

use clap::Args;
use report::assessment_files::{AssessmentFindings, NAMES};
use report::assessment_work;
use report::page::assessment::Against;
use report::study_folder::TABLE_FILE;
use report::terminal::TerminalTable;
use serde_json::json;
use study::assessment::dependence::{NEAR, OverFriction};
use study::assessment::{Assessment, FRICTIONS, LimitVerdict, Request, counted};
use study::car::speeds;
use study::records::Status;

use super::study::work;
use crate::execute::jobs;
use crate::failure::{Failure, Message, say};
use crate::interrupt;
use crate::json;
use crate::progress::Steady;

/// Run a car in all regimes of the assessment of freight cars, and compare with the limits of rules
///
/// Each regime is a track (`wedgelab regime` lists them) that the car passes at several speeds, in one or
/// more conditions: wedge rise, a broken coil, empty. Writes one page (limits, the worst runs in 3D, figures
/// over speed and distance, wedges), assessment.csv and assessment.parquet (one row per run and limit),
/// table.parquet (all measures of each run) and assessment.json. The same command continues an assessment
/// that was stopped or killed. Tracks and limits are quoted from memory of AAR M-1001, chapter XI: check them
/// against your edition.
#[derive(Debug, Args)]
#[command(after_long_help = "\
Examples:
  wedgelab assess my_car.toml
  wedgelab assess car_tangent_loaded --regimes twist_and_roll pitch_and_bounce
  wedgelab assess my_car.toml --conditions new rise_0.75 mu_0.25 massless_wedges
  wedgelab assess my_car.toml --limits my_limits.toml --against other_car_assessment")]
pub struct Arguments {
    /// Case file of a car, or the name of a built-in case
    car: PathBuf,
    /// Regimes by name, or your own files [default: all that `wedgelab regime` lists]
    #[arg(long, value_name = "REGIME", num_args = 1..)]
    regimes: Vec<String>,
    #[command(flatten)]
    common: Common,
}

/// Arguments of both `assess` and `regime`.
#[derive(Debug, Args)]
pub struct Common {
    /// Speeds for all regimes, with --steps; or several speeds [default: those of each regime]
    #[arg(long, value_name = "FROM..TO", num_args = 1..)]
    speeds: Vec<String>,
    /// Number of speeds from the first to the last
    #[arg(
        long,
        value_name = "N",
        default_value_t = 6,
        value_parser = clap::value_parser!(u32).range(2..=100),
    )]
    steps: u32,
    /// No runs at more speeds about the worst one of each regime; without --speeds up to six are made of each
    #[arg(long)]
    unrefined: bool,
    /// Conditions by name (as_given, new, rise_0.75, ...), or your own file [default: those of the case]
    #[arg(long, value_name = "CONDITION", num_args = 0..)]
    conditions: Option<Vec<String>>,
    /// Frictions of wheel on rail at which runs near limits are looked at again; the option alone: none
    /// [default: 0.3 0.5]
    #[arg(long, value_name = "MU", num_args = 0.., value_parser = friction)]
    frictions: Option<Vec<f64>>,
    /// Limits by name (`wedgelab regime` lists them), or your own file
    #[arg(long, value_name = "LIMITS", default_value = "aar_chapter_xi")]
    limits: String,
    /// Folder of another assessment, to compare with this one
    #[arg(long, value_name = "DIR")]
    against: Option<PathBuf>,
    /// Set one value over those of the case
    #[arg(long, value_name = "PATH.KEY=VALUE")]
    set: Vec<String>,
    /// Folder to write into, or to continue in [default: NAME_assessment, or NAME_REGIME]
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// Number of runs at a time [default: number of processors]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..))]
    jobs: Option<u16>,
    /// No progress
    #[arg(long, short)]
    quiet: bool,
    #[arg(long, help = json::HELP)]
    json: bool,
}

/// Reads a coefficient of friction.
fn friction(text: &str) -> Result<f64, String> {
    let value = text.parse::<f64>().ok().filter(|own| *own > 0.0 && *own <= 2.0);
    value.ok_or_else(|| "a coefficient above 0, at most 2, is expected".to_owned())
}

/// The command's older name, which this version still takes.
pub const BEFORE: &str = "certify";

/// Executes the command.
pub fn execute(arguments: &Arguments) -> Result<ExitCode, Failure> {
    if std::env::args_os().nth(1).is_some_and(|own| own == BEFORE) {
        say(
            "note: `wedgelab certify` is called `wedgelab assess` now; the older name goes with the next \
             version",
        );
    }
    assess(
        &arguments.car,
        &arguments.regimes,
        &arguments.common,
        "assessment",
    )
}

/// Runs a car in regimes and writes what comes out.
pub fn assess(car: &Path, regimes: &[String], common: &Common, ending: &str) -> Result<ExitCode, Failure> {
    interrupt::listen();
    let conditions = match &common.conditions {
        None => Vec::new(),
        // The option alone: all of them.
        Some(names) if names.is_empty() => {
            let all = study::assessment::conditions::Condition::all().iter();
            all.map(|own| own.name.clone()).collect()
        }
        Some(names) => names.clone(),
    };
    let assessment = Assessment::new(&Request {
        car: car.to_owned(),
        set: common.set.clone(),
        regimes: regimes.to_vec(),
        speeds: speeds::parse(&common.speeds, common.steps)?,
        conditions,
        limits: common.limits.clone(),
        refine: !common.unrefined && common.speeds.is_empty(),
        frictions: common.frictions.clone().unwrap_or_else(|| FRICTIONS.to_vec()),
    })?;
    let path = common
        .out
        .clone()
        .unwrap_or_else(|| PathBuf::from(format!("{}_{ending}", assessment.car)));
    let against = common.against.as_deref().map(Against::read).transpose()?;
    for regime in assessment.without_limits() {
        say(&format!(
            "note: {} sets no limit for the regime {regime}",
            assessment.limits.title
        ));
    }
    let folder = work::open(&assessment.study, &path)?;
    let jobs = jobs(common.jobs);
    let done = work::all(&assessment.study, &folder, jobs, common.quiet)?;
    if done.interrupted || interrupt::wanted() {
        return Err(interrupted(&assessment, &path, done.before + done.now));
    }
    let progress = Steady::new("worst runs", assessment.regimes.len() as u64, 0, common.quiet);
    let finished = assessment_work::finish(
        &assessment,
        &folder,
        jobs,
        against.as_ref(),
        interrupt::flag(),
        &|| progress.done(),
    );
    progress.finish();
    let Some(findings) = finished? else {
        return Err(interrupted(&assessment, &path, assessment.study.count()));
    };
    if common.json {
        let [kept, exceeded, unknown] = findings.counts();
        json::print(&json!({
            "folder": path,
            "files": NAMES.iter().chain([&TABLE_FILE]).collect::<Vec<_>>(),
            "runs": findings.runs.len(),
            "incomplete": findings.runs.iter().filter(|run| run.status != Status::Complete.name()).count(),
            "before": done.before,
            "kept": kept,
            "exceeded": exceeded,
            "unknown": unknown,
        }))?;
        return Ok(ExitCode::SUCCESS);
    }
    print(&assessment, &findings, &path)?;
    Ok(ExitCode::SUCCESS)
}

fn interrupted(assessment: &Assessment, path: &Path, kept: u64) -> Failure {
    let message = format!(
        "{}: {kept} of {} runs are kept in {}",
        interrupt::REASON,
        assessment.study.count(),
        path.display()
    );
    Failure::Interrupted(Message::new(message, "the same command goes on from there").into())
}

/// Prints the table of limits.
fn print(assessment: &Assessment, findings: &AssessmentFindings, path: &Path) -> io::Result<()> {
    let several = assessment.conditions.len() > 1;
    let mut table = TerminalTable::new(
        if several { 3 } else { 2 },
        &[
            ("regime", ""),
            ("limit", ""),
            if several { ("condition", "") } else { ("at", "") },
            ("worst", ""),
            ("limit", ""),
            ("margin", "%"),
            ("verdict", ""),
        ],
    );
    for own in &findings.verdicts {
        let limit = &assessment.limits.limits[own.limit];
        let worst = own.worst.as_ref();
        let third = match several {
            true => assessment.conditions[own.condition].name.clone(),
            false => worst.map_or("-".to_owned(), |worst| worst.speed.clone()),
        };
        let derailed = if own.derailed.is_empty() { "" } else { ", derailed" };
        table.row([
            assessment.regimes[own.regime].name.clone(),
            limit.name.clone(),
            third,
            worst.map_or("-".to_owned(), |worst| {
                let until = if worst.until_derailed {
                    ", until it derailed"
                } else {
                    ""
                };
                format!("{:.3} {}{until}", worst.value, limit.unit)
            }),
            worst.map_or_else(
                || limit.value_in_words(),
                |worst| limit.with_unit(worst.limit_value),
            ),
            worst.map_or("-".to_owned(), |worst| format!("{:.0}", 100.0 * worst.margin)),
            format!("{}{derailed}", own.word()),
        ]);
    }
    let mut out = io::stdout().lock();
    table.write(&mut out)?;
    depends(assessment, findings, &mut out)?;
    let [kept, exceeded, unknown] = findings.counts();
    let refined = match findings.refined.len() {
        0 => String::new(),
        count => format!(", {count} of them at speeds about the worst ones"),
    };
    writeln!(
        out,
        "\n{}{refined}. Limits: {kept} kept, {exceeded} exceeded, {unknown} unknown. {}: {}.",
        counted(findings.runs.len(), "run"),
        assessment.limits.title_with_edition(),
        assessment.limits.source
    )?;
    match assessment.falls_short(&findings.verdicts).as_slice() {
        [] => writeln!(out, "A certificate: all that the rule asks for is kept.")?,
        reasons => writeln!(out, "An assessment, no certificate: {}.", reasons.join("; "))?,
    }
    let ended = |word: &str| findings.runs.iter().filter(|run| run.status == word).count();
    let others: Vec<String> = Status::ALL[1..]
        .iter()
        .map(|status| (ended(status.name()), status.name()))
        .filter(|(count, _)| *count > 0)
        .map(|(count, name)| format!("{count} {name}"))
        .collect();
    if !others.is_empty() {
        writeln!(out, "Not complete: {}.", others.join(", "))?;
    }
    for run in findings.runs.iter().filter(|run| !run.note.is_empty()).take(5) {
        writeln!(
            out,
            "  run {} ({}, {}): {}: {}",
            run.run, assessment.regimes[run.regime].name, run.speed, run.status, run.note
        )?;
    }
    writeln!(
        out,
        "\nWritten into {}: {}, {TABLE_FILE} (open {} in a browser).",
        path.display(),
        NAMES.join(", "),
        NAMES[3]
    )
}

/// Prints what verdicts depend on: the start of runs near limits, and the friction at which limits are
/// reached.
fn depends(assessment: &Assessment, findings: &AssessmentFindings, out: &mut impl Write) -> io::Result<()> {
    let name = |own: &LimitVerdict| {
        format!(
            "{} {} ({})",
            assessment.regimes[own.regime].name,
            assessment.limits.limits[own.limit].name,
            assessment.conditions[own.condition].name,
        )
    };
    let near = findings.verdicts.iter();
    let near = near.filter_map(|own| Some((own, own.depends.other_start.as_ref()?, own.worst.as_ref()?)));
    for (place, (own, other, worst)) in near.enumerate() {
        if place == 0 {
            writeln!(out, "\nWithin {:.0} % of a limit, from two starts:", 100.0 * NEAR)?;
        }
        let unit = &assessment.limits.limits[own.limit].unit;
        writeln!(
            out,
            "  {}, {}: {}",
            name(own),
            worst.speed,
            other.words(worst.value, unit)
        )?;
    }
    let over = findings.verdicts.iter();
    let over = over.filter_map(|own| Some((own, own.depends.friction.as_ref()?)));
    let turns = |own: &&(&LimitVerdict, &OverFriction)| own.0.turned_by().contains(&"friction");
    let (reached, others): (Vec<_>, Vec<_>) = over.partition(|own| turns(&own));
    if let Some((_, first)) = reached.first().or(others.first()) {
        writeln!(out, "\nOver the friction of wheel on rail (here {}):", first.own)?;
    }
    for (own, friction) in &reached {
        writeln!(out, "  {}: {}", name(own), friction.words(own.word()))?;
    }
    if let Some((_, first)) = others.first() {
        let [from, to] = first.range();
        writeln!(out, "  {} verdicts stay from {from} to {to}.", others.len())?;
    }
    Ok(())
}
