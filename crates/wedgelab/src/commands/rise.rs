//! `wedgelab rise`: what wedge rise costs a car, and the rise at which each limit is reached.

use std::io::{self, Write};
use std::path::PathBuf;
use std::process::ExitCode;
use std::sync::Arc;

use clap::Args;
use quantity::{Kind, Quantity};
use report::rise_files::{self as files, NAMES};
use report::rise_work::{RiseRuns, RiseTasks};
use study::rise::{RUNS, RiseRequest, Survey, inches};

use crate::execute::jobs;
use crate::failure::{Failure, Message, say};
use crate::interrupt;
use crate::progress::Steady;

/// Find the wedge rise at which a car reaches each limit, and what that depends on
///
/// Runs a car in regimes (rocking, bouncing, curves, hunting) over wedge rise and speed, closer where a
/// limit is reached, down to a sixteenth of an inch; then each other condition alone (where wear lies,
/// friction, lading, side bearings, wheels, track) and the worst two together. Writes index.html, the
/// table of an inspection rule on one page; method.html, how it was found; rise.json, rise.csv, runs.csv,
/// rise.svg, rise.png, rise.txt; runs/ keeps each run. The same command continues a survey that was
/// stopped or killed.
///
/// Tracks and limits are from memory of AAR M-1001, chapter XI: check them against your edition.
#[derive(Debug, Args)]
#[command(after_long_help = "\
Examples:
  wedgelab rise car_tangent_loaded
  wedgelab rise my_car.toml --to \"1 in\" --regimes twist_and_roll --runs 60
  wedgelab rise my_car.toml --factors mu_0.25 track_class_4 my_conditions.toml
  wedgelab rise my_car.toml --full --factors --runs 300")]
pub struct Arguments {
    /// Case file of a car, or the name of a built-in case
    car: PathBuf,
    /// Regimes by name, or your own files [default: twist_and_roll pitch_and_bounce dynamic_curving
    /// constant_curve hunting]
    #[arg(long, value_name = "REGIME", num_args = 1..)]
    regimes: Vec<String>,
    /// The highest rise [default: 1.25 in, or what the pockets hold]
    #[arg(long, value_name = "LENGTH", value_parser = length)]
    to: Option<Quantity>,
    /// Conditions that are looked at besides: names (`wedgelab regime` lists them), your own file,
    /// track_class_1 to track_class_6; the option alone: none [default: two of each factor]
    #[arg(long, value_name = "CONDITION", num_args = 0..)]
    factors: Option<Vec<String>>,
    /// Limits by name (`wedgelab regime` lists them), or your own file
    #[arg(long, value_name = "LIMITS", default_value = "aar_chapter_xi")]
    limits: String,
    /// Most runs; a greater number goes on in the same folder
    #[arg(
        long,
        value_name = "N",
        default_value_t = RUNS as u32,
        value_parser = clap::value_parser!(u32).range(1..=100_000),
    )]
    runs: u32,
    /// Run the car itself at all rises and all speeds
    #[arg(long)]
    full: bool,
    /// Say what would be run and how long it takes, and run nothing
    #[arg(long)]
    cost: bool,
    /// Set one value over those of the case
    #[arg(long, value_name = "PATH.KEY=VALUE")]
    set: Vec<String>,
    /// Folder to write into, or to continue in [default: NAME_rise]
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// Number of runs at a time [default: number of processors]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..))]
    jobs: Option<u16>,
    /// No progress
    #[arg(long, short)]
    quiet: bool,
}

/// Reads a rise above zero.
pub(super) fn length(text: &str) -> Result<Quantity, String> {
    let quantity = Quantity::parse_as(text.trim(), Kind::Length).map_err(|error| error.to_string())?;
    match quantity.to_si() > 0.0 {
        true => Ok(quantity),
        false => Err("a rise above 0 is expected".to_owned()),
    }
}

/// Executes the command.
pub fn execute(arguments: &Arguments) -> Result<ExitCode, Failure> {
    interrupt::listen();
    let survey = Survey::new(RiseRequest {
        car: arguments.car.clone(),
        set: arguments.set.clone(),
        regimes: arguments.regimes.clone(),
        limits: arguments.limits.clone(),
        to: arguments.to.clone(),
        factors: arguments.factors.clone(),
        most: arguments.runs as usize,
        full: arguments.full,
    })?;
    let path = arguments
        .out
        .clone()
        .unwrap_or_else(|| PathBuf::from(format!("{}_rise", survey.name)));
    let jobs = jobs(arguments.jobs);
    let cost = cost(&survey, jobs);
    if arguments.cost {
        writeln!(io::stdout().lock(), "{cost}")?;
        return Ok(ExitCode::SUCCESS);
    }
    if !arguments.quiet {
        say(&cost);
    }
    let kept = "the runs that were computed are kept; the same command continues";
    interrupt::stops(
        &format!("stopping after the runs at work: {kept} (once more: ends at once)"),
        kept,
    );
    let all = (survey.request.most + survey.rigs().len()) as u64;
    let progress = Steady::new("runs", all, 0, arguments.quiet);
    let survey = Arc::new(survey);
    let mut runs = RiseRuns::new(Arc::clone(&survey), &path);
    while let Some(RiseTasks { about, tasks }) = runs.next_tasks() {
        if !arguments.quiet {
            let (count, known) = (tasks.len(), runs.findings().known.len());
            say(&format!("{about}: {count} runs, {known} are known"));
        }
        let computed = runs.compute(tasks, jobs, interrupt::flag(), &|| progress.done());
        if !computed? {
            progress.finish();
            let message = Message::new("the survey was interrupted", kept);
            return Err(Failure::Interrupted(message.into()));
        }
    }
    progress.finish();
    let findings = runs.findings();
    files::write(&survey, findings, &path)?;
    let mut out = io::stdout().lock();
    write!(out, "{}", files::words(&survey, findings))?;
    writeln!(out, "\nWritten into {}: {}.", path.display(), NAMES.join(", "))?;
    Ok(ExitCode::SUCCESS)
}

/// Returns what a survey costs, in words.
fn cost(survey: &Survey, jobs: usize) -> String {
    let most = survey.request.most;
    let seconds = survey.run_time() * most as f64 * CPU_TIME / jobs as f64;
    let mut text = format!(
        "up to {most} runs of {:.0} s each, wedge rise up to {}: about {:.0} min at {jobs} runs at a time \
         (a guess from runs of built-in cars)",
        survey.run_time(),
        inches(survey.top),
        (seconds / 60.0).max(1.0)
    );
    if survey.request.full {
        let grid = survey.grid_count();
        text += &format!("; the whole grid of the car itself has {grid} runs");
        if grid > most {
            text += &format!(": --runs {grid} is the least that has room for it");
        }
    }
    text
}

/// CPU time of a second of a car in a regime, s: a guess, between 0.5 and 1.5 on machines of 2024.
const CPU_TIME: f64 = 1.0;
