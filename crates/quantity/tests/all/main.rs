//! Tests of `quantity`, one program: what is linked once is not linked thirty times.
#![allow(clippy::expect_used, clippy::unwrap_used, missing_docs)]

mod issue_029_behaviour;
mod units;
