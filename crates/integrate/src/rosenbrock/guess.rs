//! Where Newton's method begins a stage.
//!
//! Straight on is safe, and as exact as the square of the step. Where the way behind is smooth, the cubic through both its ends,
//!
//! ```text
//! x(1 + s) = x₁ + s d₁ + s² (C + d₁ - Δ) + s³ C,    Δ = x₁ - x₀,  C = d₀ + d₁ - 2Δ
//! ```
//!
//! (values `x₀`, `x₁` and slopes `d₀`, `d₁` there, in units of its length; Hermite), is some ten times nearer, and the first correction is often the last
//! one. Behind a kink it leads astray: so it is taken only if the stage before needed no other matrix, if its last term is small, and while the
//! matrix fits where it leads; and only where the straight line is not near enough itself.

use serde::{Deserialize, Serialize};
use wide::f64x4;

use crate::lanes::LANES;

/// The largest last term, in units of admissible last corrections.
const SMOOTH: f64 = 10.0;
/// Where both lie within this, the straight line serves.
const NEAR: f64 = 1.0;

/// The way behind a step: the last one.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub(crate) struct Behind {
    /// Its length.
    pub step: f64,
    /// States at its start, and by how much they would have changed at the slope there. Padded while the integrator has them.
    pub x: Vec<f64>,
    pub first: Vec<f64>,
}

impl Behind {
    /// A value that cannot be.
    pub fn damage(&self) -> Option<f64> {
        let mut values = self.x.iter().chain(&self.first).chain([&self.step]).copied();
        values
            .find(|value| !value.is_finite())
            .or((self.step <= 0.0).then_some(self.step))
    }
}

/// What lies behind a stage; slopes with the factors that bring them to its length.
pub(super) struct Way<'a> {
    pub start: &'a [f64],
    pub first: (&'a [f64], f64),
    pub last: (&'a [f64], f64),
    /// How far to go on, in units of its length; whether straight by the last slope, else through both ends.
    pub further: f64,
    pub by_slope: bool,
}

impl Way<'_> {
    /// Goes on from its end, `x`, straight and, if that is called for, by the cubic: `straight` receives the one, `x` the other or the one; whether
    /// it is the cubic. Lengths are multiples of [`LANES`].
    #[inline(always)]
    pub fn go_on(&self, cubic: bool, weights: &[f64], x: &mut [f64], straight: &mut [f64]) -> bool {
        let s = f64x4::splat(self.further);
        let (square, cube) = (s * s, s * s * s);
        let (first, last) = (f64x4::splat(self.first.1), f64x4::splat(self.last.1));
        let (mut most_third, mut most_apart) = (f64x4::ZERO, f64x4::ZERO);
        let ends = chunks(self.start).zip(x.as_chunks_mut::<LANES>().0);
        let slopes = chunks(self.first.0).zip(chunks(self.last.0));
        let targets = straight.as_chunks_mut::<LANES>().0.iter_mut();
        let all = ends.zip(slopes).zip(chunks(weights)).zip(targets);
        for ((((start, end), (d0, d1)), weight), straight) in all {
            let x1 = f64x4::new(*end);
            let (d0, d1) = (f64x4::new(*d0) * first, f64x4::new(*d1) * last);
            let (way, weight) = (x1 - f64x4::new(*start), f64x4::new(*weight));
            let line = s * if self.by_slope { d1 } else { way };
            *straight = (x1 + line).to_array();
            if cubic {
                let c = d0 + d1 - 2.0 * way;
                let third = cube * c;
                let curve = s * d1 + square * (c + d1 - way) + third;
                *end = (x1 + curve).to_array();
                most_third = most_third.fast_max(third.abs() * weight);
                most_apart = most_apart.fast_max((curve - line).abs() * weight);
            }
        }
        let most = |value: f64x4| value.to_array().into_iter().fold(0.0, f64::max);
        // (What is not a number gets through; the right-hand side then leads back to the straight line.)
        let curved = cubic && most(most_third) <= SMOOTH && most(most_apart) > NEAR;
        if !curved {
            x.copy_from_slice(straight);
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

    /// A cubic is gone on exactly, its tangent where it bends little.
    #[test]
    fn a_cubic_is_gone_on() {
        let value = |t: f64, bend: f64| 1.0 - 2.0 * t + bend * t * t * (3.0 - t);
        let slope = |t: f64, bend: f64| -2.0 + bend * 3.0 * t * (2.0 - t);
        // The last is a term of 160 admissible corrections.
        for (bend, by_slope, weight, curved) in [
            (1.0, true, 1e3, true),
            (1.0, false, 1e3, true),
            (0.1, true, 5.0, false),
            (20.0, false, 1e3, false),
        ] {
            // Behind: from 0 to 0.5; on: 0.4 of that.
            let at = |t: f64| [value(t, bend); LANES];
            let (first, last) = ([slope(0.0, bend); LANES], [slope(0.5, bend); LANES]);
            let way = Way {
                start: &at(0.0),
                first: (&first, 0.5),
                last: (&last, 0.5),
                further: 0.4,
                by_slope,
            };
            let (mut x, mut straight) = (at(0.5), [0.0; LANES]);
            let found = way.go_on(true, &[weight; LANES], &mut x, &mut straight);
            assert_eq!(found, curved, "{bend}");
            let along = if by_slope {
                0.2 * slope(0.5, bend)
            } else {
                0.4 * (value(0.5, bend) - value(0.0, bend))
            };
            let line = value(0.5, bend) + along;
            let expected = if curved { value(0.7, bend) } else { line };
            assert!(
                (x[0] - expected).abs() < 1e-14 && (straight[3] - line).abs() < 1e-14,
                "{bend}"
            );
        }
    }
}
