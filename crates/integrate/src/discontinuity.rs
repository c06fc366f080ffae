//! Discontinuities of the right-hand side and of its derivatives: the functions from which
//! they are predicted, and the predictions.

use serde::{Deserialize, Serialize};

use crate::error::SetupError;
use crate::validation::{check_finite, check_positive};

/// Functions of time and state from which discontinuities are predicted, see
/// [`crate::Problem::discontinuities`].
#[derive(Clone, Debug, Default)]
pub struct DiscontinuityFunctions {
    /// Smooth functions across whose zeros a derivative of the right-hand side jumps (the gap of a contact).
    pub values: Vec<f64>,
    /// Slips: dimensionless plane vectors around whose zero, in a circle of radius 1 (the *regularization
    /// zone*), the right-hand side changes almost like a jump. The slip velocity of a contact point over the
    /// reference speed of its regularized friction law is one. Not a number where there is no friction.
    pub slips: Vec<[f64; 2]>,
}

impl DiscontinuityFunctions {
    /// Returns zeros, so many values and slips.
    pub(crate) fn zeros((values, slips): (usize, usize)) -> Self {
        Self {
            values: vec![0.0; values],
            slips: vec![[0.0; 2]; slips],
        }
    }
}

/// A regularization zone in which a slip is predicted to reverse, or to come to stick.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub(crate) struct RegularizationZone {
    /// Length of the first step in the zone.
    #[serde(rename = "length")]
    pub first_step: f64,
    /// Component of the slip along [`RegularizationZone::direction`] at the edge of the zone.
    #[serde(rename = "size")]
    pub edge_slip: f64,
    /// Index of the slip.
    #[serde(rename = "direction")]
    pub slip: usize,
    /// Unit vector of the slip before the zone.
    #[serde(rename = "from")]
    pub direction: [f64; 2],
}

/// What is predicted for the next step.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub(crate) enum Prediction {
    /// A discontinuity: the next step should end at this time, shortly after it.
    #[serde(rename = "Kink")]
    Discontinuity(f64),
    /// A regularization zone: the next step should end at this time, before it.
    #[serde(rename = "Layer")]
    Zone(f64, RegularizationZone),
    /// A regularization zone so near that the next step starts in it.
    #[serde(rename = "InLayer")]
    InZone(RegularizationZone),
}

/// A regularization zone that is being crossed.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub(crate) struct ZoneCrossing {
    #[serde(rename = "layer")]
    pub zone: RegularizationZone,
    /// Length of the steps before the zone.
    #[serde(rename = "planned")]
    pub planned_step: f64,
}

impl Prediction {
    /// Checks a saved prediction for a problem with so many slips.
    pub fn check(&self, slips: usize) -> Result<(), SetupError> {
        let (time, zone) = match self {
            Self::Discontinuity(time) => (*time, None),
            Self::Zone(time, zone) => (*time, Some(zone)),
            Self::InZone(zone) => (0.0, Some(zone)),
        };
        check_finite("ahead", time)?;
        zone.map_or(Ok(()), |zone| zone.check(slips))
    }
}

impl RegularizationZone {
    fn check(&self, slips: usize) -> Result<(), SetupError> {
        if self.slip >= slips {
            return Err(SetupError::Dimension {
                what: "slips, of which a regularization zone names one by its index,",
                expected: slips,
                found: self.slip,
            });
        }
        check_positive("layer.length", self.first_step)?;
        check_finite("layer.size", self.edge_slip)?;
        check_finite("layer.from", self.direction[0])?;
        check_finite("layer.from", self.direction[1])
    }
}

impl ZoneCrossing {
    /// Checks a saved crossing for a problem with so many slips.
    pub fn check(&self, slips: usize) -> Result<(), SetupError> {
        check_positive("passage.planned", self.planned_step)?;
        self.zone.check(slips)
    }
}

/// Returns the square of the length of a plane vector.
pub(crate) fn square([a, b]: &[f64; 2]) -> f64 {
    a * a + b * b
}
