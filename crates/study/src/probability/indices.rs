//! What matters: how a measure depends on each uncertain parameter.
//!
//! - *Rank correlation* (Spearman) from any sample: whether the measure grows or falls with a parameter. A
//!   dependence that rises and falls again has none.
//! - *Sobol' indices* from a sample of their own: the share of the measure's variance that a parameter
//!   takes alone (first order), and with all that it does together with others (total). A. Saltelli et
//!   al., *Variance based sensitivity analysis of model output*, Computer Physics Communications 181
//!   (2010): first order by its equation (b) of table 2, total by Jansen's (f). Runs: samples times
//!   (parameters + 2).
//!
//! Functions of our own: forty lines, of which the evaluation of points, which must resume and must not
//! depend on the number of threads, is most.

use serde::Serialize;

use super::sample::{self, Counting};
use super::{Answer, Evaluate, Interval, normal};
use crate::design::{DIMENSIONS, mix};

/// Repeats of the bootstrap that gives intervals.
const RESAMPLES: u64 = 500;

/// Sobol' indices of a parameter.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct SobolIndex {
    /// The share of the variance that it takes alone.
    pub first: f64,
    /// Its bounds.
    pub first_bounds: Interval,
    /// The share of the variance that it takes part in.
    pub total: f64,
    /// Its bounds.
    pub total_bounds: Interval,
}

/// Sobol' indices of all parameters.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct SobolIndices {
    /// One a parameter.
    pub of: Vec<SobolIndex>,
    /// Base samples that count.
    pub samples: u64,
    /// Base samples that do not: one of their runs has no value.
    pub left_out: u64,
}

/// A rank correlation.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct RankCorrelation {
    /// From -1 to 1.
    pub value: f64,
    /// Its bounds, by Fisher's transformation.
    pub bounds: Interval,
}

/// Returns the points of the base samples: first all points A, then all B, then for each parameter all A with
/// that parameter of B.
#[must_use]
pub fn points(samples: u64, dimensions: usize, seed: u64) -> Vec<Vec<f64>> {
    // Evenly spread points where the sequence has enough dimensions.
    let counting = match 2 * dimensions <= DIMENSIONS {
        true => Counting::Sobol,
        false => Counting::MonteCarlo,
    };
    let both = sample::points(counting, samples, 2 * dimensions, mix(seed, &[u64::MAX]));
    let a = both.iter().map(|own| own[..dimensions].to_vec());
    let b = both.iter().map(|own| own[dimensions..].to_vec());
    let mixed = (0..dimensions).flat_map(|dimension| {
        both.iter().map(move |own| {
            let mut point = own[..dimensions].to_vec();
            point[dimension] = own[dimensions + dimension];
            point
        })
    });
    a.chain(b).chain(mixed).collect()
}

/// Evaluates base samples and returns the indices; none where fewer than two samples count, or where the
/// measure does not vary.
///
/// # Errors
/// The evaluator's.
pub fn sobol<E>(
    samples: u64,
    (dimensions, seed, confidence): (usize, u64, f64),
    evaluate: &mut Evaluate<'_, E>,
) -> Result<Option<SobolIndices>, E> {
    let answers = evaluate(&points(samples, dimensions, seed))?;
    let n = samples as usize;
    let rows: Vec<Vec<f64>> = (0..n)
        .filter_map(|row| {
            let values = (0..dimensions + 2).map(|block| match answers.get(block * n + row)? {
                Answer::Value(value) => Some(*value),
                Answer::Beyond | Answer::Unknown => None,
            });
            values.collect()
        })
        .collect();
    let all: Vec<usize> = (0..rows.len()).collect();
    let Some(found) = shares(&rows, &all, dimensions) else {
        return Ok(None);
    };
    let resampled: Vec<Vec<[f64; 2]>> = (0..RESAMPLES)
        .filter_map(|resample| {
            let pick = |row: usize| (mix(seed, &[resample, row as u64]) % rows.len() as u64) as usize;
            let picked: Vec<usize> = all.iter().map(|row| pick(*row)).collect();
            shares(&rows, &picked, dimensions)
        })
        .collect();
    let z = normal::quantile(0.5 * (1.0 + confidence));
    let bounds = |dimension: usize, which: usize, value: f64| {
        let own: Vec<f64> = resampled.iter().map(|all| all[dimension][which]).collect();
        let mean = own.iter().sum::<f64>() / own.len() as f64;
        let variance = own.iter().map(|own| (own - mean) * (own - mean)).sum::<f64>();
        let half = z * (variance / (own.len() as f64 - 1.0)).sqrt();
        Interval {
            low: value - half,
            high: value + half,
        }
    };
    let of = found
        .iter()
        .enumerate()
        .map(|(dimension, [first, total])| SobolIndex {
            first: *first,
            first_bounds: bounds(dimension, 0, *first),
            total: *total,
            total_bounds: bounds(dimension, 1, *total),
        });
    Ok(Some(SobolIndices {
        of: of.collect(),
        samples: rows.len() as u64,
        left_out: samples - rows.len() as u64,
    }))
}

/// Returns first-order and total index of each parameter from rows of f(A), f(B), f(A with one of B).
fn shares(rows: &[Vec<f64>], picked: &[usize], dimensions: usize) -> Option<Vec<[f64; 2]>> {
    let n = picked.len() as f64;
    let ends = || picked.iter().flat_map(|row| &rows[*row][..2]);
    let mean = ends().sum::<f64>() / (2.0 * n);
    let variance = ends().map(|own| (own - mean) * (own - mean)).sum::<f64>() / (2.0 * n);
    if picked.len() < 2 || variance <= 0.0 {
        return None;
    }
    let of = |dimension: usize| {
        let mut sums = [0.0; 2];
        for row in picked {
            let values = &rows[*row];
            let [a, b, mixed] = [values[0], values[1], values[2 + dimension]];
            sums[0] += (b - mean) * (mixed - a);
            sums[1] += 0.5 * (a - mixed) * (a - mixed);
        }
        sums.map(|sum| sum / (n * variance))
    };
    Some((0..dimensions).map(of).collect())
}

/// Returns the rank correlation of a measure with a parameter, with its bounds; `None` of fewer than four
/// pairs, or where one of both does not vary.
#[must_use]
pub fn rank_correlation(pairs: &[(f64, f64)], confidence: f64) -> Option<RankCorrelation> {
    let n = pairs.len() as f64;
    let (x, y): (Vec<f64>, Vec<f64>) = pairs.iter().copied().unzip();
    let (x, y) = (ranks(&x), ranks(&y));
    let mean = 0.5 * (n + 1.0);
    let sum = |a: &[f64], b: &[f64]| -> f64 { a.iter().zip(b).map(|(a, b)| (a - mean) * (b - mean)).sum() };
    let size = (sum(&x, &x) * sum(&y, &y)).sqrt();
    if pairs.len() < 4 || size <= 0.0 {
        return None;
    }
    let value = (sum(&x, &y) / size).clamp(-1.0, 1.0);
    // With the larger variance that ranks have (D. G. Bonett and T. A. Wright, Psychometrika 65 (2000)).
    let z = normal::quantile(0.5 * (1.0 + confidence));
    let half = z * ((1.0 + 0.5 * value * value) / (n - 3.0)).sqrt();
    let middle = libm::atanh(value);
    Some(RankCorrelation {
        value,
        bounds: Interval {
            low: libm::tanh(middle - half),
            high: libm::tanh(middle + half),
        },
    })
}

/// Returns the ranks of values, from 1; equal ones share theirs.
fn ranks(values: &[f64]) -> Vec<f64> {
    let mut order: Vec<usize> = (0..values.len()).collect();
    order.sort_by(|a, b| values[*a].total_cmp(&values[*b]));
    let mut ranks = vec![0.0; values.len()];
    let mut start = 0;
    while start < order.len() {
        let same = order[start..]
            .iter()
            .take_while(|own| values[**own] == values[order[start]]);
        let end = start + same.count().max(1);
        for own in &order[start..end] {
            ranks[*own] = 0.5 * (start + end + 1) as f64;
        }
        start = end;
    }
    ranks
}
