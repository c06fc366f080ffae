//! Wheel on rail, and track: what a railway vehicle stands on. The crate knows no vehicle.
//!
//! | what | where |
//! |---|---|
//! | elastic contact of two curved bodies (Hertz) | [`hertz`] |
//! | creep forces: Kalker's linear theory, Shen-Hedrick-Elkins, Polach, FASTSIM | [`creep`] |
//! | profiles of wheels and rails | [`profile`] |
//! | track: center line, superelevation, grade, irregularities | [`track`] |
//!
//! SI units. Axes of track and vehicles: x forward, y left, z up. Axes of a contact: x rolling direction, y
//! in the tangent plane, z along the normal.

#![warn(missing_docs)]

pub mod creep;
pub mod hertz;
pub mod profile;
pub mod track;
