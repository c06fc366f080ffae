//! Saving and continuing an integration.

use serde::{Deserialize, Serialize};

use crate::control::Controller;
use crate::error::SetupError;
use crate::kinks::{Ahead, Passage};
use crate::rosenbrock::{Behind, Place};
use crate::statistics::Statistics;

/// Version of [`State`].
pub const STATE_VERSION: u32 = 13;
/// The largest number in a counter of a saved state. A million steps a second count for thirty years up to it; from it on no run
/// counts to the end of 64 bits.
pub const MOST_COUNTED: u64 = 1_000_000_000_000_000;

/// All that is needed to continue an integration with the same bits.
///
/// The problem and the options are not part of it. Text formats must write floating-point numbers such that they
/// read back exactly.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct State {
    /// Version of the layout, [`STATE_VERSION`].
    pub version: u32,
    /// Time.
    pub time: f64,
    /// States.
    pub x: Vec<f64>,
    /// Modes of the switches.
    pub modes: Vec<u8>,
    /// Start of the smooth piece of the problem in which the last step was made.
    pub segment_start: f64,
    /// Length that the next step is going to try.
    pub proposed_step: f64,
    /// What is foreseen for the next step.
    pub(crate) ahead: Option<Ahead>,
    /// The thin layer on the way through.
    pub(crate) passage: Option<Passage>,
    /// Memory of the step-size control.
    pub(crate) controller: Controller,
    /// How long the last explicit step was that its error bounded, in units of the fastest answer; zero: there was none.
    pub(crate) reach: f64,
    /// The slope with which an implicit step ended, which is the first stage of the next one; empty: the derivative at the states is.
    pub(crate) slope: Vec<f64>,
    /// The last step, from which Newton's method guesses how the next one begins; none: it guesses straight on.
    pub(crate) behind: Option<Behind>,
    /// Where the matrix that Newton's method keeps was formed; none: there is none.
    pub(crate) matrix: Option<Place>,
    /// What was done so far.
    pub statistics: Statistics,
}

impl State {
    /// Whether a state can be one of a problem with so many states, switches and directions: all that could lead astray is looked at
    /// here, once, and nowhere on the way.
    pub(crate) fn check(
        &self,
        dimension: usize,
        switches: usize,
        directions: usize,
    ) -> Result<(), SetupError> {
        if self.version != STATE_VERSION {
            return Err(SetupError::Version { found: self.version });
        }
        self.statistics.check()?;
        self.controller.check()?;
        self.ahead.map_or(Ok(()), |ahead| ahead.check(directions))?;
        self.passage.map_or(Ok(()), |passage| passage.check(directions))?;
        let slopes = if self.slope.is_empty() { 0 } else { dimension };
        let place = self.matrix.as_ref().map_or(dimension, |place| place.x.len());
        let behind = self.behind.as_ref();
        let behind = behind.map_or([dimension; 2], |behind| [behind.x.len(), behind.first.len()]);
        let lengths = [
            ("states of the matrix", dimension, place),
            ("states of the last step", dimension, behind[0]),
            ("slopes of the last step", dimension, behind[1]),
            ("states", dimension, self.x.len()),
            ("switches", switches, self.modes.len()),
            ("slopes", slopes, self.slope.len()),
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
        let damaged = |name, value| Err(SetupError::Damaged { name, value });
        if !self.segment_start.is_finite() || self.segment_start > self.time {
            return damaged("segment_start", self.segment_start);
        }
        if let Some(slope) = self.slope.iter().find(|slope| !slope.is_finite()) {
            return damaged("slope", *slope);
        }
        let place = self.matrix.as_ref();
        if let Some(value) = place.and_then(|place| place.damage(self.segment_start)) {
            return damaged("matrix", value);
        }
        if let Some(value) = self.behind.as_ref().and_then(Behind::damage) {
            return damaged("behind", value);
        }
        check_size("reach", self.reach)?;
        check_length("proposed_step", self.proposed_step)
    }
}

/// Whether a member of a saved state is a length: positive and finite.
pub(crate) fn check_length(name: &'static str, value: f64) -> Result<(), SetupError> {
    if value > 0.0 && value.is_finite() {
        return Ok(());
    }
    Err(SetupError::Damaged { name, value })
}

/// Whether a member of a saved state is a size: not negative, and finite.
pub(crate) fn check_size(name: &'static str, value: f64) -> Result<(), SetupError> {
    if value >= 0.0 && value.is_finite() {
        return Ok(());
    }
    Err(SetupError::Damaged { name, value })
}

/// Whether a counter of a saved state is one that a run can reach.
pub(crate) fn check_count(name: &'static str, found: u64) -> Result<(), SetupError> {
    if found <= MOST_COUNTED {
        return Ok(());
    }
    Err(SetupError::Counter { name, found })
}
