//! The bodies of a vehicle's case.

use quantity::Kind;
use vehicle::RigidBody;

use super::like;
use crate::case::field::Reach;
use crate::case::motion;
use crate::case::problem::Problem;
use crate::case::section::Range;
use crate::reader::{CaseReader, QuantityForm};

const INERTIA: QuantityForm = (Kind::Inertia, Range::Positive, Reach::Positive);
const LENGTHS: QuantityForm = (Kind::Length, Range::Any, Reach::Signed(0.0254));
const ANGLES: QuantityForm = (Kind::Angle, Range::Any, Reach::Signed(0.1));
const SPEEDS: QuantityForm = (Kind::Speed, Range::Any, Reach::Signed(0.5));
const TURNS: QuantityForm = (Kind::AngularSpeed, Range::Any, Reach::Signed(1.0));
const SIZE: QuantityForm = (Kind::Length, Range::Positive, Reach::Positive);

/// Reads `[bodies.NAME]`.
pub(super) fn all(r: &mut CaseReader<'_>) -> Vec<RigidBody> {
    let names = r.names("bodies");
    let bodies = names.into_iter().map(|name| body(r, name)).collect();
    let bodies: Vec<RigidBody> = bodies;
    if let Some(own) = bodies.iter().find(|own| own.name == vehicle::GROUND) {
        let problem = Problem::new("a body cannot be named `ground`: that is what stands still");
        let path = format!("bodies.{}", own.name);
        r.problem_at_key(&path, problem.label("taken").help("give it another name"));
    }
    bodies
}

fn body(r: &mut CaseReader<'_>, name: &str) -> RigidBody {
    let path = format!("bodies.{name}");
    let mut own = RigidBody::new(name, 1000.0, [1000.0; 3], [0.0; 3]);
    let about = format!(
        "A body. Axes: x forward, y left, z up, along the fixed axes in the nominal layout. A motion is {}",
        motion::SHAPES_WRITTEN
    );
    r.section(&path, &about);
    if like::is_told(r, &path) {
        return own;
    }
    let comment = "of the center of gravity in the nominal layout";
    r.place("at", &mut own.place, comment);
    let comment = "of x, y, z, roll, pitch, yaw; the others are held. [] prescribes the motions below";
    r.free_coordinates(&mut own.free, None, comment);
    if own.is_prescribed() {
        // Of no effect, but a body may be freed by a study.
        r.also_known("weight");
        r.also_known("inertia");
    } else {
        let comment = "a force; the mass is the weight over standard gravity";
        r.needed_weight(&mut own.mass, comment);
        let comment = "about x, y, z through the center of gravity";
        match own.free[3..].contains(&true) {
            true => r.needed_triple("inertia", INERTIA, &mut own.inertia, comment),
            false => r.triple("inertia", INERTIA, &mut own.inertia, comment),
        }
        inertia(r, &path, &own);
    }
    let turns_about = "the point it turns about in the nominal layout; left out, its center of gravity";
    let free = !own.is_prescribed();
    r.motions(&mut own.motion, free, turns_about);
    start(r, &mut own);
    let mut size = own.size.unwrap_or_default();
    if r.gives("size") {
        r.triple(
            "size",
            SIZE,
            &mut size,
            "edges along x, y, z of the box that is drawn",
        );
        own.size = Some(size);
    } else {
        r.also_known("size");
    }
    r.loads(&path, &mut own.applied, own.free);
    own
}

/// Notes moments of inertia that no body has.
fn inertia(r: &mut CaseReader<'_>, path: &str, own: &RigidBody) {
    let [x, y, z] = own.inertia;
    let largest = x.max(y).max(z);
    let given = own.free[3..].iter().all(|free| *free);
    if given && largest > (x + y + z - largest) * (1.0 + 1e-9) {
        let message = format!(
            "`{path}.inertia` is of no body: one moment of inertia is larger than the two others together"
        );
        let help = "about x is what lies aside and above (y² + z²); check the order x, y, z and the units";
        let problem = Problem::new(message).label("not possible").help(help);
        r.problem(&format!("{path}.inertia"), problem);
    }
}

/// How a body starts.
fn start(r: &mut CaseReader<'_>, own: &mut RigidBody) {
    let halves: [(&'static str, QuantityForm, &str); 2] = [
        (
            "offset",
            LENGTHS,
            "x, y, z at the start, over the nominal layout or the rest",
        ),
        ("turn", ANGLES, "roll, pitch, yaw at the start, the same"),
    ];
    for (half, (key, form, comment)) in halves.into_iter().enumerate() {
        triple(r, key, form, &mut own.start.displacement, half, comment);
    }
    triple(
        r,
        "velocity",
        SPEEDS,
        &mut own.start.rates,
        0,
        "along x, y, z at the start",
    );
    triple(
        r,
        "turn_rate",
        TURNS,
        &mut own.start.rates,
        1,
        "of roll, pitch, yaw at the start",
    );
    let held = own.free.iter().zip(own.start.displacement).zip(own.start.rates);
    let wrong = held
        .into_iter()
        .any(|((free, a), b)| !free && (a != 0.0 || b != 0.0));
    if wrong {
        let message = format!("{} starts aside in a coordinate that is not free", own.name);
        let help = "free it, or leave it at zero: a held coordinate stays in the nominal layout";
        let path = format!("bodies.{}", own.name);
        r.problem_at_key(&path, Problem::new(message).label("no effect").help(help));
    }
}

fn triple(
    r: &mut CaseReader<'_>,
    key: &'static str,
    form: QuantityForm,
    values: &mut [f64; 6],
    half: usize,
    comment: &str,
) {
    let own = 3 * half..3 * half + 3;
    let mut three = [0.0; 3];
    three.copy_from_slice(&values[own.clone()]);
    r.triple(key, form, &mut three, comment);
    values[own].copy_from_slice(&three);
}
