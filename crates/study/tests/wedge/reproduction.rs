//! The thesis's twelve runs: the two anchors, the orderings and envelopes that the thesis states of its
//! figures, lift-off.

use crate::runs::{INCH, LBF, LBF_IN, TWELVE, averages, column, twelve};
use study::result::RunResult;

/// Branch means and energies of independent simulations of the same equations, lbf and lbf·in.
#[test]
fn anchors() {
    for (name, expected) in [
        ("vdrun_toe_out_0.2_psi_0.012", [1432.0, -931.0, 1746.0]),
        ("cdrun_toe_out_0.2_psi_0.012", [1949.0, -1364.0, 6616.0]),
    ] {
        let found = averages(twelve(name));
        for (found, expected) in found.iter().zip(expected) {
            assert!(
                (found / expected - 1.0).abs() < 0.01,
                "{name}: {found:?}, expected {expected:?}"
            );
        }
    }
}

/// The averages of the summary, computed a second time from the table and the definitions.
#[test]
fn averages_are_those_of_the_definitions() {
    for (name, result) in TWELVE.iter() {
        let constant = name.starts_with("cd");
        let time = result.column("time").unwrap();
        let force = column(result, "vertical_wedge_force", LBF);
        let lost = column(result, "side_frame_friction_loss", LBF_IN);
        let (mut up, mut down) = (Vec::new(), Vec::new());
        for (t, force) in time.iter().zip(&force) {
            // z = sin 2t in, rate 2 cos 2t in/s.
            let (z, rate) = ((2.0 * t).sin(), (2.0 * t).cos());
            let counts = if constant {
                rate.abs() > 0.9
            } else {
                rate.abs() > 0.25 && z < -0.3
            };
            if *t > 0.5 * std::f64::consts::PI && counts {
                if rate > 0.0 {
                    up.push(*force)
                } else {
                    down.push(*force)
                }
            }
        }
        let mean = |v: &[f64]| v.iter().sum::<f64>() / v.len() as f64;
        let [found_up, found_down, energy] = averages(result);
        assert!((found_up / mean(&up) - 1.0).abs() < 1e-9, "{name}");
        assert!((found_down / mean(&down) - 1.0).abs() < 1e-9, "{name}");
        // Two whole cycles from π/2 to 5π/2, straight between rows: friction losses change by less than 60
        // lbf·in a row.
        let at = |t: f64| {
            let i = (t / 0.01) as usize;
            lost[i] + (lost[i + 1] - lost[i]) * (t / 0.01 - i as f64)
        };
        let pi = std::f64::consts::PI;
        let cycles = 0.5 * (at(2.5 * pi) - at(0.5 * pi));
        assert!((energy - cycles).abs() < 1.0, "{name}: {energy} {cycles}");
        assert_eq!(result.summary.averages.cycles, 2);
    }
}

#[test]
fn constant_damping_without_yaw_is_ordered_by_toe() {
    let [out, none, into] = [
        "cdrun_toe_out_0.2_psi_0",
        "cdrun_toe_0_psi_0",
        "cdrun_toe_in_0.2_psi_0",
    ]
    .map(|name| averages(twelve(name)));
    println!("out {out:?}, none {none:?}, in {into:?}");
    assert!(out[0] > none[0] && none[0] > into[0], "going up: out > none > in");
    assert!(
        out[1].abs() < none[1].abs() && none[1].abs() < into[1].abs(),
        "going down: in > none > out"
    );
}

#[test]
fn variable_damping_without_yaw_is_ordered_by_toe_going_down() {
    let [out, none, into] = [
        "vdrun_toe_out_0.2_psi_0",
        "vdrun_toe_0_psi_0",
        "vdrun_toe_in_0.2_psi_0",
    ]
    .map(|name| averages(twelve(name)));
    println!("out {out:?}, none {none:?}, in {into:?}");
    assert!(
        out[1].abs() < none[1].abs() && none[1].abs() < into[1].abs(),
        "going down: in > none > out"
    );
}

/// Least and greatest value after a time, s.
fn extremes(result: &RunResult, name: &str, unit: f64, after: f64) -> (f64, f64) {
    let time = result.column("time").unwrap();
    column(result, name, unit)
        .iter()
        .zip(time)
        .filter(|(_, time)| **time > after)
        .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), (v, _)| {
            (low.min(*v), high.max(*v))
        })
}

/// The axes of the thesis's figures; they cut the first half second.
#[test]
fn envelopes() {
    let within = |name: &str, column: &str, unit: f64, low: f64, high: f64| {
        let (least, most) = extremes(twelve(name), column, unit, 0.5);
        println!("{name} {column}: {least:.0} to {most:.0}");
        assert!(
            least >= low && most <= high,
            "{name} {column}: {least} to {most}, not within {low} to {high}"
        );
    };
    for name in ["cdrun_toe_out_0.2_psi_0", "cdrun_toe_out_0.2_psi_0.012"] {
        within(name, "vertical_wedge_force", LBF, -2100.0, 2600.0);
    }
    for name in TWELVE.keys() {
        within(name, "bolster_vertical", INCH, -1.1, 1.1);
        within(name, "side_frame_friction_power", LBF_IN, -6000.0, 0.0);
        if name.starts_with("cd") {
            within(name, "longitudinal_wedge_force", LBF, 0.0, 8000.0);
        } else if name.ends_with("0.012") {
            within(name, "longitudinal_wedge_force", LBF, 0.0, 6000.0);
        }
    }
}

/// Returns the number of the column's corners that are closed, by row.
fn closed(result: &RunResult, face: &str) -> Vec<usize> {
    let corners = ["lower_right", "lower_left", "upper_right", "upper_left"]
        .map(|corner| result.column(&format!("{face}_{corner}_state")).unwrap());
    (0..result.rows())
        .map(|row| corners.iter().filter(|c| c[row] > 0.0).count())
        .collect()
}

#[test]
fn variable_damping_lifts_off_after_three_seconds() {
    for toe in ["out_0.2", "0", "in_0.2"] {
        for yaw in ["0", "0.012"] {
            let name = format!("vdrun_toe_{toe}_psi_{yaw}");
            let result = twelve(&name);
            let time = result.column("time").unwrap();
            let slope = closed(result, "slope");
            // Loaded while the bolster goes down and up again.
            assert!((0..result.rows()).any(|i| (2.0..2.3).contains(&time[i]) && slope[i] > 0));
            let lift = (0..result.rows())
                .find(|&i| time[i] > 2.4 && slope[i] == 0)
                .unwrap();
            println!("{name}: lifts off at {} s", time[lift]);
            assert!(
                (3.0..3.3).contains(&time[lift]),
                "{name}: lift-off at {} s",
                time[lift]
            );
            // After that nothing is lost until the bolster comes back, and the force on the side frame rings
            // about zero.
            let air: Vec<usize> = (0..result.rows())
                .filter(|&i| (3.3..4.5).contains(&time[i]))
                .collect();
            let force = column(result, "vertical_force_on_side_frame", LBF);
            let lost = column(result, "side_frame_dissipation", LBF_IN);
            let loaded = (0..result.rows())
                .filter(|&i| (1.5..3.1).contains(&time[i]))
                .fold(0.0_f64, |m, i| m.min(lost[i]));
            for &i in &air {
                assert!(
                    lost[i] > 1e-2 * loaded,
                    "{name}: {} lbf in/s at {} s",
                    lost[i],
                    time[i]
                );
            }
            // It is the coil's spring alone: 24 Hz about the weight, small against the loaded wedge.
            let mean = air.iter().map(|&i| force[i]).sum::<f64>() / air.len() as f64;
            let crossings = air
                .windows(2)
                .filter(|w| time[w[1]] < 4.0 && (force[w[0]] + 50.0) * (force[w[1]] + 50.0) < 0.0)
                .count();
            let most = air.iter().fold(0.0_f64, |m, &i| m.max(force[i].abs()));
            let peak = force.iter().fold(0.0_f64, |m, f| m.max(f.abs()));
            println!("{name}: {crossings} crossings, mean {mean:.0}, largest {most:.0} of {peak:.0} lbf");
            assert!((mean + 50.0).abs() < 10.0, "{name}: {mean} lbf");
            assert!(most < 0.1 * peak, "{name}: {most} of {peak} lbf");
            // 0.7 s at 24.2 Hz: 34 crossings; a late row or a last touch may cost some.
            assert!((29..=35).contains(&crossings), "{name}: {crossings} crossings");
        }
    }
}

#[test]
fn constant_damping_never_lifts_off() {
    for (name, result) in TWELVE.iter().filter(|(name, _)| name.starts_with("cd")) {
        let time = result.column("time").unwrap();
        let (column, slope) = (closed(result, "column"), closed(result, "slope"));
        for i in 0..result.rows() {
            assert!(
                time[i] < 0.1 || (column[i] > 0 && slope[i] > 0),
                "{name} at {} s",
                time[i]
            );
        }
    }
}

#[test]
fn every_ledger_closes_and_every_run_is_complete() {
    println!("run                        up      down    energy  residual  steps  events");
    for (name, result) in TWELVE.iter() {
        let summary = &result.summary;
        let [up, down, energy] = averages(result);
        println!(
            "{name:25} {up:7.1} {down:8.1} {energy:8.1} {:9.1e} {:6} {:6}",
            summary.ledger.largest_relative_residual, summary.solver.statistics.steps, summary.events.total
        );
        assert!(summary.complete && summary.stopped.is_none());
        assert_eq!(summary.rows, 1001);
        let limit = if name.ends_with("0.012") { 1e-5 } else { 1e-4 };
        assert!(summary.ledger.largest_relative_residual < limit, "{name}");
    }
}

/// In the region of the massless wedge's closed form 2A (F_up + F_down) = 6655 lbf·in, and (f_up + f_down) K
/// A²/2 = 1656.
#[test]
fn energies_without_toe_and_yaw_are_in_the_region_of_the_closed_forms() {
    for (name, closed) in [("cdrun_toe_0_psi_0", 6655.0), ("vdrun_toe_0_psi_0", 1656.0)] {
        let energy = averages(twelve(name))[2];
        println!(
            "{name}: {energy:.0}, massless {closed}: {:+.1} %",
            100.0 * (energy / closed - 1.0)
        );
        assert!((energy / closed - 1.0).abs() < 0.25, "{name}: {energy}");
    }
}
