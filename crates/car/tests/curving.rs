//! Cars in curves: balance of forces, symmetry, any heading.
#![allow(missing_docs, clippy::unwrap_used, clippy::expect_used)]

mod common;

use std::f64::consts::PI;

use car::Loads;
use common::{INCH, Ran, curve, loaded, run};

/// The force of all wheels on the rails along the track's plane, positive to the left, N.
fn lateral(loads: &Loads) -> f64 {
    loads
        .wheels
        .iter()
        .map(|[left, right]| left.lateral - right.lateral)
        .sum()
}

fn steady(degree: f64, turn: f64, cant: f64, speed: f64, heading: f64) -> Ran {
    let mut parameters = loaded(curve(degree, turn, cant, 200.0), speed);
    parameters.start.heading = heading;
    parameters.start.distance = 100.0;
    run(&parameters, 8.0, 0.05, 1e-5)
}

/// `Σ L = m V²/R cos φ - m g sin φ`, on all wheels.
#[test]
fn analytic_the_rails_turn_the_car() {
    for (degree, cant, speed) in [(5.0, 0.0, 13.0), (7.5, 4.0 * INCH, 8.0)] {
        let parameters = loaded(curve(degree, 1.0, cant, 250.0), speed);
        let ran = run(&parameters, 270.0 / speed, 0.05, 1e-5);
        let last = ran.last();
        let curvature = ran.car.lines.center_line().at(last.distance).curvature[0];
        let mass = parameters.weight() / parameters.gravity;
        let roll = (cant / (59.5 * INCH)).asin();
        let turning = last.speed * last.speed * curvature;
        let falling = parameters.gravity * roll.sin();
        let expected = mass * (turning * roll.cos() - falling);
        // On the rails, to the outside: to the right in a curve to the left. What is left of the car's swaying is averaged
        // over some periods.
        let late: Vec<&Loads> = ran.loads.iter().rev().take(80).map(|(_, own)| own).collect();
        let found = -late.iter().map(|own| lateral(own)).sum::<f64>() / late.len() as f64;
        let scale = mass * turning.max(falling);
        assert!(
            (found - expected).abs() < 1e-3 * scale,
            "{degree} deg: {found} N, {expected} N expected of {scale} N"
        );
        let normal: f64 = last.wheels.iter().flatten().map(|wheel| wheel.vertical).sum();
        let pressed = mass * (parameters.gravity * roll.cos() + turning * roll.sin());
        assert!(
            (normal / pressed - 1.0).abs() < 1e-3,
            "{normal} N, {pressed} N expected"
        );
    }
}

/// The leading wheelset runs against the outer rail in a curve of 7.5 deg, and its truck warps.
#[test]
fn limits_a_tight_curve_is_run_on_the_flange() {
    let ran = steady(7.5, 1.0, 4.0 * INCH, 11.0, 0.0);
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
    let [left, right] = [1.0, -1.0].map(|turn| steady(7.5, turn, 4.0 * INCH, 11.0, 0.0));
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

#[test]
fn limits_forces_do_not_know_the_heading() {
    let [here, there] = [0.0, 2.3].map(|heading| steady(5.0, 1.0, 0.0, 13.0, heading));
    let (here, there) = (here.last(), there.last());
    for (a, b) in here.wheels.iter().flatten().zip(there.wheels.iter().flatten()) {
        assert!((a.vertical - b.vertical).abs() < 1.5e2, "{a:?} {b:?}");
        assert!((a.lateral - b.lateral).abs() < 1.5e2, "{a:?} {b:?}");
    }
}

/// Round more than a full circle of 12 deg all forces stay as they are.
#[test]
fn limits_a_full_circle() {
    let length = 2.0 * PI * 145.0 + 150.0;
    let speed = 12.0;
    let mut parameters = loaded(curve(12.0, 1.0, 4.0 * INCH, length), speed);
    parameters.start.heading = 1.0;
    parameters.start.distance = 110.0;
    let ran = run(&parameters, (length - 40.0) / speed, 1.0, 1e-4);
    let turned = |own: &Loads| ran.car.lines.center_line().at(own.distance).heading;
    let last = ran.last();
    let before = ran
        .loads
        .iter()
        .find(|(_, own)| turned(own) > turned(last) - 2.0 * PI)
        .unwrap();
    assert!(turned(last) > 2.0 * PI + 0.3, "{}", turned(last));
    for (a, b) in last.wheels.iter().flatten().zip(before.1.wheels.iter().flatten()) {
        assert!((a.vertical - b.vertical).abs() < 2e3, "{a:?} {b:?}");
        assert!((a.lateral - b.lateral).abs() < 2e3, "{a:?} {b:?}");
    }
}
