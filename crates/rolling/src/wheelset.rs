//! A wheelset as a body whose last angle is its spin.
//!
//! Bodies of the core turn about the axes y, z, x of their reference frame, in this order. The reference
//! frame of a wheelset has its axes along y (left), z (up), x (forward) of the track: so the angles are
//! heading about z, roll about x and spin about the axle, in this order. Heading and spin may grow without
//! bound; singular is a roll of 90° only. The spin's angle stands in no force law
//! ([`leave_spin_uncontrolled`]).
//!
//! The body's own axes are the axle (to the left), up, forward at zero angles. A body that does not spin gets
//! heading, pitch, roll by a reference frame with axes x, z, -y.

use std::f64::consts::FRAC_PI_2;

use mechanics::body::Body;
use mechanics::frame::Frame;
use mechanics::link::Marker;
use mechanics::system::System;
use mechanics::vector::{Matrix, Vector};

/// Numbers of the body's coordinates.
pub mod coordinate {
    /// To the left, m.
    pub const LATERAL: usize = 0;
    /// Up, m.
    pub const VERTICAL: usize = 1;
    /// Forward, m.
    pub const FORWARD: usize = 2;
    /// Spin about the axle, rad: positive if the wheelset rolls forward.
    pub const SPIN: usize = 3;
    /// Heading, rad: positive to the left.
    pub const HEADING: usize = 4;
    /// Roll of the axle, rad: positive with the left side up.
    pub const ROLL: usize = 5;
}

/// A wheelset's mass properties.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WheelsetBody {
    /// Mass, kg.
    pub mass: f64,
    /// Moment of inertia about the axle, kg·m².
    pub about_axle: f64,
    /// Moment of inertia about a diameter, kg·m².
    pub about_diameter: f64,
}

/// The pose of a wheelset.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct WheelsetPlace {
    /// Forward, to the left, up, m.
    pub position: [f64; 3],
    /// Heading, rad.
    pub heading: f64,
    /// Roll, rad.
    pub roll: f64,
}

impl WheelsetBody {
    /// Returns the body at a place in the fixed frame.
    #[must_use]
    pub fn body(&self, name: &str, place: &WheelsetPlace) -> Body {
        let [x, y, z] = place.position;
        let inertia = [self.about_axle, self.about_diameter, self.about_diameter];
        Body {
            frame: Frame::fixed([0.0; 3], [0.0, FRAC_PI_2, FRAC_PI_2]),
            ..Body::free(
                name,
                self.mass,
                inertia,
                [y, z, x, 0.0, place.heading, place.roll],
            )
        }
    }
}

/// Returns a marker on a wheelset, `left` (m) along the axle from its center, with axes forward, left (along
/// the axle), up.
#[must_use]
pub fn marker(left: f64) -> Marker {
    Marker {
        origin: Vector([left, 0.0, 0.0]),
        rotation: Matrix([[0.0, 1.0, 0.0], [0.0, 0.0, 1.0], [1.0, 0.0, 0.0]]),
    }
}

/// Leaves the spin's angle of a wheelset out of the error control.
pub fn leave_spin_uncontrolled(system: &mut System, wheelset: usize) {
    system.leave_uncontrolled(wheelset, coordinate::SPIN);
}
