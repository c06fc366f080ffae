//! Bounds over 200 consecutive seeds, against closed forms: of 200 bounds at 95 % between 180 and 198 must
//! hold the truth.

use study::car::limits::Bound;
use study::probability::bounds::counted;
use study::probability::distribution::Distribution;
use study::probability::normal;
use study::probability::sample::Counting;
use study::probability::subset::{RepeatEnd, Subset};
use study::probability::{Answer, Estimate, Estimator, Goal};

use super::of;

const SEEDS: u64 = 200;
const HELD: std::ops::RangeInclusive<usize> = 180..=198;

/// What the bounds of many seeds come to.
#[derive(Debug)]
struct Coverage {
    held: usize,
    /// Median of the upper bound over the lower one.
    ratio: f64,
    /// Mean estimate over the truth.
    mean: f64,
    /// Mean number of runs of a seed.
    runs: f64,
}

fn coverage(truth: f64, of_seed: impl Fn(u64) -> Estimate) -> Coverage {
    let all: Vec<Estimate> = (0..SEEDS).map(of_seed).collect();
    let held = all
        .iter()
        .filter(|own| (own.bounds.low..=own.bounds.high).contains(&truth));
    let mut ratios: Vec<f64> = all.iter().map(|own| own.bounds.high / own.bounds.low).collect();
    ratios.sort_by(f64::total_cmp);
    let mean = |of: &dyn Fn(&Estimate) -> f64| all.iter().map(of).sum::<f64>() / SEEDS as f64;
    Coverage {
        held: held.count(),
        ratio: ratios[ratios.len() / 2],
        mean: mean(&|own| own.probability.high) / truth,
        runs: mean(&|own| own.runs as f64),
    }
}

fn counting(counting: Counting, runs: u64, seed: u64) -> Estimator {
    Estimator::Count { counting, runs, seed }
}

fn subset(samples: usize, repeats: usize, seed: u64) -> Estimator {
    Estimator::Subset(Subset {
        samples,
        parts: 10,
        repeats,
        levels: 8,
        seed,
        most_runs: u64::MAX,
    })
}

/// A plane in the standard normal space at the distance of a probability: `P = Phi(-distance)`.
fn plane(dimensions: usize, probability: f64) -> (Goal, impl Fn(&[f64]) -> Answer) {
    let goal = Goal {
        bound: Bound::AtMost,
        limit: -normal::quantile(probability),
    };
    let share = 1.0 / (dimensions as f64).sqrt();
    (goal, move |point: &[f64]| {
        Answer::Value(point.iter().sum::<f64>() * share)
    })
}

fn of_plane(estimator: &Estimator, dimensions: usize, probability: f64) -> Estimate {
    let (goal, value) = plane(dimensions, probability);
    of(estimator, (dimensions, goal), value)
}

/// A mass on a spring: its weight over its stiffness, both lognormal, deflects it by a lognormal length.
fn of_deflection(estimator: &Estimator, probability: f64) -> Estimate {
    let stiffness = Distribution::Lognormal {
        median: 2e6,
        factor: 1.1,
        from: 0.0,
        to: f64::INFINITY,
    };
    let weight = Distribution::Lognormal {
        median: 2e5,
        factor: 1.2,
        from: 0.0,
        to: f64::INFINITY,
    };
    let spread = libm::hypot(libm::log(1.1), libm::log(1.2));
    let goal = Goal {
        bound: Bound::AtMost,
        limit: 0.1 * libm::exp(-normal::quantile(probability) * spread),
    };
    of(estimator, (2, goal), |point| {
        Answer::Value(weight.at(point[1]) / stiffness.at(point[0]))
    })
}

fn check(name: &str, found: &Coverage, widest: f64) {
    assert!(HELD.contains(&found.held), "{name}: {found:?}");
    assert!(found.ratio < widest, "{name}: {found:?}");
    assert!((0.9..1.25).contains(&found.mean), "{name}: {found:?}");
}

#[test]
fn analytic_bounds_of_subset_simulation_hold_the_truth_as_often_as_they_say() {
    // Ten repeats of 200 samples a level: 6,600 runs at 1e-3, 10,200 at 1e-5.
    for (probability, widest, runs) in [(1e-3, 2.4, 7000.0), (1e-5, 4.2, 11_000.0)] {
        let found = coverage(probability, |seed| {
            of_plane(&subset(200, 10, seed), 5, probability)
        });
        check("plane", &found, widest);
        assert!(found.runs < runs, "{found:?}");
        let found = coverage(probability, |seed| {
            of_deflection(&subset(200, 10, seed), probability)
        });
        check("deflection", &found, widest);
    }
}

#[test]
fn analytic_bounds_of_counts_hold_the_truth_as_often_as_they_say() {
    for how in [Counting::MonteCarlo, Counting::LatinHypercube] {
        let found = coverage(1e-3, |seed| of_plane(&counting(how, 20_000, seed), 2, 1e-3));
        check("plane", &found, 2.8);
    }
    // Points of the Sobol' sequence are evener than the bounds assume.
    let found = coverage(1e-2, |seed| {
        of_plane(&counting(Counting::Sobol, 1000, seed), 2, 1e-2)
    });
    assert!(found.held >= 190, "{found:?}");
}

#[test]
fn analytic_bounds_of_counts_at_one_in_a_hundred_thousand() {
    // Two million runs of independent points are a binomial number: the coverage is a sum.
    let (n, p) = (2_000_000, 1e-5_f64);
    let mut covered = 0.0;
    let mut log = n as f64 * libm::log1p(-p);
    for count in 0..100_u64 {
        let bounds = counted([count; 2], n, 0.95);
        if (bounds.low..=bounds.high).contains(&p) {
            covered += libm::exp(log);
        }
        log += libm::log((n - count) as f64 / (count + 1) as f64 * p / (1.0 - p));
    }
    assert!((0.95..0.98).contains(&covered), "{covered}");
    // 20 seen: the width of the bounds.
    let bounds = counted([20; 2], n, 0.95);
    let ratio = bounds.high / bounds.low;
    assert!((2.4..2.6).contains(&ratio), "{ratio}");
}

#[test]
fn limits_a_sample_without_a_case_gives_an_upper_bound_only() {
    let (goal, _) = plane(1, 1e-3);
    let within = |_: &[f64]| Answer::Value(0.0);
    let found = of(&counting(Counting::MonteCarlo, 100, 0), (1, goal), within);
    assert!(found.is_upper_bound_only());
    // 1 - 0.05^(1/100).
    assert!((found.bounds.high - 0.029_513_05).abs() < 1e-8, "{found:?}");
    assert_eq!(found.bounds.high, found.least_told);
    // A value that never grows stops the climb, and says so.
    let found = of(&subset(100, 5, 0), (1, goal), within);
    assert!(found.repeats.iter().all(|own| own.end == RepeatEnd::Stalled));
    assert!(found.is_upper_bound_only() && found.bounds.high == 1.0);
    // One that grows, but nowhere near: each level leaves a tenth.
    let far = Goal { limit: 100.0, ..goal };
    let found = of(&subset(100, 5, 0), (1, far), |point| Answer::Value(point[0]));
    assert!(
        found
            .repeats
            .iter()
            .all(|own| own.end == RepeatEnd::Levels && own.levels.len() == 8)
    );
    assert!(found.bounds.low == 0.0 && found.bounds.high < 2e-8, "{found:?}");
    let Estimator::Subset(few) = subset(100, 5, 0) else {
        unreachable!()
    };
    let few = Estimator::Subset(Subset {
        most_runs: 1000,
        ..few
    });
    let found = of(&few, (1, far), |point| Answer::Value(point[0]));
    assert!(found.repeats.iter().all(|own| own.end == RepeatEnd::Runs));
    assert!(found.runs <= 1000 && found.bounds.low == 0.0, "{found:?}");
}

#[test]
fn limits_runs_without_a_value_widen_the_bounds_to_both_sides() {
    // Every tenth of the values beyond two deviations is not known.
    let unknown = |point: &[f64]| match point[0] > 2.0 && normal::below(point[1]) < 0.1 {
        true => Answer::Unknown,
        false => Answer::Value(point[0]),
    };
    let goal = Goal {
        bound: Bound::AtMost,
        limit: 3.0,
    };
    let [least, most] = [
        0.9 * normal::below(-3.0),
        normal::below(-3.0) + 0.1 * (0.022_75 - 0.001_35),
    ];
    for estimator in [subset(500, 10, 3), counting(Counting::MonteCarlo, 200_000, 3)] {
        let found = of(&estimator, (2, goal), unknown);
        assert!(found.unknown > 0);
        let [low, high] = [found.probability.low / least, found.probability.high / most];
        assert!(
            (low - 1.0).abs() < 0.2 && (high - 1.0).abs() < 0.2,
            "{low} {high}"
        );
        assert!(found.bounds.low < least && found.bounds.high > most, "{found:?}");
    }
    // A derailment is beyond every limit: nothing is left open.
    let derailed = |point: &[f64]| match unknown(point) {
        Answer::Unknown => Answer::Beyond,
        other => other,
    };
    let found = of(&counting(Counting::MonteCarlo, 200_000, 3), (2, goal), derailed);
    assert!(found.derailed > 0 && found.unknown == 0);
    assert_eq!(found.probability.low, found.probability.high);
}

#[test]
fn limits_a_limit_below_is_one_above_of_the_negative_value() {
    let (above, value) = plane(2, 1e-3);
    let below = Goal {
        bound: Bound::AtLeast,
        limit: -above.limit,
    };
    let negative = |point: &[f64]| match value(point) {
        Answer::Value(value) => Answer::Value(-value),
        other => other,
    };
    for estimator in [subset(100, 5, 1), counting(Counting::MonteCarlo, 5000, 1)] {
        let [a, b] = [
            of(&estimator, (2, above), &value),
            of(&estimator, (2, below), negative),
        ];
        assert_eq!((a.probability, a.bounds), (b.probability, b.bounds));
    }
}
