//! Stage predictor: extrapolation of the last step, or of the previous stages, to the next stage.
//!
//! The straight line is safe, with an error of second order in the step. If the solution is smooth there, the
//! cubic through values and derivatives at both ends of the way (Hermite),
//!
//! ```text
//! x(1 + s) = x₁ + s d₁ + s² (C + d₁ - Δ) + s³ C,    Δ = x₁ - x₀,  C = d₀ + d₁ - 2Δ,
//! ```
//!
//! with `x₀`, `x₁`, `d₀`, `d₁` in units of the length of the way, is about ten times nearer, and the first
//! correction is often the last. After a discontinuity it is wrong. So it is used only if the stage before
//! needed no matrix but the cached one, if its third-order term is small, if the cached matrix is valid where
//! it leads, and if the straight line is not near enough. Decision 0035.

use serde::{Deserialize, Serialize};
use wide::f64x4;

use crate::lanes::LANES;
use crate::tuning::predictor as tuning;

/// The last step.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub(crate) struct StepHistory {
    /// Its length.
    pub step: f64,
    /// States at its start.
    pub x: Vec<f64>,
    /// First stage: the step times the derivative at its start.
    pub first: Vec<f64>,
}

impl StepHistory {
    /// Returns a value that it cannot have, for the check of a saved state.
    pub fn damage(&self) -> Option<f64> {
        let mut values = self.x.iter().chain(&self.first).chain([&self.step]).copied();
        values
            .find(|value| !value.is_finite())
            .or((self.step <= 0.0).then_some(self.step))
    }
}

/// Values and derivatives at both ends of the way from which a stage is predicted; derivatives with the
/// factors that scale them to its length. The end itself is the argument of [`Extrapolation::evaluate`].
pub(crate) struct Extrapolation<'a> {
    pub start: &'a [f64],
    pub first: (&'a [f64], f64),
    pub last: (&'a [f64], f64),
    /// Distance to extrapolate, in units of the length of the way.
    pub distance: f64,
    /// Whether the straight line is the tangent at the end; otherwise it is the chord.
    pub tangent: bool,
}

impl Extrapolation<'_> {
    /// Extrapolates from the end, `x`. Writes the straight line to `line`, and to `x` the cubic if `cubic` is
    /// set and the cubic is smooth and differs enough, otherwise the straight line. Returns whether it is the
    /// cubic. Lengths are multiples of [`LANES`].
    #[inline(always)]
    pub fn evaluate(&self, cubic: bool, weights: &[f64], x: &mut [f64], line: &mut [f64]) -> bool {
        let s = f64x4::splat(self.distance);
        let (square, cube) = (s * s, s * s * s);
        let (first, last) = (f64x4::splat(self.first.1), f64x4::splat(self.last.1));
        let (mut most_third, mut most_apart) = (f64x4::ZERO, f64x4::ZERO);
        let ends = chunks(self.start).zip(x.as_chunks_mut::<LANES>().0);
        let derivatives = chunks(self.first.0).zip(chunks(self.last.0));
        let targets = line.as_chunks_mut::<LANES>().0.iter_mut();
        let all = ends.zip(derivatives).zip(chunks(weights)).zip(targets);
        for ((((start, end), (d0, d1)), weight), target) in all {
            let x1 = f64x4::new(*end);
            let (d0, d1) = (f64x4::new(*d0) * first, f64x4::new(*d1) * last);
            let (change, weight) = (x1 - f64x4::new(*start), f64x4::new(*weight));
            let straight = s * if self.tangent { d1 } else { change };
            *target = (x1 + straight).to_array();
            if cubic {
                let c = d0 + d1 - 2.0 * change;
                let third = cube * c;
                let curve = s * d1 + square * (c + d1 - change) + third;
                *end = (x1 + curve).to_array();
                most_third = most_third.fast_max(third.abs() * weight);
                most_apart = most_apart.fast_max((curve - straight).abs() * weight);
            }
        }
        let most = |value: f64x4| value.to_array().into_iter().fold(0.0, f64::max);
        // (A value that is not a number may pass; the right-hand side there then leads back to the straight
        // line.)
        let curved = cubic
            && most(most_third) <= tuning::MAXIMUM_CUBIC_TERM
            && most(most_apart) > tuning::LINE_SUFFICES;
        if !curved {
            x.copy_from_slice(line);
        }
        curved
    }
}

fn chunks(values: &[f64]) -> std::slice::Iter<'_, [f64; LANES]> {
    values.as_chunks::<LANES>().0.iter()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A cubic is extrapolated exactly, its tangent or chord where it hardly bends or bends too much.
    #[test]
    fn a_cubic_is_extrapolated() {
        let value = |t: f64, bend: f64| 1.0 - 2.0 * t + bend * t * t * (3.0 - t);
        let slope = |t: f64, bend: f64| -2.0 + bend * 3.0 * t * (2.0 - t);
        // The last has a third-order term of 160 admissible corrections.
        for (bend, tangent, weight, curved) in [
            (1.0, true, 1e3, true),
            (1.0, false, 1e3, true),
            (0.1, true, 5.0, false),
            (20.0, false, 1e3, false),
        ] {
            // The way: from 0 to 0.5; extrapolated by 0.4 of that.
            let at = |t: f64| [value(t, bend); LANES];
            let (first, last) = ([slope(0.0, bend); LANES], [slope(0.5, bend); LANES]);
            let way = Extrapolation {
                start: &at(0.0),
                first: (&first, 0.5),
                last: (&last, 0.5),
                distance: 0.4,
                tangent,
            };
            let (mut x, mut line) = (at(0.5), [0.0; LANES]);
            let found = way.evaluate(true, &[weight; LANES], &mut x, &mut line);
            assert_eq!(found, curved, "{bend}");
            let along = if tangent {
                0.2 * slope(0.5, bend)
            } else {
                0.4 * (value(0.5, bend) - value(0.0, bend))
            };
            let straight = value(0.5, bend) + along;
            let expected = if curved { value(0.7, bend) } else { straight };
            assert!(
                (x[0] - expected).abs() < 1e-14 && (line[3] - straight).abs() < 1e-14,
                "{bend}"
            );
        }
    }
}
