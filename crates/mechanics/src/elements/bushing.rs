//! A bushing: springs and dampers along and about the axes of marker B, with a load in the nominal layout.
//!
//! With d the position of marker A from B in the axes of B, v its rate, ω the angular velocity and R the
//! rotation of A relative to B, force and moment on A are
//!
//! ```text
//! F_i = P_i - k_i d_i - c_i v_i
//! M   = Σ_i (L_i - κ_i θ_i) g_i - γ_i ω_i e_i,   θ_i = ½ (R_kj - R_jk),   g_i = ½ (tr R e_i - Σ_j R_ij e_j)
//! ```
//!
//! with (i, j, k) cyclic: θ are the small rotations (`sin` of the angle times its axis), `g_i · ω` their
//! rates. The elastic part is the gradient of `½ Σ (k_i d_i² + κ_i θ_i²) - Σ (P_i d_i + L_i θ_i)` at any
//! pose, so that the ledger closes; the powers lost are `c_i v_i²` and `γ_i ω_i²`. Units: m, N, s, rad.
//!
//! Defects: the moment about one axis is `κ sin φ cos φ`, 2 % less than κφ at 10°, and falls beyond 45°; axes
//! do not couple. Remedy for long ways: a [`Strut`](super::Strut), for large angles none.

use numerics::scalar::Real;

use crate::element::{Element, Wrench};
use crate::link::RelativeMotion;
use crate::vector::Vector;

/// A bushing between markers that coincide in the nominal layout.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Bushing {
    /// Its name in results.
    pub name: String,
    /// Force on the body with marker A in the nominal layout, N.
    pub load: [f64; 3],
    /// Stiffness along x, y, z, N/m.
    pub stiffness: [f64; 3],
    /// Damping along x, y, z, N·s/m.
    pub damping: [f64; 3],
    /// Moment on the body with marker A in the nominal layout, N·m.
    pub rotational_load: [f64; 3],
    /// Stiffness about x, y, z, N·m/rad.
    pub rotational_stiffness: [f64; 3],
    /// Damping about x, y, z, N·m·s/rad.
    pub rotational_damping: [f64; 3],
}

/// Returns the vector with each component multiplied.
#[inline(always)]
fn by<S: Real>(factors: [f64; 3], vector: Vector<S>) -> Vector<S> {
    Vector([0, 1, 2].map(|i| vector.0[i] * factors[i]))
}

impl Element for Bushing {
    fn name(&self) -> &str {
        &self.name
    }

    #[inline(always)]
    fn evaluate<S: Real>(&self, motion: &RelativeMotion<S>) -> Wrench<S> {
        let (velocity, spin) = (motion.velocity, motion.angular_velocity);
        let damped = by(self.damping, velocity);
        let turned = by(self.rotational_damping, spin);
        let given = Vector(self.rotational_load.map(S::from));
        let torques = by(self.rotational_stiffness, motion.small_rotations()) - given;
        let r = &motion.rotation.0;
        let trace = r[0][0] + r[1][1] + r[2][2];
        let mut elastic = Vector::<S>::zero();
        for i in 0..3 {
            for j in 0..3 {
                elastic.0[j] -= torques.0[i] * r[i][j] * 0.5;
            }
            elastic.0[i] += torques.0[i] * trace * 0.5;
        }
        Wrench {
            force: Vector(self.load.map(S::from)) - by(self.stiffness, motion.position) - damped,
            moment: -elastic - turned,
            powers: [damped.dot::<S, S>(velocity) + turned.dot::<S, S>(spin), S::zero()],
        }
    }

    fn energy(&self, motion: &RelativeMotion<f64>) -> f64 {
        let (way, turn) = (motion.position, motion.small_rotations());
        let along = way.dot::<f64, f64>(by(self.stiffness, way));
        let about = turn.dot::<f64, f64>(by(self.rotational_stiffness, turn));
        let given = turn.dot::<f64, f64>(Vector(self.rotational_load));
        0.5 * (along + about) - way.dot::<f64, f64>(Vector(self.load)) - given
    }
}
