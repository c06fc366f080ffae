//! What several tests need.

#![allow(clippy::unwrap_used)] // it may stop where it stands

use integrate::{FunctionProblem, Integrator, Options, Statistics};

/// Integrates from zero to `end`; the states there, and what it cost.
pub fn run(
    problem: FunctionProblem<'_>,
    options: Options,
    start: &[f64],
    end: f64,
) -> (Vec<f64>, Statistics) {
    let mut integrator = Integrator::new(problem, options, 0.0, start).unwrap();
    while integrator.time() < end {
        integrator.step_to(end).unwrap();
    }
    (integrator.x().to_vec(), integrator.statistics().clone())
}
