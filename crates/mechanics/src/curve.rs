//! Piecewise linear curves: straight between their points, the end slopes continued outside.
//!
//! Unlike a [`Characteristic`] a curve may fall, be mirrored about the origin, and be clamped. Its integral
//! from zero is exact: that is the energy of a spring that follows it.

use numerics::scalar::Real;
use serde::{Deserialize, Serialize};
use thiserror::Error;

use crate::characteristic::Characteristic;

/// An ordinate (force, moment, depth) over an abscissa (extension, rate), piecewise linear. SI units.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(try_from = "Vec<[f64; 2]>", into = "Vec<[f64; 2]>")]
pub struct Curve {
    points: Vec<[f64; 2]>,
    /// The slope of the piece that begins at each point; of the last piece also at the last point.
    slopes: Vec<f64>,
    /// The integral from zero to each point.
    integrals: Vec<f64>,
}

/// Reasons why points define no curve.
#[derive(Clone, Debug, PartialEq, Error)]
pub enum CurveError {
    /// There is no point.
    #[error("a curve needs at least one point")]
    Empty,
    /// A value is infinite or not a number.
    #[error("point {index} (counted from 1) of a curve is not finite")]
    NotFinite {
        /// Number of the point, counted from 1.
        index: usize,
    },
    /// The abscissae do not increase strictly.
    #[error("point {index} (counted from 1) of a curve: abscissa {value} does not come after {previous}")]
    NotIncreasing {
        /// Number of the point, counted from 1.
        index: usize,
        /// Its abscissa.
        value: f64,
        /// The one before.
        previous: f64,
    },
}

impl Curve {
    /// Returns the curve through points `[abscissa, ordinate]`; a single point makes a constant.
    ///
    /// # Errors
    /// No point, values not finite, abscissae that do not increase.
    pub fn new(points: Vec<[f64; 2]>) -> Result<Self, CurveError> {
        if points.is_empty() {
            return Err(CurveError::Empty);
        }
        if let Some(i) = points.iter().position(|p| !p.iter().all(|v| v.is_finite())) {
            return Err(CurveError::NotFinite { index: i + 1 });
        }
        if let Some(i) = points.windows(2).position(|pair| pair[1][0] <= pair[0][0]) {
            return Err(CurveError::NotIncreasing {
                index: i + 2,
                value: points[i + 1][0],
                previous: points[i][0],
            });
        }
        Ok(Self::through(points))
    }

    /// Returns the same; if the first point is the origin (both coordinates zero), the curve is mirrored:
    /// `f(-x) = -f(x)`.
    ///
    /// That is how the comparison program reads its tables.
    ///
    /// # Errors
    /// As [`Curve::new`].
    pub fn mirrored_from_origin(points: Vec<[f64; 2]>) -> Result<Self, CurveError> {
        if points.len() < 2 || points[0] != [0.0, 0.0] {
            return Self::new(points);
        }
        let mut all: Vec<[f64; 2]> = points[1..].iter().rev().map(|p| [-p[0], -p[1]]).collect();
        all.extend(points);
        Self::new(all)
    }

    /// Returns a constant.
    #[must_use]
    pub fn constant(value: f64) -> Self {
        Self::through(vec![[0.0, value]])
    }

    /// `slope · x`.
    #[must_use]
    pub fn linear(slope: f64) -> Self {
        Self::through(vec![[0.0, 0.0], [1.0, slope]])
    }

    /// Slopes and integrals of points that are in order.
    fn through(points: Vec<[f64; 2]>) -> Self {
        let last = points.len() - 1;
        let slope = |i: usize| (points[i + 1][1] - points[i][1]) / (points[i + 1][0] - points[i][0]);
        let slopes: Vec<f64> = match last {
            0 => vec![0.0],
            _ => (0..=last).map(|i| slope(i.min(last - 1))).collect(),
        };
        // outwards from zero: a far end does not spoil the digits near it
        let mut integrals = vec![0.0; points.len()];
        let home = points.partition_point(|p| p[0] <= 0.0).saturating_sub(1);
        let x = points[home][0];
        integrals[home] = x * (points[home][1] - 0.5 * slopes[home] * x);
        let area = |i: usize| 0.5 * (points[i][1] + points[i + 1][1]) * (points[i + 1][0] - points[i][0]);
        for i in home..last {
            integrals[i + 1] = integrals[i] + area(i);
        }
        for i in (0..home).rev() {
            integrals[i] = integrals[i + 1] - area(i);
        }
        Self {
            points,
            slopes,
            integrals,
        }
    }

    /// Returns the points.
    #[must_use]
    pub fn points(&self) -> &[[f64; 2]] {
        &self.points
    }

    /// Returns the slopes of the pieces, by the number that [`Curve::piece`] gives.
    #[must_use]
    pub fn slopes(&self) -> &[f64] {
        &self.slopes
    }

    /// Returns whether the curve is zero everywhere.
    #[must_use]
    pub fn is_zero(&self) -> bool {
        self.points.iter().all(|p| p[1] == 0.0)
    }

    /// Returns the number of the piece that holds an abscissa.
    #[inline(always)]
    #[must_use]
    pub fn piece(&self, x: f64) -> usize {
        let mut piece = 0;
        for (i, point) in self.points.iter().enumerate().skip(1) {
            if point[0] > x {
                break;
            }
            piece = i;
        }
        piece
    }

    /// Returns the ordinate.
    #[inline(always)]
    pub fn evaluate<S: Real>(&self, x: S) -> S {
        let at = x.value();
        let i = self.piece(at);
        let (point, slope) = (self.points[i], self.slopes[i]);
        x.chain(point[1] + slope * (at - point[0]), slope)
    }

    /// Returns the integral from zero to `x`.
    #[must_use]
    pub fn integral(&self, x: f64) -> f64 {
        let i = self.piece(x);
        let d = x - self.points[i][0];
        self.integrals[i] + d * (self.points[i][1] + 0.5 * self.slopes[i] * d)
    }

    /// Returns the same curve with other ordinates: `offset + factor · y`.
    #[must_use]
    pub fn scaled(&self, factor: f64, offset: f64) -> Self {
        let points = self.points.iter();
        Self::through(points.map(|p| [p[0], offset + factor * p[1]]).collect())
    }

    /// Returns the curve held between `low` and `high` (which may be infinite): again piecewise linear.
    #[must_use]
    pub fn clamped(&self, low: f64, high: f64) -> Self {
        let clamp = |y: f64| y.max(low).min(high);
        let last = self.points.len() - 1;
        if last == 0 {
            return Self::constant(clamp(self.points[0][1]));
        }
        // Where the line from a point with this slope meets a limit at a distance from `from` to `to`.
        let crossings = |i: usize, from: f64, to: f64| {
            let (point, slope) = (self.points[i], self.slopes[i]);
            let mut found: Vec<[f64; 2]> = [low, high]
                .into_iter()
                .filter(|limit| limit.is_finite() && slope != 0.0)
                .map(|limit| [point[0] + (limit - point[1]) / slope, limit])
                .filter(|p| p[0] > from && p[0] < to && p[0].is_finite())
                .collect();
            found.sort_by(|a, b| a[0].total_cmp(&b[0]));
            found
        };
        let mut points = crossings(0, f64::NEG_INFINITY, self.points[0][0]);
        for i in 0..=last {
            let point = self.points[i];
            points.push([point[0], clamp(point[1])]);
            let to = self.points.get(i + 1).map_or(f64::INFINITY, |next| next[0]);
            points.extend(crossings(i, point[0], to));
        }
        points.dedup_by(|b, a| b[0] <= a[0]);
        // Beyond the ends the clamped curve is flat, or goes on as before, from a limit too that it leaves
        // there.
        let (first, end) = (points[0], points[points.len() - 1]);
        let beyond = |[x, y]: [f64; 2], slope: f64, outwards: f64| {
            let held = (y <= low && slope * outwards < 0.0) || (y >= high && slope * outwards > 0.0);
            let step = if held { 0.0 } else { slope * outwards };
            (slope == 0.0 || y <= low || y >= high).then_some([x + outwards, y + step])
        };
        points.extend(beyond(end, self.slopes[last], 1.0));
        if let Some(point) = beyond(first, self.slopes[0], -1.0) {
            points.insert(0, point);
        }
        Self::through(points)
    }
}

impl TryFrom<Vec<[f64; 2]>> for Curve {
    type Error = CurveError;
    fn try_from(points: Vec<[f64; 2]>) -> Result<Self, CurveError> {
        Self::new(points)
    }
}

impl From<Curve> for Vec<[f64; 2]> {
    fn from(curve: Curve) -> Self {
        curve.points
    }
}

impl From<&Characteristic> for Curve {
    fn from(table: &Characteristic) -> Self {
        Self::through(table.points().to_vec())
    }
}
