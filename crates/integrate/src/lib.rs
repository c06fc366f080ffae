//! Implicit one-step integration of stiff, kinked ordinary differential equations. Knows no physics.

#![warn(missing_docs)]

pub mod lanes;
pub mod partitioned;
pub mod processor;
pub mod scalar;

mod block_lu;
mod controller;
mod dense_block;
mod dense_output;
mod discontinuity;
mod discontinuity_prediction;
mod error;
mod event;
mod event_detection;
mod function_problem;
mod integrator;
mod layout;
mod limits;
mod methods;
mod newton;
mod options;
mod problem;
mod root_search;
mod state;
mod statistics;
mod tuning;
mod validation;
mod vector;

pub use block_lu::BlockLu;
pub use discontinuity::DiscontinuityFunctions;
pub use error::{Reason, SetupError, Singular, StepError};
pub use event::{Event, EventGroup};
pub use function_problem::FunctionProblem;
pub use integrator::Integrator;
pub use limits::{MAXIMUM_COUNT, STATE_VERSION};
pub use methods::tableau::{Family, MAXIMUM_STAGES, Tableau};
pub use methods::{Method, UnknownMethod};
pub use options::Options;
pub use problem::Problem;
pub use state::State;
pub use statistics::Statistics;
