//! The part of an attempt that all methods share.

use super::Integrator;
use super::memory::{AttemptFailure, AttemptOutcome};
use crate::error::Reason;
use crate::methods::tableau::Family;
use crate::problem::Problem;
use crate::vector::{add, all_finite};

impl<P: Problem> Integrator<P> {
    /// Makes the planned attempt; returns its error in units of the tolerance.
    ///
    /// Only a diagnostic attempt finds the state to blame for a value that is not finite in a stage.
    #[inline(always)]
    pub(super) fn make_attempt(&mut self) -> AttemptOutcome {
        if self.tableau.family == Family::DiagonallyImplicit {
            self.attempt_esdirk()
        } else if self.is_explicit(self.attempt.step) {
            self.attempt_explicit()
        } else {
            self.attempt_rosenbrock()
        }
    }

    /// Factors `shift·I - J` with the matrix that the problem holds.
    #[inline(always)]
    pub(super) fn factor(&mut self, shift: f64) -> Result<(), AttemptFailure> {
        self.statistics.factorizations += 1;
        self.problem.factor(shift).map_err(|singular| AttemptFailure {
            reason: Reason::Singular {
                block: singular.block,
            },
            index: None,
        })
    }

    /// Returns the last stage of the attempt: its error.
    #[inline(always)]
    pub(super) fn last_trial_stage(&self) -> &[f64] {
        &self.trial_stages[(self.trial_method.stages() - 1) * self.stride..][..self.stride]
    }

    /// Writes the error of a method whose last row of `a` holds the weights of the error estimate.
    #[inline(always)]
    pub(super) fn write_error(&mut self) {
        let (stride, last) = (self.stride, self.trial_method.stages() - 1);
        let (done, error) = self.trial_stages.split_at_mut(last * stride);
        let error = &mut error[..stride];
        error.fill(0.0);
        for (weight, stage) in self.trial_method.a[last].iter().zip(done.chunks_exact(stride)) {
            add(error, *weight, stage);
        }
    }

    /// Evaluates the derivative at the end of the attempt. It belongs to the step: a step to a state without
    /// derivative is rejected.
    #[inline(always)]
    pub(super) fn evaluate_end(&mut self) -> Result<(), AttemptFailure> {
        let n = self.dimension;
        self.problem
            .derivative(self.attempt.target, &self.trial_x[..n], &mut self.trial_dx[..n]);
        self.statistics.derivatives += 1;
        if !all_finite(&self.trial_dx) {
            return Err(not_finite(&self.trial_dx[..n]));
        }
        Ok(())
    }

    /// Evaluates the discontinuity functions at the end of the attempt.
    pub(super) fn evaluate_trial_discontinuities(&mut self) {
        let x = &self.trial_x[..self.dimension];
        self.predictor
            .evaluate_trial(&mut self.problem, self.attempt.target, x);
    }
}

/// Returns the time of a stage; stages with α = 1 are at the end exactly.
#[inline(always)]
pub(super) fn stage_time(alpha: f64, start: f64, step: f64, target: f64) -> f64 {
    if alpha == 1.0 {
        target
    } else {
        start + alpha * step
    }
}

/// Returns the failure of an attempt with a value that is not finite; the first such state is to blame.
#[cold]
pub(super) fn not_finite(values: &[f64]) -> AttemptFailure {
    AttemptFailure {
        reason: Reason::NotFinite,
        index: values.iter().position(|value| !value.is_finite()),
    }
}
