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
