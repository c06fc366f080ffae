//! Wheelsets, trucks and the track of a vehicle's case.

use ::car::{Drive, Parameters, Wheels};
use quantity::Kind;
use truck::Lading;
use vehicle::{Accelerometer, AccelerometerOf, Description, OnTrack, RigidBody, TruckPart, WheelsetPart};

use super::like;
use crate::car::{rails, sections, track as car_track, trucks, wheels};
use crate::case::field::{Reach, Written};
use crate::case::problem::{Problem, Problems};
use crate::case::section::{CaseSection, Names, Range};
use crate::case::tables::NamedFile;
use crate::reader::schema::Form;
use crate::reader::{CaseReader, QuantityForm};
use crate::track::{Notes, Support};

/// Height of the couplers above the top of rail, at which a drive pushes: 34.5 in, m.
const COUPLERS: f64 = 34.5 * 0.0254;
const MILE_PER_HOUR: f64 = 0.447_04;
const PLACE: QuantityForm = (Kind::Length, Range::Any, Reach::Signed(2.54));

/// Wheelsets and trucks as read, with the names that elements may have as ends.
pub(super) struct Parts {
    wheelsets: Vec<WheelsetPart>,
    trucks: Vec<TruckPart>,
    pub names: Vec<String>,
}

/// Reads `[wheelsets.NAME]` and `[trucks.NAME]`.
pub(super) fn parts(r: &mut CaseReader<'_>, bodies: &[RigidBody]) -> Parts {
    let mut parts = Parts {
        wheelsets: Vec::new(),
        trucks: Vec::new(),
        names: Vec::new(),
    };
    for name in r.names("wheelsets") {
        let path = format!("wheelsets.{name}");
        r.section(&path, "A wheelset; [wheels] has its numbers.");
        parts.names.push(name.to_owned());
        if like::is_told(r, &path) {
            continue;
        }
        let mut x = 0.0;
        r.needed(
            "at",
            PLACE,
            &mut x,
            "along the track in the nominal layout, forward",
        );
        let truck = group(r);
        parts.wheelsets.push(WheelsetPart {
            name: name.to_owned(),
            x,
            truck,
        });
    }
    let coils = truck::coils::catalog();
    let bodies: Vec<&str> = bodies.iter().map(|own| own.name.as_str()).collect();
    for name in r.names("trucks") {
        let (mut x, mut body) = (0.0, None);
        let path = format!("trucks.{name}");
        let about = "A three-piece truck, with the keys of a car's.";
        let parameters = trucks::truck(r, &path, about, (Lading::Loaded, &coils), |r| {
            if like::is_told(r, &path) {
                return;
            }
            r.needed(
                "at",
                PLACE,
                &mut x,
                "its center along the track in the nominal layout, forward",
            );
            body = r.name_among("under", &bodies, "the body that stands on it");
        });
        for part in ["bolster", "left_side_frame", "right_side_frame"] {
            parts.names.push(format!("{name}_{part}"));
        }
        if let Some(body) = body {
            parts.trucks.push(TruckPart {
                name: name.to_owned(),
                x,
                body: body + 1,
                parameters: Box::new(parameters),
            });
        }
    }
    for (at, name) in parts.names.iter().enumerate() {
        if bodies.contains(&name.as_str()) || parts.names[..at].contains(name) {
            let problem = Problem::new(format!("two parts of the vehicle are named `{name}`"));
            let help = "give each body, wheelset and truck a name of its own";
            r.problems.push(problem.help(help));
        }
    }
    parts
}

/// The name of the truck that a wheelset belongs to, if any.
fn group(r: &mut CaseReader<'_>) -> Option<String> {
    let comment = "its truck by any name: forces of a truck's side are those of all wheelsets that name it";
    let read = |section: &CaseSection<'_>, problems: &mut Problems| {
        let (name, node) = section.text("truck", problems)?;
        let plain = |sign: char| sign.is_ascii_alphanumeric() || sign == '_';
        if !name.chars().all(plain) {
            let path = section.path_of("truck");
            let problem = Problem::new(format!("`{path}` is no name"));
            let help = "statistics begin with it: write letters, digits and _";
            problems.push(problem.at(&node.place).label("not a name").help(help));
            return None;
        }
        Some(name.to_owned())
    };
    let name = r.other("truck", Form::Text, comment, String::new(), read, |own| {
        Written::text(own)
    });
    Some(name).filter(|own| !own.is_empty())
}

/// Reads `[accelerometers.NAME]`.
fn accelerometers(r: &mut CaseReader<'_>, bodies: &[RigidBody]) -> Vec<Accelerometer> {
    const TAKEN_AS: Names<AccelerometerOf> =
        &[("body", AccelerometerOf::Body), ("truck", AccelerometerOf::Truck)];
    let bodies: Vec<&str> = bodies.iter().map(|own| own.name.as_str()).collect();
    let mut all = Vec::new();
    for name in r.names("accelerometers") {
        let about = "An accelerometer on a body. Bodies have one over the center of each truck besides.";
        r.section(&format!("accelerometers.{name}"), about);
        let body = r.name_among("on", &bodies, "the body that it is on");
        let (mut at, mut of) = ([0.0; 3], AccelerometerOf::Body);
        r.place("at", &mut at, "its place in the nominal layout");
        let comment = "\"body\": ride, through the low-pass filter of accelerations; \"truck\": hunting of a \
                       truck's frame, in the band of trucks";
        r.choice("of", TAKEN_AS, &mut of, comment);
        if let Some(body) = body {
            all.push(Accelerometer {
                name: name.to_owned(),
                body: body + 1,
                at,
                of,
            });
        }
    }
    all
}

/// Reads `[rails]`, `[wheels]`, `[track]`, `[speed]`, `[drive]` of a vehicle that has wheelsets or trucks;
/// returns files that were read, and what is doubtful.
pub(super) fn track(
    r: &mut CaseReader<'_>,
    parts: &mut Parts,
    bodies: &[RigidBody],
) -> (Option<OnTrack>, Vec<NamedFile>, Vec<String>) {
    let sections = ["rails", "wheels", "track", "speed", "drive", "accelerometers"];
    if parts.wheelsets.is_empty() && parts.trucks.is_empty() && !r.has("wheelsets") && !r.has("trucks") {
        for section in sections {
            if !r.has(section) {
                continue;
            }
            let problem = Problem::new(format!("[{section}] has no effect: the vehicle has no wheelsets"));
            let help = "write [wheelsets.NAME] or [trucks.NAME], or leave it out";
            r.problem(section, problem.label("no effect").help(help));
            r.expect("", &sections);
        }
        return (None, Vec::new(), Vec::new());
    }
    let nothing = (None, Vec::new(), Vec::new());
    let Some(straight) = car_track::tangent(1000.0) else {
        return nothing;
    };
    let Ok(mut scratch) = Parameters::new(Lading::Loaded, straight, 40.0 * MILE_PER_HOUR) else {
        return nothing;
    };
    let line = car_track::track(r);
    let sprung = !matches!(&line, Some(read) if read.support == Support::Rigid);
    let rails = rails::rails(r);
    let of_wheels = wheels::wheels(r, &mut scratch, rails, sprung);
    for axle in ["axle_1", "axle_2", "axle_3", "axle_4"] {
        let path = format!("wheels.{axle}");
        if r.has(&path) {
            let problem = Problem::new(format!("[{path}] is for cars: wheelsets of a vehicle have names"));
            let help = "leave it out: all wheelsets of a vehicle have the wheels of [wheels.left] and \
                        [wheels.right]";
            r.problem(&path, problem.label("not here").help(help));
        }
    }
    sections::speed(r, &mut scratch);
    r.section("drive", "What a held speed pushes: the body, at this height.");
    let names: Vec<&str> = bodies.iter().map(|own| own.name.as_str()).collect();
    let mut driven = 1;
    if r.gives("body") {
        driven = r
            .name_among("body", &names, "of the vehicle")
            .map_or(1, |place| place + 1);
    } else {
        r.also_known("body");
    }
    let mut height = COUPLERS;
    r.quantity(
        "height",
        PLACE,
        &mut height,
        "above the top of rail: that of couplers",
    );
    let accelerometers = accelerometers(r, bodies);
    let Some(read) = line else { return nothing };
    let Notes { mut doubts, files } = read.notes;
    doubts.extend(of_wheels);
    let Wheels::OnRails(own) = scratch.wheels else {
        let problem = Problem::new("a vehicle of one's own rolls on wheels with profiles");
        let help = "leave wheels.geometry out";
        r.problem("wheels.geometry", problem.label("not here").help(help));
        return (None, files, doubts);
    };
    if bodies.is_empty() && scratch.drive != Drive::Coasting {
        let problem = Problem::new("there is no body that a held speed could push");
        let help = "write [bodies.NAME], or speed.kind = \"coasting\"";
        r.problem("speed", problem.help(help));
    }
    let on = OnTrack {
        support: sections::rail_support(&read.support, scratch.gravity),
        movable_rails: false,
        track: read.track,
        wheels: own,
        wheelset: scratch.wheelset,
        wheelsets: std::mem::take(&mut parts.wheelsets),
        trucks: std::mem::take(&mut parts.trucks),
        drive: scratch.drive,
        driven: (driven, height),
        accelerometers,
        distance: 0.0,
        speed: scratch.start.speed,
    };
    (Some(on), files, doubts)
}

/// Reads where a vehicle on a track starts, in the section `[start]`; returns how long it settles, s.
pub(super) fn start(r: &mut CaseReader<'_>, description: &mut Description) -> f64 {
    let mut settle = 0.0;
    let Some(on) = &mut description.on_track else {
        for key in ["distance", "settle"] {
            r.also_known(key);
            if r.gives(key) {
                let message = format!("`start.{key}` has no effect: the vehicle has no wheelsets");
                let problem = Problem::new(message).label("no effect");
                r.problem(&format!("start.{key}"), problem.help("leave it out"));
            }
        }
        return settle;
    };
    on.distance = on.reach() + 1.0;
    let form: QuantityForm = (Kind::Distance, Range::NotNegative, Reach::Positive);
    let comment = "of the layout's origin along the track, which is straight so far";
    r.quantity("distance", form, &mut on.distance, comment);
    let form: QuantityForm = (Kind::Time, Range::NotNegative, Reach::FromZero(2.0));
    r.quantity(
        "settle",
        form,
        &mut settle,
        "statistics leave out what is before it",
    );
    if let Some(reason) = on.misplaced() {
        let problem = Problem::new(format!("the vehicle cannot start there: {reason}"));
        let help = "begin the track with a tangent that is longer than the vehicle, and start on it";
        r.problem("start.distance", problem.label("not here").help(help));
    }
    rails::begin_behind(r, &on.wheels, on.distance + on.reach());
    if let Some(body) = description.bodies.iter().find(|own| own.free != [true; 6]) {
        let path = format!("bodies.{}.free_coordinates", body.name);
        let problem = Problem::new(format!(
            "{} runs along a track, but is not free in all coordinates",
            body.name
        ));
        let help = "leave free_coordinates out, and hold it by stiff bushings";
        r.problem(&path, problem.label("held").help(help));
    }
    settle
}
