//! `wedgelab nucars`: the comparison program's files.

mod check;
pub mod files;
mod load;
mod modes;
pub mod run;
mod show;

use std::process::ExitCode;

use clap::{Args, Subcommand};

use crate::failure::Failure;

/// Check, show and run files of NUCARS
///
/// Reads the .SYS, .INP, .DAT and .RUN files of NUCARS, the vehicle dynamics program that the thesis compares
/// with.
#[derive(Debug, Args)]
pub struct Arguments {
    #[command(subcommand)]
    command: Command,
}

#[derive(Debug, Subcommand)]
enum Command {
    Check(check::Arguments),
    Show(show::Arguments),
    Run(run::Arguments),
    Modes(modes::Arguments),
}

/// Executes the command.
pub fn execute(arguments: &Arguments) -> Result<ExitCode, Failure> {
    match &arguments.command {
        Command::Check(arguments) => check::execute(arguments),
        Command::Show(arguments) => show::execute(arguments),
        Command::Run(arguments) => run::execute(arguments),
        Command::Modes(arguments) => modes::execute(arguments),
    }
}
