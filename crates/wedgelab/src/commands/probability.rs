//! `wedgelab probability`: the probability that a measure lies beyond a limit.

use std::io::{self, Write};
use std::path::PathBuf;
use std::process::ExitCode;
use std::sync::Arc;
use std::time::Instant;

use clap::Args;
use report::probability_files::{self as files, NAMES};
use report::probability_work::{ProbabilityNext, ProbabilityRuns};
use study::probability::Plan;

use crate::cost::{Cost, EACH, WORTH};
use crate::execute::jobs;
use crate::failure::{Failure, Message, say};
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

/// Bytes that a run leaves on the disk, about: its record and its row.
const RUN_BYTES: u64 = 1000;

/// Executes the command.
pub fn execute(arguments: &Arguments) -> Result<ExitCode, Failure> {
    interrupt::listen();
    let plan = Arc::new(Plan::read(&arguments.plan)?);
    let path = arguments
        .out
        .clone()
        .unwrap_or_else(|| PathBuf::from(format!("{}_probability", plan.name)));
    let mut work = ProbabilityRuns::open(&path, Arc::clone(&plan))?;
    let kept = format!(
        "the runs that ended are kept in {}. The same command goes on from there.",
        path.display()
    );
    interrupt::stops(
        "stopping: the runs under way are finished and kept (once more: ends at once)",
        &kept,
    );
    let progress = Steady::new("runs", plan.most_runs(), work.kept(), arguments.quiet);
    let began = work.kept();
    let (summary, runs) = loop {
        match work.comes_next() {
            ProbabilityNext::Found(summary, runs) => break (summary, runs),
            ProbabilityNext::Missing(_) if interrupt::wanted() => {
                progress.finish();
                return Err(Failure::Interrupted(Message::new(interrupt::REASON, kept).into()));
            }
            ProbabilityNext::Missing(tasks) => {
                let jobs = jobs(arguments.jobs);
                let left = plan.most_runs() - work.kept();
                let sample = EACH * jobs;
                let judges = work.kept() == began && left > WORTH * sample as u64;
                let some = if judges && !arguments.quiet {
                    sample
                } else {
                    tasks.len()
                };
                let some: Vec<_> = tasks.into_iter().take(some).collect();
                let (count, clock) = (some.len() as u64, Instant::now());
                work.compute(some, jobs, interrupt::flag(), &|| progress.done())?;
                let cost = Cost {
                    left,
                    sample: count,
                    took: clock.elapsed(),
                    jobs,
                    bytes: RUN_BYTES,
                };
                if judges && !arguments.quiet && cost.is_long() && !interrupt::wanted() {
                    say(&format!("up to {}", cost.words()));
                }
            }
        }
    };
    progress.finish();
    interrupt::ends(&kept);
    files::write(&plan, &summary, &runs, &path)?;
    if arguments.json {
        json::print(&serde_json::json!({
            "folder": path,
            "files": NAMES,
            "probability": summary.estimate.probability,
            "bounds": summary.estimate.bounds,
            "confidence": summary.estimate.confidence,
            "runs": runs.len(),
            "beyond": summary.estimate.beyond,
            "unknown": summary.estimate.unknown,
            "warnings": summary.warnings,
        }))?;
        return Ok(ExitCode::SUCCESS);
    }
    let mut out = io::stdout().lock();
    writeln!(
        out,
        "{}\nWritten into {}: {}.",
        files::words(&plan, &summary),
        path.display(),
        NAMES.join(", ")
    )?;
    Ok(ExitCode::SUCCESS)
}
