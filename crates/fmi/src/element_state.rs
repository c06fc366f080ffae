//! Saved states of elements: plain data.

use integrate::State;
use serde::{Deserialize, Serialize};

/// The saved state of an element.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub enum ElementState {
    /// A quasi-static wedge.
    QuasiStatic(QuasiStaticState),
    /// A system with named ports.
    System(Box<SystemState>),
}

impl ElementState {
    /// Returns its time, s.
    pub(crate) fn time(&self) -> f64 {
        match self {
            Self::QuasiStatic(state) => state.time,
            Self::System(state) => state.time,
        }
    }
}

/// The saved state of a quasi-static wedge.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct QuasiStaticState {
    pub(crate) time: f64,
    pub(crate) states: Vec<f64>,
    pub(crate) inputs: Vec<f64>,
    pub(crate) friction: [f64; 2],
}

/// The saved state of a system.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct SystemState {
    pub(crate) time: f64,
    pub(crate) states: Vec<f64>,
    pub(crate) inputs: Vec<f64>,
    pub(crate) contact_states: Vec<u8>,
    pub(crate) start_energy: f64,
    pub(crate) piece_start: f64,
    pub(crate) integrator: Option<State>,
}
