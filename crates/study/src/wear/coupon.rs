//! A coupon of a wedge's face that slides to and fro under a clamp, as in the test of AAR M-980: what it
//! loses by Archard's law, and the wear coefficient that a measured loss means.
//!
//! With the load N, the amplitude A and n cycles the coupon slides s = 4 A n under N, so that
//! `V = K N s / H` and `K = V H / (N s)`; friction takes `E = μ N s`.
//!
//! Amplitude, cycles and clamp of [`Coupon::M_980`] are remembered (AAR M-980, friction castings of
//! trucks): check them against your edition. The area of a coupon's face is not known to us: a depth needs
//! it.
//!
//! Limits: those of the law ([`Archard`]); a sine and a triangle of one amplitude slide the same way. A
//! coupon runs warm and keeps its debris, a wedge in service does neither: K of one is not that of the
//! other.

use super::archard::Archard;

/// A coupon under a clamp.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Coupon {
    /// Amplitude of the motion, m.
    pub amplitude: f64,
    /// Number of cycles.
    pub cycles: f64,
    /// Normal load, N.
    pub clamp: f64,
}

impl Coupon {
    /// The test of AAR M-980: 0.5 in to each side, 100,000 cycles, 750 lbf; remembered.
    pub const M_980: Self = Self {
        amplitude: 0.5 * 0.0254,
        cycles: 1e5,
        clamp: 750.0 * 4.448_221_615_260_5,
    };

    /// Returns load times path, J.
    #[must_use]
    pub fn load_times_path(&self) -> f64 {
        self.clamp * 4.0 * self.amplitude * self.cycles
    }

    /// Returns the worn volume, m³.
    #[must_use]
    pub fn volume(&self, law: &Archard) -> f64 {
        law.volume(self.load_times_path())
    }

    /// Returns the wear coefficient by which this volume (m³) is worn, with a hardness in Pa.
    #[must_use]
    pub fn coefficient(&self, volume: f64, hardness: f64) -> f64 {
        volume * hardness / self.load_times_path()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::TAU;

    /// The path by a sum over the cycle's velocity, and the coefficient of the volume that another has
    /// worn.
    #[test]
    fn analytic_volume_and_coefficient_are_of_one_law() {
        let own = Coupon::M_980;
        let steps = 100_000;
        let path: f64 = (0..steps)
            .map(|step| {
                let phase = (f64::from(step) + 0.5) / f64::from(steps);
                (own.amplitude * TAU * (TAU * phase).cos()).abs() / f64::from(steps)
            })
            .sum();
        let sum = own.clamp * path * own.cycles;
        assert!((own.load_times_path() / sum - 1.0).abs() < 1e-8);
        // 750 lbf over 200,000 in.
        assert!((own.load_times_path() / (750.0 * 2e5 * 0.112_984_829) - 1.0).abs() < 1e-8);
        for coefficient in [1e-6, 1e-4, 3e-3] {
            let law = Archard {
                coefficient,
                hardness: 2e9,
            };
            let again = own.coefficient(own.volume(&law), law.hardness);
            assert!((again / coefficient - 1.0).abs() < 1e-14);
        }
    }
}
