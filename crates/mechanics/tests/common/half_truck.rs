//! A half-truck made up for tests and for measuring: a heavy body (bolster and half a car) and two side
//! frames, six coordinates each; three prescribed bodies that drive the bolster; 50 connections, of them 4
//! wedges and 8 surfaces.
#![allow(dead_code, missing_docs, clippy::unwrap_used, clippy::expect_used)]

use mechanics::body::Body;
use mechanics::connection::{
    Accumulator, ColumnFace, Connection, GapDamper, Law, SpringDamper, SurfaceFriction, Wedge,
};
use mechanics::contact::FrictionDirections;
use mechanics::curve::Curve;
use mechanics::motion::Motion;
use mechanics::system::Model;

pub const LBF: f64 = 4.448_221_615_260_5;
pub const INCH: f64 = 0.0254;
pub const LBF_PER_INCH: f64 = LBF / INCH;
pub const LBF_INCH: f64 = LBF * INCH;
pub const ALL: [bool; 6] = [true; 6];

/// Returns a curve from points in inches and pounds, mirrored if it begins at the origin.
pub fn curve(points: &[[f64; 2]]) -> Curve {
    let points = points.iter().map(|p| [p[0] * INCH, p[1] * LBF]).collect();
    Curve::mirrored_from_origin(points).unwrap()
}

/// Returns a wedge with the published numbers: 32 degrees and 3000 lbf/in on the side frame, or 37.5 degrees
/// and 3702.2 lbf in the bolster.
pub fn wedge(constant: bool, column: ColumnFace) -> Wedge {
    let plain = matches!(column, ColumnFace::Plain { .. });
    let (angle, coil, preload) = match (constant, plain) {
        (false, _) => (32.0, curve(&[[-1.0, -3000.0], [0.0, 0.0]]), 0.0),
        (true, true) => (37.5, Curve::constant(0.0), 3702.2 * LBF),
        (true, false) => (37.5, curve(&[[-1.0, -5681.2], [0.0, -3702.2]]), 0.0),
    };
    Wedge {
        angle: f64::to_radians(angle),
        coil,
        preload,
        coil_in_bolster: constant,
        column,
        slope_friction: 0.4,
        column_friction: 0.4,
        accumulator: Accumulator::Bristle {
            stiffness: 1e6 * LBF_PER_INCH,
            damping: 1e3 * LBF_PER_INCH,
        },
        normal_limit: 1e5 * LBF,
    }
}

/// Returns a straight column with this toe (degrees, positive out).
pub fn straight(toe: f64, direction: f64) -> ColumnFace {
    ColumnFace::Profile {
        depth: Curve::linear(-f64::to_radians(toe).tan()),
        direction,
    }
}

fn sine(amplitude: f64, angular_frequency: f64) -> Motion {
    Motion::Sine {
        amplitude,
        angular_frequency,
        phase: 0.0,
    }
}

/// Six motions of which only the vertical one is not zero.
pub fn vertical(motion: Motion) -> [Motion; 6] {
    let mut motions: [Motion; 6] = std::array::from_fn(|_| Motion::Constant(0.0));
    motions[2] = motion;
    motions
}

pub const BOLSTER: usize = 0;
pub const LEFT: usize = 1;
pub const RIGHT: usize = 2;
pub const GROUND: usize = 3;

/// Returns the half-truck; its bolster is moved up and down by an inch at 2 rad/s.
pub fn model(constant: bool, spatial: bool) -> Model {
    let at = |x: f64, y: f64, z: f64| [x * INCH, y * INCH, z * INCH];
    let mass = LBF / INCH;
    let inertia = LBF * INCH;
    let mut bodies = vec![Body::linearized(
        "bolster and half car",
        at(-35.0, 0.0, 83.0),
        ALL,
        319.175 * mass,
        [0.92e6, 8.35e6, 8.35e6].map(|i| i * inertia),
    )];
    for (name, y) in [("left side frame", 39.5), ("right side frame", -39.5)] {
        let own = [9e2, 1.37e3, 1.37e3].map(|i| i * inertia);
        bodies.push(Body::linearized(name, at(-35.0, y, 18.0), ALL, 2.98 * mass, own));
    }
    bodies.push(Body::ground());
    for (name, y) in [
        ("left input", 39.5),
        ("center input", 0.0),
        ("right input", -39.5),
    ] {
        bodies.push(Body::linearized_prescribed(
            name,
            at(-35.0, y, 18.0),
            vertical(sine(INCH, 2.0)),
        ));
    }
    let mut connections = Vec::new();
    let mut connect = |name: &str, a: usize, b: usize, point: [f64; 3], law: Law| {
        connections.push(Connection {
            account: String::new(),
            name: name.to_owned(),
            a,
            b,
            point,
            markers: None,
            law,
        });
    };
    let spring = |points: &[[f64; 2]]| SpringDamper::spring(curve(points));
    let moment = |points: &[[f64; 2]]| {
        let points = points.iter().map(|p| [p[0], p[1] * LBF_INCH]).collect();
        SpringDamper::spring(Curve::mirrored_from_origin(points).unwrap())
    };
    let nest = match constant {
        true => vec![
            [-1.4, -24487.0],
            [-1.3, -23837.0],
            [0.0, -15403.7],
            [2.39, -131.2],
            [2.41, 0.0],
            [4.0, 0.0],
        ],
        false => vec![[-5.0, -15000.0], [0.0, 0.0], [5.0, 15000.0]],
    };
    for (frame, side) in [(LEFT, 1.0), (RIGHT, -1.0)] {
        let mut along = spring(&[[0.0, 0.0], [0.125, 2225.0], [0.6, 102225.0]]);
        along.damper = Some(curve(&[[0.0, 0.0], [1.0, 1000.0]]));
        let law = Law::Springs(vec![
            (0, along),
            (4, moment(&[[0.0, 0.0], [0.042, 0.0], [1.042, 6.4e7]])),
            (5, moment(&[[0.0, 0.0], [0.03, 2.55e5], [0.04, 8.95e5]])),
        ]);
        connect(
            "longitudinal, pitch, yaw",
            BOLSTER,
            frame,
            at(-35.0, side * 39.5, 18.0),
            law,
        );
        for (x, y) in [(-31.25, 35.75), (-31.25, 43.25), (-38.75, 35.75), (-38.75, 43.25)] {
            let mut vertical = spring(&nest);
            vertical.extension_limit = 0.0;
            let law = Law::Springs(vec![
                (1, spring(&[[0.0, 0.0], [0.5, 2225.0], [0.6, 102200.0]])),
                (2, vertical),
            ]);
            connect("spring nest", BOLSTER, frame, at(x, side * y, 13.0), law);
        }
        for (x, direction) in [(-26.5, 1.0), (-43.5, -1.0)] {
            let column = match spatial {
                true => straight(0.2, direction),
                false => ColumnFace::Plain { toe_out: true },
            };
            connect(
                "wedge",
                BOLSTER,
                frame,
                at(x, side * 39.5, 18.0),
                Law::Wedge(wedge(constant, column)),
            );
        }
        for x in [0.0, -70.0] {
            for y in [42.5, 36.5] {
                let law = SurfaceFriction {
                    clamped: false,
                    directions: FrictionDirections::Two,
                    coordinates: [2, 0, 1],
                    spring: curve(&[[0.0, -15691.0], [0.031382, 0.0], [1.0, 0.0]]),
                    damper: None,
                    coefficient: 0.5,
                    accumulator: wedge(false, ColumnFace::Plain { toe_out: true }).accumulator,
                };
                connect("bearing", frame, GROUND, at(x, side * y, 22.5), Law::Surface(law));
                let law = GapDamper {
                    spring: None,
                    damper: Some(curve(&[[0.0, 0.0], [1.0, 1000.0]])),
                    low: 0.031382 * INCH,
                    high: 1000.0 * INCH,
                };
                connect(
                    "bearing damper",
                    frame,
                    GROUND,
                    at(x, side * y, 22.5),
                    Law::Gap(2, law),
                );
            }
            let stop = spring(&[[0.0, 0.0], [0.25, 1.0], [0.26, 1000.0]]);
            let turn = moment(&[[0.0, 0.0], [0.03, 0.0], [0.04, 6.4e5]]);
            let law = Law::Springs(vec![(1, stop), (5, turn)]);
            connect("stops", frame, GROUND, at(x, side * 39.5, 22.5), law);
        }
    }
    for (input, y) in [(4, 39.5), (5, 0.0), (6, -39.5)] {
        for k in 0..if input == 5 { 6 } else { 5 } {
            let law = match k {
                0..3 => spring(&[[0.0, 0.0], [1.0, 1e6]]),
                _ => moment(&[[0.0, 0.0], [1.0, 1e6]]),
            };
            connect(
                "input",
                BOLSTER,
                input,
                at(-35.0, y, 18.0),
                Law::Springs(vec![(k, law)]),
            );
        }
    }
    Model {
        bodies,
        connections,
        gravity: [0.0, 0.0, -9.80665],
        ..Model::default()
    }
}
