//! Reasons why a run cannot begin or go on, and checks of saved states, which find some of them.

use integrate::{MAXIMUM_COUNT, SetupError};
use mechanics::system::{ModelError, NoEquilibrium};
use quantity::SixDigits;
use thiserror::Error;
use wedge::BuildError;

/// Version of [`RunState`](crate::run::RunState).
pub const RUN_STATE_VERSION: u32 = 6;

/// Reasons why a run cannot begin or go on.
#[derive(Debug, Error)]
pub enum RunError {
    /// The parameters make no wedge.
    #[error(transparent)]
    Build(#[from] BuildError),
    /// Bodies and elements make no system.
    #[error(transparent)]
    Model(#[from] ModelError),
    /// The parameters make no truck.
    #[error(transparent)]
    Truck(#[from] truck::BuildError),
    /// The parameters make no car.
    #[error(transparent)]
    Car(#[from] car::BuildError),
    /// The description makes no vehicle.
    #[error(transparent)]
    Vehicle(Box<vehicle::VehicleError>),
    /// A wheel has left its rail: the run ends there, with its results.
    #[error("{what}")]
    Derailed {
        /// The wheel, the place and the criterion.
        what: String,
    },
    /// A force is so large that it would tear the model apart.
    #[error(
        "the force of `{element}` is {force:.3e} lbf at {} s, above the limit of {limit:.1e} lbf at which a \
         run is taken for a truck torn apart: lower the motion that presses its parts together, or give them \
         more clearance",
        SixDigits(*time)
    )]
    TornApart {
        /// The element.
        element: String,
        /// Its force, lbf.
        force: f64,
        /// The limit, lbf.
        limit: f64,
        /// The time, s.
        time: f64,
    },
    /// The wheelset does not stand on its rails.
    #[error(transparent)]
    Rig(#[from] rolling::rig::RigError),
    /// There is no equilibrium to start from.
    #[error("no static equilibrium was found to start from: {0}")]
    Equilibrium(#[from] NoEquilibrium),
    /// The integrator cannot be set up.
    #[error(transparent)]
    Setup(#[from] SetupError),
    /// The integrator cannot go on, or the run hardly progresses ([`crate::progress`]).
    #[error("{reason}; contacts: {contacts}")]
    Step {
        /// The reason, with the state whose error is largest.
        reason: String,
        /// Contact states at that time, in words.
        contacts: String,
    },
    /// A column of the result is not finite.
    #[error(transparent)]
    NotFinite(#[from] NotFinite),
    /// A saved state that this version cannot read.
    #[error(
        "the saved run state has version {found}; this program reads version {RUN_STATE_VERSION}. \
         Continue it with the program that saved it, or run the case from its start"
    )]
    Version {
        /// The version found.
        found: u32,
    },
    /// A saved state has a member that no run of this case can have.
    #[error(
        "the saved run state is damaged: `{member}` is {found}; it must be {expected}. Continue from the \
         state as it was saved, or run the case from its start"
    )]
    Damaged {
        /// The member.
        member: &'static str,
        /// The description.
        found: String,
        /// The condition on it.
        expected: String,
    },
}

/// A value of the result is not finite.
#[derive(Clone, Debug, PartialEq, Error)]
#[error(
    "`{column}` is {value} at {} s, which is not a finite number: look for values out of all proportion",
    SixDigits(*time)
)]
pub struct NotFinite {
    /// The column, without unit.
    pub column: String,
    /// Its value, SI.
    pub value: f64,
    /// The time, s.
    pub time: f64,
}

/// Returns the error about a member.
pub(crate) fn damaged<T>(
    member: &'static str,
    found: impl ToString,
    expected: impl ToString,
) -> Result<T, RunError> {
    Err(RunError::Damaged {
        member,
        found: found.to_string(),
        expected: expected.to_string(),
    })
}

pub(crate) fn check_length(member: &'static str, found: usize, expected: usize) -> Result<(), RunError> {
    if found == expected {
        return Ok(());
    }
    damaged(
        member,
        format!("a list of {found}"),
        format!("a list of {expected}"),
    )
}

pub(crate) fn check_size(member: &'static str, value: f64) -> Result<(), RunError> {
    if value >= 0.0 && value.is_finite() {
        return Ok(());
    }
    damaged(member, value, "zero or positive, and finite")
}

pub(crate) fn check_finite(member: &'static str, value: f64) -> Result<(), RunError> {
    if value.is_finite() {
        return Ok(());
    }
    damaged(member, value, "finite")
}

pub(crate) fn check_count(member: &'static str, count: u64) -> Result<(), RunError> {
    if count <= MAXIMUM_COUNT {
        return Ok(());
    }
    damaged(member, count, format!("at most {MAXIMUM_COUNT}"))
}

impl From<vehicle::VehicleError> for RunError {
    fn from(error: vehicle::VehicleError) -> Self {
        Self::Vehicle(Box::new(error))
    }
}
