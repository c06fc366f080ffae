//! `wedgelab wheelrail run`: one wheelset on a track.

use std::collections::BTreeMap;
use std::io::{self, Write};
use std::path::PathBuf;
use std::process::ExitCode;

use clap::{Args, ValueEnum};
use quantity::{Kind, Quantity};
use report::files::Folder;
use report::page;
use report::run_files::RunFiles;
use rolling::rig::RigStart;
use rolling::wheelset::WheelsetBody;
use study::track::TrackFile;
use study::wheelset::summary::WheelsetSummary;
use study::wheelset::{SearchMode, Wheelset, WheelsetCase};
use wheelrail::contact::CreepLaw;
use wheelrail::creep::fastsim::StripGrid;
use wheelrail::creep::polach;
use wheelrail::hertz::Material;

use super::wheelrail::{DEVIATION, WheelRailPair};
use super::wheelrail_contact::{Creep, of_angle, of_length, of_speed};
use crate::execute::{compute, unsound, write, write_outcome};
use crate::failure::{Failure, Message};
use crate::folders;
use crate::interrupt;
use crate::progress::Progress;
use crate::table::TerminalTable;
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

/// Steel.
const STEEL: Material = Material {
    youngs_modulus: 207e9,
    poisson: 0.28,
};

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
    /// Load of the axle on both rails, its own weight included
    #[arg(long, value_name = "FORCE", default_value = "65.75 kip", value_parser = of_force)]
    load: Quantity,
    /// Mass of the wheelset
    #[arg(long, default_value = "1250 kg", value_parser = of_mass)]
    mass: Quantity,
    /// Moment of inertia of the wheelset about its axle
    #[arg(long, value_name = "INERTIA", default_value = "150 kg m^2", value_parser = of_inertia)]
    spin_inertia: Quantity,
    /// Moment of inertia of the wheelset about a diameter
    #[arg(long, value_name = "INERTIA", default_value = "700 kg m^2", value_parser = of_inertia)]
    yaw_inertia: Quantity,
    /// Lateral stiffness between wheelset and carriage
    #[arg(long, value_name = "STIFFNESS", default_value = "2 MN/m", value_parser = of_stiffness)]
    lateral_stiffness: Quantity,
    /// Yaw stiffness between wheelset and carriage
    #[arg(long, value_name = "STIFFNESS", default_value = "2 MN m/rad", value_parser = of_yaw_stiffness)]
    yaw_stiffness: Named,
    /// Lateral damping between wheelset and carriage
    #[arg(long, value_name = "DAMPING", default_value = "20 kN s/m", value_parser = of_damping)]
    lateral_damping: Quantity,
    /// Yaw damping between wheelset and carriage
    #[arg(long, value_name = "DAMPING", default_value = "2 kN m s/rad", value_parser = of_yaw_damping)]
    yaw_damping: Quantity,
    /// Coefficient of friction
    #[arg(long, value_name = "NUMBER", default_value_t = 0.4)]
    friction: f64,
    /// Creep law
    #[arg(long, value_name = "LAW", value_enum, default_value_t = Creep::Polach)]
    creep: Creep,
    /// Cells and strips of FASTSIM
    #[arg(
        long,
        value_name = "NUMBER",
        default_value_t = 21,
        value_parser = clap::value_parser!(u16).range(1..=1000),
    )]
    cells: u16,
    /// Contact search: at each evaluation, or in tables made beforehand (faster on treads, not on flanges)
    #[arg(long, value_enum, default_value_t = How::Search)]
    search: How,
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

/// Search for contact.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum How {
    /// The search at every evaluation
    Search,
    /// Tables made beforehand
    Table,
}

/// A number of a kind that quantities do not have, with its text.
#[derive(Clone, Debug)]
struct Named {
    si: f64,
    text: String,
}

fn of(text: &str, kind: Kind) -> Result<Quantity, String> {
    Quantity::parse_as(text, kind).map_err(|error| format!("{error}; {}", error.help()))
}

fn of_force(text: &str) -> Result<Quantity, String> {
    of(text, Kind::Force)
}

fn of_mass(text: &str) -> Result<Quantity, String> {
    of(text, Kind::Mass)
}

fn of_inertia(text: &str) -> Result<Quantity, String> {
    of(text, Kind::Inertia)
}

fn of_stiffness(text: &str) -> Result<Quantity, String> {
    of(text, Kind::Stiffness)
}

fn of_damping(text: &str) -> Result<Quantity, String> {
    of(text, Kind::Damping)
}

fn of_yaw_damping(text: &str) -> Result<Quantity, String> {
    of(text, Kind::RotationalDamping)
}

fn of_time(text: &str) -> Result<Quantity, String> {
    of(text, Kind::Time)
}

/// Returns a moment by an angle.
fn of_yaw_stiffness(text: &str) -> Result<Named, String> {
    let moment = text
        .trim()
        .strip_suffix("/rad")
        .ok_or_else(|| format!("`{text}` is no stiffness against yaw; write for example 2 MN m/rad"))?;
    Ok(Named {
        si: of(moment, Kind::Moment)?.to_si(),
        text: text.to_owned(),
    })
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
    let pair = &arguments.pair;
    let cells = usize::from(arguments.cells);
    Ok(Wheelset {
        name,
        wheel: pair.wheel(DEVIATION)?,
        rail: pair.rail(DEVIATION)?,
        radius: pair.radius(),
        layout: pair.layout(),
        material: STEEL,
        given: given(arguments, &track),
        track,
        body: WheelsetBody {
            mass: arguments.mass.to_si(),
            about_axle: arguments.spin_inertia.to_si(),
            about_diameter: arguments.yaw_inertia.to_si(),
        },
        axle_load: arguments.load.to_si(),
        speed: arguments.speed.to_si(),
        stiffness: [arguments.lateral_stiffness.to_si(), arguments.yaw_stiffness.si],
        damping: [arguments.lateral_damping.to_si(), arguments.yaw_damping.to_si()],
        friction: arguments.friction,
        creep: match arguments.creep {
            Creep::Linear => CreepLaw::Linear,
            Creep::ShenHedrickElkins => CreepLaw::ShenHedrickElkins,
            Creep::Polach => CreepLaw::Polach(polach::DRY),
            Creep::Fastsim => CreepLaw::Fastsim(StripGrid { cells, strips: cells }),
        },
        search: match arguments.search {
            How::Search => SearchMode::Search,
            How::Table => SearchMode::Table,
        },
        start: RigStart {
            distance: arguments.start.to_si(),
            lateral: arguments.lateral.to_si(),
            yaw: arguments.yaw.to_si(),
        },
        duration: arguments.duration.as_ref().map(Quantity::to_si),
        interval: arguments.interval.to_si(),
        relative_tolerance: arguments.tolerance,
        units: arguments.units.system(),
    })
}

/// Returns the given values, in words.
fn given(arguments: &Arguments, track: &TrackFile) -> BTreeMap<String, String> {
    let creep = match (arguments.creep, arguments.creep.to_possible_value()) {
        (Creep::Fastsim, _) => format!("fastsim, {0} x {0} cells", arguments.cells),
        (_, value) => value.map_or(String::new(), |value| value.get_name().to_owned()),
    };
    let search = arguments.search.to_possible_value();
    let layout = arguments.pair.layout();
    let millimeters = |length: f64| format!("{:.3} mm", 1e3 * length);
    let mut given: BTreeMap<String, String> = [
        ("wheel", arguments.pair.names()[0].to_owned()),
        ("rail", arguments.pair.names()[1].to_owned()),
        ("gauge", millimeters(layout.gauge)),
        ("gauge depth", millimeters(layout.gauge_depth)),
        ("tape distance", millimeters(layout.tape_distance)),
        ("nominal radius", millimeters(arguments.pair.radius())),
        ("track", track.name.clone()),
        (
            "rails",
            if track.support.rail().is_some() {
                "sprung"
            } else {
                "rigid"
            }
            .to_owned(),
        ),
        ("speed", arguments.speed.to_string()),
        ("axle load", arguments.load.to_string()),
        ("mass", arguments.mass.to_string()),
        (
            "moment of inertia about the axle",
            arguments.spin_inertia.to_string(),
        ),
        (
            "moment of inertia about a diameter",
            arguments.yaw_inertia.to_string(),
        ),
        ("lateral stiffness", arguments.lateral_stiffness.to_string()),
        ("yaw stiffness", arguments.yaw_stiffness.text.clone()),
        ("lateral damping", arguments.lateral_damping.to_string()),
        ("yaw damping", arguments.yaw_damping.to_string()),
        ("friction", arguments.friction.to_string()),
        ("creep", creep),
        (
            "contact",
            search.map_or(String::new(), |value| value.get_name().to_owned()),
        ),
        ("start", arguments.start.to_string()),
        ("lateral at the start", arguments.lateral.to_string()),
        ("yaw at the start", arguments.yaw.to_string()),
        ("interval", arguments.interval.to_string()),
    ]
    .into_iter()
    .map(|(name, value)| (name.to_owned(), value))
    .collect();
    if let Some(duration) = &arguments.duration {
        given.insert("duration".to_owned(), duration.to_string());
    }
    given
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
