//! Rigid bodies with free coordinates, and the elements between them.
//!
//! Bodies have absolute coordinates, each measured from its own reference frame ([`body`], [`frame`]).
//! Elements compute a force and a moment from the relative motion of markers on two bodies ([`link`],
//! [`contact`], [`coil`]). A [`system::System`] assembles them for the integrator, with exact derivatives
//! from the same functions, and an energy ledger. [`connection`]s, the element laws of the industry's vehicle
//! programs, act on coordinates instead.
//!
//! ```
//! use mechanics::body::Body;
//! use mechanics::coil::{Coil, CoilLaw};
//! use mechanics::frame::Frame;
//! use mechanics::link::Marker;
//! use mechanics::system::{Model, System};
//! use mechanics::vector::Vector;
//!
//! let ground = Body::prescribed("ground", Frame::fixed([0.0; 3], [0.0; 3]));
//! let mass = Body { mass: 2.0, free: [false, false, true, false, false, false], ..ground.clone() }; // kg
//! let spring = Coil {
//!     end: Vector([0.0; 3]),
//!     acts_at: Vector([0.0; 3]),
//!     law: CoilLaw::Linear { stiffness: 100.0 }, // N/m
//!     free_length: 1.0,
//!     damping: 0.0,
//!     rotational_damping: 0.0,
//!     pulls: true,
//! };
//! let below = Marker::new([0.0, 0.0, -1.0], [0.0; 3]);
//! let model = Model {
//!     bodies: vec![ground, mass],
//!     gravity: [0.0, 0.0, -10.0],
//!     coils: vec![(1, 0, below, spring)],
//!     ..Model::default()
//! };
//! let mut system = System::new(model)?;
//! let seen = system.observe(0.0, &[0.1, 0.0]); // 0.1 m above its place, at rest
//! let (lifted, stretched) = (2.0 * 10.0 * 0.1, 0.5 * 100.0 * 0.1_f64.powi(2)); // J
//! assert!((seen.energies.gravity - lifted).abs() < 1e-12);
//! assert!((seen.energies.coil - stretched).abs() < 1e-12);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

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
pub mod linear;
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
