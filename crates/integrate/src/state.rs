//! Saved states: all that an integration needs to continue.

use serde::{Deserialize, Serialize};

use crate::controller::Controller;
use crate::discontinuity::Prediction;
use crate::error::SetupError;
use crate::limits::STATE_VERSION;
use crate::newton::LinearizationPoint;
use crate::statistics::Statistics;
use crate::validation::{check_positive, first_not_finite};

/// All that is needed to continue an integration with the same bits.
///
/// The problem and the options are not part of it. Text formats must write floating-point numbers such that
/// they read back exactly.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct State {
    /// Version of the layout, [`STATE_VERSION`].
    pub version: u32,
    /// Time.
    pub time: f64,
    /// States.
    pub x: Vec<f64>,
    /// Discrete states.
    pub discrete_states: Vec<u8>,
    /// Start of the smooth interval of the explicit time dependence in which the last step was made.
    pub interval_start: f64,
    /// Length of the next attempt.
    pub proposed_step: f64,
    /// Discontinuity predicted for the next step.
    pub(crate) prediction: Option<Prediction>,
    /// Memory of the step-size controller.
    pub(crate) controller: Controller,
    /// Derivative in the last stage of an ESDIRK method, the first stage of the next step; empty for other
    /// methods.
    pub(crate) last_stage_derivative: Vec<f64>,
    /// The linearization point of the Jacobian matrix of Newton's method; none: there is no matrix.
    pub(crate) linearization_point: Option<LinearizationPoint>,
    /// Counters.
    pub statistics: Statistics,
}

impl State {
    /// Checks the state for a problem with so many states and discrete states. Nothing is checked later.
    pub(crate) fn check(&self, dimension: usize, discrete_states: usize) -> Result<(), SetupError> {
        if self.version != STATE_VERSION {
            return Err(SetupError::Version { found: self.version });
        }
        self.statistics.check()?;
        self.controller.check()?;
        self.prediction.map_or(Ok(()), |prediction| prediction.check())?;
        self.check_lengths(dimension, discrete_states)?;
        let damaged = |name, value| Err(SetupError::Damaged { name, value });
        if !self.interval_start.is_finite() || self.interval_start > self.time {
            return damaged("interval_start", self.interval_start);
        }
        if let Some(value) = first_not_finite(&self.last_stage_derivative) {
            return damaged("last_stage_derivative", value);
        }
        let point = self.linearization_point.as_ref();
        if let Some(value) = point.and_then(|point| point.damage(self.interval_start)) {
            return damaged("linearization_point", value);
        }
        check_positive("proposed_step", self.proposed_step)
    }

    fn check_lengths(&self, dimension: usize, discrete_states: usize) -> Result<(), SetupError> {
        let derivatives = if self.last_stage_derivative.is_empty() {
            0
        } else {
            dimension
        };
        let point = self
            .linearization_point
            .as_ref()
            .map_or(dimension, |point| point.x.len());
        let lengths = [
            ("states of the matrix", dimension, point),
            ("states", dimension, self.x.len()),
            ("discrete states", discrete_states, self.discrete_states.len()),
            ("stage derivatives", derivatives, self.last_stage_derivative.len()),
        ];
        for (what, expected, found) in lengths {
            if expected != found {
                return Err(SetupError::Dimension {
                    what,
                    expected,
                    found,
                });
            }
        }
        Ok(())
    }
}
