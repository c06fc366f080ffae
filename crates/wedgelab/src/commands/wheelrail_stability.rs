//! `wedgelab wheelrail stability`: hunting of one wheelset over speed.

use std::io::{self, Write};
use std::ops::ControlFlow;
use std::path::PathBuf;
use std::process::ExitCode;

use clap::Args;
use quantity::{Kind, System as Units};
use report::drawn::Drawn;
use report::terminal::TerminalTable;
use report::wheelset_stability_files::{self as files, NAMES};
use study::track::TrackFile;
use study::wheelset::stability::{WheelsetStability, stability};

use super::stability::{range, spaced};
use super::wheelrail_pair::WheelRailPair;
use super::wheelrail_suspended::SuspendedArguments;
use crate::failure::{Failure, Message};
use crate::folders;
use crate::interrupt;
use crate::progress::Progress;
use crate::units::OutputUnits;

/// Prints them with the long help of the command.
const EXAMPLES: &str = "\
Examples:
  wedgelab wheelrail stability aar_1b 136re
  wedgelab wheelrail stability worn.csv 136re --load \"15 kip\" --speeds \"30 mph\"..\"150 mph\"
  wedgelab wheelrail stability cone_1:20 136re --lateral-stiffness \"150 kN/m\" \\
    --yaw-stiffness \"800 kN m/rad\" --units si";

/// Length of the track, m; nothing runs along it.
const LENGTH: f64 = 100.0;

/// Arguments of the command.
#[derive(Debug, Args)]
#[command(after_long_help = EXAMPLES)]
pub struct Arguments {
    #[command(flatten)]
    pair: WheelRailPair,
    #[command(flatten)]
    suspended: SuspendedArguments,
    /// The lowest and the highest speed
    #[arg(long, value_name = "FROM..TO", default_value = "30 mph..200 mph", value_parser = range)]
    speeds: [f64; 2],
    /// Number of speeds, at least 2
    #[arg(
        long,
        value_name = "N",
        default_value_t = 18,
        value_parser = clap::value_parser!(u32).range(2..=1000),
    )]
    steps: u32,
    /// Units of the results
    #[arg(long, value_enum, default_value_t = OutputUnits::Us)]
    units: OutputUnits,
    /// Folder to write into
    #[arg(long, value_name = "DIR", default_value = "wheelset_stability")]
    out: PathBuf,
    /// Overwrite existing results
    #[arg(long)]
    force: bool,
    /// No progress
    #[arg(long, short)]
    quiet: bool,
}

/// Executes the command.
pub fn execute(arguments: &Arguments) -> Result<ExitCode, Failure> {
    interrupt::listen();
    let units = arguments.units.system();
    let track = TrackFile::straight(LENGTH).map_err(|error| Message::new(error.to_string(), ""))?;
    let wheelset = arguments
        .suspended
        .wheelset(&arguments.pair, track, "wheelset".to_owned(), false)?;
    let folder = folders::check(&arguments.out, &NAMES, arguments.force)?;
    let progress = Progress::new(1, arguments.quiet);
    interrupt::stops_run();
    let mut reached = progress.of_run(1.0);
    let speeds = spaced(arguments.speeds, arguments.steps);
    let found = stability(&wheelset, &speeds, |share| {
        reached(share);
        match interrupt::wanted() {
            true => ControlFlow::Break(()),
            false => ControlFlow::Continue(()),
        }
    });
    progress.finish();
    let found = found.map_err(|error| Message::new(error.to_string(), error.remedy()))?;
    let title = arguments.pair.names().join(" on ");
    let figure = Drawn::of(&files::figure(&title, &found, units))?;
    folder.write(|own| {
        own.add(files::TABLE, |out| files::write_table(&found, units, out))?;
        figure.add(own, files::FIGURE, files::PICTURE)
    })?;
    let mut out = io::stdout().lock();
    table(&found, units).write(&mut out)?;
    writeln!(out, "\n{}", verdict(&found, units))?;
    writeln!(
        out,
        "About steady rolling on straight perfect track: growth of the least damped lateral vibration, \
         which hunts\nwhere it is positive. Small motions only: off them, flanges and the amplitude decide \
         (wedgelab wheelrail run)."
    )?;
    writeln!(
        out,
        "\nWritten into {}: {}.",
        folder.path().display(),
        NAMES.join(", ")
    )?;
    if found.complete {
        Ok(ExitCode::SUCCESS)
    } else {
        let message = "interrupted: the speeds that were computed are written".to_owned();
        Err(Failure::Interrupted(Message::new(message, "").into()))
    }
}

/// Returns the vibration at each speed.
fn table(found: &WheelsetStability, units: Units) -> TerminalTable {
    let head = [
        ("speed", Kind::TravelSpeed.label(units)),
        ("growth", "1/s"),
        ("frequency", "Hz"),
        ("damping ratio", ""),
    ];
    let mut table = TerminalTable::new(0, &head);
    for (speed, own) in found.speeds.iter().zip(&found.vibrations) {
        let mut cells = vec![format!("{:.1}", speed * Kind::TravelSpeed.from_si(units))];
        cells.extend(match own {
            None => ["-", "-", "-"].map(str::to_owned),
            Some(own) => {
                [own.growth_per_s, own.frequency_hz, own.damping_ratio].map(|own| format!("{own:.3}"))
            }
        });
        table.row(cells);
    }
    table
}

/// Returns in a sentence from which speed on it hunts.
fn verdict(found: &WheelsetStability, units: Units) -> String {
    let speed = |si: f64| {
        let unit = Kind::TravelSpeed.label(units);
        format!("{:.1} {unit}", si * Kind::TravelSpeed.from_si(units))
    };
    let last = found.speeds.last().copied().unwrap_or_default();
    match &found.critical {
        None => format!("Nothing grows up to {}.", speed(last)),
        Some((slowest, own)) if found.grows_at_once() => format!(
            "At {} already it hunts, at {:.2} Hz.",
            speed(*slowest),
            own.frequency_hz
        ),
        Some((slowest, own)) => format!(
            "From {} on it hunts, at {:.2} Hz.",
            speed(*slowest),
            own.frequency_hz
        ),
    }
}
