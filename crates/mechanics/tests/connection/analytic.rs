//! Laws against their closed forms.

use mechanics::connection::{
    Accumulator, ColumnFace, GapDamper, Law, Options, SpringDamper, SurfaceFriction,
};
use mechanics::contact::FrictionDirections;
use mechanics::curve::Curve;
use mechanics::system::ContactState;
use mechanics::system::System;

use crate::common::Random;
use crate::models::{against_ground, at, at_deflection, one};

pub fn close(value: f64, expected: f64, tolerance: f64) {
    assert!(
        (value - expected).abs() <= tolerance,
        "{value} instead of {expected} (within {tolerance})"
    );
}

/// Returns a column without profile.
pub fn plain(toe_out: bool) -> ColumnFace {
    ColumnFace::Plain { toe_out }
}

#[test]
fn curves_mirror_continue_and_integrate() {
    let mirrored = Curve::mirrored_from_origin(vec![[0.0, 0.0], [2.0, 4.0], [3.0, 10.0]]).unwrap();
    for (x, y) in [(1.0, 2.0), (2.5, 7.0), (5.0, 22.0), (-1.0, -2.0), (-5.0, -22.0)] {
        assert_eq!(mirrored.evaluate(x), y);
    }
    // an abscissa of zero alone does not mirror
    let one_sided = Curve::mirrored_from_origin(vec![[0.0, -5.0], [1.0, 0.0], [2.0, 0.0]]).unwrap();
    assert_eq!((one_sided.evaluate(-1.0), one_sided.evaluate(7.0)), (-10.0, 0.0));
    close(mirrored.integral(5.0), 4.0 + 7.0 + 2.0 * 16.0, 1e-12);
    close(mirrored.integral(-5.0), 4.0 + 7.0 + 2.0 * 16.0, 1e-12);
    close(one_sided.integral(-1.0), 7.5, 1e-12);
    let mut random = Random(3);
    for _ in 0..200 {
        let mut x = -1.5;
        let points = (0..6).map(|_| {
            x += random.between(0.1, 0.8);
            [x, random.between(-3.0, 3.0)]
        });
        let curve = Curve::new(points.collect()).unwrap();
        let (low, high) = (random.between(-2.0, 0.5), random.between(0.5, 2.0));
        let clamped = curve.clamped(low, high);
        for _ in 0..20 {
            let x = random.between(-4.0, 6.0);
            close(clamped.evaluate(x), curve.evaluate(x).clamp(low, high), 1e-9);
            // the integral's derivative is the curve
            let h = 1e-5;
            let slope = (clamped.integral(x + h) - clamped.integral(x - h)) / (2.0 * h);
            close(slope, clamped.evaluate(x), 2e-3);
        }
        assert_eq!(clamped.integral(0.0), 0.0);
    }
}

/// A curve whose first or last point lies on a limit, or beyond it, goes on from there by its own slope.
#[test]
fn clamped_curves_go_on_from_a_limit() {
    for points in [
        vec![[0.0, 0.0], [1.0, -3.0]],
        vec![[-1.0, -3.0], [0.0, 0.0]],
        vec![[0.0, -3.0], [1.0, -2.0]],
        vec![[0.0, -2.0], [1.0, -3.0]],
    ] {
        let curve = Curve::new(points.clone()).unwrap();
        for most in [f64::INFINITY, 5.0] {
            let clamped = curve.clamped(0.0, most);
            for i in -40..=40 {
                let x = 0.25 * f64::from(i);
                close(clamped.evaluate(x), curve.evaluate(x).clamp(0.0, most), 1e-12);
            }
        }
    }
}

/// A limit of 1e9 lbf on a soft spring does not cost digits of the energy near zero.
#[test]
fn far_limits_keep_the_digits_of_energies() {
    let curve = Curve::linear(10.0).clamped(-4.4e9, 4.4e9);
    close(curve.integral(0.01), 0.5 * 10.0 * 1e-4, 1e-18);
}

#[test]
fn a_spring_and_damper_in_parallel_are_clamped_together() {
    let law = SpringDamper {
        spring: Some(Curve::linear(100.0)),
        damper: Some(Curve::linear(7.0)),
        compression_limit: -50.0,
        extension_limit: 20.0,
    };
    let mut system = against_ground(one(1, law), Options::default());
    for (s, v, force) in [
        (0.1, 0.5, 13.5),
        (0.3, 0.0, 20.0),
        (0.1, 3.0, 20.0),
        (-0.6, 5.0, -25.0),
        (-1.0, 0.0, -50.0),
    ] {
        let state = at(&mut system, [0.0, s, 0.0], [0.0, v, 0.0]).connections[0].clone();
        close(state.forces[0], force, 1e-12);
        assert_eq!((state.extensions[0], state.velocities[0]), (s, v));
    }
    // -f acts on body A
    let observation = at(&mut system, [0.0, 0.1, 0.0], [0.0; 3]);
    close(observation.bodies[0].accelerations[1], -10.0, 1e-12);
}

#[test]
fn a_gap_is_empty_inside_and_never_pulls_at_its_lower_end() {
    let law = GapDamper {
        spring: None,
        damper: Some(Curve::linear(10.0)),
        low: -0.1,
        high: 0.2,
    };
    let mut system = against_ground(Law::Gap(2, law.clone()), Options::default());
    let mut force = |s: f64, v: f64| at(&mut system, [0.0, 0.0, s], [0.0, 0.0, v]).connections[0].forces[0];
    assert_eq!([force(0.0, 3.0), force(-0.05, -3.0), force(0.19, 3.0)], [0.0; 3]);
    assert_eq!([force(-0.2, -3.0), force(-0.2, 3.0)], [-30.0, 0.0]);
    assert_eq!([force(0.3, -3.0), force(0.3, 3.0)], [0.0, 30.0]);
    let options = Options {
        gap_tension: mechanics::connection::GapTension::Allowed,
        ..Options::default()
    };
    let mut system = against_ground(Law::Gap(2, law), options);
    assert_eq!(
        at(&mut system, [0.0, 0.0, -0.2], [0.0, 0.0, 3.0]).connections[0].forces[0],
        30.0
    );
}

#[test]
fn strokes_follow_the_levers() {
    let law = Law::Springs(
        (0..6)
            .map(|k| (k, SpringDamper::spring(Curve::linear(1.0))))
            .collect(),
    );
    let mut model = crate::models::model(
        vec![
            mechanics::body::Body::linearized("a", [1.0, 2.0, 3.0], [true; 6], 1.0, [1.0; 3]),
            mechanics::body::Body::ground(),
        ],
        vec![crate::models::connection(0, 1, [1.5, 2.7, 3.9], law)],
    );
    model.gravity[2] = -9.0;
    let mut system = System::new(model).unwrap();
    let (lx, ly, lz) = (0.5, 0.7, 0.9);
    let [x, y, z, phi, theta, psi] = [0.1, 0.2, 0.3, 0.01, 0.02, 0.03];
    let mut state = system.initial_state();
    state[..6].copy_from_slice(&[x, y, z, phi, theta, psi]);
    let observation = system.observe(0.0, &state);
    let extensions = [
        x + theta * lz - psi * ly,
        y - phi * lz + psi * lx,
        z + phi * ly - theta * lx,
        phi,
        theta,
        psi,
    ];
    for (value, expected) in observation.connections[0].extensions.iter().zip(extensions) {
        close(*value, expected, 1e-15);
    }
    // the moment of a force about the center of gravity is l × F
    let f = extensions.map(|s| -s);
    let moment = [
        f[3] + ly * f[2] - lz * f[1],
        f[4] + lz * f[0] - lx * f[2],
        f[5] + lx * f[1] - ly * f[0],
    ];
    for k in 0..3 {
        close(observation.bodies[0].accelerations[3 + k], moment[k], 1e-14);
        close(
            observation.bodies[0].accelerations[k],
            f[k] - if k == 2 { 9.0 } else { 0.0 },
            1e-14,
        );
    }
}

#[test]
fn surface_friction_holds_and_slips_on_one_circle() {
    let law = SurfaceFriction {
        clamped: false,
        directions: FrictionDirections::Two,
        coordinates: [2, 0, 1],
        spring: Curve::new(vec![[0.0, -100.0], [0.5, 0.0], [1.0, 0.0]]).unwrap(),
        damper: None,
        coefficient: 0.5,
        accumulator: Accumulator::Bristle {
            stiffness: 1000.0,
            damping: 1.0,
        },
    };
    let mut system = against_ground(Law::Surface(law), Options::default());
    // N = 150 N, limit 75 N
    let held = at_deflection(&mut system, [0.0, 0.0, -0.25], [0.0; 3], [0.03, -0.04]);
    let state = &held.connections[0];
    assert_eq!(state.contact_state, Some(ContactState::Stick));
    for (value, expected) in state.forces.iter().zip([-150.0, 30.0, -40.0]) {
        close(*value, expected, 1e-12);
    }
    let slips = at_deflection(&mut system, [0.0, 0.0, -0.25], [30.0, -40.0, 0.0], [0.075, -0.1]);
    let state = &slips.connections[0];
    assert_eq!(state.contact_state, Some(ContactState::Slip));
    for (value, expected) in state.forces.iter().zip([-150.0, 45.0, -60.0]) {
        close(*value, expected, 1e-12);
    }
    let lifted = at(&mut system, [0.0, 0.0, 0.6], [3.0, 0.0, 0.0]);
    assert_eq!(lifted.connections[0].forces, [0.0; 3]);
    assert_eq!(lifted.connections[0].contact_state, Some(ContactState::Open));
}
