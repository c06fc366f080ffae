//! What the other solvers get is right: the Jacobian matrix against differences of the rates, errors and fronts by hand.
#![allow(missing_docs, clippy::unwrap_used, clippy::expect_used)]

use race::equations::Equations;
use race::measure::Quantities;
use race::outcome::Outcome;
use race::problem::{Problem, names};
use race::runner::Entry;
use race::standings::{Judgement, Standing};

/// Each column against a central difference with Richardson's extrapolation, at a state on the way, where contacts are closed.
#[test]
fn the_jacobian_is_the_derivative_of_the_rates() {
    for name in names() {
        let mut equations = Equations::named(&name).unwrap();
        let n = equations.dimension();
        // A little way in, so that nothing is at rest or just touching.
        let (_, states) =
            race::own::run(&name, integrate::Method::Rodas4, false, 1e-7, 10.0, 40).expect("our own run");
        let mut z = states[states.len() - n..].to_vec();
        // A wedge that hangs free may hang at a face without touching it: a thousand differences away from there.
        for (value, scale) in z.iter_mut().zip(equations.scales()) {
            *value += 1e-6 * scale;
        }
        let time = 0.39;
        let mut matrix = vec![0.0; n * n];
        equations.jacobian(time, &z, &mut matrix).unwrap();
        let scales = equations.scales().to_vec();
        let (mut plus, mut minus) = (vec![0.0; n], vec![0.0; n]);
        for column in 0..n {
            let mut difference = |h: f64| -> Vec<f64> {
                let mut moved = z.clone();
                moved[column] = z[column] + h;
                equations.rates(time, &moved, &mut plus);
                moved[column] = z[column] - h;
                equations.rates(time, &moved, &mut minus);
                plus.iter()
                    .zip(&minus)
                    .map(|(a, b)| (a - b) / (2.0 * h))
                    .collect()
            };
            let h = 1e-9 * scales[column];
            let (one, two) = (difference(h), difference(2.0 * h));
            for row in 0..n {
                let expected = (4.0 * one[row] - two[row]) / 3.0;
                let found = matrix[column * n + row];
                // In units of the error scales; contacts make entries of 1e7.
                let size = scales[column] / scales[row];
                let largest = (0..n)
                    .map(|column| matrix[column * n + row].abs() * scales[column] / scales[row])
                    .fold(1.0, f64::max);
                assert!(
                    (found - expected).abs() * size <= 1e-5 * largest,
                    "{name} [{row}, {column}]: {found} instead of {expected}"
                );
            }
        }
    }
}

#[test]
fn no_problem_has_a_break() {
    for name in names() {
        let mut problem = Problem::named(&name).unwrap();
        let end = integrate::Problem::segment(&mut problem.system, 0.0);
        assert!(end.is_infinite(), "{name}: {end}");
    }
}

#[test]
fn errors_by_hand() {
    let series = |values: &[f64]| Quantities::Series(vec![values.to_vec()]);
    let reference = series(&[3.0, 4.0, 12.0]);
    assert_eq!(series(&[3.0, 4.0]).error(&reference), 0.0);
    // √(1 + 1) / √(9 + 16)
    let error = series(&[4.0, 3.0]).error(&reference);
    assert!((error - 2.0_f64.sqrt() / 5.0).abs() < 1e-15);
    assert!(series(&[f64::NAN, 3.0]).error(&reference).is_infinite());
    assert!(series(&[]).error(&reference).is_infinite());
    assert_eq!(series(&[0.0]).error(&series(&[0.0, 1.0])), 0.0);
    assert!(series(&[1.0]).error(&series(&[0.0, 1.0])).is_infinite());
    let means = Quantities::Means([100.0, -200.0, 50.0]);
    assert_eq!(means.error(&means), 0.0);
    assert_eq!(Quantities::Means([90.0, -200.0, 50.0]).error(&means), 0.05);
    assert_eq!(Quantities::Means([100.0, -200.0, 60.0]).error(&means), 0.2);
    assert!(means.error(&reference).is_infinite());
}

fn standing(runs: &[(&str, f64, f64, &str)]) -> Standing {
    let runs = runs.iter().map(|(solver, error, cpu, failure)| Judgement {
        entry: Entry {
            case: "case".to_owned(),
            solver: (*solver).to_owned(),
            tolerance: "1e-3".to_owned(),
            rows: 1001,
            outcome: Outcome {
                cpu: *cpu,
                failure: (*failure).to_owned(),
                ..Outcome::default()
            },
        },
        error: Some(*error),
    });
    Standing {
        case: "case".to_owned(),
        span: 10.0,
        judged: String::new(),
        floor: 2e-4,
        runs: runs.collect(),
    }
}

#[test]
fn fronts_and_ratios_by_hand() {
    let one = standing(&[
        ("a", 2e-2, 1.0, ""),
        ("a", 2e-3, 3.0, ""),
        // On no front: dearer than what is more exact.
        ("a", 5e-3, 9.0, ""),
        // Below the floor counts as the floor.
        ("b", 1e-9, 12.0, ""),
        ("b", 1e-3, 4.0, "fails"),
    ]);
    assert_eq!(one.cheapest(&["a"], 1e-2).unwrap().entry.outcome.cpu, 3.0);
    assert_eq!(one.cheapest(&["a"], 3e-2).unwrap().entry.outcome.cpu, 1.0);
    assert!(one.cheapest(&["a"], 1e-3).is_none());
    assert!(one.cheapest(&["b"], 1e-12).is_some());
    assert!(one.levels().iter().all(|level| *level > one.floor));
    let ratios = one.ratios(&["b"], &["a"]);
    assert_eq!(ratios, [(3e-2, 12.0), (1e-2, 4.0), (3e-3, 4.0)]);
}
