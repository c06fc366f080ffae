//! The control coil: a spring with damping between a seat on one body and a point of another.
//!
//! Equations (Steets 2007, eqs. 3-11, 3-12, 3-16, 3-17): with d from the seat to the coil's upper end and
//! L = |d|, the force on the upper body is `F(l0 - L) d/L - C ḋ`, and a moment `-C_r Ω` damps its rotation
//! relative to the seat (eqs. 3-13, 3-18, where C_r is numerically C in lbf·s·in). Units: N, m, s. ḋ is
//! measured by an observer on the seat's body.
//!
//! Line of action. The thesis's moment equations hold no moment of the coil: its force acts at the center of
//! gravity although L is measured to the coil's end (`acts_at = "center_of_gravity"`). That is a force and a
//! guiding couple; the couple does work when the body turns, and this work is integrated and entered in the
//! energy ledger under its own name. With `acts_at = "seat"` the force acts at the coil's end, and there is
//! no couple.

use numerics::scalar::{Number, Real};
use serde::{Deserialize, Serialize};

use crate::body::Kinematics;
use crate::characteristic::Characteristic;
use crate::element::{Element, Inputs, Wrench};
use crate::link::{BodyWrench, RelativeFrame, RelativeMotion};
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
    /// A force that comes from outside the model, whatever the compression. Its energy is not the model's:
    /// the ledger does not hold its work.
    Given {
        /// The force, N: positive pushes.
        force: f64,
    },
}

/// The line of action of the coil's force on the body that it carries.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum CoilLine {
    /// Through the center of gravity: no moment about it.
    CenterOfGravity,
    /// At the coil's end on the body.
    Seat,
}

/// A coil. Its seat is the origin of marker B.
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
    /// True if the spring can pull.
    pub pulls: bool,
}

/// Spring and dashpot alone.
struct Pull<S> {
    force: Vector<S>,
    /// The spring's part of it.
    along: Vector<S>,
    length: S,
    spring: S,
    /// Power lost in the dashpot.
    loss: S,
}

/// The force of a coil.
#[derive(Clone, Copy, Debug)]
pub struct CoilForce<S> {
    /// Force on the body, marker axes, N.
    pub force: Vector<S>,
    /// The spring's part of it.
    pub spring_force: Vector<S>,
    /// Its moment about the body's origin, marker axes, N·m.
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
    /// Returns the force (N) at a compression (m); negative where it pulls.
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
    /// Returns the coil's force.
    #[inline(always)]
    pub fn on_body<S: Real>(&self, relative: &RelativeMotion<S>) -> CoilForce<S> {
        self.on_body_with(relative, |length| self.spring(length))
    }

    /// Returns the same with the spring force (N) as a function of the length (m) that the caller gives.
    #[inline(always)]
    pub fn on_body_with<S: Real>(
        &self,
        relative: &RelativeMotion<S>,
        spring: impl FnOnce(S) -> S,
    ) -> CoilForce<S> {
        let coil = self.at_end(&relative.at(self.end), spring);
        let arm: Vector<S> = relative.rotation.apply(self.end);
        CoilForce {
            moment: coil.moment + arm.cross::<S, S>(coil.force),
            ..coil
        }
    }

    /// Returns the same from the motion of the coil's end, with the moment about that end.
    #[inline(always)]
    fn at_end<S: Real>(&self, relative: &RelativeMotion<S>, spring: impl FnOnce(S) -> S) -> CoilForce<S> {
        let pull = pull(self.damping, relative.position, relative.velocity, spring);
        let force = pull.force;
        let angular_velocity = relative.angular_velocity;
        let mut moment = angular_velocity.scale(-self.rotational_damping);
        let loss = pull.loss + angular_velocity.dot(angular_velocity) * self.rotational_damping;
        let mut guide_power = S::zero();
        if self.acts_at != self.end {
            let offset: Vector<S> = relative.rotation.apply(self.acts_at - self.end);
            let couple: Vector<S> = offset.cross(force);
            moment += couple;
            guide_power = couple.dot(angular_velocity);
        }
        CoilForce {
            force,
            spring_force: pull.along,
            moment,
            length: pull.length,
            spring: pull.spring,
            loss,
            guide_power,
        }
    }

    /// Returns the wrench of the coil on its body if marker B does not rotate: [`Coil::on_body`] with fewer
    /// products; with it a wedge takes 1 to 3 % more instructions.
    #[inline(always)]
    pub(crate) fn wrench_on_body(
        &self,
        relative_frame: &RelativeFrame<f64>,
        body: &Kinematics<f64>,
    ) -> BodyWrench {
        let (rotation, spin, end) = (&body.orientation.rotation, body.spin, self.end);
        let (mut end_position, mut velocity) = (body.position, body.velocity);
        if end != Vector::zero() {
            end_position += rotation.apply(end);
            velocity += rotation.apply(spin.cross::<f64, f64>(end));
        }
        let d = relative_frame.position + relative_frame.rotation.apply::<f64, f64>(end_position);
        let rate = relative_frame.velocity + relative_frame.rotation.apply::<f64, f64>(velocity);
        let pull = pull(self.damping, d, rate, |length| self.spring(length));
        let own: Vector<f64> =
            rotation.apply_transposed(relative_frame.rotation.apply_transposed::<f64, f64>(pull.force));
        let brake = self.rotational_damping;
        let moment = self.acts_at.cross::<f64, f64>(own) - spin.scale::<f64, f64>(brake);
        let couple: Vector<f64> = (self.acts_at - end).cross(own);
        BodyWrench {
            force: pull.force,
            moment,
            powers: [pull.loss + spin.dot::<f64, f64>(spin) * brake, couple.dot(spin)],
        }
    }

    /// Returns the spring force at a length (m), N.
    #[inline(always)]
    pub fn spring<S: Real>(&self, length: S) -> S {
        let compression = -length + self.free_length;
        taut(self.law.force(compression), self.pulls)
    }

    /// Returns the stored energy at a length, J; zero at the free length.
    #[must_use]
    pub fn stored_energy(&self, length: f64) -> f64 {
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

/// Marker A is the coil's end, marker B its seat.
impl Element for Coil {
    fn name(&self) -> &str {
        "coil"
    }

    fn energy(&self, relative: &RelativeMotion<f64>) -> f64 {
        let d = relative.position;
        self.stored_energy(d.dot::<f64, f64>(d).sqrt())
    }

    fn inputs(&self) -> Inputs {
        if self.acts_at == self.end && self.rotational_damping == 0.0 {
            Inputs::Points
        } else {
            Inputs::Motion
        }
    }

    #[inline(always)]
    fn evaluate<S: Real>(&self, relative: &RelativeMotion<S>) -> Wrench<S> {
        let coil = self.at_end(relative, |length| self.spring(length));
        Wrench {
            force: coil.force,
            moment: coil.moment,
            powers: [coil.loss, coil.guide_power],
        }
    }
}

/// Returns the spring and dashpot between the seat and the coil's end at `d`, which moves with `rate`.
#[inline(always)]
fn pull<S: Real>(damping: f64, d: Vector<S>, rate: Vector<S>, spring: impl FnOnce(S) -> S) -> Pull<S> {
    let length = d.dot::<S, S>(d).sqrt();
    let spring = spring(length);
    let along = d.scale(spring / length);
    Pull {
        force: along - rate.scale::<f64, S>(damping),
        along,
        length,
        spring,
        loss: rate.dot::<S, S>(rate) * damping,
    }
}

/// Returns the force of a spring, which may not be able to pull.
#[inline(always)]
pub(crate) fn taut<S: Number>(force: S, pulls: bool) -> S {
    if pulls {
        force
    } else {
        S::blend(S::Plain::zero().below(force.plain()), force, S::zero())
    }
}
