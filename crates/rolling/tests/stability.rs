//! reproduction, analytic: kinematic wavelength and critical speeds through the elements on the core.
#![allow(missing_docs, clippy::unwrap_used, clippy::expect_used)]

mod common;

use std::f64::consts::TAU;

use common::{POLACH, cones, linear, on_rails, track};
use integrate::{Integrator, Options};
use rolling::rig::{Rig, Setup, Start};
use wheelrail::conicity::LinearGeometry;
use wheelrail::contact::{ContactLaw, CreepLaw};
use wheelrail::track::Segment;

const START: Start = Start {
    distance: 50.0,
    lateral: 0.0,
    yaw: 0.0,
};

/// The least damped vibration whose frequency lies in a range (rad/s): real and imaginary part.
fn hunting(setup: &Setup, range: [f64; 2], shift: f64) -> [f64; 2] {
    let mut rig = Rig::new(setup, START).unwrap();
    let start = rig.start.clone();
    let found = rig.system.eigenvalues(0.0, &start, shift).unwrap();
    *found
        .iter()
        .find(|[_, imaginary]| (range[0]..range[1]).contains(imaginary))
        .expect("a vibration in the range")
}

/// Two suspended wheelsets: parameters, critical speed (m/s) and frequency (Hz) by the closed form.
type Suspended = ([f64; 4], [f64; 2], [f64; 3], [f64; 2]);
const SUSPENDED: [Suspended; 2] = [
    (
        [1250.0, 700.0, 2.5e5, 2.5e6],
        [1e7, 1e7],
        [0.05, 0.45, 0.7452],
        [117.1532, 6.92422],
    ),
    (
        [1568.0, 656.0, 4e5, 1.5e6],
        [9.43e6, 10.2e6],
        [0.05, 0.4572, 0.7465],
        [90.7235, 5.43344],
    ),
];

/// `w² = (c1 kψ + c2 ky)/(c1 I + c2 m)`, `Vc² = c1 c2 w² / (X + (ky - m w²)(kψ - I w²))`, with c1 = 2 f22,
/// c2 = 2 f11 l², X = 4 f11 f22 λ l / r.
#[test]
fn reproduction_critical_speed_of_a_suspended_wheelset_by_linearization() {
    for (suspension, creep, geometry, [critical, frequency]) in SUSPENDED {
        let at = |speed: f64| hunting(&linear(suspension, creep, geometry, speed), [5.0, 300.0], 20.0);
        let (mut low, mut high) = (50.0, 200.0);
        assert!(at(low)[0] < 0.0 && at(high)[0] > 0.0);
        while high - low > 1e-7 {
            let middle = 0.5 * (low + high);
            *(if at(middle)[0] < 0.0 { &mut low } else { &mut high }) = middle;
        }
        let found = 0.5 * (low + high);
        assert!((found / critical - 1.0).abs() < 1e-4, "{found} {critical}");
        // What remains is the reference speed √(V² + 0.01 m²/s²) and the digits of the published number.
        assert!((found - critical).abs() < 2e-4, "{found} {critical}");
        let hertz = at(found)[1] / TAU;
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
            let mut rig = Rig::new(
                &setup,
                Start {
                    lateral: 1e-4,
                    ..START
                },
            )
            .unwrap();
            let options = Options {
                relative_tolerance: 1e-7,
                ..Options::default()
            };
            let mut integrator = Integrator::new(rig.system.clone(), options, 0.0, &rig.start).unwrap();
            // Largest excursions in three periods, early and late.
            let mut peak = |from: f64| {
                let until = from + 3.0 / frequency;
                let mut largest = (0.0_f64, from);
                while integrator.time() < until {
                    integrator.step_to(until).unwrap();
                    if integrator.time() < from {
                        continue;
                    }
                    let seen = rig.system.observe(integrator.time(), integrator.x());
                    let lateral = rig.relative(&setup.lines, &seen)[1].abs();
                    if lateral > largest.0 {
                        largest = (lateral, integrator.time());
                    }
                }
                largest
            };
            let (early, late) = (peak(1.5), peak(5.0));
            let growth = libm::log(late.0 / early.0) / 3.5;
            assert_eq!(growth > 0.0, factor > 1.0, "{factor}: {early:?} {late:?}");
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
    let law = ContactLaw {
        creep: CreepLaw::Linear,
        ..POLACH
    };
    for (slope, crown) in [(0.025, 0.3), (0.05, 0.3), (0.1, 0.3), (0.05, 0.05), (0.1, 0.05)] {
        let wheels = cones(slope, crown);
        let speed = 2.0;
        let mut setup = on_rails(&wheels, track(&[Segment::Tangent(200.0)], Vec::new()), law, speed);
        setup.carriage.stiffness = [0.0; 2];
        setup.carriage.damping = [0.0; 2];
        setup.carriage.load = 50e3;
        let klingel = LinearGeometry::of(&wheels.0, 1e-3).unwrap().klingel_wavelength();
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
            Start {
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
