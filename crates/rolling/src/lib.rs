//! Wheels on rails as elements of the multibody core.
//!
//! | what | where |
//! |---|---|
//! | a wheel on a rail: patches, normal and creep forces | [`wheel::WheelOnRail`] |
//! | a wheelset with linear geometry and creep, in all its motions | [`linear::LinearOnTrack`] |
//! | a sprung rail that follows its wheel | [`track::RailSupport`], [`track::rail_body`] |
//! | springs of a carriage that runs along the track, its load and its drive | [`carriage::Carriage`] |
//! | a wheelset as a body that spins about its axle, last of its angles | [`wheelset::WheelsetBody`] |
//! | vibrations about steady rolling, in curves too | [`rig::Rig::vibrations`] |
//! | where a wheel stands: on its rail, its flange's tip, beside the rail | [`wheel::WheelOnRail::seat`] |
//! | all of it: one wheelset under a carriage on a track | [`rig::Rig`] |
//!
//! Elements are [`mechanics::element::Element`]s: marker A is on the wheelset, marker B on the ground or on a
//! sprung rail, with the fixed axes of the track. All are written over a scalar and have no memory. SI units.
//!
//! ```
//! use rolling::wheelset::{WheelsetBody, WheelsetPlace};
//!
//! let wheelset = WheelsetBody { mass: 1250.0, about_axle: 150.0, about_diameter: 700.0 }; // kg, kg·m²
//! let place = WheelsetPlace { position: [10.0, 0.0, 0.46], ..Default::default() };
//! let body = wheelset.body("wheelset", &place);
//! assert_eq!(body.initial[2], 10.0); // forward; the last of its angles is its spin
//! ```

#![warn(missing_docs)]

mod ahead;
pub mod beam;
pub mod carriage;
pub mod linear;
mod linearize;
pub mod rig;
mod seat;
pub mod track;
pub mod wheel;
pub mod wheelset;
