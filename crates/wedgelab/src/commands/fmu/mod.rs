//! `wedgelab fmu`: functional mock-up units.

mod export;
mod half_truck;
mod merge;
mod ssp;

use std::path::Path;
use std::process::ExitCode;

use clap::{Args, Subcommand};

use crate::failure::{Failure, Message};
use crate::folders;
use crate::interrupt;

/// Write wedges, half-trucks, trucks, cars and vehicles as functional mock-up units (FMI 2.0 and 3.0)
///
/// A functional mock-up unit is a file that a vehicle dynamics program loads as an element of its own:
/// bolster and side frame move there, forces and moments come from the wedge; or loads on a half-truck come
/// from there, its motions go back.
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

/// Executes the command.
pub fn execute(arguments: &Arguments) -> Result<ExitCode, Failure> {
    interrupt::listen();
    match &arguments.command {
        Command::Export(arguments) => export::execute(arguments),
        Command::Merge(arguments) => merge::execute(arguments),
        Command::Ssp(arguments) => ssp::execute(arguments),
    }
}

/// Writes a file, whole or not at all.
fn write(path: &Path, force: bool, bytes: &[u8]) -> Result<(), Failure> {
    let Some(name) = path.file_name().and_then(|name| name.to_str()) else {
        let message = format!("`{}` is no name for a file", path.display());
        return Err(Message::new(message, "name a file, such as wedge.fmu").into());
    };
    let folder = match path.parent() {
        Some(parent) if !parent.as_os_str().is_empty() => parent,
        _ => Path::new("."),
    };
    let folder = folders::check(folder, &[name], force)?;
    Ok(folder.write(|files| files.add(name, |out| out.write_all(bytes)))?)
}
