//! Connections between markers: derivatives, heading, energy, and small motions against differences of
//! coordinates.

use std::f64::consts::FRAC_PI_2;

use integrate::Method;
use mechanics::body::Body;
use mechanics::connection::{
    Accumulator, ColumnFace, Connection, GapDamper, Law, Options, SlopeDirection, SpringDamper,
    SurfaceFriction, Wedge,
};
use mechanics::contact::FrictionDirections;
use mechanics::curve::Curve;
use mechanics::frame::Frame;
use mechanics::link::Marker;
use mechanics::motion::Motion;
use mechanics::orientation::fixed;
use mechanics::system::{Model, ModelError, System};
use mechanics::vector::Vector;

use crate::common::Random;
use crate::jacobian::compare;
use crate::models::{connection, model, observation, run};

const BRISTLE: Accumulator = Accumulator::Bristle {
    stiffness: 900.0,
    damping: 30.0,
};

fn curve(points: &[[f64; 2]]) -> Curve {
    Curve::mirrored_from_origin(points.to_vec()).unwrap()
}

/// Returns one law of each kind, in numbers near one.
fn laws(accumulator: Accumulator) -> Vec<Law> {
    let spring = SpringDamper {
        spring: Some(curve(&[[0.0, 0.0], [0.3, 20.0], [0.5, 90.0]])),
        damper: Some(curve(&[[0.0, 0.0], [0.4, 3.0], [1.0, 4.0]])),
        compression_limit: -40.0,
        extension_limit: 30.0,
    };
    let gap = GapDamper {
        spring: Some(curve(&[[0.0, 0.0], [1.0, 30.0]])),
        damper: Some(curve(&[[0.0, 0.0], [1.0, 8.0]])),
        low: -0.05,
        high: 0.1,
    };
    let surface = SurfaceFriction {
        clamped: false,
        directions: FrictionDirections::Two,
        coordinates: [2, 0, 1],
        spring: curve(&[[-1.0, -150.0], [0.0, -60.0], [0.2, 0.0], [1.0, 0.0]]),
        damper: Some(curve(&[[0.0, 0.0], [1.0, 4.0]])),
        coefficient: 0.5,
        accumulator,
    };
    // Its limit follows the extension along which it slips.
    let hysteresis = SurfaceFriction {
        clamped: true,
        directions: FrictionDirections::One,
        coordinates: [2, 0, 2],
        damper: None,
        ..surface.clone()
    };
    vec![
        Law::Springs((0..6).map(|k| (k, spring.clone())).collect()),
        Law::Gap(2, gap),
        Law::Surface(surface),
        Law::Surface(hysteresis),
        Law::Wedge(wedge(accumulator)),
    ]
}

fn wedge(accumulator: Accumulator) -> Wedge {
    Wedge {
        angle: 0.6,
        coil: curve(&[[-1.0, -160.0], [0.0, -80.0], [1.0, -10.0], [2.0, 0.0]]),
        preload: 5.0,
        coil_in_bolster: true,
        column: ColumnFace::Profile {
            depth: curve(&[[-1.0, 0.2], [0.0, 0.0], [1.0, -0.3]]),
            direction: -1.0,
        },
        slope_friction: 0.3,
        column_friction: 0.4,
        accumulator,
        normal_limit: 300.0,
    }
}

/// Returns a marker on a body at a point of the layout, along the fixed axes.
fn marker(body: &Body, point: [f64; 3]) -> Marker {
    let axes = fixed(body.frame.orientation).transpose();
    let arm = Vector(point) - Vector(body.frame.origin);
    Marker {
        origin: axes.apply(arm),
        rotation: axes,
    }
}

fn between(bodies: &[Body], [a, b]: [usize; 2], point: [f64; 3], law: Law) -> Connection {
    Connection {
        markers: Some([a, b].map(|number| marker(&bodies[number], point))),
        ..connection(a, b, point, law)
    }
}

/// Returns a body whose reference frame is turned, not free in all coordinates.
fn turned(name: &str, origin: [f64; 3], orientation: [f64; 3], mass: f64, free: [bool; 6]) -> Body {
    Body {
        frame: Frame::fixed(origin, orientation),
        free,
        ..Body::free(name, mass, [0.7, 0.9, 1.1], [0.0; 6])
    }
}

/// Bodies in turned frames, one with linearized kinematics, one without free coordinates, and every law
/// between them.
fn everything(options: Options, accumulator: Accumulator) -> Model {
    let most = [true, true, true, false, true, true];
    let bodies = vec![
        turned("one", [0.1, 0.2, 0.3], [FRAC_PI_2, 2.0, -0.4], 1.5, [true; 6]),
        turned("two", [-0.2, 0.3, 0.1], [0.3, -2.5, 0.2], 2.5, most),
        Body::linearized("three", [0.3, -0.1, 0.2], [true; 6], 2.0, [1.0; 3]),
        turned("support", [0.0; 3], [0.2, 0.1, -0.3], 1.0, [false; 6]),
    ];
    let mut connections = Vec::new();
    for (i, ends) in [[0, 1], [1, 2], [3, 0], [2, 0]].into_iter().enumerate() {
        for (j, law) in laws(accumulator).into_iter().enumerate() {
            let x = 0.1 * (i + j) as f64;
            connections.push(between(&bodies, ends, [x, 0.3 - x, 0.5 * x], law));
        }
    }
    let mut model = model(bodies, connections);
    model.gravity[2] = -9.8;
    model.options = options;
    model
}

/// Every entry of the Jacobian matrix, at both ends.
#[test]
fn analytic_derivatives_agree_with_differences_at_large_angles() {
    let own_slip = Options {
        rise_in_slip: true,
        slope: SlopeDirection::OwnSlip { reference_speed: 0.3 },
        ..Options::default()
    };
    let viscous = Accumulator::Viscous { damping: 60.0 };
    for (seed, (options, accumulator)) in [
        (Options::default(), BRISTLE),
        (own_slip, BRISTLE),
        (Options::default(), viscous),
    ]
    .into_iter()
    .enumerate()
    {
        let columns = compare(&everything(options, accumulator), 11 + seed as u64).columns;
        assert!(columns > 1000, "{columns}");
    }
}

/// Returns a body with frames as those of a car's bodies: axes forward, up, right, so that the heading is the
/// first angle.
fn pair() -> (Vec<Body>, Vec<Connection>) {
    let upright = [FRAC_PI_2, 0.0, 0.0];
    let bodies = vec![
        turned("bolster", [0.1, 0.0, 0.2], upright, 3.0, [true; 6]),
        turned("side_frame", [0.0, 0.1, 0.0], upright, 2.0, [true; 6]),
    ];
    let laws = laws(BRISTLE).into_iter().enumerate();
    let connections = laws.map(|(i, law)| between(&bodies, [0, 1], [0.1 * i as f64, 0.05, 0.1], law));
    let connections = connections.collect();
    (bodies, connections)
}

/// Moves a state to another heading (rad) and place (m): x, y of the fixed frame are x and -z of the bodies'.
fn moved(system: &System, x: &[f64], heading: f64, place: [f64; 2]) -> Vec<f64> {
    let mut x = x.to_vec();
    let speeds = system.layout().speeds;
    let (sine, cosine) = heading.sin_cos();
    for (number, body) in system.bodies().iter().enumerate() {
        let at = |k: usize| system.position_of(number, k).unwrap();
        let origin = body.frame.origin;
        for (first, origin, place) in [(0, [origin[0], origin[1]], place), (speeds, [0.0; 2], [0.0; 2])] {
            let (east, north) = (x[first + at(0)] + origin[0], -x[first + at(2)] + origin[1]);
            x[first + at(0)] = cosine * east - sine * north + place[0] - origin[0];
            x[first + at(2)] = -(sine * east + cosine * north + place[1] - origin[1]);
        }
        x[at(4)] += heading;
    }
    x
}

/// A mile away, at any heading, extensions, forces and accelerations along the bodies are the same.
#[test]
fn limits_forces_do_not_know_heading_and_place() {
    let (bodies, connections) = pair();
    let mut system = System::new(model(bodies, connections)).unwrap();
    let mut random = Random(5);
    let layout = system.layout();
    for _ in 0..20 {
        let mut x = system.initial_state();
        for (i, value) in x.iter_mut().enumerate().take(layout.len() - layout.quadratures) {
            let size = if i < 2 * layout.speeds { 0.2 } else { 0.05 };
            *value = random.between(-size, size);
        }
        let here = system.observe(0.0, &x).connections;
        let largest = here
            .iter()
            .flat_map(|own| &own.forces)
            .fold(0.0, |most: f64, force| most.max(force.abs()));
        assert!(largest > 1.0, "{largest} N");
        for (heading, place) in [
            (FRAC_PI_2, [0.0; 2]),
            (2.2, [1609.3, -700.0]),
            (-3.0, [-1e3, 1609.3]),
        ] {
            let there = moved(&system, &x, heading, place);
            for (a, b) in here.iter().zip(&system.observe(0.0, &there).connections) {
                let pairs = a
                    .extensions
                    .iter()
                    .zip(&b.extensions)
                    .chain(a.velocities.iter().zip(&b.velocities));
                for (a, b) in pairs {
                    assert!((a - b).abs() < 1e-9, "{heading}: {a} and {b}");
                }
                for (a, b) in a.forces.iter().zip(&b.forces) {
                    assert!((a - b).abs() < 1e-6, "{heading}: {a} and {b} N");
                }
            }
        }
    }
}

/// Two bodies that swing against each other while both turn: the ledger closes, and the momentum stays.
#[test]
fn energy_the_ledger_closes_while_both_bodies_turn() {
    let (bodies, connections) = pair();
    let system = System::new(model(bodies, connections)).unwrap();
    let mut x = system.initial_state();
    let speeds = system.layout().speeds;
    for (body, coordinate, rate) in [
        (0, 0, 2.0),
        (0, 1, 1.5),
        (1, 1, -1.0),
        (0, 3, 0.8),
        (0, 4, 3.0),
        (1, 4, 3.0),
    ] {
        x[speeds + system.position_of(body, coordinate).unwrap()] = rate;
    }
    let stored = system.clone().observe(0.0, &x).energies.total();
    let ended = run(&system, Method::Rodas5P, 1e-8, &x, 1.0);
    let seen = observation(&ended);
    assert!(seen.losses > 1.0, "{}", seen.losses);
    let residual = seen.residual(stored).abs();
    assert!(residual < 1e-6 * seen.losses, "{residual:e} of {}", seen.losses);
    let heading = ended.x()[system.position_of(0, 4).unwrap()];
    assert!(heading > 1.0, "{heading}");
    let speed = |k: usize| {
        let own = |body: usize| ended.x()[speeds + system.position_of(body, k).unwrap()];
        3.0 * own(0) + 2.0 * own(1)
    };
    for (k, momentum) in [(0, 6.0), (1, 2.5), (2, 0.0)] {
        assert!((speed(k) - momentum).abs() < 1e-6, "{k}: {} {momentum}", speed(k));
    }
}

/// At displacements and angles of the size h forces differ from those of differences of coordinates by h².
#[test]
fn convergence_small_motions_are_differences_of_coordinates() {
    let axes = [0.0; 3];
    let bodies = vec![
        turned("one", [0.1, 0.0, 0.2], axes, 3.0, [true; 6]),
        turned("two", [0.0, 0.1, 0.0], axes, 2.0, [true; 6]),
    ];
    let spring = || SpringDamper::spring(Curve::linear(100.0));
    let law = || Law::Springs((0..6).map(|k| (k, spring())).collect());
    let point = [0.3, 0.05, 0.1];
    let mut systems = [
        between(&bodies, [0, 1], point, law()),
        connection(0, 1, point, law()),
    ]
    .map(|own| System::new(model(bodies.clone(), vec![own])).unwrap());
    let mut random = Random(9);
    let direction: [f64; 12] = random.vector(1.0);
    let mut apart = |h: f64| {
        let forces = systems.each_mut().map(|system| {
            let mut x = system.initial_state();
            for (x, own) in x.iter_mut().zip(direction) {
                *x = h * own;
            }
            system.observe(0.0, &x).connections[0].forces.clone()
        });
        let [a, b] = &forces;
        a.iter()
            .zip(b)
            .fold(0.0, |most: f64, (a, b)| most.max((a - b).abs()))
    };
    let (large, small) = (apart(1e-2), apart(1e-3));
    assert!(large > 1e-4 && large < 0.1, "{large}");
    assert!((large / small / 100.0 - 1.0).abs() < 0.1, "{large} {small}");
}

/// A body whose frame moves has no place of its own for a marker's coordinates.
#[test]
fn input_moving_frames_are_refused() {
    let mut bodies = pair().0;
    bodies[1].free = [false; 6];
    bodies[1].frame.motions[0] = Motion::Sine {
        amplitude: 0.1,
        angular_frequency: 1.0,
        phase: 0.0,
    };
    let own = between(&bodies, [0, 1], [0.0; 3], Law::Gap(2, gap_of_nothing()));
    let error = System::new(model(bodies, vec![own])).unwrap_err();
    assert!(matches!(error, ModelError::Connection(_)));
    let text = error.to_string();
    assert!(
        text.contains("side_frame") && text.contains("stand still"),
        "{text}"
    );
}

fn gap_of_nothing() -> GapDamper {
    GapDamper {
        spring: None,
        damper: None,
        low: -1.0,
        high: 1.0,
    }
}
