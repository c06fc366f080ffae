//! Resonances and orders that the field knows. Nothing is tuned to them.

use std::f64::consts::PI;

use car::FrictionState;
use study::car::run::CarResult;
use study::run::Run;

use super::case;

const MPH: f64 = 0.447_04;
/// Rail length, m.
const RAIL: f64 = 39.0 * 0.3048;

fn run(regime: &str, lading: &str, speed: f64, overrides: &[&str]) -> CarResult {
    let case = case(regime, lading, &format!("{speed} mph"), overrides);
    let result = Run::new(&case).unwrap().finish(|_| ());
    let summary = &result.summary;
    assert!(summary.complete, "{regime} at {speed} mph: {:?}", summary.stopped);
    assert!(summary.derailed.is_none(), "{:?}", summary.derailed);
    result
}

/// A statistic, filtered if it is.
fn statistic(result: &CarResult, name: &str) -> f64 {
    let own = &result.summary.statistics[name];
    own.filtered.as_ref().or(own.raw.as_ref()).unwrap().value
}

fn roll(speed: f64, overrides: &[&str]) -> f64 {
    statistic(&run("twist_and_roll", "loaded", speed, overrides), "body_roll_peak_to_peak").to_degrees()
}
