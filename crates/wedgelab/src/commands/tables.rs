//! `wedgelab tables`: a nest's force and warp moment as tables for other programs, with their error.

use std::io::{self, Write};
use std::path::PathBuf;
use std::process::ExitCode;

use clap::Args;
use fmi::description::Version;
use report::tables_files::{self as files, CSV, NAMES, PWL};
use report::tables_work;
use study::tables::{Lists, TablesError, TablesRequest};

use super::fmu;
use super::warp::truck;
use crate::execute::jobs;
use crate::failure::{Failure, Message, say};
use crate::folders;
use crate::interrupt;
use crate::progress::Steady;

/// A nest's force and warp moment over load, rise, friction and rate, as tables for other programs
///
/// Moves one nest of a truck up and down, and warps it, at every node of a grid, and writes both branches of
/// each loop: nest.csv and warp.csv, nest.pwl and warp.pwl (piecewise linear functions of NUCARS: mean of
/// the branches, half of their difference) and tables.json. Runs between the nodes and at half the amplitude
/// say how far the tables are off: printed, in tables.json and at the head of the functions. --fmu writes a
/// functional mock-up unit of both tables besides.
#[derive(Debug, Args)]
#[command(after_long_help = "\
Examples:
  wedgelab tables
  wedgelab tables my_truck.toml --load \"15 kip\" \"35 kip\" \"60 kip\" --friction 0.4
  wedgelab tables truck_crowned_vertical_constant --rise \"0 in\" \"0.5 in\" \"1 in\" --rate \"0.5 Hz\"

A list of one value makes that direction a constant.")]
pub struct Arguments {
    /// Case file of a truck, or the name of a built-in one
    #[arg(default_value = "truck_crowned_vertical_variable")]
    case: PathBuf,
    /// Loads of a nest at zero stroke [default: 0.3, 0.6 and 1 of what its coils carry in the nominal
    /// layout]
    #[arg(long, value_name = "FORCE", num_args = 1..)]
    load: Vec<String>,
    /// Rises of all wedges [default: "0 in" "0.75 in"]
    #[arg(long, value_name = "RISE", num_args = 1..)]
    rise: Vec<String>,
    /// Coefficients of friction of all wedges at column and slope [default: 0.2 0.35 0.5]
    #[arg(long, value_name = "MU", num_args = 1..)]
    friction: Vec<String>,
    /// Frequencies of the motion [default: "0.1 Hz" "1 Hz"]
    #[arg(long, value_name = "FREQUENCY", num_args = 1..)]
    rate: Vec<String>,
    /// Amplitude of the stroke [default: 0.5 in]
    #[arg(long, value_name = "LENGTH")]
    stroke: Option<String>,
    /// Amplitude of the warp angle [default: 20 mrad]
    #[arg(long, value_name = "ANGLE")]
    angle: Option<String>,
    /// Write nest.fmu too: both tables as a functional mock-up unit, of this version of the standard
    #[arg(long, value_name = "VERSION", value_parser = fmu::export::version)]
    fmu: Option<Version>,
    /// The library for the FMU [default: the one that this program carries]
    #[arg(long, value_name = "FILE", requires = "fmu")]
    library: Option<PathBuf>,
    /// Say what would be run and how long it takes, and run nothing
    #[arg(long)]
    cost: bool,
    /// Set one value over those of the case
    #[arg(long, value_name = "PATH.KEY=VALUE")]
    set: Vec<String>,
    /// Number of runs at a time [default: number of processors]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..))]
    jobs: Option<u16>,
    /// Folder to write into [default: NAME_tables]
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// Overwrite existing results
    #[arg(long)]
    force: bool,
    /// No progress
    #[arg(long, short)]
    quiet: bool,
}

/// The FMU.
const FMU: &str = "nest.fmu";

/// CPU time of a second of a test, s: measured, of built-in trucks on a machine of 2024.
const CPU_TIME: f64 = 0.03;

/// Executes the command.
pub fn execute(arguments: &Arguments) -> Result<ExitCode, Failure> {
    interrupt::listen();
    let case = truck(&arguments.case, &arguments.set)?;
    let lists = Lists {
        directions: [
            &arguments.load,
            &arguments.rise,
            &arguments.friction,
            &arguments.rate,
        ]
        .map(Clone::clone),
        amplitudes: [arguments.stroke.clone(), arguments.angle.clone()],
    };
    let request = TablesRequest::new(&case, &lists).map_err(refused)?;
    let jobs = jobs(arguments.jobs);
    let runs = request.wanted().len();
    let seconds = request.simulated() * CPU_TIME / jobs.min(runs) as f64;
    let cost = format!(
        "{} nodes, {runs} runs of {:.0} s in all: about {seconds:.0} s at {jobs} at a time (a guess from \
         runs of built-in trucks)",
        request.grid.count(),
        request.simulated(),
    );
    if arguments.cost {
        writeln!(io::stdout().lock(), "{cost}")?;
        return Ok(ExitCode::SUCCESS);
    }
    let path = arguments
        .out
        .clone()
        .unwrap_or_else(|| PathBuf::from(format!("{}_tables", case.name)));
    let library = arguments.library.as_deref();
    let mut names = NAMES.to_vec();
    if arguments.fmu.is_some() {
        fmu::check(library)?;
        names.push(FMU);
    }
    let folder = folders::check(path, &names, arguments.force)?;
    if !arguments.quiet {
        say(&cost);
    }
    interrupt::stops(
        "stopping: nothing is written (once more: ends at once)",
        "nothing was written",
    );
    let progress = Steady::new("runs", runs as u64, 0, arguments.quiet);
    let found = tables_work::run(&request, jobs, &interrupt::go_on, &|| progress.done());
    progress.finish();
    if interrupt::wanted() {
        let message = Message::new(
            format!("{}: the tables are not made", interrupt::REASON),
            "nothing is written; the same command begins anew",
        );
        return Err(Failure::Interrupted(message.into()));
    }
    let Some(findings) = found.map_err(refused)? else {
        return Ok(ExitCode::SUCCESS);
    };
    for (warning, count) in &findings.warnings {
        say(&format!("warning: {count} of {runs} runs: {warning}"));
    }
    let units = case.simulation.output_units;
    let summary = files::summary(&findings);
    let unit = arguments
        .fmu
        .map(|version| fmu::of_tables(&case, &findings.tables, version, library));
    let unit = unit.transpose()?;
    folder.write(|all| {
        all.add(files::SUMMARY, |out| {
            Ok(serde_json::to_writer_pretty(out, &summary)?)
        })?;
        for (number, (csv, pwl)) in CSV.into_iter().zip(PWL).enumerate() {
            all.add(csv, |out| files::write_csv(&findings.tables, number, units, out))?;
            all.add(pwl, |out| files::write_pwl(&findings.tables, number, out))?;
        }
        match &unit {
            Some(bytes) => all.add(FMU, |out| out.write_all(bytes)),
            None => Ok(()),
        }
    })?;
    let mut out = io::stdout().lock();
    files::print(&findings, &mut out)?;
    writeln!(
        out,
        "\nWritten into {}: {}.",
        folder.path().display(),
        names.join(", ")
    )?;
    Ok(ExitCode::SUCCESS)
}

/// Returns the failure of a request or of its runs.
fn refused(error: TablesError) -> Failure {
    match error {
        TablesError::Case(error) => error.into(),
        other => {
            let message = Message::new(other.to_string(), other.help());
            match other {
                TablesError::Run { .. } => Failure::Failed(message.into()),
                _ => message.into(),
            }
        }
    }
}
