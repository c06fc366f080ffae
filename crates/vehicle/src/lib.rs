//! Vehicles as data: bodies, and elements of a catalog between them.
//!
//! A [`Description`] says which bodies there are, what holds them together and how they start; [`Vehicle`] is
//! the system of equations made of it, with what is seen of it ([`Channels`]) and how it is drawn
//! ([`Drawing`]). Tables, pages, pictures and studies ask for these and know no kind of vehicle. An element
//! of one's own is one [`catalog::CatalogElement`]; everything else follows.
//!
//! Axes: x forward, y left, z up, in the nominal layout, where bodies stand along the fixed axes and both
//! ends of an element that has one place coincide. SI units.
//!
//! ```
//! use std::sync::Arc;
//! use vehicle::catalog::{Attachment, Bushing, Element};
//! use vehicle::{Description, RigidBody, Vehicle};
//!
//! let mut block = RigidBody::new("block", 1000.0, [10.0; 3], [0.0, 0.0, 1.0]); // kg, kg·m², m
//! block.free = [false, false, true, false, false, false];
//! let spring = Bushing { stiffness: [0.0, 0.0, 1e6], ..Bushing::default() }; // N/m
//! let description = Description {
//!     bodies: vec![block],
//!     elements: vec![Element {
//!         name: "spring".to_owned(),
//!         ends: [Attachment { body: 1, at: [0.0; 3] }, Attachment { body: 0, at: [0.0; 3] }],
//!         law: Arc::new(spring),
//!     }],
//!     ..Description::default()
//! };
//! let mut vehicle = Vehicle::new(&description)?;
//! let vibrations = vehicle.vibrations()?;
//! assert!((vibrations[0].frequency - (1e6_f64 / 1000.0).sqrt()).abs() < 1e-6); // rad/s
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

#![warn(missing_docs)]

mod assemble;
mod body;
pub mod catalog;
mod channel;
mod drawing;
mod error;
mod on_track;
mod seen;
mod vibration;

pub use assemble::{Description, StartKind, Vehicle};
pub use body::{BodyStart, RigidBody};
pub use channel::{Channels, View, Whole};
pub use drawing::{Drawing, Drawn, DrawnBody, DrawnElement, Solid};
pub use error::VehicleError;
pub use on_track::{Accelerometer, AccelerometerOf, Axle, AxleState, OnTrack, TruckPart, WheelsetPart};
pub use vibration::Vibration;

/// The name of the body that stands still: number 0.
pub const GROUND: &str = "ground";
