//! energy: ledgers of wheels on rails; what a frictionless contact gives back.

use crate::common;
use common::{INCH, POLACH, freight, on_rails, track};
use integrate::{Integrator, Options};
use mechanics::system::Observation;
use rolling::rig::{Rig, RigStart, Setup};
use rolling::track::RailSupport;
use wheelrail::contact::{ContactLaw, CreepLaw};
use wheelrail::track::shape::Shape;
use wheelrail::track::spectrum::{Realization, Spectrum};
use wheelrail::track::{CurveElements, Direction, Irregularity, Placed, Rails, Segment, SpiralForm};

/// Runs to a time; gives the energy at the start, observations at steps, and the rig.
fn run(
    setup: &Setup,
    tolerance: f64,
    end: f64,
    mut see: impl FnMut(&Rig, &Observation),
) -> (f64, Observation, Rig) {
    let start = RigStart {
        distance: 1.0,
        ..RigStart::default()
    };
    let mut rig = Rig::new(setup, start).unwrap();
    let stored = rig.system.observe(0.0, &rig.start).energies.total();
    let options = Options {
        relative_tolerance: tolerance,
        ..Options::default()
    };
    let mut integrator = Integrator::new(rig.system.clone(), options, 0.0, &rig.start).unwrap();
    while integrator.time() < end {
        integrator.step_to(end).unwrap();
        let seen = rig.system.observe(integrator.time(), integrator.x());
        see(&rig, &seen);
    }
    let seen = rig.system.observe(integrator.time(), integrator.x());
    (stored, seen, rig)
}

/// Returns the sum of the quadratures of elements whose name begins so, of a kind, J.
fn sum(rig: &Rig, seen: &Observation, element: &str, kind: &str) -> f64 {
    let terms = rig.system.energy_terms().iter().zip(&seen.quadratures);
    terms
        .filter(|(term, _)| term.element.starts_with(element) && term.kind.name() == kind)
        .map(|(_, value)| value)
        .sum()
}

fn dip(rails: Rails, direction: Direction) -> Vec<Placed> {
    vec![Placed {
        rails,
        direction,
        irregularity: Irregularity::Shape(Shape::Dip {
            depth: 0.01,
            length: 3.0,
            start: 4.0,
        }),
    }]
}

/// A frictionless mass over a bump keeps its energy: nothing is put in by the rail, which is at rest, though
/// the wheel rises and falls by 10 mm within 3 m and its speed changes.
#[test]
fn energy_a_frictionless_wheelset_over_a_bump_keeps_its_energy() {
    let law = ContactLaw {
        creep: CreepLaw::Frictionless,
        damping: 0.0,
        ..POLACH
    };
    for (rails, direction) in [
        (Rails::Both, Direction::Vertical),
        (Rails::Left, Direction::Vertical),
        (Rails::Both, Direction::Lateral),
    ] {
        let track = track(&[Segment::Tangent(60.0)], dip(rails, direction));
        let mut setup = on_rails(&freight(), track, law.clone(), 5.0);
        setup.carriage.stiffness = [0.0; 2];
        setup.carriage.damping = [0.0; 2];
        setup.carriage.load = 0.0;
        setup.carriage.drive = 0.0;
        let mut exchanged = 0.0_f64;
        let (stored, seen, rig) = run(&setup, 1e-7, 2.0, |rig, seen| {
            let start = rig.relative(&setup.lines, seen);
            assert!(start[0] < 30.0);
            let height = seen.bodies[1].origin.0[2];
            exchanged = exchanged.max((height - 18.0 * INCH).abs() * 1250.0 * 9.81);
        });
        let change = seen.energies.total() - stored;
        let work = sum(&rig, &seen, "wheel", "element_work");
        assert!(
            (change - work).abs() < 1e-5 * exchanged.max(10.0),
            "{change} {work}"
        );
        assert!(work.abs() < 1e-3 * exchanged.max(10.0), "{work} {exchanged}");
        if rails == Rails::Both && direction == Direction::Vertical {
            assert!(exchanged > 100.0, "{exchanged}");
            assert!(change.abs() < 1e-5 * exchanged, "{change}");
        }
    }
}

/// On rough track, with flange strikes, on rigid and on sprung rails: what the drive puts in is stored or
/// lost. The part of the contacts that does not come back is below 1 % of what creep and damping lose.
#[test]
fn energy_ledger_closes_on_rough_track() {
    let placed = |rails, direction, spectrum, seed| Placed {
        rails,
        direction,
        irregularity: Irregularity::Spectrum(
            Realization::new(spectrum, [1.524, 91.44], 500, 30.0, seed).unwrap(),
        ),
    };
    let irregularities = vec![
        placed(Rails::Both, Direction::Lateral, Spectrum::FraLateral(4), 1),
        placed(Rails::Against, Direction::Lateral, Spectrum::FraCrossLevel(4), 2),
        placed(Rails::Both, Direction::Vertical, Spectrum::FraVertical(5), 3),
    ];
    for sprung in [false, true] {
        let track = track(&[Segment::Tangent(200.0)], irregularities.clone());
        let mut setup = on_rails(&freight(), track, POLACH, 60.0 / 3.6);
        setup.support = sprung.then(|| RailSupport::default_support("rail", 9.81));
        let mut widest = 0.0_f64;
        let (stored, seen, rig) = run(&setup, 1e-5, 6.0, |rig, seen| {
            widest = widest.max(rig.relative(&setup.lines, seen)[1].abs());
        });
        let residual = seen.residual(stored);
        let largest = seen.work.abs().max(seen.losses.abs());
        let lost = sum(&rig, &seen, "wheel", "element_loss");
        let work = sum(&rig, &seen, "wheel", "element_work");
        assert!(widest > 0.011, "no flange contact: {widest}");
        assert!(largest > 100.0);
        assert!(residual.abs() < 1e-5 * largest, "{residual} {largest}");
        assert!(work.abs() < 0.01 * lost, "{work} {lost}");
    }
}

/// Straight perfect track at 60 s below the critical speed: nothing moves aside.
#[test]
fn limits_nothing_moves_aside_on_straight_perfect_track() {
    for speed in [0.0, 15.0] {
        let track = track(&[Segment::Tangent(1000.0)], Vec::new());
        let setup = on_rails(&freight(), track, POLACH, speed);
        let mut widest = [0.0_f64; 2];
        run(&setup, 1e-5, 60.0, |rig, seen| {
            let [_, lateral, _, _, roll] = rig.relative(&setup.lines, seen);
            widest = [widest[0].max(lateral.abs()), widest[1].max(roll.abs())];
        });
        assert!(widest[0] < 1e-6 && widest[1] < 1e-6, "{speed}: {widest:?}");
    }
}

/// Through a spiral into a curve that a carriage leads the wheelset through.
#[test]
fn energy_ledger_closes_through_a_curve() {
    let curve = CurveElements::of_degree(4.0_f64.to_radians(), 2.0 * INCH);
    let segments = [
        Segment::Tangent(20.0),
        Segment::Spiral(40.0, SpiralForm::Clothoid),
        Segment::Curve(100.0, curve),
    ];
    let mut setup = on_rails(&freight(), track(&segments, Vec::new()), POLACH, 15.0);
    // A carriage that leads it through the curve.
    setup.carriage.stiffness = [2e6, 2e7];
    let (stored, seen, rig) = run(&setup, 1e-6, 8.0, |_, _| ());
    let [distance, lateral, ..] = rig.relative(&setup.lines, &seen);
    assert!(distance > 100.0 && lateral.abs() > 1e-3);
    let residual = seen.residual(stored);
    let lost = sum(&rig, &seen, "wheel", "element_loss");
    let work = sum(&rig, &seen, "wheel", "element_work");
    assert!(residual.abs() < 1e-5 * lost, "{residual} {lost}");
    assert!(work.abs() < 0.01 * lost, "{work} {lost}");
}

/// On a vertical sine `z = A sin(ω t)` of both rails the wheels carry `W - m A ω² sin(ω t)`, with the mass m
/// that follows the rails and the load W at rest: contacts and rails are much stiffer than `m ω²`.
#[test]
fn analytic_wheel_loads_on_a_sine_of_both_rails() {
    let (amplitude, wavelength, speed) = (1e-3, 5.0, 15.0);
    let sine = vec![Placed {
        rails: Rails::Both,
        direction: Direction::Vertical,
        irregularity: Irregularity::Shape(Shape::Sine {
            amplitude,
            wavelength,
            cycles: 8,
            start: 5.0,
        }),
    }];
    let mut setup = on_rails(&freight(), track(&[Segment::Tangent(100.0)], sine), POLACH, speed);
    setup.carriage.damping = [2e4, 2e3];
    let rate = std::f64::consts::TAU / wavelength;
    let frequency = rate * speed;
    let (mass, load) = (1250.0, 280e3 + 1250.0 * 9.81);
    let swing = mass * amplitude * frequency * frequency;
    let (mut worst, mut largest) = (0.0_f64, 0.0_f64);
    run(&setup, 1e-6, 2.5, |rig, seen| {
        let distance = rig.relative(&setup.lines, seen)[0];
        if !(25.0..40.0).contains(&distance) {
            return;
        }
        // The carriage comes first, then both wheels; creep forces on coned treads carry a part.
        let sum = seen.elements[1].force.0[2] + seen.elements[2].force.0[2];
        let (sine, _) = libm::sincos(rate * (distance - 5.0));
        worst = worst.max((sum - (load - swing * sine)).abs());
        largest = largest.max((sum - load).abs());
    });
    assert!((largest / swing - 1.0).abs() < 0.01, "{largest} {swing}");
    assert!(worst < 0.01 * swing, "{worst} {swing}");
}
