//! The control coil: a spring with damping between a seat on one body and a point of another.
//!
//! Equations (Steets 2007, eqs. 3-11, 3-12, 3-16, 3-17): with d from the seat to the coil's upper end and L = |d|,
//! the force on the upper body is `F(l0 - L) d/L - C ḋ`, and a moment `-C_r Ω` brakes its rotation relative to the
//! seat (eqs. 3-13, 3-18, where C_r is numerically C in lbf·s·in). Units: N, m, s. ḋ is measured by an
//! observer on the seat's body.
//!
//! Line of action. The thesis's moment equations hold no moment of the coil: its force acts at the
//! centre of gravity although L is measured to the coil's end (`acts_at = "center_of_gravity"`). That is a force
//! and a guiding couple; the couple does work when the body turns, and this work is integrated and entered in the
//! energy ledger under its own name. With `acts_at = "seat"` the force acts at the coil's end, and there is no couple.

use integrate::scalar::Real;
use serde::{Deserialize, Serialize};

use crate::characteristic::Characteristic;
use crate::link::Relative;
use crate::vector::Vector;

/// Force by compression.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum CoilLaw {
    /// `stiffness · compression`.
    Linear {
        /// Stiffness, N/m.
        stiffness: f64,
    },
    /// A table of compression (m) and force (N), straight between its points and on beyond them.
    Table(Characteristic),
    /// A force that comes from outside the model, whatever the compression. Its energy is not the model's: the ledger does not hold
    /// its work.
    Given {
        /// The force, N: positive pushes.
        force: f64,
    },
}

/// Where the coil's force acts on the body that it carries.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum CoilLine {
    /// Through the centre of gravity: no moment about it.
    CenterOfGravity,
    /// At the coil's end on the body.
    Seat,
}

/// A coil. The seat is the origin of its mount.
#[derive(Clone, Debug, PartialEq)]
pub struct Coil {
    /// The coil's upper end on its body, from the body's origin in body axes, m.
    pub end: Vector<f64>,
    /// The point where its force acts, from the body's origin in body axes, m.
    pub acts_at: Vector<f64>,
    /// Force by compression.
    pub law: CoilLaw,
    /// Free length l0, m.
    pub free_length: f64,
    /// Damping C, N·s/m.
    pub damping: f64,
    /// Damping of rotations C_r, N·m·s.
    pub rotational_damping: f64,
    /// Whether the spring can pull.
    pub pulls: bool,
}

/// What a coil does.
#[derive(Clone, Copy, Debug)]
pub struct CoilForce<S> {
    /// Force on the body, mount axes, N.
    pub force: Vector<S>,
    /// The spring's part of it.
    pub spring_force: Vector<S>,
    /// Its moment about the body's origin, mount axes, N·m.
    pub moment: Vector<S>,
    /// Length, m.
    pub length: S,
    /// Spring force along the coil, N: positive when it pushes.
    pub spring: S,
    /// Power lost in damping, W.
    pub loss: S,
    /// Power of the guiding couple on the body, W: zero when the force acts at the coil's end.
    pub guide_power: S,
}

impl CoilLaw {
    /// The force (N) at a compression (m); negative where it pulls.
    #[inline(always)]
    #[must_use]
    pub fn force<S: Real>(&self, compression: S) -> S {
        match self {
            Self::Linear { stiffness } => compression * *stiffness,
            Self::Table(table) => table.evaluate(compression),
            Self::Given { force } => S::from(*force),
        }
    }
}

impl Coil {
    /// The coil's force.
    #[inline(always)]
    pub fn evaluate<S: Real>(&self, relative: &Relative<S>) -> CoilForce<S> {
        self.evaluate_with(relative, |length| self.spring(length))
    }

    /// The same with a spring force (N) by the length (m) of the caller's own.
    #[inline(always)]
    pub fn evaluate_with<S: Real>(
        &self,
        relative: &Relative<S>,
        spring: impl FnOnce(S) -> S,
    ) -> CoilForce<S> {
        // A coil that ends at the body's origin, as in a wedge, needs no lever.
        let central = self.end == Vector::zero();
        let (mut arm, mut d, mut rate) = (Vector::zero(), relative.position, relative.velocity);
        if !central {
            arm = relative.rotation.apply(self.end);
            d += arm;
            rate += relative.angular_velocity.cross(arm);
        }
        let length = d.dot(d).sqrt();
        let spring = spring(length);
        let along = d.scale(spring / length);
        let force = along - rate.scale(self.damping);
        let turn = relative.angular_velocity;
        let brake = turn.scale(-self.rotational_damping);
        let mut loss = rate.dot(rate) * self.damping;
        loss += turn.dot(turn) * self.rotational_damping;
        let (moment, guide_power) = if self.acts_at == self.end {
            (arm.cross(force) + brake, S::zero())
        } else {
            let at: Vector<S> = relative.rotation.apply(self.acts_at);
            let couple = (at - arm).cross(force);
            (at.cross(force) + brake, couple.dot(turn))
        };
        CoilForce {
            force,
            spring_force: along,
            moment,
            length,
            spring,
            loss,
            guide_power,
        }
    }

    /// Spring force at a length (m), N.
    #[inline(always)]
    pub fn spring<S: Real>(&self, length: S) -> S {
        let compression = -length + self.free_length;
        let force = self.law.force(compression);
        if self.pulls || force.value() > 0.0 {
            force
        } else {
            S::zero()
        }
    }

    /// Stored energy at a length, J; zero at the free length.
    #[must_use]
    pub fn energy(&self, length: f64) -> f64 {
        let compression = self.free_length - length;
        match &self.law {
            _ if !self.pulls && self.spring(length) <= 0.0 => match &self.law {
                // The energy that is left where the force has come to zero.
                CoilLaw::Table(table) => table.energy_at_zero_force(),
                CoilLaw::Linear { .. } | CoilLaw::Given { .. } => 0.0,
            },
            CoilLaw::Linear { stiffness } => 0.5 * stiffness * compression * compression,
            CoilLaw::Table(table) => table.energy(compression),
            CoilLaw::Given { .. } => 0.0,
        }
    }
}
