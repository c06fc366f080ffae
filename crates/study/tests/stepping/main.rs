//! Wedges whose neighbours a caller moves.
#![allow(missing_docs, clippy::unwrap_used, clippy::expect_used)]

mod analytic;
mod common;
mod cross_code;
mod input;
mod limits;
mod reproducible;
