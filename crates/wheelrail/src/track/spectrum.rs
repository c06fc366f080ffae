//! Irregularities from spectra, by seed.
//!
//! One-sided spectral densities S(Ω) by the angular wavenumber Ω (rad/m), in m²/(rad/m):
//!
//! ```text
//! FRA, vertical and lateral   S = k A Ωc² / (Ω² (Ω² + Ωc²)),                k = 0.25, Ωc = 0.8245 rad/m
//! FRA, cross level and gauge  S = 4 k A Ωc² / ((Ω² + Ωc²) (Ω² + Ωs²))
//! ERRI B176, vertical         S = A Ωc² / ((Ω² + Ωr²) (Ω² + Ωc²)),          Ωc = 0.8246, Ωr = 0.0206 rad/m
//! ```
//!
//! A by class is published in cm² rad/m; densities by cycles/m are 2π times as large. FRA's vertical values
//! are as quoted in open vehicle-track programs; those of alignment and cross level are remembered from the
//! literature, unverified.
//!
//! Users' own densities are quotients of polynomials, [`Rational`].
//!
//! A realization is `Σ √(2 S_k ΔΩ) cos(Ω_k s + θ_k)` over equal steps of the wavenumber in a range of
//! wavelengths, with phases from a seed; it begins with a taper `sin²`, so that a vehicle meets no jump. It
//! repeats itself after 2π/ΔΩ: the number of terms must fit the length of the run.

use std::f64::consts::{FRAC_PI_2, TAU};

use rand_xoshiro::Xoshiro256PlusPlus;
use rand_xoshiro::rand_core::{Rng, SeedableRng};
use thiserror::Error;

use super::rational::Rational;

/// k of the FRA's spectra, and their Ωc, rad/m.
const FRA: [f64; 2] = [0.25, 0.8245];
/// A of the FRA's classes 1 to 6, cm² rad/m: vertical, and lateral.
const FRA_VERTICAL: [f64; 6] = [1.2107, 1.0181, 0.6816, 0.5376, 0.2095, 0.0339];
const FRA_LATERAL: [f64; 6] = [3.3634, 1.2107, 0.4128, 0.3027, 0.0762, 0.0339];
/// Ωs of the FRA's classes, rad/m.
const FRA_CROSS_LEVEL: [f64; 6] = [0.6046, 0.9308, 0.8520, 1.1312, 0.8209, 0.4380];
/// cm² rad/m in m² rad/m.
const SQUARE_CENTIMETER: f64 = 1e-4;
/// Most terms of a realization: each place of a wheel sums them all. They last for 15 km of waves down to
/// 1.5 m.
pub const MOST_TERMS: usize = 10_000;

/// A spectral density.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Spectrum {
    /// Vertical profile of a class (1 to 6) of the FRA.
    FraVertical(u8),
    /// Alignment of a class of the FRA.
    FraLateral(u8),
    /// Cross level and gauge of a class of the FRA.
    FraCrossLevel(u8),
    /// Vertical profile of ERRI B176, low level.
    ErriVerticalLow,
    /// The same, high level.
    ErriVerticalHigh,
    /// One of users' own.
    Rational(Rational),
}

/// A range of wavelengths cannot be realized.
#[derive(Clone, Copy, Debug, PartialEq, Error)]
pub enum SpectrumError {
    /// The class is none of the FRA's.
    #[error("there is no class {class} in the FRA's spectra; classes are 1 to 6")]
    Class {
        /// The class.
        class: u8,
    },
    /// The wavelengths are not a range.
    #[error(
        "wavelengths from {shortest} to {longest} m are no range: give the shortest and the longest one, \
         both positive, such as 1.524 and 304.8 m (5 to 1000 ft)"
    )]
    Range {
        /// The shortest, m.
        shortest: f64,
        /// The longest, m.
        longest: f64,
    },
    /// A density is none.
    #[error(
        "the density is {density} m²/(rad/m) at {wavenumber:.4} rad/m, a wavelength of {:.2} m; it must be \
         zero or positive: look at the signs and the order of the coefficients, by rising powers of the \
         wavenumber",
        TAU / wavenumber
    )]
    Density {
        /// The wavenumber, rad/m.
        wavenumber: f64,
        /// The density, m²/(rad/m).
        density: f64,
    },
    /// The number of terms is out of range.
    #[error("a realization of {terms} terms cannot be made: give 1 to {MOST_TERMS}")]
    Terms {
        /// The number.
        terms: usize,
    },
}

impl Spectrum {
    /// Returns the density at an angular wavenumber (rad/m), m²/(rad/m).
    ///
    /// # Errors
    /// The class does not exist, or a density of users' own is negative or not finite there.
    pub fn density(self, wavenumber: f64) -> Result<f64, SpectrumError> {
        let square = wavenumber * wavenumber;
        let [k, corner] = FRA;
        let corner = corner * corner;
        let of_class = |values: &[f64; 6], class: u8| {
            let index = usize::from(class).checked_sub(1);
            let value = index.and_then(|index| values.get(index));
            value.copied().ok_or(SpectrumError::Class { class })
        };
        let profile = |a: f64| k * a * SQUARE_CENTIMETER * corner / (square * (square + corner));
        let erri = |a: f64| {
            let (low, high) = (0.0206 * 0.0206, 0.8246 * 0.8246);
            a * high / ((square + low) * (square + high))
        };
        Ok(match self {
            Self::FraVertical(class) => profile(of_class(&FRA_VERTICAL, class)?),
            Self::FraLateral(class) => profile(of_class(&FRA_LATERAL, class)?),
            Self::FraCrossLevel(class) => {
                let second = of_class(&FRA_CROSS_LEVEL, class)?;
                let a = of_class(&FRA_VERTICAL, class)? * SQUARE_CENTIMETER;
                4.0 * k * a * corner / ((square + corner) * (square + second * second))
            }
            Self::ErriVerticalLow => erri(4.032e-7),
            Self::ErriVerticalHigh => erri(1.08e-6),
            Self::Rational(own) => {
                let density = own.density(wavenumber);
                if !(density >= 0.0 && density.is_finite()) {
                    return Err(SpectrumError::Density { wavenumber, density });
                }
                density
            }
        })
    }
}

/// Terms of a block.
const BLOCK: usize = 8;

/// Some terms: wavenumbers (rad/m), and amplitudes (m) times cosine and sine of the phase.
#[derive(Clone, Debug, PartialEq)]
struct Block {
    wavenumber: [f64; BLOCK],
    cosine: [f64; BLOCK],
    sine: [f64; BLOCK],
}

/// A realization of a spectrum.
///
/// Wavenumbers are evenly spaced: the waves of one block are those of the block before, turned by an angle
/// that is the same for all terms. So a distance takes the sines and cosines of one block.
#[derive(Clone, Debug, PartialEq)]
pub struct Realization {
    blocks: Vec<Block>,
    /// From one wavenumber to the next, rad/m.
    step: f64,
    taper: f64,
}

impl Realization {
    /// Returns a realization over wavelengths from `shortest` to `longest` (m) with a number of terms, by a
    /// seed. It rises from zero at the distance 0 within `taper` (m), and is zero before.
    ///
    /// # Errors
    /// [`SpectrumError`].
    pub fn new(
        spectrum: Spectrum,
        [shortest, longest]: [f64; 2],
        terms: usize,
        taper: f64,
        seed: u64,
    ) -> Result<Self, SpectrumError> {
        if !(shortest > 0.0 && shortest < longest && longest.is_finite()) {
            return Err(SpectrumError::Range { shortest, longest });
        }
        if !(1..=MOST_TERMS).contains(&terms) {
            return Err(SpectrumError::Terms { terms });
        }
        let (low, high) = (TAU / longest, TAU / shortest);
        let step = (high - low) / terms as f64;
        let mut random = Xoshiro256PlusPlus::seed_from_u64(seed);
        let mut blocks = Vec::with_capacity(terms.div_ceil(BLOCK));
        for first in (0..terms).step_by(BLOCK) {
            let mut block = Block {
                wavenumber: [0.0; BLOCK],
                cosine: [0.0; BLOCK],
                sine: [0.0; BLOCK],
            };
            for k in 0..BLOCK.min(terms - first) {
                let wavenumber = low + ((first + k) as f64 + 0.5) * step;
                let phase = TAU * ((random.next_u64() >> 11) as f64 / (1_u64 << 53) as f64);
                let amplitude = (2.0 * spectrum.density(wavenumber)? * step).sqrt();
                let (sine, cosine) = libm::sincos(phase);
                block.wavenumber[k] = wavenumber;
                (block.cosine[k], block.sine[k]) = (amplitude * cosine, amplitude * sine);
            }
            blocks.push(block);
        }
        Ok(Self { blocks, step, taper })
    }

    /// Returns the irregularity (m) at a distance (m), its slope and its second derivative (1/m).
    #[must_use]
    pub fn at(&self, distance: f64) -> [f64; 3] {
        if distance <= 0.0 {
            return [0.0; 3];
        }
        let sum = self.sum(distance);
        if distance >= self.taper {
            return sum;
        }
        let rate = FRAC_PI_2 / self.taper;
        let (sine, cosine) = libm::sincos(rate * distance);
        let window = [
            sine * sine,
            2.0 * rate * sine * cosine,
            2.0 * rate * rate * (cosine * cosine - sine * sine),
        ];
        [
            window[0] * sum[0],
            window[1] * sum[0] + window[0] * sum[1],
            window[2] * sum[0] + 2.0 * window[1] * sum[1] + window[0] * sum[2],
        ]
    }

    /// Returns the sum of the terms at a distance (m), and its first and second derivative.
    fn sum(&self, distance: f64) -> [f64; 3] {
        let mut sums = [[0.0; BLOCK]; 3];
        let (mut sines, mut cosines) = ([0.0; BLOCK], [0.0; BLOCK]);
        let first = self.blocks.first().map_or(0.0, |own| own.wavenumber[0]);
        for k in 0..BLOCK {
            let angle = (first + k as f64 * self.step) * distance;
            (sines[k], cosines[k]) = libm::sincos(angle);
        }
        let (turn_sine, turn_cosine) = libm::sincos(BLOCK as f64 * self.step * distance);
        for block in &self.blocks {
            for k in 0..BLOCK {
                let wavenumber = block.wavenumber[k];
                let value = block.cosine[k] * cosines[k] - block.sine[k] * sines[k];
                let across = block.cosine[k] * sines[k] + block.sine[k] * cosines[k];
                sums[0][k] += value;
                sums[1][k] -= wavenumber * across;
                sums[2][k] -= wavenumber * wavenumber * value;
            }
            for k in 0..BLOCK {
                let (sine, cosine) = (sines[k], cosines[k]);
                sines[k] = sine * turn_cosine + cosine * turn_sine;
                cosines[k] = cosine * turn_cosine - sine * turn_sine;
            }
        }
        sums.map(|own| own.iter().sum())
    }
}
