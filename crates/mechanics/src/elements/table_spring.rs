//! A coil spring whose load is a table over its length, with shear and tilt stiffness.
//!
//! Marker A is the point of the carried body where the spring acts, marker B that point's nominal place on
//! the body with the seat, z away from the seat. With d the position of A from B in the axes of B, ḋ its
//! rate, and a the z axis of A in the axes of B, force and moment on A are
//!
//! ```text
//! (-k_s d_x, -k_s d_y, F(d_z)) - c ḋ,   k_t a × (0, 0, 1)
//! ```
//!
//! with F(d_z) the load, never negative. They are the gradient of the energy `-∫ F dd_z + ½ k_s |d_s|² +
//! k_t (1 - a_z)`, the tilt's part exact at any angle; the coil does not resist a turn about its own axis.
//! The power lost is `c |ḋ|²`. Force and moment act at A and their reactions on the other body at the same
//! place. Units: m, N, s.
//!
//! Defects: seats hold the ends of the coil, so that shear, tilt and damping act without load too, also where
//! the body is lifted off. A [`ShearSpring`](super::ShearSpring) lets go instead. The stiffness jumps at the
//! points of the table.

use numerics::scalar::Real;

use crate::curve::Curve;
use crate::element::{Element, Wrench};
use crate::link::RelativeMotion;
use crate::vector::Vector;

/// A coil spring whose load is a table.
#[derive(Clone, Debug, PartialEq)]
pub struct TableSpring {
    /// Its name in results.
    pub name: String,
    /// Load (N) over the displacement of its end along z (m), which is zero at the nominal place; not
    /// negative.
    load: Curve,
    /// Stiffness along x and y, N/m.
    pub shear_stiffness: f64,
    /// Stiffness of the tilt about x and y, N·m/rad.
    pub tilt_stiffness: f64,
    /// Damping in all directions, N·s/m.
    pub damping: f64,
}

impl TableSpring {
    /// Returns a spring with a load (N) over the displacement along z (m), without shear, tilt and damping.
    /// Where the table is negative, the load is zero.
    #[must_use]
    pub fn new(name: &str, load: &Curve) -> Self {
        Self {
            name: name.to_owned(),
            load: load.clamped(0.0, f64::INFINITY),
            shear_stiffness: 0.0,
            tilt_stiffness: 0.0,
            damping: 0.0,
        }
    }

    /// Returns the load (N) over the displacement along z (m).
    #[must_use]
    pub fn table(&self) -> &Curve {
        &self.load
    }

    /// Returns the same spring under another name.
    #[must_use]
    pub fn named(&self, name: String) -> Self {
        Self { name, ..self.clone() }
    }

    /// Returns the load (N) at a displacement along z (m): never negative.
    #[inline(always)]
    pub fn load<S: Real>(&self, displacement: S) -> S {
        self.load.evaluate(displacement)
    }
}

impl Element for TableSpring {
    fn name(&self) -> &str {
        &self.name
    }

    #[inline(always)]
    fn evaluate<S: Real>(&self, motion: &RelativeMotion<S>) -> Wrench<S> {
        let ([x, y, z], velocity) = (motion.position.0, motion.velocity);
        let shear = self.shear_stiffness;
        let elastic = Vector([x * -shear, y * -shear, self.load(z)]);
        let damped: Vector<S> = velocity.scale(self.damping);
        let [ax, ay] = [0, 1].map(|row| motion.rotation.0[row][2]);
        let tilt = self.tilt_stiffness;
        Wrench {
            force: elastic - damped,
            moment: Vector([ay * tilt, ax * -tilt, S::zero()]),
            powers: [damped.dot(velocity), S::zero()],
        }
    }

    fn energy(&self, motion: &RelativeMotion<f64>) -> f64 {
        let [x, y, z] = motion.position.0;
        let shear = 0.5 * self.shear_stiffness * (x * x + y * y);
        shear + self.tilt_stiffness * (1.0 - motion.rotation.0[2][2]) - self.load.integral(z)
    }
}
