//! A car body on center plate and side bearings.

use truck::{CarBody, CenterPlate, Lading, Parameters, SideBearing, SideBearings};

use super::{HEIGHT, Load, clearance, friction, rigid_body};
use crate::case::problem::Problem;
use crate::case::read::contact;
use crate::case::section::Names;
use crate::reader::{CLEARANCE, CaseReader, DAMPING, LENGTH, PRELOAD, STIFFNESS};

pub(in crate::truck) fn car_body(
    r: &mut CaseReader<'_>,
    parameters: &mut Parameters,
    load: Load,
    lading: Lading,
) {
    if load != Load::CarBody {
        for section in ["car_body", "center_plate", "side_bearing"] {
            if r.has(section) {
                let problem = Problem::new(format!("[{section}] has no effect: there is no car body"));
                r.problem(
                    section,
                    problem.label("unused").help("write load.kind = \"car_body\""),
                );
                // Its keys are not looked at.
                r.expect("", &["car_body", "center_plate", "side_bearing"]);
            }
        }
        return;
    }
    let bearings = match lading {
        Lading::Loaded => SideBearings::rollers(),
        Lading::Empty => SideBearings::constant_contact(),
    };
    let mut car = CarBody::new(lading, bearings);
    r.section(
        "car_body",
        "Half a car's body, on center plate and side bearings.",
    );
    let comment = "half a car on one truck falls over in pitch";
    r.free_coordinates(&mut car.free, Some("the car body could not move"), comment);
    rigid_body(r, &mut car.body);
    r.loads("car_body", &mut car.applied, car.free);
    center_plate(r, &mut car.center_plate);
    side_bearings(r, &mut car.side_bearings);
    if car.side_bearings.preload() > car.body.mass * parameters.gravity {
        let message = "the side bearings' preloads are more than the body's weight";
        let help = "lower side_bearing.preload: AAR allows 85 % of a quarter of the body's weight";
        r.problem(
            "side_bearing.preload",
            Problem::new(message).label("lifts the body").help(help),
        );
    }
    parameters.car_body = Some(car);
}

/// The section of a center plate.
pub(crate) fn center_plate(r: &mut CaseReader<'_>, plate: &mut CenterPlate) {
    r.section(
        "center_plate",
        "The center plate: two rings of points with friction, and a rim.",
    );
    r.quantity(
        "height",
        HEIGHT,
        &mut plate.height,
        "of its surface above the top of rail",
    );
    plate_keys(r, "center_plate", plate);
}

/// The keys of a center plate in the current section, which has this path.
pub(crate) fn plate_keys(r: &mut CaseReader<'_>, path: &str, plate: &mut CenterPlate) {
    if let [outer, inner] = plate.rings.as_mut_slice() {
        let [diameter, radius] = ["diameter", "radius"].map(|key| r.has(&format!("{path}.{key}")));
        if radius {
            // An older key, which is read.
            r.quantity("radius", LENGTH, outer, "half of the diameter");
            if diameter {
                let message = "`center_plate.radius` is given, and `center_plate.diameter` too";
                let problem = Problem::new(message).label("one of two");
                r.problem(&format!("{path}.radius"), problem.help("leave out the radius"));
                r.expect(path, &["diameter"]);
            }
        } else {
            let mut diameter = 2.0 * *outer;
            let comment = "of the plate, which is that of its outer ring of points; bowls of 12, 14 and 16 \
                           in are in use, and no source at hand says which truck has which";
            r.quantity("diameter", LENGTH, &mut diameter, comment);
            *outer = 0.5 * diameter;
        }
        *inner = *outer / 3.0;
    }
    contact(r, &mut plate.contact, "of each of the 16 points: a guess");
    friction(r, &mut plate.friction);
    r.quantity(
        "rim_clearance",
        CLEARANCE,
        &mut plate.rim.clearance,
        "on the radius: a guess",
    );
    r.quantity("rim_stiffness", STIFFNESS, &mut plate.rim.stiffness, "of the rim");
    r.quantity("rim_damping", DAMPING, &mut plate.rim.damping, "of the rim");
}

/// The section of side bearings.
pub(crate) fn side_bearings(r: &mut CaseReader<'_>, bearings: &mut SideBearings) {
    r.section("side_bearing", "Side bearings.");
    let mut rolls = matches!(bearings.kind, SideBearing::Roller(_));
    const KINDS: Names<bool> = &[("roller", true), ("constant_contact", false)];
    r.choice(
        "kind",
        KINDS,
        &mut rolls,
        "\"roller\": a clearance; \"constant_contact\": a preloaded spring with friction",
    );
    let mut own = if rolls {
        SideBearings::rollers()
    } else {
        SideBearings::constant_contact()
    };
    r.quantity("distance", LENGTH, &mut own.distance, "from the truck's center");
    bearing_keys(r, &mut own.kind);
    *bearings = own;
}

/// The keys of a side bearing of its kind in the current section.
pub(crate) fn bearing_keys(r: &mut CaseReader<'_>, bearing: &mut SideBearing) {
    match bearing {
        SideBearing::Roller(stop) => clearance(r, stop),
        SideBearing::ConstantContact {
            preload,
            contact: soft,
            travel,
            solid,
            friction: law,
        } => {
            r.quantity("preload", PRELOAD, preload, "in the nominal layout");
            contact(r, soft, "until it is solid");
            r.quantity("travel", CLEARANCE, travel, "until it is solid");
            r.quantity("solid_stiffness", STIFFNESS, &mut solid.stiffness, "beyond it");
            r.quantity("solid_damping", DAMPING, &mut solid.damping, "beyond it");
            friction(r, law);
        }
    }
}
