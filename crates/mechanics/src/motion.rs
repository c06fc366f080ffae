//! Prescribed motions of one coordinate: value, rate and second derivative in closed form.
//!
//! A motion is a function of time with exact first and second derivatives, generic over the scalar, so that
//! its derivative by time comes from the same lines. Where a motion is not smooth (corners of a triangle,
//! ends of a linear ramp) it names the time in [`Motion::next_break`]; between two breaks it is one smooth
//! piece, chosen by a `reference` time inside the piece, so that the value at a break itself belongs to the
//! piece that is being integrated.

use numerics::scalar::Real;
use serde::{Deserialize, Serialize};

use crate::spline::Spline;

/// A prescribed motion. Lengths in m, angles in rad, times in s, angular frequencies in rad/s.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[non_exhaustive]
pub enum Motion {
    /// A held value.
    Constant(f64),
    /// `amplitude · sin(angular_frequency · t + phase)`.
    Sine {
        /// Amplitude (m or rad).
        amplitude: f64,
        /// Angular frequency (rad/s).
        angular_frequency: f64,
        /// Phase (rad).
        phase: f64,
    },
    /// A triangle wave: rises from zero to `amplitude` in a quarter period, then between plus and minus it.
    Triangle {
        /// Amplitude (m or rad).
        amplitude: f64,
        /// Angular frequency (rad/s), `2π / period`.
        angular_frequency: f64,
    },
    /// `amplitude · sin(φ(t))`, φ̇ growing linearly from `start` to `end` over `duration`, and staying at
    /// `end` thereafter. The phase is the exact integral of the frequency.
    SweptSine {
        /// Amplitude (m or rad).
        amplitude: f64,
        /// Angular frequency at time zero (rad/s).
        start: f64,
        /// Angular frequency from `duration` on (rad/s).
        end: f64,
        /// Time of the sweep (s).
        duration: f64,
    },
    /// From zero to `amplitude` within `duration` after `start`, and held there.
    Ramp {
        /// The value held at the end (m or rad).
        amplitude: f64,
        /// Time at which the ramp begins (s).
        start: f64,
        /// Time that it takes (s).
        duration: f64,
        /// Its shape.
        profile: RampProfile,
    },
    /// A cubic spline (C²) through tabulated points.
    Table(Spline),
    /// Peaks `amplitude · exp(-|t - c| / decay)` around the middles c of periods of `spacing`, the first of
    /// which begins at zero.
    Cusps {
        /// Height of the peaks (m or rad).
        amplitude: f64,
        /// Time in which a peak falls to 1/e (s).
        decay: f64,
        /// Time from peak to peak (s).
        spacing: f64,
    },
    /// `c0 + c1 τ + c2 τ² + c3 τ³` with τ the time since `start`, at all times: a motion that a caller
    /// prescribes piece by piece (see [`Motion::between`]).
    Polynomial {
        /// The start of τ (s).
        start: f64,
        /// The coefficients c0 to c3 (m or rad, per power of s).
        coefficients: [f64; 4],
    },
    /// Motions one after the other, each from its own start. Before the first one its value at its start is
    /// held; values may jump.
    Sequence(Vec<Piece>),
    /// The sum of motions.
    Sum(Vec<Motion>),
}

/// A piece of a [`Motion::Sequence`].
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Piece {
    /// Its start (s), which is also that of the motion's own time.
    pub start: f64,
    /// The motion.
    pub motion: Motion,
}

/// The shape of a ramp.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum RampProfile {
    /// `10 s³ - 15 s⁴ + 6 s⁵`: rate and acceleration are zero at both ends.
    Smooth,
    /// Constant rate; the rate jumps at both ends.
    Linear,
    /// `(1 - cos πs) / 2`: the rate is zero at both ends, the acceleration jumps.
    HalfCosine,
}

/// Value, first and second derivative by time.
pub type Jet<S> = [S; 3];

/// Returns whether numbers of this size can still be counted one by one: at later times breaks are no longer
/// reported.
fn is_counted(n: f64) -> bool {
    n.abs() < 1.0 / f64::EPSILON
}

impl Motion {
    /// Returns the cubic that has a value (m or rad) and a rate at `start`, and another value and rate after
    /// `duration` (s, positive).
    #[must_use]
    pub fn between(start: f64, duration: f64, [from, from_rate]: [f64; 2], [to, to_rate]: [f64; 2]) -> Self {
        let mean_rate = (to - from) / duration;
        Self::Polynomial {
            start,
            coefficients: [
                from,
                from_rate,
                (3.0 * mean_rate - 2.0 * from_rate - to_rate) / duration,
                (from_rate + to_rate - 2.0 * mean_rate) / (duration * duration),
            ],
        }
    }

    /// Returns the straight line that has a value (m or rad) and a rate at `start`.
    #[must_use]
    pub fn line(start: f64, [value, rate]: [f64; 2]) -> Self {
        Self::Polynomial {
            start,
            coefficients: [value, rate, 0.0, 0.0],
        }
    }

    /// Returns the value, rate and second derivative at `time`, on the smooth piece that holds `reference`.
    #[must_use]
    pub fn evaluate<S: Real>(&self, time: S, reference: f64) -> Jet<S> {
        match self {
            Self::Constant(value) => [S::from(*value), S::zero(), S::zero()],
            Self::Sine {
                amplitude,
                angular_frequency,
                phase,
            } => {
                let w = *angular_frequency;
                let (s, c) = (time * w + *phase).sin_cos();
                [s * *amplitude, c * (*amplitude * w), s * (-*amplitude * w * w)]
            }
            Self::Triangle {
                amplitude,
                angular_frequency,
            } => {
                // Pieces are numbered by the half period around the corners at (n - 1/2) · half.
                let half = std::f64::consts::PI / angular_frequency.abs();
                let n = (reference / half + 0.5).floor();
                let sign = if n.rem_euclid(2.0) == 0.0 { 1.0 } else { -1.0 };
                let rate = sign * angular_frequency.signum() * amplitude * 2.0 / half;
                [(time - n * half) * rate, S::from(rate), S::zero()]
            }
            Self::SweptSine {
                amplitude,
                start,
                end,
                duration,
            } => {
                let (phase, rate, growth) = if reference < *duration {
                    let a = (end - start) / duration;
                    (time * *start + time * time * (0.5 * a), time * a + *start, a)
                } else {
                    (time * *end + 0.5 * (start - end) * duration, S::from(*end), 0.0)
                };
                let (s, c) = phase.sin_cos();
                [
                    s * *amplitude,
                    c * rate * *amplitude,
                    (c * growth - s * rate * rate) * *amplitude,
                ]
            }
            Self::Ramp {
                amplitude,
                start,
                duration,
                profile,
            } => {
                if reference < *start {
                    return [S::zero(); 3];
                }
                if reference >= start + duration {
                    return [S::from(*amplitude), S::zero(), S::zero()];
                }
                let s = (time - *start) * (1.0 / duration);
                match profile {
                    RampProfile::Linear => [s * *amplitude, S::from(amplitude / duration), S::zero()],
                    RampProfile::HalfCosine => {
                        let w = std::f64::consts::PI / duration;
                        let (sine, cosine) = (s * std::f64::consts::PI).sin_cos();
                        let half = 0.5 * amplitude;
                        [
                            (S::from(1.0) - cosine) * half,
                            sine * (half * w),
                            cosine * (half * w * w),
                        ]
                    }
                    RampProfile::Smooth => {
                        let s2 = s * s;
                        let one = S::from(1.0);
                        [
                            s2 * s * (s * (s * 6.0 - 15.0) + 10.0) * *amplitude,
                            s2 * (one - s) * (one - s) * (30.0 * amplitude / duration),
                            s * (one - s) * (one - s * 2.0) * (60.0 * amplitude / (duration * duration)),
                        ]
                    }
                }
            }
            Self::Table(spline) => spline.evaluate(time),
            Self::Cusps {
                amplitude,
                decay,
                spacing,
            } => {
                let middle = ((reference / spacing).floor() + 0.5) * spacing;
                let sign = if reference < middle { 1.0 } else { -1.0 };
                let value = ((time - middle) * (sign / decay)).exp() * *amplitude;
                [value, value * (sign / decay), value * (1.0 / (decay * decay))]
            }
            Self::Sequence(pieces) => {
                let number = pieces.partition_point(|piece| piece.start <= reference);
                match (
                    number.checked_sub(1).and_then(|number| pieces.get(number)),
                    pieces.first(),
                ) {
                    (Some(piece), _) => piece.motion.evaluate(time - piece.start, reference - piece.start),
                    (None, Some(first)) => {
                        let [value, ..] = first.motion.evaluate(0.0, 0.0);
                        [S::from(value), S::zero(), S::zero()]
                    }
                    (None, None) => [S::zero(); 3],
                }
            }
            Self::Polynomial { start, coefficients } => {
                let [c0, c1, c2, c3] = *coefficients;
                let t = time - *start;
                [
                    ((t * c3 + c2) * t + c1) * t + c0,
                    (t * (3.0 * c3) + 2.0 * c2) * t + c1,
                    t * (6.0 * c3) + 2.0 * c2,
                ]
            }
            Self::Sum(motions) => {
                let mut sum = [S::zero(); 3];
                for motion in motions {
                    let jet = motion.evaluate(time, reference);
                    for (total, part) in sum.iter_mut().zip(jet) {
                        *total += part;
                    }
                }
                sum
            }
        }
    }

    /// Returns the first time after `time` at which the motion is not smooth, if there is one.
    #[must_use]
    pub fn next_break(&self, time: f64) -> Option<f64> {
        match self {
            Self::Triangle {
                angular_frequency, ..
            } => {
                let half = std::f64::consts::PI / angular_frequency.abs();
                let mut n = (time / half - 0.5).floor();
                // The loop runs once or twice: it guards against rounding in the division.
                loop {
                    n += 1.0;
                    let corner = (n + 0.5) * half;
                    if corner > time {
                        return Some(corner);
                    }
                    if !is_counted(n) {
                        return None;
                    }
                }
            }
            Self::SweptSine { duration, .. } => (*duration > time).then_some(*duration),
            Self::Ramp { start, duration, .. } => [*start, start + duration]
                .into_iter()
                .find(|corner| *corner > time),
            Self::Cusps { spacing, .. } => {
                let mut n = (2.0 * time / spacing).floor();
                loop {
                    n += 1.0;
                    let corner = 0.5 * n * spacing;
                    if corner > time {
                        return Some(corner);
                    }
                    if !is_counted(n) {
                        return None;
                    }
                }
            }
            Self::Sequence(pieces) => {
                let number = pieces.partition_point(|piece| piece.start <= time);
                let next = pieces.get(number).map(|piece| piece.start);
                let own = number
                    .checked_sub(1)
                    .and_then(|number| pieces.get(number))
                    .and_then(|piece| {
                        let within = piece.motion.next_break(time - piece.start)?;
                        Some(within + piece.start).filter(|corner| *corner > time)
                    });
                [next, own].into_iter().flatten().min_by(f64::total_cmp)
            }
            Self::Sum(motions) => motions
                .iter()
                .filter_map(|motion| motion.next_break(time))
                .min_by(f64::total_cmp),
            Self::Constant(_) | Self::Sine { .. } | Self::Table(_) | Self::Polynomial { .. } => None,
        }
    }

    /// Returns the motion times a factor.
    #[must_use]
    pub fn scaled(&self, factor: f64) -> Self {
        let mut scaled = self.clone();
        scaled.scale(factor);
        scaled
    }

    fn scale(&mut self, factor: f64) {
        match self {
            Self::Constant(amplitude)
            | Self::Sine { amplitude, .. }
            | Self::Triangle { amplitude, .. }
            | Self::SweptSine { amplitude, .. }
            | Self::Ramp { amplitude, .. }
            | Self::Cusps { amplitude, .. } => *amplitude *= factor,
            Self::Table(spline) => *spline = spline.scaled(factor),
            Self::Polynomial { coefficients, .. } => coefficients.iter_mut().for_each(|c| *c *= factor),
            Self::Sequence(pieces) => pieces.iter_mut().for_each(|piece| piece.motion.scale(factor)),
            Self::Sum(motions) => motions.iter_mut().for_each(|motion| motion.scale(factor)),
        }
    }

    /// Returns whether the motion never moves.
    #[must_use]
    pub fn is_constant(&self) -> bool {
        match self {
            Self::Constant(_) => true,
            Self::Sum(motions) => motions.iter().all(Self::is_constant),
            Self::Sequence(pieces) => match pieces.as_slice() {
                [] => true,
                [only] => only.motion.is_constant(),
                _ => false,
            },
            _ => false,
        }
    }
}
