//! Contact of wheel and rail, and track. The crate knows no vehicle.
//!
//! | what | where |
//! |---|---|
//! | profiles of wheels and rails: arcs and lines, points from files, nominal ones | [`profile`] |
//! | contact: search for patches, normal force with damping, wrench on a wheel | [`contact`] |
//! | a rigid wheelset on rails: rolling radii, contact angles | [`wheelset`] |
//! | a wheelset under given loads, in the frame of the program CONTACT | [`loaded`] |
//! | the pitch rate at which it rolls freely | [`free_rolling`] |
//! | equivalent conicity, linear geometry | [`conicity`] |
//! | elastic contact of two curved bodies | [`hertz`] |
//! | creep forces: Kalker's coefficients and linear theory, Shen-Hedrick-Elkins, Polach, FASTSIM | [`creep`] |
//! | center line of a track: tangents, spirals, curves; mid-chord offsets; irregularities from spectra and tables | [`track`] |
//!
//! SI units. Axes of a contact: x in the rolling direction, y in the tangent plane, z along the normal. All
//! laws are written over a scalar, so that derivatives come from the same lines.
//!
//! ```
//! use wheelrail::creep::{Creepage, Patch, polach};
//! use wheelrail::hertz::{Hertz, Material};
//! // A 36 in wheel on a rail crown of 10 in, 160 kN.
//! let steel = Material { youngs_modulus: 207e9, poisson: 0.27 };
//! let hertz = Hertz::new(steel, 1.0 / 0.4572, 1.0 / 0.254)?;
//! let patch = Patch::new(&hertz, 160e3, 0.3);
//! let creepage = Creepage { longitudinal: 1e-3, lateral: 0.0, spin: 0.0 };
//! let forces = polach::forces(&patch, &creepage, polach::DRY);
//! assert!(forces.x < 0.0 && forces.x > -0.3 * 160e3);
//! # Ok::<(), wheelrail::hertz::HertzError>(())
//! ```

#![warn(missing_docs)]

pub mod climb;
pub mod conicity;
pub mod contact;
pub mod creep;
pub mod damage;
pub mod free_rolling;
pub mod friction;
pub mod hertz;
pub mod loaded;
pub mod profile;
pub mod track;
mod vector;
pub mod wheelset;
