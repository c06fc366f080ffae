//! Freight cars on track: cases, statistics, messages.
#![allow(clippy::unwrap_used)]

mod assumptions;
mod case;
mod couplers;
mod damage;
mod derailment;
mod friction;
mod geometry;
mod input;
#[path = "../case_keys/layout.rs"]
mod layout;
mod locus;
mod mode_shape;
mod not_round;
mod onset;
#[path = "../common/problems.rs"]
mod problems;
mod rails;
mod route;
mod run;
mod shared_rails;
mod stability;
mod start;
mod statics;
mod statistics;
mod wheels;
