//! Reasons why a description makes no vehicle.

use mechanics::connection::ConnectionError;
use mechanics::system::{ModelError, NoEquilibrium};
use thiserror::Error;

/// A description makes no vehicle.
#[derive(Debug, Error)]
pub enum VehicleError {
    /// Bodies and elements make no system.
    #[error(transparent)]
    Model(#[from] ModelError),
    /// A connection is not admissible.
    #[error(transparent)]
    Connection(#[from] ConnectionError),
    /// There is no rest to start from.
    #[error("cannot start from equilibrium: {0}; start.kind = \"nominal\" needs none")]
    Equilibrium(#[from] NoEquilibrium),
    /// The truck's or the wheels' numbers make no car.
    #[error(transparent)]
    Wheels(#[from] car::BuildError),
    /// The straight track on which it comes to rest cannot be made.
    #[error(transparent)]
    Track(#[from] wheelrail::track::TrackError),
    /// A vehicle on a track has a body that is held or moved.
    #[error(
        "{body} is not free in all six coordinates, but a body of a vehicle on a track runs along it: hold \
         it by stiff elements instead"
    )]
    Held {
        /// The body.
        body: String,
    },
    /// It cannot start there.
    #[error("the vehicle cannot start at {distance:.2} m along the track: {reason}")]
    Misplaced {
        /// The distance of its origin, m.
        distance: f64,
        /// The reason.
        reason: String,
    },
    /// Two channels have one name.
    #[error("two columns are named `{name}`: give bodies and elements names that do not run into each other")]
    SameColumn {
        /// The name.
        name: String,
    },
    /// An element cannot stand where it is.
    #[error("{element}: {reason}")]
    Element {
        /// Its name.
        element: String,
        /// The reason.
        reason: String,
    },
}
