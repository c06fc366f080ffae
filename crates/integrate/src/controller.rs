//! Step-size controller.

use serde::{Deserialize, Serialize};

use crate::error::SetupError;
use crate::limits::MAXIMUM_REJECTIONS;
use crate::methods::tableau::Family;
use crate::options::Options;
use crate::tuning::controller as tuning;
use crate::validation::check_not_negative;

/// Proportional-integral controller: K. Gustafsson, *Control-theoretic techniques for stepsize selection in
/// implicit Runge-Kutta methods*, ACM TOMS 20 (1994), in the form of Hairer & Wanner (1996), section IV.8.
///
/// It works on the error root `error^(1/(q+1))`, q the order of the embedded solution: a number proportional
/// to the step.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub(crate) struct Controller {
    /// Length of the last accepted step; zero: there was none since the last restart.
    step: f64,
    /// Error root of that step.
    root: f64,
    /// Number of rejections since then.
    rejections: u32,
    /// Family of its method: errors of another method say nothing about the trend.
    family: Family,
}

impl Controller {
    /// Forgets the trend.
    pub fn restart(&mut self) {
        *self = Self::default();
    }

    /// Checks the controller of a saved state.
    pub fn check(&self) -> Result<(), SetupError> {
        check_not_negative("controller.step", self.step)?;
        check_not_negative("controller.root", self.root)?;
        if self.rejections > MAXIMUM_REJECTIONS {
            let value = f64::from(self.rejections);
            let name = "controller.rejections";
            return Err(SetupError::Damaged { name, value });
        }
        Ok(())
    }

    /// After an accepted step: returns the factor for the next step, and whether it is a prediction (not the
    /// largest factor).
    ///
    /// If the problem predicts its discontinuities, the step before a rejection is left out of the trend: a
    /// discontinuity lies between.
    #[inline]
    pub fn accept(
        &mut self,
        options: &Options,
        step: f64,
        root: f64,
        predicts_discontinuities: bool,
        family: Family,
    ) -> (f64, bool) {
        let mut divisor = root / options.safety;
        if self.step > 0.0 && self.family == family && !(predicts_discontinuities && self.rejections > 0) {
            divisor = divisor.max(root * root / (self.root * options.safety) * (self.step / step));
        }
        let growth = limited_growth(1.0 / divisor, family);
        let maximum = options.maximum_factor;
        let mut factor = growth.max(options.minimum_factor).min(maximum);
        if self.rejections > 0 {
            factor = factor.min(1.0);
        }
        self.rejections = 0;
        self.step = step;
        self.family = family;
        self.root = root.max(tuning::MINIMUM_ERROR_ROOT);
        (factor, growth < maximum)
    }

    /// After a step whose error was too large: returns the factor for the next attempt.
    #[inline]
    pub fn reject(&mut self, options: &Options, root: f64) -> f64 {
        self.rejections += 1;
        let factor = (options.safety / root).max(options.minimum_factor);
        if self.rejections > 1 {
            factor.min(tuning::REPEATED_REJECTION_FACTOR)
        } else {
            factor
        }
    }

    /// Counts a step that could not be computed.
    pub fn fail(&mut self) {
        self.rejections += 1;
    }
}

/// Returns the growth of the step: for Rosenbrock methods the root of what the error allows, up to
/// [`tuning::SLOW_GROWTH_LIMIT`].
#[inline]
fn limited_growth(allowed: f64, family: Family) -> f64 {
    if allowed <= 1.0 || family != Family::LinearlyImplicit {
        allowed
    } else if allowed < tuning::SLOW_GROWTH_LIMIT {
        allowed.sqrt()
    } else {
        // 1/√SLOW_GROWTH_LIMIT
        allowed * std::f64::consts::FRAC_1_SQRT_2
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rosenbrock_steps_grow_by_the_root_of_what_the_error_allows() {
        // 0.9 over an error root of 0.5: 1.8 times as long.
        let after = |family| {
            Controller::default()
                .accept(&Options::default(), 1.0, 0.5, false, family)
                .0
        };
        assert!((after(Family::Explicit) - 1.8).abs() < 1e-12);
        assert!((after(Family::LinearlyImplicit) - 1.8_f64.sqrt()).abs() < 1e-12);
    }

    #[test]
    fn slow_growth_is_continuous_at_its_limit() {
        let limit = tuning::SLOW_GROWTH_LIMIT;
        let below = limited_growth(limit * (1.0 - 1e-15), Family::LinearlyImplicit);
        assert!((below - limited_growth(limit, Family::LinearlyImplicit)).abs() < 1e-14);
    }
}
