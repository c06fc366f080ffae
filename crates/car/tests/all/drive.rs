//! The force that holds the speed of a car: constant, over distance, over time.

use crate::common;
use car::{Car, Drive, Parameters};
use common::{curve, empty, run, tangent};

/// A gain (N·s/m) that leaves little lag: an eighth of a second on the empty car.
const GAIN: f64 = 2e5;

fn following(mut parameters: Parameters, speeds: Vec<[f64; 2]>) -> Parameters {
    parameters.start.speed = speeds[0][1];
    parameters.drive = Drive::History { gain: GAIN, speeds };
    parameters
}

/// From 12 to 9 m/s between 1 and 11 s, then held. A car of mass m (with the inertia of its wheelsets about
/// the axle) that slows down by a lags behind the speed of its place by `m a/gain`; by time it is within
/// that.
#[test]
fn analytic_a_car_follows_a_speed_history() {
    let history = vec![[1.0, 12.0], [11.0, 9.0]];
    for (name, track) in [
        ("straight", tangent(200.0)),
        ("curve", curve(3.0, 1.0, 0.0, 120.0)),
    ] {
        let parameters = following(empty(track, 12.0), history.clone());
        let ran = run(&parameters, 13.0, 0.1, 1e-5);
        let spinning = 4.0 * parameters.wheelset.about_axle / (18.0_f64 * common::INCH).powi(2);
        let mass = parameters.weight() / parameters.gravity + spinning;
        let lag = mass * 0.3 / GAIN;
        // Creep takes some force in the curve.
        let within = if name == "straight" { 0.1 } else { 0.5 };
        for (time, loads) in &ran.loads {
            let by_time = 12.0 - 0.3 * (time - 1.0).clamp(0.0, 10.0);
            let found = loads.speed - by_time;
            assert!(found.abs() < 1.2 * lag, "{name}, {time} s: {found} of {lag} m/s");
            let slowed = loads.distance - parameters.start.distance - 12.0;
            let by_place = (144.0 - 0.6 * slowed.clamp(0.0, 105.0)).sqrt();
            let found = loads.speed - by_place;
            // Settled within a second after each corner.
            let expected = match *time {
                0.0..1.0 => 0.0,
                2.0..10.8 => lag,
                12.0.. => 0.0,
                _ => continue,
            };
            assert!(
                (found - expected).abs() < within * lag,
                "{name}, {time} s: {found} m/s, {expected} expected"
            );
        }
        assert!(ran.residual < 1e-4, "{name}: {}", ran.residual);
    }
}

#[test]
fn input_histories_that_are_none_are_named() {
    let said = |speeds: Vec<[f64; 2]>| {
        let mut parameters = empty(tangent(60.0), 10.0);
        parameters.drive = Drive::History { gain: GAIN, speeds };
        Car::new(&parameters).map(|_| ()).unwrap_err().to_string()
    };
    for (speeds, expected) in [
        (vec![], "the speeds over time are an empty list"),
        (
            vec![[0.0, 0.0]],
            "a speed over time (m/s) is 0; it must be positive",
        ),
        (
            vec![[-1.0, 5.0]],
            "a time of the speeds over time (s) is -1; it must be zero or positive",
        ),
        (
            vec![[1.0, 5.0], [1.0, 4.0]],
            "a time of the speeds over time (s) is 1; it must be more than the one before it",
        ),
        (vec![[0.0, f64::NAN]], "a speed over time (m/s) is NaN"),
    ] {
        let found = said(speeds);
        assert!(found.contains(expected), "{found}");
    }
}
