//! The figures of the reproduction.
//!
//! - [`thesis`]: those of the thesis's stand-alone runs, three toe cases in each.
//! - [`comparison`]: the stand-alone wedge against types 6.8 and 6.9 of the comparison program.
//! - [`model`]: the bolster's motion, the friction law, the coil.
//! - [`groups`]: one figure for each group of the built-in cases beyond the thesis.
//! - [`sensitivity`]: statements that hold over the contact stiffness.

pub mod comparison;
pub mod groups;
pub mod model;
pub mod sensitivity;
pub mod thesis;
