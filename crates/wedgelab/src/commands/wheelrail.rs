//! `wedgelab wheelrail`: profiles of wheels and rails, and the motion of a wheelset on them.

use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::process::ExitCode;

use clap::{Args, Subcommand};
use quantity::{Kind as Measure, Quantity};
use report::wheelrail_files::{self, NAMES};
use wheelrail::conicity::RollingRadiusDifference;
use wheelrail::hertz::Material;
use wheelrail::profile::{Profile, ProfileError, ProfileKind, nominal};
use wheelrail::wheelset::{Layout, RigidPosition, RigidWheelset};

use super::{wheelrail_contact, wheelrail_run, wheelrail_stability};
use crate::drawn::Drawn;
use crate::failure::{Failure, Message};
use crate::folders;
use crate::table::TerminalTable;

/// Profiles of wheels and rails: checks, rolling radius difference, contact angles, equivalent conicity,
/// contact; a wheelset that runs
///
/// WHEEL is aar_1b, cylinder, cone_1:20 (any slope), or a file; RAIL is 136re, or a file: CSV with units in
/// its header, or Simpack's .prw and .prr. The nominal profiles are from memory, not from drawings.
#[derive(Debug, Args)]
#[command(after_long_help = "\
Examples:
  wedgelab wheelrail check aar_1b 136re
  wedgelab wheelrail plot worn.csv rail.prr --gauge \"56.75 in\" --out worn
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
    Check(WheelRailPair),
    /// Does the same, and writes wheelrail.csv, wheelrail.svg and wheelrail.png
    Plot {
        #[command(flatten)]
        pair: WheelRailPair,
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

/// A wheel and a rail, and where they are.
#[derive(Debug, Args)]
pub(super) struct WheelRailPair {
    /// Wheel profile
    wheel: String,
    /// Rail profile
    rail: String,
    /// Gauge
    #[arg(long, default_value = "56.5 in", value_parser = length)]
    gauge: Quantity,
    /// Depth below the datum of the rail, z = 0 of its file, at which gauge is measured [default: 5/8 in;
    /// 14 mm for rails from .prr]
    #[arg(long, value_name = "DEPTH", value_parser = length)]
    gauge_depth: Option<Quantity>,
    /// Distance of the tape circles of the wheels [default: 59.5 in; 1500 mm for wheels from .prw]
    #[arg(long, value_name = "DISTANCE", value_parser = length)]
    tape_distance: Option<Quantity>,
    /// Nominal radius of the wheels [default: 18 in; 460 mm for wheels from .prw]
    #[arg(long, value_parser = length)]
    radius: Option<Quantity>,
    /// Inclination of the rails, such as 1:40 or 0 [default: 1:40 for nominal rails, 0 for files]
    #[arg(long, value_name = "SLOPE", value_parser = slope)]
    inclination: Option<f64>,
    /// Largest distance of splines from the points of a file [default: 0.02 mm; 0 for contact]
    #[arg(long, value_name = "LENGTH", value_parser = length_or_zero)]
    deviation: Option<Quantity>,
    /// Largest lateral shift
    #[arg(long, value_name = "SHIFT", default_value = "0.5 in", value_parser = length)]
    shift: Quantity,
}

pub(super) fn length(text: &str) -> Result<Quantity, String> {
    let quantity = length_or_zero(text)?;
    if quantity.to_si() > 0.0 {
        Ok(quantity)
    } else {
        Err("it must be positive".to_owned())
    }
}

fn length_or_zero(text: &str) -> Result<Quantity, String> {
    let quantity = Quantity::parse_as(text, Measure::Length).map_err(|error| error.to_string())?;
    if quantity.to_si() >= 0.0 && quantity.to_si() < 10.0 {
        Ok(quantity)
    } else {
        Err("it must lie between 0 and 10 m".to_owned())
    }
}

/// Returns a slope as a ratio (1:40) or a number.
fn slope(text: &str) -> Result<f64, String> {
    let number = |text: &str| {
        text.trim()
            .parse::<f64>()
            .map_err(|_| "write for example 1:40 or 0.025".to_owned())
    };
    let value = match text.split_once(':') {
        Some((rise, run)) => number(rise)? / number(run)?,
        None => number(text)?,
    };
    if (-0.5..=0.5).contains(&value) {
        Ok(value)
    } else {
        Err("it must lie between -0.5 and 0.5".to_owned())
    }
}

/// Returns the given value, m, or else the usual one of Simpack's files, or of others.
fn or_usual(given: Option<&Quantity>, simpack: bool, usual: [f64; 2]) -> f64 {
    given.map_or(usual[usize::from(!simpack)], Quantity::to_si)
}

const INCH: f64 = 0.0254;
/// Default of the largest distance of splines from the points of a file, m.
pub(super) const DEVIATION: f64 = 2e-5;
/// Half width of a conical tread, m.
const TREAD: f64 = 2.0 * INCH;
const STEEL: Material = Material {
    youngs_modulus: 207e9,
    poisson: 0.27,
};
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
    let (wheel, rail) = (pair.wheel(DEVIATION)?, pair.rail(DEVIATION)?);
    let (layout, radius) = (pair.layout(), pair.radius());
    let wheelset = RigidWheelset::new([&wheel; 2], [radius; 2], [&rail; 2], layout, STEEL)
        .map_err(|error| wrong(&error))?;
    let largest = pair.shift.to_si();
    let positions = wheelset.sweep(largest, POSITIONS, false);
    if positions.len() < 3 {
        wheelset.check_reach().map_err(|error| wrong(&error))?;
        let message = "nowhere are both wheels over their rails";
        return Err(Message::new(message, "look at gauge and tape distance").into());
    }
    let difference = RollingRadiusDifference::of_positions(&positions)
        .map_err(|error| Message::new(error.to_string(), "look at gauge, tape distance and shift"))?;
    let amplitudes = (1..=POSITIONS / 2).map(|i| largest * i as f64 / (POSITIONS / 2) as f64);
    // Towards the ends of the range the motion about a middle that is not zero leaves the table.
    let conicity: Vec<(f64, f64)> = amplitudes
        .filter_map(|amplitude| {
            let found = difference
                .equivalent_conicity(amplitude, radius, layout.tape_distance)
                .ok()?;
            Some((amplitude, found.by_wavelength))
        })
        .collect();
    let mut out = io::stdout().lock();
    for profile in [&wheel, &rail] {
        let word = profile.kind().word();
        let deviation = profile.deviation();
        writeln!(out, "{word}: {}", profile.name())?;
        if !profile.note().is_empty() {
            writeln!(out, "  {}", profile.note())?;
        }
        if deviation.largest > 0.0 {
            writeln!(
                out,
                "  a spline at most {:.4} mm from its points",
                1e3 * deviation.largest
            )?;
        }
    }
    let [center, _] = wheelset.rail_origins();
    let gauge_point = 0.5 * layout.gauge - center;
    writeln!(out, "  {}", placed(&rail, gauge_point, layout.gauge_depth))?;
    writeln!(
        out,
        "  y = 0 lies {:.3} mm from the middle of the track\n",
        1e3 * center
    )?;
    table(&positions, &conicity, largest).write(&mut out)?;
    writeln!(
        out,
        "\nShift: of the wheelset to the left, at the height of the rails' tops. Angles: left, right. \
         Conicity: equivalent, after\n\
         EN 15302, at an amplitude of that size; - where the wheelset does not swing or the amplitude is \
         not covered."
    )?;
    if let Some(folder) = folder {
        let figure = Drawn::of(&wheelrail_files::figure(&wheel, &rail, &positions, &conicity))?;
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

pub(super) fn wrong(error: &ProfileError) -> Failure {
    Message::new(error.to_string(), error.remedy()).into()
}

impl WheelRailPair {
    /// Returns the names of wheel and rail.
    pub(super) fn names(&self) -> [&str; 2] {
        [&self.wheel, &self.rail]
    }

    pub(super) fn layout(&self) -> Layout {
        let (depth, distance) = (Self::is_simpack(&self.rail), Self::is_simpack(&self.wheel));
        Layout {
            tape_distance: or_usual(
                self.tape_distance.as_ref(),
                distance,
                [1.5, nominal::TAPE_DISTANCE],
            ),
            gauge: self.gauge.to_si(),
            gauge_depth: or_usual(self.gauge_depth.as_ref(), depth, [14e-3, nominal::GAUGE_DEPTH]),
        }
    }

    /// Returns the nominal radius of the wheels, m.
    pub(super) fn radius(&self) -> f64 {
        or_usual(
            self.radius.as_ref(),
            Self::is_simpack(&self.wheel),
            [0.46, 18.0 * INCH],
        )
    }

    /// Simpack's files mostly hold European profiles.
    fn is_simpack(name: &str) -> bool {
        let extension = Path::new(name)
            .extension()
            .and_then(|extension| extension.to_str());
        extension.is_some_and(|own| own.eq_ignore_ascii_case("prw") || own.eq_ignore_ascii_case("prr"))
    }

    /// Returns the wheel; splines lie at most `deviation` (m) from their points if nothing is given.
    pub(super) fn wheel(&self, deviation: f64) -> Result<Profile, Failure> {
        match self.wheel.as_str() {
            "aar_1b" => nominal::aar_1b().map_err(|error| wrong(&error)),
            "cylinder" => nominal::cone(0.0, TREAD).map_err(|error| wrong(&error)),
            name => match name.strip_prefix("cone_") {
                Some(text) => {
                    let slope = slope(text)
                        .map_err(|reason| Message::new(format!("`{name}`: {reason}"), "write cone_1:20"))?;
                    nominal::cone(slope, TREAD).map_err(|error| wrong(&error))
                }
                None => self.of_file(name, ProfileKind::Wheel, "aar_1b, cylinder, cone_1:20", deviation),
            },
        }
    }

    /// As [`WheelRailPair::wheel`].
    pub(super) fn rail(&self, deviation: f64) -> Result<Profile, Failure> {
        let (rail, usual) = match self.rail.as_str() {
            "136re" => (nominal::rail_136re().map_err(|error| wrong(&error))?, 1.0 / 40.0),
            name => (self.of_file(name, ProfileKind::Rail, "136re", deviation)?, 0.0),
        };
        Ok(match self.inclination.unwrap_or(usual) {
            0.0 => rail,
            slope => rail.inclined(slope),
        })
    }

    fn of_file(
        &self,
        name: &str,
        kind: ProfileKind,
        nominal: &str,
        deviation: f64,
    ) -> Result<Profile, Failure> {
        let path = Path::new(name);
        if !path.exists() {
            let message = format!("there is neither a file nor a nominal {} `{name}`", kind.word());
            let advice = format!("name a file of points, or {nominal}");
            return Err(Message::new(message, advice).into());
        }
        let deviation = self.deviation.as_ref().map_or(deviation, Quantity::to_si);
        Profile::read(path, kind, deviation).map_err(|error| wrong(&error))
    }
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
