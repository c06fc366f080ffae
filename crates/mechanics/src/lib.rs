//! Rigid bodies with freed coordinates, and the elements between them.
//!
//! Made for a truck, used for a wedge: bodies in absolute coordinates, each measured from a reference frame of its
//! own ([`body`], [`frame`]); elements that see one body from a mount on another ([`link`]) and answer with
//! a force and a moment ([`contact`], [`coil`]); a [`system::System`] that puts them together for the
//! integrator, with exact derivatives from the same lines, and an energy ledger. Bodies with linearized kinematics are joined by
//! [`connection`]s, the element laws of the industry's vehicle programs.

pub mod body;
pub mod characteristic;
pub mod coil;
pub mod connection;
pub mod contact;
pub mod curve;
pub mod element;
pub mod energy_balance;
pub mod frame;
pub mod friction;
pub mod link;
pub mod motion;
pub mod orientation;
pub mod output;
pub mod plausibility;
pub mod quasi_static;
pub mod spline;
pub mod surface;
pub mod system;
mod tangent;
pub mod vector;
mod without_roll;
