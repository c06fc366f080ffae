//! Distributions against closed forms, and bounds of counts against sums of binomial probabilities.

use study::probability::bounds::{counted, mean_of_lognormal};
use study::probability::distribution::{Distribution, discrete};
use study::probability::normal;

/// Returns mean and variance of a distribution, by the midpoint rule over its probability.
fn moments(of: &Distribution) -> [f64; 2] {
    const PARTS: u32 = 20_000;
    let values =
        || (0..PARTS).map(|part| of.at(normal::quantile((f64::from(part) + 0.5) / f64::from(PARTS))));
    let mean = values().sum::<f64>() / f64::from(PARTS);
    let variance = values().map(|own| (own - mean) * (own - mean)).sum::<f64>() / f64::from(PARTS);
    [mean, variance]
}

#[test]
fn analytic_quantiles_of_the_normal_distribution_invert_it() {
    for p in [
        1e-300, 1e-20, 1e-8, 1e-3, 0.0749, 0.0751, 0.3, 0.5, 0.8, 0.924, 0.926, 0.999,
    ] {
        let again = normal::below(normal::quantile(p));
        assert!(
            (again / p - 1.0).abs() < 2e-13 * (1.0 - libm::log(p)),
            "{p}: {again}"
        );
    }
    // As printed in tables.
    assert!((normal::quantile(0.975) - 1.959_963_984_540_054).abs() < 1e-14);
    assert!((normal::quantile(1e-5) + 4.264_890_793_922_825).abs() < 1e-13);
}

#[test]
fn analytic_moments_of_distributions() {
    let infinite = [f64::NEG_INFINITY, f64::INFINITY];
    let normal_of = |[from, to]: [f64; 2]| Distribution::Normal {
        mean: 3.0,
        deviation: 2.0,
        from,
        to,
    };
    // Cut off at one deviation to either side: variance 1 - 2 density(1) / (1 - 2 below(-1)).
    let density = libm::exp(-0.5) / (2.0 * std::f64::consts::PI).sqrt();
    let cut = 4.0 * (1.0 - 2.0 * density / (1.0 - 2.0 * normal::below(-1.0)));
    // Cut off at its mean: half of a normal distribution.
    let half = (2.0 / std::f64::consts::PI).sqrt();
    let log = libm::log(1.3);
    let lognormal = Distribution::Lognormal {
        median: 0.4,
        factor: 1.3,
        from: 0.0,
        to: f64::INFINITY,
    };
    let mean = 0.4 * libm::exp(0.5 * log * log);
    let all = [
        (Distribution::Uniform { from: -1.0, to: 3.0 }, [1.0, 16.0 / 12.0]),
        (normal_of(infinite), [3.0, 4.0]),
        (normal_of([1.0, 5.0]), [3.0, cut]),
        (
            normal_of([3.0, f64::INFINITY]),
            [3.0 + 2.0 * half, 4.0 * (1.0 - half * half)],
        ),
        (lognormal, [mean, mean * mean * libm::expm1(log * log)]),
        (
            Distribution::Triangular {
                from: 1.0,
                mode: 2.0,
                to: 6.0,
            },
            [3.0, (1.0 + 4.0 + 36.0 - 2.0 - 6.0 - 12.0) / 18.0],
        ),
    ];
    for (of, exact) in all {
        let found = moments(&of);
        for (found, exact) in found.iter().zip(exact) {
            assert!((found / exact - 1.0).abs() < 1e-3, "{of:?}: {found} {exact}");
        }
        // Far out it stays within its ends, and grows.
        let [low, high] = [-8.0, 8.0].map(|u| of.at(u));
        let [from, to] = of.ends();
        assert!(low >= from && high <= to && low < high, "{of:?}: {low} {high}");
    }
}

#[test]
fn analytic_discrete_values_have_the_shares_of_their_weights() {
    let weights = [1.0, 0.0, 2.0, 1.0];
    let counts = (0..1000).fold([0; 4], |mut counts, part| {
        counts[discrete(&weights, normal::quantile((f64::from(part) + 0.5) / 1000.0))] += 1;
        counts
    });
    assert_eq!(counts, [250, 0, 500, 250]);
    assert_eq!(discrete(&weights, 40.0), 3);
}

/// Returns the probability of at least so many cases among so many runs.
fn at_least(count: u64, runs: u64, p: f64) -> f64 {
    let mut log = runs as f64 * libm::log1p(-p);
    let mut sum = 0.0;
    for number in 0..=runs {
        if number >= count {
            sum += libm::exp(log);
        }
        log += libm::log((runs - number) as f64 / (number + 1) as f64 * p / (1.0 - p));
    }
    sum
}

#[test]
fn analytic_bounds_of_counts_solve_their_equations() {
    for (count, runs) in [(1, 20), (10, 100), (3, 300), (150, 200), (99, 100_000)] {
        let found = counted([count; 2], runs, 0.95);
        let below = at_least(count, runs, found.low);
        let above = 1.0 - at_least(count + 1, runs, found.high);
        assert!((below - 0.025).abs() < 1e-9, "{count} of {runs}: {below}");
        assert!((above - 0.025).abs() < 1e-9, "{count} of {runs}: {above}");
    }
    let none = counted([0; 2], 100, 0.95);
    assert!(none.low == 0.0 && (none.high - (1.0 - libm::pow(0.025, 0.01))).abs() < 1e-12);
    let all = counted([100; 2], 100, 0.95);
    assert!(all.high == 1.0 && (all.low - libm::pow(0.025, 0.01)).abs() < 1e-12);
    // What is not known counts once to either side.
    let open = counted([10, 12], 100, 0.95);
    assert_eq!(open.low, counted([10; 2], 100, 0.95).low);
    assert_eq!(open.high, counted([12; 2], 100, 0.95).high);
}

#[test]
fn analytic_bounds_of_a_lognormal_mean() {
    // Logarithms -1, 0, 1: mean 0, variance 1; t of two degrees of freedom is 4.3027.
    let values = [libm::exp(-1.0), 1.0, libm::exp(1.0)].map(|own| own * 1e-4);
    let found = mean_of_lognormal([&values, &values], 0.95);
    let half = 4.302_65 * (1.0_f64 / 3.0 + 0.25).sqrt();
    for (found, exact) in [
        (found.low, 1e-4 * libm::exp(0.5 - half)),
        (found.high, 1e-4 * libm::exp(0.5 + half)),
    ] {
        assert!((found / exact - 1.0).abs() < 1e-4, "{found} {exact}");
    }
}
