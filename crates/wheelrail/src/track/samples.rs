//! An irregularity given at distances: a natural cubic spline whose ends are tapered.
//!
//! The spline passes through all values, and its second derivative is continuous, as contact on a rail asks
//! for. It is multiplied by `sin²` within the taper at each end, and is zero beyond: a vehicle meets no jump.

use std::f64::consts::FRAC_PI_2;

use super::measured_error::MeasuredError;

/// Values over the distance.
#[derive(Clone, Debug, PartialEq)]
pub struct Samples {
    distances: Vec<f64>,
    values: Vec<f64>,
    /// Second derivatives at the distances.
    seconds: Vec<f64>,
    taper: f64,
}

impl Samples {
    /// Returns the spline through values (m) at rising distances (m), tapered within `taper` (m) at both
    /// ends.
    ///
    /// # Errors
    /// [`MeasuredError::Samples`]: less than four values, distances that do not rise, or a taper that is not
    /// positive or longer than half the range.
    pub fn new(distances: Vec<f64>, values: Vec<f64>, taper: f64) -> Result<Self, MeasuredError> {
        let count = distances.len();
        let wrong = |what: String| Err(MeasuredError::Samples { what });
        if count < 4 || values.len() != count {
            return wrong(format!(
                "there are {count} distances and {} values; at least four of each are needed",
                values.len()
            ));
        }
        if let Some(k) = (1..count).find(|&k| !(distances[k] > distances[k - 1] && distances[k].is_finite()))
        {
            return wrong(format!(
                "distance {} m follows {} m; distances must rise",
                distances[k],
                distances[k - 1]
            ));
        }
        if values.iter().any(|value| !value.is_finite()) {
            return wrong("a value is not a finite number".to_owned());
        }
        let range = distances[count - 1] - distances[0];
        if !(taper > 0.0 && 2.0 * taper <= range) {
            return wrong(format!(
                "a taper of {taper} m does not fit twice into {range} m; it must be positive and fit"
            ));
        }
        let seconds = natural_spline(&distances, &values);
        Ok(Self {
            distances,
            values,
            seconds,
            taper,
        })
    }

    /// Returns the first and the last distance, m.
    #[must_use]
    pub fn range(&self) -> [f64; 2] {
        [self.distances[0], self.distances[self.distances.len() - 1]]
    }

    /// Returns the value (m) at a distance (m), its slope and its second derivative (1/m).
    #[must_use]
    pub fn at(&self, distance: f64) -> [f64; 3] {
        let [first, last] = self.range();
        if !(distance > first && distance < last) {
            return [0.0; 3];
        }
        let k = self.distances.partition_point(|own| *own <= distance) - 1;
        let pair = |own: &[f64]| [own[k], own[k + 1]];
        let own = piece(
            pair(&self.distances),
            pair(&self.values),
            pair(&self.seconds),
            distance,
        );
        let (inside, sense) = match distance - first < last - distance {
            true => (distance - first, 1.0),
            false => (last - distance, -1.0),
        };
        if inside >= self.taper {
            return own;
        }
        let rate = FRAC_PI_2 / self.taper;
        let (sine, cosine) = libm::sincos(rate * inside);
        let window = [
            sine * sine,
            sense * 2.0 * rate * sine * cosine,
            2.0 * rate * rate * (cosine * cosine - sine * sine),
        ];
        [
            window[0] * own[0],
            window[1] * own[0] + window[0] * own[1],
            window[2] * own[0] + 2.0 * window[1] * own[1] + window[0] * own[2],
        ]
    }
}

/// Returns value, slope and second derivative at a place within one piece of a spline: places, values and
/// second derivatives of its ends.
pub(super) fn piece([x0, x1]: [f64; 2], [y0, y1]: [f64; 2], [m0, m1]: [f64; 2], at: f64) -> [f64; 3] {
    let h = x1 - x0;
    let (a, b) = ((x1 - at) / h, (at - x0) / h);
    [
        a * y0 + b * y1 + ((a * a * a - a) * m0 + (b * b * b - b) * m1) * h * h / 6.0,
        (y1 - y0) / h + ((3.0 * b * b - 1.0) * m1 - (3.0 * a * a - 1.0) * m0) * h / 6.0,
        a * m0 + b * m1,
    ]
}

/// Returns the second derivatives of the spline with none at its ends, by elimination of the tridiagonal
/// system.
pub(super) fn natural_spline(x: &[f64], y: &[f64]) -> Vec<f64> {
    let count = x.len();
    let (mut upper, mut right) = (vec![0.0; count], vec![0.0; count]);
    for k in 1..count - 1 {
        let (before, after) = (x[k] - x[k - 1], x[k + 1] - x[k]);
        let jump = (y[k + 1] - y[k]) / after - (y[k] - y[k - 1]) / before;
        let pivot = 2.0 * (before + after) - before * upper[k - 1];
        upper[k] = after / pivot;
        right[k] = (6.0 * jump - before * right[k - 1]) / pivot;
    }
    let mut seconds = vec![0.0; count];
    for k in (1..count - 1).rev() {
        seconds[k] = right[k] - upper[k] * seconds[k + 1];
    }
    seconds
}
