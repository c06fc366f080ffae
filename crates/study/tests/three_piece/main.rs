//! Three-piece trucks with wedge bodies, sorted by what is proved.

mod common;
mod input;
mod kinds;
mod massless;
mod reproducible;
mod rigs;
mod thesis_wedge;
