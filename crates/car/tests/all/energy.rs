//! The energy ledger of a car, and the spin of its wheelsets.

use crate::common;
use car::{Car, StartKind, Wheels};
use common::{
    INCH, POUND_FORCE, at_start, curve, empty, loaded, massless, run, run_by, tangent, with_hysteresis,
};
use integrate::{Method, Problem};
use mechanics::system::EnergyTermKind;
use rolling::wheelset::coordinate;
use truck::WedgeKind;
use wheelrail::contact::CreepLaw;
use wheelrail::track::spectrum::{Realization, Spectrum};
use wheelrail::track::{Direction, Irregularity, Placed, Rails, Track};

/// Tangent track with irregularities of FRA class 6.
fn rough() -> Track {
    let mut rough = tangent(120.0);
    for (rails, direction, spectrum, seed) in [
        (Rails::Both, Direction::Lateral, Spectrum::FraLateral(6), 1),
        (Rails::Against, Direction::Vertical, Spectrum::FraCrossLevel(6), 2),
        (Rails::Both, Direction::Vertical, Spectrum::FraVertical(6), 3),
    ] {
        let own = Realization::new(spectrum, [1.524, 91.44], 400, 30.0, seed).unwrap();
        rough.irregularities.push(Placed {
            rails,
            direction,
            irregularity: Irregularity::Spectrum(own),
        });
    }
    rough
}

/// Work of the drive against losses and what is stored, on rough track and into a curve.
#[test]
fn energy_closes_on_rough_track_and_in_curves() {
    for (name, track, speed, duration) in [
        ("rough", rough(), 15.0, 3.0),
        ("curve", curve(7.5, 1.0, 4.0 * INCH, 200.0), 11.0, 10.0),
    ] {
        let bodies = loaded(track, speed);
        for parameters in [massless(bodies.clone()), bodies] {
            let ran = run(&parameters, duration, 0.05, 1e-6);
            assert!(ran.residual < 1e-4, "{name}: {}", ran.residual);
        }
    }
}

/// The empty car on side bearings with hysteresis: they begin without force of it, in the equilibrium of a
/// car without, lose energy on rough track, and the ledger closes.
#[test]
fn energy_closes_with_hysteresis_of_side_bearings() {
    let standing = empty(tangent(60.0), 15.0);
    let [without, with] = [standing.clone(), with_hysteresis(standing)].map(|own| Car::new(&own).unwrap());
    let n = with.system.layout().speeds;
    for (a, b) in without.initial_state[..n].iter().zip(&with.initial_state) {
        assert!((a - b).abs() < 1e-7, "{a} {b}");
    }
    for own in at_start(&with)
        .trucks
        .iter()
        .flat_map(|truck| truck.side_bearings)
    {
        assert!(own.hysteresis.abs() < 1e-6, "{}", own.hysteresis);
        let preload = 6000.0 * POUND_FORCE;
        assert!((own.force / preload - 1.0).abs() < 0.1, "{}", own.force);
    }
    let ran = run(&with_hysteresis(empty(rough(), 15.0)), 3.0, 0.05, 1e-6);
    assert!(ran.residual < 1e-4, "{}", ran.residual);
    let mut system = ran.car.system.clone();
    let seen = system.observe(ran.time, &ran.state);
    let terms = system.energy_terms().iter().zip(&seen.quadratures);
    let own = terms.filter(|(term, _)| term.kind == EnergyTermKind::SurfaceFriction);
    let lost: Vec<f64> = own.map(|(_, lost)| *lost).collect();
    assert!(lost.len() == 4 && lost.iter().all(|own| *own > 0.1), "{lost:?}");
    let limit = 600.0 * POUND_FORCE;
    for (time, loads) in &ran.loads {
        for own in loads.trucks.iter().flat_map(|truck| truck.side_bearings) {
            assert!(
                own.hysteresis.abs() <= limit * (1.0 + 1e-9) && own.force > 0.0,
                "{time} {own:?}"
            );
        }
    }
}

/// The residual of the ledger is the integrator's error: it falls with the tolerance, over a hundredth of it
/// to a fortieth at least. (At one tight tolerance it scatters: the last bits of the track alone make 2e-5 or
/// 5e-5 of it at 3e-7.)
#[test]
fn convergence_the_ledger_closes_with_the_tolerance() {
    let parameters = loaded(rough(), 15.0);
    let [large, small] = [3e-5, 3e-7].map(|tolerance| run(&parameters, 2.0, 0.05, tolerance).residual);
    assert!(small < 1e-4 && small < large / 40.0, "{large:e} {small:e}");
}

/// Friction of massless wedges takes energy, and the bolster does not swing on what they would feed.
#[test]
fn energy_massless_wedges_feed_none() {
    let ran = run_by(Method::TrBdf2, &massless(loaded(rough(), 15.0)), 4.0, 0.05, 1e-4);
    let mut system = ran.car.system.clone();
    let seen = system.observe(ran.time, &ran.state);
    let sum = |kind: EnergyTermKind| -> f64 {
        let terms = system.energy_terms().iter().zip(&seen.quadratures);
        terms
            .filter(|(term, _)| term.kind == kind)
            .map(|(_, value)| value)
            .sum()
    };
    let column = sum(EnergyTermKind::ColumnFriction);
    assert!(column > 500.0, "{column} J");
    for (term, value) in system.energy_terms().iter().zip(&seen.quadratures) {
        if term.kind == EnergyTermKind::SlopeFriction {
            assert!(*value > -1.0, "{}: {value} J", term.element);
        }
    }
    let fed = sum(EnergyTermKind::WedgeKinematics).abs();
    assert!(fed < 0.01 * column, "{fed} of {column} J");
}

/// A car on split wedges, pressed apart, in one truck, and spatial ones in the other: it starts in its
/// equilibrium, its wheels carry its weight, and the ledger closes into a curve.
#[test]
fn energy_closes_with_wedges_of_all_kinds() {
    let of_kinds = |track, speed| {
        let mut parameters = loaded(track, speed);
        for (truck, kind) in parameters
            .trucks
            .iter_mut()
            .zip([WedgeKind::Split, WedgeKind::Body])
        {
            for wedge in &mut truck.wedges {
                wedge.kind = kind;
                wedge.slope_across = 0.15;
                wedge.pocket_sides.clearance = 0.0;
            }
        }
        parameters
    };
    let standing = of_kinds(tangent(60.0), 0.0);
    let car = Car::new(&standing).unwrap();
    assert_eq!(car.numbers.wedges.each_ref().map(Vec::len), [8, 4]);
    let loads = common::at_start(&car);
    let carried: f64 = loads.wheels.iter().flatten().map(|wheel| wheel.vertical).sum();
    assert!((carried / standing.weight() - 1.0).abs() < 1e-7, "{carried}");
    for own in &loads.trucks[0].wedges {
        for half in own.halves {
            let share = 2.0 * half.column_normal / own.column_normal;
            assert!((share - 1.0).abs() < 0.05, "{share}");
        }
    }
    let parameters = of_kinds(curve(7.5, 1.0, 4.0 * INCH, 200.0), 11.0);
    let ran = run(&parameters, 5.0, 0.05, 1e-6);
    assert!(ran.residual < 1e-4, "{}", ran.residual);
    let turned = ran.last().trucks[0].warp_angle.abs();
    assert!(turned > 1e-4, "{turned}");
}

/// A wheelset that spins and turns with the track has the gyroscopic moment `I Ω ψ'` about its forward
/// axis. Without creep nothing else knows of the spin.
#[test]
fn analytic_gyroscopic_moment_of_the_wheelsets() {
    let mut parameters = loaded(curve(5.0, 1.0, 0.0, 200.0), 13.0);
    parameters.start.distance = 150.0;
    parameters.start.kind = StartKind::Nominal;
    if let Wheels::OnRails(wheels) = &mut parameters.wheels {
        for law in wheels.laws.iter_mut() {
            law.creep = CreepLaw::Frictionless;
        }
    }
    let car = Car::new(&parameters).unwrap();
    let mut system = car.system.clone();
    let speeds = system.layout().speeds;
    let mut still = car.initial_state.clone();
    let (mut with, mut without) = (vec![0.0; still.len()], vec![0.0; still.len()]);
    system.derivative(0.0, &car.initial_state, &mut with);
    for wheelset in car.numbers.wheelsets {
        still[speeds + system.position_of(wheelset, coordinate::SPIN).unwrap()] = 0.0;
    }
    system.derivative(0.0, &still, &mut without);
    for wheelset in car.numbers.wheelsets {
        let at = |k: usize| speeds + system.position_of(wheelset, k).unwrap();
        let (spin, yaw_rate) = (
            car.initial_state[at(coordinate::SPIN)],
            car.initial_state[at(coordinate::HEADING)],
        );
        let change = with[at(coordinate::ROLL)] - without[at(coordinate::ROLL)];
        let own = &parameters.wheelset;
        // The spin leads the axle's left end down where it turns to the left.
        let expected = own.about_axle * spin * yaw_rate / own.about_diameter;
        assert!(spin > 20.0 && yaw_rate > 0.01, "{spin} {yaw_rate}");
        assert!(
            (change.abs() / expected - 1.0).abs() < 1e-3,
            "{change} and {expected} rad/s²"
        );
    }
}
