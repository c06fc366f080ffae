//! Points of the standard normal space for the methods that count.

use serde::Serialize;

use super::normal;
use crate::design::{LatinHypercube, Sobol, mix};

/// The way in which points are chosen.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Counting {
    /// Independent points.
    MonteCarlo,
    /// A Latin hypercube.
    LatinHypercube,
    /// The Sobol' sequence, shifted at random.
    Sobol,
}

/// Returns the points of a sample.
#[must_use]
pub fn points(counting: Counting, runs: u64, dimensions: usize, seed: u64) -> Vec<Vec<f64>> {
    let hypercube = LatinHypercube::new(runs, seed);
    let sobol = Sobol::new(dimensions, Some(seed));
    let coordinate = |number: u64, dimension: usize| match counting {
        Counting::MonteCarlo => normal_value(seed, &[number, dimension as u64]),
        Counting::LatinHypercube => standard(hypercube.coordinate(number, dimension)),
        Counting::Sobol => standard(sobol.coordinate(number, dimension)),
    };
    let point = |number| {
        (0..dimensions)
            .map(|dimension| coordinate(number, dimension))
            .collect()
    };
    (0..runs).map(point).collect()
}

/// Returns the standard normal value at a coordinate from 0 to below 1.
pub(super) fn standard(coordinate: f64) -> f64 {
    const LEAST: f64 = 1.0 / (1_u64 << 54) as f64;
    normal::quantile(coordinate.max(LEAST))
}

/// Returns a standard normal random value for a seed and some numbers.
pub(super) fn normal_value(seed: u64, numbers: &[u64]) -> f64 {
    normal::quantile(open_unit(mix(seed, numbers)))
}

/// Returns a number above 0 and below 1.
pub(super) fn open_unit(bits: u64) -> f64 {
    // The middles of 2^52 parts, whose complements have all their digits too.
    ((bits >> 12) as f64 + 0.5) / (1_u64 << 52) as f64
}
