//! Options of an integration.

use serde::{Deserialize, Serialize};

use crate::error::SetupError;
use crate::methods::Method;
use crate::methods::tableau::Family;
use crate::tuning::options as tuning;

/// Options of an integration.
///
/// ```
/// use integrate::{Method, Options};
/// let options = Options { method: Method::Rodas5P, relative_tolerance: 1e-8, ..Options::default() };
/// assert!(options.check().is_ok());
/// ```
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Options {
    /// The method.
    pub method: Method,
    /// True if a Rosenbrock method may make explicit steps where the problem is not stiff
    /// ([`crate::Problem::spectral_radius_bound`]).
    pub explicit_steps: bool,
    /// True if events, the changes of the problem's discrete states, are located and recorded
    /// ([`crate::ProblemStructure::event_groups`]). Steps and states are the same without.
    #[serde(rename = "record_switches")]
    pub record_events: bool,
    /// Admissible local error of each state, relative to its scale ([`crate::ProblemStructure::scales`]).
    pub relative_tolerance: f64,
    /// First step; none: it is estimated.
    pub initial_step: Option<f64>,
    /// Length of all steps, instead of error control (steps are shortened only at limits and time
    /// discontinuities).
    pub fixed_step: Option<f64>,
    /// Largest step; may be infinite. (None stands for infinite in formats that cannot write it.)
    #[serde(with = "infinite_as_none")]
    pub maximum_step: f64,
    /// A step that would have to be shorter than this after a rejection is an error. The resolution of the
    /// time is another bound.
    pub minimum_step: f64,
    /// Largest number of attempted steps since the start of the run, rejected ones included.
    pub maximum_steps: u64,
    /// Safety factor of the step-size controller.
    pub safety: f64,
    /// Smallest factor by which a step changes because of its error.
    pub minimum_factor: f64,
    /// Largest factor by which a step grows.
    pub maximum_factor: f64,
    /// Largest number of events in one step.
    pub maximum_events: usize,
}

impl Default for Options {
    fn default() -> Self {
        Self {
            method: Method::default(),
            explicit_steps: true,
            record_events: true,
            relative_tolerance: tuning::RELATIVE_TOLERANCE,
            initial_step: None,
            fixed_step: None,
            maximum_step: f64::INFINITY,
            minimum_step: 0.0,
            maximum_steps: u64::MAX,
            safety: tuning::SAFETY,
            minimum_factor: tuning::MINIMUM_FACTOR,
            maximum_factor: tuning::MAXIMUM_FACTOR,
            maximum_events: tuning::MAXIMUM_EVENTS,
        }
    }
}

impl Options {
    /// Returns the defaults for a method. Steps of an ESDIRK method grow slowly, so that its stage predictor
    /// is near enough.
    #[must_use]
    pub fn of(method: Method) -> Self {
        let options = Self {
            method,
            ..Self::default()
        };
        match method.tableau().family {
            Family::DiagonallyImplicit => Self {
                safety: tuning::ESDIRK_SAFETY,
                maximum_factor: tuning::ESDIRK_MAXIMUM_FACTOR,
                ..options
            },
            Family::LinearlyImplicit | Family::Explicit => options,
        }
    }

    /// Checks all values.
    ///
    /// # Errors
    /// Names the first value that is not admissible.
    pub fn check(&self) -> Result<(), SetupError> {
        let rule = |name, value: f64, holds: bool, must: &'static str| {
            if holds {
                Ok(())
            } else {
                Err(SetupError::Option { name, value, must })
            }
        };
        let tolerance = self.relative_tolerance;
        rule(
            "relative_tolerance",
            tolerance,
            tolerance > 0.0 && tolerance < 1.0,
            "lie between 0 and 1",
        )?;
        for (name, step) in [
            ("initial_step", self.initial_step),
            ("fixed_step", self.fixed_step),
        ] {
            let step = step.unwrap_or(1.0);
            rule(
                name,
                step,
                step > 0.0 && step.is_finite(),
                "be positive and finite",
            )?;
        }
        rule(
            "maximum_step",
            self.maximum_step,
            self.maximum_step > 0.0,
            "be positive",
        )?;
        let minimum = self.minimum_step;
        rule(
            "minimum_step",
            minimum,
            minimum >= 0.0 && minimum < self.maximum_step,
            "lie below maximum_step",
        )?;
        rule(
            "safety",
            self.safety,
            self.safety > 0.0 && self.safety < 1.0,
            "lie between 0 and 1",
        )?;
        let factor = self.minimum_factor;
        rule(
            "minimum_factor",
            factor,
            factor > 0.0 && factor < 1.0,
            "lie between 0 and 1",
        )?;
        let factor = self.maximum_factor;
        rule(
            "maximum_factor",
            factor,
            factor > 1.0 && factor.is_finite(),
            "be finite and larger than 1",
        )
    }
}

/// Formats like JSON have no infinity.
mod infinite_as_none {
    use serde::{Deserialize, Deserializer, Serialize, Serializer};

    pub fn serialize<S: Serializer>(value: &f64, serializer: S) -> Result<S::Ok, S::Error> {
        value.is_finite().then_some(*value).serialize(serializer)
    }

    pub fn deserialize<'de, D: Deserializer<'de>>(deserializer: D) -> Result<f64, D::Error> {
        Ok(Option::<f64>::deserialize(deserializer)?.unwrap_or(f64::INFINITY))
    }
}
