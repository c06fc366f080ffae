//! Confidence bounds of a probability.
//!
//! Functions of our own, with elementary functions of `libm`: the same bits on every machine, which crates of
//! statistics over the system's mathematical library do not give.

use super::Interval;
use crate::fit::student;

/// Returns the bounds of a probability of which a sample of `runs` independent runs shows `least` to `most`
/// cases: from the lower bound for `least` to the upper one for `most`.
///
/// C. J. Clopper and E. S. Pearson, *The use of confidence or fiducial limits illustrated in the case of the
/// binomial*, Biometrika 26 (1934): the bounds at which so few or so many cases have the probability
/// `(1 - confidence)/2`. They hold the truth at least as often as the confidence says, for any number of
/// runs.
#[must_use]
pub fn counted([least, most]: [u64; 2], runs: u64, confidence: f64) -> Interval {
    let tail = 0.5 * (1.0 - confidence);
    let n = runs as f64;
    let (few, many) = (least as f64, most as f64);
    Interval {
        low: match least {
            0 => 0.0,
            _ => beta_quantile(tail, few, n - few + 1.0),
        },
        high: match most >= runs {
            true => 1.0,
            false => beta_quantile(1.0 - tail, many + 1.0, n - many),
        },
    }
}

/// Returns the upper bound of a probability of which no case was seen in so many runs, with the whole
/// uncertainty above it: `1 - (1 - confidence)^(1/runs)`, about 3/runs for 95 %.
#[must_use]
pub fn none_seen(runs: u64, confidence: f64) -> f64 {
    -libm::expm1(libm::log1p(-confidence) / runs as f64)
}

/// Returns the bounds of the mean of a lognormal distribution from independent values above zero: the lower
/// one of `least`, the upper one of `most` (the same values, or larger ones).
///
/// Cox's method with Student's t: `exp(m + s²/2 ± t √(s²/n + s⁴/(2(n-1))))`, m and s being mean and standard
/// deviation of the logarithms (U. Olsson, *Confidence intervals for the mean of a log-normal distribution*,
/// J. Statistics Education 13 (2005)). Repeats of subset simulation are skewed so: bounds `mean ± t s/√n` of
/// the values themselves hold the truth too seldom.
#[must_use]
pub fn mean_of_lognormal([least, most]: [&[f64]; 2], confidence: f64) -> Interval {
    let end = |values: &[f64], sign: f64| {
        let n = values.len() as f64;
        let logs: Vec<f64> = values.iter().map(|own| libm::log(*own)).collect();
        let mean = logs.iter().sum::<f64>() / n;
        let variance = logs.iter().map(|own| (own - mean) * (own - mean)).sum::<f64>() / (n - 1.0);
        let spread = (variance / n + 0.5 * variance * variance / (n - 1.0)).sqrt();
        let t = student::two_sided(confidence, n - 1.0);
        libm::exp(mean + 0.5 * variance + sign * t * spread)
    };
    let any_zero = least.iter().any(|own| *own <= 0.0);
    Interval {
        low: if any_zero { 0.0 } else { end(least, -1.0) },
        high: end(most, 1.0).min(1.0),
    }
}

/// Returns the quantile of the beta distribution, by bisection.
fn beta_quantile(probability: f64, a: f64, b: f64) -> f64 {
    let [mut low, mut high] = [0.0_f64, 1.0];
    loop {
        let middle = 0.5 * (low + high);
        if middle <= low || middle >= high {
            return middle;
        }
        match beta_below(middle, a, b) < probability {
            true => low = middle,
            false => high = middle,
        }
    }
}

/// Returns the regularized incomplete beta function: the probability that a beta-distributed value lies below
/// `x`, by the continued fraction of Lentz (Press et al., *Numerical Recipes*, section 6.4).
fn beta_below(x: f64, a: f64, b: f64) -> f64 {
    if x <= 0.0 || x >= 1.0 {
        return f64::from(u8::from(x >= 1.0));
    }
    let factor = libm::exp(
        libm::lgamma(a + b) - libm::lgamma(a) - libm::lgamma(b) + a * libm::log(x) + b * libm::log1p(-x),
    );
    match x < (a + 1.0) / (a + b + 2.0) {
        true => factor * fraction(x, a, b) / a,
        false => 1.0 - factor * fraction(1.0 - x, b, a) / b,
    }
}

fn fraction(x: f64, a: f64, b: f64) -> f64 {
    const TINY: f64 = 1e-300;
    let off_zero = |own: f64| if own.abs() < TINY { TINY } else { own };
    let mut c = 1.0;
    let mut d = 1.0 / off_zero(1.0 - (a + b) * x / (a + 1.0));
    let mut product = d;
    // It needs some times the root of the larger parameter.
    for step in 1..100_000 {
        let m = f64::from(step);
        let even = m * (b - m) * x / ((a + 2.0 * m - 1.0) * (a + 2.0 * m));
        d = 1.0 / off_zero(1.0 + even * d);
        c = off_zero(1.0 + even / c);
        product *= d * c;
        let odd = -(a + m) * (a + b + m) * x / ((a + 2.0 * m) * (a + 2.0 * m + 1.0));
        d = 1.0 / off_zero(1.0 + odd * d);
        c = off_zero(1.0 + odd / c);
        let change = d * c;
        product *= change;
        if (change - 1.0).abs() < 1e-15 {
            break;
        }
    }
    product
}
