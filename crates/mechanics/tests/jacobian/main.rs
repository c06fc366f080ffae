//! Every entry of the Jacobian matrix, and the derivative by time, against differences of the right-hand
//! side.
#![allow(missing_docs, clippy::unwrap_used, clippy::expect_used)]

#[path = "../common/mod.rs"]
mod common;
mod compare;

use common::{ALL, Random, UP, body, coil, face, ground, model};
use compare::{Counts, by_differences, check_matrix, compare};
use mechanics::body::Body;
use mechanics::characteristic::Characteristic;
use mechanics::coil::CoilLaw;
use mechanics::contact::{FrictionDirections, Interface, Sliding};
use mechanics::depth_surface::DepthSurface;
use mechanics::frame::Frame;
use mechanics::friction::FrictionLaw;
use mechanics::link::Marker;
use mechanics::motion::{Motion, RampProfile};
use mechanics::spline::Spline;
use mechanics::surface::{ProfileDirection, SurfaceProfile, SurfaceShape};
use mechanics::system::{Model, System};

const TANH: FrictionLaw = FrictionLaw::Tanh { reference_speed: 0.7 };
const BRISTLE: FrictionLaw = FrictionLaw::Bristle {
    stiffness: 900.0,
    damping: 60.0,
};

const CORNERS: [[f64; 3]; 4] = [
    [0.3, 0.4, -0.2],
    [0.3, -0.4, -0.2],
    [-0.3, 0.4, -0.25],
    [-0.3, -0.4, -0.25],
];

fn sine(amplitude: f64, angular_frequency: f64, phase: f64) -> Motion {
    Motion::Sine {
        amplitude,
        angular_frequency,
        phase,
    }
}

/// Returns one motion of every shape; those about axes turn the frame.
fn shapes(rotating: bool) -> [Motion; 6] {
    let times: Vec<f64> = (0..12).map(|i| 0.4 * f64::from(i) - 1.0).collect();
    let values = times.iter().map(|t| 0.1 * libm::sin(1.3 * t)).collect();
    let swept = Motion::SweptSine {
        amplitude: 0.1,
        start: 1.0,
        end: 4.0,
        duration: 1.1,
    };
    let ramp = |profile| Motion::Ramp {
        amplitude: 0.2,
        start: 0.2,
        duration: 1.5,
        profile,
    };
    let triangle = Motion::Triangle {
        amplitude: 0.1,
        angular_frequency: 3.0,
    };
    let turns = [
        swept.clone(),
        Motion::Sum(vec![sine(0.2, 2.0, 0.3), ramp(RampProfile::Smooth)]),
        Motion::Table(Spline::new(times.clone(), values).unwrap()),
    ];
    let held = [0.1, -0.2, 0.15].map(Motion::Constant);
    let [a, b, c] = if rotating { turns } else { held };
    let z = Motion::Sum(vec![triangle, ramp(RampProfile::Linear), sine(0.1, 2.0, 0.1)]);
    [
        Motion::Sum(vec![swept, ramp(RampProfile::Smooth)]),
        sine(0.1, 3.0, 1.0),
        z,
        a,
        b,
        c,
    ]
}

fn moving(rotating: bool) -> Frame {
    Frame {
        origin: [0.05, -0.1, 0.02],
        orientation: [0.1, -0.2, 0.3],
        motions: shapes(rotating),
    }
}

fn table() -> CoilLaw {
    CoilLaw::Table(Characteristic::new(vec![[-0.3, -20.0], [0.0, 10.0], [0.2, 60.0], [0.3, 150.0]]).unwrap())
}

/// Returns one free body on a prescribed one: a face (damped or not), coils with both lines of action.
fn one_on_prescribed(free: [bool; 6], law: FrictionLaw, damping: f64, frame: Frame, held: [f64; 6]) -> Model {
    let mut one = body("b", 2.0, [0.3, 0.5, 0.7], [-0.1, 0.05, 0.1], free, held);
    one.frame = Frame::fixed([0.02, 0.03, 0.0], [0.1, 0.05, -0.1]);
    let base = Body {
        initial: [0.1, 0.05, -0.1, 0.05, -0.05, 0.1],
        linearized: false,
        ..Body::prescribed("base", frame)
    };
    let mut model = model(vec![one, base, ground()], [0.3, 0.1, -9.8]);
    let points = face("face", &CORNERS, 500.0, damping, 0.4, law);
    model
        .faces
        .push((0, 1, Marker::new([0.0, 0.1, -0.2], UP), points));
    let other = face("side", &CORNERS[..2], 300.0, 0.0, 0.3, TANH);
    model
        .faces
        .push((0, 2, Marker::new([0.0, 0.1, -0.2], [0.3, -1.2, 0.2]), other));
    let mut through_end = coil([0.1, 0.0, -0.1], [0.1, 0.0, -0.1], 300.0, 1.2);
    through_end.damping = 8.0;
    let mut through_center = coil([0.1, 0.2, -0.1], [-0.1, 0.05, 0.1], 0.0, 1.1);
    through_center.law = table();
    through_center.rotational_damping = 3.0;
    through_center.damping = 5.0;
    model
        .coils
        .push((0, 1, Marker::new([0.2, -0.1, -1.1], [0.3, 0.2, 0.5]), through_end));
    model.coils.push((
        0,
        1,
        Marker::new([-0.2, 0.1, -1.0], [0.1, 0.2, 0.1]),
        through_center,
    ));
    let mut slack = coil([0.0; 3], [0.2, 0.0, 0.0], 200.0, 1.0);
    slack.pulls = false;
    model
        .coils
        .push((0, 2, Marker::new([0.9, 0.4, 0.3], [0.0; 3]), slack));
    model
}

const SPREAD: [f64; 3] = [0.25, 0.8, 0.15];

#[test]
fn bodies_with_one_to_six_free_coordinates() {
    // Every coordinate alone, and 2 to 6 of them; roll free, held at zero, held at an angle.
    let choices = [
        0b000001, 0b000010, 0b000100, 0b001000, 0b010000, 0b100000, 0b000101, 0b110000, 0b010101, 0b111000,
        0b110101, 0b101110, 0b011111, 0b111110, 0b111111,
    ];
    for (i, choice) in choices.into_iter().enumerate() {
        let free: [bool; 6] = std::array::from_fn(|k| choice >> k & 1 == 1);
        let roll = if i % 2 == 0 { 0.0 } else { 0.2 };
        let held = [0.05, -0.05, 0.02, roll, 0.1, -0.1];
        compare(
            &one_on_prescribed(free, BRISTLE, 4.0, moving(true), held),
            100 + choice,
            3,
            SPREAD,
        );
    }
}

#[test]
fn tanh_on_a_turning_body() {
    let model = one_on_prescribed(ALL, TANH, 0.0, moving(true), [0.0; 6]);
    let counts = compare(&model, 1, 12, SPREAD);
    assert!(counts.open > 5 && counts.closed > 5);
}

#[test]
fn tanh_with_contact_damping() {
    let model = one_on_prescribed(ALL, TANH, 60.0, moving(true), [0.0; 6]);
    let counts = compare(&model, 2, 20, [0.2, 1.5, 0.1]);
    assert!(counts.open > 5 && counts.closed > 5 && counts.lifted > 2);
}

#[test]
fn bristles_on_a_turning_body() {
    let model = one_on_prescribed(ALL, BRISTLE, 60.0, moving(true), [0.0; 6]);
    let counts = compare(&model, 3, 30, [0.25, 0.4, 0.03]);
    assert!(counts.open > 5 && counts.lifted > 0 && counts.stick > 2 && counts.slip > 2);
}

/// A base that moves without turning is evaluated by lines of its own.
#[test]
fn on_a_base_that_does_not_turn() {
    for (law, free) in [
        (TANH, ALL),
        (BRISTLE, ALL),
        (BRISTLE, [true, false, true, false, true, true]),
    ] {
        let model = one_on_prescribed(free, law, 4.0, moving(false), [0.0; 6]);
        let counts = compare(&model, 4, 8, SPREAD);
        assert!(counts.open > 5 && counts.closed > 5);
        // Only tanh has a bound of its answers, which is of use: not ten times too large.
        assert_eq!(counts.bounds.len() > 3, law == TANH);
        assert!(
            counts.bounds.iter().all(|share| *share > 0.1),
            "{:?}",
            counts.bounds
        );
    }
}

#[test]
fn on_a_base_at_rest() {
    let rest = Frame::fixed([0.05, -0.1, 0.02], [0.1, -0.2, 0.3]);
    let counts = compare(
        &one_on_prescribed(ALL, BRISTLE, 4.0, rest, [0.0; 6]),
        5,
        8,
        SPREAD,
    );
    assert!(counts.open > 5 && counts.closed > 5);
}

/// Returns two free bodies, faces and coils in both directions, all on a prescribed base.
fn two_free(free: [[bool; 6]; 2], frames: [Frame; 2]) -> Model {
    let [frame_a, frame_b] = frames;
    let mut a = body("a", 2.0, [0.3, 0.5, 0.7], [-0.1, 0.05, 0.1], free[0], [0.0; 6]);
    let mut b = body(
        "b",
        3.0,
        [0.4, 0.3, 0.6],
        [0.1, 0.03, -0.1],
        free[1],
        [0.1, 0.0, -0.3, 0.1, 0.0, 0.1],
    );
    (a.frame, b.frame) = (frame_a, frame_b);
    let base = Body::prescribed("base", moving(true));
    let mut model = model(vec![a, base, b], [0.3, 0.1, -9.8]);
    for (body, on, law, damping) in [(0, 2, BRISTLE, 30.0), (2, 0, TANH, 3.0), (2, 1, BRISTLE, 0.0)] {
        let height = if on == 0 { -0.4 } else { 0.05 };
        let one = face("face", &CORNERS, 400.0, damping, 0.4, law);
        model
            .faces
            .push((body, on, Marker::new([0.1, 0.05, height], [0.1, -1.4, 0.2]), one));
    }
    for (body, on) in [(0, 2), (2, 0), (0, 1), (2, 1)] {
        let acts_at = if on == 2 {
            [0.1, 0.2, -0.1]
        } else {
            [0.0, 0.1, 0.2]
        };
        let mut one = coil([0.1, 0.2, -0.1], acts_at, 250.0, 1.1);
        one.damping = 6.0;
        one.rotational_damping = 2.0;
        if body == 2 {
            one.law = table();
        }
        model
            .coils
            .push((body, on, Marker::new([-0.2, 0.1, -1.0], [0.1, 0.2, 0.4]), one));
    }
    model
}

#[test]
fn two_free_bodies() {
    let rest = || Frame::fixed([0.0; 3], [0.05, 0.1, -0.05]);
    let four = [true, false, true, false, true, true];
    let mut total = Counts::default();
    for (i, free) in [
        [ALL, ALL],
        [four, ALL],
        [ALL, [true, false, false, false, false, false]],
        [four, four],
    ]
    .into_iter()
    .enumerate()
    {
        let counts = compare(
            &two_free(free, [rest(), rest()]),
            10 + i as u64,
            8,
            [0.25, 0.6, 0.04],
        );
        total.open += counts.open;
        total.stick += counts.stick;
        total.slip += counts.slip;
    }
    let Counts {
        open, stick, slip, ..
    } = total;
    assert!(
        open > 20 && stick > 5 && slip > 10,
        "{open} open, {stick} stick, {slip} slip"
    );
}

#[test]
fn two_free_bodies_in_frames_that_move() {
    let rest = || Frame::fixed([0.0; 3], [0.05, 0.1, -0.05]);
    compare(&two_free([ALL, ALL], [moving(true), rest()]), 20, 6, SPREAD);
    compare(&two_free([ALL, ALL], [rest(), moving(true)]), 21, 6, SPREAD);
    compare(&two_free([ALL, ALL], [moving(true), moving(true)]), 22, 6, SPREAD);
    compare(
        &two_free([ALL, ALL], [moving(false), moving(true)]),
        23,
        6,
        SPREAD,
    );
}

/// The very state in which a model starts: at rest, bristles relaxed, points open.
#[test]
fn open_points_at_rest_with_relaxed_bristles() {
    let mut one = body("b", 2.0, [0.3, 0.5, 0.7], [0.0; 3], ALL, [0.0; 6]);
    one.initial[2] = 1.0;
    let mut model = model(vec![one, ground()], [0.0, 0.0, -9.8]);
    model.faces.push((
        0,
        1,
        Marker::new([0.0; 3], UP),
        face("floor", &CORNERS, 500.0, 0.0, 0.4, BRISTLE),
    ));
    let mut system = System::new(model).unwrap();
    let x = system.initial_state();
    let expected = by_differences(&mut system, 0.0, &x, 1e-3);
    check_matrix(&mut system, 0.0, &x, &expected, &mut Random(30));
}

/// The stiffness that is due to the accelerations (change of the mass matrix) is there: a body that turns
/// fast.
#[test]
fn a_fast_turning_body_without_elements() {
    let one = body("b", 2.0, [0.3, 0.5, 0.7], [-0.4, 0.3, 0.2], ALL, [0.0; 6]);
    let mut model = model(vec![one], [0.3, 0.1, -9.8]);
    compare(&model, 31, 10, [0.6, 6.0, 0.0]);
    model.bodies[0].frame = moving(true);
    compare(&model, 32, 10, [0.6, 6.0, 0.0]);
}

/// Returns a crown and a hollow, along either tangent, a table of one cubic, and surfaces worn over both
/// tangents.
fn curved() -> [SurfaceShape; 6] {
    let table = Spline::new(vec![-3.0, -1.0, 1.0, 3.0], vec![0.5, 0.1, 0.05, 0.6]).unwrap();
    let arc = |curvature: f64| SurfaceProfile::Arc { curvature };
    let mut shapes = [
        (arc(0.7), ProfileDirection::Z),
        (arc(-0.4), ProfileDirection::Y),
        (SurfaceProfile::Table(table.clone()), ProfileDirection::Y),
        (SurfaceProfile::Table(table), ProfileDirection::Z),
        (SurfaceProfile::Flat, ProfileDirection::Z),
        (arc(0.3), ProfileDirection::Y),
    ]
    .map(|(profile, direction)| SurfaceShape {
        profile,
        direction,
        worn: None,
    });
    // A bicubic, twisted: the spline surface is that.
    let places = vec![-3.0, -1.0, 1.0, 3.0];
    let depth = |y: f64, z: f64| {
        0.05 + 0.1 * y - 0.06 * z + 0.04 * y * y - 0.07 * y * z + 0.03 * z * z + 0.008 * y * y * z
    };
    let depths: Vec<f64> = places
        .iter()
        .flat_map(|z| places.iter().map(|y| depth(*y, *z)))
        .collect();
    let worn = DepthSurface::new(places.clone(), places, &depths).unwrap();
    shapes[4].worn = Some(worn.clone());
    shapes[5].worn = Some(worn);
    shapes
}

#[test]
fn on_curved_surfaces() {
    for (seed, shape) in curved().into_iter().enumerate() {
        for (law, damping, rotating) in [(TANH, 0.0, true), (BRISTLE, 20.0, true), (TANH, 30.0, false)] {
            let mut model = one_on_prescribed(ALL, law, damping, moving(rotating), [0.0; 6]);
            for face in 0..2 {
                let interface = Interface {
                    shape: shape.clone(),
                    ..Interface::default()
                };
                model.interfaces.push((face, interface));
            }
            let counts = compare(&model, 700 + seed as u64, 5, SPREAD);
            assert!(counts.open > 2 && counts.closed > 2);
        }
    }
}

#[test]
fn with_refined_laws() {
    let refined = |factors: Vec<f64>, shape: SurfaceShape, directions| Interface {
        shape,
        directions,
        sliding: Sliding {
            ratio: 0.6,
            stribeck_speed: 0.9,
            half_load: 150.0,
        },
        friction_factors: factors,
        hardening: Some(0.4),
        first_arm: 0.0,
    };
    let (one, two) = (FrictionDirections::One, FrictionDirections::Two);
    for (law, shape, directions) in [
        (TANH, SurfaceShape::default(), two),
        (BRISTLE, SurfaceShape::default(), two),
        (BRISTLE, curved()[0].clone(), two),
        (TANH, SurfaceShape::default(), one),
        (BRISTLE, curved()[0].clone(), one),
    ] {
        let mut model = one_on_prescribed(ALL, law, 10.0, moving(true), [0.0; 6]);
        model
            .interfaces
            .push((0, refined(vec![1.0, 0.7, 1.3, 0.4], shape.clone(), directions)));
        model.interfaces.push((1, refined(Vec::new(), shape, directions)));
        let counts = compare(&model, 800, 8, [0.25, 0.6, 0.05]);
        assert!(counts.open > 5 && counts.closed > 5);
        assert!(law == TANH || counts.slip > 1);
    }
}

/// Planes of bodies that pitch with the body with the points.
#[test]
fn with_arms_of_the_first_tangent() {
    for (seed, (law, rotating)) in [(TANH, true), (BRISTLE, true), (BRISTLE, false)]
        .into_iter()
        .enumerate()
    {
        let mut model = one_on_prescribed(ALL, law, 10.0, moving(rotating), [0.0; 6]);
        for (face, first_arm) in [(0, 0.4), (1, -0.3)] {
            let interface = Interface {
                first_arm,
                ..Interface::default()
            };
            model.interfaces.push((face, interface));
        }
        let counts = compare(&model, 900 + seed as u64, 8, [0.25, 0.6, 0.05]);
        assert!(counts.open > 5 && counts.closed > 5);
    }
}
