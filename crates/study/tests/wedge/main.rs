//! Runs of a wedge: closed forms, convergence, energy, limits, the thesis's twelve runs, wear.
#![allow(missing_docs, clippy::unwrap_used, clippy::expect_used, clippy::panic)]

#[path = "../common/runs.rs"]
mod runs;

mod analytic;
mod analytic_directions;
mod analytic_extreme_loads;
mod analytic_lock_up_maps;
mod convergence;
mod energy;
mod energy_laws;
mod energy_splits;
mod engineering;
mod issue_002_behaviour;
mod issue_036_behaviour;
mod limits;
mod plausibility;
mod properties;
mod reproducible;
mod reproduction;
mod wear;
