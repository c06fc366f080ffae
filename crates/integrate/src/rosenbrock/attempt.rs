//! One attempt at a step: the stages of the method, the new states and their error.

use super::Integrator;
use crate::error::Reason;
use crate::explicit::DORMAND_PRINCE;
use crate::problem::Problem;
use crate::stages::{add, all_finite, combine, largest, leading_states};

/// Steps shorter than this, in units of the fastest answer of the problem, are explicit. The method is stable down to -3.3 on the real
/// axis and all but stable up to 2 on the imaginary one; bounds of answers are larger than the answers.
const EXPLICIT: f64 = 3.0;

/// By how much errors of explicit steps count more. Their estimate is near the error itself, which adds up in the energy ledger; that of the
/// linearly implicit methods is ten to twenty times as large.
const CAUTION: f64 = 16.0;

/// Why an attempt failed, with the state to blame.
pub(super) struct Failure {
    pub reason: Reason,
    pub index: Option<usize>,
}

impl<P: Problem> Integrator<P> {
    /// Tries one step; the size of its error.
    ///
    /// Only a checked attempt tells which state is to blame for a value that is not finite. A `landing` is to end just behind a kink.
    #[inline]
    pub(super) fn attempt<const CHECKED: bool>(
        &mut self,
        step: f64,
        target: f64,
        landing: bool,
    ) -> Result<f64, Failure> {
        if self.options.explicit_steps && step * self.stiffness <= EXPLICIT {
            let result = self.attempt_explicit::<CHECKED>(step, target);
            // Across a kink the estimate of an explicit method's error can be small by chance, again and again until it is; that of a
            // linearly implicit one, whose Jacobian matrix is that of the wrong side, is large.
            let accepted = matches!(result, Ok(error) if error <= 1.0);
            let x = &self.trial_x[..self.dimension];
            if landing || !accepted || !self.kinks.cross(&mut self.problem, target, x) {
                return result;
            }
            self.stiffness = f64::INFINITY;
        }
        let (n, stride, tableau) = (self.dimension, self.stride, self.tableau);
        self.trial_method = tableau;
        if !self.linearized {
            self.df_dt.fill(0.0);
            self.problem
                .linearize(self.time, &self.x[..n], &self.dx[..n], &mut self.df_dt[..n]);
            self.statistics.jacobians += 1;
            self.linearized = true;
            self.autonomous = self.df_dt.iter().all(|value| *value == 0.0);
        }
        let inverse = 1.0 / step;
        self.statistics.factorizations += 1;
        if let Err(singular) = self.problem.factor(inverse / tableau.gamma) {
            return Err(Failure {
                reason: Reason::Singular {
                    block: singular.block,
                },
                index: None,
            });
        }
        let (stages, argument, slope) = (
            &mut self.trial_stages[..],
            &mut self.argument[..],
            &mut self.slope[..],
        );
        for i in 0..tableau.stages() {
            let (done, rest) = stages.split_at_mut(i * stride);
            let stage = &mut rest[..stride];
            if i == 0 {
                stage.copy_from_slice(&self.dx);
            } else {
                if self.extends[i] {
                    add(argument, 1.0, &done[(i - 1) * stride..]);
                } else {
                    let argument = &mut argument[..self.widths[i]];
                    combine(argument, &self.x, 1.0, tableau.a[i], done, stride);
                }
                let time = stage_time(tableau.alpha[i], self.time, step, target);
                self.problem.derivative(time, &argument[..n], &mut slope[..n]);
                if CHECKED && !all_finite(slope) {
                    return Err(not_finite(&slope[..n]));
                }
                combine(stage, slope, inverse, tableau.c[i], done, stride);
            }
            let d = tableau.d[i] * step;
            if !self.autonomous && d != 0.0 {
                add(stage, d, &self.df_dt);
            }
            self.problem.solve(&mut stage[..n]);
        }
        self.statistics.derivatives += tableau.stages() as u64 - 1;
        self.statistics.solves += tableau.stages() as u64;

        let last = &stages[(tableau.stages() - 1) * stride..][..stride];
        for ((new, old), u) in self.trial_x.iter_mut().zip(&*argument).zip(last) {
            *new = old + u;
        }
        if !all_finite(&self.trial_x) {
            return Err(not_finite(&self.trial_x[..n]));
        }
        let error = largest(last, &self.weights);
        if error > 1.0 && self.options.fixed_step.is_none() {
            return Ok(error);
        }
        // The derivative at the end belongs to the step: a step into a place where there is none is rejected.
        self.problem
            .derivative(target, &self.trial_x[..n], &mut self.trial_dx[..n]);
        self.statistics.derivatives += 1;
        if !all_finite(&self.trial_dx) {
            return Err(not_finite(&self.trial_dx[..n]));
        }
        Ok(error)
    }

    /// The same by the explicit method, where nothing is stiff.
    fn attempt_explicit<const CHECKED: bool>(&mut self, step: f64, target: f64) -> Result<f64, Failure> {
        let (n, stride, tableau) = (self.dimension, self.stride, &DORMAND_PRINCE);
        self.trial_method = tableau;
        let (leading, end) = (leading_states(&self.problem), tableau.stages() - 2);
        for i in 0..=end {
            let (done, rest) = self.trial_stages.split_at_mut(i * stride);
            let slope = if i == 0 {
                &self.dx
            } else {
                let argument = if i == end {
                    &mut self.trial_x[..]
                } else {
                    &mut self.argument[..leading]
                };
                combine(argument, &self.x, 1.0, tableau.a[i], done, stride);
                let (argument, slope) = if i == end {
                    (&self.trial_x, &mut self.trial_dx)
                } else {
                    (&self.argument, &mut self.slope)
                };
                let time = stage_time(tableau.alpha[i], self.time, step, target);
                self.problem.derivative(time, &argument[..n], &mut slope[..n]);
                self.statistics.derivatives += 1;
                if CHECKED && !all_finite(slope) {
                    return Err(not_finite(&slope[..n]));
                }
                &*slope
            };
            let stage = &mut rest[..stride];
            stage.fill(0.0);
            add(stage, step, slope);
        }
        for values in [&self.trial_x, &self.trial_dx] {
            if !all_finite(values) {
                return Err(not_finite(&values[..n]));
            }
        }
        let (done, rest) = self.trial_stages.split_at_mut((end + 1) * stride);
        let error = &mut rest[..stride];
        error.fill(0.0);
        for (weight, stage) in tableau.a[end + 1].iter().zip(done.chunks_exact(stride)) {
            add(error, *weight, stage);
        }
        Ok(CAUTION * largest(error, &self.weights))
    }
}

/// The time of a stage; the last ones stand at the end itself.
#[inline(always)]
fn stage_time(alpha: f64, start: f64, step: f64, target: f64) -> f64 {
    if alpha == 1.0 {
        target
    } else {
        start + alpha * step
    }
}

/// The first value that is not finite is to blame.
#[cold]
fn not_finite(values: &[f64]) -> Failure {
    Failure {
        reason: Reason::NotFinite,
        index: values.iter().position(|value| !value.is_finite()),
    }
}
