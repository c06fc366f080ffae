//! The section `[wheels]`: wheelsets, profiles, creep.

use std::f64::consts::FRAC_PI_2;
use std::sync::Arc;

use car::{Parameters, ProfiledWheels, Wheels};
use quantity::Kind as Measure;
use wheelrail::conicity::LinearGeometry;
use wheelrail::contact::{
    ContactLaw, CreepCoefficients, CreepLaw, LinearWheelset, PatchForm, Side, WheelForm,
};
use wheelrail::creep::fastsim::StripGrid;
use wheelrail::creep::polach;
use wheelrail::friction::Friction;
use wheelrail::hertz::Material;
use wheelrail::profile::figures::LEAST_CLEARANCE;
use wheelrail::profile::{
    Profile, ProfileError, ProfileKind, ReadOptions, SlicedProfile, WheelDatum, flangeway_clearance, nominal,
};
use wheelrail::wheelset::{Layout, RigidWheelset};

use super::friction;
use super::not_round::{self, Roundness, roundness};
use super::profiles::{self, DEVIATION, NamedProfile, SIDES, named, named_or, profile, wrong};
use super::rails::Rails;
use crate::case::field::Reach;
use crate::case::problem::Problem;
use crate::case::section::{Names, Range};
use crate::reader::{CaseReader, LENGTH, QuantityForm};

const INCH: f64 = 0.0254;
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

const PATCHES: Names<PatchForm> = &[("ellipse", PatchForm::Ellipse), ("strips", PatchForm::Strips)];

/// Reads `[wheels]`; `sprung` tells whether rails give way. Returns what is doubtful.
pub(crate) fn wheels(
    r: &mut CaseReader<'_>,
    parameters: &mut Parameters,
    rails: Rails,
    sprung: bool,
) -> Vec<String> {
    r.section(
        "wheels",
        "The wheelsets, their wheels, and what happens where they touch the rails. Some wheels may have a \
         profile \
         and a\n# radius of their own: [wheels.left], [wheels.right], [wheels.axle_1] to [wheels.axle_4], \
         [wheels.axle_1.left] and so on.",
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
        if rails.varies() {
            let problem = Problem::new("linear wheels roll on rails that do not change along the track");
            let help = "leave out rails.over_distance, or write wheels.geometry = \"profiles\"";
            r.problem("wheels.geometry", problem.label("the rails change").help(help));
        }
        not_round::refuse_linear(r);
        let static_load = parameters.weight() / 4.0;
        parameters.wheels = linear_wheels(r, radius, static_load);
        return rails.doubts;
    }
    let comment = "\"aar_1b\" (nominal, from memory), \"aar_1b_1:10\" (its flange, another tread), \
                   \"aar_1:20\", \
                   \"s1002\", \"hollow_2mm\", \"cone_1:20\" of any slope, or a file: CSV with units, \
                   Simpack, MiniProf, \
                   VAMPIRE, a list of sections around the wheel (.slcw)";
    let all = named(r, "wheels", "aar_1b", comment);
    let round = roundness(r, "wheels", &Roundness::default());
    let mut tape_distance = nominal::TAPE_DISTANCE;
    r.quantity("tape_distance", LENGTH, &mut tape_distance, "of the tape circles");
    const DATUMS: Names<Option<WheelDatum>> = &[
        ("file", None),
        ("tape", Some(WheelDatum::Tape)),
        ("flange_back", Some(WheelDatum::FlangeBack)),
    ];
    let mut datum = None;
    let comment = "where y = 0 of files lies: \"file\" (as they say, else the tape circle), \"tape\", \
                   \"flange_back\"";
    r.choice("datum", DATUMS, &mut datum, comment);
    let mut tape_from_back = None;
    let comment = "distance of the tape circle from the back of the flange in files; left out: what they \
                   say, or 70 mm";
    r.optional(
        "tape_from_back",
        LENGTH,
        &mut tape_from_back,
        "\"70 mm\"",
        comment,
    );
    let mut deviation = DEVIATION;
    let form: QuantityForm = (Measure::Length, Range::NotNegative, Reach::FromZero(1e-4));
    let comment = "how far a spline may lie from the points of a file";
    r.quantity("deviation", form, &mut deviation, comment);
    let mut tables = false;
    let comment = "true: patches from tables over lateral shift, faster, for motion on treads only";
    r.truth("tables", &mut tables, comment);
    if tables && rails.varies() {
        let problem = Problem::new("tables of contacts are those of one section, and the rails change");
        let help = "leave out wheels.tables, or rails.over_distance";
        r.problem("wheels.tables", problem.label("the rails change").help(help));
    }
    let mut patch = PatchForm::Ellipse;
    let comment = "\"ellipse\" (Hertz's), or \"strips\": patches that are no ellipses, for their pressure \
                   and where profiles conform; three to five times as slow";
    r.choice("patch", PATCHES, &mut patch, comment);
    if tables && patch == PatchForm::Strips {
        let problem = Problem::new("tables of contacts hold ellipses");
        let help = "leave out wheels.tables, or write wheels.patch = \"ellipse\"";
        r.problem("wheels.patch", problem.label("strips need the search").help(help));
    }
    let law = contact_law(r, sprung);
    let all = WheelKeys {
        named: all,
        radius,
        round,
    };
    let each = each_wheel(r, &all);
    let laws = friction::laws(r, law);
    let mut doubts = rails.doubts;
    let options = ReadOptions {
        deviation,
        datum,
        tape_from_back,
        side: None,
    };
    let Some((each, rail_profiles)) = profiles_of(r, each, options, &mut doubts).zip(rails.profiles) else {
        return doubts;
    };
    let layout = Layout {
        tape_distance,
        gauge: rails.gauge,
        gauge_depth: rails.gauge_depth,
    };
    for [
        EachWheel {
            keys: own, profile, ..
        },
        _,
    ] in &each
    {
        let stated = profile.stated();
        for (key, stated, used) in [
            ("wheels.radius", stated.radius, own.radius),
            ("wheels.tape_distance", stated.tape_distance, tape_distance),
        ] {
            let Some(stated) = stated.filter(|stated| (stated - used).abs() > 1e-4) else {
                continue;
            };
            let words = format!(
                "the file of {} states {:.2} mm for {key}, and {:.2} mm is used: set {key} = \"{:.2} mm\" \
                 if the file \
                 is right",
                own.named.path,
                1e3 * stated,
                1e3 * used,
                1e3 * stated
            );
            if !doubts.contains(&words) {
                doubts.push(words);
            }
        }
    }
    let mut geometry: Vec<Arc<RigidWheelset>> = Vec::with_capacity(4);
    for (w, own) in each.iter().enumerate() {
        let alike = |other: &[EachWheel; 2]| {
            let same = |i: usize| {
                Arc::ptr_eq(&other[i].profile, &own[i].profile) && other[i].keys.radius == own[i].keys.radius
            };
            same(0) && same(1)
        };
        if let Some(known) = each[..w].iter().position(alike) {
            geometry.push(geometry[known].clone());
            continue;
        }
        let wheels = own.each_ref().map(|own| &*own.profile);
        let radii = own.each_ref().map(|own| own.keys.radius);
        let on = rail_profiles.each_ref().map(|own| &**own);
        match RigidWheelset::new(wheels, radii, on, layout, STEEL) {
            Ok(made) => geometry.push(Arc::new(made.with_patches(patch))),
            Err(error) => {
                let of_rail = matches!(error, ProfileError::Datum { .. });
                let path = if of_rail {
                    "rails.profile"
                } else {
                    own[0].keys.named.path.as_str()
                };
                wrong(r, path, &error);
                return doubts;
            }
        }
        let clearance = flangeway_clearance(wheels, on, tape_distance, layout.gauge, layout.gauge_depth);
        if let Some(clearance) = clearance.filter(|own| *own < LEAST_CLEARANCE) {
            doubts.push(format!(
                "the flangeway clearance of wheelset {} is {:.3} mm to each side: below {:.0} mm its \
                 flanges touch all \
                 the time; look at rails.gauge, wheels.tape_distance and the datum of the profiles",
                w + 1,
                1e3 * clearance,
                1e3 * LEAST_CLEARANCE
            ));
        }
    }
    let forms = each.each_ref().map(|sides| {
        sides.each_ref().map(|own| {
            let sliced = (own.sliced.as_deref(), own.keys.named.path.as_str());
            let form = own.keys.round.form(r, own.keys.radius, sliced, &mut doubts);
            if let (true, Some(WheelForm::Sliced(_))) = (tables, &form) {
                let problem =
                    Problem::new("tables of contacts are those of one section, and a wheel has several");
                let help = "leave out wheels.tables, or name a single profile";
                r.problem("wheels.tables", problem.label("a wheel changes").help(help));
            }
            form
        })
    });
    if let Ok(geometry) = <[Arc<RigidWheelset>; 4]>::try_from(geometry) {
        parameters.wheels = Wheels::OnRails(ProfiledWheels {
            geometry,
            wheels: each.map(|sides| sides.map(|own| own.profile)),
            rails: rail_profiles,
            rails_over: rails.over,
            forms,
            tape_distance,
            tables,
            laws: Box::new(laws),
        });
    }
    doubts
}

/// What is typed of a wheel.
#[derive(Clone, Debug, PartialEq)]
struct WheelKeys {
    named: NamedProfile,
    /// Nominal, m.
    radius: f64,
    round: Roundness,
}

/// A wheel with its profile, and with those around it, if they change.
struct EachWheel {
    keys: WheelKeys,
    profile: Arc<Profile>,
    sliced: Option<Arc<SlicedProfile>>,
}

/// Reads what is said of some wheels, left and right of each wheelset.
fn each_wheel(r: &mut CaseReader<'_>, all: &WheelKeys) -> [[WheelKeys; 2]; 4] {
    let mut read = |path: &str, about: &str, mut own: WheelKeys| {
        if r.overlay(path, about) {
            own.named = named_or(r, path, &own.named);
            r.quantity("radius", LENGTH, &mut own.radius, "nominal, at the tape circle");
            own.round = roundness(r, path, &own.round);
        }
        own
    };
    let about = "All wheels of a side: what is not given is as in [wheels].";
    let sides = SIDES.map(|side| read(&format!("wheels.{side}"), about, all.clone()));
    [1, 2, 3, 4].map(|axle| {
        let path = format!("wheels.axle_{axle}");
        let about = "One wheelset: what is not given is as in [wheels.left], [wheels.right] or [wheels].";
        let wheelset = read(&path, about, all.clone());
        [0, 1].map(|i| {
            let side = &sides[i];
            // What the wheelset says goes before what its side says.
            let mut base = wheelset.clone();
            if wheelset.named == all.named {
                base.named = side.named.clone();
            }
            if wheelset.radius == all.radius {
                base.radius = side.radius;
            }
            base.round = base.round.over(&side.round, &all.round);
            let path = format!("wheels.axle_{axle}.{}", SIDES[i]);
            let about = "One wheel: what is not given is as for its wheelset.";
            read(&path, about, base)
        })
    })
}

/// Reads the profiles of all wheels, each file once. None if one is not made.
fn profiles_of(
    r: &mut CaseReader<'_>,
    each: [[WheelKeys; 2]; 4],
    options: ReadOptions,
    doubts: &mut Vec<String>,
) -> Option<[[EachWheel; 2]; 4]> {
    let alike = each
        .iter()
        .all(|[left, right]| left.named.name == right.named.name);
    let mut known: Vec<(String, Option<Side>, Option<Made>)> = Vec::new();
    let made = each.map(|sides| {
        let mut i = 0;
        sides.map(|keys| {
            let side = (!alike).then_some([Side::Left, Side::Right][i]);
            i += 1;
            let found = known
                .iter()
                .find(|(name, of, _)| *name == keys.named.name && *of == side);
            let made = match found {
                Some((_, _, made)) => made.clone(),
                None => {
                    let options = ReadOptions { side, ..options };
                    let made = made(r, &keys.named, &options, doubts);
                    known.push((keys.named.name.clone(), side, made.clone()));
                    made
                }
            };
            made.map(|(profile, sliced)| EachWheel {
                keys,
                profile,
                sliced,
            })
        })
    });
    let [a, b, c, d] = made.map(|[left, right]| left.zip(right).map(|(left, right)| [left, right]));
    Some([a?, b?, c?, d?])
}

/// A wheel's profile, and its sections around it, if they change.
type Made = (Arc<Profile>, Option<Arc<SlicedProfile>>);

/// Returns a wheel's profile: of a list of sections around it the one that is down at the start.
fn made(
    r: &mut CaseReader<'_>,
    named: &NamedProfile,
    options: &ReadOptions,
    doubts: &mut Vec<String>,
) -> Option<Made> {
    if !profiles::is_list(r, named, ProfileKind::Wheel) {
        let made = profile(r, named, ProfileKind::Wheel, options, doubts)?;
        return Some((Arc::new(made), None));
    }
    let list = profiles::sliced(r, named, ProfileKind::Wheel, options, doubts)?;
    match list.at(0.0) {
        Ok(first) => Some((Arc::new(first), Some(Arc::new(list)))),
        Err(error) => {
            wrong(r, &named.path, &error);
            None
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
        "of wheel on rail; [friction] has zones, rails, distance, slip",
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
        friction: Friction::constant(friction),
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
