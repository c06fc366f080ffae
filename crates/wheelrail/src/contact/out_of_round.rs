//! Wheels that are not round: flats and harmonics of the running circle.
//!
//! **Support function.** The height of the axle above a level rail, `R + g(ψ)`, over the angle ψ of the wheel
//! that is down. A convex circle touches the rail `g'(ψ)` ahead of the plane of its axle, so a normal force N
//! has the moment `N g'` about the axle: it gives back by the spin what it takes by the height
//! (`N dg = N g' dψ`).
//!
//! ψ is measured in the wheel, from the point that is down at zero spin towards the front: a wheel that rolls
//! forward by β stands on its point at β, as in CONTACT's slices around a wheel.
//!
//! **Fresh flat**, a chord of length l: the wheel turns about one end of the chord, then about the other.
//! With `α = asin(l / 2R)` and the angle φ from the middle of the flat
//!
//! ```text
//! g = -R (1 - cos(α - |φ|)),   depth R (1 - cos α), nearly l²/(8 R)
//! ```
//!
//! In the middle the contact goes from one end to the other at once, the blow of a flat: the axle's velocity
//! would jump by `V l / R`, as at a joint with a dip angle of `l / R`. An elastic wheel on a flat of 50 mm
//! bears on both ends while it turns by some 1 mm of its circumference (approach over length). Within 1 mm
//! on both sides of the middle (`ROUNDED`, a choice) |φ| is replaced by a cubic, `ε (2 t² - t³)` with `t =
//! |φ|/ε`, which keeps the depth; its slope exceeds that of the ends by a third for a moment.
//!
//! **Worn flat**, whose ends are rounded: `g = -(d/2) (1 + cos(2π φ R / l))` with the depth d over the
//! length l of circumference. The haversine is that of Lyon (1972) and Newton and Clark (1979), who use a
//! depth of l²/(16 R) (both remembered); as they do, it is taken as the path of the axle, which is exact for
//! depths up to `l²/(2π² R)`: a deeper haversine of the radius touches the rail with its shoulders alone.
//!
//! **Harmonics**: `g = a cos(n (ψ - ψ0))`: order 1 is eccentricity, exactly; others are those of the radius
//! but for `(n a)²/(2 R)` (4 μm for 0.1 mm of order 20). At the speed V order n excites at `n V / (2π R)`.
//!
//! **Limits.** Flats and harmonics add up: exact for eccentricity, else to first order. The drop is the same
//! over the width of the wheel. Hertz's contact has the curvature of the round wheel: P1 of a fresh flat,
//! whose ends are edges, is an estimate. Where a flange touches ahead of the axle by yaw it meets a flat at
//! the wrong moment by as much.

use std::f64::consts::{PI, TAU};

use crate::profile::ProfileError;

/// Distance to the middle of a fresh flat within which the contact goes over from end to end, m.
const ROUNDED: f64 = 1e-3;
/// Longest flat, as a share of the radius.
pub const LONGEST_FLAT: f64 = 0.5;
/// Highest order of a harmonic.
pub const HIGHEST_ORDER: u32 = 100;
/// Largest sum of amplitudes, as a share of the radius.
pub const LARGEST_AMPLITUDE: f64 = 0.02;

/// A flat.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Flat {
    /// Its length along the circumference, m.
    pub length: f64,
    /// Depth of a worn one, m; none of a fresh one, a chord.
    pub depth: Option<f64>,
    /// Angle of its middle in the wheel, rad.
    pub angle: f64,
}

/// A harmonic of the radius.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Harmonic {
    /// Waves in a turn, from 1.
    pub order: u32,
    /// Amplitude, m.
    pub amplitude: f64,
    /// Angle in the wheel at which the radius is largest, rad.
    pub angle: f64,
}

/// The running circle of a wheel that is not round.
#[derive(Clone, Debug, PartialEq)]
pub struct OutOfRound {
    radius: f64,
    flats: Vec<Flat>,
    harmonics: Vec<Harmonic>,
}

impl Flat {
    /// Returns half of its angle in a wheel of a radius (m), rad.
    #[must_use]
    pub fn half_angle(&self, radius: f64) -> f64 {
        match self.depth {
            None => libm::asin(0.5 * self.length / radius),
            Some(_) => 0.5 * self.length / radius,
        }
    }

    /// Returns its depth in a wheel of a radius, m.
    #[must_use]
    pub fn depth_in(&self, radius: f64) -> f64 {
        self.depth
            .unwrap_or_else(|| radius * (1.0 - libm::cos(self.half_angle(radius))))
    }

    /// Returns by how much it lowers the axle (m) at an angle from its middle, with both derivatives.
    fn drop(&self, radius: f64, from_middle: f64) -> [f64; 3] {
        let half = self.half_angle(radius);
        let (size, sign) = (from_middle.abs(), 1.0_f64.copysign(from_middle));
        if size >= half {
            return [0.0; 3];
        }
        if let Some(depth) = self.depth {
            let waves = PI / half;
            let (sine, cosine) = libm::sincos(waves * from_middle);
            let own = 0.5 * depth;
            return [
                own * (1.0 + cosine),
                -own * waves * sine,
                -own * waves * waves * cosine,
            ];
        }
        let rounded = (ROUNDED / radius).min(0.5 * half);
        let t = size / rounded;
        let [s, rate, bend] = match t < 1.0 {
            true => [
                rounded * t * t * (2.0 - t),
                t * (4.0 - 3.0 * t),
                (4.0 - 6.0 * t) / rounded,
            ],
            false => [size, 1.0, 0.0],
        };
        let (sine, cosine) = libm::sincos(half - s);
        [
            radius * (1.0 - cosine),
            -radius * sine * rate * sign,
            radius * (cosine * rate * rate - sine * bend),
        ]
    }
}

impl OutOfRound {
    /// Returns the circle of a wheel of a nominal radius (m) with flats and harmonics.
    ///
    /// # Errors
    /// A number is not admissible, or flats overlap.
    pub fn new(radius: f64, flats: Vec<Flat>, harmonics: Vec<Harmonic>) -> Result<Self, ProfileError> {
        let wrong = |what: &'static str, value: f64, must: &'static str| {
            Err(ProfileError::Number { what, value, must })
        };
        for flat in &flats {
            let longest = LONGEST_FLAT * radius;
            if !(flat.length > 0.0 && flat.length <= longest) {
                return wrong(
                    "length of a flat (m)",
                    flat.length,
                    "positive, at most half of the radius",
                );
            }
            let chord = Flat { depth: None, ..*flat }.depth_in(radius);
            if let Some(depth) = flat.depth.filter(|depth| !(*depth > 0.0 && *depth <= chord)) {
                let must = "positive, at most that of a fresh flat of the same length, nearly l²/(8 R)";
                return wrong("depth of a worn flat (m)", depth, must);
            }
            if !flat.angle.is_finite() {
                return wrong("angle of a flat (rad)", flat.angle, "finite");
            }
        }
        for (number, flat) in flats.iter().enumerate() {
            for other in &flats[..number] {
                let room = flat.half_angle(radius) + other.half_angle(radius);
                if around(flat.angle - other.angle).abs() < room {
                    let must = "so far from the other flats of the wheel that they do not overlap";
                    return wrong("angle of a flat (rad)", flat.angle, must);
                }
            }
        }
        let (mut sum, mut bend) = (0.0, 0.0);
        for own in &harmonics {
            let order = f64::from(own.order);
            if !(1..=HIGHEST_ORDER).contains(&own.order) {
                return wrong("order of a harmonic", order, "a whole number from 1 to 100");
            }
            if !(own.amplitude > 0.0 && own.angle.is_finite()) {
                return wrong("amplitude of a harmonic (m)", own.amplitude, "positive");
            }
            sum += own.amplitude;
            bend += (order * order - 1.0) * own.amplitude;
        }
        if sum > LARGEST_AMPLITUDE * radius {
            return wrong(
                "sum of the amplitudes of harmonics (m)",
                sum,
                "at most a fiftieth of the radius",
            );
        }
        if bend >= radius {
            let must = "less than the radius: else the wheel has hollows that do not reach the rail";
            return wrong("sum of (order² - 1) × amplitude of harmonics (m)", bend, must);
        }
        Ok(Self {
            radius,
            flats,
            harmonics,
        })
    }

    /// Returns the flats.
    #[must_use]
    pub fn flats(&self) -> &[Flat] {
        &self.flats
    }

    /// Returns the harmonics.
    #[must_use]
    pub fn harmonics(&self) -> &[Harmonic] {
        &self.harmonics
    }

    /// Returns the nominal radius, m.
    #[must_use]
    pub fn radius(&self) -> f64 {
        self.radius
    }

    /// Returns the height of the axle above that of a round wheel (m) over the angle that is down (rad), with
    /// its first and second derivative by the angle.
    #[must_use]
    pub fn at(&self, angle: f64) -> [f64; 3] {
        let mut sum = [0.0; 3];
        for flat in &self.flats {
            let drop = flat.drop(self.radius, around(angle - flat.angle));
            for (sum, own) in sum.iter_mut().zip(drop) {
                *sum -= own;
            }
        }
        for own in &self.harmonics {
            let order = f64::from(own.order);
            let (sine, cosine) = libm::sincos(order * (angle - own.angle));
            sum[0] += own.amplitude * cosine;
            sum[1] -= own.amplitude * order * sine;
            sum[2] -= own.amplitude * order * order * cosine;
        }
        sum
    }

    /// Returns the shortest way of a rolling wheel over which its height changes much, m: half of a flat, an
    /// eighth of a wave. Steps of an integration should not be longer.
    #[must_use]
    pub fn finest(&self) -> f64 {
        let flats = self.flats.iter().map(|own| 0.5 * own.length);
        let waves = self.harmonics.iter();
        let waves = waves.map(|own| TAU * self.radius / (8.0 * f64::from(own.order)));
        flats.chain(waves).fold(f64::INFINITY, f64::min)
    }
}

/// Returns an angle within half a turn of zero, rad.
pub(super) fn around(angle: f64) -> f64 {
    angle - TAU * libm::floor((angle + PI) / TAU)
}
