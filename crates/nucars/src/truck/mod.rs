//! From files to mechanics: a system file and an input file become a [`Model`](mechanics::system::Model).
//!
//! Files are in pounds-force, inches, seconds, radians and lb s²/in (distances of distance-based histories in
//! feet); the model is in SI units. Where the program's manual would be needed, [`Choices`] has an option
//! with a default, and [`Choices::describe`] says what was chosen.

mod build;
mod choices;
mod history;
pub(crate) mod units;
mod yaw;

pub use build::{BuildError, Truck};
pub use choices::{Bend, Choices, WedgeBody, Wedges, Yaw};
pub use yaw::{DRIVEN_YAW_STIFFNESS, intended_yaw};
