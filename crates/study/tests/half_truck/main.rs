//! The half-truck of the comparison program's files, sorted by what is proved.

mod analytic;
mod common;
mod convergence;
mod energy;
mod input;
mod limits;
mod reproducible;
mod reproduction;
mod wedge_bodies;
mod wedge_bodies_input;
