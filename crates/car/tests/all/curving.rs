//! Cars in curves: balance of forces, symmetry, any heading.

use crate::common;
use car::{Car, Loads, Parameters};
use common::{INCH, POUND_FORCE, Ran, at_start, curve, loaded, massless, run, run_by, track};
use integrate::Method;
use truck::{WedgeKind, empirical_warp};
use wheelrail::track::{CurveElements, Segment, SpiralForm};

/// Returns the force of all wheels on the rails along the track's plane, positive to the left, N.
fn lateral(loads: &Loads) -> f64 {
    loads
        .wheels
        .iter()
        .map(|[left, right]| left.lateral - right.lateral)
        .sum()
}

/// Returns the mean of the last four seconds, some periods of what is left of the car's swaying.
fn late(ran: &Ran, of: impl Fn(&Loads) -> f64) -> f64 {
    let late = ran.loads.iter().rev().take(80);
    late.map(|(_, own)| of(own)).sum::<f64>() / 80.0
}

fn steady(degree: f64, turn: f64, cant: f64, speed: f64) -> Ran {
    let mut parameters = loaded(curve(degree, turn, cant, 200.0), speed);
    parameters.start.distance = 100.0;
    run(&parameters, 8.0, 0.05, 1e-5)
}

/// `Σ L = m V²/R cos φ - m g sin φ`, on all wheels.
fn the_rails_turn_the_car(degree: f64, cant: f64, speed: f64) {
    let parameters = loaded(curve(degree, 1.0, cant, 250.0), speed);
    let ran = run(&parameters, 270.0 / speed, 0.05, 1e-5);
    let last = ran.last();
    let curvature = ran.car.lines.center_line().at(last.distance).curvature[0];
    let mass = parameters.weight() / parameters.gravity;
    let roll = (cant / (59.5 * INCH)).asin();
    let centripetal = last.speed * last.speed * curvature;
    let falling = parameters.gravity * roll.sin();
    let expected = mass * (centripetal * roll.cos() - falling);
    // On the rails, to the outside: to the right in a curve to the left.
    let found = -late(&ran, lateral);
    let scale = mass * centripetal.max(falling);
    assert!(
        (found - expected).abs() < 1e-3 * scale,
        "{degree} deg: {found} N, {expected} N expected of {scale} N"
    );
    let normal: f64 = last.wheels.iter().flatten().map(|wheel| wheel.vertical).sum();
    let pressed = mass * (parameters.gravity * roll.cos() + centripetal * roll.sin());
    assert!(
        (normal / pressed - 1.0).abs() < 1e-3,
        "{normal} N, {pressed} N expected"
    );
}

#[test]
fn analytic_the_rails_turn_the_car_without_cant() {
    the_rails_turn_the_car(5.0, 0.0, 13.0);
}

#[test]
fn analytic_the_rails_turn_the_car_with_cant() {
    the_rails_turn_the_car(7.5, 4.0 * INCH, 8.0);
}

/// The leading wheelset runs against the outer rail in a curve of 7.5 deg, and its truck warps.
#[test]
fn limits_a_tight_curve_is_run_on_the_flange() {
    let ran = steady(7.5, 1.0, 4.0 * INCH, 11.0);
    let last = ran.last();
    let [leading, ..] = &last.axles;
    assert!(leading.lateral < -8e-3, "{leading:?}");
    assert!(leading.yaw < -4e-3, "it steers outwards: {leading:?}");
    let [_, outer] = last.wheels[0];
    assert!(outer.l_over_v() > 0.3, "{outer:?}");
    assert!(
        last.trucks[0].warp_angle.abs() > 1e-3,
        "{}",
        last.trucks[0].warp_angle
    );
    assert!(ran.residual < 1e-4, "{}", ran.residual);
}

#[test]
fn limits_curves_to_the_left_and_to_the_right_mirror_each_other() {
    let [left, right] = [1.0, -1.0].map(|turn| steady(7.5, turn, 4.0 * INCH, 11.0));
    let (left, right) = (left.last(), right.last());
    for w in 0..4 {
        for i in 0..2 {
            let (a, b) = (&left.wheels[w][i], &right.wheels[w][1 - i]);
            for (a, b) in [(a.vertical, b.vertical), (a.lateral, b.lateral)] {
                assert!((a - b).abs() < 300.0, "wheel {w} {i}: {a} and {b} N");
            }
        }
        let sum = left.axles[w].lateral + right.axles[w].lateral;
        assert!(sum.abs() < 2e-5, "wheelset {w}: {sum} m");
    }
}

/// The car turns past 90 deg, where the order of angles of rigs is singular, and past 180 deg.
#[test]
fn limits_forces_do_not_know_the_heading() {
    for heading in [1.4, 3.0] {
        same_as_at(heading);
    }
}

fn same_as_at(heading: f64) {
    let ran = [0.0, heading].map(|heading| {
        let mut parameters = loaded(curve(5.0, 1.0, 0.0, 200.0), 13.0);
        (parameters.start.heading, parameters.start.distance) = (heading, 100.0);
        run(&parameters, 8.0, 0.05, 2e-6)
    });
    same(&ran);
}

/// The same with massless wedges and empirical warp springs, which act between markers.
#[test]
fn limits_forces_of_massless_wedges_do_not_know_the_heading() {
    let ran = [0.0, 3.0].map(|heading| {
        let mut parameters = industry(5.0, 0.0, 13.0);
        parameters.start.heading = heading;
        run(&parameters, 4.0, 0.05, 1e-5)
    });
    same(&ran);
}

/// Returns a car with the industry's wedges and the warp springs of a new truck, in a curve.
fn industry(degree: f64, cant: f64, speed: f64) -> Parameters {
    let mut parameters = massless(loaded(curve(degree, 1.0, cant, 200.0), speed));
    for own in &mut parameters.trucks {
        own.warp_spring = Some(empirical_warp(255e3 * POUND_FORCE * INCH).unwrap());
    }
    parameters.start.distance = 100.0;
    parameters
}

/// Steady curving of 7.5 deg with the industry's wedges beside wedges that are bodies: the rails' sum is
/// that of the balance with either, forces of the leading outer wheel agree within a tenth. Massless wedges
/// do not lock in warp: their trucks warp more and steer less, and the warp springs of a new truck make
/// about as much as crowned wedges do.
#[test]
fn limits_massless_wedges_curve_as_wedge_bodies_do() {
    let with_springs = industry(7.5, 4.0 * INCH, 11.0);
    let mut without = with_springs.clone();
    for own in &mut without.trucks {
        own.warp_spring = None;
    }
    let mut bodies = without.clone();
    for wedge in bodies.trucks.iter_mut().flat_map(|own| &mut own.wedges) {
        wedge.kind = WedgeKind::Body;
    }
    let ran = [bodies, with_springs, without].map(|parameters| {
        let ran = run_by(Method::TrBdf2, &parameters, 10.0, 0.05, 1e-4);
        assert!(ran.residual < 1e-4, "{}", ran.residual);
        ran
    });
    let of = |quantity: fn(&Loads) -> f64| ran.each_ref().map(|ran| late(ran, quantity));
    let [expected, sprung, free] = of(lateral);
    for found in [sprung, free] {
        assert!((found - expected).abs() < 2e3, "{found} and {expected} N");
    }
    let [expected, sprung, free] = of(|loads| loads.wheels[0][1].lateral);
    for found in [sprung, free] {
        assert!((found / expected - 1.0).abs() < 0.1, "{found} and {expected} N");
    }
    let [bodies, sprung, free] = of(|loads| -loads.axles[0].yaw);
    assert!(
        bodies > 5e-3 && (sprung / bodies - 1.0).abs() < 0.03 && free > 1.03 * bodies && free < 1.25 * bodies,
        "{bodies} {sprung} {free} rad"
    );
    let [locked, sprung, free] = of(|loads| loads.trucks[0].warp_angle);
    assert!(
        locked > 2e-3 && (sprung / locked - 1.0).abs() < 0.15 && free > 1.05 * sprung && free < 1.6 * locked,
        "{locked} {sprung} {free}"
    );
}

fn same(ran: &[Ran; 2]) {
    let [here, there] = ran.each_ref().map(Ran::last);
    for (a, b) in here.wheels.iter().flatten().zip(there.wheels.iter().flatten()) {
        assert!((a.vertical - b.vertical).abs() < 1.5e2, "{a:?} {b:?}");
        assert!((a.lateral - b.lateral).abs() < 1.5e2, "{a:?} {b:?}");
    }
    for (a, b) in here.trucks.iter().zip(&there.trucks) {
        for (a, b) in a.wedges.iter().zip(&b.wedges) {
            for (a, b) in a.displacement.iter().zip(b.displacement) {
                assert!((a - b).abs() < 1e-3, "{a} {b} m");
            }
            assert!(
                (a.rise - b.rise).abs() < 1e-4 && a.rise.abs() < 5e-3,
                "{} {} m",
                a.rise,
                b.rise
            );
            assert!(a.coil_extension.abs() < 0.03, "{} m", a.coil_extension);
        }
    }
}

/// In a curve with superelevation, at once.
#[test]
fn analytic_wheel_forces_at_any_heading_are_the_same() {
    let at = |heading: f64| {
        let mut parameters = loaded(curve(7.5, 1.0, 4.0 * INCH, 200.0), 11.0);
        (parameters.start.heading, parameters.start.distance) = (heading, 150.0);
        at_start(&Car::new(&parameters).unwrap())
    };
    let here = at(0.0);
    for heading in [1.0, std::f64::consts::FRAC_PI_2, 3.0, -2.0] {
        let there = at(heading);
        for (a, b) in here.wheels.iter().flatten().zip(there.wheels.iter().flatten()) {
            assert!(
                (a.vertical - b.vertical).abs() < 1e-6 * 146e3,
                "{heading}: {a:?} {b:?}"
            );
            assert!(
                (a.lateral - b.lateral).abs() < 1e-6 * 146e3,
                "{heading}: {a:?} {b:?}"
            );
        }
        for (a, b) in here.trucks.iter().zip(&there.trucks) {
            assert!((a.nest_vertical[0] - b.nest_vertical[0]).abs() < 0.1, "{heading}");
            assert!((a.warp_angle - b.warp_angle).abs() < 1e-9, "{heading}");
        }
    }
}

/// Tangent, spiral and curve, each laid in two parts, are the same track.
#[test]
fn limits_joined_tracks_are_one_track() {
    let own = CurveElements::of_degree(7.5_f64.to_radians(), 4.0 * INCH);
    let half = CurveElements {
        curvature: 0.5 * own.curvature,
        superelevation: 0.5 * own.superelevation,
    };
    let joined = track(&[
        Segment::Tangent(12.0),
        Segment::Tangent(18.0),
        Segment::Spiral(30.0, SpiralForm::Clothoid),
        Segment::Curve(1e-3, half),
        Segment::Spiral(30.0, SpiralForm::Clothoid),
        Segment::Curve(40.0, own),
        Segment::Curve(60.0, own),
    ]);
    let whole = curve(7.5, 1.0, 4.0 * INCH, 100.0);
    for distance in [45.0, 75.0, 110.0, 135.0] {
        let [a, b] = [&joined, &whole].map(|track| {
            let mut parameters = loaded(track.clone(), 11.0);
            parameters.start.distance = distance;
            at_start(&Car::new(&parameters).unwrap())
        });
        for (a, b) in a.wheels.iter().flatten().zip(b.wheels.iter().flatten()) {
            assert!(
                (a.vertical - b.vertical).abs() < 1e-4 * 146e3,
                "{distance}: {a:?} {b:?}"
            );
            assert!(
                (a.lateral - b.lateral).abs() < 1e-4 * 146e3,
                "{distance}: {a:?} {b:?}"
            );
        }
    }
}
