//! Closed forms of single elements.

use std::f64::consts::PI;

use mechanics::curve::Curve;
use mechanics::motion::Motion;
use truck::Spring;
use vehicle::StartKind;
use vehicle::catalog::{AppliedForce, AxisStop, Bushing, Coil, DryFriction, Line};

use crate::{body, element, run, value, vehicle};

const G: f64 = 9.80665;

/// A mass on a damped spring along a line: frequency and damping ratio.
#[test]
fn analytic_a_spring_and_a_damper_along_a_line() {
    let (mass, stiffness, damping) = (400.0, 2.5e5, 3e3);
    let spring = element(
        "spring",
        Line::linear(0.0, stiffness, damping),
        (1, [0.0, 0.0, 1.0]),
        (0, [0.0; 3]),
    );
    let mut own = vehicle(
        vec![body("block", mass, 1.0, [0.0, 0.0, 1.0], &[2])],
        vec![spring],
        0.0,
        StartKind::Nominal,
    );
    let found = own.vibrations().unwrap();
    let omega = (stiffness / mass).sqrt();
    let ratio = damping / (2.0 * mass * omega);
    assert_eq!(found.len(), 1);
    let damped = omega * (1.0 - ratio * ratio).sqrt();
    assert!((found[0].frequency / damped - 1.0).abs() < 1e-9, "{found:?}");
    assert!((found[0].damping_ratio() / ratio - 1.0).abs() < 1e-9, "{found:?}");
}

/// A rod on a link, hung at its upper end: the frequency of the pendulum with the link's stretch.
#[test]
fn analytic_a_mass_on_a_link_swings_as_a_pendulum() {
    let (mass, length, stiffness) = (10.0, 0.8, 1e8);
    let link = element(
        "link",
        Line::linear(-mass * G, stiffness, 0.0),
        (1, [0.0; 3]),
        (0, [0.0, 0.0, length]),
    );
    let mut own = vehicle(
        vec![body("bob", mass, 1.0, [0.0; 3], &[0, 2])],
        vec![link],
        G,
        StartKind::Nominal,
    );
    let found = own.vibrations().unwrap();
    // The load in the nominal layout is the weight, so that it rests there with its nominal length.
    assert!(
        (found[0].frequency / (G / length).sqrt() - 1.0).abs() < 1e-6,
        "{found:?}"
    );
    // Along the link the tension's geometry adds nothing.
    assert!(
        (found[1].frequency / (stiffness / mass).sqrt() - 1.0).abs() < 1e-6,
        "{found:?}"
    );
    let start = own.initial_state.clone();
    assert!((value(&mut own, "link_force", 0.0, &start) + mass * G).abs() < 1e-9);
}

/// A table along a line: push at its points, with the load; the deflection under weight.
#[test]
fn analytic_a_table_and_the_rest_under_weight() {
    let mass = 300.0;
    let table = Curve::new(vec![[-0.1, -1000.0], [0.0, 0.0], [0.05, 2000.0], [0.1, 8000.0]]).unwrap();
    let spring = Line {
        spring: table.scaled(1.0, 0.0),
        ..Line::linear(0.0, 0.0, 0.0)
    };
    let spring = element("spring", spring, (1, [0.0, 0.0, 1.0]), (0, [0.0; 3]));
    let mut own = vehicle(
        vec![body("block", mass, 1.0, [0.0, 0.0, 1.0], &[2])],
        vec![spring],
        G,
        StartKind::Equilibrium,
    );
    let start = own.initial_state.clone();
    // Beyond 2000 N by 120 kN/m.
    let compression = 0.05 + (mass * G - 2000.0) / 120e3;
    assert!((value(&mut own, "spring_compression", 0.0, &start) - compression).abs() < 1e-9);
    assert!((value(&mut own, "block_z", 0.0, &start) + compression).abs() < 1e-9);
    assert!((value(&mut own, "spring_force", 0.0, &start) - mass * G).abs() < 1e-5);
}

/// A gap: no force within the slack, a spring beyond, on both sides; it never pulls where it pushes.
#[test]
fn analytic_a_gap_lets_go_within_its_slack() {
    let gap = Line {
        slack: Some([0.02, 0.03]),
        ..Line::linear(0.0, 1e5, 0.0)
    };
    for (offset, force) in [
        (0.0, 0.0),
        (0.019, 0.0),
        (0.025, -500.0),
        (-0.029, 0.0),
        (-0.05, 2000.0),
    ] {
        let gap = element("gap", gap.clone(), (1, [1.0, 0.0, 0.0]), (0, [0.0; 3]));
        let mut block = body("block", 1.0, 1.0, [1.0, 0.0, 0.0], &[0]);
        block.start.displacement[0] = offset;
        let mut own = vehicle(vec![block], vec![gap], 0.0, StartKind::Nominal);
        let start = own.initial_state.clone();
        assert!(
            (value(&mut own, "gap_force", 0.0, &start) - force).abs() < 1e-6,
            "{offset}"
        );
    }
}

/// A bushing about one axis: the moment `κ sin φ cos φ` and the frequency of a rotation.
#[test]
fn analytic_a_bushing_about_one_axis() {
    let (stiffness, inertia) = (5e4, 12.0);
    let bushing = Bushing {
        rotational_stiffness: [0.0, 0.0, stiffness],
        ..Bushing::default()
    };
    let place = [0.3, 0.1, 0.2];
    for angle in [0.0_f64, 0.1, 0.6, 1.2] {
        let mut turned = body("turned", 5.0, inertia, place, &[5]);
        turned.start.displacement[5] = angle;
        let bushing = element("bushing", bushing.clone(), (1, place), (0, place));
        let mut own = vehicle(vec![turned], vec![bushing], 0.0, StartKind::Nominal);
        let start = own.initial_state.clone();
        let moment = -stiffness * angle.sin() * angle.cos();
        let found = value(&mut own, "bushing_moment_yaw", 0.0, &start);
        assert!(
            (found - moment).abs() < 1e-9 * stiffness,
            "{angle}: {found} {moment}"
        );
        if angle == 0.0 {
            let frequency = (stiffness / inertia).sqrt();
            assert!((own.vibrations().unwrap()[0].frequency / frequency - 1.0).abs() < 1e-9);
        }
    }
}

/// A coil on its seat: load, shear, and the height at which a body rests on it.
#[test]
fn analytic_a_coil_carries_a_body_and_shears() {
    let spring = Spring {
        preload: 2000.0,
        stiffness: 1e5,
        shear_stiffness: 4e4,
        damping: 0.0,
        solid: None,
    };
    let coil = Coil { spring, length: 0.2 };
    let place = [0.0, 0.0, 0.5];
    let mut block = body("block", 250.0, 1.0, place, &[1, 2]);
    let coil = element("coil", coil, (1, place), (0, place));
    let own = vehicle(vec![block.clone()], vec![coil.clone()], G, StartKind::Equilibrium);
    let mut own = own;
    let start = own.initial_state.clone();
    let sinks = (250.0 * G - 2000.0) / 1e5;
    assert!((value(&mut own, "block_z", 0.0, &start) + sinks).abs() < 1e-9);
    block.start.displacement[1] = 0.01;
    let mut aside = vehicle(vec![block], vec![coil], G, StartKind::Equilibrium);
    let start = aside.initial_state.clone();
    assert!((value(&mut aside, "coil_force_y", 0.0, &start) + 400.0).abs() < 1e-6);
    let found = own.vibrations().unwrap();
    assert!((found[0].frequency / (4e4_f64 / 250.0).sqrt() - 1.0).abs() < 1e-9);
    assert!((found[1].frequency / (1e5_f64 / 250.0).sqrt() - 1.0).abs() < 1e-9);
}

/// A stop along each axis: nothing within its clearance, a spring beyond.
#[test]
fn analytic_stops_along_each_axis() {
    for axis in 0..3 {
        let stop = AxisStop {
            axis,
            clearances: [0.01, 0.02],
            stiffness: 3e5,
            damping: 0.0,
        };
        for (offset, force) in [(0.015, 0.0), (0.025, -1500.0), (-0.009, 0.0), (-0.02, 3000.0)] {
            let mut block = body("block", 1.0, 1.0, [0.0; 3], &[0, 1, 2]);
            block.start.displacement[axis] = offset;
            let stop = element("stop", stop, (1, [0.0; 3]), (0, [0.0; 3]));
            let mut own = vehicle(vec![block], vec![stop], 0.0, StartKind::Nominal);
            let start = own.initial_state.clone();
            assert!((value(&mut own, "stop_force", 0.0, &start) - force).abs() < 1e-6);
            assert!((value(&mut own, "stop_displacement", 0.0, &start) - offset).abs() < 1e-12);
        }
    }
}

/// A block on dry friction under a sine of force: it holds below μN, and beyond takes a loop whose area is
/// that of the closed form for a bristle in series with a slider, moved by a prescribed sine.
#[test]
fn analytic_dry_friction_holds_and_takes_its_loop() {
    let (limit, bristle) = (0.4 * 1500.0, 1e7);
    let friction = DryFriction {
        axis: 2,
        normal_force: 1500.0,
        normal_stiffness: 0.0,
        coefficient: 0.4,
        bristle_stiffness: bristle,
        bristle_damping: 2e3,
        pushes: false,
    };
    // Held: a force of 90 % of the limit deflects the bristle alone.
    let force = AppliedForce {
        direction: [1.0, 0.0, 0.0],
        course: Motion::Sine {
            amplitude: 0.9 * limit,
            angular_frequency: PI,
            phase: 0.0,
        },
    };
    let block = body("block", 20.0, 1.0, [0.0; 3], &[0]);
    let own = vehicle(
        vec![block],
        vec![
            element("friction", friction, (1, [0.0; 3]), (0, [0.0; 3])),
            element("force", force, (1, [0.0; 3]), (0, [0.0; 3])),
        ],
        0.0,
        StartKind::Nominal,
    );
    run(&own, &[0.5, 1.0, 2.0], 1e-7, |time, seen, _| {
        let held = 0.9 * limit * (PI * time).sin() / bristle;
        let x = seen.bodies[1].origin.0[0];
        assert!((x - held).abs() < 2e-3 * limit / bristle, "{time}: {x} {held}");
    });
    // Slipping: the block is driven by x = A sin ωt; between its ends it slips by 2A less the two
    // deflections.
    let amplitude = 0.01;
    let mut driven = body("block", 20.0, 1.0, [0.0; 3], &[]);
    driven.motion.coordinates[0] = Motion::Sine {
        amplitude,
        angular_frequency: PI,
        phase: 0.0,
    };
    let sled = body("sled", 1e4, 1.0, [0.0; 3], &[0]);
    let hold = element(
        "hold",
        Line::linear(0.0, 1e9, 0.0),
        (2, [1.0, 0.0, 0.0]),
        (0, [0.0; 3]),
    );
    let own = vehicle(
        vec![driven, sled],
        vec![element("friction", friction, (2, [0.0; 3]), (1, [0.0; 3])), hold],
        0.0,
        StartKind::Nominal,
    );
    let mut losses = Vec::new();
    run(&own, &[2.0, 4.0], 1e-7, |_, seen, _| losses.push(seen.losses));
    let loop_area = 4.0 * limit * (amplitude - limit / bristle);
    let found = losses[1] - losses[0];
    assert!((found / loop_area - 1.0).abs() < 2e-3, "{found} {loop_area}");
}
