//! The sections `[rails]` and `[wheels]`: profiles, gauge, wheelsets, creep.

use std::f64::consts::FRAC_PI_2;
use std::sync::Arc;

use car::{Parameters, ProfiledWheels, Wheels};
use quantity::Kind as Measure;
use wheelrail::conicity::LinearGeometry;
use wheelrail::contact::{ContactLaw, CreepCoefficients, CreepLaw, LinearWheelset};
use wheelrail::creep::fastsim::StripGrid;
use wheelrail::creep::polach;
use wheelrail::hertz::Material;
use wheelrail::profile::{Profile, ProfileError, ProfileKind, nominal};
use wheelrail::wheelset::{Layout, RigidWheelset};

use crate::case::field::{Reach, Written};
use crate::case::problem::Problem;
use crate::case::section::{Names, Range};
use crate::case::tables::NamedFile;
use crate::reader::schema::Form;
use crate::reader::{CaseReader, LENGTH, QuantityForm};

const INCH: f64 = 0.0254;
/// Largest distance of splines from the points of a file, m.
const DEVIATION: f64 = 0.0008 * INCH;
/// Half width of a conical tread, m.
const TREAD: f64 = 2.0 * INCH;
const STEEL: Material = Material {
    youngs_modulus: 207e9,
    poisson: 0.28,
};

/// Creep laws by name.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Creep {
    Polach,
    ShenHedrickElkins,
    Fastsim,
    Kalker,
    Frictionless,
}

const CREEPS: Names<Creep> = &[
    ("polach", Creep::Polach),
    ("shen_hedrick_elkins", Creep::ShenHedrickElkins),
    ("fastsim", Creep::Fastsim),
    ("kalker", Creep::Kalker),
    ("frictionless", Creep::Frictionless),
];

/// Rails as read: profile, gauge, its depth.
pub(crate) struct Rails {
    profile: Option<Profile>,
    gauge: f64,
    gauge_depth: f64,
}

/// Reads `[rails]`.
pub(crate) fn rails(r: &mut CaseReader<'_>) -> Rails {
    r.section("rails", "The rails: one profile, the same on both sides.");
    let name = text(
        r,
        "profile",
        "136re",
        "\"136re\" (nominal, from memory) or a file: CSV with units, Simpack's .prr",
    );
    let from_file = name != "136re";
    let mut inclination = if from_file { 0.0 } else { nominal::INCLINATION };
    let range = Range::Between(-0.5, 0.5, "between -0.5 and 0.5: a slope");
    let reach = Reach::Between(0.0, 0.05);
    let comment = "towards the track's center, 1:40; 0 for profiles from files, which mostly have it";
    r.number("inclination", range, reach, &mut inclination, comment);
    let mut gauge = 56.5 * INCH;
    r.quantity("gauge", LENGTH, &mut gauge, "between the gauge sides");
    let mut gauge_depth = nominal::GAUGE_DEPTH;
    let comment = "below the datum of the rail, z = 0 of its file, where gauge is measured";
    r.quantity("gauge_depth", LENGTH, &mut gauge_depth, comment);
    let mut deviation = DEVIATION;
    let form: QuantityForm = (Measure::Length, Range::NotNegative, Reach::FromZero(1e-4));
    let comment = "how far a spline may lie from the points of a file";
    r.quantity("deviation", form, &mut deviation, comment);
    let profile = profile(r, "rails.profile", &name, ProfileKind::Rail, deviation);
    Rails {
        profile: profile.map(|own| match inclination {
            0.0 => own,
            slope => own.inclined(slope),
        }),
        gauge,
        gauge_depth,
    }
}

/// Reads `[wheels]`; `sprung` tells whether rails give way.
pub(crate) fn wheels(r: &mut CaseReader<'_>, parameters: &mut Parameters, rails: Rails, sprung: bool) {
    r.section(
        "wheels",
        "The wheelsets, their wheels, and what happens where they touch the rails.",
    );
    let own = &mut parameters.wheelset;
    r.weight(&mut own.mass, "of a wheelset with its bearings and adapters");
    let inertia: QuantityForm = (Measure::Inertia, Range::Positive, Reach::Positive);
    r.quantity(
        "inertia_about_axle",
        inertia,
        &mut own.about_axle,
        "of a wheelset",
    );
    r.quantity(
        "inertia_about_diameter",
        inertia,
        &mut own.about_diameter,
        "of a wheelset, in roll and yaw",
    );
    let mut radius = 18.0 * INCH;
    r.quantity("radius", LENGTH, &mut radius, "nominal, at the tape circles");
    const GEOMETRIES: Names<bool> = &[("profiles", false), ("linear", true)];
    let mut linear = false;
    let comment = "\"profiles\", or \"linear\": linear geometry and creep for stability, on rigid rails";
    r.choice("geometry", GEOMETRIES, &mut linear, comment);
    if linear {
        if sprung {
            let problem = Problem::new("linear wheels roll on rails that do not give way");
            let help = "write track.support.kind = \"rigid\"";
            r.problem("wheels.geometry", problem.label("the track is sprung").help(help));
        }
        let static_load = parameters.weight() / 4.0;
        parameters.wheels = linear_wheels(r, radius, static_load);
        return;
    }
    let comment = "\"aar_1b\" (nominal, from memory), \"aar_1b_1:10\" (its flange, another tread), \
                   \"cone_1:20\" of any slope, or a file: CSV with units, Simpack's .prw";
    let name = text(r, "profile", "aar_1b", comment);
    let mut tape_distance = nominal::TAPE_DISTANCE;
    r.quantity("tape_distance", LENGTH, &mut tape_distance, "of the tape circles");
    let mut deviation = DEVIATION;
    let form: QuantityForm = (Measure::Length, Range::NotNegative, Reach::FromZero(1e-4));
    let comment = "how far a spline may lie from the points of a file";
    r.quantity("deviation", form, &mut deviation, comment);
    let mut tables = false;
    let comment = "true: patches from tables over lateral shift, faster, for motion on treads only";
    r.truth("tables", &mut tables, comment);
    let law = contact_law(r, sprung);
    let Some((wheel, rail)) =
        profile(r, "wheels.profile", &name, ProfileKind::Wheel, deviation).zip(rails.profile)
    else {
        return;
    };
    let layout = Layout {
        tape_distance,
        gauge: rails.gauge,
        gauge_depth: rails.gauge_depth,
    };
    match RigidWheelset::new([&wheel; 2], [radius; 2], [&rail; 2], layout, STEEL) {
        Ok(geometry) => {
            parameters.wheels = Wheels::OnRails(ProfiledWheels {
                geometry: Arc::new(geometry),
                profiles: Arc::new([wheel, rail]),
                tape_distance,
                tables,
                law,
            });
        }
        Err(error) => {
            let of_rail = matches!(error, ProfileError::Datum { .. });
            wrong(
                r,
                if of_rail {
                    "rails.profile"
                } else {
                    "wheels.profile"
                },
                &error,
            );
        }
    }
}

fn contact_law(r: &mut CaseReader<'_>, sprung: bool) -> ContactLaw {
    let mut friction = 0.4;
    let range = crate::case::friction::COEFFICIENT;
    r.number(
        "friction",
        range,
        Reach::FromZero(0.5),
        &mut friction,
        "of wheel on rail",
    );
    let mut creep = Creep::Polach;
    let comment = "\"polach\", \"shen_hedrick_elkins\", \"fastsim\", \"kalker\" (linear, no \
                   saturation), \"frictionless\"";
    r.choice("creep", CREEPS, &mut creep, comment);
    let mut damping = if sprung { 0.3 } else { 2.0 };
    let comment = "of the normal force, s/m (Hunt and Crossley): 0.3 on sprung track, 2 on rigid; guesses";
    r.number(
        "contact_damping",
        Range::NotNegative,
        Reach::Positive,
        &mut damping,
        comment,
    );
    let mut slowest = 0.1;
    let speed: QuantityForm = (Measure::Speed, Range::Positive, Reach::Wide);
    let comment = "creepages are velocities over the root of the sum of squares of this and the car's speed";
    r.quantity("slowest", speed, &mut slowest, comment);
    ContactLaw {
        friction,
        damping,
        creep: match creep {
            Creep::Polach => CreepLaw::Polach(polach::DRY),
            Creep::ShenHedrickElkins => CreepLaw::ShenHedrickElkins,
            Creep::Fastsim => CreepLaw::Fastsim(StripGrid {
                cells: 20,
                strips: 20,
            }),
            Creep::Kalker => CreepLaw::Linear,
            Creep::Frictionless => CreepLaw::Frictionless,
        },
        slowest,
    }
}

/// Linear geometry and creep: defaults are those of a cone of 1:20 with Kalker's coefficients of a loaded
/// wheel, rounded.
fn linear_wheels(r: &mut CaseReader<'_>, radius: f64, axle_load: f64) -> Wheels {
    let slope = Range::Between(0.0, 1.0, "between 0 and 1");
    let mut conicity = 0.05;
    r.number(
        "conicity",
        slope,
        Reach::Wide,
        &mut conicity,
        "change of the rolling radius by the lateral shift",
    );
    let mut half_distance = 29.75 * INCH;
    r.quantity("half_distance", LENGTH, &mut half_distance, "of the contacts");
    let mut contact_angle = 0.05;
    let angle: QuantityForm = (
        Measure::Angle,
        Range::Between(-FRAC_PI_2, FRAC_PI_2, "less than a right angle"),
        Reach::Signed(0.1),
    );
    r.quantity("contact_angle", angle, &mut contact_angle, "in the middle");
    let mut contact_angle_rate = 0.0;
    let comment = "of the contact angle by the lateral shift, 1/m";
    r.number(
        "contact_angle_rate",
        Range::Any,
        Reach::Signed(10.0),
        &mut contact_angle_rate,
        comment,
    );
    let mut creep = CreepCoefficients {
        f11: 9e6,
        f22: 8e6,
        f23: 2e4,
        f33: 50.0,
    };
    let force: QuantityForm = (Measure::Force, Range::NotNegative, Reach::Wide);
    r.quantity(
        "f11",
        force,
        &mut creep.f11,
        "longitudinal creep coefficient of a contact",
    );
    r.quantity(
        "f22",
        force,
        &mut creep.f22,
        "lateral creep coefficient of a contact",
    );
    let moment: QuantityForm = (Measure::Moment, Range::NotNegative, Reach::Wide);
    r.quantity("f23", moment, &mut creep.f23, "of spin to lateral force");
    let range = Range::NotNegative;
    r.number(
        "f33",
        range,
        Reach::Wide,
        &mut creep.f33,
        "of spin to spin moment, N m^2",
    );
    let mut spin = true;
    r.truth("spin", &mut spin, "whether spin acts");
    let mut gravity = true;
    r.truth(
        "gravity_stiffness",
        &mut gravity,
        "whether the axle load acts by the contact angles",
    );
    let mut support = [1e9, 5e8];
    let stiffness: QuantityForm = (Measure::Stiffness, Range::Positive, Reach::Wide);
    r.quantity(
        "support",
        stiffness,
        &mut support[0],
        "vertical stiffness of what carries a wheelset",
    );
    support[1] = support[0] * half_distance * half_distance;
    Wheels::Linear {
        wheelset: LinearWheelset {
            geometry: LinearGeometry {
                conicity,
                contact_angle,
                contact_angle_rate,
                roll_coefficient: 0.0,
                half_distance,
                radius,
            },
            creep,
            spin,
            axle_load: if gravity { axle_load } else { 0.0 },
        },
        support,
    }
}

/// Returns a text, such as the name of a profile.
fn text(r: &mut CaseReader<'_>, key: &'static str, default: &str, comment: &str) -> String {
    let read = |section: &crate::case::section::CaseSection<'_>,
                problems: &mut crate::case::problem::Problems| {
        section.text(key, problems).map(|(text, _)| text.to_owned())
    };
    r.other(key, Form::Text, comment, default.to_owned(), read, |text| {
        Written::text(text)
    })
}

/// Returns a nominal profile, or one from a file.
fn profile(
    r: &mut CaseReader<'_>,
    path: &str,
    name: &str,
    kind: ProfileKind,
    deviation: f64,
) -> Option<Profile> {
    let nominal = match (kind, name) {
        (ProfileKind::Wheel, "aar_1b") => Some(nominal::aar_1b()),
        (ProfileKind::Rail, "136re") => Some(nominal::rail_136re()),
        (ProfileKind::Wheel, name) if name.starts_with("aar_1b_1:") => {
            let run = name.trim_start_matches("aar_1b_1:").trim().parse::<f64>();
            Some(nominal::aar_1b_with_tread(run.unwrap_or(f64::NAN)))
        }
        (ProfileKind::Wheel, name) => match name.strip_prefix("cone_") {
            Some(text) => {
                let Some(slope) = slope(text) else {
                    let problem = Problem::new(format!("`{path}` is \"{name}\", which is no cone"));
                    r.problem(
                        path,
                        problem
                            .label("which slope?")
                            .help("write for example \"cone_1:20\""),
                    );
                    return None;
                };
                Some(nominal::cone(slope, TREAD))
            }
            None => None,
        },
        (ProfileKind::Rail, _) => None,
    };
    let made = match nominal {
        Some(made) => made,
        None => {
            let tables = r.tables();
            let file = match tables.locate(name) {
                Ok(file) if file.exists() => file,
                Ok(_) => {
                    let shown = tables.shown(name);
                    let problem = Problem::new(format!("`{path}`: there is no file {shown}"));
                    let names = match kind {
                        ProfileKind::Wheel => "\"aar_1b\", \"aar_1b_1:10\", \"cone_1:20\"",
                        ProfileKind::Rail => "\"136re\"",
                    };
                    let help = format!("name a file of points from the folder of the case file, or {names}");
                    r.problem(
                        path,
                        problem.label("neither a file nor a nominal profile").help(help),
                    );
                    return None;
                }
                Err(refused) => {
                    let problem =
                        Problem::new(format!("`{path}`: {} {}", tables.shown(name), refused.reason));
                    r.problem(path, problem.label("this file").help(refused.help));
                    return None;
                }
            };
            let made = Profile::read(&file, kind, deviation);
            r.files.push(NamedFile {
                key: match kind {
                    ProfileKind::Wheel => "wheels.profile",
                    ProfileKind::Rail => "rails.profile",
                },
                typed: name.to_owned(),
                path: file,
            });
            made
        }
    };
    made.map_err(|error| wrong(r, path, &error)).ok()
}

fn wrong(r: &mut CaseReader<'_>, path: &str, error: &ProfileError) {
    let problem = match (r.tables().may_quote(), r.files.is_empty()) {
        (false, false) => {
            let names: Vec<&str> = r.files.iter().map(|file| file.typed.as_str()).collect();
            Problem::of_unquoted(
                path,
                &names.join(", "),
                error.line(),
                "no profile as it is needed here",
            )
        }
        _ => Problem::new(format!("`{path}`: {error}")).help(error.remedy()),
    };
    r.problem(path, problem.label("this profile"));
}

/// Returns a slope as a ratio (`1:20`) or a number.
fn slope(text: &str) -> Option<f64> {
    let number = |text: &str| text.trim().parse::<f64>().ok();
    let value = match text.split_once(':') {
        Some((rise, run)) => number(rise)? / number(run)?,
        None => number(text)?,
    };
    (-0.5..=0.5).contains(&value).then_some(value)
}
