//! A coil spring that stands on a seat: preload, shear stiffness, solid height, lift-off.
//!
//! Marker A is the point of the carried body where the spring acts, marker B that point's nominal place on
//! the body with the seat, z away from the seat. With d the position of A from B in the axes of B, and ḋ its
//! rate, the force on A is
//!
//! ```text
//! (-k_s f d_x, -k_s f d_y, F(d_z) + ½ k k_s f' |d_s|²) - c f ḋ,
//! F(d_z) = max(0, F0 - k d_z) [+ k_solid (d_solid - d_z) beyond solid]
//! ```
//!
//! where the fading factor `f = t³ (10 - 15t + 6t²)` with `t = min(1, F / (0.05 F0))` acts on shear and
//! damping alone: a coil off its seat carries neither. The force acts at A and its reaction on the other body
//! at the same place, so that momentum and angular momentum are kept. Units: m, N, s.
//!
//! Energy: `½ k (F0/k - d_z)²` while the spring is on its seat, the solid coil's, and the shear's `½ k_s f
//! |d_s|²`. The force without damping is its gradient at any pose, so that the coil gives back exactly what it
//! takes, also where it leaves its seat and comes down aside of its nominal place: there the seat pushes it
//! up by the term with f', which is the work that the shear takes. The power lost is `c f |ḋ|²`, never
//! negative.
//!
//! Defects: a coil that comes down aside of its nominal place does not stand there with a new one, but is
//! sheared again. No moment by rotation of the seats, no change of shear stiffness with compression; the
//! stiffness jumps at solid height and at lift-off.

use numerics::scalar::Real;

use super::unilateral_energy;
use crate::element::{Element, Inputs, Wrench};
use crate::link::RelativeMotion;
use crate::vector::Vector;

/// The share of the preload below which shear and damping fade.
const FADING: f64 = 0.05;

/// The solid height of a coil.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Solid {
    /// The displacement along z at which it does, m: negative.
    pub at: f64,
    /// The stiffness beyond, in addition to the coil's, N/m.
    pub stiffness: f64,
}

/// A coil spring on a seat.
#[derive(Clone, Debug, PartialEq)]
pub struct ShearSpring {
    /// Its name in results.
    pub name: String,
    /// Load at the nominal place, N: positive.
    pub preload: f64,
    /// Stiffness along z, N/m: positive.
    pub stiffness: f64,
    /// Stiffness along x and y, N/m.
    pub shear_stiffness: f64,
    /// Damping in all directions, N·s/m.
    pub damping: f64,
    /// Its solid height, if it has one.
    pub solid: Option<Solid>,
}

impl ShearSpring {
    /// Returns the load of the coil alone (N) at a displacement along z (m): never negative.
    #[inline(always)]
    pub fn coil_load<S: Real>(&self, displacement: S) -> S {
        let load = -displacement * self.stiffness + self.preload;
        if load.value() > 0.0 { load } else { S::zero() }
    }

    /// Returns the load along z (N) at a displacement along z (m), beyond solid height too.
    #[inline(always)]
    pub fn load<S: Real>(&self, displacement: S) -> S {
        let coil = self.coil_load(displacement);
        match self.solid {
            Some(solid) if displacement.value() < solid.at => {
                coil + (-displacement + solid.at) * solid.stiffness
            }
            _ => coil,
        }
    }

    /// Returns the fading factor and its derivative by the coil's load (1/N).
    #[inline(always)]
    fn fading<S: Real>(&self, load: S) -> [S; 2] {
        let full = FADING * self.preload;
        if load.value() >= full {
            [S::from(1.0), S::zero()]
        } else if load.value() > 0.0 {
            let share = load * (1.0 / full);
            let rest = -share + 1.0;
            let square = share * share;
            let fading = square * share * ((share * 6.0 - 15.0) * share + 10.0);
            [fading, square * rest * rest * (30.0 / full)]
        } else {
            [S::zero(); 2]
        }
    }
}

impl Element for ShearSpring {
    fn name(&self) -> &str {
        &self.name
    }

    fn inputs(&self) -> Inputs {
        Inputs::Points
    }

    #[inline(always)]
    fn evaluate<S: Real>(&self, motion: &RelativeMotion<S>) -> Wrench<S> {
        let ([x, y, z], velocity) = (motion.position.0, motion.velocity);
        let [fading, slope] = self.fading(self.coil_load(z));
        let (shear, damping) = (fading * self.shear_stiffness, fading * self.damping);
        let lifted = (x * x + y * y) * slope * (0.5 * self.stiffness * self.shear_stiffness);
        let elastic = Vector([-x * shear, -y * shear, self.load(z) + lifted]);
        let damped: Vector<S> = velocity.scale(damping);
        Wrench {
            force: elastic - damped,
            moment: Vector::zero(),
            powers: [damped.dot(velocity), S::zero()],
        }
    }

    fn energy(&self, motion: &RelativeMotion<f64>) -> f64 {
        let [x, y, z] = motion.position.0;
        let load = self.coil_load(z);
        let [fading, _] = self.fading(load);
        let solid = self
            .solid
            .map_or(0.0, |solid| unilateral_energy(solid.stiffness, solid.at - z));
        0.5 * (load * load / self.stiffness + fading * self.shear_stiffness * (x * x + y * y)) + solid
    }
}
