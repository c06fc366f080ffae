//! `wedgelab fmu ssp`: a truck with four wedges as a system structure.

use std::io::{self, Write};
use std::path::PathBuf;
use std::process::ExitCode;

use clap::Args;
use fmi::ssp;

use super::export::{may_write, parts};
use super::write;
use crate::commands::run;
use crate::failure::{Failure, Message};

/// Write a truck with four wedges of a case as a system structure (SSP 1.0)
///
/// The file holds the FMUs of wedge and truck (FMI 2.0), five components with all their connections, and the
/// values of parameters, in SI units. It is an example of how wedges are put into a vehicle.
#[derive(Debug, Args)]
#[command(after_long_help = "\
Example:
  wedgelab fmu ssp cdrun_toe_0_psi_0 -o truck.ssp")]
pub struct Arguments {
    /// Case file of the wedges, or, if there is no such file, the name of a built-in case
    case: PathBuf,
    /// File to write
    #[arg(long, short, value_name = "FILE")]
    out: PathBuf,
    /// Set one value over those of the case; VALUE is TOML (quotes around text may be left out)
    #[arg(long, value_name = "PATH.KEY=VALUE")]
    set: Vec<String>,
    /// The library for the FMUs [default: the one that this program carries]
    #[arg(long, value_name = "FILE")]
    library: Option<PathBuf>,
    /// Overwrite an existing file
    #[arg(long)]
    force: bool,
}

/// Executes the command.
pub fn execute(arguments: &Arguments) -> Result<ExitCode, Failure> {
    let case = run::read(&arguments.case, &arguments.set)?;
    may_write(&arguments.out, arguments.force)?;
    let (platform, library) = parts(arguments.library.as_deref())?;
    let (bytes, connections) = ssp::truck(&case, &library, platform)
        .map_err(|error| Failure::from(Message::new(error.to_string(), "nothing was written")))?;
    write(&arguments.out, arguments.force, &bytes)?;
    writeln!(
        io::stdout().lock(),
        "Written {}: the truck and four wedges of the case {}, {} connections.",
        arguments.out.display(),
        case.name,
        connections.len()
    )?;
    Ok(ExitCode::SUCCESS)
}
