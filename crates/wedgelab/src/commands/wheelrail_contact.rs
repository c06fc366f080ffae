//! `wedgelab wheelrail contact`: the patches of a loaded wheelset, in the frame of the program CONTACT.

mod answer;

use std::io::{self, Write};
use std::process::ExitCode;

use clap::{Args, ValueEnum};
use quantity::{Kind, Quantity, System as Units};
use serde_json::json;
use wheelrail::contact::{ContactLaw, CreepLaw, PatchForm, Side};
use wheelrail::creep::fastsim::StripGrid;
use wheelrail::creep::polach;
use wheelrail::friction::Friction;
use wheelrail::hertz::Material;
use wheelrail::loaded::{Attitude, LoadError, LoadedPatch};

use super::wheelrail_pair::{ProfiledPair, WheelRailPair, word};
use crate::failure::{Failure, Message};
use crate::json;
use crate::units::OutputUnits;
use answer::{AnswerUnits, Entries};

/// Frame and signs of the results: in the help, the table and the JSON.
const FRAME: &str = "CONTACT's: x forward, y to the right, z down, from the middle of the track at the \
                     height of the rails' tops; forward rolling is a negative pitch rate. Forces and the \
                     spin moment act on the rail, in the plane of contact; creepages are the rail's \
                     velocity less the wheel's over the speed";

/// Prints them with the long help of the command.
const EXAMPLES: &str = "\
Frame: x forward, y to the right, z down (that of the program CONTACT; everything else in wedgelab has y to \
the left and
z up). Forward rolling is a negative pitch rate. Forces act on the rail. Each wheel carries the load at a \
height of its
own. Where two areas of contact grow together they are given as one patch with a share and as two with the \
rest; forces
contain the share.

Without --pitch-rate the wheelset rolls freely: its axle spins so fast that the rails' forces make no torque
about it.
Answers are in the units of the question: those of --load, millimeters with N or inches with lbf, if not
--units says otherwise.

Examples:
  wedgelab wheelrail contact aar_1b 136re --lateral \"0.25 in\" --load \"33 kip\" --speed \"40 mph\"
  wedgelab wheelrail contact MBench_S1002_v3.prw MBench_UIC60_v3.prr --gauge \"1435 mm\" --lateral \"3 mm\" \\
    --yaw \"0.0072 rad\" --roll \"-0.0001803 rad\" --load \"10 kN\" --speed \"2 m/s\" --pitch-rate \
\"-4.3451503 rad/s\" \\
    --friction 0.3 --creep fastsim --json";

/// Arguments of the command.
#[derive(Debug, Args)]
#[command(after_long_help = EXAMPLES)]
pub struct Arguments {
    #[command(flatten)]
    pair: WheelRailPair,
    /// Lateral place of the wheelset, to the right
    #[arg(
        long,
        value_name = "LENGTH",
        default_value = "0 mm",
        value_parser = of_length,
        allow_hyphen_values = true,
    )]
    lateral: Quantity,
    /// Yaw, to the right (about z, down)
    #[arg(
        long,
        value_name = "ANGLE",
        default_value = "0 rad",
        value_parser = of_angle,
        allow_hyphen_values = true,
    )]
    yaw: Quantity,
    /// Roll, right side down (about x, forward)
    #[arg(
        long,
        value_name = "ANGLE",
        default_value = "0 rad",
        value_parser = of_angle,
        allow_hyphen_values = true,
    )]
    roll: Quantity,
    /// Vertical load of each wheel
    #[arg(long, value_name = "FORCE", value_parser = of_force, allow_hyphen_values = true)]
    load: Quantity,
    /// Forward speed
    #[arg(
        long,
        value_name = "SPEED",
        default_value = "2 m/s",
        value_parser = of_speed,
        allow_hyphen_values = true,
    )]
    speed: Quantity,
    /// Pitch rate: negative where the wheelset rolls forward [default: that of free rolling, without torque
    /// about the axle]
    #[arg(long, value_name = "RATE", value_parser = of_rate, allow_hyphen_values = true)]
    pitch_rate: Option<Quantity>,
    /// Coefficient of friction
    #[arg(
        long,
        value_name = "NUMBER",
        default_value_t = 0.3,
        allow_hyphen_values = true
    )]
    friction: f64,
    /// Coefficient of friction on the gauge face, above a contact angle of 30 deg; between 20 and 30 deg it
    /// goes over from that of the tread [default: that of the tread]
    #[arg(long, value_name = "NUMBER", allow_hyphen_values = true)]
    gauge_face_friction: Option<f64>,
    /// Creep law
    #[arg(long, value_name = "LAW", value_enum, default_value_t = Creep::Polach)]
    creep: Creep,
    /// Contact patches: Hertz's ellipses, or strips. FASTSIM takes the strips of the patch then
    #[arg(long, value_name = "FORM", value_enum, default_value_t = Form::Ellipse)]
    patch: Form,
    /// Cells and strips of FASTSIM
    #[arg(
        long,
        value_name = "NUMBER",
        default_value_t = 50,
        value_parser = clap::value_parser!(u16).range(1..=1000),
    )]
    cells: u16,
    /// Shear modulus of both bodies
    #[arg(long, value_name = "MODULUS", default_value = "82 GPa", value_parser = of_modulus)]
    shear_modulus: f64,
    /// Poisson's ratio of both bodies
    #[arg(long, value_name = "NUMBER", default_value_t = 0.28)]
    poisson: f64,
    /// Units of the answer [default: those of the load]
    #[arg(long, value_enum)]
    units: Option<OutputUnits>,
    #[arg(long, help = json::HELP)]
    json: bool,
}

/// A creep law.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
#[value(rename_all = "snake_case")]
pub(super) enum Creep {
    /// Kalker's linear theory, without saturation
    Linear,
    /// Shen, Hedrick and Elkins
    ShenHedrickElkins,
    /// Polach, clean dry rails
    Polach,
    /// Kalker's simplified theory
    Fastsim,
}

/// What contact patches are taken for.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(super) enum Form {
    /// Hertz's ellipses
    Ellipse,
    /// Strips along the rolling direction: patches that are no ellipses
    Strips,
}

impl Form {
    pub(super) fn form(self) -> PatchForm {
        match self {
            Self::Ellipse => PatchForm::Ellipse,
            Self::Strips => PatchForm::Strips,
        }
    }

    /// Returns its name.
    pub(super) fn name(self) -> String {
        self.to_possible_value()
            .map_or(String::new(), |value| value.get_name().to_owned())
    }
}

fn of(text: &str, kind: Kind) -> Result<Quantity, String> {
    Quantity::parse_as(text, kind).map_err(|error| format!("{error}; {}", error.help()))
}

pub(super) fn of_length(text: &str) -> Result<Quantity, String> {
    of(text, Kind::Length)
}

pub(super) fn of_angle(text: &str) -> Result<Quantity, String> {
    of(text, Kind::Angle)
}

fn of_force(text: &str) -> Result<Quantity, String> {
    of(text, Kind::Force)
}

pub(super) fn of_speed(text: &str) -> Result<Quantity, String> {
    of(text, Kind::Speed)
}

fn of_rate(text: &str) -> Result<Quantity, String> {
    of(text, Kind::AngularSpeed)
}

/// Returns a modulus, Pa.
fn of_modulus(text: &str) -> Result<f64, String> {
    let units = [("GPa", 1e9), ("MPa", 1e6), ("ksi", 6_894_757.293_168_361)];
    let value = units.iter().find_map(|(unit, factor)| {
        let number: f64 = text.trim().strip_suffix(unit)?.trim().parse().ok()?;
        Some(number * factor)
    });
    match value {
        Some(value) if value > 0.0 && value.is_finite() => Ok(value),
        _ => Err("write for example 82 GPa (or MPa, ksi)".to_owned()),
    }
}

/// Executes the command.
pub fn execute(arguments: &Arguments) -> Result<ExitCode, Failure> {
    let pair = &arguments.pair;
    if !(0.0..=0.5).contains(&arguments.poisson) {
        let message = format!(
            "Poisson's ratio is {}; it must be from 0 to 0.5",
            arguments.poisson
        );
        return Err(Message::new(message, "steel has 0.28").into());
    }
    // Other programs pass through the points of a file.
    let read = pair.read(0.0)?;
    let layout = read.layout;
    let material = Material {
        youngs_modulus: 2.0 * arguments.shear_modulus * (1.0 + arguments.poisson),
        poisson: arguments.poisson,
    };
    let wheelset = read.rigid(material)?.with_patches(arguments.patch.form());
    let radius = wheelset.nominal_radius();
    let cells = usize::from(arguments.cells);
    let law = ContactLaw {
        friction: Friction::by_zone(
            arguments.friction,
            arguments.gauge_face_friction.unwrap_or(arguments.friction),
        ),
        damping: 0.0,
        creep: match arguments.creep {
            Creep::Linear => CreepLaw::Linear,
            Creep::ShenHedrickElkins => CreepLaw::ShenHedrickElkins,
            Creep::Polach => CreepLaw::Polach(polach::DRY),
            Creep::Fastsim => CreepLaw::Fastsim(StripGrid { cells, strips: cells }),
        },
        slowest: 0.0,
    };
    let load = arguments.load.to_si();
    let failed = |error: LoadError| Failure::from(Message::new(error.to_string(), error.remedy()));
    let mut attitude = Attitude {
        lateral: arguments.lateral.to_si(),
        yaw: arguments.yaw.to_si(),
        roll: arguments.roll.to_si(),
        speed: arguments.speed.to_si(),
        pitch_rate: 0.0,
    };
    attitude.pitch_rate = match &arguments.pitch_rate {
        Some(rate) => rate.to_si(),
        None => wheelset.free_rolling(&attitude, load, &law).map_err(failed)?,
    };
    let of_side = |side| wheelset.loaded(side, &attitude, load, &law).map_err(failed);
    let wheels = [of_side(Side::Left)?, of_side(Side::Right)?];
    let along = [0, 1].map(|side| Along::of(&read, side, wheels[side].patches.first()));
    let given = arguments.units.map(OutputUnits::system);
    let units = AnswerUnits::of(given.or(arguments.load.system()).unwrap_or(Units::Si));
    let mut out = io::stdout().lock();
    if arguments.json {
        let creep = arguments.creep.to_possible_value();
        let mut given = Entries::default();
        for (what, profiles) in [("wheel", &read.wheels), ("rail", &read.rails)] {
            if profiles[0] == profiles[1] {
                given.put(what, profiles[0].name());
            } else {
                for side in 0..2 {
                    given.put(&format!("{}_{what}", word(side)), profiles[side].name());
                }
            }
        }
        given.add("gauge", layout.gauge, units.length);
        given.add("gauge_depth", layout.gauge_depth, units.length);
        given.add("tape_distance", layout.tape_distance, units.length);
        if read.radii[0] == read.radii[1] {
            given.add("nominal_radius", radius, units.length);
        } else {
            for side in 0..2 {
                given.add(
                    &format!("{}_nominal_radius", word(side)),
                    read.radii[side],
                    units.length,
                );
            }
        }
        given.add("lateral", attitude.lateral, units.length);
        given.put("yaw_rad", attitude.yaw);
        given.put("roll_rad", attitude.roll);
        given.add("speed", attitude.speed, units.speed);
        given.put("pitch_rate_rad_per_s", attitude.pitch_rate);
        given.put("free_rolling", arguments.pitch_rate.is_none());
        given.add("load", load, units.force);
        given.put("friction", law.friction.zones.tread);
        given.put("gauge_face_friction", law.friction.zones.gauge_face);
        given.put("creep", creep.map(|value| value.get_name().to_owned()));
        given.put("patch", arguments.patch.name());
        given.put("cells", (arguments.creep == Creep::Fastsim).then_some(cells));
        given.add("shear_modulus", arguments.shear_modulus, units.modulus);
        given.put("poisson", arguments.poisson);
        let patches = |side: usize| {
            let patches = wheels[side].patches.iter();
            patches.map(|patch| units.patch(patch)).collect::<Vec<_>>()
        };
        let mut answer = json!({
            "frame": FRAME,
            "units": units.system.name(),
            "given": given.value(),
            "left": patches(0),
            "right": patches(1),
            "left_wheel": units.wheel(&wheels[0]),
            "right_wheel": units.wheel(&wheels[1]),
        });
        for (side, own) in along.iter().enumerate() {
            let Some(own) = own else { continue };
            let mut entries = Entries::default();
            entries.add("top", own.top, units.length);
            entries.put("rise", own.rise);
            entries.add("contact_ahead", own.ahead, units.length);
            answer[format!("{}_rail_along", word(side))] = entries.value();
        }
        json::print(&answer)?;
    } else {
        units.write(&wheels, &mut out)?;
        for (side, own) in along.iter().enumerate() {
            let Some(own) = own else { continue };
            let unit = units.length.label();
            writeln!(
                out,
                "The {} rail's top lies {:.4} {unit} above z = 0 of its slices there and rises by {:.3} mm \
                 a meter: \
                 the contact lies {:.3} {unit} before the axle.",
                word(side),
                units.length.of(own.top),
                1e3 * own.rise,
                units.length.of(own.ahead)
            )?;
        }
        writeln!(
            out,
            "{}: pitch rate {:.5} rad/s; its speed over the nominal radius is {:.5} rad/s.",
            match arguments.pitch_rate {
                None => "The wheelset rolls freely",
                Some(_) => "The wheelset turns as given",
            },
            attitude.pitch_rate,
            attitude.speed / radius
        )?;
        writeln!(
            out,
            "\nFrame: {}.",
            FRAME.replace("; f", ";\nf").replace("; c", ";\nc")
        )?;
    }
    Ok(ExitCode::SUCCESS)
}

/// A rail whose section changes, where a wheel stands on it.
struct Along {
    /// Height of its highest point above z = 0 of its slices, m.
    top: f64,
    /// Its rise along the track under the patch, m/m.
    rise: f64,
    /// Distance of the contact before the axle, m: the wheel touches a surface that rises before its lowest
    /// point, at the radius times the rise.
    ahead: f64,
}

impl Along {
    /// Returns the rail of a side under a patch; none if it is the same everywhere.
    fn of(read: &ProfiledPair, side: usize, patch: Option<&LoadedPatch>) -> Option<Self> {
        let (sliced, place) = read.sliced[side].as_ref()?;
        let top = read.rails[side].top();
        // Its place on the rail: patches are placed from the middle of the track.
        let origin = 0.5 * read.layout.gauge - read.rails[side].gauge_point(read.layout.gauge_depth);
        let y = patch.map_or(top[0], |patch| patch.y.abs() - origin);
        let rise = sliced.rise(*place, y).ok()??;
        Some(Self {
            top: top[1],
            rise,
            ahead: read.radii[side] * rise,
        })
    }
}
