//! Shen, Hedrick and Elkins (1983): Kalker's linear forces, saturated by the cubic of Johnson and Vermeulen.
//!
//! With F the size of the linear force and `u = F / (μN)`, the forces are multiplied by
//! `1 - u/3 + u²/27` for u below 3 and by `1/u` beyond. The spin moment stays linear.
//!
//! Defects: spin enters by its linear force alone, which is too large at the large spin of flange contacts. The
//! second derivative jumps at u = 3.

use numerics::scalar::Real;

use super::{CreepForces, Creepage, Patch, linear};

/// Returns the creep forces.
#[inline(always)]
pub fn forces<S: Real>(patch: &Patch<S>, creepage: &Creepage<S>) -> CreepForces<S> {
    let linear = linear::forces(patch, creepage);
    let limit = patch.limit();
    if limit.value() <= 0.0 {
        return CreepForces::none();
    }
    let square = linear.x * linear.x + linear.y * linear.y;
    if square.value() == 0.0 {
        return linear;
    }
    let u = square.sqrt() / limit;
    let factor = if u.value() < 3.0 {
        u * (u * (1.0 / 27.0) - 1.0 / 3.0) + 1.0
    } else {
        u.recip()
    };
    CreepForces {
        x: linear.x * factor,
        y: linear.y * factor,
        spin_moment: linear.spin_moment,
    }
}
