//! An element whose markers are exchanged, so that the body with its marker A may be prescribed.

use numerics::scalar::Real;

use super::{Element, Wrench};
use crate::link::RelativeMotion;
use crate::vector::{Matrix, Vector};

/// An element on the motion of its marker B relative to its marker A: it gives the wrench on B.
#[derive(Clone, Debug)]
pub(super) struct Reversed<E>(pub E);

/// Returns the motion of marker B relative to marker A, in the axes of A, from that of A relative to B.
///
/// With (d, R, v, ω) the motion of A relative to B: `(-Rᵀd, Rᵀ, -Rᵀ(v - ω × d), -Rᵀω)`.
#[inline(always)]
fn inverse<S: Real>(motion: &RelativeMotion<S>) -> RelativeMotion<S> {
    let back: Matrix<S> = motion.rotation.transpose();
    let carried: Vector<S> = motion.angular_velocity.cross(motion.position);
    RelativeMotion {
        position: -back.apply::<S, S>(motion.position),
        rotation: back,
        velocity: -back.apply::<S, S>(motion.velocity - carried),
        angular_velocity: -back.apply::<S, S>(motion.angular_velocity),
    }
}

/// Returns the wrench on marker B in the axes of A, from that on A, of the motion of B relative to A and its
/// inverse.
#[inline(always)]
fn on_other<S: Real>(motion: &RelativeMotion<S>, own: &RelativeMotion<S>, wrench: &Wrench<S>) -> Wrench<S> {
    let moment = wrench.moment + own.position.cross::<S, S>(wrench.force);
    Wrench {
        force: -motion.rotation.apply::<S, S>(wrench.force),
        moment: -motion.rotation.apply::<S, S>(moment),
        powers: wrench.powers,
    }
}

impl<E: Element> Element for Reversed<E> {
    fn name(&self) -> &str {
        self.0.name()
    }

    #[inline(always)]
    fn evaluate<S: Real>(&self, motion: &RelativeMotion<S>) -> Wrench<S> {
        let own = inverse(motion);
        on_other(motion, &own, &self.0.evaluate(&own))
    }

    fn has_states(&self) -> bool {
        self.0.has_states()
    }

    #[inline(always)]
    fn evaluate_with<S: Real>(&self, motion: &RelativeMotion<S>, states: [S; 2]) -> (Wrench<S>, [S; 2]) {
        let own = inverse(motion);
        let (wrench, rates) = self.0.evaluate_with(&own, states);
        (on_other(motion, &own, &wrench), rates)
    }

    fn energy_with(&self, motion: &RelativeMotion<f64>, states: [f64; 2]) -> f64 {
        self.0.energy_with(&inverse(motion), states)
    }

    fn energy(&self, motion: &RelativeMotion<f64>) -> f64 {
        self.0.energy(&inverse(motion))
    }

    fn does_work(&self) -> bool {
        self.0.does_work()
    }
}
