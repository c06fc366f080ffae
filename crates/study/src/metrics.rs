//! Averages and extremes, defined so that two people compute the same.
//!
//! - Energies per cycle are means over whole cycles after the first half period.
//! - Branch means run over the output times after the first half period in a window that depends on the
//!   damping ([`window_of`]): with constant damping, |ż_b| > 0.9 of its peak, and with variable damping |ż_b|
//!   > 0.25 of its peak and z_b < -0.3 of the amplitude.
//! - Equivalent viscous damping is W/(π ω A²).
//! - Equivalent stiffness and damping of a force are those of its first harmonic, see [`first_harmonic`].

use mechanics::motion::Motion;
use mechanics::output::Column;
use quantity::System as Units;
use serde::{Deserialize, Serialize};
use wedge::parameters::{Damping, Parameters};

/// The windows of branch means, in words.
pub const WINDOWS: &str = "mid stroke (constant damping): the bolster is faster than 0.9 of its peak speed; \
                           lower stroke (variable damping): it is faster than 0.25 of its peak speed and \
                           lower than 0.3 of its amplitude below its middle; both at the output times after \
                           the first half period";

/// Returns the name of the window of the branch means of a damping, see [`WINDOWS`] and [`Cycle::branch`].
#[must_use]
pub fn window_of(damping: Damping) -> &'static str {
    match damping {
        Damping::Constant => "mid stroke",
        Damping::Variable => "lower stroke",
    }
}

/// The bolster's vertical cycle: what averages are taken over.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cycle {
    /// Amplitude A, m.
    pub amplitude: f64,
    /// Angular frequency ω, rad/s.
    pub angular_frequency: f64,
    /// Peak speed of the bolster, m/s.
    pub peak_speed: f64,
    /// The displacement about which it moves, m.
    pub middle: f64,
}

impl Cycle {
    /// Returns the cycle of a sine about zero; amplitude in m, angular frequency in rad/s.
    #[must_use]
    pub fn sine(amplitude: f64, angular_frequency: f64) -> Self {
        Self {
            amplitude: amplitude.abs(),
            angular_frequency: angular_frequency.abs(),
            peak_speed: (amplitude * angular_frequency).abs(),
            middle: 0.0,
        }
    }

    /// Returns the cycle of the bolster's vertical motion, if it is one sine or triangle (plus constants).
    #[must_use]
    pub fn of(parameters: &Parameters) -> Option<Self> {
        Self::of_motion(&parameters.bolster.coordinates[2])
    }

    /// Returns the cycle of a motion, if it is one sine or triangle (plus constants).
    #[must_use]
    pub fn of_motion(motion: &Motion) -> Option<Self> {
        fn find(motion: &Motion) -> Option<Cycle> {
            match motion {
                Motion::Sine {
                    amplitude,
                    angular_frequency,
                    ..
                } => Some(Cycle::sine(*amplitude, *angular_frequency)),
                Motion::Triangle {
                    amplitude,
                    angular_frequency,
                } => Some(Cycle {
                    amplitude: amplitude.abs(),
                    angular_frequency: angular_frequency.abs(),
                    peak_speed: (2.0 * amplitude * angular_frequency / std::f64::consts::PI).abs(),
                    middle: 0.0,
                }),
                Motion::Sum(parts) => {
                    let mut moving = parts.iter().filter(|part| !part.is_constant());
                    match (moving.next(), moving.next()) {
                        (Some(one), None) => {
                            let held = parts.iter().filter(|part| part.is_constant());
                            let middle = held.map(|part| part.evaluate(0.0, 0.0)[0]).sum();
                            find(one).map(|cycle| Cycle { middle, ..cycle })
                        }
                        _ => None,
                    }
                }
                _ => None,
            }
        }
        find(motion).filter(|cycle| cycle.amplitude > 0.0 && cycle.angular_frequency > 0.0)
    }

    /// Period, s.
    #[must_use]
    pub fn period(&self) -> f64 {
        2.0 * std::f64::consts::PI / self.angular_frequency
    }

    /// Equivalent viscous damping of an energy (J) lost each cycle, N·s/m: W/(π ω A²).
    #[must_use]
    pub fn equivalent_damping(&self, energy: f64) -> f64 {
        energy / (std::f64::consts::PI * self.angular_frequency * self.amplitude * self.amplitude)
    }

    /// Returns the beginning of the first counted cycle and the end of the last one, s; `None` if there is no
    /// whole cycle.
    #[must_use]
    pub fn window(&self, duration: f64) -> Option<(f64, f64, u32)> {
        let (start, period) = (0.5 * self.period(), self.period());
        let cycles = ((duration - start) / period * (1.0 + 1e-12)).floor();
        (cycles >= 1.0).then(|| (start, (start + cycles * period).min(duration), cycles as u32))
    }

    /// Returns the branch that an output time counts for: `Some(true)` up, `Some(false)` down.
    #[must_use]
    pub fn branch(&self, damping: Damping, time: f64, position: f64, speed: f64) -> Option<bool> {
        let counts = time > 0.5 * self.period()
            && match damping {
                Damping::Constant => speed.abs() > 0.9 * self.peak_speed,
                Damping::Variable => {
                    speed.abs() > 0.25 * self.peak_speed && position - self.middle < -0.3 * self.amplitude
                }
            };
        counts.then_some(speed > 0.0)
    }
}

/// The extremes of a column.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Extremes {
    /// Least value.
    pub minimum: f64,
    /// Time at which it occurs (first), s.
    pub minimum_time: f64,
    /// Greatest value.
    pub maximum: f64,
    /// Time at which it occurs (first), s.
    pub maximum_time: f64,
}

impl Extremes {
    /// Returns the extremes of `values` over `times`; `None` without values.
    #[must_use]
    pub fn of(times: &[f64], values: &[f64]) -> Option<Self> {
        let mut rows = times.iter().zip(values).map(|(time, value)| Self {
            minimum: *value,
            minimum_time: *time,
            maximum: *value,
            maximum_time: *time,
        });
        let first = rows.next()?;
        Some(rows.fold(first, Self::then))
    }

    /// Returns the name of their column with its unit, and them in output units.
    #[must_use]
    pub fn named(mut self, column: &Column, units: Units) -> (String, Self) {
        self.minimum *= column.kind.from_si(units);
        self.maximum *= column.kind.from_si(units);
        (column.full_name(units), self)
    }

    /// Returns the extremes of these rows and later ones.
    #[must_use]
    pub fn then(mut self, later: Self) -> Self {
        if later.minimum < self.minimum {
            (self.minimum, self.minimum_time) = (later.minimum, later.minimum_time);
        }
        if later.maximum > self.maximum {
            (self.maximum, self.maximum_time) = (later.maximum, later.maximum_time);
        }
        self
    }
}

/// A force's response to a motion at one frequency, as of a spring and a dashpot beside each other.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FirstHarmonic {
    /// In phase: force per displacement, N/m.
    pub stiffness: f64,
    /// Out of phase: force per velocity, N·s/m.
    pub damping: f64,
}

/// Equivalent stiffness and damping of a force that resists a displacement: with the first harmonics z₁ and
/// F₁ of displacement and force over whole cycles, `-F₁/z₁ = k + i ω c`.
///
/// A force is positive the way the displacement is. For a sine of amplitude A this gives `c = W/(π ω A²)`
/// with the work W that the force takes up a cycle, whatever its course; for a linear spring and dashpot it
/// gives back k and c.
///
/// `times` (s) grow; `window` is the begin and the end of whole cycles, within them. Integrals are taken by
/// the trapezoidal rule on the given times, the values at the ends of the window being interpolated linearly:
/// with N rows a cycle an error of the order 1/N² of the result, of a force that jumps 1/N.
///
/// `None` if the lengths differ, the window lies outside the times, or the displacement has no first
/// harmonic.
#[must_use]
pub fn first_harmonic(
    times: &[f64],
    displacement: &[f64],
    force: &[f64],
    angular_frequency: f64,
    window: (f64, f64),
) -> Option<FirstHarmonic> {
    let z = harmonic(times, displacement, angular_frequency, window)?;
    let f = harmonic(times, force, angular_frequency, window)?;
    let square = z[0] * z[0] + z[1] * z[1];
    let mean = mean_square(displacement);
    // Rounding is no motion.
    if square.is_nan() || square <= 1e-24 * mean || angular_frequency <= 0.0 {
        return None;
    }
    // -F₁/z₁ with z₁ = z[0] - i z[1] and F₁ likewise, in the convention e^{+iωt}.
    Some(FirstHarmonic {
        stiffness: -(f[0] * z[0] + f[1] * z[1]) / square,
        damping: (f[1] * z[0] - f[0] * z[1]) / (square * angular_frequency),
    })
}

/// Coefficients of cosine and sine of the first harmonic of `values` over a window of whole cycles; `None` if
/// it is not within the times.
#[must_use]
pub fn harmonic(
    times: &[f64],
    values: &[f64],
    angular_frequency: f64,
    (start, end): (f64, f64),
) -> Option<[f64; 2]> {
    let slack = 1e-9 * (end - start);
    let inside = times.first().is_some_and(|first| *first <= start + slack)
        && times.last().is_some_and(|last| *last >= end - slack);
    if times.len() != values.len() || !inside || end <= start {
        return None;
    }
    // ∫ v cos, ∫ v sin, ∫ v, ∫ cos, ∫ sin: the last three take out the mean, which the rule would not do
    // exactly.
    let mut sums = [0.0; 5];
    for (t, v) in times.windows(2).zip(values.windows(2)) {
        let (from, to) = (t[0].max(start), t[1].min(end));
        if to <= from {
            continue;
        }
        for time in [from, to] {
            let half = 0.5 * (to - from);
            let value = v[0] + (v[1] - v[0]) * (time - t[0]) / (t[1] - t[0]);
            let (sin, cos) = libm::sincos(angular_frequency * time);
            for (sum, term) in sums.iter_mut().zip([value * cos, value * sin, value, cos, sin]) {
                *sum += half * term;
            }
        }
    }
    let [cos, sin, value, one_cos, one_sin] = sums;
    let mean = value / (end - start);
    Some([cos - mean * one_cos, sin - mean * one_sin].map(|sum| 2.0 * sum / (end - start)))
}

fn mean_square(values: &[f64]) -> f64 {
    values.iter().map(|value| value * value).sum::<f64>() / values.len().max(1) as f64
}

/// Mean of a column over the rows of one branch; `None` where there are none.
#[must_use]
pub fn mean(values: &[f64], rows: &[usize]) -> Option<f64> {
    (!rows.is_empty()).then(|| rows.iter().map(|row| values[*row]).sum::<f64>() / rows.len() as f64)
}
