//! `wedgelab fmu merge`: FMUs for several platforms in one file.

use std::io::{self, Write};
use std::path::PathBuf;
use std::process::ExitCode;

use clap::Args;
use fmi::package;

use super::export::may_write;
use super::write;
use crate::failure::{Failure, Message};

/// Join FMUs of the same case for several platforms into one
///
/// Each of them was exported on another platform; the result holds the libraries of all.
#[derive(Debug, Args)]
#[command(after_long_help = "\
Example:
  wedgelab fmu merge linux.fmu windows.fmu -o wedge.fmu")]
pub struct Arguments {
    /// The FMUs to join
    #[arg(required = true, num_args = 2..)]
    parts: Vec<PathBuf>,
    /// File to write
    #[arg(long, short, value_name = "FILE")]
    out: PathBuf,
    /// Overwrite an existing file
    #[arg(long)]
    force: bool,
}

/// Executes the command.
pub fn execute(arguments: &Arguments) -> Result<ExitCode, Failure> {
    may_write(&arguments.out, arguments.force)?;
    let (bytes, count) = package::merged(&arguments.parts)
        .map_err(|error| Failure::from(Message::new(error.to_string(), "nothing was written")))?;
    write(&arguments.out, arguments.force, &bytes)?;
    writeln!(
        io::stdout().lock(),
        "Written {}: libraries for {count} platforms.",
        arguments.out.display()
    )?;
    Ok(ExitCode::SUCCESS)
}
