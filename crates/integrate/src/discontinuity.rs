//! Discontinuities of the right-hand side and of its derivatives: the functions from which
//! they are predicted, and the predictions.

use serde::{Deserialize, Serialize};

use crate::error::SetupError;
use crate::validation::{check_finite, check_positive};

/// Functions of time and state from which discontinuities are predicted, see
/// [`crate::Problem::discontinuities`].
#[derive(Clone, Debug, Default)]
pub struct DiscontinuityFunctions {
    /// Smooth functions across whose zeros a derivative of the right-hand side jumps (the gap of a contact).
    pub values: Vec<f64>,
    /// Slips: dimensionless plane vectors around whose zero, in a circle of radius 1 (the *regularization
    /// zone*), the right-hand side changes almost like a jump. The slip velocity of a contact point over the
    /// reference speed of its regularized friction law is one. Not a number where there is no friction.
    pub slips: Vec<[f64; 2]>,
}

impl DiscontinuityFunctions {
    /// Returns zeros, so many values and slips.
    pub(crate) fn zeros(values: usize, slips: usize) -> Self {
        Self {
            values: vec![0.0; values],
            slips: vec![[0.0; 2]; slips],
        }
    }
}

/// The predicted end of the next step: shortly after a discontinuity, or before a regularization zone in
/// which a slip is predicted to reverse or to come to stick.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub(crate) struct Prediction {
    pub time: f64,
    /// Length of the first step in the zone; none: it is a discontinuity.
    pub zone_step: Option<f64>,
}

impl Prediction {
    /// Checks a saved prediction.
    pub fn check(&self) -> Result<(), SetupError> {
        check_finite("prediction.time", self.time)?;
        self.zone_step
            .map_or(Ok(()), |step| check_positive("prediction.zone_step", step))
    }
}

/// Returns the square of the length of a plane vector.
pub(crate) fn square([a, b]: &[f64; 2]) -> f64 {
    a * a + b * b
}
