//! The three-piece truck with four wedges that have mass, as data for the multibody core.
//!
//! Axes: x forward, y left, z up from the top of rail, origin at the truck's center. The nominal layout is
//! the loaded one: coils carry their static loads there and faces just touch. Bodies and elements, and where
//! their numbers come from: [`Parameters`]. How it becomes a system of bodies: [`Truck`]. What one sees of
//! it: [`Loads`].
//!
//! ```
//! use truck::{Parameters, Truck};
//! use wedge::parameters::Damping;
//! let mut truck = Truck::new(&Parameters::new(Damping::Variable))?;
//! let observation = truck.system.observe(0.0, &truck.system.initial_state());
//! let loads = truck.loads(&observation);
//! assert!(loads.nest_vertical[0] > 200e3); // N
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

#![warn(missing_docs)]

mod assemble;
mod bodies;
pub mod coils;
mod defaults;
mod elements;
mod geometry;
mod joints;
mod loads;
mod massless;
mod motions;
mod mounted;
pub mod nest;
mod parameters;
mod split;
mod statics;
mod units;
mod wedge_mount;

pub use assemble::{
    BOLSTER, BuildError, CAR_BODY, INBOARD_HALVES, SIDE_FRAMES, Truck, WEDGES, WHEELSETS, held,
};
pub use bodies::{bodies, numbers};
pub use defaults::{CROWN_RADIUS, SERVICE_GRID};
pub use elements::{Mount, add_elements, mounted};
pub use geometry::Geometry;
pub use joints::Joint;
pub use loads::{CenterPlateLoads, HalfLoads, Loads, SideBearingLoads, WarpMoment, WedgeLoads};
pub use massless::empirical_warp;
pub use motions::{FaceForce, Motions};
pub use mounted::{MountedTruck, TruckFrame};
pub use parameters::{
    Adapter, AdapterPad, Applied, Bolster, CarBody, CenterPlate, Clearance, ControlCoil, FrictionAdapter,
    Hysteresis, Lading, NestCoil, Parameters, RigidBody, SideBearing, SideBearings, SideFrame, Split, Spring,
    Wedge, WedgeKind, Wheelsets, unloaded,
};
pub use split::{HALVES, WedgePart};
pub use statics::{CoilGroup, TruckStatics};
pub use wedge_mount::{WedgeElements, WedgeMount, add_wedge, reversed, wedge_body};

/// The names of the wedges in the order of all arrays of four: end (leading, trailing), then side.
pub const WEDGE_NAMES: [&str; 4] = ["leading_left", "leading_right", "trailing_left", "trailing_right"];

/// Ends (leading 1, trailing -1) and sides (left 1, right -1) of the wedges.
pub const PLACES: [[f64; 2]; 4] = [[1.0, 1.0], [1.0, -1.0], [-1.0, 1.0], [-1.0, -1.0]];
