//! Saved states of elements: plain data.

use integrate::State;
use serde::{Deserialize, Serialize};

use crate::Error;
use crate::error::{check_finite, check_lengths};

/// The saved state of an element.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ElementState {
    /// Time, s.
    pub(crate) time: f64,
    pub(crate) states: Vec<f64>,
    pub(crate) inputs: Vec<f64>,
    /// What systems with named ports need besides.
    pub(crate) system: Option<SystemState>,
}

/// What a system with named ports needs to go on.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct SystemState {
    pub(crate) contact_states: Vec<u8>,
    pub(crate) start_energy: f64,
    pub(crate) piece_start: f64,
    pub(crate) integrator: Option<State>,
}

impl ElementState {
    /// Checks whether it can be that of an element with so many states and inputs.
    pub(crate) fn check(&self, states: usize, inputs: usize) -> Result<(), Error> {
        check_lengths([
            ("the element's states", self.states.len(), states),
            ("the element's inputs", self.inputs.len(), inputs),
        ])?;
        check_finite("the element's states", &self.states)?;
        check_finite("the element's inputs", &self.inputs)?;
        check_finite("the element's time", [&self.time])
    }
}
