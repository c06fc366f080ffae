//! An attempt by the explicit method, which takes over from a Rosenbrock method while h·ρ is small.

use super::Integrator;
use super::attempt::{not_finite, stage_time};
use super::memory::{Attempt, AttemptOutcome};
use crate::methods::explicit::TSITOURAS;
use crate::problem::Problem;
use crate::tuning::attempt as tuning;
use crate::vector::{all_finite, combine, max_norm, scale};

/// The stage whose argument is the new state.
const LAST_STAGE: usize = 6;
const _: () = assert!(TSITOURAS.alpha.len() == LAST_STAGE + 2);

impl<P: Problem> Integrator<P> {
    /// Returns whether a step of this length from the state reached is explicit.
    #[inline(always)]
    pub(super) fn is_explicit(&self, step: f64) -> bool {
        self.options.explicit_steps && step * self.spectral_radius <= tuning::EXPLICIT_H_RHO
    }

    /// Makes an attempt by the explicit method; returns its error in units of the tolerance.
    #[inline(never)]
    pub(super) fn attempt_explicit(&mut self) -> AttemptOutcome {
        let (n, stride) = (self.dimension, self.stride);
        let Attempt {
            step,
            target,
            diagnostic,
            ..
        } = self.attempt;
        self.trial_method = &TSITOURAS;
        scale(&mut self.trial_stages[..stride], step, &self.dx);
        for i in 1..=LAST_STAGE {
            let (argument, derivative) = if i == LAST_STAGE {
                (&mut self.trial_x[..], &mut self.trial_dx)
            } else {
                let leading = self.structure.padded_dynamic_states();
                (&mut self.argument[..leading], &mut self.stage_derivative)
            };
            let (done, rest) = self.trial_stages.split_at_mut(i * stride);
            combine(argument, &self.x, 1.0, TSITOURAS.a[i], done, stride);
            let argument = if i == LAST_STAGE {
                &self.trial_x[..n]
            } else {
                &self.argument[..n]
            };
            let time = stage_time(TSITOURAS.alpha[i], self.time, step, target);
            self.problem.derivative(time, argument, &mut derivative[..n]);
            self.statistics.derivatives += 1;
            if diagnostic && !all_finite(derivative) {
                return Err(not_finite(&derivative[..n]));
            }
            scale(&mut rest[..stride], step, derivative);
        }
        for values in [&self.trial_x, &self.trial_dx] {
            if !all_finite(values) {
                return Err(not_finite(&values[..n]));
            }
        }
        self.write_error();
        Ok(tuning::EXPLICIT_ERROR_WEIGHT * max_norm(self.last_trial_stage(), &self.weights))
    }
}
