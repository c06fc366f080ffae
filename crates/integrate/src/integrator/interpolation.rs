//! States between the ends of the last step: the dense output, and its correction where friction holds
//! something.
//!
//! The ends of an implicit step lie where stiff forces are in equilibrium; the dense output between them need
//! not. A sticking contact creeps with a part of the reference speed of its friction law, and what the
//! polynomial misses of that changes its friction by as large a part: a step that is exact to a fifth of the
//! tolerance at its end can be off by half of the friction force in its middle. So the states `u` of the
//! dense output are corrected by one step of the implicit Euler method of length γh for what they miss of the
//! equations,
//!
//! ```text
//! δ/(γh) = f(u + δ) - u',
//! ```
//!
//! solved by Newton's method. It brings stiff components to their equilibrium, and changes the others by no
//! more than the error of the dense output. Decision 0029.

use super::Integrator;
use super::memory::{CorrectionState, DenseCorrection};
use crate::dense_output::DenseOutput;
use crate::methods::tableau::Family;
use crate::problem::Problem;
use crate::tuning::dense_output as tuning;
use crate::vector::all_finite;

impl<P: Problem> Integrator<P> {
    /// Returns the limit of the next step on the way to `end`, if states are needed at `output_time`.
    ///
    /// For Rosenbrock methods it is `end`: [`Integrator::interpolate`] is as exact as a step. For ESDIRK
    /// methods it is `output_time`: they control the errors of displacements alone, and only at stages are
    /// speeds in equilibrium with friction.
    #[must_use]
    pub fn step_limit(&self, output_time: f64, end: f64) -> f64 {
        match self.tableau.family {
            Family::DiagonallyImplicit => output_time.min(end),
            Family::LinearlyImplicit | Family::Explicit => end,
        }
    }

    /// Writes the states at a time in the last step, to the order of the method's dense output, corrected
    /// where something stiff holds them. Call it before the next step begins: from then on it is the same as
    /// [`Integrator::interpolate_range`].
    ///
    /// # Panics
    /// If `out` does not have the length of the problem.
    pub fn interpolate(&mut self, time: f64, out: &mut [f64]) {
        assert_eq!(out.len(), self.dimension, "length of the interpolated states");
        self.interpolate_range(time, 0, out);
        if time <= self.previous_time || time >= self.time {
            return;
        }
        if self.correction.state == CorrectionState::Undecided {
            self.correction.state = if self.needs_correction() {
                CorrectionState::Enabled
            } else {
                CorrectionState::Disabled
            };
        }
        if self.correction.state == CorrectionState::Enabled {
            self.correct(time, out);
        }
    }

    /// Writes the states from `first` on, as many as `out` holds, at a time in the last step, by the method's
    /// dense output without correction.
    ///
    /// # Panics
    /// If there are not as many states.
    pub fn interpolate_range(&self, time: f64, first: usize, out: &mut [f64]) {
        assert!(
            first + out.len() <= self.dimension,
            "range of the interpolated states"
        );
        let dense = self.dense_output();
        dense.evaluate_range(dense.fraction(time), first, out);
    }

    fn dense_output(&self) -> DenseOutput<'_> {
        DenseOutput {
            tableau: self.last_method,
            start: self.previous_time,
            step: self.time - self.previous_time,
            end: self.time,
            x0: &self.previous_x,
            x1: &self.x,
            stages: &self.stages,
        }
    }

    /// Returns whether the dense output of the last step needs a correction in its middle, by the factored
    /// matrix of the step, which the problem holds. Where everything slides fast, friction hardly depends on
    /// the slip.
    fn needs_correction(&mut self) -> bool {
        let middle = 0.5 * (self.previous_time + self.time);
        self.predictor.any_slip_held()
            && self.start_correction(middle)
            && self.correct_once(self.correction_shift()) > tuning::NEGLIGIBLE
    }

    /// Returns 1/(γh).
    fn correction_shift(&self) -> f64 {
        1.0 / (self.last_method.gamma * (self.time - self.previous_time))
    }

    /// Evaluates the dense output and its derivative at a time, and if the problem is stiff there the
    /// right-hand side; returns whether it is stiff, and the right-hand side finite.
    fn start_correction(&mut self, time: f64) -> bool {
        let mut correction = std::mem::take(&mut self.correction);
        let dense = self.dense_output();
        let theta = dense.fraction(time);
        dense.evaluate(theta, &mut correction.start);
        dense.derivative(theta, &mut correction.derivative);
        correction.x.copy_from_slice(&correction.start);
        self.correction = correction;
        let step = self.time - self.previous_time;
        let x = &self.correction.x[..self.dimension];
        step * self.problem.spectral_radius_bound(time, x) >= tuning::STIFF_H_RHO
            && self.evaluate_corrected(time)
    }

    /// Evaluates the right-hand side at the corrected states; returns whether it is finite.
    fn evaluate_corrected(&mut self, time: f64) -> bool {
        let DenseCorrection { x, rate, .. } = &mut self.correction;
        self.problem
            .derivative(time, &x[..self.dimension], &mut rate[..self.dimension]);
        all_finite(rate)
    }

    /// Corrects the states of the dense output at a time, if the problem is stiff there and Newton's method
    /// converges.
    fn correct(&mut self, time: f64, out: &mut [f64]) {
        let dynamic = self.structure.dynamic_states;
        let shift = self.correction_shift();
        if !self.start_correction(time) {
            return;
        }
        let (mut before, mut outdated) = (f64::INFINITY, true);
        for _ in 0..tuning::MAXIMUM_ITERATIONS {
            if outdated && !self.evaluate_correction_matrix(time, shift) {
                return;
            }
            let size = self.correct_once(shift);
            if size <= tuning::CONVERGED {
                out[..dynamic].copy_from_slice(&self.correction.x[..dynamic]);
                return;
            }
            if size > tuning::DIVERGED * before || !self.evaluate_corrected(time) {
                return;
            }
            outdated = size > tuning::SLOW * before;
            before = size;
        }
    }

    /// Evaluates a matrix at the corrected states, where the right-hand side is known; returns whether it
    /// could be factored.
    fn evaluate_correction_matrix(&mut self, time: f64, shift: f64) -> bool {
        let n = self.dimension;
        let DenseCorrection { x, rate, .. } = &self.correction;
        self.problem
            .linearize_for_newton(time, &x[..n], &rate[..n], &mut self.df_dt[..n]);
        self.linearized = false;
        self.problem.factor(shift).is_ok()
    }

    /// Corrects the states once, by the right-hand side there and the matrix that the problem holds; returns
    /// the norm of the correction, infinite if a value is not finite.
    fn correct_once(&mut self, shift: f64) -> f64 {
        let DenseCorrection {
            start,
            x,
            rate,
            derivative,
            ..
        } = &mut self.correction;
        let states = x.iter().zip(start);
        for ((rate, derivative), (x, start)) in rate.iter_mut().zip(derivative).zip(states) {
            *rate -= *derivative + shift * (*x - *start);
        }
        self.problem.solve(&mut rate[..self.dimension]);
        if !all_finite(rate) {
            return f64::INFINITY;
        }
        let mut most = 0.0_f64;
        let corrections = rate.iter().zip(&self.weights);
        let dynamic = self.structure.dynamic_states;
        for (x, (correction, weight)) in x.iter_mut().zip(corrections).take(dynamic) {
            *x += correction;
            most = most.max(correction.abs() * weight);
        }
        most
    }
}
