//! Contact of a wheel and a rail: search, normal forces, creep forces.
//!
//! | what | where |
//! |---|---|
//! | a wheel and a rail prepared for the search; patches; rigid touch | [`ContactPair`], [`ContactPatch`] |
//! | tables of patches: a fast mode of the search | [`ContactTable`] |
//! | where a wheel is; axes, which serve both sides | [`WheelPose`], [`Side`] |
//! | normal force with damping, creepages, creep forces, the wrench on the wheel | [`ContactLaw`] |
//! | linear geometry and creep of a wheelset, for stability | [`LinearWheelset`] |
//! | Hertz's constants by a table, with derivatives | [`Ellipses`] |
//!
//! All of it is written over a scalar and has no memory: the same pose gives the same patches.

mod ellipse;
mod force;
mod linear;
mod patch;
mod pose;
mod search;
mod section;
mod table;

pub use ellipse::{Ellipse, Ellipses};
pub use force::{ContactLaw, CreepLaw, PatchForces, WheelForces, WheelMotion};
pub use linear::{CreepCoefficients, LinearWheelset};
pub use patch::ContactPatch;
pub use pose::{Side, WheelPose};
pub use search::{AREAS, ContactPair, FindPatches, RigidTouch};
pub use table::ContactTable;
