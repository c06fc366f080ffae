//! Linear combinations of stages, and dense output.

use std::ops::Range;

use wide::f64x4;

// Vectors are padded with zeros to a multiple of this length.
use crate::lanes::LANES;
use crate::methods::tableau::{MAXIMUM_STAGES, Tableau};
use crate::problem::Problem;

/// `out = base + scale · Σ_j weights_j stage_j`, with `stage_j` at `stages[j·stride ..]`; the length of `out` is a multiple of [`LANES`].
#[inline]
pub(crate) fn combine(
    out: &mut [f64],
    base: &[f64],
    scale: f64,
    weights: &[f64],
    stages: &[f64],
    stride: usize,
) {
    let mut at = 0;
    while at + 4 * LANES <= out.len() {
        combine_groups::<4>(out, base, scale, weights, stages, stride, at);
        at += 4 * LANES;
    }
    if at + 2 * LANES <= out.len() {
        combine_groups::<2>(out, base, scale, weights, stages, stride, at);
        at += 2 * LANES;
    }
    if at + LANES <= out.len() {
        combine_groups::<1>(out, base, scale, weights, stages, stride, at);
    }
}

/// The same of `G` groups of [`LANES`] from `at` on, whose sums stay in registers.
#[inline(always)]
fn combine_groups<const G: usize>(
    out: &mut [f64],
    base: &[f64],
    scale: f64,
    weights: &[f64],
    stages: &[f64],
    stride: usize,
    at: usize,
) {
    let mut sums = [f64x4::ZERO; G];
    if let [first, weights @ ..] = weights {
        sums = groups::<G>(stages, at).map(|group| group * f64x4::splat(*first));
        let mut start = at;
        for weight in weights {
            start += stride;
            let (row, weight) = (groups::<G>(stages, start), f64x4::splat(*weight));
            for g in 0..G {
                sums[g] += row[g] * weight;
            }
        }
    }
    let base = groups::<G>(base, at);
    let scale = f64x4::splat(scale);
    let out = &mut out[at..][..G * LANES];
    for (g, out) in out.as_chunks_mut::<LANES>().0.iter_mut().enumerate() {
        *out = (base[g] + sums[g] * scale).to_array();
    }
}

/// `G` groups of values from `at` on.
#[inline(always)]
fn groups<const G: usize>(values: &[f64], at: usize) -> [f64x4; G] {
    let (groups, _) = values[at..][..G * LANES].as_chunks::<LANES>();
    std::array::from_fn(|g| f64x4::new(groups[g]))
}

/// `target += factor · term`; lengths are multiples of [`LANES`].
#[inline(always)]
pub(crate) fn add(target: &mut [f64], factor: f64, term: &[f64]) {
    let factor = f64x4::splat(factor);
    let pairs = target
        .as_chunks_mut::<LANES>()
        .0
        .iter_mut()
        .zip(term.as_chunks::<LANES>().0);
    for (value, term) in pairs {
        *value = (f64x4::new(*value) + factor * f64x4::new(*term)).to_array();
    }
}

/// `target = factor · a - factor · b`; lengths are multiples of [`LANES`].
#[inline(always)]
pub(crate) fn scale_difference(target: &mut [f64], factor: f64, a: &[f64], b: &[f64]) {
    let factor = f64x4::splat(factor);
    let pairs = a.as_chunks::<LANES>().0.iter().zip(b.as_chunks::<LANES>().0);
    for (value, (a, b)) in target.as_chunks_mut::<LANES>().0.iter_mut().zip(pairs) {
        *value = (factor * f64x4::new(*a) - factor * f64x4::new(*b)).to_array();
    }
}

/// `target = term + factor · a - factor · b`; lengths are multiples of [`LANES`].
#[inline(always)]
pub(crate) fn add_difference(target: &mut [f64], term: &[f64], factor: f64, a: &[f64], b: &[f64]) {
    let factor = f64x4::splat(factor);
    let pairs = a.as_chunks::<LANES>().0.iter().zip(b.as_chunks::<LANES>().0);
    let terms = term.as_chunks::<LANES>().0.iter().zip(pairs);
    for (value, (term, (a, b))) in target.as_chunks_mut::<LANES>().0.iter_mut().zip(terms) {
        *value = (f64x4::new(*term) + factor * f64x4::new(*a) - factor * f64x4::new(*b)).to_array();
    }
}

/// `target = factor · term`; lengths are multiples of [`LANES`].
#[inline(always)]
pub(crate) fn scale(target: &mut [f64], factor: f64, term: &[f64]) {
    for (value, term) in target.iter_mut().zip(term) {
        *value = factor * term;
    }
}

/// How many leading states of a padded vector hold all that a problem reads, see [`Problem::read_states`].
pub(crate) fn leading_states<P: Problem>(problem: &P) -> usize {
    problem
        .read_states()
        .min(problem.dimension())
        .next_multiple_of(LANES)
}

/// Whether all values are finite; the length is a multiple of [`LANES`].
#[inline]
pub(crate) fn all_finite(values: &[f64]) -> bool {
    // zero times a number that is not finite is not zero
    let mut taint = [0.0_f64; LANES];
    for group in values.as_chunks::<LANES>().0 {
        for l in 0..LANES {
            taint[l] += 0.0 * group[l];
        }
    }
    taint[0] + taint[1] + (taint[2] + taint[3]) == 0.0
}

/// `max |values_i| weights_i` over finite values; the length is a multiple of [`LANES`].
#[inline]
pub(crate) fn largest(values: &[f64], weights: &[f64]) -> f64 {
    let mut most = [0.0_f64; LANES];
    for (group, weight) in values
        .as_chunks::<LANES>()
        .0
        .iter()
        .zip(weights.as_chunks::<LANES>().0)
    {
        for l in 0..LANES {
            let size = group[l].abs() * weight[l];
            most[l] = if size > most[l] { size } else { most[l] };
        }
    }
    most[0].max(most[1]).max(most[2].max(most[3]))
}

/// [`largest`], or infinite if not all values are finite.
#[inline(always)]
pub(crate) fn largest_if_finite(values: &[f64], weights: &[f64]) -> f64 {
    let (mut most, mut taint) = (f64x4::ZERO, f64x4::ZERO);
    let weights = weights.as_chunks::<LANES>().0;
    for (group, weight) in values.as_chunks::<LANES>().0.iter().zip(weights) {
        let group = f64x4::new(*group);
        taint += group * 0.0;
        most = most.fast_max(group.abs() * f64x4::new(*weight));
    }
    let ([a, b, c, d], taint) = (most.to_array(), taint.to_array());
    if taint[0] + taint[1] + (taint[2] + taint[3]) == 0.0 {
        a.max(b).max(c.max(d))
    } else {
        f64::INFINITY
    }
}

/// The dense output of one step.
pub(crate) struct Dense<'a> {
    pub tableau: &'static Tableau,
    /// Start, length and end of the step.
    pub start: f64,
    pub step: f64,
    pub end: f64,
    /// The states there.
    pub x0: &'a [f64],
    pub x1: &'a [f64],
    pub stages: &'a [f64],
}

impl Dense<'_> {
    /// The time at a fraction of the step.
    #[inline]
    pub fn time(&self, theta: f64) -> f64 {
        if theta >= 1.0 {
            self.end
        } else {
            self.start + theta * self.step
        }
    }

    /// The fraction of the step at a time.
    #[inline]
    pub fn fraction(&self, time: f64) -> f64 {
        if time == self.end || self.step <= 0.0 {
            1.0
        } else {
            (time - self.start) / self.step
        }
    }

    /// As many leading states as `out` takes, a multiple of [`LANES`], at a fraction of the step.
    #[inline]
    pub fn evaluate(&self, theta: f64, out: &mut [f64]) {
        let all = 0..out.len();
        self.evaluate_parts(theta, std::slice::from_ref(&all), out);
    }

    /// These ranges of states, which begin and end at multiples of [`LANES`], at a fraction of the step.
    #[inline]
    pub fn evaluate_parts(&self, theta: f64, parts: &[Range<usize>], out: &mut [f64]) {
        if theta == 1.0 {
            for part in parts {
                out[part.clone()].copy_from_slice(&self.x1[part.clone()]);
            }
            return;
        }
        let weights = self.weights(theta);
        for part in parts {
            self.add_up(theta, &weights, part.start, &mut out[part.clone()]);
        }
    }

    /// States `first ..`, as many as `out` takes.
    pub fn evaluate_range(&self, theta: f64, first: usize, out: &mut [f64]) {
        if theta == 1.0 {
            out.copy_from_slice(&self.x1[first..][..out.len()]);
            return;
        }
        let (groups, rest) = out.split_at_mut(out.len() / LANES * LANES);
        let weights = self.weights(theta);
        self.add_up(theta, &weights, first, groups);
        for (k, out) in (first + groups.len()..).zip(rest) {
            let column = self.stages[k..].iter().step_by(self.x0.len());
            let mut terms = column.zip(&weights).map(|(stage, weight)| stage * weight);
            let sum = terms
                .next()
                .map_or(0.0, |first| terms.fold(first, |sum, term| sum + term));
            *out = self.x0[k] + sum + theta * (self.x1[k] - self.x0[k]);
        }
    }

    /// States `first ..`, as many as `out` takes, a multiple of [`LANES`], by the weights of the stages there.
    #[inline(always)]
    fn add_up(&self, theta: f64, weights: &[f64; MAXIMUM_STAGES], first: usize, out: &mut [f64]) {
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

    /// The slopes of all states at a fraction of the step.
    pub fn slope(&self, theta: f64, out: &mut [f64]) {
        // of θ (1 - θ) θᵏ
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

    /// By how much each stage counts at a fraction of the step.
    #[inline]
    fn weights(&self, theta: f64) -> [f64; MAXIMUM_STAGES] {
        let mut power = theta * (1.0 - theta);
        self.sum_rows(|| {
            let now = power;
            power *= theta;
            now
        })
    }

    /// The sum of the rows of the dense output, each times what `factor` says next.
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
