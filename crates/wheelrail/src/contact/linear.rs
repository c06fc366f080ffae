//! A wheelset with linear contact geometry and linear creep: for stability analyses and their benchmarks.
//!
//! About straight rolling at the speed V, with the lateral shift y at the height of the rails, the yaw ψ, the
//! conicity λ, half the distance of the contacts l, the rolling radius r, and the rate ε of the contact
//! angles:
//!
//! ```text
//! ξx = ∓ (l ψ'/V + λ y / r)       left and right
//! ξy = y'/V - ψ
//! φ  = ψ'/V ∓ (δ0 ± ε y) / r      left and right
//! F  = - 2 f22 ξy - 2 f23 (ψ'/V - ε y / r) - W ε y
//! M  = - 2 f11 l (l ψ'/V + λ y / r) + 2 f23 ξy - 2 f33 (ψ'/V - ε y / r) + W l δ0 ψ
//! ```
//!
//! Terms with f23, f33 are those of spin, terms with the axle load W those of gravity; each group can be left
//! out. Limits: small motions, no saturation, no flange, one speed.

use numerics::scalar::Real;

use crate::conicity::LinearGeometry;
use crate::creep::Patch;

/// Coefficients of one contact, as factors of creepages.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CreepCoefficients {
    /// Longitudinal, N.
    pub f11: f64,
    /// Lateral, N.
    pub f22: f64,
    /// Spin to lateral force, N·m.
    pub f23: f64,
    /// Spin to spin moment, N·m².
    pub f33: f64,
}

impl CreepCoefficients {
    /// Returns Kalker's coefficients of a patch.
    #[must_use]
    pub fn of(patch: &Patch<f64>) -> Self {
        let [a, b] = patch.axes;
        let area = patch.shear_modulus * a * b;
        let mean = (a * b).sqrt();
        let c = &patch.coefficients;
        Self {
            f11: area * c.c11,
            f22: area * c.c22,
            f23: area * mean * c.c23,
            f33: area * mean * mean * c.c33,
        }
    }
}

/// A wheelset with linear geometry and creep.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LinearWheelset {
    /// Its geometry.
    pub geometry: LinearGeometry,
    /// Coefficients of each of its contacts.
    pub creep: CreepCoefficients,
    /// True if spin acts.
    pub spin: bool,
    /// Axle load for gravitational stiffnesses, N; zero leaves them out.
    pub axle_load: f64,
}

impl LinearWheelset {
    /// Returns lateral force (N, to the left) and yaw moment (N·m) on the wheelset from shift (m, to the
    /// left), yaw (rad, to the left), their rates, and the speed (m/s, positive).
    #[inline(always)]
    pub fn forces<S: Real>(
        &self,
        [shift, yaw]: [S; 2],
        [shift_rate, yaw_rate]: [S; 2],
        speed: f64,
    ) -> [S; 2] {
        let LinearGeometry {
            conicity,
            contact_angle,
            contact_angle_rate,
            half_distance,
            radius,
            ..
        } = self.geometry;
        let CreepCoefficients { f11, f22, f23, f33 } = self.creep;
        let turning = yaw_rate * (1.0 / speed);
        let longitudinal = turning * half_distance + shift * (conicity / radius);
        let lateral = shift_rate * (1.0 / speed) - yaw;
        let mut force = lateral * (-2.0 * f22) - shift * (self.axle_load * contact_angle_rate);
        let mut moment = longitudinal * (-2.0 * f11 * half_distance)
            + yaw * (self.axle_load * half_distance * libm::sin(contact_angle));
        if self.spin {
            let spin = turning - shift * (contact_angle_rate / radius);
            force -= spin * (2.0 * f23);
            moment += lateral * (2.0 * f23) - spin * (2.0 * f33);
        }
        [force, moment]
    }
}
