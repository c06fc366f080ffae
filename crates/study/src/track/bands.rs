//! Wavelength bands of track geometry: D1, D2, D3 after EN 13848-1, and what of a track lies in them.
//!
//! The band-pass has -3 dB at both ends, falls with the fourth power of the wavelength ratio, and shifts
//! nothing: `G(λ) = 1/(1 + a (λs/λ)⁴) · 1/(1 + a (λ/λl)⁴)`, `a = √2 - 1`, for the shortest and longest
//! wavelengths λs, λl; of rows Δ apart tan(πΔ/λ) stands for 1/λ, which is more by a tenth at six rows a
//! wavelength. Bands and order of the filter are remembered from EN 13848-1, not read there; D3 ends
//! at 150 m here (profile; alignment may go to 200 m). The filter continues a track at its ends by
//! reflection, so that values within one longest wavelength of them are uncertain: deviations leave them out
//! where [`SECTION`] remains.

use crate::signal::{BandPass, LowPass};

/// A band of wavelengths.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Band {
    /// Its name.
    pub name: &'static str,
    /// The shortest and the longest wavelength, m.
    pub wavelengths: [f64; 2],
}

/// The bands of EN 13848-1.
pub const BANDS: [Band; 3] = [
    Band {
        name: "D1",
        wavelengths: [3.0, 25.0],
    },
    Band {
        name: "D2",
        wavelengths: [25.0, 70.0],
    },
    Band {
        name: "D3",
        wavelengths: [70.0, 150.0],
    },
];

/// Length over which standard deviations are compared with limits, m.
pub const SECTION: f64 = 200.0;

/// The standard deviations of values in a band.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BandDeviation {
    /// Over the track without its uncertain ends, in the unit of the values.
    pub whole: f64,
    /// The largest over [`SECTION`], and the distance of the section's middle, m; that of the whole track if
    /// it is shorter.
    pub worst: [f64; 2],
}

/// Returns values at equal distances (m) within a band of wavelengths (m, shortest and longest). `None` if
/// the rows are farther apart than a quarter of the shortest one.
#[must_use]
pub fn in_band(values: &[f64], spacing: f64, [shortest, longest]: [f64; 2]) -> Option<Vec<f64>> {
    let band = BandPass::new(spacing, [1.0 / longest, 1.0 / shortest]).ok()?;
    Some(band.apply(values))
}

/// Returns the standard deviations of values at equal distances (m, from zero) within a band.
#[must_use]
pub fn deviation(values: &[f64], spacing: f64, band: Band) -> Option<BandDeviation> {
    let filtered = in_band(values, spacing, band.wavelengths)?;
    let count = filtered.len();
    // Sums of values and of squares before each row.
    let mut sums = Vec::with_capacity(count + 1);
    let mut sum = [0.0; 2];
    sums.push(sum);
    for own in &filtered {
        sum = [sum[0] + own, sum[1] + own * own];
        sums.push(sum);
    }
    let over = |from: usize, to: usize| {
        let rows = (to - from).max(1) as f64;
        let [mean, square] = [0, 1].map(|k: usize| (sums[to][k] - sums[from][k]) / rows);
        (square - mean * mean).max(0.0).sqrt()
    };
    let rows = ((SECTION / spacing).round() as usize).clamp(1, count.max(1));
    let ends = ((band.wavelengths[1] / spacing).ceil() as usize).min(count.saturating_sub(rows) / 2);
    let middle = |from: usize| (from as f64 + 0.5 * rows as f64) * spacing;
    let mut worst = [0.0; 2];
    for from in ends..=count.saturating_sub(rows + ends) {
        let own = over(from, (from + rows).min(count));
        if own > worst[0] {
            worst = [own, middle(from)];
        }
    }
    Some(BandDeviation {
        whole: over(ends, count - ends),
        worst,
    })
}

/// Returns the share of the standard deviation of values at equal distances (m) that lies in wavelengths more
/// than three times as long as `longest` (m): next to nothing where they were filtered to that.
#[must_use]
pub(super) fn share_beyond(values: &[f64], spacing: f64, longest: f64) -> Option<f64> {
    let long = LowPass::new(spacing, 1.0 / (3.0 * longest)).ok()?.apply(values);
    // Without the ends, where the continuation has long waves of its own.
    let ends = ((3.0 * longest / spacing).ceil() as usize).min(values.len() / 4);
    let size = |values: &[f64]| {
        let middle = &values[ends..values.len() - ends];
        middle.iter().map(|own| own * own).sum::<f64>().sqrt()
    };
    let whole = size(values);
    (whole > 0.0).then(|| size(&long) / whole)
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::TAU;

    fn sine(wavelength: f64) -> Vec<f64> {
        (0..8000)
            .map(|k| (TAU * 0.25 * f64::from(k) / wavelength).sin())
            .collect()
    }

    /// The gain of the band-pass, from sines in the middle of 2 km; 1/√2 at both ends of each band.
    #[test]
    fn analytic_bands_pass_what_their_formula_says() {
        let a = std::f64::consts::SQRT_2 - 1.0;
        for Band { name, wavelengths } in BANDS {
            let [short, long] = wavelengths;
            for wavelength in [
                short,
                (short * long).sqrt(),
                long,
                0.5 * short.max(4.0),
                2.0 * long,
            ] {
                let passed = in_band(&sine(wavelength), 0.25, wavelengths).unwrap();
                let middle = &passed[3000..5000];
                let found = middle.iter().fold(0.0_f64, |most, own| most.max(own.abs()));
                let tangent = |wavelength: f64| (0.5 * TAU * 0.25 / wavelength).tan();
                let side = |of: f64, to: f64| 1.0 / (1.0 + a * (tangent(of) / tangent(to)).powi(4));
                let expected = side(wavelength, short) * side(long, wavelength);
                assert!(
                    (found - expected).abs() < 0.01,
                    "{name} {wavelength}: {found} {expected}"
                );
            }
        }
    }

    /// A sine of 10 m and 4 mm has 4/√2 mm in D1, over any 200 m, and nothing in D3.
    #[test]
    fn analytic_deviations_of_a_sine() {
        let values: Vec<f64> = sine(10.0).iter().map(|own| 4.0 * own).collect();
        let found = deviation(&values, 0.25, BANDS[0]).unwrap();
        for own in [found.whole, found.worst[0]] {
            assert!((own - 2.82).abs() < 0.04, "{found:?}");
        }
        assert!(deviation(&values, 0.25, BANDS[2]).unwrap().whole < 0.01);
        assert_eq!(deviation(&values, 1.0, BANDS[0]), None);
        assert!(share_beyond(&values, 0.25, 25.0).unwrap() < 0.01);
        assert!(share_beyond(&sine(200.0), 0.25, 25.0).unwrap() > 0.9);
    }
}
