//! Search for the first zero of several functions along a dense output, where evaluations are expensive: a
//! bracket that closes around it, with polynomial interpolation guarded by bisection.

use crate::tuning::root_search as tuning;

/// Number of points that are stored: the ends of the bracket and two that were ends before.
const POINTS: usize = 4;
const LOW: usize = 0;
const HIGH: usize = 1;
const PREVIOUS: usize = 2;
const EARLIER: usize = 3;

/// A bracket with the values of the functions at its ends and at two earlier points.
///
/// A caller writes the values at a point to [`RootSearch::values_mut`], then calls [`RootSearch::set_low`],
/// [`RootSearch::set_high`] or [`RootSearch::set_outside`] with the point.
#[derive(Clone, Debug)]
pub(crate) struct RootSearch {
    /// Number of functions.
    count: usize,
    /// Low end, high end, points that were ends before, the latest first; not a number: there is none yet.
    points: [f64; POINTS],
    /// Row in `values` of each point; the last entry is the row for the next point.
    rows: [usize; POINTS + 1],
    values: Vec<f64>,
    /// Number of iterations, and the width of the bracket at the last check.
    iteration: u32,
    checked_width: f64,
    /// True if the last point was the midpoint, because the bracket closed too slowly.
    halved: bool,
    /// The end that the last point was intended to move, and how often in a row the other end moved instead,
    /// by less than the resolution.
    intended: Option<usize>,
    misses: i32,
}

impl RootSearch {
    pub fn new(count: usize) -> Self {
        Self {
            count,
            points: [f64::NAN; POINTS],
            rows: std::array::from_fn(|k| k),
            values: vec![0.0; count * (POINTS + 1)],
            iteration: 0,
            checked_width: f64::INFINITY,
            halved: false,
            intended: None,
            misses: 0,
        }
    }

    /// Forgets all points.
    pub fn clear(&mut self) {
        self.points = [f64::NAN; POINTS];
        (self.iteration, self.checked_width) = (0, f64::INFINITY);
        (self.halved, self.intended, self.misses) = (false, None, 0);
    }

    /// Returns the place for the values at the next point.
    #[inline]
    pub fn values_mut(&mut self) -> &mut [f64] {
        &mut self.values[self.rows[POINTS] * self.count..][..self.count]
    }

    /// Makes `point`, whose values were written to [`RootSearch::values_mut`], the low end of the bracket.
    #[inline]
    pub fn set_low(&mut self, point: f64) {
        self.set(LOW, point);
    }

    /// Makes `point` the high end of the bracket.
    #[inline]
    pub fn set_high(&mut self, point: f64) {
        self.set(HIGH, point);
    }

    /// Adds `point`, which lies outside of the bracket, for the interpolation.
    #[inline]
    pub fn set_outside(&mut self, point: f64) {
        self.set(PREVIOUS, point);
    }

    fn set(&mut self, end: usize, point: f64) {
        let row = self.rows[POINTS];
        if self.points[end].is_nan() {
            self.rows[POINTS] = self.rows[end];
        } else {
            self.rows.copy_within(PREVIOUS..POINTS, PREVIOUS + 1);
            self.points.copy_within(PREVIOUS..POINTS - 1, PREVIOUS + 1);
            self.rows[PREVIOUS] = self.rows[end];
            self.points[PREVIOUS] = self.points[end];
        }
        self.rows[end] = row;
        self.points[end] = point;
        self.misses = if self.intended.is_some_and(|intended| intended != end) {
            self.misses + 1
        } else {
            0
        };
    }

    /// Returns the ends of the bracket.
    #[inline]
    pub fn ends(&self) -> (f64, f64) {
        (self.points[LOW], self.points[HIGH])
    }

    /// Returns the values at the low end.
    #[inline]
    pub fn low(&self) -> &[f64] {
        self.row(LOW)
    }

    /// Returns the values at the high end.
    #[inline]
    pub fn high(&self) -> &[f64] {
        self.row(HIGH)
    }

    #[inline]
    fn row(&self, point: usize) -> &[f64] {
        &self.values[self.rows[point] * self.count..][..self.count]
    }

    /// Returns the next point to evaluate, if a zero is expected at `expected` and the bracket is wider than
    /// the resolution.
    pub fn next_point(&mut self, expected: f64, resolution: f64) -> f64 {
        let (low, high) = self.ends();
        let width = high - low;
        self.iteration += 1;
        self.halved = false;
        if self.iteration.is_multiple_of(tuning::CHECK_INTERVAL) || self.iteration > tuning::BISECT_AFTER {
            self.halved =
                width > tuning::CHECK_SHRINKAGE * self.checked_width || self.iteration > tuning::BISECT_AFTER;
            self.checked_width = width;
            if self.halved {
                self.intended = None;
                return 0.5 * (low + high);
            }
        }
        // Beyond the zero as seen from the nearer end, so that the farther end comes near, too; farther each
        // time the values are so small that their rounding errors decide.
        let (to_low, to_high) = (expected - low, high - expected);
        if to_low.min(to_high) > resolution {
            self.misses = 0;
        }
        let growth = tuning::NUDGE_GROWTH_BITS * self.misses.min(tuning::MAXIMUM_NUDGE_GROWTH);
        let nudge = tuning::NUDGE * resolution * f64::from(1 << growth);
        let (intended, point) = if to_low < to_high {
            (HIGH, expected + nudge)
        } else {
            (LOW, expected - nudge)
        };
        self.intended = Some(intended);
        let distance = tuning::END_DISTANCE * resolution.min(width);
        if point.is_finite() {
            point.max(low + distance).min(high - distance)
        } else {
            0.5 * (low + high)
        }
    }

    /// Returns the expected zero of a function that changes its sign in the bracket: that of the polynomial
    /// through all points, or of a part of them.
    pub fn zero(&self, index: usize) -> f64 {
        let at = |point: usize| (self.points[point], self.row(point)[index]);
        let ((low, first), (high, last)) = (at(LOW), at(HIGH));
        let width = high - low;
        let line = width * (first / (first - last));
        // Divided differences: first + t (slope + (t - width) curvature), t from the low end.
        let (previous, value) = at(PREVIOUS);
        let slope = (last - first) / width;
        let outer_slope = (value - last) / (previous - high);
        let curvature = (outer_slope - slope) / (previous - low);
        let start = slope - width * curvature;
        let root = (start * start - 4.0 * first * curvature).sqrt();
        let parabola = 2.0 * first / (if first > last { root } else { -root } - start);
        let inside = |t: f64| t >= 0.0 && t <= width;
        let one_sided = if previous > high {
            width - last / outer_slope
        } else {
            -first * (previous - low) / (value - first)
        };
        if self.halved && inside(one_sided) {
            // The function is smooth on one side only.
            return low + one_sided;
        }
        if !inside(parabola) {
            return low + line;
        }
        let (earlier, earlier_value) = at(EARLIER);
        let outermost = ((earlier_value - value) / (earlier - previous) - outer_slope) / (earlier - high);
        let third = (outermost - curvature) / (earlier - low);
        let mut cubic = parabola;
        for _ in 0..tuning::CUBIC_ITERATIONS {
            let (back, bent) = (cubic - width, curvature + (cubic - (previous - low)) * third);
            let value = first + cubic * (slope + back * bent);
            cubic -= value / (slope + back * bent + cubic * (bent + back * third));
        }
        low + if inside(cubic) { cubic } else { parabola }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    type Function<'a> = &'a dyn Fn(f64) -> f64;

    /// Returns the first zero of two functions and the number of evaluations.
    fn find(functions: [Function<'_>; 2], resolution: f64) -> (f64, usize) {
        let mut search = RootSearch::new(2);
        let write = |search: &mut RootSearch, at: f64| {
            let row = search.values_mut();
            row.copy_from_slice(&functions.map(|function| function(at)));
            row.iter().all(|value| *value > 0.0)
        };
        assert!(write(&mut search, 0.0));
        search.set_low(0.0);
        assert!(!write(&mut search, 1.0));
        search.set_high(1.0);
        let mut count = 0;
        while search.ends().1 - search.ends().0 > resolution {
            let crossing = (0..2).filter(|i| search.high()[*i] <= 0.0);
            let expected = crossing.map(|i| search.zero(i)).fold(f64::INFINITY, f64::min);
            let at = search.next_point(expected, resolution);
            count += 1;
            if write(&mut search, at) {
                search.set_low(at);
            } else {
                search.set_high(at);
            }
            assert!(count < 200);
        }
        (search.ends().1, count)
    }

    #[test]
    fn the_first_zero_is_found_to_the_resolution() {
        let never = |_: f64| 1.0;
        let line = |t: f64| 0.3 - t;
        let curve = |t: f64| libm::exp(1.7 * t) * (0.8 - t) + 0.1 * libm::sin(10.0 * (t - 0.8));
        let cliff = |t: f64| (0.7f64 - t).min(1e-6) * 1e6;
        let steep = |t: f64| 1e-3 - t.powi(9);
        let gentle = |t: f64| libm::cos(t) - 0.8 + 0.1 * t;
        // A step has no value near zero; a function that falls to zero stays there.
        let jump = |t: f64| if t < 0.123 { 1.0 } else { -1e3 };
        let floor = |t: f64| (0.4 - t).max(0.0);
        let cases: [(Function<'_>, f64, usize); 7] = [
            (&line, 0.3, 3),
            (&curve, 0.8, 9),
            (&cliff, 0.7, 12),
            (&steep, 1e-3_f64.powf(1.0 / 9.0), 20),
            (&jump, 0.123, 60),
            (&floor, 0.4, 60),
            (&gentle, 0.761_418_325_005_647_8, 6),
        ];
        for resolution in [1e-3, 1e-7, 1e-12] {
            for (number, (function, zero, most)) in cases.iter().enumerate() {
                for functions in [[*function, &never as Function<'_>], [&never, *function]] {
                    let (found, count) = find(functions, resolution);
                    println!("case {number}, {resolution}: {count}");
                    assert!(
                        (found - zero).abs() <= 1.01 * resolution,
                        "case {number}: {found}"
                    );
                    assert!(count <= *most, "case {number}: {count} evaluations");
                }
            }
        }
        let (found, _) = find([&line, &curve], 1e-12);
        assert!((found - 0.3).abs() < 1.1e-12, "{found}");
    }
}
