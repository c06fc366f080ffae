//! The pose of a body along its motion: numbers whose derivative is the rate along the motion.

use mechanics::link::RelativeMotion;
use mechanics::vector::Vector;
use numerics::scalar::{Dual, Real};

/// Returns marker A's place and its second axis (the axle), each with its rate.
#[inline(always)]
pub(crate) fn ahead<S: Real>(motion: &RelativeMotion<S>) -> [[Dual<1>; 3]; 2] {
    [
        with_rate(motion.position.value(), motion.velocity.value()),
        axis_ahead(motion, 1),
    ]
}

/// Returns an axis of marker A with its rate.
#[inline(always)]
pub(crate) fn axis_ahead<S: Real>(motion: &RelativeMotion<S>, axis: usize) -> [Dual<1>; 3] {
    let own = motion.rotation.column(axis).value();
    with_rate(own, motion.angular_velocity.value().cross(own))
}

#[inline(always)]
fn with_rate(value: Vector<f64>, rate: Vector<f64>) -> [Dual<1>; 3] {
    [0, 1, 2].map(|i| Dual {
        value: value.0[i],
        derivative: [rate.0[i]],
    })
}
