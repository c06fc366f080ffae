//! Hunting of a wheelset on profiles with flanges: where it begins, and what becomes of it.

use crate::common;
use common::nonlinear::{amplitude, by_steps, critical};

/// Where runs from 0.1 mm neither grow nor die is the eigenvalue's critical speed within 1 %.
#[test]
fn cross_code_critical_speed_by_time_steps_on_profiles() {
    let [speed, turning] = critical();
    let stepped = by_steps([speed, turning]);
    assert!((stepped / speed - 1.0).abs() < 0.01, "{stepped} and {speed} m/s");
}

/// Below it even a start near the flange dies away; above it a small one grows until the flanges stop it, at
/// a clearance of 0.406 in less what the throats take.
#[test]
fn limits_hunting_ends_and_grows_up_to_the_flanges() {
    let [speed, _] = critical();
    let quiet = amplitude(0.9 * speed, 9e-3, 8.0);
    assert!(quiet < 1e-3, "{quiet} m");
    let hunting = amplitude(1.1 * speed, 0.5e-3, 8.0);
    assert!((8.5e-3..10.5e-3).contains(&hunting), "{hunting} m");
}
