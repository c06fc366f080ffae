//! Cases, runs and metrics.

#![warn(missing_docs)]

pub mod case;
