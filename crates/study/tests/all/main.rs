//! Tests of `study`, one program: what is linked once is not linked thirty times.
#![allow(clippy::expect_used, clippy::unwrap_used, missing_docs)]

mod fit;
mod issue_029_states_behaviour;
mod parts;
mod probability;
mod sections;
mod signal;
mod tables;
mod vehicle;
mod vehicle_rules;
mod wheelset;
#[path = "../common/wheelsets.rs"]
mod wheelsets;
