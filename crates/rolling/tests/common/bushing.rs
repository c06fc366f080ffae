//! A bushing for models of the literature.

use mechanics::element::{Element, Wrench};
use mechanics::link::RelativeMotion;
use mechanics::vector::Vector;
use numerics::scalar::Real;

/// Springs and dampers along and about the axes of marker B, for small rotations.
#[derive(Clone, Debug)]
pub struct Bushing {
    pub along: [f64; 3],
    pub about: [f64; 3],
    pub damping: [f64; 3],
    pub turning: [f64; 3],
}

impl Element for Bushing {
    fn name(&self) -> &str {
        "bushing"
    }
    fn evaluate<S: Real>(&self, motion: &RelativeMotion<S>) -> Wrench<S> {
        let (d, v, r, w) = (
            motion.position.0,
            motion.velocity.0,
            motion.small_rotations().0,
            motion.angular_velocity.0,
        );
        let part = |k: [f64; 3], c: [f64; 3], d: [S; 3], v: [S; 3]| {
            Vector([0, 1, 2].map(|i| -(d[i] * k[i]) - v[i] * c[i]))
        };
        Wrench {
            force: part(self.along, self.damping, d, v),
            moment: part(self.about, self.turning, r, w),
            powers: [S::zero(); 2],
        }
    }
    fn energy(&self, _: &RelativeMotion<f64>) -> f64 {
        0.0
    }
}
