//! `wedgelab fmu`: functional mock-up units.

pub(super) mod export;
mod half_truck;
mod merge;
mod ssp;

use std::path::Path;
use std::process::ExitCode;

use clap::{Args, Subcommand};
use fmi::description::Version;
use fmi::package;
use fmi::source::Source;
use fmi::tables::TablesOrigin;
use study::tables::NestTables;
use study::truck::TruckCase;

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

/// Returns the bytes of the FMU of tables of a nest.
pub(super) fn of_tables(
    case: &TruckCase,
    tables: &NestTables,
    version: Version,
    library: Option<&Path>,
) -> Result<Vec<u8>, Failure> {
    let (platform, library) = export::parts(library)?;
    let source = Source::NestTables(Box::new(TablesOrigin::new(case, tables)));
    let made = package::fmu(&source, version, &library, platform);
    let (bytes, _) = made.map_err(|error| Message::new(error.to_string(), "nothing was written"))?;
    Ok(bytes)
}

/// Checks whether an FMU can be made here: the library is there.
pub(super) fn check(library: Option<&Path>) -> Result<(), Failure> {
    export::parts(library).map(|_| ())
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
