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
//! | motions about steady running, critical speed | [`SteadyCar`] |
//! | critical speed over the amplitude by equivalent linearization | [`OverAmplitude`] |
//! | the linear benchmark of textbooks | [`Parameters::tied`] |
//! | what one sees: wheel forces, places on the track, accelerations, trucks | [`Loads`] |
//!
//! Not in the model: flexible bodies but for one twist of the car body ([`Torsion`]), braking; draft gears of
//! couplers, whose forces are given.
//!
//! ```
//! use car::{Car, Parameters};
//! use integrate::Problem;
//! use truck::Lading;
//! use wheelrail::track::{CenterLine, Segment, Track};
//!
//! let center_line = CenterLine::new(&[Segment::Tangent(200.0)], 1.511, &[])?; // m
//! let track = Track { center_line, irregularities: Vec::new() };
//! let parameters = Parameters::new(Lading::Loaded, track, 20.0)?; // m/s
//! let mut car = Car::new(&parameters)?;
//! let state = car.initial_state.clone();
//! let mut rates = vec![0.0; state.len()];
//! car.system.derivative(0.0, &state, &mut rates);
//! let seen = car.system.observe(0.0, &state);
//! let loads = car.loads(&seen, &rates);
//! let carried: f64 = loads.wheels.iter().flatten().map(|wheel| wheel.vertical).sum(); // N
//! assert!((carried / parameters.weight() - 1.0).abs() < 0.01);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

#![warn(missing_docs)]

mod amplitude;
mod assemble;
mod benchmark;
mod body;
mod climb;
mod coupler;
mod defaults;
mod derailment;
pub mod drive;
mod error;
mod linearize;
mod loads;
mod motions;
mod parameters;
mod shaken;
mod shapes;
mod start;
mod statics;
mod tipping;
mod torsion;
mod wheels_over_amplitude;

pub use amplitude::{Neutral, OverAmplitude};
pub use assemble::{Car, Numbers, free as free_truck, massless_options, searches, upright};
pub use benchmark::NoWarp;
pub use climb::{AxleLimits, ClimbLimits};
pub use coupler::{
    Coupler, CouplerForce, CouplerLine, CouplerLoads, CouplerPlace, Couplers, Course, Direction,
};
pub use derailment::Derailment;
pub use error::{BuildError, InvalidParameter};
pub use linearize::{
    CriticalSpeed, FrictionState, LinearizeError, Mode, SteadyCar, VIBRATIONS, growing, vibrations,
};
pub use loads::{AxleLoads, EndMotion, Loads, TRUCK_PARTS, WheelLoads, accelerometer, ratio};
pub use motions::{BodyMotion, Motions, TruckMotion, WheelsetAxes};
pub use parameters::{
    ACCELEROMETER_HEIGHTS, Drive, Mass, Parameters, ProfiledWheels, Start, StartKind, TRUCK_DISTANCES,
    Torsion, Wheels,
};
pub use shapes::name_of;
pub use statics::Statics;
pub use tipping::{Support, Tipping};
