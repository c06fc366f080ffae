//! A band-pass filter without phase.

use std::f64::consts::SQRT_2;

use super::{LowPass, TooCoarse};

/// A band-pass filter of fourth order at both ends without phase: a low-pass filter ([`LowPass`]) of what
/// another one takes away.
///
/// Values less what a low-pass of cutoff f passes are values through a high-pass. With c = √2 - 1 and
/// r = tan πFΔ / tan πfΔ at the frequency F its gain is `1 - 1/(1 + c r⁴) = 1/(1 + 1/(c r⁴))`. That is to be
/// `1/(1 + c (tan πf₁Δ / tan πFΔ)⁴)`, -3 dB at the lower end f₁: hence `tan πfΔ = √c tan πf₁Δ`.
///
/// Limits: as those of [`LowPass`]. What the continuation at the ends excites takes some periods of f₁ to die
/// away.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BandPass {
    low: LowPass,
    high: LowPass,
}

impl BandPass {
    /// Returns the filter for rows `interval` apart (s) with these ends of its band (Hz, the lower one first,
    /// both positive), each with -3 dB.
    ///
    /// # Errors
    /// [`TooCoarse`]: a period of the upper end has fewer than four rows.
    pub fn new(interval: f64, [low, high]: [f64; 2]) -> Result<Self, TooCoarse> {
        let turn = std::f64::consts::PI * interval;
        let tangent = libm::sqrt(SQRT_2 - 1.0) * libm::tan(turn * low);
        Ok(Self {
            high: LowPass::new(interval, high)?,
            low: LowPass::new(interval, libm::atan(tangent) / turn)?,
        })
    }

    /// Returns the gain for a sine of this frequency, Hz.
    #[must_use]
    pub fn gain(&self, frequency: f64) -> f64 {
        self.high.gain(frequency) * (1.0 - self.low.gain(frequency))
    }

    /// Returns the filtered values.
    #[must_use]
    pub fn apply(&self, values: &[f64]) -> Vec<f64> {
        let slow = self.low.apply(values);
        let fast: Vec<f64> = values.iter().zip(slow).map(|(own, slow)| own - slow).collect();
        self.high.apply(&fast)
    }
}
