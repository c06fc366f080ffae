//! Rigid bodies with freed coordinates, and the elements between them.
//!
//! Made for a truck, used for a wedge: bodies in absolute coordinates, each measured from a reference frame of its
//! own ([`body`], [`frame`]); elements that see one body from a mount on another ([`link`]) and answer with
//! a force and a moment ([`contact`], [`coil`]); a [`system::System`] that puts them together for the
//! integrator, with exact derivatives from the same lines, and an energy ledger. [`small`] does the same for small
//! displacements, with the element laws of the industry's vehicle programs.

pub mod body;
pub mod characteristic;
pub mod coil;
pub mod contact;
pub mod energy_balance;
pub mod frame;
pub mod friction;
pub mod link;
pub mod motion;
pub mod output;
pub mod quasi_static;
pub mod small;
pub mod spline;
pub mod surface;
pub mod system;
pub mod turn;
pub mod vector;
mod without_roll;
