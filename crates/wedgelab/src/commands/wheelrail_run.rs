//! `wedgelab wheelrail run`: one wheelset on a track.

use std::io::{self, Write};
use std::path::PathBuf;
use std::process::ExitCode;

use clap::Args;
use quantity::{Kind, Quantity};
use report::page;
use report::run_files::RunFiles;
use report::terminal::TerminalTable;
use rolling::rig::RigStart;
use staging::Folder;
use study::models::ModelCase;
use study::track::TrackFile;
use study::wheelset::summary::WheelsetSummary;
use study::wheelset::{Wheelset, WheelsetCase};

use super::wheelrail_contact::{of_angle, of_length, of_speed};
use super::wheelrail_pair::WheelRailPair;
use super::wheelrail_suspended::SuspendedArguments;
use crate::execute::{compute, unsound, write, write_outcome};
use crate::failure::{Failure, Message};
use crate::folders;
use crate::interrupt;
use crate::progress::Progress;
use crate::units::OutputUnits;

/// Prints them with the long help of the command.
const EXAMPLES: &str = "\
Axes: x along the track, y to the left, z up. The carriage follows the track: lateral and yaw springs to its \
direction, a
load square to it, a drive that holds the speed. A wheel on the tip of its flange or off its rail has \
derailed: the run
ends there, place and time are its result, and the exit code is 3.

Examples:
  wedgelab wheelrail run aar_1b 136re my_track.toml --speed \"60 mph\"
  wedgelab wheelrail run worn.csv 136re curve.toml --speed \"30 mph\" --yaw-stiffness \"20 MN m/rad\" --out \
worn
  wedgelab wheelrail run cone_1:20 136re straight.toml --speed \"5 m/s\" --lateral \"2 mm\" \
--lateral-stiffness \"0 N/m\" \\
    --yaw-stiffness \"0 N m/rad\"";

/// Arguments of the command.
#[derive(Debug, Args)]
#[command(after_long_help = EXAMPLES)]
pub struct Arguments {
    #[command(flatten)]
    pair: WheelRailPair,
    /// Track file
    track: PathBuf,
    /// Speed
    #[arg(long, value_parser = of_speed)]
    speed: Quantity,
    #[command(flatten)]
    suspended: SuspendedArguments,
    /// Distance along the track at which the run begins
    #[arg(long, value_name = "LENGTH", default_value = "2 m", value_parser = of_length)]
    start: Quantity,
    /// Lateral place at which it begins, to the left
    #[arg(
        long,
        value_name = "LENGTH",
        default_value = "0 mm",
        value_parser = of_length,
        allow_hyphen_values = true,
    )]
    lateral: Quantity,
    /// Yaw with which it begins, to the left
    #[arg(
        long,
        value_name = "ANGLE",
        default_value = "0 rad",
        value_parser = of_angle,
        allow_hyphen_values = true,
    )]
    yaw: Quantity,
    /// Duration of the run [default: to the end of the track]
    #[arg(long, value_name = "TIME", value_parser = of_time)]
    duration: Option<Quantity>,
    /// Time between two rows
    #[arg(long, value_name = "TIME", default_value = "5 ms", value_parser = of_time)]
    interval: Quantity,
    /// Relative tolerance of the integrator
    #[arg(long, value_name = "NUMBER", default_value_t = 1e-5)]
    tolerance: f64,
    /// Units of the results
    #[arg(long, value_enum, default_value_t = OutputUnits::Us)]
    units: OutputUnits,
    /// Folder to write into [default: the track's name behind `wheelset_`]
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// Overwrite existing results
    #[arg(long)]
    force: bool,
    /// No progress
    #[arg(long, short)]
    quiet: bool,
}

fn of_time(text: &str) -> Result<Quantity, String> {
    Quantity::parse_as(text, Kind::Time).map_err(|error| format!("{error}; {}", error.help()))
}

/// Executes the command.
pub fn execute(arguments: &Arguments) -> Result<ExitCode, Failure> {
    interrupt::listen();
    let track = TrackFile::read(&arguments.track)?;
    let name = format!("wheelset_{}", track.name);
    let path = arguments.out.clone().unwrap_or_else(|| PathBuf::from(&name));
    let case = WheelsetCase::new(wheelset(arguments, track, name)?)
        .map_err(|error| Message::new(error.to_string(), error.remedy()))?;
    let names = [case.names(&case.output_files()), vec![page::FILE_NAME]].concat();
    let folder = folders::check(path, &names, arguments.force)?;
    let progress = Progress::new(1, arguments.quiet);
    interrupt::stops_run();
    let done =
        compute(&case, &progress).and_then(|done| write(&done, &case, &folder, &progress).map(|()| done));
    progress.finish();
    let result = done?.result;
    let html = page::wheelset::render(&case, &result).map_err(|error| {
        let message = format!("cannot write the page's data: {error}");
        Failure::Failed(Message::new(message, "").into())
    })?;
    Folder::check(folder.path(), &[page::FILE_NAME], true)?
        .write(|files| files.add(page::FILE_NAME, |out| out.write_all(html.as_bytes())))?;
    let mut out = io::stdout().lock();
    write_outcome(&result.summary, &mut out)?;
    print_summary(&result.summary, &mut out)?;
    writeln!(
        out,
        "\nWritten into {}: {} (open it in a browser).",
        folder.path().display(),
        names.join(", ")
    )?;
    match unsound::<WheelsetCase>(&result.summary, folder.path()) {
        Some(failure) => Err(failure),
        None => Ok(ExitCode::SUCCESS),
    }
}

fn wheelset(arguments: &Arguments, track: TrackFile, name: String) -> Result<Wheelset, Failure> {
    let given = [
        ("speed", arguments.speed.to_string()),
        ("start", arguments.start.to_string()),
        ("lateral at the start", arguments.lateral.to_string()),
        ("yaw at the start", arguments.yaw.to_string()),
        ("interval", arguments.interval.to_string()),
    ];
    let mut own = arguments.suspended.wheelset(&arguments.pair, track, name, true)?;
    own.given
        .extend(given.map(|(name, value)| (name.to_owned(), value)));
    if let Some(duration) = &arguments.duration {
        own.given.insert("duration".to_owned(), duration.to_string());
    }
    Ok(Wheelset {
        speed: arguments.speed.to_si(),
        start: RigStart {
            distance: arguments.start.to_si(),
            lateral: arguments.lateral.to_si(),
            yaw: arguments.yaw.to_si(),
        },
        duration: arguments.duration.as_ref().map(Quantity::to_si),
        interval: arguments.interval.to_si(),
        relative_tolerance: arguments.tolerance,
        units: arguments.units.system(),
        ..own
    })
}

/// Prints the table of the wheels and the lines below it.
fn print_summary(summary: &WheelsetSummary, out: &mut impl Write) -> io::Result<()> {
    let units = summary.units;
    let force = Kind::Force.label(units);
    let of = |side: &str, what: &str, kind: Kind| {
        let name = format!("{side}_{what}");
        let name = match kind.suffix(units) {
            "" => name,
            suffix => format!("{name}_{suffix}"),
        };
        summary.extremes.get(&name)
    };
    let mut table = TerminalTable::new(
        1,
        &[
            ("wheel", ""),
            ("vertical force, least", force),
            ("largest", force),
            ("lateral force, largest", force),
            ("L/V, largest", ""),
            ("wear number, largest", force),
        ],
    );
    for side in ["left", "right"] {
        let vertical = of(side, "vertical_force", Kind::Force);
        let cell = |value: Option<f64>, digits: usize| {
            value.map_or("-".to_owned(), |value| format!("{value:.digits$}"))
        };
        let largest = |what: &str, kind: Kind| of(side, what, kind).map(|found| found.maximum);
        table.row([
            side.to_owned(),
            cell(vertical.map(|found| found.minimum), 0),
            cell(vertical.map(|found| found.maximum), 0),
            cell(largest("lateral_force", Kind::Force), 0),
            cell(largest("lateral_over_vertical", Kind::Dimensionless), 3),
            cell(largest("wear_number", Kind::Force), 1),
        ]);
    }
    table.write(out)?;
    if let Some(found) = &summary.hunting {
        let what = if found.damping_ratio < 0.0 {
            "the wheelset hunts"
        } else {
            "it dies out"
        };
        writeln!(
            out,
            "\nAbout steady rolling at this speed on straight perfect track the least damped lateral \
             vibration has {:.2} Hz and a\ndamping ratio of {:.3}: {what}.",
            found.frequency_hz, found.damping_ratio
        )?;
    }
    Ok(())
}
