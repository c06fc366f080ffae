//! Reasons why a driven wedge cannot begin, go on or go back, and the checks of what is given to it.

use integrate::SetupError;
use mechanics::system::{ContactState, InputError};
use quantity::Number;
use thiserror::Error;
use wedge::BuildError;
use wedge::inputs::{CoilInput, Neighbours};

/// Reasons why a driven wedge cannot begin, go on or go back.
#[derive(Debug, Error)]
pub enum SteppingError {
    /// The parameters make no wedge.
    #[error(transparent)]
    Build(#[from] BuildError),
    /// The integrator refuses the state.
    #[error(transparent)]
    Setup(#[from] SetupError),
    /// The integrator cannot go on.
    #[error("{0}; go back to a saved state, or begin anew with smaller steps of the neighbours")]
    Step(String),
    /// The system cannot be driven.
    #[error(transparent)]
    Input(#[from] InputError),
    /// A step that is no step.
    #[error(
        "a step of {} s from time {} s is none: it must be positive, finite, and not lost against the time",
        Number(*step),
        Number(*time)
    )]
    NoStep {
        /// The step, s.
        step: f64,
        /// The time from which it was to be made, s.
        time: f64,
    },
    /// A value that is not finite, or outside its range.
    #[error("{what} is {value}; it must be {expected}")]
    Value {
        /// The name of the value.
        what: String,
        /// The value, SI.
        value: f64,
        /// The condition on it.
        expected: &'static str,
    },
    /// A communication step hardly progresses ([`crate::progress`]).
    #[error(
        "the step of {step} s from time {time} s cannot be finished: {why}; make it shorter, or look for \
         places or rates of the neighbours that are far out"
    )]
    TooLong {
        /// The step, s.
        step: f64,
        /// The time at which it began, s.
        time: f64,
        /// The progress and its place.
        why: String,
    },
    /// Neighbours move far in one step.
    #[error(
        "in one step the bolster moves by {} m in {coordinate} against the side frame; at most {} m are \
         taken for a motion of a truck: give places in m or with their unit, or go there in several steps",
        Number(*path),
        super::LARGEST_PATH
    )]
    TooFar {
        /// The coordinate.
        coordinate: &'static str,
        /// The path, m.
        path: f64,
    },
    /// An earlier step failed.
    #[error("an earlier step failed; go back to a saved state, or begin anew")]
    Failed,
    /// A saved state that cannot be read.
    #[error("this is no saved state of a driven wedge: {0}")]
    State(String),
    /// A saved state of another version.
    #[error("the saved state has version {found}; this program reads version {expected}")]
    Version {
        /// The version found.
        found: u32,
        /// The version expected.
        expected: u32,
    },
    /// A saved state of a wedge with other parameters.
    #[error("the saved state belongs to a wedge with other parameters")]
    OtherCase,
}

fn finite(what: &str, value: f64) -> Result<(), SteppingError> {
    if value.is_finite() {
        return Ok(());
    }
    Err(SteppingError::Value {
        what: what.to_owned(),
        value,
        expected: "finite",
    })
}

/// Checks whether all coordinates and rates are finite.
pub(super) fn check_neighbours(neighbours: &Neighbours) -> Result<(), SteppingError> {
    for (name, place) in [
        ("side frame", &neighbours.side_frame),
        ("bolster", &neighbours.bolster),
    ] {
        for (what, values) in [("", &place.position), ("rate of ", &place.rate)] {
            for (coordinate, value) in mechanics::body::COORDINATES.into_iter().zip(values) {
                if !value.is_finite() {
                    finite(&format!("the {what}{coordinate} of the {name}"), *value)?;
                }
            }
        }
    }
    Ok(())
}

/// Checks whether a coil's value is usable.
pub(super) fn check_coil(coil: &CoilInput) -> Result<(), SteppingError> {
    match coil {
        CoilInput::Stiffness(value) if !coil.is_valid() => Err(SteppingError::Value {
            what: "the coil's stiffness".to_owned(),
            value: *value,
            expected: "zero or positive, and finite",
        }),
        CoilInput::Force(value) => finite("the coil's force", *value),
        _ => Ok(()),
    }
}

/// Checks whether numbers are those of contact states.
pub(super) fn check_contact_states(contact_states: &[u8]) -> Result<(), SteppingError> {
    let none = contact_states
        .iter()
        .enumerate()
        .find(|(_, contact_state)| **contact_state > ContactState::Slip as u8);
    none.map_or(Ok(()), |(corner, contact_state)| {
        Err(SteppingError::Value {
            what: format!("the contact state of corner {corner} (counted from 0)"),
            value: f64::from(*contact_state),
            expected: "0 (open), 1 (stick) or 2 (slip)",
        })
    })
}

/// Checks whether coefficients of friction of column and slope are usable.
pub(super) fn check_friction(friction: [f64; 2]) -> Result<(), SteppingError> {
    for (name, value) in ["friction.column", "friction.slope"].into_iter().zip(friction) {
        if !(value >= 0.0 && value.is_finite()) {
            return Err(SteppingError::Value {
                what: name.to_owned(),
                value,
                expected: "zero or positive, and finite",
            });
        }
    }
    Ok(())
}
