//! The cubic spline through tabulated points, with not-a-knot ends: twice continuously differentiable.

use numerics::scalar::Real;
use serde::{Deserialize, Serialize};
use thiserror::Error;

/// A cubic spline. Outside its abscissae the end pieces go on.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(try_from = "Points", into = "Points")]
pub struct Spline {
    abscissae: Vec<f64>,
    ordinates: Vec<f64>,
    /// Second derivatives at the abscissae.
    curvatures: Vec<f64>,
}

/// Knots and ordinates of a spline.
#[derive(Clone, Debug, Serialize, Deserialize)]
struct Points {
    abscissae: Vec<f64>,
    ordinates: Vec<f64>,
}

/// Reasons why points define no spline.
#[derive(Clone, Debug, PartialEq, Error)]
pub enum SplineError {
    /// Too few points.
    #[error("{got} points; a cubic spline needs at least 4")]
    TooFew {
        /// Their number.
        got: usize,
    },
    /// Unequal numbers of abscissae and ordinates.
    #[error("{abscissae} abscissae, but {ordinates} ordinates")]
    Unequal {
        /// Number of abscissae.
        abscissae: usize,
        /// Number of ordinates.
        ordinates: usize,
    },
    /// The abscissae do not increase strictly.
    #[error(
        "point {index} (counted from 1): {value} does not come after {previous}; abscissae must increase"
    )]
    NotIncreasing {
        /// Number of the point, counted from 1.
        index: usize,
        /// Its abscissa.
        value: f64,
        /// The one before.
        previous: f64,
    },
    /// Points so close to each other that the spline overflows.
    #[error(
        "at point {index} (counted from 1) the curvature is not finite: abscissae are too close to each other"
    )]
    Steep {
        /// Number of the point, counted from 1.
        index: usize,
    },
    /// A value is infinite or not a number.
    #[error("point {index} (counted from 1) is not finite")]
    NotFinite {
        /// Number of the point, counted from 1.
        index: usize,
    },
}

impl Spline {
    /// Returns the spline through the points (`abscissae[i]`, `ordinates[i]`).
    ///
    /// # Errors
    /// Fewer than four points, unequal lengths, values that are not finite, abscissae that do not increase
    /// or are so close to each other that curvatures overflow.
    pub fn new(abscissae: Vec<f64>, ordinates: Vec<f64>) -> Result<Self, SplineError> {
        let n = abscissae.len();
        if n != ordinates.len() {
            return Err(SplineError::Unequal {
                abscissae: n,
                ordinates: ordinates.len(),
            });
        }
        if n < 4 {
            return Err(SplineError::TooFew { got: n });
        }
        for i in 0..n {
            if !(abscissae[i].is_finite() && ordinates[i].is_finite()) {
                return Err(SplineError::NotFinite { index: i + 1 });
            }
            if i > 0 && abscissae[i] <= abscissae[i - 1] {
                return Err(SplineError::NotIncreasing {
                    index: i + 1,
                    value: abscissae[i],
                    previous: abscissae[i - 1],
                });
            }
        }
        let curvatures = curvatures(&abscissae, &ordinates);
        if let Some(index) = curvatures.iter().position(|curvature| !curvature.is_finite()) {
            return Err(SplineError::Steep { index: index + 1 });
        }
        Ok(Self {
            abscissae,
            ordinates,
            curvatures,
        })
    }

    /// Returns the first and last abscissa.
    #[must_use]
    pub fn range(&self) -> (f64, f64) {
        (self.abscissae[0], self.abscissae[self.abscissae.len() - 1])
    }

    /// Returns the points, as given.
    pub fn points(&self) -> impl ExactSizeIterator<Item = (f64, f64)> + '_ {
        self.abscissae.iter().copied().zip(self.ordinates.iter().copied())
    }

    /// Returns the spline with all ordinates times a factor.
    #[must_use]
    pub fn scaled(&self, factor: f64) -> Self {
        let times = |values: &[f64]| values.iter().map(|value| value * factor).collect();
        Self {
            abscissae: self.abscissae.clone(),
            ordinates: times(&self.ordinates),
            curvatures: times(&self.curvatures),
        }
    }

    /// Returns the spline of the abscissae with the other sign.
    #[must_use]
    pub fn mirrored(&self) -> Self {
        let reversed = |values: &[f64]| values.iter().rev().copied().collect();
        Self {
            abscissae: self.abscissae.iter().rev().map(|abscissa| -abscissa).collect(),
            ordinates: reversed(&self.ordinates),
            curvatures: reversed(&self.curvatures),
        }
    }

    /// Returns the value, first and second derivative.
    #[must_use]
    pub fn evaluate<S: Real>(&self, x: S) -> [S; 3] {
        let last = self.abscissae.len() - 2;
        let i = self
            .abscissae
            .partition_point(|a| *a <= x.value())
            .saturating_sub(1)
            .min(last);
        let h = self.abscissae[i + 1] - self.abscissae[i];
        let (ca, cb) = (self.curvatures[i], self.curvatures[i + 1]);
        let slope = (self.ordinates[i + 1] - self.ordinates[i]) / h - h * (2.0 * ca + cb) / 6.0;
        let third = (cb - ca) / h;
        let d = x - self.abscissae[i];
        let curvature = d * third + ca;
        [
            d * (d * (d * (third / 6.0) + 0.5 * ca) + slope) + self.ordinates[i],
            d * (d * (0.5 * third) + ca) + slope,
            curvature,
        ]
    }
}

/// Returns the second derivatives at the knots; the third derivative is continuous at the second and last but
/// one knot (not-a-knot, de Boor 1978, chapter IV).
fn curvatures(x: &[f64], y: &[f64]) -> Vec<f64> {
    let n = x.len();
    let h: Vec<f64> = x.windows(2).map(|w| w[1] - w[0]).collect();
    let slope: Vec<f64> = (0..n - 1).map(|i| (y[i + 1] - y[i]) / h[i]).collect();
    // Tridiagonal system for the inner curvatures, the outer ones eliminated by the end conditions.
    let m = n - 2;
    let mut lower = vec![0.0; m];
    let mut diagonal = vec![0.0; m];
    let mut upper = vec![0.0; m];
    let mut right = vec![0.0; m];
    for k in 0..m {
        let (a, b) = (h[k], h[k + 1]);
        lower[k] = a;
        diagonal[k] = 2.0 * (a + b);
        upper[k] = b;
        right[k] = 6.0 * (slope[k + 1] - slope[k]);
    }
    let (a, b) = (h[0], h[1]);
    diagonal[0] += a * (a + b) / b;
    upper[0] -= a * a / b;
    let (a, b) = (h[n - 2], h[n - 3]);
    diagonal[m - 1] += a * (a + b) / b;
    lower[m - 1] -= a * a / b;
    for k in 1..m {
        let factor = lower[k] / diagonal[k - 1];
        diagonal[k] -= factor * upper[k - 1];
        right[k] -= factor * right[k - 1];
    }
    let mut inner = vec![0.0; n];
    for k in (0..m).rev() {
        let next = if k + 1 < m { upper[k] * inner[k + 2] } else { 0.0 };
        inner[k + 1] = (right[k] - next) / diagonal[k];
    }
    inner[0] = inner[1] - h[0] / h[1] * (inner[2] - inner[1]);
    inner[n - 1] = inner[n - 2] + h[n - 2] / h[n - 3] * (inner[n - 2] - inner[n - 3]);
    inner
}

impl TryFrom<Points> for Spline {
    type Error = SplineError;
    fn try_from(points: Points) -> Result<Self, SplineError> {
        Self::new(points.abscissae, points.ordinates)
    }
}

impl From<Spline> for Points {
    fn from(spline: Spline) -> Self {
        Self {
            abscissae: spline.abscissae,
            ordinates: spline.ordinates,
        }
    }
}
