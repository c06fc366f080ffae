//! Mid-chord offsets, by which inspectors measure profile and alignment: 31, 62 and 124 ft chords.
//!
//! `m(s) = y(s) - ½ (y(s - L/2) + y(s + L/2))`. An irregularity of wavelength λ appears multiplied by `1 -
//! cos(π L/λ)`: twice its amplitude at λ = L, nothing at λ = L/2, and little beyond a few chords. So an
//! offset is no profile. Over a band of wavelengths in which that factor is not small, offsets can be
//! inverted.

use std::f64::consts::{FRAC_PI_2, PI, TAU};

use thiserror::Error;

/// Smallest factor that is inverted: errors of measurement grow tenfold.
const LEAST: f64 = 0.1;
/// Width of the band's edge in which waves fade out, as a factor of the wavenumber.
const FADE: f64 = 1.25;
/// Most products of rows and waves: some seconds.
const MOST: f64 = 1e9;

/// The chords of inspectors in North America, m: 31, 62 and 124 ft.
pub const CHORDS: [f64; 3] = [31.0 * 0.3048, 62.0 * 0.3048, 124.0 * 0.3048];

/// Returns the mid-chord offset (m) of an irregularity (m, by distance in m) at a distance, with a chord (m).
pub fn offset(irregularity: impl Fn(f64) -> f64, distance: f64, chord: f64) -> f64 {
    let ends = irregularity(distance - 0.5 * chord) + irregularity(distance + 0.5 * chord);
    irregularity(distance) - 0.5 * ends
}

/// Returns the factor by which a wavelength (m) appears in offsets of a chord (m).
#[must_use]
pub fn transfer(wavelength: f64, chord: f64) -> f64 {
    1.0 - libm::cos(PI * chord / wavelength)
}

/// Reasons why offsets cannot be inverted.
#[derive(Clone, Copy, Debug, PartialEq, Error)]
pub enum ChordError {
    /// The wavelengths are no range, or longer than the data.
    #[error(
        "wavelengths from {shortest} to {longest} m cannot be inverted from {length} m of offsets, \
         {spacing} m apart: the shortest must be at least two spacings, the longest at most the length"
    )]
    Range {
        /// The shortest, m.
        shortest: f64,
        /// The longest, m.
        longest: f64,
        /// Length of the data, m.
        length: f64,
        /// Distance of its rows, m.
        spacing: f64,
    },
    /// The chord does not see a wavelength.
    #[error(
        "offsets of a chord of {chord} m hold a wavelength of {wavelength} m {factor:.3} times only: it \
         cannot be inverted; from {:.1} to {:.1} m it can",
        chord / 1.8, chord * 6.0
    )]
    Insensitive {
        /// The chord, m.
        chord: f64,
        /// The wavelength, m.
        wavelength: f64,
        /// The factor.
        factor: f64,
    },
    /// Too many rows and waves.
    #[error(
        "{rows} rows with {waves} waves between the wavelengths are too many: choose a longer shortest \
         wavelength"
    )]
    Size {
        /// Rows.
        rows: usize,
        /// Waves.
        waves: usize,
    },
}

/// Returns the space curve (m) whose mid-chord offsets (m, `spacing` (m) apart) of a chord (m) these are,
/// over wavelengths from the shortest to the longest one (m). What lies outside of them fades out within a
/// quarter: from the longest one to 1.25 times as long, from the shortest one to 0.8 times as long. The
/// offsets are tapered by `sin²` within `taper` (m) at both ends.
///
/// Each wave of a discrete Fourier series is divided by [`transfer`]; a sharp end of the band would ring
/// along the whole track.
///
/// # Errors
/// [`ChordError`].
pub fn invert(
    offsets: &[f64],
    spacing: f64,
    chord: f64,
    [shortest, longest]: [f64; 2],
    taper: f64,
) -> Result<Vec<f64>, ChordError> {
    let rows = offsets.len();
    let length = rows as f64 * spacing;
    if !(shortest >= 2.0 * spacing && shortest < longest && longest <= length) {
        return Err(ChordError::Range {
            shortest,
            longest,
            length,
            spacing,
        });
    }
    let [low, high] = [length / longest, length / shortest];
    let first = (low / FADE).ceil().max(1.0) as usize;
    let last = ((high * FADE).floor() as usize).min(rows / 2);
    let waves = (last + 1).saturating_sub(first);
    if rows as f64 * waves as f64 > MOST {
        return Err(ChordError::Size { rows, waves });
    }
    for wave in first..=last {
        let wavelength = length / wave as f64;
        let factor = transfer(wavelength, chord);
        if factor < LEAST && wave as f64 >= low && wave as f64 <= high {
            return Err(ChordError::Insensitive {
                chord,
                wavelength,
                factor,
            });
        }
    }
    let tapered: Vec<f64> = offsets
        .iter()
        .enumerate()
        .map(|(k, offset)| {
            let inside = k.min(rows - 1 - k) as f64 * spacing;
            let sine = match inside < taper {
                true => libm::sin(FRAC_PI_2 * inside / taper),
                false => 1.0,
            };
            offset * sine * sine
        })
        .collect();
    let mut curve = vec![0.0; rows];
    for wave in first..=last {
        let factor = transfer(length / wave as f64, chord).max(LEAST);
        let outside = match wave as f64 {
            wave if wave < low => (low - wave) / (low - low / FADE),
            wave if wave > high => (wave - high) / (high * FADE - high),
            _ => 0.0,
        };
        let gain = 0.5 * (1.0 + libm::cos(PI * outside.min(1.0))) / factor;
        let phase = |k: usize| {
            let turn = (wave as u64 * k as u64) % rows as u64;
            libm::sincos(TAU * turn as f64 / rows as f64)
        };
        let (mut sine_sum, mut cosine_sum) = (0.0, 0.0);
        for (k, value) in tapered.iter().enumerate() {
            let (sine, cosine) = phase(k);
            sine_sum += value * sine;
            cosine_sum += value * cosine;
        }
        let scale = match 2 * wave == rows {
            true => gain,
            false => 2.0 * gain,
        } / rows as f64;
        for (k, value) in curve.iter_mut().enumerate() {
            let (sine, cosine) = phase(k);
            *value += scale * (sine_sum * sine + cosine_sum * cosine);
        }
    }
    Ok(curve)
}
