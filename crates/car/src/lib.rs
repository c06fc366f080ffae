//! A freight car on track, as data for the multibody core.
//!
//! A car body with its lading stands with center plates and side bearings on two three-piece trucks
//! ([`truck`]), whose wheelsets roll on rails ([`rolling`]). All bodies have absolute coordinates; the
//! track is a curve in space. Axes: x forward, y to the left, z up from the top of rail. Wheelsets 1 to 4
//! and trucks count from the front; wheels, side frames and nests left before right. SI units.
//!
//! | what | where |
//! |---|---|
//! | parameters, with the values of a car of 263,000 lbf | [`Parameters`] |
//! | bodies, elements, state at the start | [`Car`] |
//! | motions about steady running, critical speed | [`Parameters::modes`], [`Parameters::critical_speed`] |
//! | what one sees: wheel forces, places on the track, accelerations, trucks | [`Loads`] |
//!
//! Not in the model: flexible bodies, braking, coupler forces.

#![warn(missing_docs)]

mod assemble;
mod body;
mod defaults;
mod drive;
mod error;
mod linearize;
mod loads;
mod motions;
mod parameters;
mod start;

pub use assemble::{Car, Numbers};
pub use error::{BuildError, InvalidParameter};
pub use linearize::{CriticalSpeed, FrictionState, LinearizeError, Mode};
pub use loads::{AxleLoads, EndMotion, Loads, WheelLoads};
pub use motions::{BodyMotion, Motions, TruckMotion, WheelsetAxes};
pub use parameters::{Drive, Mass, Parameters, ProfiledWheels, Start, StartKind, Wheels};
