//! Operations on padded vectors: all lengths are multiples of [`LANES`], filled with zeros.

use wide::f64x4;

use numerics::lanes::LANES;

/// Writes `out = base + scale · Σ_j weights_j stage_j`, with `stage_j` at `stages[j·stride ..]`.
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

/// [`combine`] for `G` groups of [`LANES`] values from `at` on, whose sums stay in registers.
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

/// Returns `G` groups of values from `at` on.
#[inline(always)]
fn groups<const G: usize>(values: &[f64], at: usize) -> [f64x4; G] {
    let (groups, _) = values[at..][..G * LANES].as_chunks::<LANES>();
    std::array::from_fn(|g| f64x4::new(groups[g]))
}

/// Adds `factor · term` to `target`.
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

/// Adds `factor · (target - start)` to `target`.
#[inline(always)]
pub(crate) fn extrapolate(target: &mut [f64], factor: f64, start: &[f64]) {
    for (value, start) in target.iter_mut().zip(start) {
        *value += factor * (*value - start);
    }
}

/// Writes `target = factor · a - factor · b`.
#[inline(always)]
pub(crate) fn scale_difference(target: &mut [f64], factor: f64, a: &[f64], b: &[f64]) {
    let factor = f64x4::splat(factor);
    let pairs = a.as_chunks::<LANES>().0.iter().zip(b.as_chunks::<LANES>().0);
    for (value, (a, b)) in target.as_chunks_mut::<LANES>().0.iter_mut().zip(pairs) {
        *value = (factor * f64x4::new(*a) - factor * f64x4::new(*b)).to_array();
    }
}

/// Writes `target = term + factor · a - factor · b`.
#[inline(always)]
pub(crate) fn add_difference(target: &mut [f64], term: &[f64], factor: f64, a: &[f64], b: &[f64]) {
    let factor = f64x4::splat(factor);
    let pairs = a.as_chunks::<LANES>().0.iter().zip(b.as_chunks::<LANES>().0);
    let terms = term.as_chunks::<LANES>().0.iter().zip(pairs);
    for (value, (term, (a, b))) in target.as_chunks_mut::<LANES>().0.iter_mut().zip(terms) {
        *value = (f64x4::new(*term) + factor * f64x4::new(*a) - factor * f64x4::new(*b)).to_array();
    }
}

/// Writes `target = factor · term`.
#[inline(always)]
pub(crate) fn scale(target: &mut [f64], factor: f64, term: &[f64]) {
    for (value, term) in target.iter_mut().zip(term) {
        *value = factor * term;
    }
}

/// Returns whether all values are finite.
#[inline]
pub(crate) fn all_finite(values: &[f64]) -> bool {
    // Zero times a number that is not finite is not zero.
    let mut product = [0.0_f64; LANES];
    for group in values.as_chunks::<LANES>().0 {
        for l in 0..LANES {
            product[l] += 0.0 * group[l];
        }
    }
    product[0] + product[1] + (product[2] + product[3]) == 0.0
}

/// Returns the weighted maximum norm `max |values_i| weights_i` of finite values.
#[inline]
pub(crate) fn max_norm(values: &[f64], weights: &[f64]) -> f64 {
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

/// Returns [`max_norm`], or infinity if a value is not finite.
#[inline(always)]
pub(crate) fn max_norm_if_finite(values: &[f64], weights: &[f64]) -> f64 {
    let (mut most, mut product) = (f64x4::ZERO, f64x4::ZERO);
    let weights = weights.as_chunks::<LANES>().0;
    for (group, weight) in values.as_chunks::<LANES>().0.iter().zip(weights) {
        let group = f64x4::new(*group);
        product += group * 0.0;
        most = most.fast_max(group.abs() * f64x4::new(*weight));
    }
    let ([a, b, c, d], product) = (most.to_array(), product.to_array());
    if product[0] + product[1] + (product[2] + product[3]) == 0.0 {
        a.max(b).max(c.max(d))
    } else {
        f64::INFINITY
    }
}
