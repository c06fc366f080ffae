//! Figures of a car that limits depend on.
use car::Parameters;

/// The figures, SI.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CarFigures {
    /// Least static axle load, N.
    pub least_static_axle_load: f64,
}

impl CarFigures {
    /// Returns them.
    #[must_use]
    pub fn of(_parameters: &Parameters) -> Self {
        Self {
            least_static_axle_load: f64::NAN,
        }
    }

    /// Returns the figure with the name of a measure.
    #[must_use]
    pub fn named(&self, _name: &str) -> Option<f64> {
        None
    }
}
