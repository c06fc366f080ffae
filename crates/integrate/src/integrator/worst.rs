//! The state that bounds the steps.

use super::Integrator;
use crate::methods::tableau::Family;
use crate::problem::Problem;

impl<P: Problem> Integrator<P> {
    /// Returns the number of the state with the largest error estimate in the last accepted step, relative to
    /// its admissible error: the one that bounds the length of the steps. Returns `None` before the first
    /// step.
    #[must_use]
    pub fn worst_state(&self) -> Option<usize> {
        if self.statistics.steps == 0 {
            return None;
        }
        let last = (self.last_method.stages() - 1) * self.stride;
        let errors = self.stages.get(last..last + self.stride)?;
        let weights = match self.last_method.family {
            Family::DiagonallyImplicit => &self.newton.error_weights,
            Family::LinearlyImplicit | Family::Explicit => &self.weights,
        };
        let sizes = errors
            .iter()
            .zip(weights)
            .map(|(error, weight)| error.abs() * weight);
        let worst = sizes.enumerate().max_by(|(_, a), (_, b)| a.total_cmp(b));
        worst.filter(|(_, size)| *size > 0.0).map(|(index, _)| index)
    }
}
