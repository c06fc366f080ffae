//! The options of a wheelset under a carriage, of all commands that run or linearize one.

use std::collections::BTreeMap;
use std::f64::consts::PI;
use std::sync::Arc;

use clap::{Args, ValueEnum};
use quantity::{Kind, Quantity, System as Units};
use rolling::rig::RigStart;
use rolling::wheelset::WheelsetBody;
use study::track::TrackFile;
use study::wheelset::{SearchMode, Wheelset};
use wheelrail::contact::{CreepLaw, Flat, Harmonic, OutOfRound, WheelForm};
use wheelrail::creep::fastsim::StripGrid;
use wheelrail::creep::polach;
use wheelrail::friction::Friction;
use wheelrail::hertz::Material;

use super::wheelrail_contact::{Creep, Form};
use super::wheelrail_pair::{DEVIATION, ProfiledPair, WheelRailPair, word, wrong};
use crate::failure::Failure;

/// Steel.
const STEEL: Material = Material {
    youngs_modulus: 207e9,
    poisson: 0.28,
};

/// Interval of rows (s) and relative tolerance where no run is made.
const INTERVAL: f64 = 0.005;
const TOLERANCE: f64 = 1e-5;

/// A wheelset's mass properties, load, springs and contact.
#[derive(Debug, Args)]
pub struct SuspendedArguments {
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
    /// Coefficient of friction on the gauge face, above a contact angle of 30 deg; between 20 and 30 deg it
    /// goes over from that of the tread [default: that of the tread]
    #[arg(long, value_name = "FRICTION")]
    gauge_face_friction: Option<f64>,
    /// Length of a fresh flat on both wheels, up at the start
    #[arg(long, value_name = "LENGTH", value_parser = of_length)]
    flat: Option<Quantity>,
    /// Waves of the radius of both wheels: their number in a turn, and their amplitude; several are added
    #[arg(long, value_name = "ORDER=LENGTH", value_parser = polygon)]
    polygon: Vec<Polygon>,
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
    /// Contact patches: Hertz's ellipses, or strips, which need the search
    #[arg(long, value_enum, default_value_t = Form::Ellipse)]
    patch: Form,
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

/// Waves of a wheel's radius.
#[derive(Clone, Debug)]
struct Polygon {
    order: u32,
    amplitude: Quantity,
}

/// Reads `ORDER=LENGTH`.
fn polygon(text: &str) -> Result<Polygon, String> {
    let help = "write for example 3=\"0.1 mm\": three waves of 0.1 mm in a turn";
    let (order, amplitude) = text.split_once('=').ok_or_else(|| help.to_owned())?;
    let order = order
        .trim()
        .parse()
        .map_err(|_| format!("`{order}` is no number of waves; {help}"))?;
    let amplitude = of_length(amplitude.trim())?;
    Ok(Polygon { order, amplitude })
}

fn of(text: &str, kind: Kind) -> Result<Quantity, String> {
    Quantity::parse_as(text, kind).map_err(|error| format!("{error}; {}", error.help()))
}

fn of_length(text: &str) -> Result<Quantity, String> {
    of(text, Kind::Length)
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

impl SuspendedArguments {
    /// Returns the wheelset on a track, at rest in its middle; the settings of a run are the usual ones. With
    /// `over` rails may change along the track.
    pub fn wheelset(
        &self,
        pair: &WheelRailPair,
        track: TrackFile,
        name: String,
        over: bool,
    ) -> Result<Wheelset, Failure> {
        let cells = usize::from(self.cells);
        let read = pair.read_over(DEVIATION, over)?;
        let forms = self.forms(read.radii)?;
        Ok(Wheelset {
            name,
            given: self.given(pair, &read, &track),
            wheels: read.wheels,
            rails: read.rails,
            rails_over: read.over,
            forms,
            radii: read.radii,
            layout: read.layout,
            material: STEEL,
            track,
            body: WheelsetBody {
                mass: self.mass.to_si(),
                about_axle: self.spin_inertia.to_si(),
                about_diameter: self.yaw_inertia.to_si(),
            },
            axle_load: self.load.to_si(),
            speed: 0.0,
            stiffness: [self.lateral_stiffness.to_si(), self.yaw_stiffness.si],
            damping: [self.lateral_damping.to_si(), self.yaw_damping.to_si()],
            friction: Friction::by_zone(self.friction, self.gauge_face_friction.unwrap_or(self.friction)),
            creep: match self.creep {
                Creep::Linear => CreepLaw::Linear,
                Creep::ShenHedrickElkins => CreepLaw::ShenHedrickElkins,
                Creep::Polach => CreepLaw::Polach(polach::DRY),
                Creep::Fastsim => CreepLaw::Fastsim(StripGrid { cells, strips: cells }),
            },
            search: match self.search {
                How::Search => SearchMode::Search,
                How::Table => SearchMode::Table,
            },
            patch: self.patch.form(),
            start: RigStart::default(),
            duration: None,
            interval: INTERVAL,
            relative_tolerance: TOLERANCE,
            units: Units::Us,
        })
    }

    /// Returns the given values, in words.
    /// Returns the forms of wheels of these radii (m) with flats and waves.
    fn forms(&self, radii: [f64; 2]) -> Result<[Option<WheelForm>; 2], Failure> {
        if self.flat.is_none() && self.polygon.is_empty() {
            return Ok([None, None]);
        }
        let form = |radius: f64| -> Result<Option<WheelForm>, Failure> {
            let flat = self.flat.iter().map(|length| Flat {
                length: length.to_si(),
                depth: None,
                angle: PI,
            });
            let waves = self.polygon.iter().map(|own| Harmonic {
                order: own.order,
                amplitude: own.amplitude.to_si(),
                angle: 0.0,
            });
            let made =
                OutOfRound::new(radius, flat.collect(), waves.collect()).map_err(|error| wrong(&error))?;
            Ok(Some(WheelForm::OutOfRound(Arc::new(made))))
        };
        let [left, right] = radii;
        Ok([form(left)?, form(right)?])
    }

    fn given(
        &self,
        pair: &WheelRailPair,
        read: &ProfiledPair,
        track: &TrackFile,
    ) -> BTreeMap<String, String> {
        let creep = match (self.creep, self.creep.to_possible_value()) {
            (Creep::Fastsim, _) => format!("fastsim, {0} x {0} cells", self.cells),
            (_, value) => value.map_or(String::new(), |value| value.get_name().to_owned()),
        };
        let search = self.search.to_possible_value();
        let layout = read.layout;
        let millimeters = |length: f64| format!("{:.3} mm", 1e3 * length);
        let [wheel, rail] = pair.names();
        let radii = match read.radii[0] == read.radii[1] {
            true => millimeters(read.radii[0]),
            false => {
                let [left, right] =
                    [0, 1].map(|side| format!("{} ({})", millimeters(read.radii[side]), word(side)));
                format!("{left}, {right}")
            }
        };
        [
            ("wheel", wheel),
            ("rail", rail),
            ("gauge", millimeters(layout.gauge)),
            ("gauge depth", millimeters(layout.gauge_depth)),
            ("tape distance", millimeters(layout.tape_distance)),
            ("nominal radius", radii),
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
            ("axle load", self.load.to_string()),
            ("mass", self.mass.to_string()),
            ("moment of inertia about the axle", self.spin_inertia.to_string()),
            ("moment of inertia about a diameter", self.yaw_inertia.to_string()),
            ("lateral stiffness", self.lateral_stiffness.to_string()),
            ("yaw stiffness", self.yaw_stiffness.text.clone()),
            ("lateral damping", self.lateral_damping.to_string()),
            ("yaw damping", self.yaw_damping.to_string()),
            (
                "flat",
                self.flat.as_ref().map_or("none".to_owned(), Quantity::to_string),
            ),
            ("polygon", {
                let all = self
                    .polygon
                    .iter()
                    .map(|own| format!("{} of {}", own.order, own.amplitude));
                let all: Vec<String> = all.collect();
                match all.is_empty() {
                    true => "none".to_owned(),
                    false => all.join(", "),
                }
            }),
            ("friction", {
                let face = self.gauge_face_friction.filter(|face| *face != self.friction);
                face.map_or(self.friction.to_string(), |face| {
                    format!("{} (tread), {face} (gauge face)", self.friction)
                })
            }),
            ("creep", creep),
            (
                "contact",
                search.map_or(String::new(), |value| value.get_name().to_owned()),
            ),
            ("patch", self.patch.name()),
        ]
        .into_iter()
        .map(|(name, value)| (name.to_owned(), value))
        .collect()
    }
}
