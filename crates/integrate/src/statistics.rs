//! Counts of what an integration cost.

use serde::{Deserialize, Serialize};

use crate::error::SetupError;
use crate::state::{check_count, check_size};

/// What an integration has done so far for its steps. What states between their ends cost ([`crate::Integrator::interpolate`]) is not counted:
/// it depends on how many are asked for.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Statistics {
    /// Accepted steps.
    pub steps: u64,
    /// Those of them that were explicit.
    #[serde(default)]
    pub explicit_steps: u64,
    /// Steps rejected because of their error.
    pub rejected_error: u64,
    /// Steps rejected because a value was not finite.
    pub rejected_not_finite: u64,
    /// Steps rejected because the matrix was singular.
    pub rejected_singular: u64,
    /// Steps rejected because the equations of a stage could not be solved.
    #[serde(default)]
    pub rejected_unsolved: u64,
    /// Evaluations of the right-hand side.
    pub derivatives: u64,
    /// Evaluations of the Jacobian matrix.
    pub jacobians: u64,
    /// Factorizations, failed ones included.
    pub factorizations: u64,
    /// Solutions of a linear system.
    pub solves: u64,
    /// Kinks that were foreseen.
    #[serde(default)]
    pub kinks_foreseen: u64,
    /// Changes of a mode.
    pub events: u64,
    /// Steps in which there were more changes of modes than the integrator is willing to follow.
    pub events_unresolved: u64,
    /// Starts of a new smooth piece of the problem, the first not counted.
    pub restarts: u64,
    /// The smallest accepted step; zero before the first one.
    pub smallest_step: f64,
    /// The largest accepted step.
    pub largest_step: f64,
}

impl Statistics {
    /// Rejected steps, whatever the reason.
    #[must_use]
    pub fn rejected(&self) -> u64 {
        // Counts read from a file may be any numbers.
        self.rejected_error
            .saturating_add(self.rejected_not_finite)
            .saturating_add(self.rejected_singular)
            .saturating_add(self.rejected_unsolved)
    }

    /// Whether a run can have counted so.
    pub(crate) fn check(&self) -> Result<(), SetupError> {
        for (name, count) in [
            ("statistics.steps", self.steps),
            ("statistics.explicit_steps", self.explicit_steps),
            ("statistics.rejected_error", self.rejected_error),
            ("statistics.rejected_not_finite", self.rejected_not_finite),
            ("statistics.rejected_singular", self.rejected_singular),
            ("statistics.rejected_unsolved", self.rejected_unsolved),
            ("statistics.derivatives", self.derivatives),
            ("statistics.jacobians", self.jacobians),
            ("statistics.factorizations", self.factorizations),
            ("statistics.solves", self.solves),
            ("statistics.kinks_foreseen", self.kinks_foreseen),
            ("statistics.events", self.events),
            ("statistics.events_unresolved", self.events_unresolved),
            ("statistics.restarts", self.restarts),
        ] {
            check_count(name, count)?;
        }
        check_size("statistics.smallest_step", self.smallest_step)?;
        check_size("statistics.largest_step", self.largest_step)
    }

    pub(crate) fn accept(&mut self, step: f64) {
        self.smallest_step = if self.steps == 0 {
            step
        } else {
            self.smallest_step.min(step)
        };
        self.largest_step = self.largest_step.max(step);
        self.steps += 1;
    }
}
