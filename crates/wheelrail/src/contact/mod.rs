//! Contact of a wheel and a rail: search, normal forces, creep forces.
//!
//! | what | where |
//! |---|---|
//! | a wheel and a rail prepared for the search; patches; rigid touch | [`ContactPair`], [`ContactPatch`] |
//! | a rail whose section changes along the track | [`VaryingRail`] |
//! | wheels that are not round: flats, harmonics, profiles that change around them | [`OutOfRound`], [`SlicedWheel`] |
//! | tables of patches: a fast mode of the search | [`ContactTable`] |
//! | where a wheel is; axes, which serve both sides | [`WheelPose`], [`Side`] |
//! | normal force with damping, creepages, creep forces, the wrench on the wheel | [`ContactLaw`] |
//! | linear geometry and creep of a wheelset, for stability | [`LinearWheelset`] |
//! | Hertz's constants by a table, with derivatives | [`Ellipses`] |
//!
//! All of it is written over a scalar and has no memory: the same pose gives the same patches.
//!
//! ```
//! use wheelrail::contact::{ContactPair, Side, WheelPose};
//! use wheelrail::hertz::Material;
//! use wheelrail::profile::nominal;
//! // A new 36 in wheel on a rail inclined by 1:40, pressed down by 0.1 mm.
//! let rail = nominal::rail_136re()?.inclined(nominal::INCLINATION);
//! let steel = Material { youngs_modulus: 207e9, poisson: 0.28 };
//! let pair = ContactPair::new(&nominal::aar_1b()?, 0.4572, &rail, steel)?;
//! let pose = |height: f64| WheelPose::of(Side::Left, [0.0, height], 0.0, 0.0);
//! let touching = 0.4572 + pair.touch(&pose(0.4572)).map_or(0.0, |touch| touch.overlap);
//! let patches = pair.patches_at(&pose(touching - 1e-4));
//! assert_eq!(patches.len(), 1);
//! assert!((patches[0].slope - 0.05).abs() < 1e-3);
//! # Ok::<(), wheelrail::profile::ProfileError>(())
//! ```

mod ellipse;
mod force;
mod linear;
mod out_of_round;
mod patch;
mod pose;
mod search;
mod section;
mod strips;
mod table;
mod turned;
mod varying;

pub use ellipse::{Ellipse, Ellipses};
pub use force::{ContactLaw, CreepLaw, PatchForces, WheelForces, WheelMotion, rolling_sense, stored_energy};
pub use linear::{CreepCoefficients, LinearWheelset};
pub use out_of_round::{Flat, HIGHEST_ORDER, Harmonic, LARGEST_AMPLITUDE, LONGEST_FLAT, OutOfRound};
pub use patch::ContactPatch;
pub use pose::{Side, WheelPose};
pub use search::{AREAS, ContactPair, FindPatches, PatchForm, RigidTouch};
pub use strips::{STRIPS, StripLoads};
pub use table::ContactTable;
pub use turned::{SlicedWheel, WheelForm};
pub use varying::VaryingRail;
