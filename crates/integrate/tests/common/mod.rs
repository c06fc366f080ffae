//! Shared by several tests.

#![allow(clippy::unwrap_used)] // it may stop where it stands
#![allow(dead_code)] // no test needs all of it

pub mod problems;

use integrate::{FunctionProblem, Integrator, Method, Options, Statistics};

/// Integrates from zero to `end`; returns the states there and the counters.
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

/// Returns the largest error in units of the scales.
pub fn scaled_error(x: &[f64], reference: &[f64], scales: &[f64]) -> f64 {
    let errors = x.iter().zip(reference).zip(scales);
    errors.fold(0.0, |most: f64, ((x, exact), scale)| {
        most.max((x - exact).abs() / scale)
    })
}

/// Returns a tolerance at which a method is about as exact as the others; the one of order 2 needs many more
/// steps.
pub fn tolerance(method: Method, of_others: f64) -> f64 {
    match method {
        Method::TrBdf2 => 1e-3 * of_others,
        _ => of_others,
    }
}
