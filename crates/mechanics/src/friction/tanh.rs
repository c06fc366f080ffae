//! Smoothed Coulomb friction.
//!
//! Equation (Steets 2007, eq. 3-8): `F_t = -μ N tanh(|v|/v0) v/|v|`, and `F_t = -μ N v/v0` in the limit of
//! zero velocity. Units: N in newtons, v and v0 in m/s.
//!
//! Defect: at zero velocity the force is zero, so that a held load never truly sticks but creeps with
//! `v = v0 atanh(|F_t| / μN)`; the law is a stiff dashpot of μN/v0 there. Remedy: [`super::bristle`].
//! Example: with v0 = 0.001 in/s a load of half the limit creeps by 0.00055 in/s.

use numerics::scalar::Number;

use super::{Friction, dot};

/// Returns the friction of a point with the friction limit `limit` = μN (N) and tangential velocity
/// `velocity` (m/s).
#[inline(always)]
#[must_use]
pub fn friction<S: Number>(limit: S, reference_speed: f64, velocity: [S; 2]) -> Friction<S> {
    let scale = 1.0 / reference_speed;
    let w = [velocity[0] * scale, velocity[1] * scale];
    let s = dot(w, w);
    let factor = -(limit * s.tanh_ratio());
    let force = [w[0] * factor, w[1] * factor];
    Friction {
        force,
        rate: [S::zero(); 2],
        loss: -dot(force, velocity),
        load: s.plain().sqrt(),
    }
}
