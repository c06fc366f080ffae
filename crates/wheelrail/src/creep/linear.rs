//! Kalker's linear theory (Kalker 1967).
//!
//! ```text
//! Fx = -G a b C11 ξx,   Fy = -G a b (C22 ξy + √(ab) C23 φ),   Mz = -G a b (-√(ab) C23 ξy + a b C33 φ)
//! ```
//!
//! Limits: no saturation; right for creepages far below `μN / (G a b C)`.

use numerics::scalar::Real;

use super::{CreepForces, Creepage, Patch};

/// Returns the creep forces.
#[inline(always)]
pub fn forces<S: Real>(patch: &Patch<S>, creepage: &Creepage<S>) -> CreepForces<S> {
    let [a, b] = patch.axes;
    let c = &patch.coefficients;
    let area = a * b;
    let (size, stiffness) = (area.sqrt(), area * patch.shear_modulus);
    CreepForces {
        x: -(stiffness * c.c11 * creepage.longitudinal),
        y: -(stiffness * (c.c22 * creepage.lateral + size * c.c23 * creepage.spin)),
        spin_moment: stiffness * (size * c.c23 * creepage.lateral - area * c.c33 * creepage.spin),
    }
}
