//! `wedgelab nucars`: the comparison program's files.

mod check;
mod load;
mod show;

use std::process::ExitCode;

use clap::{Args, Subcommand};

use crate::failure::Failure;

/// Check and show input files of NUCARS
///
/// Reads the .SYS, .INP, .DAT and .RUN files of NUCARS, the vehicle dynamics program that the thesis compares with.
#[derive(Debug, Args)]
pub struct Arguments {
    #[command(subcommand)]
    command: Command,
}

#[derive(Debug, Subcommand)]
enum Command {
    Check(check::Arguments),
    Show(show::Arguments),
}

/// Does it.
pub fn execute(arguments: &Arguments) -> Result<ExitCode, Failure> {
    match &arguments.command {
        Command::Check(arguments) => check::execute(arguments),
        Command::Show(arguments) => show::execute(arguments),
    }
}
