//! Kalker's creepage and spin coefficients of an elliptic contact (Kalker 1990, table E.3).
//!
//! The table has Poisson's ratios 0, 0.25, 0.5 and 19 ratios a/b from 0.1 to 10. Between Poisson's ratios 1/C
//! is a parabola, as in CONTACT; between ratios C is a monotone cubic in ln(a/b) (Fritsch and Butland 1984),
//! so that derivatives are continuous. Beyond 0.1 and 10 the values at the end hold; the asymptotes of the
//! theory do not join the table.

use numerics::scalar::Real;

/// The coefficients.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Coefficients<S> {
    /// Longitudinal creepage.
    pub c11: S,
    /// Lateral creepage.
    pub c22: S,
    /// Spin to lateral force, lateral creepage to spin moment.
    pub c23: S,
    /// Spin to spin moment.
    pub c33: S,
}

/// Number of ratios.
const ROWS: usize = 19;

/// Rows by a/b from 0.1 to 1 and 1/0.9 to 1/0.1; columns C11, C22, C23, C33, each at the three Poisson's
/// ratios.
#[allow(clippy::approx_constant)] // 3.14 is a value of the table
#[rustfmt::skip]
const TABLE: [[[f64; 3]; 4]; ROWS] = [
    [[2.51, 3.31, 4.85], [2.51, 2.52, 2.53], [0.334, 0.473, 0.731], [6.42, 8.28, 11.7]],
    [[2.59, 3.37, 4.81], [2.59, 2.63, 2.66], [0.483, 0.603, 0.809], [3.46, 4.27, 5.66]],
    [[2.68, 3.44, 4.80], [2.68, 2.75, 2.81], [0.607, 0.715, 0.889], [2.49, 2.96, 3.72]],
    [[2.78, 3.53, 4.82], [2.78, 2.88, 2.98], [0.720, 0.823, 0.977], [2.02, 2.32, 2.77]],
    [[2.88, 3.62, 4.83], [2.88, 3.01, 3.14], [0.827, 0.929, 1.07], [1.74, 1.93, 2.22]],
    [[2.98, 3.72, 4.91], [2.98, 3.14, 3.31], [0.930, 1.03, 1.18], [1.56, 1.68, 1.86]],
    [[3.09, 3.81, 4.97], [3.09, 3.28, 3.48], [1.03, 1.14, 1.29], [1.43, 1.50, 1.60]],
    [[3.19, 3.91, 5.05], [3.19, 3.41, 3.65], [1.13, 1.25, 1.40], [1.34, 1.37, 1.42]],
    [[3.29, 4.01, 5.12], [3.29, 3.54, 3.82], [1.23, 1.36, 1.51], [1.27, 1.27, 1.27]],
    [[3.40, 4.12, 5.20], [3.40, 3.67, 3.98], [1.33, 1.47, 1.63], [1.21, 1.19, 1.16]],
    [[3.51, 4.22, 5.30], [3.51, 3.81, 4.16], [1.44, 1.59, 1.77], [1.16, 1.11, 1.06]],
    [[3.65, 4.36, 5.42], [3.65, 3.99, 4.39], [1.58, 1.75, 1.94], [1.10, 1.04, 0.954]],
    [[3.82, 4.54, 5.58], [3.82, 4.21, 4.67], [1.76, 1.95, 2.18], [1.05, 0.965, 0.852]],
    [[4.06, 4.78, 5.80], [4.06, 4.50, 5.04], [2.01, 2.23, 2.50], [1.01, 0.892, 0.751]],
    [[4.37, 5.10, 6.11], [4.37, 4.90, 5.56], [2.35, 2.62, 2.96], [0.958, 0.819, 0.650]],
    [[4.84, 5.57, 6.57], [4.84, 5.48, 6.31], [2.88, 3.24, 3.70], [0.912, 0.747, 0.549]],
    [[5.57, 6.34, 7.34], [5.57, 6.40, 7.51], [3.79, 4.32, 5.01], [0.868, 0.674, 0.446]],
    [[6.96, 7.78, 8.82], [6.96, 8.14, 9.79], [5.72, 6.63, 7.89], [0.828, 0.601, 0.341]],
    [[10.7, 11.7, 12.9], [10.7, 12.8, 16.0], [12.2, 14.6, 18.0], [0.795, 0.526, 0.228]],
];

/// Returns the ratio a/b of a row.
fn ratio_of(row: usize) -> f64 {
    match row {
        0..=9 => 0.1 * (row + 1) as f64,
        _ => 1.0 / (0.1 * (19 - row) as f64),
    }
}

impl<S: Real> Coefficients<S> {
    /// Returns the coefficients at a ratio a/b of the semi-axis along the rolling direction to the one across
    /// it, and a Poisson's ratio (0 to 0.5).
    pub fn of(ratio: S, poisson: f64) -> Self {
        let at = libm::log(ratio.value());
        let abscissa = |row: usize| libm::log(ratio_of(row));
        let interval = (1..ROWS - 1).take_while(|row| abscissa(*row) <= at).count();
        let one = |column: usize| {
            let [value, slope] = cubic(interval, at, &abscissa, &|row| {
                by_poisson(TABLE[row][column], poisson)
            });
            ratio.chain(value, slope / ratio.value())
        };
        Self {
            c11: one(0),
            c22: one(1),
            c23: one(2),
            c33: one(3),
        }
    }
}

/// Returns the value at a Poisson's ratio, with 1/C a parabola.
fn by_poisson([c0, c1, c2]: [f64; 3], poisson: f64) -> f64 {
    let weights = [
        8.0 * (poisson - 0.25) * (poisson - 0.5),
        -16.0 * poisson * (poisson - 0.5),
        8.0 * poisson * (poisson - 0.25),
    ];
    1.0 / (weights[0] / c0 + weights[1] / c1 + weights[2] / c2)
}

/// Returns value and slope of the monotone cubic at `at` in an interval of the rows; constant beyond them.
fn cubic(
    interval: usize,
    at: f64,
    abscissa: &impl Fn(usize) -> f64,
    value: &impl Fn(usize) -> f64,
) -> [f64; 2] {
    if at <= abscissa(0) {
        return [value(0), 0.0];
    }
    if at >= abscissa(ROWS - 1) {
        return [value(ROWS - 1), 0.0];
    }
    let secant = |row: usize| (value(row + 1) - value(row)) / (abscissa(row + 1) - abscissa(row));
    // The slope at a row: the harmonic mean of the secants beside it, weighted by the intervals.
    let slope = |row: usize| {
        if row == 0 || row == ROWS - 1 {
            return 0.0;
        }
        let (left, right) = (secant(row - 1), secant(row));
        if left * right <= 0.0 {
            return 0.0;
        }
        let (before, after) = (
            abscissa(row) - abscissa(row - 1),
            abscissa(row + 1) - abscissa(row),
        );
        let share = (before + 2.0 * after) / (3.0 * (before + after));
        left * right / (share * right + (1.0 - share) * left)
    };
    let (start, length) = (abscissa(interval), abscissa(interval + 1) - abscissa(interval));
    let t = (at - start) / length;
    let (y0, y1) = (value(interval), value(interval + 1));
    let (d0, d1) = (slope(interval) * length, slope(interval + 1) * length);
    let (c2, c3) = (3.0 * (y1 - y0) - 2.0 * d0 - d1, 2.0 * (y0 - y1) + d0 + d1);
    [
        y0 + t * (d0 + t * (c2 + t * c3)),
        (d0 + t * (2.0 * c2 + 3.0 * t * c3)) / length,
    ]
}
