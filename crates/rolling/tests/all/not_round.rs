//! Wheelsets whose wheels are not round: times, frequencies, heights, peaks, energy.

use crate::common;
use common::not_round::{RADIUS, eccentric_by_slices, first_peaks, out_of_round, separation_speed, wheelset};
use common::{POLACH, freight, on_rails, track};
use integrate::{Integrator, Options};
use rolling::rig::{Rig, RigStart};
use rolling::track::RailSupport;
use wheelrail::contact::{ContactLaw, CreepLaw, Flat, Harmonic};
use wheelrail::track::Segment;

fn harmonic(order: u32, amplitude: f64) -> Harmonic {
    Harmonic {
        order,
        amplitude,
        angle: 0.0,
    }
}

fn flat(length: f64, angle: f64) -> Flat {
    Flat {
        length,
        depth: None,
        angle,
    }
}

/// On rigid rails the axle at rest is lower by the depth of its flats: 0.68 mm for 50 mm; it comes down on
/// them every 2πR/V, 0.2873 s at 10 m/s.
#[test]
fn analytic_a_flat_comes_down_once_a_turn() {
    let height = |angle: f64| {
        let own = out_of_round(RADIUS, vec![flat(0.05, angle)], Vec::new());
        let setup = wheelset([Some(own.clone()), Some(own)], 2.0, 10.0, None);
        let mut rig = Rig::new(
            &setup,
            RigStart {
                distance: 5.0,
                ..RigStart::default()
            },
        )
        .unwrap();
        rig.system.observe(0.0, &rig.start).bodies[1].origin.0[2]
    };
    let drop = height(2.0) - height(0.0);
    let nearly = 0.05 * 0.05 / (8.0 * RADIUS);
    assert!((drop / nearly - 1.0).abs() < 2e-3, "{drop} {nearly}");
    let own = out_of_round(RADIUS, vec![flat(0.05, 1.0)], Vec::new());
    let speed = 10.0;
    let setup = wheelset([Some(own.clone()), Some(own)], 2.0, speed, None);
    let mut rig = Rig::new(
        &setup,
        RigStart {
            distance: 5.0,
            ..RigStart::default()
        },
    )
    .unwrap();
    let options = Options {
        relative_tolerance: 1e-6,
        maximum_step: 2e-4,
        ..Options::default()
    };
    let mut integrator = Integrator::new(rig.system.clone(), options, 0.0, &rig.start).unwrap();
    let mut blows: Vec<[f64; 2]> = Vec::new();
    let period = std::f64::consts::TAU * RADIUS / speed;
    while integrator.time() < 3.0 * period {
        integrator.step_to(3.0 * period).unwrap();
        let seen = rig.system.observe(integrator.time(), integrator.x());
        let load = seen.elements[1].force.0[2] + seen.elements[2].force.0[2];
        let turn = (integrator.time() / period) as usize;
        blows.resize(blows.len().max(turn + 1), [0.0; 2]);
        if load > blows[turn][1] {
            blows[turn] = [integrator.time(), load];
        }
    }
    assert!((period - 0.2873).abs() < 5e-5);
    for pair in blows[..3].windows(2) {
        assert!(pair[0][1] > 6e5, "{blows:?}");
        assert!(
            ((pair[1][0] - pair[0][0]) / period - 1.0).abs() < 3e-3,
            "{blows:?}"
        );
    }
}

/// A polygon of order n loads its rail at n V / 2πR with the inertia of what rises and falls: the largest
/// line of the spectrum, and its size.
#[test]
fn analytic_polygons_load_the_rail_at_their_frequency() {
    let cases = [
        (1, 1e-3, 15.0, false),
        (3, 1e-4, 20.0, false),
        (8, 2e-5, 20.0, false),
        (1, 1e-3, 15.0, true),
    ];
    for (order, amplitude, speed, by_slices) in cases {
        let own = match by_slices {
            false => out_of_round(RADIUS, Vec::new(), vec![harmonic(order, amplitude)]),
            true => eccentric_by_slices(RADIUS, amplitude),
        };
        let setup = wheelset([Some(own.clone()), Some(own)], 2.0, speed, None);
        let mut rig = Rig::new(
            &setup,
            RigStart {
                distance: 5.0,
                ..RigStart::default()
            },
        )
        .unwrap();
        let options = Options {
            relative_tolerance: 1e-6,
            ..Options::default()
        };
        let mut integrator = Integrator::new(rig.system.clone(), options, 0.0, &rig.start).unwrap();
        // Springs of the contacts: 3/2 N/d.
        let mut spring = 0.0;
        let seen = rig.system.observe(0.0, &rig.start);
        rig.patches(&seen, |_, patch| {
            spring += 1.5 * patch.forces.normal * patch.patch.share / patch.patch.approach;
        });
        let turns = 8.0;
        let length = turns * std::f64::consts::TAU * RADIUS / speed;
        let count = 2048;
        let mut loads = Vec::new();
        for k in 0..count {
            let at = 1.0 + length * f64::from(k) / f64::from(count);
            while integrator.time() < at {
                integrator.step_to(at).unwrap();
            }
            let seen = rig.system.observe(integrator.time(), integrator.x());
            loads.push(seen.elements[1].force.0[2] + seen.elements[2].force.0[2]);
        }
        let line = |number: usize| {
            let sums = loads.iter().enumerate().fold([0.0; 2], |[a, b], (k, load)| {
                let angle = std::f64::consts::TAU * (number * k) as f64 / loads.len() as f64;
                let (sine, cosine) = libm::sincos(angle);
                [a + load * cosine, b + load * sine]
            });
            2.0 * libm::hypot(sums[0], sums[1]) / loads.len() as f64
        };
        let lines: Vec<f64> = (1..200).map(line).collect();
        let largest = (1..200)
            .max_by(|a, b| lines[a - 1].total_cmp(&lines[b - 1]))
            .unwrap();
        // Waves within the turns.
        assert_eq!(largest, 8 * order as usize, "{order}");
        let rate = f64::from(order) * speed / RADIUS;
        let mass = setup.body.mass;
        let expected = mass * amplitude * rate * rate / (1.0 - mass * rate * rate / spring);
        let found = lines[largest - 1];
        assert!(
            (found / expected - 1.0).abs() < 0.02,
            "{order}: {found} {expected}"
        );
    }
}

/// A frictionless, undamped wheelset on eccentric and flattened wheels keeps its energy: what its height
/// takes comes from the spin. With friction the ledger closes too.
#[test]
fn energy_of_wheels_that_are_not_round() {
    let left = out_of_round(RADIUS, vec![flat(0.05, 2.0)], vec![harmonic(1, 1e-3)]);
    let right = out_of_round(
        RADIUS,
        vec![Flat {
            length: 0.06,
            depth: Some(3e-4),
            angle: -1.0,
        }],
        vec![harmonic(4, 1e-4)],
    );
    for (creep, damping) in [(CreepLaw::Frictionless, 0.0), (POLACH.creep, 0.3)] {
        let law = ContactLaw {
            creep,
            damping,
            ..POLACH
        };
        let mut setup = on_rails(&freight(), track(&[Segment::Tangent(60.0)], Vec::new()), law, 4.0);
        common::not_round::put(&mut setup, [Some(left.clone()), Some(right.clone())]);
        setup.carriage.drive = 0.0;
        setup.support = Some(RailSupport::default_support("rail", 9.81));
        let start = RigStart {
            distance: 5.0,
            ..RigStart::default()
        };
        let mut rig = Rig::new(&setup, start).unwrap();
        let stored = rig.system.observe(0.0, &rig.start).energies.total();
        let spin = |rig: &Rig, x: &[f64]| {
            let first = rig.system.layout().speeds;
            x[first
                + rig
                    .system
                    .position_of(1, rolling::wheelset::coordinate::SPIN)
                    .unwrap()]
        };
        let begin = spin(&rig, &rig.start);
        let options = Options {
            relative_tolerance: 1e-6,
            maximum_step: 2e-3,
            ..Options::default()
        };
        let mut integrator = Integrator::new(rig.system.clone(), options, 0.0, &rig.start).unwrap();
        let mut exchanged = 0.0_f64;
        while integrator.time() < 1.0 {
            integrator.step_to(1.0).unwrap();
            let now = spin(&rig, integrator.x());
            exchanged = exchanged.max((0.5 * 150.0 * (now * now - begin * begin)).abs());
        }
        let seen = rig.system.observe(integrator.time(), integrator.x());
        let sum = |kind: &str| -> f64 {
            let terms = rig.system.energy_terms().iter().zip(&seen.quadratures);
            let own = terms.filter(|(term, _)| term.element.starts_with("wheel") && term.kind.name() == kind);
            own.map(|(_, value)| value).sum()
        };
        let residual = seen.residual(stored);
        assert!(exchanged > 100.0, "{exchanged}");
        assert!(residual.abs() < 1e-5 * exchanged, "{residual} {exchanged}");
        let work = sum("element_work");
        assert!(work.abs() < 1e-3 * exchanged, "{work} {exchanged}");
    }
}

/// P1 under a fresh flat by the elements and by two masses on Hertz's spring that ride the same chord. The
/// closed form of a joint at the velocity of the chord holds as far as the wheel follows the flat and
/// Hertz's spring is nearly linear; above the critical speed it bounds the peak, which falls with the speed.
#[test]
fn reproduction_peaks_under_a_flat() {
    let mut fast = Vec::new();
    for (length, speed, closed_within) in [
        (0.02, 5.0, 0.06),
        (0.05, 10.0, 0.15),
        (0.05, 20.0, 0.0),
        (0.05, 30.0, 0.0),
    ] {
        let [found, masses, closed] = first_peaks(length, speed);
        assert!(
            (found / masses - 1.0).abs() < 0.03,
            "{length} {speed}: {found} {masses}"
        );
        if speed < separation_speed() {
            assert!(
                (found / closed - 1.0).abs() < closed_within,
                "{length} {speed}: {found} {closed}"
            );
        } else {
            assert!(found < closed, "{length} {speed}: {found} {closed}");
            fast.push(found);
        }
    }
    assert!(fast[1] < fast[0], "{fast:?}");
}
