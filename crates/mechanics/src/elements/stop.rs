//! A stop with clearance along one axis: gib, land, pocket side, adapter stop, roller side bearing.
//!
//! Along the x axis of marker B, with d the x coordinate of marker A: where `d > g₊` the stop pushes back by
//! `max(0, k (d - g₊) + c ḋ)`, where `d < -g₋` by `max(0, k (-g₋ - d) - c ḋ)`, else not at all. The force
//! acts at marker A. Units: m, N, s. An infinite clearance leaves one side out.
//!
//! Defects: the force jumps by `c ḋ` at an impact. Nothing acts across the axis: a stop has no friction.
//! Remedy where friction matters: a [`ContactFace`](crate::contact::ContactFace).

use numerics::scalar::Real;

use super::{unilateral, unilateral_energy};
use crate::element::{Element, Inputs, Wrench};
use crate::link::RelativeMotion;
use crate::vector::Vector;

/// A stop along the x axis of marker B.
#[derive(Clone, Debug, PartialEq)]
pub struct Stop {
    /// Its name in results.
    pub name: String,
    /// Clearances towards negative and positive x, m; infinite: no stop on that side.
    pub clearances: [f64; 2],
    /// Stiffness, N/m.
    pub stiffness: f64,
    /// Damping, N·s/m.
    pub damping: f64,
}

impl Stop {
    /// Returns the load (N, positive along x of marker B, on the body with marker A) and the power lost (W)
    /// at a displacement (m) and its rate (m/s).
    #[inline(always)]
    pub fn load<S: Real>(&self, displacement: S, rate: S) -> [S; 2] {
        let law = [self.stiffness, self.damping];
        let [lower, upper] = self.clearances;
        if displacement.value() > upper {
            let [load, loss] = unilateral(law, displacement - upper, rate);
            [-load, loss]
        } else {
            unilateral(law, -displacement - lower, -rate)
        }
    }
}

impl Element for Stop {
    fn name(&self) -> &str {
        &self.name
    }

    fn inputs(&self) -> Inputs {
        Inputs::Points
    }

    #[inline(always)]
    fn evaluate<S: Real>(&self, motion: &RelativeMotion<S>) -> Wrench<S> {
        let [load, loss] = self.load(motion.position.0[0], motion.velocity.0[0]);
        Wrench {
            force: Vector([load, S::zero(), S::zero()]),
            moment: Vector::zero(),
            powers: [loss, S::zero()],
        }
    }

    fn energy(&self, motion: &RelativeMotion<f64>) -> f64 {
        let ([lower, upper], d) = (self.clearances, motion.position.0[0]);
        let beyond = |clearance: f64, d: f64| unilateral_energy(self.stiffness, d - clearance);
        beyond(upper, d) + beyond(lower, -d)
    }
}
