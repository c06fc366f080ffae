//! Step-size control.

use serde::{Deserialize, Serialize};

use crate::error::SetupError;
use crate::methods::tableau::Family;
use crate::options::Options;
use crate::state::check_size;

/// By this factor steps may grow more than usual behind the first one after a restart, if that was explicit: its length was a guess, and nothing
/// stiff is near that its error would not tell of. (CVODE lets its first step grow ten thousandfold.)
const FIRST_GROWTH: f64 = 10.0;
/// More rejections in a row are in no state that was saved.
const MOST_REJECTIONS: u32 = 1_000_000;

/// Proportional-integral control: K. Gustafsson, *Control-theoretic techniques for stepsize selection in implicit
/// Runge-Kutta methods*, ACM TOMS 20 (1994), in the form of Hairer & Wanner (1996), section IV.8.
///
/// Errors are used as their root `error^(1/(q+1))`, q the order of the embedded solution: a size proportional to
/// the step.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub(crate) struct Controller {
    /// Last accepted step; zero: none since the last restart.
    step: f64,
    /// Its root error.
    root: f64,
    /// Rejections since the last accepted step.
    rejections: u32,
    /// How it was made: errors of another method say nothing of the trend.
    family: Family,
}

impl Controller {
    pub fn restart(&mut self) {
        *self = Self::default();
    }

    /// Whether a run can have been controlled so.
    pub fn check(&self) -> Result<(), SetupError> {
        check_size("controller.step", self.step)?;
        check_size("controller.root", self.root)?;
        // Each rejection shortens the step: a few thousand of them in a row lead from the longest step to none.
        if self.rejections > MOST_REJECTIONS {
            let value = f64::from(self.rejections);
            let name = "controller.rejections";
            return Err(SetupError::Damaged { name, value });
        }
        Ok(())
    }

    /// After an accepted step: the factor for the next step, and whether it is a genuine prediction (not cut off).
    ///
    /// With `kinks`, the step before a rejection says nothing of the trend: a kink lies between.
    #[inline]
    pub fn accept(
        &mut self,
        options: &Options,
        step: f64,
        root: f64,
        kinks: bool,
        family: Family,
    ) -> (f64, bool) {
        let mut divisor = root / options.safety;
        if self.step > 0.0 && self.family == family && !(kinks && self.rejections > 0) {
            divisor = divisor.max(root * root / (self.root * options.safety) * (self.step / step));
        }
        let wanted = grown(1.0 / divisor, family);
        let most = if self.step == 0.0 && family == Family::Explicit {
            FIRST_GROWTH * options.maximum_factor
        } else {
            options.maximum_factor
        };
        let mut factor = wanted.max(options.minimum_factor).min(most);
        if self.rejections > 0 {
            factor = factor.min(1.0);
        }
        self.rejections = 0;
        self.step = step;
        self.family = family;
        // the root of the smallest error that counts, 0.01, lies near 0.3 for all methods
        self.root = root.max(0.3);
        (factor, wanted < most)
    }

    /// After a step whose error was too large: the factor for the next attempt.
    #[inline]
    pub fn reject(&mut self, options: &Options, root: f64) -> f64 {
        self.rejections += 1;
        let factor = (options.safety / root).max(options.minimum_factor);
        // At a kink the error is of low order in the step: do not creep towards it.
        if self.rejections > 1 {
            factor.min(0.5)
        } else {
            factor
        }
    }

    /// After a step that could not be computed.
    pub fn fail(&mut self) {
        self.rejections += 1;
    }
}

/// Growth, taken slowly where steps are linearly implicit.
///
/// What bounds them grows faster than their order says: where friction sticks, with the eighth to fifteenth power of the step, and a step
/// that follows what the order says is rejected every third time. Growth is the root of what was wanted up to twice the step, and less by as
/// much beyond: half of the gain. Why a low gain smooths: G. Söderlind, *Digital filters in adaptive time-stepping*, ACM TOMS 29 (2003) 1.
#[inline]
fn grown(wanted: f64, family: Family) -> f64 {
    if wanted <= 1.0 || family != Family::LinearlyImplicit {
        wanted
    } else if wanted < 2.0 {
        wanted.sqrt()
    } else {
        wanted * std::f64::consts::FRAC_1_SQRT_2
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The factors after two steps with hardly an error, the second as long as the first lets it be.
    fn factors(family: Family) -> [f64; 2] {
        let (options, mut controller) = (Options::default(), Controller::default());
        let (first, _) = controller.accept(&options, 1.0, 1e-3, true, family);
        let (second, _) = controller.accept(&options, first, 1e-3, true, family);
        [first, second]
    }

    #[test]
    fn only_the_first_explicit_step_may_be_followed_by_a_much_longer_one() {
        let most = Options::default().maximum_factor;
        assert_eq!(factors(Family::Explicit), [FIRST_GROWTH * most, most]);
        for family in [Family::LinearlyImplicit, Family::DiagonallyImplicit] {
            assert_eq!(factors(family), [most; 2]);
        }
    }

    #[test]
    fn implicit_steps_grow_by_the_root_of_what_they_may() {
        // 0.9 of an error's root of 0.5: 1.8 times as long.
        let after = |family| {
            Controller::default()
                .accept(&Options::default(), 1.0, 0.5, false, family)
                .0
        };
        assert!((after(Family::Explicit) - 1.8).abs() < 1e-12);
        assert!((after(Family::LinearlyImplicit) - 1.8_f64.sqrt()).abs() < 1e-12);
    }
}
