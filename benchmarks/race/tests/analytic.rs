//! The results of the other solvers are right: the Jacobian matrix against differences of the rates, errors
//! and fronts by hand.
#![allow(missing_docs, clippy::unwrap_used, clippy::expect_used)]

use race::equations::Equations;
use race::measure::Quantities;
use race::outcome::Outcome;
use race::problem::{RaceProblem, START_STEP, names, start_of, with_start};
use race::runner::RaceEntry;
use race::standings::{Judgement, Standing, over_starts};

/// Each column against a central difference with Richardson's extrapolation, at a state on the way, where
/// contacts are closed.
#[test]
fn the_jacobian_is_the_derivative_of_the_rates() {
    for name in names() {
        let mut equations = Equations::named(&name).unwrap();
        let n = equations.dimension();
        // A little way in, so that nothing is at rest or just touching.
        let (_, states) =
            race::own::run(&name, integrate::Method::Rodas5P, false, 1e-7, 10.0, 40).expect("our own run");
        let mut z = states[states.len() - n..].to_vec();
        // A wedge that hangs free may hang at a face without touching it: a thousand differences away from
        // there.
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
        let mut problem = RaceProblem::named(&name).unwrap();
        let end = integrate::Problem::next_time_discontinuity(&mut problem.system, 0.0);
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
        entry: RaceEntry {
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
        starts: 1,
        runs: runs.collect(),
    }
}

/// Two starts: the root mean square of errors and floors, the mean of times; what fails from one start has
/// failed.
#[test]
fn starts_are_taken_together_by_hand() {
    let own = standing(&[
        ("a", 3e-3, 1.0, ""),
        ("b", 1e-3, 2.0, ""),
        ("c", 1e-3, 2.0, "fails"),
    ]);
    let mut other = standing(&[("a", 4e-3, 2.0, ""), ("b", 1e-3, 2.0, "fails")]);
    other.floor = 1e-4;
    let alone = over_starts(vec![own.clone()]).unwrap();
    assert_eq!(
        (alone.starts, alone.floor, alone.runs[0].error),
        (1, own.floor, own.runs[0].error)
    );
    let both = over_starts(vec![own, other]).unwrap();
    assert_eq!(both.starts, 2);
    // √((2² + 1²)/2) × 1e-4, and twice the scatter of 1/√4 of itself on top.
    assert!((both.floor - 2.0 * 1e-4 * 2.5_f64.sqrt()).abs() < 1e-18);
    assert!((both.runs[0].error.unwrap() - 1e-3 * 12.5_f64.sqrt()).abs() < 1e-17);
    assert_eq!(both.runs[0].entry.outcome.cpu, 1.5);
    assert_eq!(both.runs[1].entry.outcome.failure, "fails (started case)");
    assert_eq!(both.runs[2].entry.outcome.failure, "fails");
    assert!(!both.runs[1].finished() && !both.runs[2].finished());
    // A solver that runs from one start only is not compared with what others do on average.
    let alone = standing(&[("a", 3e-3, 1.0, "")]);
    let both = over_starts(vec![alone, standing(&[])]).unwrap();
    assert_eq!(both.runs[0].entry.outcome.failure, "run from 1 of 2 starts only");
}

/// Another start is the same case with the wedge lower, and nothing else.
#[test]
fn another_start_is_lower() {
    for case in ["vdrun_toe_0_psi_0", "planar_variable"] {
        let (own, other) = (
            RaceProblem::named(case).unwrap(),
            RaceProblem::named(&with_start(case, 3)).unwrap(),
        );
        let differs: Vec<usize> = (0..own.start.len())
            .filter(|k| own.start[*k] != other.start[*k])
            .collect();
        assert_eq!(differs.len(), 1, "{case}");
        let heights = |problem: &RaceProblem| -> Vec<f64> {
            let observation = problem.system.clone().observe(0.0, &problem.start);
            observation.bodies.iter().map(|body| body.origin.0[2]).collect()
        };
        // Side frame and bolster stay where they are.
        let lower: Vec<f64> = heights(&own)
            .iter()
            .zip(heights(&other))
            .map(|(own, other)| own - other)
            .collect();
        assert_eq!(lower[..2], [0.0, 0.0], "{case}");
        assert!((lower[2] - 3.0 * START_STEP).abs() < 1e-12, "{case}: {lower:?}");
        assert_eq!((own.judged, own.rows()), (other.judged, other.rows()));
    }
    assert_eq!(start_of(&with_start("a case", 12)), ("a case", 12));
    assert_eq!(start_of(&with_start("a case", 0)), ("a case", 0));
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
