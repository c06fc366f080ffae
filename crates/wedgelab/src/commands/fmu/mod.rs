//! `wedgelab fmu`: functional mock-up units.

mod export;
mod merge;
mod ssp;

use std::process::ExitCode;

use clap::{Args, Subcommand};

use crate::failure::Failure;

/// Write wedges as functional mock-up units (FMI 2.0 and 3.0)
///
/// A functional mock-up unit is a file that a vehicle dynamics program loads as an element of its own: bolster and side frame move
/// there, forces and moments come from the wedge.
#[derive(Debug, Args)]
pub struct Arguments {
    #[command(subcommand)]
    command: Command,
}

#[derive(Debug, Subcommand)]
enum Command {
    Export(export::Arguments),
    Merge(merge::Arguments),
    Ssp(ssp::Arguments),
}

/// Does it.
pub fn execute(arguments: &Arguments) -> Result<ExitCode, Failure> {
    match &arguments.command {
        Command::Export(arguments) => export::execute(arguments),
        Command::Merge(arguments) => merge::execute(arguments),
        Command::Ssp(arguments) => ssp::execute(arguments),
    }
}
