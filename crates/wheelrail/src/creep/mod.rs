//! Creep forces: the tangential forces of rolling contact, by law.
//!
//! Creepages are velocities of the wheel's material relative to the rail at the contact over the rolling
//! speed, spin is the relative angular velocity about the normal over the rolling speed (1/m). Forces act on
//! the wheel; they oppose the creepages. The semi-axis a lies along the rolling direction, always.

pub mod fastsim;
pub mod kalker;
pub mod linear;
pub mod polach;
pub mod shen_hedrick_elkins;
pub mod strips;

use numerics::scalar::Real;

pub use kalker::Coefficients;

use crate::hertz::Hertz;

/// Creepages and spin.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Creepage<S> {
    /// Longitudinal creepage ξx.
    pub longitudinal: S,
    /// Lateral creepage ξy.
    pub lateral: S,
    /// Spin φ, 1/m.
    pub spin: S,
}

/// Forces on the wheel in the plane of contact, and the moment about its normal.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CreepForces<S> {
    /// Along the rolling direction, N.
    pub x: S,
    /// Across it, N.
    pub y: S,
    /// About the normal, N·m.
    pub spin_moment: S,
}

impl<S: Real> CreepForces<S> {
    /// No forces.
    #[must_use]
    pub fn none() -> Self {
        let zero = S::zero();
        Self {
            x: zero,
            y: zero,
            spin_moment: zero,
        }
    }
}

/// A loaded contact patch.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Patch<S> {
    /// Semi-axes along and across the rolling direction, m.
    pub axes: [S; 2],
    /// Load, N: positive.
    pub load: S,
    /// Coefficient of friction.
    pub friction: S,
    /// Shear modulus, Pa.
    pub shear_modulus: f64,
    /// Kalker's coefficients.
    pub coefficients: Coefficients<S>,
}

impl<S: Real> Patch<S> {
    /// Returns the patch of a contact under a load (N, positive).
    pub fn new(hertz: &Hertz, load: S, friction: f64) -> Self {
        let axes = hertz.semi_axes(load);
        // The ratio of the axes does not depend on the load.
        let ratio = S::from(hertz.axes[0] / hertz.axes[1]);
        Self {
            axes,
            load,
            friction: S::from(friction),
            shear_modulus: hertz.material.shear_modulus(),
            coefficients: Coefficients::of(ratio, hertz.material.poisson),
        }
    }

    /// Returns the greatest friction force μN, N.
    #[inline(always)]
    pub fn limit(&self) -> S {
        self.load * self.friction
    }
}
