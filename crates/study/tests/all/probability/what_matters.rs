//! Indices of what matters, against closed forms.

use std::convert::Infallible;
use std::f64::consts::PI;

use study::probability::Answer;
use study::probability::indices::{SobolIndices, rank_correlation, sobol};
use study::probability::normal;

fn indices(samples: u64, dimensions: usize, value: impl Fn(&[f64]) -> Answer) -> Option<SobolIndices> {
    let mut evaluate = |points: &[Vec<f64>]| -> Result<Vec<Answer>, Infallible> {
        Ok(points.iter().map(|point| value(point)).collect())
    };
    sobol(samples, (dimensions, 5, 0.95), &mut evaluate).unwrap_or_else(|never| match never {})
}

#[test]
fn analytic_sobol_indices_of_ishigami() {
    // sin x + 7 sin² y + 0.1 z⁴ sin x over -π to π (T. Ishigami and T. Homma, 1990).
    let value = |point: &[f64]| {
        let [x, y, z] = [0, 1, 2].map(|place| PI * (2.0 * normal::below(point[place]) - 1.0));
        let (sx, sy) = (libm::sin(x), libm::sin(y));
        Answer::Value(sx + 7.0 * sy * sy + 0.1 * z * z * z * z * sx)
    };
    let p4 = PI * PI * PI * PI;
    let first = 0.5 * (1.0 + 0.1 * p4 / 5.0) * (1.0 + 0.1 * p4 / 5.0);
    let both = 0.01 * p4 * p4 * (1.0 / 18.0 - 1.0 / 50.0);
    let second = 49.0 / 8.0;
    let all = first + second + both;
    let found = indices(4096, 3, value).unwrap();
    let exact = [[first, first + both], [second, second], [0.0, both]].map(|own| own.map(|own| own / all));
    for (found, exact) in found.of.iter().zip(exact) {
        assert!((found.first - exact[0]).abs() < 0.02, "{found:?} {exact:?}");
        assert!((found.total - exact[1]).abs() < 0.02, "{found:?} {exact:?}");
        let [first, total] = [found.first_bounds, found.total_bounds];
        assert!(
            (first.low..=first.high).contains(&exact[0]),
            "{found:?} {exact:?}"
        );
        assert!(
            (total.low..=total.high).contains(&exact[1]),
            "{found:?} {exact:?}"
        );
    }
}

#[test]
fn analytic_sobol_indices_of_a_sum() {
    // More parameters than half of the sequence's dimensions: independent points.
    let value = |point: &[f64]| Answer::Value(3.0 * point[0] + 4.0 * point[11]);
    let found = indices(4000, 12, value).unwrap();
    let exact = |place: usize| match place {
        0 => 9.0 / 25.0,
        11 => 16.0 / 25.0,
        _ => 0.0,
    };
    for (place, found) in found.of.iter().enumerate() {
        assert!((found.first - exact(place)).abs() < 0.05, "{place} {found:?}");
        assert!((found.total - exact(place)).abs() < 0.05, "{place} {found:?}");
    }
}

#[test]
fn limits_samples_without_a_value_are_left_out_and_counted() {
    let value = |point: &[f64]| match point[0] > 2.0 {
        true => Answer::Unknown,
        false => Answer::Value(point[0]),
    };
    let found = indices(200, 2, value).unwrap();
    assert!(found.left_out > 0 && found.samples + found.left_out == 200);
    assert!(indices(200, 2, |_| Answer::Value(1.0)).is_none());
    assert!(indices(200, 2, |_| Answer::Unknown).is_none());
}

#[test]
fn analytic_rank_correlations() {
    let grown: Vec<(f64, f64)> = (0..20).map(f64::from).map(|x| (x, x * x * x)).collect();
    let found = rank_correlation(&grown, 0.95).unwrap();
    assert!((found.value - 1.0).abs() < 1e-12);
    // Ranks 1 2 3 4 5 and 2 1 4 3 5: 1 - 6 * 4 / (5 * 24).
    let pairs = [(1.0, 2.0), (2.0, 1.0), (3.0, 4.0), (4.0, 3.0), (5.0, 5.0)];
    let found = rank_correlation(&pairs, 0.95).unwrap();
    assert!((found.value - 0.8).abs() < 1e-12);
    assert!(found.bounds.low < 0.8 && found.bounds.high > 0.8);
    // Equal values share the mean of their ranks: 1.5 1.5 3 4 against 1 2 3 4.
    let pairs = [(1.0, 1.0), (1.0, 2.0), (3.0, 3.0), (4.0, 4.0)];
    let found = rank_correlation(&pairs, 0.95).unwrap();
    assert!((found.value - 4.5 / (4.5_f64 * 5.0).sqrt()).abs() < 1e-12);
    assert!(rank_correlation(&[(1.0, 1.0); 9], 0.95).is_none());
}
