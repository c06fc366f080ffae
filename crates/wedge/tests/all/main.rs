//! Tests of `wedge`, one program: what is linked once is not linked thirty times.
#![allow(clippy::expect_used, clippy::unwrap_used, missing_docs)]

mod analytic;
#[path = "../common/mod.rs"]
mod common;
mod energy;
mod faces;
mod geometry;
mod grids;
mod issue_007_behaviour;
mod limits;
mod reproducible;
mod second_derivation;
mod two_wedges;
