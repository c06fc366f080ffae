//! Probabilities of closed forms.

mod coverage;
mod distributions;
mod plans;
mod what_matters;

use std::convert::Infallible;

use study::probability::{Answer, Estimate, Estimator, Goal, estimate};

/// Estimates with a function of the point, which always has a value.
pub fn of(
    estimator: &Estimator,
    (dimensions, goal): (usize, Goal),
    value: impl Fn(&[f64]) -> Answer,
) -> Estimate {
    let mut evaluate = |points: &[Vec<f64>]| -> Result<Vec<Answer>, Infallible> {
        Ok(points.iter().map(|point| value(point)).collect())
    };
    estimate(estimator, (dimensions, goal, 0.95), &mut evaluate).unwrap_or_else(|never| match never {})
}
