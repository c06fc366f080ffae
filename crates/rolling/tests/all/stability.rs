//! reproduction, analytic: kinematic wavelength and critical speeds through the elements on the core.

use crate::common;
use std::f64::consts::TAU;

use common::suspended::{SUSPENDED, critical_speed, growth_by_steps, hunting};
use common::{coned_wheelset, linear};
use integrate::{Integrator, Options};
use mechanics::element::Element;
use mechanics::link::RelativeMotion;
use mechanics::vector::{Matrix, Vector};
use rolling::linear::LinearOnTrack;
use rolling::rig::{Rig, RigStart, Wheels};
use wheelrail::conicity::LinearGeometry;

/// `w² = (c1 kψ + c2 ky)/(c1 I + c2 m)`, `Vc² = c1 c2 w² / (X + (ky - m w²)(kψ - I w²))`, with c1 = 2 f22,
/// c2 = 2 f11 l², X = 4 f11 f22 λ l / r.
#[test]
fn reproduction_critical_speed_of_a_suspended_wheelset_by_linearization() {
    for (suspension, creep, geometry, [critical, frequency]) in SUSPENDED {
        let [found, hertz] = critical_speed(&(suspension, creep, geometry));
        assert!((found / critical - 1.0).abs() < 1e-4, "{found} {critical}");
        // What remains is the reference speed √(V² + 0.01 m²/s²) and the digits of the published number.
        assert!((found - critical).abs() < 2e-4, "{found} {critical}");
        assert!((hertz / frequency - 1.0).abs() < 1e-4, "{hertz} {frequency}");
    }
}

/// Without springs a wheelset is unstable at any speed.
#[test]
fn analytic_a_free_wheelset_is_unstable_at_any_speed() {
    let ([mass, inertia, ..], creep, geometry, _) = SUSPENDED[0];
    for speed in [2.0, 20.0, 100.0] {
        let [growth, frequency] = hunting(
            &linear([mass, inertia, 0.0, 0.0], creep, geometry, speed),
            [0.1, 100.0],
            2.0,
        );
        assert!(growth > 0.0, "{speed}: {growth}");
        if speed < 5.0 {
            let kinematic = speed / (0.45 * 0.7452_f64 / 0.05).sqrt();
            assert!(
                (frequency / kinematic - 1.0).abs() < 1e-3,
                "{frequency} {kinematic}"
            );
        }
    }
}

/// Growth rate of the vibration by time steps: 1 % below the critical speed it decays, 1 % above it grows,
/// and as the eigenvalue says.
#[test]
fn reproduction_critical_speed_by_time_steps() {
    for (suspension, creep, geometry, [critical, frequency]) in SUSPENDED {
        for factor in [0.99, 1.01] {
            let setup = linear(suspension, creep, geometry, critical * factor);
            let eigenvalue = hunting(&setup, [5.0, 300.0], 20.0);
            let growth = growth_by_steps(&setup, frequency);
            assert_eq!(growth > 0.0, factor > 1.0, "{factor}: {growth}");
            assert!(
                (growth - eigenvalue[0]).abs() < 0.03,
                "{factor}: {growth} {eigenvalue:?}"
            );
        }
    }
}

/// Klingel's wavelength `2π √(r l/λ)` of coned wheels with patches on rails, by linearization and by time
/// steps. On round crowns the contacts move as the wheelset rolls, so that l and λ are those of the rigid
/// wheelset: 2 % less on 300 mm than with the cone's slope and the distance of the crowns, which hold on
/// sharp crowns.
#[test]
fn analytic_kinematic_wavelength_of_coned_wheels() {
    for (slope, crown) in [(0.025, 0.3), (0.05, 0.3), (0.1, 0.3), (0.05, 0.05), (0.1, 0.05)] {
        let (setup, klingel) = coned_wheelset(slope, crown);
        let speed = setup.carriage.speed;
        if crown < 0.1 {
            let sharp = TAU * (0.46 * 0.75 / slope).sqrt();
            assert!((klingel / sharp - 1.0).abs() < 0.01, "{slope}: {klingel} {sharp}");
        }
        let [growth, frequency] = hunting(&setup, [0.1, 10.0], 1.0);
        let found = TAU * speed / frequency;
        assert!((found / klingel - 1.0).abs() < 0.01, "{slope}: {found} {klingel}");
        assert!(growth.abs() < 0.05 * frequency, "{slope}: {growth}");

        let mut rig = Rig::new(
            &setup,
            RigStart {
                distance: 10.0,
                lateral: 5e-4,
                yaw: 0.0,
            },
        )
        .unwrap();
        let mut integrator =
            Integrator::new(rig.system.clone(), Options::default(), 0.0, &rig.start).unwrap();
        let (mut crossings, mut before) = (Vec::new(), None::<[f64; 2]>);
        while crossings.len() < 4 {
            integrator.step_to(100.0).unwrap();
            assert!(integrator.time() < 100.0);
            let seen = rig.system.observe(integrator.time(), integrator.x());
            let [distance, lateral, ..] = rig.relative(&setup.lines, &seen);
            if let Some([d, y]) = before
                && y * lateral < 0.0
            {
                crossings.push(d + (distance - d) * y / (y - lateral));
            }
            before = Some([distance, lateral]);
        }
        let found = crossings[3] - crossings[1];
        assert!((found / klingel - 1.0).abs() < 0.01, "{slope}: {found} {klingel}");
    }
}

/// With the roll of cones on rails, `φ = λ y/l`, the contacts stay at the height of the rails, and the tilt
/// of the axle makes the difference of the rolling radii: the wavelength is Klingel's, as without roll.
#[test]
fn issue_047_a_wheelset_that_rolls_with_its_shift_has_klingels_wavelength() {
    let ([mass, inertia, ..], creep, geometry, _) = SUSPENDED[0];
    let [conicity, radius, half_distance] = geometry;
    let speed = 2.0;
    let mut setup = linear([mass, inertia, 0.0, 0.0], creep, geometry, speed);
    let Wheels::Linear { wheelset, .. } = &mut setup.wheels else {
        panic!("linear wheels");
    };
    wheelset.geometry = LinearGeometry::of_cones(conicity, half_distance, radius);
    let [_, frequency] = hunting(&setup, [0.1, 100.0], 2.0);
    let kinematic = speed / (radius * half_distance / conicity).sqrt();
    assert!(
        (frequency / kinematic - 1.0).abs() < 1e-3,
        "{frequency} {kinematic}"
    );
}

/// An axle that rolls on what carries it keeps its rolling radii: cylinders do not creep along the rails.
#[test]
fn issue_047_an_axle_that_rolls_on_its_support_does_not_creep() {
    let ([mass, inertia, ..], creep, [_, radius, half_distance], _) = SUSPENDED[0];
    let speed = 20.0;
    let setup = linear(
        [mass, inertia, 0.0, 0.0],
        creep,
        [0.0, radius, half_distance],
        speed,
    );
    let Wheels::Linear { wheelset, .. } = setup.wheels else {
        panic!("linear wheels");
    };
    let element = LinearOnTrack {
        name: String::new(),
        lines: setup.lines,
        wheelset,
        support: [0.0; 2],
        slowest: 0.1,
    };
    let roll: f64 = 1e-3;
    let (sine, cosine) = roll.sin_cos();
    let rotation = Matrix([[1.0, 0.0, 0.0], [0.0, cosine, -sine], [0.0, sine, cosine]]);
    let wrench = element.evaluate(&RelativeMotion {
        position: Vector([50.0, 0.0, radius]),
        rotation,
        velocity: Vector([speed, 0.0, 0.0]),
        angular_velocity: Vector([0.0, cosine * speed / radius, sine * speed / radius]),
    });
    // Without the tilt of the arms: a creepage of l φ/r at each wheel.
    let couple = 2.0 * creep[0] * half_distance * half_distance * roll / radius;
    let Vector([_, _, yaw]) = wrench.moment;
    assert!(yaw.abs() < 1e-2 * couple, "{yaw} N m of {couple}");
}

/// A wheelset that rolls backward is the mirror image of one that rolls forward: the same lateral force, the
/// opposite longitudinal force and yaw moment.
#[test]
fn issue_047_spin_of_a_wheelset_that_rolls_backward_is_its_mirror_image() {
    let ([mass, inertia, ..], creep, geometry, _) = SUSPENDED[0];
    let setup = linear([mass, inertia, 0.0, 0.0], creep, geometry, 20.0);
    let Wheels::Linear { mut wheelset, .. } = setup.wheels else {
        panic!("linear wheels");
    };
    (wheelset.spin, wheelset.creep.f23, wheelset.creep.f33) = (true, 2e4, 50.0);
    let element = LinearOnTrack {
        name: String::new(),
        lines: setup.lines,
        wheelset,
        support: [0.0; 2],
        slowest: 0.1,
    };
    let radius = geometry[1];
    let at = |speed: f64| {
        element.evaluate(&RelativeMotion {
            position: Vector([50.0, 1e-3, radius]),
            rotation: Matrix([[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]),
            velocity: Vector([speed, 0.01, 0.0]),
            angular_velocity: Vector([0.0, speed / radius, 1e-3 * speed]),
        })
    };
    let [ahead, back] = [at(20.0), at(-20.0)];
    let (Vector([x, y, _]), Vector([_, _, yaw])) = (ahead.force, ahead.moment);
    let (Vector([u, v, _]), Vector([_, _, turn])) = (back.force, back.moment);
    assert!(y.abs() > 1.0 && yaw.abs() > 1.0, "{y} {yaw}");
    assert!(
        (x + u).abs() < 1e-9 * y.abs() && (y - v).abs() < 1e-9 * y.abs(),
        "{x} {u}, {y} {v}"
    );
    assert!((yaw + turn).abs() < 1e-9 * yaw.abs(), "{yaw} {turn}");
}
