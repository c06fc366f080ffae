//! Counters of steps and function calls.

use serde::{Deserialize, Serialize};

use crate::error::SetupError;
use crate::validation::{check_count, check_not_negative};

/// Counters of an integration. Calls for interpolated states ([`crate::Integrator::interpolate`]) are not
/// counted: they depend on how many states are asked for.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Statistics {
    /// Accepted steps.
    pub steps: u64,
    /// Accepted steps that were explicit.
    #[serde(default)]
    pub explicit_steps: u64,
    /// Steps rejected because of their error.
    pub rejected_error: u64,
    /// Steps rejected because a value was not finite.
    pub rejected_not_finite: u64,
    /// Steps rejected because the matrix was singular.
    pub rejected_singular: u64,
    /// Steps rejected because Newton's method did not converge.
    #[serde(default, rename = "rejected_unsolved")]
    pub rejected_newton: u64,
    /// Evaluations of the right-hand side.
    pub derivatives: u64,
    /// Evaluations of the Jacobian matrix.
    pub jacobians: u64,
    /// Factorizations, failed ones included.
    pub factorizations: u64,
    /// Solutions of linear systems.
    pub solves: u64,
    /// Discontinuities that were predicted.
    #[serde(default, alias = "kinks_foreseen")]
    pub discontinuities_predicted: u64,
    /// Changes of discrete states.
    pub events: u64,
    /// Steps with more events than [`crate::Options::maximum_events`].
    pub events_unresolved: u64,
    /// Restarts at time discontinuities.
    pub restarts: u64,
    /// The smallest accepted step; zero before the first one.
    pub smallest_step: f64,
    /// The largest accepted step.
    pub largest_step: f64,
}

impl Statistics {
    /// Returns the number of attempted steps, accepted and rejected.
    #[must_use]
    pub fn attempts(&self) -> u64 {
        self.steps.saturating_add(self.rejected())
    }

    /// Returns the number of rejected steps, whatever the reason.
    #[must_use]
    pub fn rejected(&self) -> u64 {
        // Counters read from a file may have any value.
        self.rejected_error
            .saturating_add(self.rejected_not_finite)
            .saturating_add(self.rejected_singular)
            .saturating_add(self.rejected_newton)
    }

    /// Checks the counters of a saved state.
    pub(crate) fn check(&self) -> Result<(), SetupError> {
        for (name, count) in [
            ("statistics.steps", self.steps),
            ("statistics.explicit_steps", self.explicit_steps),
            ("statistics.rejected_error", self.rejected_error),
            ("statistics.rejected_not_finite", self.rejected_not_finite),
            ("statistics.rejected_singular", self.rejected_singular),
            ("statistics.rejected_unsolved", self.rejected_newton),
            ("statistics.derivatives", self.derivatives),
            ("statistics.jacobians", self.jacobians),
            ("statistics.factorizations", self.factorizations),
            ("statistics.solves", self.solves),
            (
                "statistics.discontinuities_predicted",
                self.discontinuities_predicted,
            ),
            ("statistics.events", self.events),
            ("statistics.events_unresolved", self.events_unresolved),
            ("statistics.restarts", self.restarts),
        ] {
            check_count(name, count)?;
        }
        check_not_negative("statistics.smallest_step", self.smallest_step)?;
        check_not_negative("statistics.largest_step", self.largest_step)
    }

    /// Counts an accepted step.
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
