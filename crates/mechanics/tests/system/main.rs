//! A system of bodies and force elements: equations of motion, derivatives, energy, limits, findings.
#![allow(missing_docs, clippy::unwrap_used, clippy::expect_used, clippy::panic)]

#[path = "../common/mod.rs"]
mod common;
#[path = "../common/margins.rs"]
mod margins;

mod carrier;
mod closed_loops;
mod created_energy;
mod eigenvalues;
mod elements;
mod energy;
mod equations_of_motion;
mod input;
mod internal_states;
mod limits;
mod mixed_kinematics;
mod parts;
mod plausibility;
mod sliding_friction;
mod surfaces;
mod suspension_elements;
