//! The section `[couplers]`: forces at the ends of a car, and what is doubtful about them.

use car::{CouplerForce, Couplers, Course, Direction, Drive, Parameters, Wheels};
use mechanics::curve::Curve;
use mechanics::motion::Motion;
use quantity::Kind;

use super::checks::{INCH, POUND_FORCE};
use crate::case::field::Reach;
use crate::case::problem::Problem;
use crate::case::section::{Names, Range};
use crate::case::table::{QuantityTable, TableForm};
use crate::reader::{CaseReader, LENGTH, QuantityForm};
use crate::run::RowTable;

/// Loads up to which ends of cars are built, N: 1,000,000 lbf in buff (compressive end load) and 630,000 lbf
/// in draft, both remembered of AAR M-1001.
const STRENGTH: [f64; 2] = [1e6 * POUND_FORCE, 630e3 * POUND_FORCE];
/// A speed that the drive misses by a larger share is spoken of.
const MISSED: f64 = 0.02;
pub(super) const ENDS: [&str; 2] = ["leading", "trailing"];
const ANGLES: QuantityForm = (Kind::Angle, Range::Any, Reach::Signed(0.2));
const SWINGS: QuantityForm = (Kind::Angle, Range::Positive, Reach::Positive);

/// The direction of a coupler, by name.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum DirectionKind {
    LikeNeighbor,
    Angle,
}

const DIRECTIONS: Names<DirectionKind> = &[
    ("like_neighbor", DirectionKind::LikeNeighbor),
    ("angle", DirectionKind::Angle),
];

/// Reads `[couplers]`.
pub(super) fn couplers(r: &mut CaseReader<'_>, own: &mut Couplers) {
    r.section(
        "couplers",
        "Forces at both ends, positive in buff (they push the car), negative in draft (they pull).\n\
         # [couplers.leading] and [couplers.trailing] take force, over_distance, direction, angle of one.",
    );
    let comment = "from the pivot to the pulling face: remembered of AAR type F";
    r.quantity("length", LENGTH, &mut own.length, comment);
    let comment = "to either side, up to which couplers are free: remembered of AAR type F; a warning beyond";
    r.quantity("swing", SWINGS, &mut own.swing, comment);
    let mut both = CouplerForce::default();
    force(r, &mut both);
    own.ends = [both.clone(), both];
    for (end, own) in ENDS.into_iter().zip(&mut own.ends) {
        if r.overlay(
            &format!("couplers.{end}"),
            "One end: what is not given is as in [couplers].",
        ) {
            force(r, own);
        }
    }
}

pub(crate) fn force(r: &mut CaseReader<'_>, own: &mut CouplerForce) {
    if r.gives("over_distance") {
        if r.gives("force") {
            let path = r.path("over_distance");
            let problem = Problem::new(format!("`{path}`: a coupler has a force or one over distance"));
            let help = "leave out force, or over_distance";
            r.problem_at(&path, problem.label("two courses").help(help));
        }
        r.also_known("force");
        let form = TableForm::over_distance();
        let comment = "of the middle of the car along the track, and force; constant before and behind";
        let read = r.table("over_distance", &form, Reach::Signed(1e6), comment);
        if let Some(course) = read.as_ref().and_then(held) {
            own.course = Course::Distance(course);
        }
    } else {
        let mut course = match &own.course {
            Course::Time(course) => course.clone(),
            Course::Distance(_) => Motion::Constant(0.0),
        };
        let given = r.gives("force");
        let comment = "of the coupler along its line, positive in buff; over time as loads of bodies are";
        r.course("force", (Kind::Force, 1e6), &mut course, false, comment);
        if given || matches!(own.course, Course::Time(_)) {
            own.course = Course::Time(course);
        }
        r.also_known("over_distance");
    }
    let (mut kind, mut angle) = match own.direction {
        Direction::LikeNeighbor => (DirectionKind::LikeNeighbor, 0.0),
        Direction::Angle(angle) => (DirectionKind::Angle, angle),
    };
    let comment = "\"like_neighbor\": to the coupler of a copy of this car that moves as it does; \"angle\": \
                   at the angle below";
    r.choice("direction", DIRECTIONS, &mut kind, comment);
    if kind == DirectionKind::Angle {
        let comment = "of the coupler to the body, positive where it points to the left of the car";
        r.quantity("angle", ANGLES, &mut angle, comment);
    } else {
        r.also_known("angle");
        if r.gives("angle") {
            let path = r.path("angle");
            let problem = Problem::new(format!(
                "`{path}` has no effect: the coupler points to a neighbor"
            ));
            let help = "write direction = \"angle\", or leave it out";
            r.problem_at(&path, problem.label("no effect").help(help));
        }
    }
    own.direction = match kind {
        DirectionKind::LikeNeighbor => Direction::LikeNeighbor,
        DirectionKind::Angle => Direction::Angle(angle),
    };
}

/// Returns the curve of a table, SI, constant beyond its ends.
fn held(table: &QuantityTable) -> Option<Curve> {
    let rows = table.rows.iter();
    let mut points: Vec<[f64; 2]> = rows
        .map(|row| row.each_ref().map(quantity::Quantity::to_si))
        .collect();
    let (&[from, first], &[to, last]) = (points.first()?, points.last()?);
    points.insert(0, [from - 1.0, first]);
    points.push([to + 1.0, last]);
    Curve::new(points).ok()
}

/// Returns the least and the largest force of a course in a run of this duration (s), N.
fn extremes(course: &Course, duration: f64) -> [f64; 2] {
    const STEPS: u32 = 1000;
    let values: Vec<f64> = match course {
        Course::Distance(curve) => curve.points().iter().map(|[_, force]| *force).collect(),
        Course::Time(motion) => (0..=STEPS)
            .map(|k| {
                let time = duration * f64::from(k) / f64::from(STEPS);
                motion.evaluate(time, time)[0]
            })
            .collect(),
    };
    let fold = |from: f64, pick: fn(f64, f64) -> f64| values.iter().copied().fold(from, pick);
    [fold(f64::INFINITY, f64::min), fold(f64::NEG_INFINITY, f64::max)]
}

/// Notes couplers that do not fit the car; returns what is doubtful. `duration` is that of the run, s.
pub(super) fn checks(r: &mut CaseReader<'_>, parameters: &Parameters, duration: f64) -> Vec<String> {
    let own = &parameters.couplers;
    if !(own.acts(0) || own.acts(1)) {
        return Vec::new();
    }
    let (pivot, center) = (own.pivot(), 0.5 * parameters.truck_distance);
    if pivot <= 0.0 {
        let message = format!(
            "couplers of {:.1} in from pivot to pulling face do not fit a car of {:.1} in between the \
             pulling faces",
            own.length / INCH,
            own.distance / INCH
        );
        let help = "look at couplers.length and car.coupler_distance, and at their units";
        r.problem(
            "couplers.length",
            Problem::new(message).label("too long").help(help),
        );
        return Vec::new();
    }
    let mut doubts = Vec::new();
    if pivot < center {
        doubts.push(format!(
            "the pivots of the couplers are {:.1} in from the middle of the car, within the truck centers at \
             {:.1} in: look at couplers.length ({:.1} in) and car.coupler_distance ({:.1} in)",
            pivot / INCH,
            center / INCH,
            own.length / INCH,
            own.distance / INCH
        ));
    }
    let forces = own.ends.each_ref().map(|end| extremes(&end.course, duration));
    for (end, [least, largest]) in ENDS.into_iter().zip(forces) {
        let names = [("buff", largest), ("draft", -least)];
        for ((name, force), strength) in names.into_iter().zip(STRENGTH) {
            if force > strength {
                doubts.push(format!(
                    "the {end} coupler carries {:.0} lbf of {name}, more than the {:.0} lbf that cars are \
                     built for (remembered of AAR M-1001): look at couplers.force and its unit",
                    force / POUND_FORCE,
                    strength / POUND_FORCE
                ));
            }
        }
    }
    doubts.extend(swing(parameters));
    if matches!(parameters.wheels, Wheels::Linear { .. }) {
        doubts.push(
            "coupler forces act on a car with linear wheels, which have no flanges to carry what the \
             couplers push aside: take wheels.geometry = \"profiles\" unless the track is straight"
                .to_owned(),
        );
    }
    let gain = match &parameters.drive {
        Drive::Held { gain } => Some(*gain),
        _ => None,
    };
    if let Some(gain) = gain {
        let [[a, b], [c, d]] = forces;
        let most = (d - a).abs().max((c - b).abs());
        let both = own.ends[0].course == own.ends[1].course;
        let missed = if both { 0.0 } else { most / gain };
        if missed > MISSED * parameters.start.speed {
            doubts.push(format!(
                "the couplers together push or pull with up to {:.0} lbf along the track, which the force \
                 that holds the speed takes: the speed can be off by {:.1} mph; raise speed.gain, or give \
                 both ends the same force",
                most / POUND_FORCE,
                missed / 0.447_04
            ));
        }
    }
    doubts
}

/// Returns the warning about couplers that swing too far in the tightest curve, or by a given angle.
fn swing(parameters: &Parameters) -> Option<String> {
    let (own, line) = (&parameters.couplers, &parameters.track.center_line);
    let steps = line.length().ceil() as usize;
    let curvatures = (0..=steps).map(|k| line.at(k as f64).curvature[0].abs());
    let tightest = curvatures.fold(0.0, f64::max);
    // R sin a = x_p cos a + c/2, with R to the middle of the body.
    let radius = |curvature: f64| {
        let half = 0.5 * parameters.truck_distance;
        (1.0 / (curvature * curvature) - half * half).max(0.0).sqrt()
    };
    let of_neighbor = match tightest {
        0.0 => 0.0,
        curvature => {
            let (r, x) = (radius(curvature), own.pivot());
            let tilt = libm::atan2(x, r);
            tilt + libm::asin((own.length / libm::hypot(r, x)).min(1.0))
        }
    };
    let angles = [0, 1].map(|end| match own.ends[end].direction {
        _ if !own.acts(end) => 0.0,
        Direction::LikeNeighbor => of_neighbor,
        Direction::Angle(angle) => angle.abs(),
    });
    let (end, angle) = if angles[0] >= angles[1] {
        (0, angles[0])
    } else {
        (1, angles[1])
    };
    (angle > own.swing).then(|| {
        format!(
            "the {} coupler stands at {:.1} deg to the body, more than the {:.1} deg up to which it is free \
             (couplers.swing): there it would bear on its carrier or striker and push the end of the car \
             aside, which the model leaves out",
            ENDS[end],
            angle.to_degrees(),
            own.swing.to_degrees()
        )
    })
}

/// Returns whether the end of a run looks at all rows of this column.
pub(super) fn need(column: &str) -> bool {
    ENDS.iter().any(|end| column == format!("coupler_{end}_angle"))
}

/// Returns the warnings of a run whose couplers swung too far, though no check of the case said so.
pub(super) fn swung(parameters: &Parameters, table: &RowTable) -> Option<String> {
    if swing(parameters).is_some() {
        return None;
    }
    let own = &parameters.couplers;
    ENDS.into_iter()
        .enumerate()
        .filter(|(end, _)| own.acts(*end))
        .find_map(|(_, end)| {
            let angles = table.column(&format!("coupler_{end}_angle"));
            let most = angles.iter().fold(0.0_f64, |most, own| most.max(own.abs()));
            (most > own.swing).then(|| {
            format!(
                "the {end} coupler swung by {:.1} deg to the body, more than the {:.1} deg up to which it is \
                 free (couplers.swing): see coupler_{end}_angle; the model leaves out what it then bears on",
                most.to_degrees(),
                own.swing.to_degrees()
            )
        })
        })
}

/// Returns the assumption about couplers.
pub(super) fn assumption(own: &Couplers) -> String {
    let words = |end: usize| match (own.ends[end].acts(), own.ends[end].direction) {
        (false, _) => "none",
        (true, Direction::LikeNeighbor) => "towards a like neighbor that moves as the car does",
        (true, Direction::Angle(_)) => "at a given angle to the body",
    };
    match [own.ends[0].acts(), own.ends[1].acts()] {
        [false, false] => "Out of scope: flexible bodies, braking. No coupler forces act.".to_owned(),
        _ => format!(
            "Out of scope: flexible bodies, braking, draft gears. Coupler forces are given (positive in \
             buff); leading: {}; trailing: {}. Couplers bear on nothing but their pivots.",
            words(0),
            words(1)
        ),
    }
}
