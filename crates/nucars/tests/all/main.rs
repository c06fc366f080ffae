//! Tests of `nucars`, one program: what is linked once is not linked thirty times.
#![allow(clippy::expect_used, clippy::panic, clippy::unwrap_used, missing_docs)]

#[path = "../common/mod.rs"]
mod common;
mod input_checks;
mod input_files;
mod input_mistakes;
mod input_mutations;
mod input_set;
mod issue_029_behaviour;
mod limits;
