//! A piecewise linear characteristic: straight between its points, the end slopes continued outside.

use numerics::scalar::Real;
use serde::{Deserialize, Serialize};
use thiserror::Error;

/// Force (N) over compression (m), piecewise linear.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(try_from = "Vec<[f64; 2]>", into = "Vec<[f64; 2]>")]
pub struct Characteristic {
    points: Vec<[f64; 2]>,
    /// Energy at each point, J, from the first on.
    energies: Vec<f64>,
    /// Energy at zero compression, J.
    zero: f64,
}

/// Reasons why points define no characteristic.
#[derive(Clone, Debug, PartialEq, Error)]
pub enum CharacteristicError {
    /// Too few points.
    #[error("{got} points; a characteristic needs at least 2")]
    TooFew {
        /// Their number.
        got: usize,
    },
    /// A value is infinite or not a number.
    #[error("point {index} (counted from 1) is not finite")]
    NotFinite {
        /// Number of the point, counted from 1.
        index: usize,
    },
    /// The compressions do not increase strictly.
    #[error(
        "point {index} (counted from 1): {value} does not come after {previous}; compressions must increase"
    )]
    NotIncreasing {
        /// Number of the point, counted from 1.
        index: usize,
        /// Its compression, m.
        value: f64,
        /// The one before, m.
        previous: f64,
    },
    /// Points so close to each other that the stiffness overflows.
    #[error(
        "at point {index} (counted from 1) the stiffness is not finite: compressions are too close to each \
         other"
    )]
    Steep {
        /// Number of the point, counted from 1.
        index: usize,
    },
    /// The force falls with compression: such a coil would snap through.
    #[error("point {index} (counted from 1): the force falls from {previous} to {value} N; it must not fall")]
    Falling {
        /// Number of the point, counted from 1.
        index: usize,
        /// Its force, N.
        value: f64,
        /// The one before, N.
        previous: f64,
    },
}

impl Characteristic {
    /// Returns the characteristic through points of compression (m) and force (N).
    ///
    /// # Errors
    /// Fewer than two points, values not finite, compressions that do not increase or are so close
    /// to each other that the stiffness overflows, forces that fall.
    pub fn new(points: Vec<[f64; 2]>) -> Result<Self, CharacteristicError> {
        if points.len() < 2 {
            return Err(CharacteristicError::TooFew { got: points.len() });
        }
        if let Some(i) = points
            .iter()
            .position(|p| !(p[0].is_finite() && p[1].is_finite()))
        {
            return Err(CharacteristicError::NotFinite { index: i + 1 });
        }
        for (i, pair) in points.windows(2).enumerate() {
            let [a, b] = [pair[0], pair[1]];
            if b[0] <= a[0] {
                return Err(CharacteristicError::NotIncreasing {
                    index: i + 2,
                    value: b[0],
                    previous: a[0],
                });
            }
            if b[1] < a[1] {
                return Err(CharacteristicError::Falling {
                    index: i + 2,
                    value: b[1],
                    previous: a[1],
                });
            }
        }
        let stiffness = |pair: &[[f64; 2]]| (pair[1][1] - pair[0][1]) / (pair[1][0] - pair[0][0]);
        if let Some(i) = points.windows(2).position(|pair| !stiffness(pair).is_finite()) {
            return Err(CharacteristicError::Steep { index: i + 2 });
        }
        let mut energies = vec![0.0];
        for pair in points.windows(2) {
            let area = 0.5 * (pair[0][1] + pair[1][1]) * (pair[1][0] - pair[0][0]);
            energies.push(energies[energies.len() - 1] + area);
        }
        let mut table = Self {
            points,
            energies,
            zero: 0.0,
        };
        table.zero = table.energy(0.0);
        Ok(table)
    }

    /// Returns the points.
    #[must_use]
    pub fn points(&self) -> &[[f64; 2]] {
        &self.points
    }

    /// Returns the piece that holds an abscissa, and its slope.
    #[inline(always)]
    fn piece(&self, x: f64) -> (usize, f64) {
        let i = self
            .points
            .partition_point(|p| p[0] <= x)
            .saturating_sub(1)
            .min(self.points.len() - 2);
        let [a, b] = [self.points[i], self.points[i + 1]];
        (i, (b[1] - a[1]) / (b[0] - a[0]))
    }

    /// Returns the force at a compression.
    #[inline(always)]
    pub fn evaluate<S: Real>(&self, x: S) -> S {
        let (i, slope) = self.piece(x.value());
        (x - self.points[i][0]) * slope + self.points[i][1]
    }

    /// Returns the energy stored at a compression, J; zero at zero compression.
    #[must_use]
    pub fn energy(&self, x: f64) -> f64 {
        let (i, slope) = self.piece(x);
        let d = x - self.points[i][0];
        self.energies[i] + d * (self.points[i][1] + 0.5 * slope * d) - self.zero
    }

    /// Returns the energy stored where the force falls to zero, J: the least energy of all.
    #[must_use]
    pub fn energy_at_zero_force(&self) -> f64 {
        let i = self
            .points
            .iter()
            .position(|p| p[1] > 0.0)
            .map_or(self.points.len() - 2, |i| i.saturating_sub(1));
        let (x, force) = (self.points[i][0], self.points[i][1]);
        let slope = self.piece(x).1;
        if slope > 0.0 {
            self.energy(x - force / slope)
        } else {
            self.energy(x)
        }
    }
}

impl TryFrom<Vec<[f64; 2]>> for Characteristic {
    type Error = CharacteristicError;
    fn try_from(points: Vec<[f64; 2]>) -> Result<Self, CharacteristicError> {
        Self::new(points)
    }
}

impl From<Characteristic> for Vec<[f64; 2]> {
    fn from(table: Characteristic) -> Self {
        table.points
    }
}
