//! A sprung rail that follows its wheel.
//!
//! The rail under a wheel is a body with a mass and three displacements; it does not turn (the roll of a beam
//! is a state of the wheel on it, [`RailBeam::rolling`]), and the wheel's
//! place relative to the rail is its place relative to the undeformed track less these displacements. So the
//! body needs not be carried along: what runs with the wheel is a displacement of the track, whose axes are
//! fixed. Springs and dampers to ground are equal in both level directions, so that they do not depend on the
//! heading and the longitudinal displacement, which rails have too, needs no constraint of its own.
//!
//! Limits: each wheel has its own piece of rail, which knows its neighbor under the same truck only by
//! springs between them ([`RailBeam`]), if they are given; vertical is the vertical
//! of gravity, not the normal of a canted track. A steady lateral force turns with the heading, and the
//! damper of a rail in a curve of radius R at the speed V loses `c (F/k)² (V/R)²`: 0.0005 W for 30 kN in a
//! curve of 10 deg.
//!
//! Defaults: 345 kg a rail, vertically 80 MN/m and 140 kN·s/m, a third of them in level directions. The
//! lateral ones are guesses.

use mechanics::body::Body;
use mechanics::element::{Element, Inputs, Wrench};
use mechanics::frame::Frame;
use mechanics::link::RelativeMotion;
use mechanics::motion::Motion;
use mechanics::vector::Vector;
use numerics::scalar::Real;

use crate::beam::{RailBeam, RailRoll};

/// Springs and dampers under a rail.
#[derive(Clone, Debug, PartialEq)]
pub struct RailSupport {
    /// Its name.
    pub name: String,
    /// Mass of the rail that moves, kg.
    pub mass: f64,
    /// Stiffnesses, level and vertical, N/m.
    pub stiffness: [f64; 2],
    /// Damping, level and vertical, N·s/m.
    pub damping: [f64; 2],
    /// Upward force at rest, N: the weight of the mass, so that the rail lies in its place.
    pub preload: f64,
    /// The rail as a beam, if the wheels of a truck share it: then the stiffnesses are those under one
    /// wheel, the level one that of the base.
    pub beam: Option<RailBeam>,
}

impl RailSupport {
    /// Returns the default support, in a field of gravity (m/s², positive).
    #[must_use]
    pub fn default_support(name: &str, gravity: f64) -> Self {
        let (stiffness, damping, mass) = (80e6, 140e3, 345.0);
        Self {
            name: name.to_owned(),
            mass,
            stiffness: [stiffness / 3.0, stiffness],
            damping: [damping / 3.0, damping],
            preload: mass * gravity,
            beam: None,
        }
    }
}

impl RailSupport {
    /// Returns how the rail rolls under a wheel; none where it is no beam.
    #[must_use]
    pub fn rolling(&self) -> Option<RailRoll> {
        self.beam.as_ref().map(RailBeam::rolling)
    }
}

/// Returns the body of a rail: displacements alone.
#[must_use]
pub fn rail_body(support: &RailSupport) -> Body {
    let mut body = Body::free(&support.name, support.mass, [0.0; 3], [0.0; 6]);
    body.free = [true, true, true, false, false, false];
    body
}

/// Returns the body that a rail lies on where that can be moved (a bridge, a rig): it stands still along the
/// fixed axes until its motions are set.
#[must_use]
pub fn rail_bed(name: &str) -> Body {
    let mut frame = Frame::fixed([0.0; 3], [0.0; 3]);
    frame.motions = std::array::from_fn(|_| Motion::line(0.0, [0.0; 2]));
    Body::prescribed(name, frame)
}

impl Element for RailSupport {
    fn name(&self) -> &str {
        &self.name
    }

    fn inputs(&self) -> Inputs {
        Inputs::Points
    }

    #[inline(always)]
    fn evaluate<S: Real>(&self, motion: &RelativeMotion<S>) -> Wrench<S> {
        let ([k, kz], [c, cz]) = (self.stiffness, self.damping);
        let (stiffness, damping) = ([k, k, kz], [c, c, cz]);
        let (d, v) = (motion.position.0, motion.velocity.0);
        let mut force = [0, 1, 2].map(|i| -(d[i] * stiffness[i]) - v[i] * damping[i]);
        force[2] = force[2] + self.preload;
        let mut loss = S::zero();
        for i in 0..3 {
            loss += v[i] * v[i] * damping[i];
        }
        Wrench {
            force: Vector(force),
            moment: Vector::zero(),
            powers: [loss, S::zero()],
        }
    }

    fn energy(&self, motion: &RelativeMotion<f64>) -> f64 {
        let ([k, kz], [x, y, z]) = (self.stiffness, motion.position.0);
        0.5 * (k * (x * x + y * y) + kz * z * z) - self.preload * z
    }
}
