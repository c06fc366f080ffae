//! Tests of `reproduction`, one program.
#![allow(clippy::expect_used, clippy::unwrap_used, missing_docs)]

mod claims;
mod comparison;
mod figures;
mod groups;
mod page;
mod sensitivity;
mod three_piece;
