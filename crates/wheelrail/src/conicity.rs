//! Equivalent conicity, and linear geometry of a wheelset.
//!
//! A free wheelset without inertia follows `y'' = -Δr(y) / (2 l r0)` over the distance, with the rolling
//! radius difference Δr, half the distance l of the contacts, and the radius r0. Its motion of an amplitude
//! has a wavelength L. The **equivalent conicity** is the slope of the cones that have the same wavelength
//! (EN 15302): `(2π/L)² r0 l`. L is found from the first integral of the motion: between its ends y- and y+,
//! at which `S(y) = ∫ Δr dy` is equal, `L = 2 ∫ dy / √((S(y+) - S(y)) / (l r0))`.
//!
//! **Harmonic linearization** gives another definition: `(1/(2 π A)) ∫ Δr(y0 + A sin u) sin u du` over a
//! turn, about the middle y0 of the same motion.

use std::f64::consts::{PI, TAU};

use thiserror::Error;

use crate::wheelset::{RigidPosition, RigidWheelset};

/// Points of the midpoint rule over half a cycle.
const POINTS: usize = 400;
/// Relative rounding errors of shifts and integrals that are let pass.
const ROUNDING: f64 = 1e-10;

/// Reasons why there is no conicity.
#[derive(Clone, Debug, PartialEq, Error)]
pub enum ConicityError {
    /// Too few positions, or shifts that do not rise.
    #[error(
        "a table of the rolling radius difference needs at least three rising shifts: entry {entry} (from 1)"
    )]
    Table {
        /// The entry, from 1.
        entry: usize,
    },
    /// The amplitude is not covered.
    #[error(
        "an amplitude of {:.2} mm needs shifts from {:.2} to {:.2} mm; the table has {:.2} to {:.2} mm",
        amplitude * 1e3, needed[0] * 1e3, needed[1] * 1e3, range[0] * 1e3, range[1] * 1e3
    )]
    Range {
        /// The amplitude, m.
        amplitude: f64,
        /// Shifts that the motion would need at least, m.
        needed: [f64; 2],
        /// Shifts of the table, m.
        range: [f64; 2],
    },
    /// The wheelset does not swing about a middle.
    #[error(
        "at an amplitude of {:.2} mm the rolling radius difference does not lead the wheelset back: \
         there is no wavelength",
        amplitude * 1e3
    )]
    NoOscillation {
        /// The amplitude, m.
        amplitude: f64,
    },
    /// A wheel is not over its rail.
    #[error("at a shift of {:.2} mm a wheel is not over its rail", shift * 1e3)]
    OffRail {
        /// The shift, m.
        shift: f64,
    },
}

/// Rolling radius difference over the lateral shift; straight lines between its entries.
#[derive(Clone, Debug, PartialEq)]
pub struct RollingRadiusDifference {
    shifts: Vec<f64>,
    values: Vec<f64>,
    /// Integral from the first shift, m².
    integrals: Vec<f64>,
}

/// Equivalent conicities at an amplitude.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EquivalentConicity {
    /// By the wavelength (EN 15302).
    pub by_wavelength: f64,
    /// By harmonic linearization.
    pub by_linearization: f64,
    /// The wavelength, m.
    pub wavelength: f64,
    /// Middle of the motion, m.
    pub middle: f64,
}

impl RollingRadiusDifference {
    /// Returns the table of shifts (m, rising) and rolling radii left less right (m).
    ///
    /// # Errors
    /// There are less than three entries, or shifts do not rise.
    pub fn new(entries: impl IntoIterator<Item = [f64; 2]>) -> Result<Self, ConicityError> {
        let mut table = Self {
            shifts: Vec::new(),
            values: Vec::new(),
            integrals: Vec::new(),
        };
        for [shift, value] in entries {
            let count = table.shifts.len();
            let integral = match count {
                0 => 0.0,
                _ => {
                    let width = shift - table.shifts[count - 1];
                    if width.is_nan() || width <= 0.0 || !value.is_finite() {
                        return Err(ConicityError::Table { entry: count + 1 });
                    }
                    table.integrals[count - 1] + 0.5 * width * (value + table.values[count - 1])
                }
            };
            table.shifts.push(shift);
            table.values.push(value);
            table.integrals.push(integral);
        }
        match table.shifts.len() < 3 {
            true => Err(ConicityError::Table {
                entry: table.shifts.len(),
            }),
            false => Ok(table),
        }
    }

    /// Returns the table of positions.
    ///
    /// # Errors
    /// See [`RollingRadiusDifference::new`].
    pub fn of_positions(positions: &[RigidPosition]) -> Result<Self, ConicityError> {
        let entries = positions
            .iter()
            .map(|position| [position.shift, position.rolling_radius_difference()]);
        Self::new(entries)
    }

    /// Value (m) and integral (m²) at a shift (m); beyond the ends the last straight lines go on.
    fn at(&self, shift: f64) -> [f64; 2] {
        let last = self.shifts.len() - 2;
        let next = self.shifts.partition_point(|own| *own <= shift);
        let i = next.saturating_sub(1).min(last);
        let slope = (self.values[i + 1] - self.values[i]) / (self.shifts[i + 1] - self.shifts[i]);
        let t = shift - self.shifts[i];
        let value = self.values[i] + slope * t;
        [value, self.integrals[i] + 0.5 * t * (value + self.values[i])]
    }

    /// Returns the value (m) at a shift (m).
    #[must_use]
    pub fn value(&self, shift: f64) -> f64 {
        self.at(shift)[0]
    }

    /// Returns the shift (m) nearest to zero at which the rolling radii are equal and from which the wheelset
    /// is led back, about which the kinematic motion of small amplitudes swings: `(r2 - r1) / (2 λ)` for
    /// cones of slope λ and radii r1 on the left, r2 on the right. None if there is no such shift.
    #[must_use]
    pub fn equilibrium(&self) -> Option<f64> {
        let count = self.shifts.len() - 1;
        let zeros = (0..count).filter_map(|i| {
            let [from, to] = [self.values[i], self.values[i + 1]];
            (from <= 0.0 && to > 0.0).then(|| {
                let share = from / (from - to);
                self.shifts[i] + share * (self.shifts[i + 1] - self.shifts[i])
            })
        });
        zeros.min_by(|a, b| a.abs().total_cmp(&b.abs()))
    }

    /// Returns the equivalent conicities at an amplitude (m), for a radius r0 (m) and a distance 2 l of the
    /// contacts (m; EN 15302: 1.5 m on standard gauge).
    ///
    /// # Errors
    /// The table is too short, or the wheelset does not swing.
    pub fn equivalent_conicity(
        &self,
        amplitude: f64,
        radius: f64,
        contact_distance: f64,
    ) -> Result<EquivalentConicity, ConicityError> {
        let range = [self.shifts[0], self.shifts[self.shifts.len() - 1]];
        let double = 2.0 * amplitude;
        let width = range[1] - range[0];
        if !(amplitude > 0.0 && double <= width * (1.0 + ROUNDING)) {
            return Err(ConicityError::Range {
                amplitude,
                needed: [-amplitude, amplitude],
                range,
            });
        }
        let integral = |shift: f64| self.at(shift)[1];
        // The upper end, at which S is that of the lower end: S(y) - S(y - 2A) rises.
        let excess = |upper: f64| integral(upper) - integral(upper - double);
        let (mut low, mut high) = (range[0] + double, range[1]);
        let (below, above) = (excess(low), excess(high));
        let rounding = ROUNDING
            * self
                .integrals
                .iter()
                .fold(0.0, |most: f64, own| most.max(own.abs()));
        if below > rounding || above < -rounding {
            let middle = if below > rounding { low } else { high } - amplitude;
            return Err(ConicityError::Range {
                amplitude,
                needed: [middle - 1.5 * amplitude, middle + 1.5 * amplitude],
                range,
            });
        }
        for _ in 0..100 {
            let middle = 0.5 * (low + high);
            *(if excess(middle) > 0.0 { &mut high } else { &mut low }) = middle;
        }
        let upper = 0.5 * (low + high);
        let middle = upper - amplitude;
        let top = integral(upper);
        let scale = 0.5 * contact_distance * radius;
        let (mut half, mut projection) = (0.0, 0.0);
        for i in 0..POINTS {
            let angle = PI * ((i as f64 + 0.5) / POINTS as f64 - 0.5);
            let (sine, cosine) = libm::sincos(angle);
            let [value, own] = self.at(middle + amplitude * sine);
            let fall = (top - own) / scale;
            if fall.is_nan() || fall <= 0.0 {
                return Err(ConicityError::NoOscillation { amplitude });
            }
            half += amplitude * cosine / fall.sqrt();
            projection += value * sine;
        }
        let step = PI / POINTS as f64;
        let wavelength = 2.0 * half * step;
        let number = TAU / wavelength;
        Ok(EquivalentConicity {
            by_wavelength: number * number * scale,
            by_linearization: 2.0 * projection * step / (TAU * amplitude),
            wavelength,
            middle,
        })
    }
}

/// Linear geometry of a wheelset about the middle of the track: what linear stability needs.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LinearGeometry {
    /// Conicity: half the derivative of the rolling radius difference by the shift.
    pub conicity: f64,
    /// Contact angle in the middle, rad.
    pub contact_angle: f64,
    /// Half the derivative of the difference of the slopes of the planes of contact by the shift, 1/m.
    pub contact_angle_rate: f64,
    /// Derivative of the roll by the shift, rad/m.
    pub roll_coefficient: f64,
    /// Half the distance of the contacts, m.
    pub half_distance: f64,
    /// Rolling radius in the middle, m.
    pub radius: f64,
}

impl LinearGeometry {
    /// Returns the geometry from the positions at `-amplitude` and `amplitude` (m) and in the middle.
    ///
    /// # Errors
    /// A wheel is not over its rail.
    pub fn of(wheelset: &RigidWheelset, amplitude: f64) -> Result<Self, ConicityError> {
        let at = |shift: f64| {
            wheelset
                .position(shift, 0.0)
                .ok_or(ConicityError::OffRail { shift })
        };
        let (low, middle, high) = (at(-amplitude)?, at(0.0)?, at(amplitude)?);
        let rate = |of: &dyn Fn(&RigidPosition) -> f64| (of(&high) - of(&low)) / (2.0 * amplitude);
        let [left, right] = middle.touches;
        let origins = wheelset.rail_origins();
        let sum = origins[0] + left.place[1] + origins[1] + right.place[1];
        Ok(Self {
            conicity: 0.5 * rate(&RigidPosition::rolling_radius_difference),
            contact_angle: libm::atan(0.5 * (left.slope + right.slope)),
            contact_angle_rate: 0.5 * rate(&|p| p.touches[0].slope - p.touches[1].slope),
            roll_coefficient: rate(&|p| p.roll),
            half_distance: 0.5 * sum,
            radius: 0.5 * (left.radius + right.radius),
        })
    }

    /// Returns the geometry of cones on rails with sharp crowns: half the distance of the contacts and the
    /// radius in m.
    #[must_use]
    pub fn of_cones(conicity: f64, half_distance: f64, radius: f64) -> Self {
        // The shift lifts one side and lowers the other by λ y, and the planes of contact turn with the roll.
        let roll = conicity / half_distance;
        Self {
            conicity,
            contact_angle: libm::atan(conicity),
            contact_angle_rate: roll,
            roll_coefficient: roll,
            half_distance,
            radius,
        }
    }

    /// Returns the lateral stiffness (N/m) by which an axle load (N) leads the wheelset back.
    #[must_use]
    pub fn gravitational_stiffness(&self, axle_load: f64) -> f64 {
        axle_load * self.contact_angle_rate
    }

    /// Returns Klingel's wavelength of the free wheelset, m.
    #[must_use]
    pub fn klingel_wavelength(&self) -> f64 {
        TAU * (self.radius * self.half_distance / self.conicity).sqrt()
    }
}
