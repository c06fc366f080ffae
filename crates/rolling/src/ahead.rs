//! The pose of a body along its motion: numbers whose derivative is the rate along the motion.

use mechanics::link::RelativeMotion;
use mechanics::vector::Vector;
use numerics::scalar::{Dual, Real};

/// Returns marker A's place and its second axis (the axle), each with its rate.
#[inline(always)]
pub(crate) fn ahead<S: Real>(motion: &RelativeMotion<S>) -> [[Dual<1>; 3]; 2] {
    let axle = motion.rotation.column(1).value();
    let swing: Vector<f64> = motion.angular_velocity.value().cross(axle);
    let with = |value: Vector<f64>, rate: Vector<f64>| {
        [0, 1, 2].map(|i| Dual {
            value: value.0[i],
            derivative: [rate.0[i]],
        })
    };
    [
        with(motion.position.value(), motion.velocity.value()),
        with(axle, swing),
    ]
}
