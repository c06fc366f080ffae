//! Three-piece trucks with wedge bodies, sorted by what is proved.

mod common;
mod input;
mod kinds;
mod massless;
#[path = "../common/problems.rs"]
mod problems;
mod reproducible;
mod rigs;
mod thesis_wedge;
