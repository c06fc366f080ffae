//! Tests of `fmi`, one program: what is linked once is not linked thirty times.
#![allow(clippy::panic, clippy::unwrap_used, missing_docs)]

mod car;
mod issue_029_behaviour;
mod issue_047_inputs;
mod part;
mod tables;
mod three_piece;
mod vehicle;
mod vehicle_on_track;
mod wedge;
