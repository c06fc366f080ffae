//! An element whose force along y acts above or below its markers.
//!
//! An adapter pitches on the bearing of its axle as its side frame does, so that forces along and up pass
//! through the axle, and leave no moment about it; those across act at its crown. With the markers at the
//! axle, the law sees the displacement along y of the point h above marker A, along the z axis of A, and
//! its force along y acts there. With R the rotation of A relative to B,
//!
//! ```text
//! y' = y + h R_yz,   v_y' = v_y + h (ω_z R_xz - ω_x R_zz),   M = (-h R_zz F_y, 0, h R_xz F_y) more
//! ```
//!
//! which is virtual work: energy and loss are those of the law at the motion that it sees. Units: m, N.

use numerics::scalar::Real;

use crate::element::{Element, Wrench};
use crate::link::RelativeMotion;
use crate::vector::Vector;

/// A law with its force along y at a distance above its markers.
#[derive(Clone, Debug, PartialEq)]
pub struct Raised<E> {
    /// The law.
    pub law: E,
    /// Distance above marker A, m; negative: below.
    pub height: f64,
}

impl<E> Raised<E> {
    /// Returns the motion that the law sees.
    #[inline(always)]
    fn seen<S: Real>(&self, motion: &RelativeMotion<S>) -> RelativeMotion<S> {
        let Vector([x, y, z]) = motion.rotation.column(2);
        let [rolling, _, yawing] = motion.angular_velocity.0;
        let mut seen = *motion;
        seen.position.0[1] += y * self.height;
        seen.velocity.0[1] += (yawing * x - rolling * z) * self.height;
        seen
    }
}

impl<E: Element> Element for Raised<E> {
    fn name(&self) -> &str {
        self.law.name()
    }

    fn does_work(&self) -> bool {
        self.law.does_work()
    }

    #[inline(always)]
    fn evaluate<S: Real>(&self, motion: &RelativeMotion<S>) -> Wrench<S> {
        let mut wrench = self.law.evaluate(&self.seen(motion));
        let Vector([x, _, z]) = motion.rotation.column(2);
        let couple = wrench.force.0[1] * self.height;
        wrench.moment.0[0] -= couple * z;
        wrench.moment.0[2] += couple * x;
        wrench
    }

    fn energy(&self, motion: &RelativeMotion<f64>) -> f64 {
        self.law.energy(&self.seen(motion))
    }
}
