//! Saved states of driven wedges.

use input::bounded;
use integrate::{Options, State};
use serde::{Deserialize, Serialize};
use wedge::Parameters;
use wedge::inputs::{CoilInput, Neighbours};
use wedge::parameters::NeighbourMotion;

use super::SteppingError;
use super::error::{check_coil, check_contact_states, check_friction, check_neighbours};

/// Version of [`SteppedState`].
pub const STEPPED_STATE_VERSION: u32 = 2;
/// More bytes than these are no saved state, and are not read: states take some kilobytes.
pub const MOST_STATE_BYTES: usize = input::limits::RECORD_FILE as usize;

/// All that is needed to continue a driven wedge with the same bits, also in another process and on another
/// machine.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct SteppedState {
    /// [`STEPPED_STATE_VERSION`].
    pub version: u32,
    /// Tells wedges of other parameters or tolerances apart.
    pub(super) fingerprint: u64,
    /// The poses of the neighbours at time zero.
    pub(super) start: Neighbours,
    /// The poses of the neighbours.
    pub neighbours: Neighbours,
    /// The source of the coil's force.
    pub coil: CoilInput,
    /// Coefficients of friction of column and slope.
    pub friction: [f64; 2],
    /// True if a step has failed.
    pub(super) failed: bool,
    /// Time, states, contact states and the memory of the step-size control.
    pub integrator: State,
}

impl SteppedState {
    /// Returns the state as bytes: JSON, whose numbers read back to the last bit.
    ///
    /// # Errors
    /// Never, with a state that a wedge has given.
    pub fn to_bytes(&self) -> Result<Vec<u8>, SteppingError> {
        serde_json::to_vec(self).map_err(|error| SteppingError::State(error.to_string()))
    }

    /// Reads what [`SteppedState::to_bytes`] wrote.
    ///
    /// # Errors
    /// These are no bytes of such a state, or of another version, or more than [`MOST_STATE_BYTES`].
    pub fn from_bytes(bytes: &[u8]) -> Result<Self, SteppingError> {
        /// All that is looked at first.
        #[derive(Deserialize)]
        struct Head {
            version: u32,
        }
        if bytes.len() > MOST_STATE_BYTES {
            return Err(SteppingError::State(format!(
                "it has {} bytes, more than the {MOST_STATE_BYTES} that are read",
                bytes.len()
            )));
        }
        let damaged = |error: serde_json::Error| SteppingError::State(bounded(error.to_string()));
        let head: Head = serde_json::from_slice(bytes).map_err(damaged)?;
        if head.version != STEPPED_STATE_VERSION {
            return Err(SteppingError::Version {
                found: head.version,
                expected: STEPPED_STATE_VERSION,
            });
        }
        serde_json::from_slice(bytes).map_err(damaged)
    }

    /// Checks whether places, coil, friction, time and contact states can be those of a wedge; what else the
    /// integrator has is looked at by the integrator.
    pub(super) fn check(&self) -> Result<(), SteppingError> {
        check_neighbours(&self.neighbours)?;
        check_coil(&self.coil)?;
        check_friction(self.friction)?;
        check_contact_states(&self.integrator.discrete_states)?;
        if self.integrator.time < 0.0 {
            return Err(SteppingError::Value {
                what: "the time of the saved state".to_owned(),
                value: self.integrator.time,
                expected: "zero or positive: driven wedges begin at time zero",
            });
        }
        Ok(())
    }
}

/// Returns a number for parameters and options; motions and coefficients of friction do not count, since a
/// caller gives them.
pub(super) fn fingerprint(parameters: &Parameters, options: &Options) -> u64 {
    let mut still = parameters.clone();
    for neighbour in [&mut still.side_frame, &mut still.bolster] {
        neighbour.coordinates = NeighbourMotion::fixed().coordinates;
    }
    // Friction may be tuned on the way; it is part of the state.
    for face in [&mut still.column_friction, &mut still.slope_friction] {
        face.coefficient = 0.0;
    }
    let text = serde_json::to_vec(&(still, options)).unwrap_or_default();
    // FNV-1a, 64 bits: it tells apart, it does not protect.
    text.iter().fold(0xcbf2_9ce4_8422_2325, |hash, byte| {
        (hash ^ u64::from(*byte)).wrapping_mul(0x0000_0100_0000_01b3)
    })
}
