//! Tests of `integrate`, one program: what is linked once is not linked thirty times.
#![allow(clippy::unwrap_used, missing_docs)]

mod analytic;
#[path = "../common/mod.rs"]
mod common;
mod convergence;
mod cross_code;
mod dense_output;
mod discontinuities;
mod esdirk;
mod event_groups;
mod input;
mod issue_029_behaviour;
mod limits_modules;
