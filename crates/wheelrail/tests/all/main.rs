//! Tests of `wheelrail`, one program: what is linked once is not linked thirty times.
#![allow(clippy::expect_used, clippy::unwrap_used, missing_docs)]

mod class;
mod climb;
#[path = "../common/mod.rs"]
mod common;
mod contact;
mod contact_benchmark;
mod contact_limits;
mod contact_table;
mod creep;
mod damage;
mod figures;
mod formats;
mod free_rolling;
mod friction;
mod hertz;
mod kinds;
mod linear_wheelset;
mod measured;
mod not_round;
mod profile;
mod profile_limits;
mod rails;
mod recordings;
mod shape;
mod spectrum;
mod spirals;
mod strips;
mod track;
mod validation_page;
mod varying_rail;
mod wheelset;
