//! Distributions of uncertain values: few, each a map from a standard normal value to the uncertain one, so
//! that all ways of sampling share one space.

use serde::Serialize;

use super::normal;

/// A distribution of numbers.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
#[serde(tag = "distribution", rename_all = "snake_case")]
pub enum Distribution {
    /// All values between two ends are equally likely.
    Uniform {
        /// The least value.
        from: f64,
        /// The greatest value.
        to: f64,
    },
    /// Normal; what lies beyond the ends is cut off.
    Normal {
        /// Mean, before anything is cut off.
        mean: f64,
        /// Standard deviation, before anything is cut off.
        deviation: f64,
        /// The least value; infinite if there is none.
        #[serde(skip_serializing_if = "is_infinite")]
        from: f64,
        /// The greatest value; infinite if there is none.
        #[serde(skip_serializing_if = "is_infinite")]
        to: f64,
    },
    /// Lognormal; what lies beyond the ends is cut off.
    Lognormal {
        /// Half of the values lie below it.
        median: f64,
        /// Geometric standard deviation, above 1: 68 % of values lie between `median / factor` and `median *
        /// factor`.
        factor: f64,
        /// The least value; zero if there is none.
        from: f64,
        /// The greatest value; infinite if there is none.
        #[serde(skip_serializing_if = "is_infinite")]
        to: f64,
    },
    /// The density is a triangle.
    Triangular {
        /// The least value.
        from: f64,
        /// The likeliest value.
        mode: f64,
        /// The greatest value.
        to: f64,
    },
}

/// Serde passes a reference.
#[allow(clippy::trivially_copy_pass_by_ref)]
fn is_infinite(value: &f64) -> bool {
    value.is_infinite()
}

impl Distribution {
    /// Returns the value at a standard normal value: that with the same probability below it.
    #[must_use]
    pub fn at(&self, u: f64) -> f64 {
        match *self {
            Self::Uniform { from, to } => {
                // From the nearer end, whose probability has all its digits.
                match u < 0.0 {
                    true => from + (to - from) * normal::below(u),
                    false => to - (to - from) * normal::below(-u),
                }
            }
            Self::Normal {
                mean,
                deviation,
                from,
                to,
            } => {
                let ends = [(from - mean) / deviation, (to - mean) / deviation];
                (mean + deviation * cut(u, ends)).clamp(from, to)
            }
            Self::Lognormal {
                median,
                factor,
                from,
                to,
            } => {
                let log = libm::log(factor);
                let ends = [libm::log(from / median) / log, libm::log(to / median) / log];
                (median * libm::exp(log * cut(u, ends))).clamp(from, to)
            }
            Self::Triangular { from, mode, to } => {
                let share = (mode - from) / (to - from);
                let (low, high) = (normal::below(u), normal::below(-u));
                match low < share {
                    true => from + ((to - from) * (mode - from) * low).sqrt(),
                    false => to - ((to - from) * (to - mode) * high).sqrt(),
                }
            }
        }
    }

    /// Returns the least and the greatest value; infinite where there is none.
    #[must_use]
    pub fn ends(&self) -> [f64; 2] {
        match *self {
            Self::Uniform { from, to }
            | Self::Normal { from, to, .. }
            | Self::Lognormal { from, to, .. }
            | Self::Triangular { from, to, .. } => [from, to],
        }
    }
}

/// Returns the value of a normal distribution that is cut off at two ends (standard normal values).
fn cut(u: f64, [from, to]: [f64; 2]) -> f64 {
    if from == f64::NEG_INFINITY && to == f64::INFINITY {
        return u;
    }
    // In the half in which both ends, or the value, have small probabilities.
    let low = normal::below(from) + normal::below(u) * (normal::below(to) - normal::below(from));
    if low < 0.5 {
        return if low > 0.0 { normal::quantile(low) } else { from };
    }
    let high = normal::below(-to) + normal::below(-u) * (normal::below(-from) - normal::below(-to));
    if high > 0.0 { -normal::quantile(high) } else { to }
}

/// Returns the place of the discrete value at a standard normal value: each has a part of the probability by
/// its weight.
#[must_use]
pub fn discrete(weights: &[f64], u: f64) -> usize {
    let all: f64 = weights.iter().sum();
    let wanted = normal::below(u) * all;
    let mut sum = 0.0;
    let found = weights.iter().position(|weight| {
        sum += weight;
        wanted < sum
    });
    // Rounding must not lead beyond the last one that can occur.
    found.unwrap_or_else(|| weights.iter().rposition(|weight| *weight > 0.0).unwrap_or(0))
}
