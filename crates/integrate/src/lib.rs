//! Implicit one-step integration of stiff, kinked ordinary differential equations. Knows no physics.
//!
//! A [`Problem`] gives its right-hand side and brings its own structured linear algebra (for which [`BlockLu`] is at
//! hand); an [`Integrator`] makes accepted steps with a stiffly accurate [`Method`], controls their
//! error, gives dense output, and times the changes of discrete switches. Nothing is allocated in a step, and the
//! same input gives the same bits on every system.

#![warn(missing_docs)]

mod block_lu;
mod control;
mod dense_block;
mod error;
mod events;
mod kinks;
pub mod lanes;
mod layout;
mod methods;
mod options;
mod ordinary;
pub mod partitioned;
mod problem;
pub mod processor;
mod rosenbrock;
pub mod scalar;
mod search;
mod stages;
mod state;
mod statistics;

pub use block_lu::BlockLu;
pub use error::{Reason, SetupError, StepError};
pub use events::{Event, SwitchGroup};
pub use kinks::KinkSigns;
pub use methods::tableau::{Family, MAXIMUM_STAGES, Tableau};
pub use methods::{Method, UnknownMethod};
pub use options::Options;
pub use ordinary::Ordinary;
pub use problem::{Problem, Singular};
pub use rosenbrock::Integrator;
pub use state::{MOST_COUNTED, STATE_VERSION, State};
pub use statistics::Statistics;
