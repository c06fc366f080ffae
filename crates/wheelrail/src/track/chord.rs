//! Mid-chord offsets, by which inspectors measure profile and alignment: 31, 62 and 124 ft chords.
//!
//! `m(s) = y(s) - ½ (y(s - L/2) + y(s + L/2))`. An irregularity of wavelength λ appears multiplied by
//! `1 - cos(π L/λ)`: twice its amplitude at λ = L, nothing at λ = L/2, and little beyond a few chords. So an offset
//! is no profile.

use std::f64::consts::PI;

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
