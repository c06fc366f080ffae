//! A body in absolute coordinates on a circle: heading, spin, energy ledger and linearization.
#![allow(missing_docs, clippy::unwrap_used, clippy::expect_used)]

use std::f64::consts::FRAC_PI_2;

use benchmarks::circle::{
    CIRCLE, Carried, Coordinates, HEADING_RATE, INERTIA, MASS, Order, SPIN, STATES, STIFFNESS, on_core,
    states, steady_force, travel,
};
use integrate::Method;

fn after(body: Carried, end: f64) -> [f64; STATES] {
    let by = (Method::default(), 1e-6);
    let (integrator, stopped) = travel(body.problem(), &body.start(), by, end, |_| ()).unwrap();
    assert_eq!(stopped, None);
    states(integrator.x())
}

/// Returns a wheelset that rolls, at the start of the circle where the track has this heading.
fn wheelset(heading: f64) -> Carried {
    Carried {
        order: Order::YawRollPitch,
        heading,
        spin: SPIN,
    }
}

/// Closed forms: the bushing gives the centripetal force, and turns the wheelset's spin by the gyroscopic
/// moment `ω z × (I ω)` in the leaning axle's axes.
#[test]
fn analytic_force_and_gyroscopic_moment_at_any_heading() {
    let force = steady_force();
    for heading in [0.0, 0.7, FRAC_PI_2, 3.0, 5.1] {
        let body = wheelset(heading);
        let end = 20.0;
        let x = after(body, end);
        let observation = body.loads(end, &x);
        assert!(
            (observation.force.0[1] / force - 1.0).abs() < 1e-6,
            "{heading}: {}",
            observation.force.0[1]
        );
        let ((s, c), spin) = (libm::sincos(x[4]), x[11]);
        let along = INERTIA[1] * (spin + HEADING_RATE * s);
        let moment = HEADING_RATE * (INERTIA[2] * HEADING_RATE * c * s - along * c);
        assert!(moment.abs() > 200.0);
        let found = observation.moment.0[0];
        assert!((found / moment - 1.0).abs() < 1e-6, "{heading}: {found} {moment}");
    }
}

/// Once round, with and without spin: what goes in by the guide is stored or lost.
#[test]
fn energy_ledger_closes_once_round() {
    for (order, spin) in [
        (Order::YawRollPitch, 0.0),
        (Order::YawRollPitch, SPIN),
        (Order::YawPitchRoll, 0.0),
    ] {
        let body = Carried {
            order,
            heading: 0.3,
            spin,
        };
        let start = body.energy(0.0, &body.start());
        let x = after(body, CIRCLE);
        let residual = body.ledger(CIRCLE, &x, start).residual;
        assert!(x[13] > 0.1, "{order:?}: {} J are lost", x[13]);
        assert!(
            residual.abs() < 1e-4 * x[13],
            "{order:?}: {residual} J of {} J",
            x[13]
        );
    }
}

/// Pitch before yaw: at a quarter of the circle a body that leans by 5 mrad has 90° of pitch. Relative to a
/// moving frame it has 5 mrad.
#[test]
fn limits_pitch_before_yaw_means_nothing_at_a_quarter_of_the_circle() {
    let (quarter, by) = (0.25 * CIRCLE, (Method::default(), 1e-6));
    let pitch = |coordinates| {
        let (system, x) = on_core(coordinates).unwrap();
        let (integrator, stopped) = travel(system, &x, by, quarter, |_| ()).unwrap();
        assert_eq!(stopped, None);
        integrator.x()[4]
    };
    let (absolute, relative) = (pitch(Coordinates::Absolute), pitch(Coordinates::Relative));
    assert!((relative.abs() - 0.005).abs() < 1e-4, "{relative}");
    assert!((absolute.abs() - FRAC_PI_2).abs() < 0.01, "{absolute}");
}

/// Seen from the guide, small motions are the same at every heading: with `T` from the guide's axes to the
/// coordinates, `A = T⁻¹ (J T - T˙)` is one matrix.
#[test]
fn analytic_linearization_relative_to_the_guide_is_the_same_at_every_heading() {
    let relative = |heading: f64| {
        let body = wheelset(heading);
        let end = 10.0;
        let x = after(body, end);
        let (full, _) = body.linearize(end, &x);
        // Of the twelve states but the spin's angle, on which nothing depends.
        let kept: [usize; 11] = std::array::from_fn(|k| if k < 5 { k } else { k + 1 });
        let jacobian = kept.map(|row| kept.map(|column| full[row][column]));
        let (s, c) = libm::sincos(heading + HEADING_RATE * end);
        // Position and velocity turn with the guide: v = V + G (ξ˙ + ω × ξ). Angles and their rates do not.
        let (mut to, mut rate) = ([[0.0; 11]; 11], [[0.0; 11]; 11]);
        for k in 0..11 {
            to[k][k] = 1.0;
        }
        let (turn, rotation_rate) = ([[c, -s], [s, c]], [[-s, -c], [c, -s]]);
        for i in 0..2 {
            for j in 0..2 {
                to[i][j] = turn[i][j];
                to[5 + i][5 + j] = turn[i][j];
                to[5 + i][j] = HEADING_RATE * rotation_rate[i][j];
                rate[i][j] = HEADING_RATE * rotation_rate[i][j];
                rate[5 + i][5 + j] = HEADING_RATE * rotation_rate[i][j];
                rate[5 + i][j] = -HEADING_RATE * HEADING_RATE * turn[i][j];
            }
        }
        let right: [[f64; 11]; 11] = std::array::from_fn(|i| {
            std::array::from_fn(|j| (0..11).map(|k| jacobian[i][k] * to[k][j]).sum::<f64>() - rate[i][j])
        });
        // T⁻¹ by its blocks: velocities less what the turning guide carries along.
        let mut out = right;
        for i in 0..2 {
            for j in 0..11 {
                let back = |from: usize| turn[0][i] * right[from][j] + turn[1][i] * right[from + 1][j];
                out[i][j] = back(0);
                out[5 + i][j] = back(5);
            }
        }
        for j in 0..11 {
            (out[5][j], out[6][j]) = (
                out[5][j] + HEADING_RATE * out[1][j],
                out[6][j] - HEADING_RATE * out[0][j],
            );
        }
        out
    };
    let first = relative(0.0);
    let size = |row: &[f64; 11]| row.iter().fold(0.0_f64, |most, a| most.max(a.abs()));
    for heading in [0.9, FRAC_PI_2, 4.0] {
        let other = relative(heading);
        for (row, (a, b)) in first.iter().zip(&other).enumerate() {
            for (a, b) in a.iter().zip(b) {
                assert!(
                    (a - b).abs() < 1e-6 * size(&first[row]),
                    "{heading} row {row}: {a} {b}"
                );
            }
        }
    }
    // A stiffness, a damping, and what turning adds: ξ¨ = ... + ω² ξ + 2 ω η˙.
    assert!((first[5][0] + STIFFNESS / MASS - HEADING_RATE * HEADING_RATE).abs() < 1e-6 * STIFFNESS / MASS);
    assert!((first[5][6] - 2.0 * HEADING_RATE).abs() < 1e-9);
}
