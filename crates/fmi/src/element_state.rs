//! Saved states of elements: plain data.

use integrate::State;
use serde::{Deserialize, Serialize};
use study::stepping::{CoilInput, Neighbours, SteppedState};

/// The saved state of an element.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub enum ElementState {
    /// A wedge.
    Wedge(Box<WedgeState>),
    /// A quasi-static wedge.
    QuasiStatic(QuasiStaticState),
    /// A system with named ports.
    System(Box<SystemState>),
}

/// The time of a saved element.
pub(crate) struct ElementTime {
    /// Its own, s.
    pub own: f64,
    /// The time of the experiment at which it is zero, s.
    zero: f64,
}

impl ElementTime {
    /// Returns the phase in which it must be at a time of the experiment.
    pub fn of(&self, time: f64) -> f64 {
        time - self.zero
    }
}

impl ElementState {
    /// Returns its time, in an experiment with this start.
    pub(crate) fn time(&self, start: f64) -> ElementTime {
        let (own, zero) = match self {
            Self::Wedge(state) => match &**state {
                // It counts from the start; the others have the time of the experiment.
                WedgeState::Driven(state) => (state.integrator.time, start),
                WedgeState::Equations { time, .. } => (*time, 0.0),
            },
            Self::QuasiStatic(state) => (state.time, 0.0),
            Self::System(state) => (state.time, 0.0),
        };
        ElementTime { own, zero }
    }
}

/// The saved state of a wedge.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[expect(
    clippy::large_enum_variant,
    reason = "it lies in a box as a whole, see ElementState"
)]
pub enum WedgeState {
    /// One that integrates itself.
    Driven(SteppedState),
    /// One that an importer integrates.
    Equations {
        /// Time, s.
        time: f64,
        /// The states.
        states: Vec<f64>,
        /// The contact states.
        modes: Vec<u8>,
        /// The poses of the neighbours.
        neighbours: Neighbours,
        /// Their poses at the start.
        start: Neighbours,
        /// The coil now.
        coil: CoilInput,
        /// The coil at the start.
        start_coil: CoilInput,
        /// Coefficients of friction.
        friction: [f64; 2],
    },
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
