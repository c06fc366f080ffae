//! A car body on center plate and side bearings.

use quantity::Kind;
use truck::{CarBody, CenterPlate, Hysteresis, Lading, Parameters, SideBearing, SideBearings};

use super::{HEIGHT, Load, clearance, friction, rigid_body};
use crate::case::field::Reach;
use crate::case::problem::Problem;
use crate::case::read::contact;
use crate::case::section::{Names, Range};
use crate::reader::{CLEARANCE, CaseReader, DAMPING, LENGTH, PRELOAD, QuantityForm, STIFFNESS};

const INCH: f64 = 0.0254;
const POUND_FORCE: f64 = 4.448_221_615_260_5;
/// Part of the preload beyond which hysteresis is doubtful, and part of the travel before it slips.
const MOST_OF_PRELOAD: f64 = 0.5;
const MOST_OF_TRAVEL: f64 = 0.2;
/// Longest lag of hysteresis, s: at 2 Hz an eighth of the force of the spring in series.
const LONGEST_LAG: f64 = 0.01;

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
            hysteresis,
        } => {
            r.quantity("preload", PRELOAD, preload, "in the nominal layout");
            contact(r, soft, "until it is solid");
            r.quantity("travel", CLEARANCE, travel, "until it is solid");
            r.quantity("solid_stiffness", STIFFNESS, &mut solid.stiffness, "beyond it");
            r.quantity("solid_damping", DAMPING, &mut solid.damping, "beyond it");
            friction(r, law);
            let mut own = hysteresis.unwrap_or_default();
            hysteresis_keys(r, &mut own);
            *hysteresis = (own.limit > 0.0).then_some(own);
            if own.limit > *preload {
                let message = format!(
                    "the hysteresis of a side bearing is {:.0} lbf, more than its preload of {:.0} lbf: in \
                     the nominal layout the bearing would not follow the body back",
                    own.limit / POUND_FORCE,
                    *preload / POUND_FORCE
                );
                let help = "give half the height of the loop of force over travel, less than the preload";
                let problem = Problem::new(message).label("more than the preload").help(help);
                r.problem_at(&r.path("hysteresis"), problem);
            }
            if own.limit > 0.0 && soft.damping > 0.0 {
                let message = "a side bearing has damping and hysteresis: two losses of one elastomer, which \
                               together could pull";
                let help = "leave out its damping, or its hysteresis";
                let problem = Problem::new(message).label("one of two").help(help);
                r.problem_at(&r.path("damping"), problem);
            }
        }
    }
}

fn hysteresis_keys(r: &mut CaseReader<'_>, own: &mut Hysteresis) {
    const LIMIT: QuantityForm = (Kind::Force, Range::NotNegative, Reach::FromZero(4448.0));
    const BRISTLE_DAMPING: QuantityForm = (Kind::Damping, Range::Positive, Reach::Wide);
    let comment = "half the height of the loop of its vertical force: at any speed an elastomer pushes back \
                   less than it was pressed in by twice this force. 0: none";
    r.quantity("hysteresis", LIMIT, &mut own.limit, comment);
    let comment = "of the spring in series with the slider of the hysteresis: a guess";
    r.quantity("hysteresis_stiffness", STIFFNESS, &mut own.stiffness, comment);
    let comment = "of that spring, for the solver: small beside its stiffness times the time of a motion";
    r.quantity("hysteresis_damping", BRISTLE_DAMPING, &mut own.damping, comment);
}

/// Returns the doubts about the hysteresis of a side bearing.
pub(crate) fn doubts_of_bearing(bearing: &SideBearing) -> Vec<String> {
    let SideBearing::ConstantContact {
        preload,
        travel,
        hysteresis: Some(own),
        ..
    } = bearing
    else {
        return Vec::new();
    };
    let mut doubts = Vec::new();
    if own.limit > MOST_OF_PRELOAD * preload {
        doubts.push(format!(
            "the hysteresis of a side bearing, {:.0} lbf, is {:.0} % of its preload: an elastomer would lose \
             more than it gives back; hysteresis is half the height of the loop",
            own.limit / POUND_FORCE,
            100.0 * own.limit / preload
        ));
    }
    let held = own.limit / own.stiffness;
    if held > MOST_OF_TRAVEL * travel {
        doubts.push(format!(
            "the hysteresis of a side bearing slips only after {:.3} in of its travel of {:.3} in, and loses \
             nothing before: raise hysteresis_stiffness",
            held / INCH,
            travel / INCH
        ));
    }
    let lag = own.damping / own.stiffness;
    if lag > LONGEST_LAG {
        doubts.push(format!(
            "the hysteresis of a side bearing lags by {lag:.3} s, so that its loop depends on speed: lower \
             hysteresis_damping"
        ));
    }
    doubts
}
