//! Averages and extremes, defined so that two people compute the same.
//!
//! - Energies per cycle are means over whole cycles after the first half period.
//! - Branch means run over the output times after the first half period with, for constant damping, |ż_b| > 0.9 of
//!   its peak, and for variable damping |ż_b| > 0.25 of its peak and z_b < -0.3 of the amplitude.
//! - Equivalent viscous damping is W/(π ω A²).

use mechanics::motion::Motion;
use serde::{Deserialize, Serialize};
use wedge::parameters::{Damping, Parameters};

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
    /// The cycle of the bolster's vertical motion, if it is one sine or triangle (plus constants).
    #[must_use]
    pub fn of(parameters: &Parameters) -> Option<Self> {
        fn find(motion: &Motion) -> Option<Cycle> {
            match motion {
                Motion::Sine {
                    amplitude,
                    angular_frequency,
                    ..
                } => Some(Cycle {
                    amplitude: amplitude.abs(),
                    angular_frequency: angular_frequency.abs(),
                    peak_speed: (amplitude * angular_frequency).abs(),
                    middle: 0.0,
                }),
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
        find(&parameters.bolster.coordinates[2])
            .filter(|cycle| cycle.amplitude > 0.0 && cycle.angular_frequency > 0.0)
    }

    /// Period, s.
    #[must_use]
    pub fn period(&self) -> f64 {
        2.0 * std::f64::consts::PI / self.angular_frequency
    }

    /// The beginning of the first counted cycle and the end of the last one, s; `None` if there is no whole cycle.
    #[must_use]
    pub fn window(&self, duration: f64) -> Option<(f64, f64, u32)> {
        let (start, period) = (0.5 * self.period(), self.period());
        let cycles = ((duration - start) / period * (1.0 + 1e-12)).floor();
        (cycles >= 1.0).then(|| (start, (start + cycles * period).min(duration), cycles as u32))
    }

    /// The branch that an output time counts for: `Some(true)` up, `Some(false)` down.
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
    /// The extremes of `values` over `times`; `None` without values.
    #[must_use]
    pub fn of(times: &[f64], values: &[f64]) -> Option<Self> {
        let (first, time) = (*values.first()?, *times.first()?);
        let start = Self {
            minimum: first,
            minimum_time: time,
            maximum: first,
            maximum_time: time,
        };
        Some(
            times
                .iter()
                .zip(values)
                .fold(start, |mut extremes, (time, value)| {
                    if *value < extremes.minimum {
                        (extremes.minimum, extremes.minimum_time) = (*value, *time);
                    }
                    if *value > extremes.maximum {
                        (extremes.maximum, extremes.maximum_time) = (*value, *time);
                    }
                    extremes
                }),
        )
    }
}

/// Mean of a column over the rows of one branch; `None` where there are none.
#[must_use]
pub fn mean(values: &[f64], rows: &[usize]) -> Option<f64> {
    (!rows.is_empty()).then(|| rows.iter().map(|row| values[*row]).sum::<f64>() / rows.len() as f64)
}
