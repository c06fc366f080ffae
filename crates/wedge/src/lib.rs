//! The stand-alone friction wedge between side frame and bolster.
//!
//! One wedge body, two contact faces of four corners each or finer grids of points, a control coil, two
//! prescribed neighbors: put together from [`mechanics`] by [`Wedge::new`]. [`outputs`] defines the results.
//!
//! ```
//! use wedge::parameters::Damping;
//! use wedge::{COLUMN, Wedge, thesis};
//!
//! let toe = 0.2_f64.to_radians();
//! let mut wedge = Wedge::new(thesis::parameters(Damping::Constant, toe, 0.0))?;
//! let start = wedge.initial_state.clone();
//! let seen = wedge.system.observe(0.0, &start);
//! assert_eq!(seen.faces[COLUMN].points.len(), 4); // corners: gap, normal force, friction, state of each
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

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
