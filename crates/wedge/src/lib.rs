//! The stand-alone friction wedge between side frame and bolster.
//!
//! One wedge body, two contact faces of four corners each or finer grids of points, a control coil, two
//! prescribed neighbors: put together from [`mechanics`] by [`Wedge::new`]. [`outputs`] defines the results.

pub mod face;
pub mod inputs;
pub mod outputs;
pub mod parameters;
pub mod quasi_static;
pub mod resultants;
pub mod thesis;

mod assemble;

pub use assemble::{BOLSTER, BuildError, COLUMN, SIDE_FRAME, SLOPE, WEDGE, Wedge};
pub use parameters::{ParameterError, Parameters, Start};
