//! Three-piece trucks with wedge bodies, sorted by what is proved.

mod common;
mod faces_in_service;
mod input;
mod kinds;
mod massless;
#[path = "../common/problems.rs"]
mod problems;
mod reproducible;
mod rigs;
mod rise;
mod thesis_wedge;
mod wear;
