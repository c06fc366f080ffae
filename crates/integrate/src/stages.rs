//! Linear combinations of stages, and dense output.

// Vectors are padded with zeros to a multiple of this length.
use crate::lanes::LANES;
use crate::tableau::{MAXIMUM_STAGES, Tableau};

/// `out = base + scale · Σ_j weights_j stage_j`, with `stage_j` at `stages[j·stride + first..]`.
///
/// Not inlined: only the borrow of a function's argument tells the compiler that `out` overlaps nothing.
#[inline(never)]
fn combine_fixed<const K: usize>(
    out: &mut [f64],
    base: &[f64],
    scale: f64,
    weights: &[f64; K],
    stages: &[f64],
    stride: usize,
    first: usize,
) {
    let n = out.len();
    let base = &base[..n];
    let mut rows = [base; K];
    for (j, row) in rows.iter_mut().enumerate() {
        *row = &stages[j * stride + first..][..n];
    }
    for k in 0..n {
        let mut sum = weights[0] * rows[0][k];
        for j in 1..K {
            sum += weights[j] * rows[j][k];
        }
        out[k] = base[k] + scale * sum;
    }
}

/// `out = base + scale · Σ_j weights_j stage_j`, as many stages as there are weights.
#[inline(always)]
pub(crate) fn combine(
    out: &mut [f64],
    base: &[f64],
    scale: f64,
    weights: &[f64],
    stages: &[f64],
    stride: usize,
    first: usize,
) {
    match *weights {
        [a] => combine_fixed(out, base, scale, &[a], stages, stride, first),
        [a, b] => combine_fixed(out, base, scale, &[a, b], stages, stride, first),
        [a, b, c] => combine_fixed(out, base, scale, &[a, b, c], stages, stride, first),
        [a, b, c, d] => combine_fixed(out, base, scale, &[a, b, c, d], stages, stride, first),
        [a, b, c, d, e] => combine_fixed(out, base, scale, &[a, b, c, d, e], stages, stride, first),
        [a, b, c, d, e, f] => combine_fixed(out, base, scale, &[a, b, c, d, e, f], stages, stride, first),
        [a, b, c, d, e, f, g] => {
            combine_fixed(out, base, scale, &[a, b, c, d, e, f, g], stages, stride, first)
        }
        [a, b, c, d, e, f, g, h] => {
            combine_fixed(out, base, scale, &[a, b, c, d, e, f, g, h], stages, stride, first);
        }
        _ => unreachable!("methods have at most {MAXIMUM_STAGES} stages"),
    }
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

    /// States `first ..` to `out` at a fraction of the step.
    #[inline]
    pub fn evaluate(&self, theta: f64, first: usize, out: &mut [f64]) {
        let (x0, x1) = (&self.x0[first..][..out.len()], &self.x1[first..][..out.len()]);
        if theta == 1.0 {
            out.copy_from_slice(x1);
            return;
        }
        let mut weights = [0.0; MAXIMUM_STAGES];
        let mut power = theta * (1.0 - theta);
        for row in self.tableau.dense {
            for (weight, h) in weights.iter_mut().zip(*row) {
                *weight += power * h;
            }
            power *= theta;
        }
        combine(
            out,
            x0,
            1.0,
            &weights[..self.tableau.stages()],
            self.stages,
            self.x0.len(),
            first,
        );
        for ((value, x0), x1) in out.iter_mut().zip(x0).zip(x1) {
            *value += theta * (x1 - x0);
        }
    }
}
