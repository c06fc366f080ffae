//! An attempt by a Rosenbrock method.

use super::Integrator;
use super::attempt::{not_finite, stage_time};
use super::memory::{Attempt, AttemptOutcome};
use crate::problem::Problem;
use crate::tuning::attempt as tuning;
use crate::vector::{add, all_finite, combine, max_norm};

impl<P: Problem> Integrator<P> {
    /// Makes an attempt by the Rosenbrock method; returns its error in units of the tolerance.
    #[inline(never)]
    pub(super) fn attempt_rosenbrock(&mut self) -> AttemptOutcome {
        let (n, stride, tableau) = (self.dimension, self.stride, self.tableau);
        let Attempt {
            step,
            target,
            diagnostic,
            ..
        } = self.attempt;
        self.trial_method = tableau;
        self.linearize_here();
        let inverse = 1.0 / step;
        self.factor(inverse / tableau.gamma)?;
        self.trial_stages[..stride].copy_from_slice(&self.dx);
        self.solve_stage(0);
        let (last, leading) = (tableau.stages() - 1, self.structure.padded_dynamic_states());
        for i in 1..=last {
            let (done, rest) = self.trial_stages.split_at_mut(i * stride);
            // Only the argument of the last stage, to which the new state is close, needs the quadratures.
            let width = if i == last { stride } else { leading };
            combine(
                &mut self.argument[..width],
                &self.x,
                1.0,
                tableau.a[i],
                done,
                stride,
            );
            let time = stage_time(tableau.alpha[i], self.time, step, target);
            self.problem
                .derivative(time, &self.argument[..n], &mut self.stage_derivative[..n]);
            if diagnostic && !all_finite(&self.stage_derivative) {
                return Err(not_finite(&self.stage_derivative[..n]));
            }
            let stage = &mut rest[..stride];
            combine(stage, &self.stage_derivative, inverse, tableau.c[i], done, stride);
            self.solve_stage(i);
        }
        self.finish_rosenbrock()
    }

    /// Evaluates the Jacobian matrix at the state reached, unless the problem holds it.
    #[inline(always)]
    fn linearize_here(&mut self) {
        let n = self.dimension;
        if !self.linearized {
            self.df_dt.fill(0.0);
            self.problem
                .linearize(self.time, &self.x[..n], &self.dx[..n], &mut self.df_dt[..n]);
            self.statistics.jacobians += 1;
            self.linearized = true;
            self.autonomous = self.df_dt.iter().all(|value| *value == 0.0);
        }
    }

    /// Solves for a stage, in place of its right-hand side.
    #[inline(always)]
    fn solve_stage(&mut self, i: usize) {
        let stage = &mut self.trial_stages[i * self.stride..][..self.stride];
        let d = self.tableau.d[i] * self.attempt.step;
        if !self.autonomous && d != 0.0 {
            add(stage, d, &self.df_dt);
        }
        self.problem.solve(&mut stage[..self.dimension]);
    }

    /// Computes the new state and the error from the stages.
    #[inline(always)]
    fn finish_rosenbrock(&mut self) -> AttemptOutcome {
        let (n, stride, count) = (self.dimension, self.stride, self.tableau.stages());
        self.statistics.derivatives += count as u64 - 1;
        self.statistics.solves += count as u64;

        let last = &self.trial_stages[(count - 1) * stride..][..stride];
        for ((new, old), u) in self.trial_x.iter_mut().zip(&self.argument).zip(last) {
            *new = old + u;
        }
        if !all_finite(&self.trial_x) {
            return Err(not_finite(&self.trial_x[..n]));
        }
        let mut error = max_norm(last, &self.weights);
        let weight = tuning::STICK_TO_SLIP_ERROR_WEIGHT;
        if self.predicts() && error <= 1.0 && error * weight > 1.0 {
            self.evaluate_trial_discontinuities();
            if self.predictor.trial_leaves_stick() {
                error *= weight;
            }
        }
        if error > 1.0 && self.options.fixed_step.is_none() {
            return Ok(error);
        }
        self.evaluate_end()?;
        Ok(error)
    }
}
