//! The program `fuzz`: broken inputs for every reader, in processes of their own.
//!
//! `cargo xtask fuzz --help` explains it.

/// A line on the standard output. If nobody reads there is nothing to be done.
macro_rules! say {
    ($($message:tt)*) => {{
        let _ = std::io::Write::write_fmt(
            &mut std::io::stdout(),
            format_args!("{}\n", format_args!($($message)*)),
        );
    }};
}

mod finding;
mod folder;
mod parent;
mod repeat;
mod report;
mod tally;
mod worker;

use std::num::NonZero;
use std::path::PathBuf;
use std::process::ExitCode;
use std::thread::available_parallelism;
use std::time::Duration;

use cap::Cap;
use clap::{Parser, Subcommand};
use fuzz::readers::{self, Reader};

use parent::FuzzPlan;
use repeat::Address;

/// Counts what a worker holds, and ends it where it holds too much.
#[global_allocator]
static MEMORY: Cap<std::alloc::System> = Cap::new(std::alloc::System, usize::MAX);

/// Exit code: something was found.
const FOUND: u8 = 1;
/// Exit code: the call is wrong.
const WRONG: u8 = 2;

/// Give broken inputs to every reader, and tell what breaks a promise: a panic, an abort, more than 1 s or 1
/// GB for an input, a message of more than 64 KiB, a place outside the text, a document that is another one
/// once it is written and read again. The second is that of a machine as fast as the one on which the limit
/// was chosen; a reference workload tells how much slower this one is.
#[derive(Debug, Parser)]
#[command(
    name = "fuzz",
    bin_name = "cargo xtask fuzz",
    max_term_width = 100,
    after_help = "\
An input is a function of reader, seed and number: what is found is found again with --repeat \
READER:SEED:NUMBER.

Exit codes: 0 nothing was found; 1 something was found; 2 the call is wrong."
)]
struct Cli {
    /// Seconds for all readers together, shared evenly [default: 60]
    #[arg(long, value_name = "N", conflicts_with = "executions")]
    seconds: Option<f64>,
    /// Executions of all readers together, shared evenly, instead of seconds
    #[arg(long, value_name = "N")]
    executions: Option<u64>,
    /// Only these readers
    #[arg(long, value_name = "NAME", num_args = 1..)]
    reader: Vec<String>,
    /// Seed of the inputs
    #[arg(long, value_name = "N", default_value_t = 1)]
    seed: u64,
    /// Readers that work at a time [default: one a processor]
    #[arg(long, value_name = "N")]
    jobs: Option<NonZero<usize>>,
    /// Seconds of processor time after which an input is given up
    #[arg(long, value_name = "N", default_value_t = 10.0)]
    patience: f64,
    /// Folder for the inputs of findings
    #[arg(long, value_name = "DIR")]
    save: Option<PathBuf>,
    /// Show one input and run it
    #[arg(long, value_name = "READER:SEED:NUMBER", conflicts_with_all = ["seconds", "executions", "reader"])]
    repeat: Option<Address>,
    /// With --repeat: look for a shorter input that does the same, for so many seconds
    #[arg(long, value_name = "SECONDS", requires = "repeat")]
    shorten: Option<f64>,
    #[command(subcommand)]
    hidden: Option<Hidden>,
}

#[derive(Debug, Subcommand)]
enum Hidden {
    /// The worker that the program starts for each reader
    #[command(hide = true)]
    Worker(worker::Arguments),
}

impl Cli {
    fn readers(&self) -> Result<Vec<&'static Reader>, String> {
        let known = || readers::ALL.map(|reader| reader.name);
        let names = match self.reader.as_slice() {
            [] => known().to_vec(),
            names => names.iter().map(String::as_str).collect(),
        };
        let find = |name: &str| {
            readers::find(name)
                .ok_or_else(|| format!("There is no reader `{name}`; there are {}.", known().join(", ")))
        };
        names.into_iter().map(find).collect()
    }

    fn patience(&self) -> Result<Duration, String> {
        Duration::try_from_secs_f64(self.patience)
            .map_err(|_| "--patience wants a positive number.".to_owned())
    }

    fn plan(&self) -> Result<FuzzPlan, String> {
        let readers = self.readers()?;
        let jobs = self.jobs.or(available_parallelism().ok()).map_or(1, NonZero::get);
        let seconds = match self.executions {
            Some(_) => None,
            None => Some(self.seconds.unwrap_or(60.0)),
        };
        // As many turns as it takes until each reader has had its own.
        let turns = readers.len().div_ceil(jobs);
        let time = seconds.map(|seconds| Duration::try_from_secs_f64(seconds / turns as f64));
        Ok(FuzzPlan {
            time: time
                .transpose()
                .map_err(|_| "--seconds wants a positive number.".to_owned())?,
            executions: self.executions.map(|all| all.div_ceil(readers.len() as u64)),
            readers,
            seed: self.seed,
            jobs,
            patience: self.patience()?,
        })
    }

    fn execute(self) -> Result<bool, String> {
        if let Some(address) = &self.repeat {
            return repeat::repeat(address, self.patience()?, self.shorten, self.save.as_deref());
        }
        let plan = self.plan()?;
        let results = parent::run(&plan, &|result| {
            report::print_one(result, plan.seed);
            if let Some(folder) = &self.save
                && let Err(error) = report::save(result, plan.seed, folder)
            {
                eprintln!("{} cannot be written to: {error}", folder.display());
            }
        })?;
        report::print(&results);
        Ok(results.iter().all(|result| result.found.is_empty()))
    }
}

fn main() -> ExitCode {
    let cli = match Cli::try_parse() {
        Ok(cli) => cli,
        Err(message) => {
            let _ = message.print();
            return ExitCode::from(if message.use_stderr() { WRONG } else { 0 });
        }
    };
    if let Some(Hidden::Worker(arguments)) = &cli.hidden {
        return worker::work(arguments);
    }
    match cli.execute() {
        Ok(true) => ExitCode::SUCCESS,
        Ok(false) => ExitCode::from(FOUND),
        Err(message) => {
            eprintln!("{message}");
            ExitCode::from(WRONG)
        }
    }
}
