//! `wedgelab stability` of a vehicle: its natural vibrations, and on a track those over the speed.

use std::io::{self, Write};
use std::ops::ControlFlow;
use std::path::PathBuf;
use std::process::ExitCode;

use report::drawn::Drawn;
use report::stability_files::{FIGURE, NUMBERS, PICTURE, TABLE};
use report::terminal::TerminalTable;
use report::vehicle_stability_files::{self, NAMES};
use study::vehicle::VehicleCase;
use study::vehicle::stability::over_speed;
use study::vehicle::summary::VibrationSummary;

use super::stability_locus::Around;
use crate::execute::started_with;
use crate::failure::{Failure, Message};
use crate::folders;
use crate::interrupt;
use crate::progress::Progress;

/// Prints the natural vibrations of a vehicle; writes those over the speed if it runs on a track.
pub fn execute(case: &VehicleCase, around: &Around<'_>, speeds: &[f64]) -> Result<ExitCode, Failure> {
    let cannot = |error: &dyn std::fmt::Display| {
        let message = format!("{} has no natural vibrations: {error}", case.name);
        Message::new(message, "look for values that are out of proportion")
    };
    let mut vehicle = started_with(case, case.vehicle())?;
    let natural = vehicle.vibrations().map_err(|error| cannot(&error))?;
    let natural: Vec<VibrationSummary> = natural.into_iter().map(VibrationSummary::of).collect();
    if case.description.on_track.is_none() {
        let what = format!(
            "of {} about its rest; what is open or slips there does not hold",
            case.name
        );
        print(&natural, &what)?;
        return Ok(ExitCode::SUCCESS);
    }
    let path = around.out.cloned();
    let path = path.unwrap_or_else(|| PathBuf::from(format!("{}_stability", case.name)));
    let folder = folders::check(path, &NAMES, around.force)?;
    let progress = Progress::new(1, around.quiet);
    interrupt::stops_run();
    let mut reached = progress.of_run(1.0);
    let found = over_speed(case, speeds, |share| {
        reached(share);
        match interrupt::wanted() {
            true => ControlFlow::Break(()),
            false => ControlFlow::Continue(()),
        }
    });
    progress.finish();
    let found = found.map_err(|error| cannot(&error))?;
    let units = case.simulation.output_units;
    let figure = Drawn::of(&vehicle_stability_files::figure(&case.name, &found, units))?;
    folder.write(|files| {
        files.add(TABLE, |out| {
            vehicle_stability_files::write_table(&found, units, out)
        })?;
        files.add(NUMBERS, |out| {
            vehicle_stability_files::write_numbers(&case.name, &found, units, out)
        })?;
        figure.add(files, FIGURE, PICTURE)
    })?;
    let what = format!(
        "of {} at its speed; what is open or slips at rest does not hold",
        case.name
    );
    print(&natural, &what)?;
    let mut out = io::stdout().lock();
    writeln!(out, "{}", found.verdict(units))?;
    writeln!(
        out,
        "\nWritten into {}: {}.",
        folder.path().display(),
        NAMES.join(", ")
    )?;
    Ok(ExitCode::SUCCESS)
}

fn print(all: &[VibrationSummary], what: &str) -> io::Result<()> {
    let mut table = TerminalTable::new(0, &[("frequency", "Hz"), ("damping ratio", "")]);
    for own in all {
        table.row([
            format!("{:.6}", own.frequency_hz),
            format!("{:.6}", own.damping_ratio),
        ]);
    }
    let mut out = io::stdout().lock();
    table.write(&mut out)?;
    writeln!(out, "\nNatural vibrations {what}.")
}
