//! Power spectral densities by Welch's method.

use std::f64::consts::PI;

use thiserror::Error;

/// The fewest rows of a segment.
pub const FEWEST_ROWS: usize = 8;

/// A one-sided power spectral density: its integral over the frequency is the variance.
///
/// By Welch's method (P. D. Welch, IEEE Transactions on Audio and Electroacoustics 15, 1967, pages 70 to 73):
/// the mean of the periodograms of segments that overlap by half, each less its own mean and under Hann's
/// window. Segments have a power of two of rows; what is left at the end is not used.
#[derive(Clone, Debug, PartialEq)]
pub struct Spectrum {
    /// Frequencies from 0 to half the rate of the rows, Hz.
    pub frequencies: Vec<f64>,
    /// Density at each, in the square of the values' unit per Hz.
    pub density: Vec<f64>,
    /// Number of segments.
    pub segments: usize,
    /// Rows of a segment.
    pub rows: usize,
}

/// Reasons why there is none.
#[derive(Clone, Debug, PartialEq, Error)]
pub enum SpectrumError {
    /// Not as many rows as a segment needs.
    #[error("{rows} rows are too few: a segment of {needed} rows is wanted")]
    TooShort {
        /// Rows that there are.
        rows: usize,
        /// Rows that a segment needs.
        needed: usize,
    },
    /// The rows are not evenly apart.
    #[error("rows are not evenly apart: {least} s at one place, {most} s at another")]
    Uneven {
        /// Least time between two rows, s.
        least: f64,
        /// Greatest time between two rows, s.
        most: f64,
    },
    /// The resolution is no frequency that rows can have.
    #[error("a resolution of {resolution} Hz is not possible: it must be positive, and at most {most} Hz")]
    Resolution {
        /// As asked for, Hz.
        resolution: f64,
        /// The coarsest one, Hz.
        most: f64,
    },
}

impl Spectrum {
    /// Returns the spectrum of values at `times` (s), which must be evenly apart within a thousandth. Without
    /// a `resolution` (Hz between two frequencies at most) segments are as long as at least eight of them go
    /// into the rows.
    ///
    /// # Errors
    /// See [`SpectrumError`].
    pub fn welch(times: &[f64], values: &[f64], resolution: Option<f64>) -> Result<Self, SpectrumError> {
        let count = times.len().min(values.len());
        let too_short = |needed| Err(SpectrumError::TooShort { rows: count, needed });
        if count < FEWEST_ROWS {
            return too_short(FEWEST_ROWS);
        }
        let steps = times.windows(2).map(|pair| pair[1] - pair[0]);
        let [least, most] = [
            steps.clone().fold(f64::INFINITY, f64::min),
            steps.fold(f64::NEG_INFINITY, f64::max),
        ];
        let step = (times[count - 1] - times[0]) / (count - 1) as f64;
        let even = most - least <= 1e-3 * step;
        if !even {
            return Err(SpectrumError::Uneven { least, most });
        }
        let rows = match resolution {
            None => (previous_power_of_two(2 * count / 9)).max(FEWEST_ROWS),
            Some(resolution) => {
                let most = 1.0 / (step * FEWEST_ROWS as f64);
                if !(resolution > 0.0 && resolution <= most * (1.0 + 1e-9)) {
                    return Err(SpectrumError::Resolution { resolution, most });
                }
                // Rounding must not double it.
                let wanted = (1.0 / (step * resolution) * (1.0 - 1e-9)).ceil();
                if wanted > count as f64 {
                    return too_short(wanted as usize);
                }
                (wanted as usize).next_power_of_two()
            }
        };
        if rows > count {
            return too_short(rows);
        }
        Ok(Self::of_segments(&values[..count], rows, step))
    }

    /// Makes it of segments of so many rows, a power of two.
    fn of_segments(values: &[f64], rows: usize, step: f64) -> Self {
        let window: Vec<f64> = (0..rows)
            .map(|row| 0.5 - 0.5 * libm::cos(2.0 * PI * row as f64 / rows as f64))
            .collect();
        let power: f64 = window.iter().map(|weight| weight * weight).sum();
        let half = rows / 2;
        let segments = (values.len() - rows) / half + 1;
        let mut density = vec![0.0; half + 1];
        let mut transformed = vec![[0.0; 2]; rows];
        for segment in 0..segments {
            let own = &values[segment * half..][..rows];
            let mean = own.iter().sum::<f64>() / rows as f64;
            for ((value, weight), target) in own.iter().zip(&window).zip(&mut transformed) {
                *target = [(value - mean) * weight, 0.0];
            }
            transform(&mut transformed);
            for (sum, [re, im]) in density.iter_mut().zip(&transformed) {
                *sum += re * re + im * im;
            }
        }
        // Both sides of the frequencies are folded into one, but for the ends, which have one side only.
        for (place, sum) in density.iter_mut().enumerate() {
            let sides = if place == 0 || place == half { 1.0 } else { 2.0 };
            *sum *= sides * step / (power * segments as f64);
        }
        Self {
            frequencies: (0..=half)
                .map(|place| place as f64 / (rows as f64 * step))
                .collect(),
            density,
            segments,
            rows,
        }
    }

    /// Returns the distance of two frequencies, Hz.
    #[must_use]
    pub fn resolution(&self) -> f64 {
        self.frequencies[1]
    }

    /// Returns the sum of the density times the distance of frequencies: the variance about the segments'
    /// means, weighted by the window.
    #[must_use]
    pub fn variance(&self) -> f64 {
        self.density.iter().sum::<f64>() * self.resolution()
    }

    /// Returns the frequency (Hz) with the greatest density.
    #[must_use]
    pub fn peak(&self) -> f64 {
        self.peak_within([0.0, f64::INFINITY]).unwrap_or(0.0)
    }

    /// Returns the frequency (Hz) with the greatest density from a lowest to a highest one; none where there
    /// is no frequency between them.
    #[must_use]
    pub fn peak_within(&self, [lowest, highest]: [f64; 2]) -> Option<f64> {
        let pairs = self.frequencies.iter().zip(&self.density);
        let within = pairs.filter(|(frequency, _)| (lowest..=highest).contains(*frequency));
        let peak = within.max_by(|a, b| a.1.total_cmp(b.1));
        peak.map(|(frequency, _)| *frequency)
    }
}

fn previous_power_of_two(count: usize) -> usize {
    1 << count.max(1).ilog2()
}

/// Fourier's transform `Σ x[k] exp(-2πi jk/n)` of n = 2^m complex numbers in place, after Cooley and Tukey.
fn transform(x: &mut [[f64; 2]]) {
    let n = x.len();
    let bits = n.trailing_zeros();
    for i in 0..n {
        let j = i.reverse_bits() >> (usize::BITS - bits);
        if i < j {
            x.swap(i, j);
        }
    }
    let mut length = 2;
    while length <= n {
        let half = length / 2;
        for k in 0..half {
            let angle = -2.0 * PI * k as f64 / length as f64;
            let (sine, cosine) = (libm::sin(angle), libm::cos(angle));
            for first in (k..n).step_by(length) {
                let [a, b] = x[first + half];
                let turned = [a * cosine - b * sine, a * sine + b * cosine];
                let [re, im] = x[first];
                x[first] = [re + turned[0], im + turned[1]];
                x[first + half] = [re - turned[0], im - turned[1]];
            }
        }
        length *= 2;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The definition, term by term.
    #[test]
    fn analytic_the_transform_is_its_sum() {
        let n = 16;
        let values: Vec<[f64; 2]> = (0..n)
            .map(|k| [libm::sin(1.7 * k as f64), libm::cos(0.3 * (k * k) as f64)])
            .collect();
        let mut found = values.clone();
        transform(&mut found);
        for (j, found) in found.iter().enumerate() {
            let mut sum = [0.0; 2];
            for (k, [re, im]) in values.iter().enumerate() {
                let angle = -2.0 * PI * (j * k) as f64 / n as f64;
                let (sine, cosine) = (libm::sin(angle), libm::cos(angle));
                sum = [sum[0] + re * cosine - im * sine, sum[1] + re * sine + im * cosine];
            }
            assert!((found[0] - sum[0]).abs() < 1e-13 && (found[1] - sum[1]).abs() < 1e-13);
        }
    }
}
