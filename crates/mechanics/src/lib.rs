//! Rigid bodies with free coordinates, and the elements between them.
//!
//! Bodies have absolute coordinates, each measured from its own reference frame ([`body`], [`frame`]).
//! Elements compute a force and a moment from the relative motion of markers on two bodies ([`link`],
//! [`contact`], [`coil`]). A [`system::System`] assembles them for the integrator, with exact derivatives
//! from the same functions, and an energy ledger. [`connection`]s, the element laws of the industry's vehicle
//! programs, act on coordinates instead.

pub mod body;
pub mod characteristic;
pub mod coil;
pub mod connection;
pub mod contact;
pub mod curve;
pub mod depth_surface;
pub mod element;
pub mod elements;
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
