//! An attempt by an ESDIRK method: its stages are solved by Newton's method with a Jacobian cache and a line
//! search.
//!
//! A stage begins on the straight line through what is known before it, with the cached matrix if it is
//! valid there, otherwise with a matrix evaluated there (if the contact state is unknown: in the
//! first stage). The matrix is used while corrections shrink by [`tuning::CONTRACTION`]. Where a correction
//! crosses a discontinuity, a line search finds the point at which the next matrix is evaluated, see
//! [`crate::newton::LineSearch`]. Decisions 0026, 0033.

use super::Integrator;
use super::attempt::{not_finite, stage_time};
use super::memory::{Attempt, AttemptFailure, AttemptOutcome};
use crate::error::Reason;
use crate::newton::{CacheValidity, LineSearch, LinearizationPoint, Newton};
use crate::problem::Problem;
use crate::tuning::newton as tuning;
use crate::vector::{
    add, add_difference, all_finite, combine, extrapolate, max_norm, max_norm_if_finite, scale,
    scale_difference,
};

impl<P: Problem> Integrator<P> {
    /// Makes an attempt by the ESDIRK method; returns its error in units of the tolerance.
    #[inline(never)]
    pub(super) fn attempt_esdirk(&mut self) -> AttemptOutcome {
        let (stride, last) = (self.stride, self.tableau.stages() - 2);
        self.trial_method = self.tableau;
        scale(&mut self.trial_stages[..stride], self.attempt.step, &self.dx);
        for stage in 1..=last {
            self.predict_stage(stage);
            self.solve_nonlinear_stage()?;
            let found = &mut self.trial_stages[stage * stride..][..stride];
            let inverse = 1.0 / self.tableau.gamma;
            scale_difference(found, inverse, &self.argument, &self.newton.base);
        }
        self.trial_x.copy_from_slice(&self.argument);
        if !all_finite(&self.trial_x) {
            return Err(not_finite(&self.trial_x[..self.dimension]));
        }
        let last = &self.trial_stages[last * stride..][..stride];
        scale(&mut self.trial_dx, 1.0 / self.attempt.step, last);
        self.write_error();
        Ok(max_norm(self.last_trial_stage(), &self.newton.error_weights))
    }

    /// Starts a stage: computes its base, its time, and its prediction as argument: on the tangent at the
    /// start of the step, or on the chord from there to the stage before, which is the argument.
    fn predict_stage(&mut self, i: usize) {
        let Attempt {
            step: length, target, ..
        } = self.attempt;
        let (stride, tableau) = (self.stride, self.tableau);
        let newton = &mut self.newton;
        (newton.stage, newton.matrices) = (i, 0);
        newton.time = stage_time(tableau.alpha[i], self.time, length, target);
        let done = &self.trial_stages[..i * stride];
        combine(&mut newton.base, &self.x, 1.0, tableau.a[i], done, stride);
        // Quadratures need no prediction.
        let dynamic = ..self.structure.padded_dynamic_states();
        if i == 1 {
            self.argument.copy_from_slice(&self.x);
            add(
                &mut self.argument[dynamic],
                tableau.alpha[1] * length,
                &self.dx[dynamic],
            );
        } else {
            let distance = tableau.alpha[i] / tableau.alpha[i - 1] - 1.0;
            extrapolate(&mut self.argument[dynamic], distance, &self.x[dynamic]);
        }
    }

    /// Evaluates the derivative at the argument, after states that can be solved for alone are.
    fn evaluate_stage(&mut self) {
        let (n, shift) = (self.dimension, self.newton_shift());
        let Newton { time, base, .. } = &self.newton;
        let argument = &mut self.argument[..n];
        self.problem.settle(*time, shift, &base[..n], argument);
        let derivative = &mut self.stage_derivative[..n];
        self.problem.derivative(*time, argument, derivative);
        self.statistics.derivatives += 1;
    }

    /// Solves the equations of a stage, from the prediction in the argument to the solution in the argument.
    #[inline(never)]
    fn solve_nonlinear_stage(&mut self) -> Result<(), AttemptFailure> {
        self.evaluate_stage();
        while !self.first_correction()? && !self.iterate() {}
        Ok(())
    }

    /// Makes the first correction with a matrix, from the argument, where the derivative is known; returns
    /// whether the stage is solved.
    fn first_correction(&mut self) -> Result<bool, AttemptFailure> {
        let n = self.dimension;
        if !all_finite(&self.stage_derivative) {
            return Err(not_finite(&self.stage_derivative[..n]));
        }
        let matrices = self.newton.matrices + 1;
        if matrices > tuning::MAXIMUM_MATRICES {
            return Err(AttemptFailure {
                reason: Reason::NewtonFailure,
                index: None,
            });
        }
        let validity = if matrices == 1 {
            self.cache_validity()
        } else {
            // The matrix in use has failed.
            let x = &self.argument[..n];
            let Newton { cache, time, .. } = &mut self.newton;
            cache.set_contact_state(&mut self.problem, *time, x);
            CacheValidity::Invalid
        };
        self.newton.matrices = matrices;
        let reliable = self.prepare_matrix(validity)?;
        let size = self.compute_correction();
        let newton = &mut self.newton;
        if size == f64::INFINITY {
            return Err(not_finite(&newton.next[..n]));
        }
        if size <= 1.0 && reliable {
            add(&mut self.argument, 1.0, &newton.next);
            return Ok(true);
        }
        self.apply_correction(size);
        Ok(false)
    }

    /// Applies further corrections with the same matrix while they shrink; returns whether the stage is
    /// solved. If not, the next matrix is to be evaluated at the argument, where the derivative is known.
    fn iterate(&mut self) -> bool {
        let size = loop {
            self.evaluate_stage();
            let size = self.compute_correction();
            let newton = &self.newton;
            // The remainder is about size²/(size before).
            let converged = |remainder: f64| {
                size <= remainder || (size < newton.size && size * size <= remainder * newton.size)
            };
            let check = newton.cache_valid && !converged(tuning::REMAINDER_OTHER_STATE);
            if converged(tuning::REMAINDER) && (!check || self.cache_validity() == CacheValidity::Valid) {
                add(&mut self.argument, 1.0, &self.newton.next);
                return true;
            }
            if size < tuning::CONTRACTION * self.newton.size {
                self.apply_correction(size);
            } else {
                break size;
            }
        };
        let component = self.newton.component_along(size);
        if component >= -tuning::LINE_SEARCH {
            return false;
        }
        self.search_along(component);
        false
    }

    /// Searches along the last correction, at whose end the next one has the component `component` along it.
    fn search_along(&mut self, component: f64) {
        self.newton.line_search = LineSearch::new(component);
        loop {
            let newton = &mut self.newton;
            let fraction = newton.line_search.next_fraction();
            self.argument.copy_from_slice(&newton.from);
            add(&mut self.argument, fraction, &newton.correction);
            self.evaluate_stage();
            let size = self.compute_correction();
            let component = self.newton.component_along(size);
            if self.newton.line_search.update(component) {
                return;
            }
        }
    }

    /// Returns the shift 1/(hγ).
    fn newton_shift(&self) -> f64 {
        1.0 / (self.tableau.gamma * self.attempt.step)
    }

    /// Computes the next correction at the argument; returns its norm, infinite if a value is not finite.
    fn compute_correction(&mut self) -> f64 {
        let shift = self.newton_shift();
        let newton = &mut self.newton;
        let (next, derivative) = (&mut newton.next, &self.stage_derivative);
        add_difference(next, derivative, shift, &newton.base, &self.argument);
        self.problem.solve(&mut next[..self.dimension]);
        self.statistics.solves += 1;
        max_norm_if_finite(&newton.next, &newton.correction_weights)
    }

    /// Adds the next correction, of this norm, to the argument.
    fn apply_correction(&mut self, size: f64) {
        let newton = &mut self.newton;
        newton.size = size;
        newton.from.copy_from_slice(&self.argument);
        std::mem::swap(&mut newton.correction, &mut newton.next);
        add(&mut self.argument, 1.0, &newton.correction);
    }

    /// Provides a factored matrix; returns whether it is known to be valid at the argument.
    fn prepare_matrix(&mut self, validity: CacheValidity) -> Result<bool, AttemptFailure> {
        // A later stage begins with the matrix of the stage before.
        let evaluate = match validity {
            CacheValidity::Valid => false,
            CacheValidity::Invalid => true,
            CacheValidity::Unknown => self.newton.stage == 1,
        };
        self.newton.cache_valid = validity == CacheValidity::Valid;
        if evaluate {
            self.statistics.jacobians += 1;
            self.evaluate_matrix(self.newton.time);
        }
        self.factor_matrix(self.newton_shift())?;
        Ok(evaluate || self.newton.cache_valid)
    }

    /// Returns whether the cached matrix is valid at the argument.
    fn cache_validity(&mut self) -> CacheValidity {
        let x = &self.argument[..self.dimension];
        let Newton { cache, time, .. } = &mut self.newton;
        cache.validity(&mut self.problem, *time, x)
    }

    /// Evaluates a matrix at the argument, whose contact state and derivative are known.
    fn evaluate_matrix(&mut self, time: f64) {
        let n = self.dimension;
        let (x, dx) = (&self.argument[..n], &self.stage_derivative[..n]);
        self.problem
            .linearize_for_newton(time, x, dx, &mut self.df_dt[..n]);
        self.newton.cache.store(time, &self.argument);
    }

    /// Factors the cached matrix with a shift, unless it is factored so.
    fn factor_matrix(&mut self, shift: f64) -> Result<(), AttemptFailure> {
        if self.newton.cache.shift() != shift {
            if let Err(failure) = self.factor(shift) {
                self.newton.cache.clear();
                return Err(failure);
            }
            self.newton.cache.set_shift(shift);
        }
        Ok(())
    }

    /// Evaluates the matrix of a saved state again. It is not counted: an uninterrupted run has it.
    pub(super) fn restore_matrix(&mut self, saved: Option<&LinearizationPoint>) {
        let n = self.dimension;
        self.newton.cache.clear();
        let Some(saved) = saved else {
            return;
        };
        self.argument.fill(0.0);
        self.argument[..n].copy_from_slice(&saved.x);
        self.problem
            .derivative(saved.time, &saved.x, &mut self.stage_derivative[..n]);
        self.newton
            .cache
            .set_contact_state(&mut self.problem, saved.time, &saved.x);
        self.evaluate_matrix(saved.time);
        if saved.shift > 0.0 && self.problem.factor(saved.shift).is_ok() {
            self.newton.cache.set_shift(saved.shift);
        }
    }
}
