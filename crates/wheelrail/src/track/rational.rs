//! A spectral density as a quotient of polynomials of the wavenumber, in the units of its source.
//!
//! ```text
//! S(w) = (a0 + a1 w + a2 w² + ...) / (b0 + b1 w + b2 w² + ...)
//! ```
//!
//! Sources write w in rad/m or in cycles/m, and densities in the square of some length by a wavenumber that
//! need not be the same one: m²/(rad/m) is 2π times m²/(cycle/m) of the same track. So a density has both
//! units with it, and is kept in rad/m and m²/(rad/m).

use std::f64::consts::TAU;

/// Most coefficients of a polynomial.
pub const COEFFICIENTS: usize = 8;

/// A wavenumber's unit.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum WavenumberUnit {
    /// rad/m.
    RadianPerMeter,
    /// Cycles/m.
    CyclePerMeter,
    /// rad/ft.
    RadianPerFoot,
    /// Cycles/ft.
    CyclePerFoot,
}

impl WavenumberUnit {
    /// All of them with their names in files.
    pub const ALL: [(&'static str, Self); 4] = [
        ("rad/m", Self::RadianPerMeter),
        ("cycle/m", Self::CyclePerMeter),
        ("rad/ft", Self::RadianPerFoot),
        ("cycle/ft", Self::CyclePerFoot),
    ];

    /// Returns the unit in rad/m.
    #[must_use]
    pub fn in_radians_per_meter(self) -> f64 {
        match self {
            Self::RadianPerMeter => 1.0,
            Self::CyclePerMeter => TAU,
            Self::RadianPerFoot => 1.0 / 0.3048,
            Self::CyclePerFoot => TAU / 0.3048,
        }
    }
}

/// The unit of a density: the square of a length by a wavenumber.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DensityUnit {
    /// The length, m.
    pub length: f64,
    /// By which wavenumber.
    pub by: WavenumberUnit,
}

impl DensityUnit {
    /// Lengths with their names in files, m.
    const LENGTHS: [(&'static str, f64); 4] = [("m", 1.0), ("cm", 0.01), ("mm", 1e-3), ("in", 0.0254)];

    /// Returns the unit of a text such as `cm^2/(rad/m)`; none if it is not one.
    #[must_use]
    pub fn parse(text: &str) -> Option<Self> {
        let text: String = text.chars().filter(|letter| !letter.is_whitespace()).collect();
        let text = text.replace('²', "^2");
        let (length, by) = text.strip_suffix(')')?.split_once("^2/(")?;
        let find = |(name, _): &&(&str, f64)| *name == length;
        let (_, length) = Self::LENGTHS.iter().find(find)?;
        let (_, by) = WavenumberUnit::ALL.iter().find(|(name, _)| *name == by)?;
        Some(Self {
            length: *length,
            by: *by,
        })
    }

    /// Returns the unit in m²/(rad/m).
    #[must_use]
    pub fn in_si(self) -> f64 {
        self.length * self.length / self.by.in_radians_per_meter()
    }
}

/// A density as a quotient of polynomials, by the wavenumber in rad/m, in m²/(rad/m).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rational {
    numerator: [f64; COEFFICIENTS],
    denominator: [f64; COEFFICIENTS],
}

impl Rational {
    /// Returns the density of coefficients by rising powers of the wavenumber, in the units of their source;
    /// none if there are no coefficients or more than [`COEFFICIENTS`] of a polynomial.
    #[must_use]
    pub fn new(
        numerator: &[f64],
        denominator: &[f64],
        wavenumber: WavenumberUnit,
        density: DensityUnit,
    ) -> Option<Self> {
        let unit = wavenumber.in_radians_per_meter();
        let scaled = |own: &[f64], factor: f64| -> Option<[f64; COEFFICIENTS]> {
            if own.is_empty() || own.len() > COEFFICIENTS {
                return None;
            }
            let mut found = [0.0; COEFFICIENTS];
            let mut power = factor;
            for (found, own) in found.iter_mut().zip(own) {
                *found = own * power;
                power /= unit;
            }
            Some(found)
        };
        Some(Self {
            numerator: scaled(numerator, density.in_si())?,
            denominator: scaled(denominator, 1.0)?,
        })
    }

    /// Returns the density at a wavenumber (rad/m), m²/(rad/m).
    #[must_use]
    pub fn density(&self, wavenumber: f64) -> f64 {
        let at = |own: &[f64; COEFFICIENTS]| own.iter().rev().fold(0.0, |sum, own| sum * wavenumber + own);
        at(&self.numerator) / at(&self.denominator)
    }
}
