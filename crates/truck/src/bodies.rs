//! The bodies of a truck.

use mechanics::body::Body;
use mechanics::frame::Frame;
use wedge::parameters::NeighbourMotion;

use crate::assemble::{CAR_BODY, INBOARD_HALVES};
use crate::parameters::{Parameters, RigidBody, WedgeKind};
use crate::split::{HALVES, WAYS};
use crate::wedge_mount::wedge_body;
use crate::{PLACES, WEDGE_NAMES};

/// Returns a body at a place: with free coordinates, or with a prescribed motion.
fn rigid(
    name: &str,
    body: &RigidBody,
    place: [f64; 3],
    free: [bool; 6],
    motion: Option<&NeighbourMotion>,
) -> Body {
    let place = [place[0], place[1], body.height];
    if let Some(motion) = motion.filter(|_| !free.contains(&true)) {
        return prescribed(name, motion, place);
    }
    let mut rigid = Body::free(name, body.mass, body.inertia, [0.0; 6]);
    rigid.frame = Frame::fixed(place, [0.0; 3]);
    rigid.free = free;
    rigid
}

/// Returns a body with a prescribed motion, its center of gravity at a place.
fn prescribed(name: &str, motion: &NeighbourMotion, place: [f64; 3]) -> Body {
    let mut frame = Frame::fixed(motion.center.unwrap_or(place), [0.0; 3]);
    frame.motions.clone_from(&motion.coordinates);
    let center_of_gravity = std::array::from_fn(|k| place[k] - frame.origin[k]);
    Body {
        center_of_gravity,
        ..Body::prescribed(name, frame)
    }
}

/// Returns the numbers of the bodies of a truck, in the order of [`bodies`]: they rise, but there is no car
/// body where none stands on the truck, and an inboard half only of a wedge that is split.
#[must_use]
pub fn numbers(parameters: &Parameters) -> Vec<usize> {
    let mut numbers: Vec<usize> = (0..CAR_BODY).collect();
    if parameters.car_body.is_some() {
        numbers.push(CAR_BODY);
    }
    let split = (INBOARD_HALVES..).zip(&parameters.wedges);
    let split = split.filter(|(_, wedge)| wedge.kind == WedgeKind::Split);
    numbers.extend(split.map(|(number, _)| number));
    numbers
}

/// Returns the bodies of a truck whose center is at `center` (m), in the order of [`numbers`].
#[must_use]
pub fn bodies(parameters: &Parameters, center: [f64; 3]) -> Vec<Body> {
    let geometry = &parameters.geometry;
    let (side, axle) = (geometry.nest(), geometry.axle());
    let start = parameters.displacement_at_start();
    let moved = |mut body: Body| {
        if !body.is_prescribed() {
            body.initial[..3].copy_from_slice(&start);
        }
        body
    };
    let mut bodies = Vec::new();
    for (number, name) in ["leading_wheelset", "trailing_wheelset"].into_iter().enumerate() {
        let still = NeighbourMotion::fixed();
        let wheelsets = parameters.wheelsets.as_ref();
        let motion = wheelsets.map_or(&still, |wheelsets| &wheelsets.motions[number]);
        bodies.push(prescribed(
            name,
            motion,
            [[axle, -axle][number], 0.0, geometry.axle_height],
        ));
    }
    let bolster = &parameters.bolster;
    // Wedges without mass leave theirs to the bolster, with which they go: the car weighs the same.
    let massless = parameters
        .wedges
        .iter()
        .filter(|wedge| wedge.kind == WedgeKind::Massless);
    let with_wedges = RigidBody {
        mass: bolster.body.mass + massless.map(|wedge| wedge.mass).sum::<f64>(),
        ..bolster.body
    };
    let body = rigid(
        "bolster",
        &with_wedges,
        [0.0; 3],
        bolster.free,
        Some(&bolster.motion),
    );
    bodies.push(moved(body));
    let names = ["left_side_frame", "right_side_frame"];
    for ((name, frame), way) in names.into_iter().zip(&parameters.side_frames).zip([1.0, -1.0]) {
        let place = [0.0, side * way, 0.0];
        bodies.push(rigid(name, &frame.body, place, frame.free, Some(&frame.motion)));
    }
    let mut inboard = Vec::new();
    for ((name, wedge), [end, way]) in WEDGE_NAMES.into_iter().zip(&parameters.wedges).zip(PLACES) {
        let at = geometry.wedge([end, way]);
        if wedge.kind == WedgeKind::Split {
            let halves = wedge.halves();
            let half = |number: usize| {
                let mut at = at;
                at[1] += WAYS[number] * way * wedge.half_shift();
                let name = format!("{name}_{}_wedge", HALVES[number]);
                moved(wedge_body(&name, &halves[number], at, end))
            };
            bodies.push(half(0));
            inboard.push(half(1));
            continue;
        }
        let mut body = wedge_body(&format!("{name}_wedge"), wedge, at, end);
        // A wedge without mass is no body: a placeholder stands still.
        if wedge.kind == WedgeKind::Massless {
            body.free = [false; 6];
        }
        bodies.push(moved(body));
    }
    if let Some(car) = &parameters.car_body {
        bodies.push(moved(rigid("car_body", &car.body, [0.0; 3], car.free, None)));
    }
    bodies.append(&mut inboard);
    for body in &mut bodies {
        for (origin, shift) in body.frame.origin.iter_mut().zip(center) {
            *origin += shift;
        }
    }
    bodies
}
