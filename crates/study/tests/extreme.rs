//! Extreme cases: each ends, or stops with its reason in time, and each that is nonsense says so.
//!
//! Implausible results are recognized here from columns of the result alone, not by the observer of the run.
//!
//! ```sh
//! cargo test --release -p study --test extreme -- --ignored --nocapture
//! ```
#![allow(missing_docs, clippy::unwrap_used, clippy::panic)]

#[path = "common/runs.rs"]
mod runs;

use std::ops::ControlFlow;
use std::sync::Mutex;
use std::sync::atomic::{AtomicU64, Ordering};
use std::time::{Duration, Instant};

use mechanics::plausibility::LARGEST_FRICTION;
use runs::{INCH, column};
use study::case::{Case, builtin};
use study::design::LatinHypercube;
use study::plausibility;
use study::progress::most_attempts;
use study::result::RunResult;
use study::run::{Run, RunCase};

/// After this wall time the test itself ends a run, and fails.
const ABORTED: Duration = Duration::from_secs(600);
const BY_THE_TEST: &str = "aborted by the test";

/// Height of the wedge, in.
const HEIGHT: f64 = 6.125;
/// Angle at which a wedge has turned over for any purpose, rad.
const TURNED: f64 = 0.5;
/// Penetration that no steel face survives, in.
const DEEP: f64 = 0.11;

/// The outcome of an extreme case.
struct Outcome {
    number: u64,
    settings: Vec<String>,
    result: RunResult,
    /// The most attempted steps that the rule of progress admits.
    most: u64,
    took: Duration,
}

/// Returns the settings of case `number` of a Latin hypercube.
fn settings(cube: &LatinHypercube, number: u64) -> Vec<String> {
    let at = |dimension: usize| cube.coordinate(number, dimension);
    let linear = |dimension: usize, low: f64, high: f64| low + (high - low) * at(dimension);
    let logarithmic = |dimension: usize, low: f64, high: f64| low * (high / low).powf(at(dimension));
    let frequency = logarithmic(3, 0.01, 50.0);
    // A few cycles, at most 2 s.
    let duration = (4.0 / frequency).min(2.0);
    let toe = linear(5, -3.0, 3.0);
    let toe = format!("{} deg {}", toe.abs(), if toe < 0.0 { "in" } else { "out" });
    let law = if at(7) < 0.5 { "tanh" } else { "bristle" };
    let friction = linear(1, 0.0, 2.0);
    vec![
        format!("contact.stiffness=\"{} lbf/in\"", logarithmic(0, 1e3, 1e9)),
        format!("friction.column={friction}"),
        format!("friction.slope={friction}"),
        format!("wedge.weight=\"{} lbf\"", logarithmic(2, 0.1, 5000.0)),
        format!("bolster.vertical.frequency=\"{frequency} Hz\""),
        format!("wedge.angle=\"{} deg\"", linear(4, 5.0, 80.0)),
        format!("side_frame.toe=\"{toe}\""),
        format!("simulation.relative_tolerance={:e}", logarithmic(6, 1e-10, 1e-3)),
        format!("friction.law=\"{law}\""),
        format!("simulation.duration=\"{duration} s\""),
        format!("simulation.output_interval=\"{} s\"", duration / 200.0),
    ]
}

fn compute(cube: &LatinHypercube, number: u64) -> Outcome {
    let settings = settings(cube, number);
    let damping = if number.is_multiple_of(2) {
        "vdrun"
    } else {
        "cdrun"
    };
    let case = builtin::case_with(&format!("{damping}_toe_0_psi_0"), &settings);
    let case: Case = case.unwrap_or_else(|error| panic!("{settings:?}: {:?}", error.problems()));
    let start = Instant::now();
    // Ten output intervals are a twentieth of the run, and not above a tenth of a second.
    let [duration, _] = case.duration_and_interval();
    let most = 20 * (most_attempts(duration / 20.0) + 1);
    let result = Run::new(&case).unwrap().finish_while(|_| {
        if start.elapsed() > ABORTED {
            return ControlFlow::Break(BY_THE_TEST.to_owned());
        }
        ControlFlow::Continue(())
    });
    Outcome {
        number,
        settings,
        result,
        most,
        took: start.elapsed(),
    }
}

/// Computes some cases of a hypercube on two threads.
fn compute_all(cube: &LatinHypercube, count: u64) -> Vec<Outcome> {
    let (next, outcomes) = (AtomicU64::new(0), Mutex::new(Vec::new()));
    std::thread::scope(|scope| {
        for _ in 0..2 {
            scope.spawn(|| {
                loop {
                    let number = next.fetch_add(1, Ordering::Relaxed);
                    if number >= count {
                        break;
                    }
                    let outcome = compute(cube, number);
                    outcomes.lock().unwrap().push(outcome);
                }
            });
        }
    });
    let mut outcomes = outcomes.into_inner().unwrap();
    outcomes.sort_by_key(|outcome| outcome.number);
    outcomes
}

/// Returns the reason why a result is nonsense, by its columns alone.
fn nonsense(result: &RunResult) -> Option<String> {
    let largest = |name: &str, unit: f64| {
        let values = column(result, name, unit);
        values.iter().fold(0.0, |most: f64, value| most.max(value.abs()))
    };
    for name in ["wedge_x", "wedge_z"] {
        let most = largest(name, INCH);
        if most > HEIGHT {
            return Some(format!("{name} reaches {most:.3} in"));
        }
    }
    for name in ["wedge_pitch", "wedge_yaw"] {
        let most = largest(name, 1.0);
        if most > TURNED {
            return Some(format!("{name} reaches {most:.3} rad"));
        }
    }
    for found in result
        .columns
        .iter()
        .filter(|column| column.name.ends_with("_gap"))
    {
        // The overlap of the start is released at once.
        let gaps = column(result, &found.name, INCH);
        let deepest = gaps.iter().skip(1).fold(0.0, |most: f64, gap| most.max(-gap));
        if deepest > DEEP {
            return Some(format!("{} reaches -{deepest:.3} in", found.name));
        }
    }
    let coefficient = result.summary.friction["column"].coefficient;
    (coefficient > LARGEST_FRICTION).then(|| format!("friction {coefficient}"))
}

/// Holds outcomes against what is promised, and prints what they came to.
fn judge(outcomes: &[Outcome]) {
    let (mut wrong, mut silent, mut stopped, mut bad) = (Vec::new(), 0, 0, 0);
    for outcome in outcomes {
        let (summary, took) = (&outcome.result.summary, outcome.took);
        let warned = plausibility::among(&summary.warnings).count() > 0;
        let why = nonsense(&outcome.result);
        bad += usize::from(why.is_some());
        silent += usize::from(!warned);
        stopped += usize::from(summary.stopped.is_some());
        let what = format!("{}: {:?}", outcome.number, outcome.settings);
        let reason = summary.stopped.as_ref().map_or("", |stopped| &stopped.reason);
        let statistics = &summary.solver.statistics;
        let attempts = statistics.steps + statistics.rejected();
        if attempts > outcome.most || reason == BY_THE_TEST {
            wrong.push(format!(
                "{attempts} attempts of {} ({reason}): {what}",
                outcome.most
            ));
        }
        if !summary.complete && reason.is_empty() {
            wrong.push(format!("ended without a reason: {what}"));
        }
        // A step is never planned with no length at all.
        if reason.contains("a step of 0.0") {
            wrong.push(format!("{reason}: {what}"));
        }
        if let Some(why) = why.filter(|_| !warned) {
            wrong.push(format!("{why}, without a word: {what}"));
        }
        if let Some(stopped) = &summary.stopped {
            println!(
                "{}: stopped after {took:?} at {} s: {}",
                outcome.number, stopped.time, stopped.reason
            );
        }
    }
    let mut slowest: Vec<&Outcome> = outcomes.iter().collect();
    slowest.sort_by_key(|outcome| std::cmp::Reverse(outcome.took));
    for outcome in slowest.iter().take(8) {
        let statistics = &outcome.result.summary.solver.statistics;
        let attempts = statistics.steps + statistics.rejected();
        println!(
            "{}: {attempts} attempts in {:?}: {:?}",
            outcome.number, outcome.took, outcome.settings
        );
    }
    let longest = outcomes
        .iter()
        .map(|outcome| outcome.took)
        .max()
        .unwrap_or_default();
    println!(
        "{} cases: {bad} nonsense, {silent} without a finding, {stopped} stopped, {} failed; the longest \
         took {longest:?}",
        outcomes.len(),
        outcomes
            .iter()
            .filter(|outcome| outcome.result.summary.failed.is_some())
            .count()
    );
    assert!(
        bad > outcomes.len() / 4,
        "the cases are not extreme: {bad} nonsense"
    );
    assert!(silent > 0, "a finding in every case says nothing");
    assert!(wrong.is_empty(), "{} wrong\n{}", wrong.len(), wrong.join("\n"));
}

#[test]
fn limits_extreme_cases_end_or_stop_in_time_and_nonsense_is_called_so() {
    judge(&compute_all(&LatinHypercube::new(40, 1), 40));
}

#[test]
#[ignore = "takes minutes"]
fn limits_five_hundred_extreme_cases() {
    judge(&compute_all(&LatinHypercube::new(500, 30), 500));
}
