//! `wedgelab wheelrail`: profiles of wheels and rails, and the motion of a wheelset on them.

use std::io::{self, Write};
use std::path::PathBuf;
use std::process::ExitCode;

use clap::{Args, Subcommand};
use report::drawn::Drawn;
use report::terminal::TerminalTable;
use report::wheelrail_files::{self, NAMES};
use wheelrail::conicity::RollingRadiusDifference;
use wheelrail::hertz::Material;
use wheelrail::loaded::Seat;
use wheelrail::profile::Profile;
use wheelrail::profile::figures::{LEAST_CLEARANCE, WheelFigures};
use wheelrail::wheelset::{RigidPosition, RigidWheelset};

use super::wheelrail_pair::{DEVIATION, ProfiledPair, WheelRailPair, word, wrong};
use super::{wheelrail_contact, wheelrail_run, wheelrail_stability};
use crate::failure::{Failure, Message, say};
use crate::folders;

/// Profiles of wheels and rails: checks, rolling radius difference, contact angles, equivalent conicity,
/// contact; a wheelset that runs
///
/// WHEEL is aar_1b, aar_1b_1:10 (any tread of at least 1:10), aar_1:20 (of before 1990), s1002, cylinder,
/// cone_1:20 (any slope), or a file; RAIL is 136re (crown 10 in), 136re_8in, 60e1, or a file: CSV with units
/// in its header, Simpack (.prw, .prr), MiniProf (.whl, .ban, .mpt), VAMPIRE (.whe, .rai), CONTACT's slices
/// (.slcs, .slcw). Each wheel and each rail may have its own. The nominal profiles are from memory or from
/// published functions, not from drawings.
#[derive(Debug, Args)]
#[command(after_long_help = "\
Examples:
  wedgelab wheelrail check aar_1b 136re
  wedgelab wheelrail plot worn.csv rail.prr --gauge \"56.75 in\" --out worn
  wedgelab wheelrail check aar_1b 136re --left-wheel worn.whl --right-radius \"17.9 in\"
  wedgelab wheelrail contact aar_1b 136re --lateral \"0.25 in\" --load \"33 kip\"
  wedgelab wheelrail run aar_1b 136re my_track.toml --speed \"60 mph\"
  wedgelab wheelrail stability aar_1b 136re --speeds \"40 mph\"..\"200 mph\"")]
pub struct Arguments {
    #[command(subcommand)]
    command: Command,
}

#[derive(Debug, Subcommand)]
enum Command {
    /// Reads and checks both profiles, and prints the rolling properties of a wheelset on them
    Check(Box<WheelRailPair>),
    /// Does the same, and writes wheelrail.csv, wheelrail.svg and wheelrail.png
    Plot {
        #[command(flatten)]
        pair: Box<WheelRailPair>,
        /// Folder to write into
        #[arg(long, value_name = "DIR", default_value = "wheelrail")]
        out: PathBuf,
        /// Overwrite existing results
        #[arg(long)]
        force: bool,
    },
    /// Gives the contact patches of a loaded wheelset in a given position: places, forces, creepages,
    /// ellipses
    Contact(Box<wheelrail_contact::Arguments>),
    /// Runs one wheelset along a track: hunting, curving, irregularities; with a page that shows it in 3D
    ///
    /// Writes result.csv (place on the track, forces of both wheels, their contact patches), summary.json and
    /// index.html.
    Run(Box<wheelrail_run::Arguments>),
    /// Stability of one wheelset over speed on straight perfect track: growth and frequency of its least
    /// damped lateral vibration, critical speed
    ///
    /// Writes stability.csv, stability.svg and stability.png.
    Stability(Box<wheelrail_stability::Arguments>),
}

const INCH: f64 = 0.0254;
const STEEL: Material = Material {
    youngs_modulus: 207e9,
    poisson: 0.27,
};
/// Shifts smaller than this are none, m.
const NOTHING: f64 = 1e-6;
/// Positions over the range of shifts.
const POSITIONS: usize = 280;

/// Executes the command.
pub fn execute(arguments: &Arguments) -> Result<ExitCode, Failure> {
    let (pair, files) = match &arguments.command {
        Command::Contact(own) => return wheelrail_contact::execute(own),
        Command::Run(own) => return wheelrail_run::execute(own),
        Command::Stability(own) => return wheelrail_stability::execute(own),
        Command::Check(pair) => (pair, None),
        Command::Plot { pair, out, force } => (pair, Some((out, *force))),
    };
    let folder = files
        .map(|(out, force)| folders::check(out, &NAMES, force))
        .transpose()?;
    let read = pair.read(DEVIATION)?;
    let layout = read.layout;
    let wheelset = read.rigid(STEEL)?;
    let radius = wheelset.nominal_radius();
    let largest = pair.shift.to_si();
    let positions = wheelset.sweep(largest, POSITIONS, false);
    if positions.len() < 3 {
        wheelset.check_reach().map_err(|error| wrong(&error))?;
        let message = "nowhere are both wheels over their rails";
        return Err(Message::new(message, "look at gauge and tape distance").into());
    }
    let difference = RollingRadiusDifference::of_positions(&positions)
        .map_err(|error| Message::new(error.to_string(), "look at gauge, tape distance and shift"))?;
    // Unlike wheels swing about another place than the middle: their motion needs shifts further out.
    let middle = if read.is_symmetric() {
        Some(0.0)
    } else {
        difference.equilibrium()
    };
    let of_motion = match middle {
        Some(middle) if middle.abs() < NOTHING => difference,
        _ => {
            let further = largest + middle.map_or(2.0 * largest, |middle| 1.5 * middle.abs());
            let positions = wheelset.sweep(further, 2 * POSITIONS, false);
            RollingRadiusDifference::of_positions(&positions).unwrap_or(difference)
        }
    };
    let amplitudes = (1..=POSITIONS / 2).map(|i| largest * i as f64 / (POSITIONS / 2) as f64);
    // Towards the ends of the range the motion about a middle that is not zero leaves the table.
    let conicity: Vec<(f64, f64)> = amplitudes
        .filter_map(|amplitude| {
            let found = of_motion
                .equivalent_conicity(amplitude, radius, layout.tape_distance)
                .ok()?;
            Some((amplitude, found.by_wavelength))
        })
        .collect();
    let mut out = io::stdout().lock();
    let profiles = |out: &mut dyn Write, what: &[Profile; 2]| -> io::Result<bool> {
        let alike = what[0] == what[1];
        for (side, profile) in what.iter().enumerate().take(if alike { 1 } else { 2 }) {
            describe(out, if alike { "" } else { word(side) }, profile)?;
            if let Some(figures) = profile.wheel_figures() {
                writeln!(out, "  {}", inspected(&figures))?;
            }
        }
        Ok(alike)
    };
    let alike = profiles(&mut out, &read.wheels)?;
    let [left, right] = read.radii;
    if alike && left == right {
        writeln!(out, "  nominal radius {:.3} mm", 1e3 * left)?;
    } else {
        for (side, radius) in read.radii.iter().enumerate() {
            writeln!(out, "  {} nominal radius {:.3} mm", word(side), 1e3 * radius)?;
        }
    }
    let alike = profiles(&mut out, &read.rails)?;
    for (side, center) in wheelset.rail_origins().into_iter().enumerate() {
        let gauge_point = 0.5 * layout.gauge - center;
        let whose = if alike {
            String::new()
        } else {
            format!("{}: ", word(side))
        };
        writeln!(
            out,
            "  {whose}{}",
            placed(&read.rails[side], gauge_point, layout.gauge_depth)
        )?;
        writeln!(
            out,
            "  {whose}y = 0 lies {:.3} mm from the middle of the track",
            1e3 * center
        )?;
        if alike {
            break;
        }
    }
    if let Some(clearance) = read.flangeway_clearance() {
        writeln!(
            out,
            "flangeway clearance {:.3} mm ({:.4} in) to each side, where gauge is measured",
            1e3 * clearance,
            clearance / INCH
        )?;
    }
    writeln!(out)?;
    doubt(&read, &wheelset, &positions);
    table(&positions, &conicity, largest).write(&mut out)?;
    writeln!(
        out,
        "\nShift: of the wheelset to the left, at the height of the rails' tops. Angles: left, right. \
         Conicity: equivalent, after\n\
         EN 15302, at an amplitude of that size; - where the wheelset does not swing or the amplitude is \
         not covered."
    )?;
    if let Some((_, words)) = off_tread(&wheelset, &positions) {
        writeln!(out, "{}.", words.replacen("from", "From", 1))?;
    }
    let middle = of_motion.equilibrium().filter(|middle| middle.abs() > NOTHING);
    if let Some(middle) = middle.filter(|_| !read.is_symmetric()) {
        writeln!(
            out,
            "The rolling radii are equal at a shift of {:.3} mm ({:.4} in): the kinematic motion is about \
             that place.",
            1e3 * middle,
            middle / INCH
        )?;
    }
    if let Some(folder) = folder {
        let figure = Drawn::of(&wheelrail_files::figure(
            &read.wheels,
            &read.rails,
            &wheelset,
            &positions,
            &conicity,
        ))?;
        folder.write(|files| {
            files.add(wheelrail_files::TABLE, |out| {
                wheelrail_files::write(&positions, out)
            })?;
            figure.add(files, wheelrail_files::FIGURE, wheelrail_files::PICTURE)
        })?;
        writeln!(
            out,
            "\nWritten into {}: {}.",
            folder.path().display(),
            NAMES.join(", ")
        )?;
    }
    Ok(ExitCode::SUCCESS)
}

/// Returns the figures of a wheel in words.
fn inspected(figures: &WheelFigures) -> String {
    let millimeters = |length: Option<f64>| match length {
        Some(length) => format!("{:.2} mm", 1e3 * length),
        None => "unknown (the back of the flange is; --tape-from-back)".to_owned(),
    };
    let slope = figures
        .slope
        .map_or("none".to_owned(), |slope| format!("{:.2} mm", 1e3 * slope));
    format!(
        "flange height Sh {}, thickness Sd {}, qR {slope}, angle {:.1} deg; hollow depth {:.2} mm",
        millimeters(Some(figures.height)),
        millimeters(figures.thickness),
        figures.angle.to_degrees(),
        1e3 * figures.hollow
    )
}

/// Warns where rolling radii and conicity mean nothing: flanges that have no room, wheels on their flanges'
/// tips or on the edges of their rims.
fn doubt(read: &ProfiledPair, wheelset: &RigidWheelset, positions: &[RigidPosition]) {
    if let Some(clearance) = read.flangeway_clearance().filter(|own| *own < LEAST_CLEARANCE) {
        say(&format!(
            "warning: the flangeway clearance is {:.3} mm to each side; below {:.0} mm the flanges touch \
             all the time \
             and the conicity means nothing: look at gauge, tape distance and the datum of the wheels",
            1e3 * clearance,
            1e3 * LEAST_CLEARANCE
        ));
    }
    if let Some((shift, words)) = off_tread(wheelset, positions)
        && read
            .flangeway_clearance()
            .is_none_or(|clearance| shift < clearance)
    {
        say(&format!(
            "warning: {words}, although its flange has not reached the rail: look at gauge, tape distance \
             and the \
             datum of the wheels"
        ));
    }
}

/// Returns the smallest shift (m) at which a wheel does not stand on its tread, and a sentence on it.
fn off_tread(wheelset: &RigidWheelset, positions: &[RigidPosition]) -> Option<(f64, String)> {
    let smallest = |a: &&RigidPosition, b: &&RigidPosition| a.shift.abs().total_cmp(&b.shift.abs());
    let off = |position: &&RigidPosition| wheelset.seats(position).iter().any(|seat| *seat != Seat::OnRail);
    let position = positions.iter().filter(off).min_by(smallest)?;
    let seats = wheelset.seats(position);
    let side = usize::from(seats[0] == Seat::OnRail);
    let part = match seats[side] {
        Seat::RimEdge => "the edge of its rim",
        _ => "the tip of its flange",
    };
    let words = format!(
        "from a shift of {:.3} mm ({:.3} in) on the {} wheel stands on {part}; rolling radii and conicity \
         mean \
         nothing there",
        1e3 * position.shift,
        position.shift / INCH,
        word(side)
    );
    Some((position.shift.abs(), words))
}

/// Writes a profile's name, remark and deviation.
fn describe(out: &mut dyn Write, side: &str, profile: &Profile) -> io::Result<()> {
    let space = if side.is_empty() { "" } else { " " };
    writeln!(out, "{side}{space}{}: {}", profile.kind().word(), profile.name())?;
    if !profile.note().is_empty() {
        writeln!(out, "  {}", profile.note())?;
    }
    let deviation = profile.deviation();
    if deviation.largest > 0.0 {
        writeln!(
            out,
            "  a spline at most {:.4} mm from its points",
            1e3 * deviation.largest
        )?;
    }
    Ok(())
}

/// Returns where gauge is measured on a rail, and what that depth is counted from.
fn placed(rail: &Profile, gauge_point: f64, depth: f64) -> String {
    let datum = match rail.datum_depth() {
        0.0 => "the top".to_owned(),
        own => format!(
            "its datum z = 0, which lies {:.3} mm {} its highest point",
            1e3 * own.abs(),
            if own > 0.0 { "below" } else { "above" }
        ),
    };
    format!(
        "gauge point at y = {:.3} mm, {:.3} mm below {datum}",
        1e3 * gauge_point,
        1e3 * depth
    )
}

/// Returns a row for some shifts.
fn table(positions: &[RigidPosition], conicity: &[(f64, f64)], largest: f64) -> TerminalTable {
    let mut table = TerminalTable::new(
        0,
        &[
            ("shift", "in"),
            ("rolling radius difference", "in"),
            ("angle, left", "deg"),
            ("angle, right", "deg"),
            ("conicity", ""),
        ],
    );
    for part in 0..=10 {
        let wanted = largest * f64::from(part) / 10.0;
        let nearest = |a: f64, b: f64| (a - wanted).abs().total_cmp(&(b - wanted).abs());
        let Some(position) = positions.iter().min_by(|a, b| nearest(a.shift, b.shift)) else {
            continue;
        };
        let [left, right] = position.contact_angles().map(f64::to_degrees);
        let found = conicity
            .iter()
            .find(|(amplitude, _)| (amplitude - wanted).abs() < 1e-9);
        table.row([
            format!("{:.3}", position.shift / INCH),
            format!("{:.5}", position.rolling_radius_difference() / INCH),
            format!("{left:.2}"),
            format!("{right:.2}"),
            found.map_or("-".to_owned(), |(_, value)| format!("{value:.4}")),
        ]);
    }
    table
}
