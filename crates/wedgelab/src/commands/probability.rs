//! `wedgelab probability`: the probability that a measure lies beyond a limit.

use std::io::{self, Write};
use std::path::PathBuf;
use std::process::ExitCode;

use clap::Args;
use report::probability_files::{self as files, NAMES};
use report::probability_work::{ProbabilityRuns, Unfinished};
use staging::Folder;
use study::probability::{Plan, ProbabilitySummary, estimate, indices};

use crate::drawn::Drawn;
use crate::execute::jobs;
use crate::failure::{Failure, Message};
use crate::interrupt;
use crate::json;
use crate::progress::Steady;

/// Estimate the probability that a measure lies beyond a limit where parameters are uncertain
///
/// Reads a plan (TOML): a case, its uncertain parameters with a distribution and a mark each (source,
/// derived, remembered, guess), a measure of studies with its limit, and a method: monte_carlo,
/// latin_hypercube, sobol, or subset (subset simulation, for small probabilities). Writes
/// probability.json, probability.csv (all runs), probability.svg, probability.png and probability.txt:
/// the probability with its confidence bounds, and which parameters matter. A run without a value counts
/// to both sides, a derailment as beyond the limit. The same command continues a plan that was stopped or
/// killed; results do not depend on interruptions, nor on the number of jobs.
#[derive(Debug, Args)]
#[command(after_long_help = "\
Examples:
  wedgelab probability my_plan.toml
  wedgelab probability my_plan.toml --out today --jobs 1

A plan:
  case = \"car_twist_and_roll_loaded\"
  measure = \"least_load_time\"
  at_least = \"10 %\"
  method = \"monte_carlo\"
  runs = 300
  [uncertain]
  friction.column = { distribution = \"uniform\", from = 0.3, to = 0.5, mark = \"guess\" }")]
pub struct Arguments {
    /// Plan
    plan: PathBuf,
    /// Folder to write into, or to continue in [default: NAME_probability]
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

/// Executes the command.
pub fn execute(arguments: &Arguments) -> Result<ExitCode, Failure> {
    interrupt::listen();
    let plan = Plan::read(&arguments.plan)?;
    let path = arguments
        .out
        .clone()
        .unwrap_or_else(|| PathBuf::from(format!("{}_probability", plan.name)));
    let mut runs = ProbabilityRuns::open(&path, &plan, jobs(arguments.jobs))?;
    let kept = format!(
        "the runs that ended are kept in {}. The same command goes on from there.",
        path.display()
    );
    interrupt::stops(
        "stopping: the runs under way are finished and kept (once more: ends at once)",
        &kept,
    );
    let progress = Steady::new("runs", plan.most_runs(), runs.kept(), arguments.quiet);
    let mut evaluate = |points: &[Vec<f64>]| runs.answers(points, interrupt::flag(), &|| progress.done());
    let (dimensions, seed) = (plan.uncertain.len(), plan.seed());
    let of = (dimensions, plan.limit.goal, plan.confidence);
    let found = estimate(&plan.estimator, of, &mut evaluate);
    let found = found.and_then(|found| {
        let sobol = match plan.indices {
            0 => None,
            samples => indices::sobol(samples, (dimensions, seed, plan.confidence), &mut evaluate)?,
        };
        Ok((found, sobol))
    });
    progress.finish();
    let (found, sobol) = found.map_err(|error| match error {
        Unfinished::Folder(error) => error.into(),
        Unfinished::Stopped => Failure::Interrupted(Message::new(interrupt::REASON, kept.clone()).into()),
    })?;
    interrupt::ends(&kept);
    let summary = ProbabilitySummary::new(&plan, found, sobol, &runs.runs);
    let figure = Drawn::of(&files::figure(&plan, &summary, &runs.runs))?;
    let words = files::words(&plan, &summary);
    let counted = summary.estimate.runs;
    let folder = Folder::check(&path, &NAMES, true)?;
    folder.write(|all| {
        all.add(files::SUMMARY, |out| files::write_summary(&summary, out))?;
        all.add(files::TABLE, |out| {
            files::write_table(&plan, &runs.runs, counted, out)
        })?;
        figure.add(all, files::FIGURE, files::PICTURE)?;
        all.add(files::WORDS, |out| out.write_all(words.as_bytes()))
    })?;
    if arguments.json {
        json::print(&serde_json::json!({
            "folder": path,
            "files": NAMES,
            "probability": summary.estimate.probability,
            "bounds": summary.estimate.bounds,
            "confidence": summary.estimate.confidence,
            "runs": runs.runs.len(),
            "beyond": summary.estimate.beyond,
            "unknown": summary.estimate.unknown,
            "warnings": summary.warnings,
        }))?;
        return Ok(ExitCode::SUCCESS);
    }
    let mut out = io::stdout().lock();
    writeln!(
        out,
        "{words}\nWritten into {}: {}.",
        path.display(),
        NAMES.join(", ")
    )?;
    Ok(ExitCode::SUCCESS)
}
