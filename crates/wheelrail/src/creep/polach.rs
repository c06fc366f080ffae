//! Polach (1999, 2005): a closed form for creepages with spin.
//!
//! With s the size of the creepage, `C = √((C11 ξx)² + (C22 ξy)²) / s` and s_c the creepage that includes
//! spin,
//!
//! ```text
//! ε = (π/4) G a b C s_c / (μN),   F = (2 μN/π) (kA ε / (1 + (kA ε)²) + atan(kS ε))
//! Fx = -F ξx / s_c,   Fy = -(F ξy + F_spin φ) / s_c
//! ```
//!
//! with `F_spin = (9/16) a μN K (e (-δ³/3 + δ²/2 - 1/6) + (1 - δ²)^1.5 / 3)`, `K = 1 + 6.3 (1 - exp(-a/b))`,
//! `e = (8/3) G b √(ab) C23 |s_y| / (μN K)`, `δ = (e² - 1)/(e² + 1)`. At small creepages the longitudinal
//! force is Kalker's.
//!
//! Deviations from the paper, so that derivatives exist: the lateral creepage with spin, there the larger one
//! of
//! |ξy| and |ξy + φ a|, is a smooth maximum, at most 1 % larger; creepages of 1e-8 are added to roots.
//!
//! The paper gives no spin moment. Here `Mz = F_spin ξy / s_c - G (a b)² C33 φ g` with the factor g by which
//! the force is smaller than Kalker's. Its first term takes no power together with the spin's part of Fy, as
//! in linear theory, so that the law never gives power.
//!
//! Forces are cut off at μN, which spin on a slender ellipse exceeds by a little.
//!
//! Defects: the force opposes the creepage; Kalker's is turned where C11 and C22 differ and the creepage is
//! oblique (the sizes agree). The force does not saturate fully (0.96 μN at twice the creepage of linear
//! saturation) unless kS is larger than kA. The reduction factors for wet and dry rails (kA, kS) are
//! remembered from the literature, unverified.

use std::f64::consts::{FRAC_PI_4, PI};

use numerics::scalar::Real;

use super::{CreepForces, Creepage, Patch};

/// Factors of the slope at zero creepage in the area of adhesion and of slip.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Reduction {
    /// kA.
    pub adhesion: f64,
    /// kS, at most kA.
    pub slip: f64,
}

/// No reduction: clean, dry rails.
pub const DRY: Reduction = Reduction {
    adhesion: 1.0,
    slip: 1.0,
};

/// Width of the smooth maximum, as a share of the values.
const SMOOTHING: f64 = 0.02;
/// Square of the creepage that is added to roots.
const SMALL: f64 = 1e-16;

/// Returns the creep forces.
#[inline(always)]
pub fn forces<S: Real>(patch: &Patch<S>, creepage: &Creepage<S>, reduction: Reduction) -> CreepForces<S> {
    let [a, b] = patch.axes;
    let (c, limit) = (&patch.coefficients, patch.limit());
    if limit.value() <= 0.0 {
        return CreepForces::none();
    }
    let (x, y) = (creepage.longitudinal, creepage.lateral);
    let with_spin = y + creepage.spin * a;
    let (own, other) = (y * y, with_spin * with_spin);
    let difference = own - other;
    let sum = own + other;
    let lateral_square =
        (sum + (difference * difference + sum * sum * (SMOOTHING * SMOOTHING) + SMALL * SMALL).sqrt()) * 0.5;
    let total = (x * x + lateral_square + SMALL).sqrt();
    // Kalker's coefficient in the direction of the creepage.
    let weighted = (c.c11 * x) * (c.c11 * x) + c.c22 * c.c22 * (y * y + SMALL);
    let coefficient = (weighted / (x * x + y * y + SMALL)).sqrt();
    let stiffness = a * b * (patch.shear_modulus * FRAC_PI_4);
    let gradient = stiffness * coefficient * total / limit;
    let adhesion = gradient * reduction.adhesion;
    let slip = gradient * reduction.slip;
    let angle = slip.chain(
        libm::atan(slip.value()),
        1.0 / (1.0 + slip.value() * slip.value()),
    );
    let force = limit * (2.0 / PI) * (adhesion / (adhesion * adhesion + 1.0) + angle);
    let spin = spin_force(patch, lateral_square.sqrt());
    let saturation = force / (total * stiffness * coefficient * (4.0 / PI));
    let (mut fx, mut fy) = (-(force * x) / total, -(force * y + spin * creepage.spin) / total);
    let mut coupling = spin * y / total;
    let size = fx * fx + fy * fy;
    if size.value() > limit.value() * limit.value() {
        let factor = limit / size.sqrt();
        (fx, fy) = (fx * factor, fy * factor);
        coupling = coupling * factor;
    }
    CreepForces {
        x: fx,
        y: fy,
        spin_moment: coupling - (a * b) * (a * b) * c.c33 * creepage.spin * saturation * patch.shear_modulus,
    }
}

/// Returns F_spin (N·m) at a lateral creepage with spin.
#[inline(always)]
fn spin_force<S: Real>(patch: &Patch<S>, lateral: S) -> S {
    let [a, b] = patch.axes;
    let limit = patch.limit();
    let factor = S::from(1.0 + 6.3) - (-(a / b)).exp() * 6.3;
    let e = b * (a * b).sqrt() * patch.coefficients.c23 * lateral * (8.0 / 3.0 * patch.shear_modulus)
        / (limit * factor);
    let square = e * e;
    let d = (square - 1.0) / (square + 1.0);
    // (1 - δ²)^1.5 = (2e / (e² + 1))³
    let root = e * 2.0 / (square + 1.0);
    let bracket = e * (d * d * 0.5 - d * d * d * (1.0 / 3.0) - 1.0 / 6.0) + root * root * root * (1.0 / 3.0);
    a * limit * factor * bracket * (9.0 / 16.0)
}
