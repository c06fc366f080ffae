//! Tests of `car`, one program: what is linked once is not linked thirty times.
#![allow(clippy::expect_used, clippy::unwrap_used, missing_docs)]

mod beams;
mod carriers;
#[path = "../common/mod.rs"]
mod common;
mod couplers;
mod curving;
mod drive;
mod energy;
mod mirror;
mod shaken;
mod stability;
mod starts;
mod statics;
mod torsion;
