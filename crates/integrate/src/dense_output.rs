//! Dense output of a step.

use std::ops::Range;

use wide::f64x4;

use crate::methods::tableau::{MAXIMUM_STAGES, Tableau};
use crate::vector::{add, combine};
use numerics::lanes::LANES;

/// The dense output of a step: a polynomial in the fraction `θ = (t - start)/step`.
pub(crate) struct DenseOutput<'a> {
    pub tableau: &'static Tableau,
    /// Start, length and end of the step.
    pub start: f64,
    pub step: f64,
    pub end: f64,
    /// States at the start and at the end.
    pub x0: &'a [f64],
    pub x1: &'a [f64],
    pub stages: &'a [f64],
}

impl DenseOutput<'_> {
    /// Returns the time at a fraction of the step.
    #[inline]
    pub fn time(&self, theta: f64) -> f64 {
        if theta >= 1.0 {
            self.end
        } else {
            self.start + theta * self.step
        }
    }

    /// Returns the fraction of the step at a time.
    #[inline]
    pub fn fraction(&self, time: f64) -> f64 {
        if time == self.end || self.step <= 0.0 {
            1.0
        } else {
            (time - self.start) / self.step
        }
    }

    /// Writes the leading states, as many as `out` holds (a multiple of [`LANES`]), at a fraction of the
    /// step.
    #[inline]
    pub fn evaluate(&self, theta: f64, out: &mut [f64]) {
        let all = 0..out.len();
        self.evaluate_ranges(theta, std::slice::from_ref(&all), out);
    }

    /// Writes ranges of states, which begin and end at multiples of [`LANES`], at a fraction of the step.
    #[inline]
    pub fn evaluate_ranges(&self, theta: f64, ranges: &[Range<usize>], out: &mut [f64]) {
        if theta == 1.0 {
            for range in ranges {
                out[range.clone()].copy_from_slice(&self.x1[range.clone()]);
            }
            return;
        }
        let weights = self.weights(theta);
        for range in ranges {
            self.sum_stages(theta, &weights, range.start, &mut out[range.clone()]);
        }
    }

    /// Writes the states from `first` on, as many as `out` holds.
    pub fn evaluate_range(&self, theta: f64, first: usize, out: &mut [f64]) {
        if theta == 1.0 {
            out.copy_from_slice(&self.x1[first..][..out.len()]);
            return;
        }
        let (groups, rest) = out.split_at_mut(out.len() / LANES * LANES);
        let weights = self.weights(theta);
        self.sum_stages(theta, &weights, first, groups);
        for (k, out) in (first + groups.len()..).zip(rest) {
            let column = self.stages[k..].iter().step_by(self.x0.len());
            let mut terms = column.zip(&weights).map(|(stage, weight)| stage * weight);
            let sum = terms
                .next()
                .map_or(0.0, |first| terms.fold(first, |sum, term| sum + term));
            *out = self.x0[k] + sum + theta * (self.x1[k] - self.x0[k]);
        }
    }

    /// Writes the states from `first` on, as many as `out` holds (a multiple of [`LANES`]), from the weights
    /// of the stages at θ.
    #[inline(always)]
    fn sum_stages(&self, theta: f64, weights: &[f64; MAXIMUM_STAGES], first: usize, out: &mut [f64]) {
        let weights = &weights[..self.tableau.stages()];
        let (x0, x1) = (&self.x0[first..], &self.x1[first..]);
        combine(out, x0, 1.0, weights, &self.stages[first..], self.x0.len());
        let theta = f64x4::splat(theta);
        for ((out, x0), x1) in out
            .as_chunks_mut::<LANES>()
            .0
            .iter_mut()
            .zip(x0.as_chunks::<LANES>().0)
            .zip(x1.as_chunks::<LANES>().0)
        {
            let change = f64x4::new(*x1) - f64x4::new(*x0);
            *out = (f64x4::new(*out) + theta * change).to_array();
        }
    }

    /// Writes the time derivatives of all states at a fraction of the step.
    pub fn derivative(&self, theta: f64, out: &mut [f64]) {
        // Derivatives of θ (1 - θ) θᵏ.
        let (mut power, mut order) = (1.0, 1.0);
        let weights = self.sum_rows(|| {
            let change = power * (order - (order + 1.0) * theta);
            power *= theta;
            order += 1.0;
            change
        });
        let inverse = 1.0 / self.step;
        for ((out, x0), x1) in out.iter_mut().zip(self.x0).zip(self.x1) {
            *out = inverse * (x1 - x0);
        }
        for (weight, stage) in weights.iter().zip(self.stages.chunks_exact(self.x0.len())) {
            add(out, inverse * weight, stage);
        }
    }

    /// Returns the weights of the stages at a fraction of the step.
    #[inline]
    fn weights(&self, theta: f64) -> [f64; MAXIMUM_STAGES] {
        let mut power = theta * (1.0 - theta);
        self.sum_rows(|| {
            let now = power;
            power *= theta;
            now
        })
    }

    /// Returns the sum of the rows of the tableau's dense output, each times the next value of `factor`.
    #[inline(always)]
    fn sum_rows(&self, mut factor: impl FnMut() -> f64) -> [f64; MAXIMUM_STAGES] {
        let mut weights = [0.0; MAXIMUM_STAGES];
        for row in self.tableau.dense {
            let factor = factor();
            match <&[f64; MAXIMUM_STAGES]>::try_from(*row) {
                Ok(row) => add(&mut weights, factor, row),
                Err(_) => {
                    for (weight, h) in weights.iter_mut().zip(*row) {
                        *weight += factor * h;
                    }
                }
            }
        }
        weights
    }
}
