//! reproduction, analytic: kinematic wavelength and critical speeds through the elements on the core.
#![allow(missing_docs, clippy::unwrap_used, clippy::expect_used)]

mod common;

use std::f64::consts::TAU;

use common::suspended::{SUSPENDED, critical_speed, growth_by_steps, hunting};
use common::{coned_wheelset, linear};
use integrate::{Integrator, Options};
use rolling::rig::{Rig, RigStart};

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
