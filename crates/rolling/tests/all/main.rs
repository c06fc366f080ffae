//! Tests of `rolling`, one program: what is linked once is not linked thirty times.
#![allow(clippy::expect_used, clippy::unwrap_used, missing_docs)]

mod beam;
mod bogie;
mod circle;
mod climb;
#[path = "../common/mod.rs"]
mod common;
mod curving;
mod energy;
mod hunting;
mod impact;
mod manchester;
mod not_round;
mod rolled_rail;
mod stability;
