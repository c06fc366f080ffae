//! Errors in the parameters of a car.

use mechanics::system::{ModelError, NoEquilibrium};
use thiserror::Error;

use crate::shaken::{CLASS, MILES_PER_HOUR, SECONDS};
use crate::tipping::Tipping;

/// A value that makes no car.
#[derive(Clone, Debug, PartialEq, Error)]
#[error("{message}")]
pub struct InvalidParameter {
    message: String,
    remedy: Option<String>,
}

impl InvalidParameter {
    pub(crate) fn new(what: &str, value: f64, must: &str) -> Self {
        Self {
            message: format!("{what} is {value}; it must be {must}"),
            remedy: None,
        }
    }

    pub(crate) fn missing(message: &str) -> Self {
        Self {
            message: message.to_owned(),
            remedy: None,
        }
    }

    /// Returns the same with a remedy.
    pub(crate) fn with(self, remedy: Option<String>) -> Self {
        Self { remedy, ..self }
    }

    /// Returns the remedy, if there is one besides what the message says.
    #[must_use]
    pub fn remedy(&self) -> Option<&str> {
        self.remedy.as_deref()
    }
}

/// Reasons why parameters make no car.
#[derive(Debug, Error)]
pub enum BuildError {
    /// A value makes none.
    #[error(transparent)]
    Parameter(#[from] InvalidParameter),
    /// Bodies and elements make no system.
    #[error(transparent)]
    Model(#[from] ModelError),
    /// The contact tables cannot be made.
    #[error("the contact tables cannot be made: {0}")]
    Tables(#[from] wheelrail::profile::ProfileError),
    /// The straight track on which the car finds its equilibrium cannot be made.
    #[error(transparent)]
    Track(#[from] wheelrail::track::TrackError),
    /// The wheels do not stand on both rails.
    #[error("{reason}; {}", .reason.remedy())]
    Reach {
        /// The reason.
        reason: wheelrail::profile::ProfileError,
    },
    /// The car tips.
    #[error("cannot start from equilibrium: {0}")]
    Tips(Tipping),
    /// The car does not come through the shaking before its start.
    #[error(
        "cannot start shaken: in the run of {SECONDS} s at {MILES_PER_HOUR} mph on tangent track of FRA \
         class {CLASS}, at {time:.3} s, {reason}; start in equilibrium or in the nominal layout, which need \
         no such run, or look for what is out of proportion"
    )]
    Shaking {
        /// Time of its end, s.
        time: f64,
        /// What ends it.
        reason: String,
    },
    /// The track on which the car is shaken cannot be made.
    #[error("cannot start shaken: {0}")]
    ShakingTrack(String),
    /// The shaken car does not come to rest.
    #[error(
        "cannot start shaken: after its run the car does not come to rest: {0}; start in equilibrium or in \
         the nominal layout"
    )]
    ShakenRest(NoEquilibrium),
    /// There is no equilibrium to start from.
    #[error(
        "cannot start from equilibrium: {0}; look at lading off the center, coils that do not carry it, a \
         car that tips; a start in the nominal layout needs none"
    )]
    Equilibrium(#[from] NoEquilibrium),
}
