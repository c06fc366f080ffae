//! A stop with radial clearance in a plane: the rim of a center plate.
//!
//! In the x-y plane of marker B, with r the distance of marker A from the z axis: where `r > g` the stop
//! pushes back towards the axis by `max(0, k (r - g) + c ṙ)`, at marker A. Units: m, N, s.
//!
//! Defects: no friction along the rim; the force jumps by `c ṙ` at an impact.

use numerics::scalar::Real;

use super::{unilateral, unilateral_energy};
use crate::element::{Element, Inputs, Wrench};
use crate::link::RelativeMotion;
use crate::vector::Vector;

/// A radial stop about the z axis of marker B.
#[derive(Clone, Debug, PartialEq)]
pub struct RadialStop {
    /// Its name in results.
    pub name: String,
    /// Radial clearance, m.
    pub clearance: f64,
    /// Stiffness, N/m.
    pub stiffness: f64,
    /// Damping, N·s/m.
    pub damping: f64,
}

impl Element for RadialStop {
    fn name(&self) -> &str {
        &self.name
    }

    fn inputs(&self) -> Inputs {
        Inputs::Points
    }

    #[inline(always)]
    fn evaluate<S: Real>(&self, motion: &RelativeMotion<S>) -> Wrench<S> {
        let ([x, y, _], [vx, vy, _]) = (motion.position.0, motion.velocity.0);
        let square = x * x + y * y;
        if square.value() <= self.clearance * self.clearance || square.value() == 0.0 {
            return Wrench {
                force: Vector::zero(),
                moment: Vector::zero(),
                powers: [S::zero(); 2],
            };
        }
        let radius = square.sqrt();
        let rate = (x * vx + y * vy) / radius;
        let [load, loss] = unilateral([self.stiffness, self.damping], radius - self.clearance, rate);
        let inwards = -load / radius;
        Wrench {
            force: Vector([x * inwards, y * inwards, S::zero()]),
            moment: Vector::zero(),
            powers: [loss, S::zero()],
        }
    }

    fn energy(&self, motion: &RelativeMotion<f64>) -> f64 {
        let [x, y, _] = motion.position.0;
        unilateral_energy(self.stiffness, libm::hypot(x, y) - self.clearance)
    }
}
