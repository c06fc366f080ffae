//! Saved states: all that an integration needs to continue.

use serde::{Deserialize, Serialize};

use crate::controller::Controller;
use crate::discontinuity::{Prediction, ZoneCrossing};
use crate::error::SetupError;
use crate::limits::STATE_VERSION;
use crate::newton::{LinearizationPoint, StepHistory};
use crate::statistics::Statistics;
use crate::validation::{check_not_negative, check_positive, first_not_finite};

/// All that is needed to continue an integration with the same bits.
///
/// The problem and the options are not part of it. Text formats must write floating-point numbers such that
/// they read back exactly. The names of the members in such formats are those of version 13 and differ from
/// the names of some fields here.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct State {
    /// Version of the layout, [`STATE_VERSION`].
    pub version: u32,
    /// Time.
    pub time: f64,
    /// States.
    pub x: Vec<f64>,
    /// Discrete states.
    #[serde(rename = "modes")]
    pub discrete_states: Vec<u8>,
    /// Start of the smooth interval of the explicit time dependence in which the last step was made.
    #[serde(rename = "segment_start")]
    pub interval_start: f64,
    /// Length of the next attempt.
    pub proposed_step: f64,
    /// Discontinuity predicted for the next step.
    #[serde(rename = "ahead")]
    pub(crate) prediction: Option<Prediction>,
    /// Regularization zone that is being crossed.
    #[serde(rename = "passage")]
    pub(crate) zone_crossing: Option<ZoneCrossing>,
    /// Memory of the step-size controller.
    pub(crate) controller: Controller,
    /// h·ρ of the last explicit step that was limited by its error; zero: there was none.
    #[serde(rename = "reach")]
    pub(crate) explicit_h_rho: f64,
    /// Derivative in the last stage of an ESDIRK method, the first stage of the next step; empty for other
    /// methods.
    #[serde(rename = "slope")]
    pub(crate) last_stage_derivative: Vec<f64>,
    /// Last step, for the stage predictor; none: it extrapolates linearly.
    #[serde(rename = "behind")]
    pub(crate) step_history: Option<StepHistory>,
    /// Where the Jacobian matrix of Newton's method was evaluated; none: there is no matrix.
    #[serde(rename = "matrix")]
    pub(crate) linearization_point: Option<LinearizationPoint>,
    /// Counters.
    pub statistics: Statistics,
}

impl State {
    /// Checks the state for a problem with so many states, discrete states and slips. Nothing is checked
    /// later.
    pub(crate) fn check(
        &self,
        dimension: usize,
        discrete_states: usize,
        slips: usize,
    ) -> Result<(), SetupError> {
        if self.version != STATE_VERSION {
            return Err(SetupError::Version { found: self.version });
        }
        self.statistics.check()?;
        self.controller.check()?;
        self.prediction
            .map_or(Ok(()), |prediction| prediction.check(slips))?;
        self.zone_crossing
            .map_or(Ok(()), |crossing| crossing.check(slips))?;
        self.check_lengths(dimension, discrete_states)?;
        let damaged = |name, value| Err(SetupError::Damaged { name, value });
        if !self.interval_start.is_finite() || self.interval_start > self.time {
            return damaged("segment_start", self.interval_start);
        }
        if let Some(value) = first_not_finite(&self.last_stage_derivative) {
            return damaged("slope", value);
        }
        let point = self.linearization_point.as_ref();
        if let Some(value) = point.and_then(|point| point.damage(self.interval_start)) {
            return damaged("matrix", value);
        }
        if let Some(value) = self.step_history.as_ref().and_then(StepHistory::damage) {
            return damaged("behind", value);
        }
        check_not_negative("reach", self.explicit_h_rho)?;
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
        let [start, change] = self
            .step_history
            .as_ref()
            .map_or([dimension; 2], |history| [history.x.len(), history.first.len()]);
        let lengths = [
            ("states of the matrix", dimension, point),
            ("states of the last step", dimension, start),
            ("changes of the last step", dimension, change),
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
