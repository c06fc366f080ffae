//! Shen, Hedrick and Elkins (1983): Kalker's linear forces, saturated by the cubic of Johnson and Vermeulen.
//!
//! With F the size of the linear force and `u = F / (μN)`, the forces are multiplied by `1 - u/3 + u²/27` for
//! u below 3 and by `1/u` beyond. So is the spin moment, in a deviation from programs that leave it linear:
//! with the factor f and the law's forces, an unreduced moment takes the power (over G a b V)
//!
//! ```text
//! f (C11 ξx² + C22 ξy²) - (1 - f) √(ab) C23 ξy φ + a b C33 φ²
//! ```
//!
//! which is negative for some ξy φ > 0 wherever `(1 - f)² C23² > 4 f C22 C33`: on round ellipses below f =
//! 0.1, far beyond saturation, but on ellipses of 10:1 along the rolling direction from f = 0.7 on, at a load
//! factor u of 1 where hardly anything slips. Creep forces would then drive the vehicle. With all three
//! reduced the power is f times that of linear theory, whose terms with C23 cancel: never negative.
//!
//! Defects: spin enters by its linear force alone, which is too large at the large spin of flange contacts.
//! The second derivative jumps at u = 3.

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
        spin_moment: linear.spin_moment * factor,
    }
}
