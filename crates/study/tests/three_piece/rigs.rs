//! The rigs: energy ledgers, symmetry, and what is known of each.
#![allow(missing_docs, clippy::unwrap_used, clippy::expect_used)]

mod common;

use common::{KIP_INCH, POUND_FORCE, at, run};
use integrate::Method;
use truck::{RIGS, Rig};

/// The energy ledger of every rig over its first seconds closes below 1e-5, and a rig that is symmetric has
/// the same loads on both sides and at both ends.
#[test]
fn energy_of_every_rig_is_accounted_for() {
    for rig in RIGS {
        let duration = if rig.name.contains("warp") { 4.0 } else { 2.0 };
        let ran = run(&rig.parameters(), duration, Method::Rodas5P, 1e-6);
        assert!(ran.residual < 1e-5, "{}: residual {}", rig.name, ran.residual);
    }
}

/// A vertical motion is symmetric: left and right, leading and trailing wedges carry the same.
#[test]
fn limits_a_symmetric_rig_has_symmetric_loads() {
    let parameters = Rig::named("truck_vertical_variable").unwrap().parameters();
    let ran = run(&parameters, 4.0, Method::Rodas5P, 1e-6);
    let largest = ran
        .loads
        .iter()
        .map(|l| l.nest_vertical[0].abs())
        .fold(0.0, f64::max);
    for loads in &ran.loads {
        let [first, others @ ..] = &loads.wedges;
        for other in others {
            assert!((other.column_normal - first.column_normal).abs() < 1e-6 * largest);
            assert!((other.slope_normal - first.slope_normal).abs() < 1e-6 * largest);
        }
        assert!((loads.nest_vertical[0] - loads.nest_vertical[1]).abs() < 1e-6 * largest);
        assert!(loads.warp_angle.abs() < 1e-9);
    }
}

/// Constant damping without toe: the slope sticks, the wedges go with the bolster, and the columns keep the
/// normal force that the start locked in: about 3,400 lbf with 25 lbf·s/in a corner.
#[test]
fn reproduction_the_start_locks_in_the_normal_force_with_constant_damping() {
    let parameters = Rig::named("truck_vertical_constant").unwrap().parameters();
    let ran = run(&parameters, 4.0, Method::Rodas5P, 1e-6);
    for time in [1.0, 2.0, 3.0, 4.0] {
        let normal = at(&ran, time).wedges[0].column_normal / POUND_FORCE;
        assert!((3200.0..3600.0).contains(&normal), "{time} s: {normal} lbf");
    }
}

/// A wedge whose roll is free rolls by ψ cot θ when its side frame yaws by ψ, and stays flush on both faces.
/// Without friction warp meets almost no moment but that of the coils' shear, 0.5006e6 lbf·in/rad a nest.
#[test]
fn analytic_wedges_roll_by_the_yaw_times_the_cotangent_of_the_angle() {
    let rig = Rig::named("truck_warp_nest_constant_rising").unwrap();
    let parameters = rig.parameters().with_wedge_friction(0.0);
    let ran = run(&parameters, 4.5, Method::Rodas5P, 1e-6);
    let loads = at(&ran, 4.5);
    assert!((loads.warp_angle - 0.020).abs() < 1e-9, "{}", loads.warp_angle);
    let cotangent = 1.0 / 37.5_f64.to_radians().tan();
    // In truck axes wedges at the leading end lean one way, those at the trailing end the other.
    for (wedge, end) in loads.wedges.iter().zip([1.0, 1.0, -1.0, -1.0]) {
        let expected = [-end * 0.020 * cotangent, 0.0, 0.020];
        for (found, expected) in wedge.angles.iter().zip(expected) {
            assert!((found - expected).abs() < 5e-5, "{:?}", wedge.angles);
        }
    }
    let shear = loads.warp_moment.load_coils / 0.020 / (1e3 * KIP_INCH);
    assert!((shear / 1.0012 - 1.0).abs() < 2e-3, "{shear}e6 lbf·in/rad");
}

/// At low friction the warp moment has a plateau, about 225 kip·in; at 0.4 the nest locks: moment and normal
/// force go on growing, to 20 to 30 kip. (Both from a calculation in another program.)
#[test]
fn reproduction_warp_has_a_plateau_at_low_friction_and_locks_at_high() {
    let rig = Rig::named("truck_warp_nest_constant_rising").unwrap();
    // Warp moment (kip·in) and largest normal force on a column (lbf) at 10 and at 20 mrad, the first time and
    // on the way to the other side.
    let run_with = |friction: f64| {
        let parameters = rig.parameters().with_wedge_friction(friction);
        let ran = run(&parameters, 9.5, Method::Rodas5P, 1e-5);
        [3.24, 4.5, 8.24, 9.5].map(|time| {
            let loads = at(&ran, time);
            let normal = loads
                .wedges
                .iter()
                .map(|wedge| wedge.column_normal)
                .fold(0.0, f64::max);
            [loads.warp_moment.total() / KIP_INCH, normal / POUND_FORCE]
        })
    };
    let (low, high) = (run_with(0.25), run_with(0.4));
    for [moment, _] in [low[1], low[3]] {
        assert!(
            (moment.abs() / 225.0 - 1.0).abs() < 0.05,
            "plateau at {moment} kip·in"
        );
    }
    let growth = |[before, after]: [f64; 2]| after / before - 1.0;
    assert!(growth([low[0][0], low[1][0]]) < 0.15, "no plateau: {low:?}");
    assert!(growth([high[0][0], high[1][0]]) > 0.5, "no lock-up: {high:?}");
    for [_, normal] in [high[2], high[3]] {
        assert!((20_000.0..30_000.0).contains(&normal), "{high:?}");
    }
}
