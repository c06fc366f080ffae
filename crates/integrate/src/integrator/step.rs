//! A step: attempts are planned and made until one passes the error test.

use super::Integrator;
use super::memory::{Attempt, AttemptFailure, AttemptOutcome, CorrectionState};
use crate::dense_output::DenseOutput;
use crate::discontinuity::Prediction;
use crate::error::{Reason, StepError};
use crate::methods::tableau::Family;
use crate::problem::Problem;
use crate::tuning::step as tuning;

impl<P: Problem> Integrator<P> {
    /// Makes one accepted step that does not pass `limit` (which may be infinite) nor the next time
    /// discontinuity.
    ///
    /// # Errors
    /// If the limit is not later than the time, or no step can be made; the last accepted step then stays in
    /// place.
    pub fn step_to(&mut self, limit: f64) -> Result<(), StepError> {
        self.plan(limit)?;
        loop {
            match self.make_attempt() {
                Ok(error) if self.is_acceptable(error) => {
                    self.accept(error);
                    return Ok(());
                }
                outcome => self.reject(outcome)?,
            }
        }
    }

    /// Returns whether an attempt with this error passes the error test.
    #[inline(always)]
    fn is_acceptable(&self, error: f64) -> bool {
        !self.attempt.diagnostic && (self.options.fixed_step.is_some() || error <= 1.0)
    }

    /// Plans the first attempt at a step.
    #[inline]
    fn plan(&mut self, limit: f64) -> Result<(), StepError> {
        self.correction.state = CorrectionState::Disabled;
        if limit.is_nan() || limit <= self.time {
            return Err(self.error(Reason::Limit { limit }, 0.0, None, 0.0));
        }
        if self.time >= self.interval_end {
            self.start_next_interval()?;
        }
        let end = limit.min(self.interval_end);
        let proposed = self.proposed_step.min(self.options.maximum_step);
        let (mut step, mut target) = self.fit(proposed, end);
        let mut reached = None;
        if let Some(prediction) = self.prediction
            && prediction.time > self.time
            && prediction.time < target
        {
            target = prediction.time;
            (step, reached) = (target - self.time, Some(prediction));
        }
        // Otherwise the time would not advance.
        if target <= self.time {
            return Err(self.give_up(Reason::StepUnderflow, proposed, None, 0.0));
        }
        self.attempt = Attempt {
            end,
            proposed,
            step,
            target,
            prediction: reached,
            truncated: step < tuning::TRUNCATED * proposed,
            ..Attempt::NONE
        };
        self.check_number()
    }

    /// Checks whether one more attempt is admissible.
    fn check_number(&mut self) -> Result<(), StepError> {
        let (statistics, maximum) = (&self.statistics, self.options.maximum_steps);
        if statistics.steps + statistics.rejected() < maximum {
            return Ok(());
        }
        let Attempt {
            step, scaled_error, ..
        } = self.attempt;
        let index = (scaled_error > 0.0).then(|| self.largest_error());
        Err(self.give_up(Reason::MaximumSteps { maximum }, step, index, scaled_error))
    }

    /// Plans another attempt after one that failed or whose error is too large.
    #[cold]
    fn reject(&mut self, outcome: AttemptOutcome) -> Result<(), StepError> {
        let Attempt {
            end,
            mut step,
            target,
            mut scaled_error,
            diagnostic,
            blamed,
            ..
        } = self.attempt;
        let tried = target - self.time;
        if diagnostic {
            let failure = outcome.err().unwrap_or(AttemptFailure {
                reason: Reason::NotFinite,
                index: blamed,
            });
            return Err(self.give_up(failure.reason, tried, failure.index, f64::NAN));
        }
        let failure = match outcome {
            Ok(error) => {
                scaled_error = error;
                step *= self.reject_error(error);
                AttemptFailure {
                    reason: Reason::Error,
                    index: None,
                }
            }
            Err(failure) => {
                step *= self.reject_failure(failure.reason);
                failure
            }
        };
        let minimum = self
            .options
            .minimum_step
            .max(tuning::RESOLUTION * f64::EPSILON * self.time.abs())
            .max(f64::MIN_POSITIVE);
        let last = step < minimum || self.options.fixed_step.is_some();
        if last && failure.reason != Reason::NotFinite {
            let (index, scaled_error) = match failure.reason {
                Reason::Error => (Some(self.largest_error()), scaled_error),
                _ => (failure.index, f64::NAN),
            };
            return Err(self.give_up(failure.reason, tried, index, scaled_error));
        }
        let (step, target) = if last {
            // Once more, to find the first value that is not finite.
            (tried, target)
        } else {
            self.fit(step, end)
        };
        self.attempt = Attempt {
            step,
            target,
            prediction: None,
            truncated: false,
            scaled_error,
            diagnostic: last,
            blamed: failure.index,
            ..self.attempt
        };
        if last { Ok(()) } else { self.check_number() }
    }

    /// Counts a rejection because of the error; returns the factor for the next attempt.
    fn reject_error(&mut self, error: f64) -> f64 {
        self.statistics.rejected_error += 1;
        if self.attempt.prediction.is_some() {
            // It crossed the discontinuity. From most of the distance on this side its time is predicted more
            // exactly.
            tuning::RETRY_BEFORE_DISCONTINUITY
        } else {
            let root = self.error_root(error);
            self.controller.reject(&self.options, root)
        }
    }

    /// Counts a failure; returns the factor for the next attempt.
    fn reject_failure(&mut self, reason: Reason) -> f64 {
        self.controller.fail();
        match reason {
            Reason::Singular { .. } => {
                self.statistics.rejected_singular += 1;
                tuning::SINGULAR_FACTOR
            }
            Reason::NewtonFailure => {
                self.statistics.rejected_newton += 1;
                tuning::FAILURE_FACTOR
            }
            _ => {
                self.statistics.rejected_not_finite += 1;
                tuning::FAILURE_FACTOR
            }
        }
    }

    /// Returns the error for a step that cannot be made.
    fn give_up(&mut self, reason: Reason, step: f64, index: Option<usize>, scaled_error: f64) -> StepError {
        self.prediction = None;
        self.error(reason, step, index, scaled_error)
    }

    /// Returns the error for a step that cannot be planned.
    fn error(&self, reason: Reason, step: f64, index: Option<usize>, scaled_error: f64) -> StepError {
        StepError {
            time: self.time,
            step,
            reason,
            index,
            scaled_error,
        }
    }

    /// Returns length and end of an attempt of about this length, such that no tiny step remains before
    /// `end`.
    #[inline]
    fn fit(&self, step: f64, end: f64) -> (f64, f64) {
        let remaining = end - self.time;
        if step >= tuning::STRETCH * remaining {
            return (remaining, end);
        }
        let step = if step > tuning::HALVE * remaining && self.options.fixed_step.is_none() {
            tuning::HALVE * remaining
        } else {
            step
        };
        let target = self.time + step;
        (target - self.time, target)
    }

    /// Starts the next smooth interval of the explicit time dependence.
    fn start_next_interval(&mut self) -> Result<(), StepError> {
        let end = self.problem.next_time_discontinuity(self.time);
        if end.is_nan() || end <= self.time {
            return Err(self.error(Reason::TimeDiscontinuity { end }, 0.0, None, 0.0));
        }
        self.interval_start = self.time;
        self.interval_end = end;
        self.statistics.restarts += 1;
        self.restart();
        match self.first_not_finite() {
            Some(index) => Err(self.error(Reason::NotFinite, 0.0, Some(index), f64::NAN)),
            None => Ok(()),
        }
    }

    /// Evaluates the derivative at the state reached, after a change of the right-hand side.
    pub(super) fn evaluate_derivative(&mut self) {
        self.correction.state = CorrectionState::Disabled;
        let n = self.dimension;
        self.problem
            .derivative(self.time, &self.x[..n], &mut self.dx[..n]);
        self.statistics.derivatives += 1;
        self.linearized = false;
        self.newton.cache.clear();
        self.events.forget();
        self.update_spectral_radius();
        if self.predicts() {
            self.update_discontinuities();
        }
    }

    /// Returns whether discontinuities are predicted, and errors bounded in regularization zones.
    pub(super) fn predicts(&self) -> bool {
        self.options.fixed_step.is_none() && self.tableau.family == Family::LinearlyImplicit
    }

    /// Evaluates the bound of the spectral radius at the state reached, if the next step may be explicit.
    fn update_spectral_radius(&mut self) {
        if self.options.explicit_steps && self.tableau.family == Family::LinearlyImplicit {
            let x = &self.x[..self.dimension];
            self.spectral_radius = self.problem.spectral_radius_bound(self.time, x);
        }
    }

    /// Evaluates the discontinuity functions at the state reached, and the admissible errors there.
    #[inline]
    fn update_discontinuities(&mut self) {
        let x = &self.x[..self.dimension];
        self.predictor.evaluate(&mut self.problem, self.time, x);
        let share = 1.0 / self.predictor.bound_widening();
        let bounds = self.plain_weights.iter().zip(&self.zone_weights);
        for (weight, (plain, zone)) in self.weights.iter_mut().zip(bounds) {
            *weight = plain.max(zone * share);
        }
    }

    /// Returns the index of the first state whose derivative is not finite.
    pub(super) fn first_not_finite(&self) -> Option<usize> {
        self.derivative().iter().position(|value| !value.is_finite())
    }

    /// Accepts the attempt and plans the next step.
    #[inline]
    fn accept(&mut self, error: f64) {
        let Attempt { step, target, .. } = self.attempt;
        self.prediction = None;
        std::mem::swap(&mut self.previous_x, &mut self.x);
        std::mem::swap(&mut self.x, &mut self.trial_x);
        std::mem::swap(&mut self.dx, &mut self.trial_dx);
        std::mem::swap(&mut self.stages, &mut self.trial_stages);
        self.previous_time = self.time;
        self.time = target;
        self.linearized = false;
        self.last_method = self.trial_method;
        self.statistics.accept(step);
        let family = self.last_method.family;
        self.correction.state = if family == Family::LinearlyImplicit {
            CorrectionState::Undecided
        } else {
            CorrectionState::Disabled
        };
        self.statistics.explicit_steps += u64::from(family == Family::Explicit);
        // All functions are evaluated at the end of the step one after the other: what the problem computes
        // for one serves the others.
        let radius_before = self.spectral_radius;
        self.update_spectral_radius();
        if self.predicts() {
            self.update_discontinuities();
        }
        if !self.events.discrete_states.is_empty() {
            let x = &self.x[..self.dimension];
            self.events.evaluate_end(&mut self.problem, self.time, x);
        }
        if self.options.fixed_step.is_none() {
            self.control_step(error, radius_before);
        }
        self.predict_and_detect(error);
    }

    /// Chooses the length of the next step. `radius_before` is the spectral radius at the start of this one.
    #[inline]
    fn control_step(&mut self, error: f64, radius_before: f64) {
        let Attempt {
            step,
            truncated,
            proposed,
            prediction,
            ..
        } = self.attempt;
        let root = self.error_root(error);
        let family = self.last_method.family;
        let active = self.predictor.is_active();
        let (factor, genuine) = self.controller.accept(&self.options, step, root, active, family);
        let next = step * factor;
        // A step truncated by a limit says little about the planned one.
        self.proposed_step = if truncated && !genuine {
            next.max(proposed)
        } else {
            next
        };
        match prediction {
            Some(Prediction {
                zone_step: Some(first),
                ..
            }) => self.start_in_zone(first),
            Some(_) => self.plan_after_discontinuity(proposed, radius_before),
            None => {}
        }
        self.proposed_step = self.proposed_step.min(self.options.maximum_step).min(f64::MAX);
    }

    /// Plans the step after a discontinuity; the error of the step across it says nothing.
    fn plan_after_discontinuity(&mut self, planned: f64, radius_before: f64) {
        self.proposed_step = self.proposed_step.max(tuning::AFTER_DISCONTINUITY * planned);
        if self.last_method.family == Family::Explicit
            && self.spectral_radius > radius_before
            // A bound that is not known (infinite) would say that no step is short enough.
            && self.spectral_radius.is_finite()
        {
            // A contact closed: the explicit steps that follow are as long as its vibration asks for.
            self.proposed_step = self
                .proposed_step
                .min(tuning::AFTER_CLOSING_H_RHO / self.spectral_radius);
        }
        self.controller.restart();
    }

    /// Plans the first step in a regularization zone.
    fn start_in_zone(&mut self, first_step: f64) {
        self.proposed_step = self.proposed_step.min(first_step);
        self.controller.restart();
    }

    /// Predicts the next discontinuity and locates the events of the step just accepted.
    #[inline]
    fn predict_and_detect(&mut self, error: f64) {
        let predicts = self.predicts();
        let dense = DenseOutput {
            tableau: self.last_method,
            start: self.previous_time,
            step: self.time - self.previous_time,
            end: self.time,
            x0: &self.previous_x,
            x1: &self.x,
            stages: &self.stages,
        };
        if predicts {
            let length = self.proposed_step.min(self.interval_end - self.time);
            self.prediction = self.predictor.predict(&mut self.problem, &dense, length, error);
            self.statistics.discontinuities_predicted += u64::from(self.prediction.is_some());
        }
        if !self.events.discrete_states.is_empty() {
            let maximum = self.options.maximum_events;
            self.events
                .detect(&mut self.problem, &dense, maximum, &mut self.statistics);
        }
        if let Some(Prediction {
            time,
            zone_step: Some(first),
        }) = self.prediction
            && time <= self.time
        {
            self.prediction = None;
            self.start_in_zone(first);
        }
    }

    /// Returns the root of an error, a number proportional to the step.
    #[inline]
    fn error_root(&self, error: f64) -> f64 {
        match self.trial_method.embedded_order {
            3 => error.sqrt().sqrt(),
            // Half the time of a power.
            q => libm::exp(libm::log(error) / f64::from(q + 1)),
        }
    }

    /// Returns the index of the state with the largest error in the last attempt.
    fn largest_error(&self) -> usize {
        let weights = match self.trial_method.family {
            Family::DiagonallyImplicit => &self.newton.error_weights,
            _ => &self.weights,
        };
        let mut largest = (0, 0.0);
        for (i, (u, weight)) in self.last_trial_stage().iter().zip(weights).enumerate() {
            let size = u.abs() * weight;
            if size > largest.1 {
                largest = (i, size);
            }
        }
        largest.0
    }
}
