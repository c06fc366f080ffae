//! Shapes of irregularities, placed by distance: cusps of rail joints, sines, dips, jogs.
//!
//! Each has a value (m), a slope and a second derivative (1/m) at a distance (m). Rail joints are rectified
//! sines with their low points at the joints, `-A (1 - |sin(π u/λ)|)` with u the distance from a joint; a
//! parabola with the same value and slope at its ends rounds the tip, which lowers the depth there by `A π
//! t/(2 λ)` with a half length t. The form of the cusps is a guess; the amplitudes that a standard asks for
//! are the user's.

use std::f64::consts::{PI, TAU};

/// A shape.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Shape {
    /// Low joints one rail length apart, the first one at `start`; level rail before it and after the last
    /// one.
    Joints {
        /// Depth A of the joints before their tips are rounded, m.
        depth: f64,
        /// From joint to joint, m: 39 ft (11.8872 m) in North America.
        spacing: f64,
        /// Number of joints.
        joints: usize,
        /// Half the length of the rounded tip, m: less than half the spacing.
        rounding: f64,
        /// Distance of the first joint, m.
        start: f64,
    },
    /// Whole cycles of a sine from `start`.
    Sine {
        /// Amplitude, m.
        amplitude: f64,
        /// Wavelength, m.
        wavelength: f64,
        /// Number of cycles.
        cycles: usize,
        /// Distance of the first one, m.
        start: f64,
    },
    /// A dip `-D (1 - cos(2π u/L)) / 2` from `start`.
    Dip {
        /// Depth D, m.
        depth: f64,
        /// Length L, m.
        length: f64,
        /// Distance of its beginning, m.
        start: f64,
    },
    /// A jog: from 0 to `offset` by `(1 - cos(π u/L)) / 2`, and held there.
    Jog {
        /// The offset, m.
        offset: f64,
        /// Length L, m.
        length: f64,
        /// Distance of its beginning, m.
        start: f64,
    },
}

impl Shape {
    /// Returns value (m), slope and second derivative (1/m) at a distance (m).
    #[must_use]
    pub fn at(&self, distance: f64) -> [f64; 3] {
        match *self {
            Self::Joints {
                depth,
                spacing,
                joints,
                rounding,
                start,
            } => {
                let u = distance - start;
                let half = 0.5 * spacing;
                if joints == 0 || u <= -half || u >= (joints as f64 - 0.5) * spacing {
                    return [0.0; 3];
                }
                cusp(u - (u / spacing).round() * spacing, depth, spacing, rounding)
            }
            Self::Sine {
                amplitude,
                wavelength,
                cycles,
                start,
            } => {
                let u = distance - start;
                if u <= 0.0 || u >= wavelength * cycles as f64 {
                    return [0.0; 3];
                }
                let rate = TAU / wavelength;
                let (sine, cosine) = libm::sincos(rate * u);
                [
                    amplitude * sine,
                    amplitude * rate * cosine,
                    -amplitude * rate * rate * sine,
                ]
            }
            Self::Dip { depth, length, start } => {
                let u = distance - start;
                if u <= 0.0 || u >= length {
                    return [0.0; 3];
                }
                raised(-depth, TAU / length, u)
            }
            Self::Jog {
                offset,
                length,
                start,
            } => {
                let u = distance - start;
                if u <= 0.0 {
                    [0.0; 3]
                } else if u >= length {
                    [offset, 0.0, 0.0]
                } else {
                    raised(offset, PI / length, u)
                }
            }
        }
    }
}

/// Returns `h (1 - cos(r u)) / 2` with its derivatives.
fn raised(height: f64, rate: f64, u: f64) -> [f64; 3] {
    let (sine, cosine) = libm::sincos(rate * u);
    let half = 0.5 * height;
    [
        half * (1.0 - cosine),
        half * rate * sine,
        half * rate * rate * cosine,
    ]
}

/// Returns the cusp at a distance from its joint.
fn cusp(u: f64, depth: f64, spacing: f64, rounding: f64) -> [f64; 3] {
    let rate = PI / spacing;
    let side = |u: f64| {
        let (sine, cosine) = libm::sincos(rate * u);
        [
            depth * (sine - 1.0),
            depth * rate * cosine,
            -depth * rate * rate * sine,
        ]
    };
    if u.abs() >= rounding {
        let [value, slope, second] = side(u.abs());
        return [value, slope * u.signum(), second];
    }
    let [value, slope, _] = side(rounding);
    let second = slope / rounding;
    [
        value + 0.5 * second * (u * u - rounding * rounding),
        second * u,
        second,
    ]
}
