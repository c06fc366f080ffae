//! Quantiles of Student's t distribution, for confidence intervals.

/// Returns the number t such that a Student-distributed value with so many degrees of freedom lies between -t
/// and t with this probability.
///
/// Hill's expansion (*Algorithm 396: Student's t-quantiles*, Comm. ACM 13, 1970), better than 1e-4 from three
/// degrees of freedom on; the exact values for one and two.
#[must_use]
pub fn two_sided(probability: f64, freedom: f64) -> f64 {
    let tail = 1.0 - probability;
    if freedom <= 1.0 {
        return 1.0 / libm::tan(0.5 * std::f64::consts::PI * tail);
    }
    if freedom <= 2.0 {
        return (2.0 / (tail * (2.0 - tail)) - 2.0).sqrt();
    }
    let n = freedom;
    let a = 1.0 / (n - 0.5);
    let b = (48.0 / a) * (1.0 / a);
    let c = ((20_700.0 * a / b - 98.0) * a - 16.0) * a + 96.36;
    let d = ((94.5 / (b + c) - 3.0) / b + 1.0) * (a * std::f64::consts::FRAC_PI_2).sqrt() * n;
    let mut y = libm::pow(d * tail, 2.0 / n);
    if y > 0.05 + a {
        let x = normal(0.5 * tail);
        y = x * x;
        let c = if n < 5.0 {
            c + 0.3 * (n - 4.5) * (x + 0.6)
        } else {
            c
        };
        let c = (((0.05 * d * x - 5.0) * x - 7.0) * x - 2.0) * x + b + c;
        y = (((((0.4 * y + 6.3) * y + 36.0) * y + 94.5) / c - y - 3.0) / b + 1.0) * x;
        y = libm::expm1(a * y * y);
    } else {
        y = ((1.0 / (((n + 6.0) / (n * y) - 0.089 * d - 0.822) * (n + 2.0) * 3.0) + 0.5 / (n + 4.0)) * y
            - 1.0)
            * (n + 1.0)
            / (n + 2.0)
            + 1.0 / y;
    }
    (n * y).sqrt()
}

/// Returns the quantile of the normal distribution: by Newton's method from Abramowitz and Stegun 26.2.23.
fn normal(probability: f64) -> f64 {
    let tail = probability.min(1.0 - probability);
    let t = (-2.0 * libm::log(tail)).sqrt();
    let series = (2.515_517 + t * (0.802_853 + t * 0.010_328))
        / (1.0 + t * (1.432_788 + t * (0.189_269 + t * 0.001_308)));
    let mut x = t - series;
    for _ in 0..3 {
        let above = 0.5 * libm::erfc(x / std::f64::consts::SQRT_2);
        let density = libm::exp(-0.5 * x * x) / (2.0 * std::f64::consts::PI).sqrt();
        x += (above - tail) / density;
    }
    if probability < 0.5 { -x } else { x }
}

#[cfg(test)]
mod tests {
    use super::two_sided;

    #[test]
    fn analytic_quantiles_from_printed_tables() {
        // Two-sided 95 % and 99 %, as in any table of t.
        for (freedom, wide, wider) in [
            (1.0, 12.7062, 63.6567),
            (2.0, 4.3027, 9.9248),
            (3.0, 3.1824, 5.8409),
            (5.0, 2.5706, 4.0321),
            (10.0, 2.2281, 3.1693),
            (30.0, 2.0423, 2.7500),
            (1e6, 1.95997, 2.57583),
        ] {
            for (probability, exact) in [(0.95, wide), (0.99, wider)] {
                let found: f64 = two_sided(probability, freedom);
                assert!(
                    (found / exact - 1.0).abs() < 2e-4,
                    "{freedom} {probability}: {found} {exact}"
                );
            }
        }
    }
}
