//! Tests of `truck`, one program: what is linked once is not linked thirty times.
#![allow(clippy::expect_used, clippy::unwrap_used, missing_docs)]

mod analytic;
mod car;
mod center_plate;
#[path = "../common/mod.rs"]
mod common;
mod faces;
mod geometry;
mod massless;
mod momentum;
mod nest;
mod side_bearing;
mod spatial_wedge;
mod split_wedge;
