//! Results converge as the tolerance falls; they do not depend on when they are written.

use crate::runs::{averages, run_all};
use integrate::Method;
use study::case::{Case, builtin};

/// Returns a case with another tolerance, output interval and duration.
fn case(name: &str, tolerance: f64, interval: f64, duration: f64) -> Case {
    let mut case = builtin::case(name).unwrap();
    case.simulation.relative_tolerance = tolerance;
    case.simulation.output_interval = interval;
    case.simulation.duration = duration;
    case
}

/// Branch means and energies against those at 1e-9. Local errors are of the tolerance; these are global, of a
/// system with discontinuities, so no order is asked for: only that they fall from those at 1e-3, and are
/// small where users are.
#[test]
fn yawed_cases_converge() {
    // The largest errors of all cases: that of a single one may be small by chance at a wide tolerance.
    let (mut wide, mut narrow) = (0.0_f64, 0.0_f64);
    for name in [
        "vdrun_toe_out_0.2_psi_0.012",
        "cdrun_toe_out_0.2_psi_0.012",
        "cdrun_toe_0_psi_0.012",
    ] {
        let tolerances = [1e-3, 1e-5, 1e-6, 1e-7, 1e-8, 1e-9];
        let cases = tolerances.map(|tolerance| case(name, tolerance, 0.01, 10.0));
        let results: Vec<[f64; 3]> = run_all(&cases, 2).iter().map(averages).collect();
        let reference = results[results.len() - 1];
        let errors: Vec<f64> = results
            .iter()
            .map(|r| (0..3).fold(0.0_f64, |m, i| m.max((r[i] / reference[i] - 1.0).abs())))
            .collect();
        println!("{name}: {errors:.1?} {errors:?}");
        // At the default tolerance and below nothing changes but the fourth digit and later ones; what is
        // left there is the sensitivity of motion with discontinuities, not the error of the method.
        assert!(
            errors[2..5].iter().all(|error| *error < 2e-4),
            "{name}: {errors:?}"
        );
        wide = wide.max(errors[0]);
        narrow = narrow.max(errors[3]).max(errors[4]);
    }
    assert!(narrow < 0.2 * wide, "{narrow} at 1e-7 and 1e-8, {wide} at 1e-3");
}

/// Methods that damp vibrations follow the force all the same: rows are ends of their steps. Within steps a
/// single row at a reversal was off by as much as the friction, and made an error of 4e-2 here.
#[test]
fn force_histories_of_methods_that_damp_converge() {
    for name in ["cdrun_toe_out_0.2_psi_0.012", "cdrun_toe_in_0.2_psi_0.012"] {
        let reference = case(name, 1e-9, 0.01, 10.0);
        let mut cases = vec![reference];
        for method in [Method::TrBdf2, Method::Esdirk3] {
            for tolerance in [1e-5, 1e-6, 1e-7] {
                let mut case = case(name, tolerance, 0.01, 10.0);
                case.simulation.method = method;
                cases.push(case);
            }
        }
        let results = run_all(&cases, 2);
        let force = |number: usize| results[number].column("vertical_wedge_force").unwrap();
        let square = |values: &mut dyn Iterator<Item = f64>| values.map(|value| value * value).sum::<f64>();
        let size = square(&mut force(0).iter().copied());
        let errors: Vec<f64> = (1..results.len())
            .map(|number| {
                let pairs = force(number).iter().zip(force(0));
                (square(&mut pairs.map(|(a, b)| a - b)) / size).sqrt()
            })
            .collect();
        println!("{name}: {errors:?}");
        for errors in errors.chunks_exact(3) {
            assert!(errors[1] < 5e-3 && errors[2] < 1.2e-3, "{name}: {errors:?}");
            assert!(errors[2] < 0.3 * errors[0], "{name}: {errors:?}");
        }
    }
}

#[test]
fn the_output_interval_changes_nothing_but_the_rows() {
    for name in ["vdrun_toe_0_psi_0", "cdrun_toe_out_0.2_psi_0.012"] {
        let cases = [0.01, 0.0037, 2.0].map(|interval| case(name, 1e-6, interval, 5.0));
        let results = run_all(&cases, 2);
        let first = &results[0].summary;
        assert!(first.events.total > 20, "{name}: {} events", first.events.total);
        for result in &results[1..] {
            let other = &result.summary;
            assert_ne!(other.rows, first.rows);
            // The integration: same steps, same events at the same times, bit for bit.
            assert_eq!(other.solver.statistics, first.solver.statistics, "{name}");
            assert_eq!(other.events, first.events, "{name}");
            assert_eq!(
                other.averages.energy_per_cycle, first.averages.energy_per_cycle,
                "{name}"
            );
            assert_eq!(
                other.averages.equivalent_damping,
                first.averages.equivalent_damping
            );
            assert_eq!(other.ledger.entries, first.ledger.entries, "{name}");
            assert_eq!(other.friction, first.friction, "{name}");
            // The last row is the end in all of them.
            for (a, b) in result.values.iter().zip(&results[0].values) {
                assert_eq!(a.last().unwrap().to_bits(), b.last().unwrap().to_bits());
            }
        }
        // And events are at the times where the rows change: a state differs from the one before only if one
        // was listed.
        let (times, events) = (results[1].column("time").unwrap(), &results[1].summary.events);
        let state = results[1].column("column_upper_left_state").unwrap();
        if events.total as usize == events.listed.len() {
            for i in 1..times.len() {
                let between = |t: f64| t > times[i - 1] && t <= times[i];
                let changed = state[i] != state[i - 1];
                let listed = events
                    .listed
                    .iter()
                    .any(|e| e.face == "column" && e.corner == "upper_left" && between(e.time));
                assert!(
                    !changed || listed,
                    "{name}: unlisted change before {} s",
                    times[i]
                );
            }
        }
    }
}
