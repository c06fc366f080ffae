//! Steps.

use super::Integrator;
use super::attempt::{Attempt, Failure, Outcome};
use crate::error::{Reason, StepError};
use crate::kinks::{Ahead, Layer, Passage, WHOLE_LANDING};
use crate::methods::tableau::Family;
use crate::problem::Problem;
use crate::stages::Dense;

/// The part of the planned step that is tried behind a kink.
const BEHIND_KINK: f64 = 0.5;

/// The part of the way to a kink that is tried after a step to it got across.
const SHORT_OF_KINK: f64 = 0.8;

/// A step that is shorter than this part of the planned one was cut short; by rounding alone others are shorter too.
const CUT: f64 = 1.0 - 1e-6;

/// The fastest answer behind a kink is faster than before it by this factor where something has struck there, and slower by it where
/// something has come off.
const STRUCK: f64 = 1.5;

/// The part of the longest explicit step that is tried where something has come off: it may strike again soon.
const CAME_OFF: f64 = 0.1;

/// Errors above this bounded a step.
const BOUNDED: f64 = 0.1;

/// A layer in which nothing reverses (slip that comes to stick, say) is behind where errors are smaller than this.
const SETTLED: f64 = 0.001;

impl<P: Problem> Integrator<P> {
    /// Makes one accepted step that does not pass `limit` (which may be infinite) nor the end of the segment.
    ///
    /// # Errors
    /// If the limit does not lie ahead, or no step can be made; the last accepted step then stays in place.
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

    /// Whether an attempt with this error is a step.
    #[inline(always)]
    fn is_acceptable(&self, error: f64) -> bool {
        !self.attempt.checked && (self.options.fixed_step.is_some() || error <= 1.0)
    }

    /// Plans the first attempt at a step.
    #[inline]
    fn plan(&mut self, limit: f64) -> Result<(), StepError> {
        self.between.close();
        if limit.is_nan() || limit <= self.time {
            return Err(self.error(Reason::Limit { limit }, 0.0, None, 0.0));
        }
        if self.time >= self.segment_end {
            self.enter_segment()?;
        }
        let end = limit.min(self.segment_end);
        let proposed = self.proposed_step.min(self.options.maximum_step);
        let (mut step, mut target) = self.fit(proposed, end);
        let mut landing = None;
        if let Some(ahead @ (Ahead::Kink(time) | Ahead::Layer(time, _))) = self.ahead
            && time > self.time
            && time < target
        {
            let distance = time - self.time;
            if distance > WHOLE_LANDING * step && !self.is_explicit(step) {
                // The arguments of a step's stages are less exact than its end: they would get across. (Those of an explicit method are
                // exact enough.)
                (step, target) = self.fit(0.5 * distance, end);
            } else {
                (step, target, landing) = (distance, time, Some(ahead));
            }
        }
        // Else the time would never go on.
        if target <= self.time {
            return Err(self.give_up(Reason::Lost, proposed, None, 0.0));
        }
        self.attempt = Attempt {
            end,
            proposed,
            step,
            target,
            landing,
            cut: step < CUT * proposed,
            ..Attempt::NONE
        };
        self.check_number()
    }

    /// Whether one more attempt is admissible.
    fn check_number(&mut self) -> Result<(), StepError> {
        let (statistics, maximum) = (&self.statistics, self.options.maximum_steps);
        if statistics.steps + statistics.rejected() < maximum {
            return Ok(());
        }
        let Attempt {
            step, scaled_error, ..
        } = self.attempt;
        let index = (scaled_error > 0.0).then(|| self.dominant().0);
        Err(self.give_up(Reason::MaximumSteps { maximum }, step, index, scaled_error))
    }

    /// Plans another attempt after one that failed or whose error is too large.
    #[cold]
    fn reject(&mut self, outcome: Outcome) -> Result<(), StepError> {
        let Attempt {
            end,
            mut step,
            target,
            landing,
            mut scaled_error,
            checked,
            blamed,
            ..
        } = self.attempt;
        let tried = target - self.time;
        if checked {
            let failure = outcome.err().unwrap_or(Failure {
                reason: Reason::NotFinite,
                index: blamed,
            });
            return Err(self.give_up(failure.reason, tried, failure.index, f64::NAN));
        }
        let failure = match outcome {
            Ok(error) => {
                self.statistics.rejected_error += 1;
                scaled_error = error;
                step *= if landing.is_some() {
                    // It got across. Most of the way is on this side, and from there the kink is seen more exactly.
                    SHORT_OF_KINK
                } else {
                    let root = self.root(error);
                    self.controller.reject(&self.options, root)
                };
                Failure {
                    reason: Reason::Error,
                    index: None,
                }
            }
            Err(failure) => {
                self.controller.fail();
                match failure.reason {
                    Reason::Singular { .. } => {
                        self.statistics.rejected_singular += 1;
                        step *= 0.5;
                    }
                    Reason::Unsolved => {
                        self.statistics.rejected_unsolved += 1;
                        step *= 0.25;
                    }
                    _ => {
                        self.statistics.rejected_not_finite += 1;
                        step *= 0.25;
                    }
                }
                failure
            }
        };
        let minimum = self
            .options
            .minimum_step
            .max(4.0 * f64::EPSILON * self.time.abs())
            .max(f64::MIN_POSITIVE);
        let last = step < minimum || self.options.fixed_step.is_some();
        if last && failure.reason != Reason::NotFinite {
            let (index, scaled_error) = match failure.reason {
                Reason::Error => (Some(self.dominant().0), scaled_error),
                _ => (failure.index, f64::NAN),
            };
            return Err(self.give_up(failure.reason, tried, index, scaled_error));
        }
        let (step, target) = if last {
            // once more, to see where it begins
            (tried, target)
        } else {
            self.fit(step, end)
        };
        self.attempt = Attempt {
            step,
            target,
            landing: None,
            cut: false,
            scaled_error,
            checked: last,
            blamed: failure.index,
            ..self.attempt
        };
        if last { Ok(()) } else { self.check_number() }
    }

    /// The step cannot be made.
    fn give_up(&mut self, reason: Reason, step: f64, index: Option<usize>, scaled_error: f64) -> StepError {
        self.ahead = None;
        self.error(reason, step, index, scaled_error)
    }

    fn error(&self, reason: Reason, step: f64, index: Option<usize>, scaled_error: f64) -> StepError {
        StepError {
            time: self.time,
            step,
            reason,
            index,
            scaled_error,
        }
    }

    /// Length and end of the next attempt, such that no tiny step remains before `end`.
    #[inline]
    fn fit(&self, step: f64, end: f64) -> (f64, f64) {
        let remaining = end - self.time;
        if step >= 0.99 * remaining {
            return (remaining, end);
        }
        let step = if step > 0.5 * remaining && self.options.fixed_step.is_none() {
            0.5 * remaining
        } else {
            step
        };
        let target = self.time + step;
        (target - self.time, target)
    }

    fn enter_segment(&mut self) -> Result<(), StepError> {
        let end = self.problem.segment(self.time);
        if end.is_nan() || end <= self.time {
            return Err(self.error(Reason::Segment { end }, 0.0, None, 0.0));
        }
        self.segment_start = self.time;
        self.segment_end = end;
        self.statistics.restarts += 1;
        self.refresh();
        match self.first_not_finite() {
            Some(index) => Err(self.error(Reason::NotFinite, 0.0, Some(index), f64::NAN)),
            None => Ok(()),
        }
    }

    pub(super) fn evaluate_derivative(&mut self) {
        self.between.close();
        let n = self.dimension;
        self.problem
            .derivative(self.time, &self.x[..n], &mut self.dx[..n]);
        self.statistics.derivatives += 1;
        self.linearized = false;
        self.newton.forget();
        self.switches.forget();
        self.bound();
        if self.foresees() {
            self.look(false);
        }
    }

    /// Whether kinks are foreseen, and errors held to what the place reached asks for.
    pub(super) fn foresees(&self) -> bool {
        self.options.fixed_step.is_none() && self.tableau.family == Family::LinearlyImplicit
    }

    /// Asks for the problem's fastest answer at the place reached, if that may make steps explicit.
    fn bound(&mut self) {
        if self.options.explicit_steps && self.tableau.family == Family::LinearlyImplicit {
            self.stiffness = self.problem.stiffness(self.time, &self.x[..self.dimension]);
        }
    }

    /// Looks for kinks at the place reached, and lets errors count as they must there.
    #[inline]
    fn look(&mut self, again: bool) {
        if again {
            self.kinks.look_again();
        } else {
            let x = &self.x[..self.dimension];
            self.kinks.look(&mut self.problem, self.time, x);
        }
        let share = 1.0 / self.kinks.slack();
        let bounds = self.plain_weights.iter().zip(&self.layer_weights);
        for (weight, (plain, layer)) in self.weights.iter_mut().zip(bounds) {
            *weight = plain.max(layer * share);
        }
    }

    /// Plans the step behind a kink; the error of the step across it says nothing. Before it the fastest answer was `answer`.
    fn leave_kink(&mut self, planned: f64, answer: f64) {
        self.proposed_step = self.proposed_step.max(BEHIND_KINK * planned);
        if self.reach > 0.0 {
            // In units of the fastest answer steps are about as long as before.
            let usual = self.reach / self.stiffness;
            if self.stiffness > STRUCK * answer {
                self.proposed_step = self.proposed_step.min(usual);
            } else if STRUCK * self.stiffness < answer {
                self.proposed_step = self.proposed_step.max(CAME_OFF * usual);
            }
        }
        self.controller.restart();
    }

    /// Begins the way through a layer, behind which steps may be as long as `planned`.
    fn enter_layer(&mut self, layer: Layer, planned: f64) {
        self.passage = Some(Passage { layer, planned });
        self.proposed_step = self.proposed_step.min(layer.length);
        self.controller.restart();
    }

    pub(super) fn first_not_finite(&self) -> Option<usize> {
        self.derivative().iter().position(|value| !value.is_finite())
    }

    #[inline]
    fn accept(&mut self, error: f64) {
        let Attempt {
            step,
            target,
            cut,
            proposed,
            landing,
            ..
        } = self.attempt;
        self.ahead = None;
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
        self.between.open(family);
        if family == Family::DiagonallyImplicit {
            let first = &self.stages[..self.stride];
            self.newton
                .leave_behind(self.time - self.previous_time, &self.previous_x, first);
        }
        self.statistics.explicit_steps += u64::from(family == Family::Explicit);
        // All that is asked at the end is asked at once: what the problem has computed there serves several times.
        let answer = self.stiffness;
        self.bound();
        if family == Family::Explicit && !cut && landing.is_none() && error > BOUNDED {
            self.reach = step * answer;
        }
        if self.foresees() {
            // An explicit step that was not to end at a kink was peered at.
            self.look(family == Family::Explicit && landing.is_none());
        }
        if !self.switches.modes.is_empty() {
            self.switches
                .look(&mut self.problem, self.time, &self.x[..self.dimension]);
        }
        if self.options.fixed_step.is_none() {
            let root = self.root(error);
            let (factor, genuine) =
                self.controller
                    .accept(&self.options, step, root, self.kinks.are_told(), family);
            let next = step * factor;
            // A step cut short by a limit says little about the step that was planned.
            self.proposed_step = if cut && !genuine { next.max(proposed) } else { next };
            match landing {
                Some(Ahead::Layer(_, layer)) if self.kinks.has_come(&layer) => {
                    self.enter_layer(layer, proposed)
                }
                Some(Ahead::Kink(_) | Ahead::Layer(..)) => self.leave_kink(proposed, answer),
                _ => {}
            }
            self.proposed_step = self.proposed_step.min(self.options.maximum_step).min(f64::MAX);
            if let Some(Passage { layer, planned }) = self.passage
                && ((error < SETTLED && !self.kinks.moves(&layer))
                    || self.proposed_step >= planned
                    || self.kinks.is_behind(&layer))
            {
                self.passage = None;
                self.proposed_step = self.proposed_step.max(BEHIND_KINK * planned);
                self.controller.restart();
            }
        }
        let dense = Dense {
            tableau: self.last_method,
            start: self.previous_time,
            step: self.time - self.previous_time,
            end: self.time,
            x0: &self.previous_x,
            x1: &self.x,
            stages: &self.stages,
        };
        if self.foresees() {
            let length = self.proposed_step.min(self.segment_end - self.time);
            self.ahead = self.kinks.foresee(&mut self.problem, &dense, length, error);
            self.statistics.kinks_foreseen += u64::from(self.ahead.is_some());
        }
        if !self.switches.modes.is_empty() {
            let maximum = self.options.maximum_events;
            self.switches
                .detect(&mut self.problem, &dense, maximum, &mut self.statistics);
        }
        if let Some(Ahead::InLayer(layer)) = self.ahead {
            self.enter_layer(layer, self.proposed_step);
        }
    }

    /// The root of an error that is proportional to the step.
    #[inline]
    fn root(&self, error: f64) -> f64 {
        match self.trial_method.embedded_order {
            3 => error.sqrt().sqrt(),
            // Half the time of a power.
            q => libm::exp(libm::log(error) / f64::from(q + 1)),
        }
    }

    /// The state with the largest error in the last attempt, and the error.
    fn dominant(&self) -> (usize, f64) {
        let last = self.last_trial_stage();
        let mut found = (0, 0.0);
        let weights = match self.trial_method.family {
            Family::DiagonallyImplicit => &self.newton.controlled,
            _ => &self.weights,
        };
        for (i, (u, weight)) in last.iter().zip(weights).enumerate() {
            let size = u.abs() * weight;
            if size > found.1 {
                found = (i, size);
            }
        }
        found
    }

    /// A first step: Hairer, Nørsett & Wanner, *Solving Ordinary Differential Equations I*, section II.4.
    pub(super) fn estimate_step(&mut self) -> f64 {
        let n = self.dimension;
        let tolerance = self.options.relative_tolerance;
        let size = |a: &[f64], b: &[f64]| {
            let pairs = a.iter().zip(b).zip(&self.weights);
            pairs.fold(0.0_f64, |most, ((a, b), weight)| most.max((a - b).abs() * weight))
        };
        let zero = vec![0.0; self.stride];
        let longest = self.options.maximum_step.min(self.segment_end - self.time);
        let slope = size(&self.dx, &zero);
        // in units of the scales, not of the tolerance
        let guess = if slope > 1e-10 {
            0.01 / (tolerance * slope)
        } else {
            1e-6 * self.time.abs().max(1.0)
        };
        let guess = guess.min(longest);
        for ((target, x), dx) in self.argument.iter_mut().zip(&self.x).zip(&self.dx) {
            *target = x + guess * dx;
        }
        self.problem
            .derivative(self.time + guess, &self.argument[..n], &mut self.trial_dx[..n]);
        self.statistics.derivatives += 1;
        let bend = size(&self.trial_dx, &self.dx) / guess;
        let most = slope.max(bend);
        let step = if most > 1e-10 {
            libm::pow(0.01 / most, 1.0 / f64::from(self.tableau.embedded_order + 1))
        } else {
            100.0 * guess
        };
        let step = if step.is_finite() {
            step.min(100.0 * guess)
        } else {
            guess
        };
        step.min(longest)
            .max(self.options.minimum_step)
            .max(16.0 * f64::EPSILON * self.time.abs())
    }
}
