//! Systems with small displacements and the industry's element laws: closed forms, derivatives, energy,
//! limits.
#![allow(missing_docs, clippy::unwrap_used, clippy::expect_used)]

#[path = "../common/mod.rs"]
mod common;
#[path = "../common/half_truck.rs"]
mod half_truck;
mod models;

mod analytic;
mod convergence;
mod energy;
mod input;
mod issue_004_behaviour;
mod jacobian;
mod limits;
mod loops;
mod markers;
mod prescribed;
mod vibration;
mod wedges;
