//! Start of an integration, saved states, and changes of the right-hand side.

use super::Integrator;
use super::memory::{Attempt, DenseCorrection};
use crate::controller::Controller;
use crate::discontinuity_prediction::DiscontinuityPredictor;
use crate::error::SetupError;
use crate::event_detection::EventDetector;
use crate::limits::{LARGEST_STATE, STATE_VERSION};
use crate::methods::tableau::{Family, MAXIMUM_STAGES};
use crate::newton::Newton;
use crate::options::Options;
use crate::problem::{Problem, ProblemStructure};
use crate::state::State;
use crate::statistics::Statistics;
use crate::tuning::first_step as tuning;
use numerics::lanes::LANES;

impl<P: Problem> Integrator<P> {
    /// Starts an integration.
    ///
    /// # Errors
    /// If the options, the problem's scales, the states or the derivative at the start are not admissible.
    pub fn new(problem: P, options: Options, time: f64, x: &[f64]) -> Result<Self, SetupError> {
        let state = State {
            version: STATE_VERSION,
            time,
            x: x.to_vec(),
            discrete_states: vec![0; recorded_states(&problem.structure(), &options)],
            interval_start: time,
            proposed_step: 1.0,
            prediction: None,
            controller: Controller::default(),
            last_stage_derivative: Vec::new(),
            linearization_point: None,
            statistics: Statistics::default(),
        };
        let mut this = Self::resume(problem, options, state)?;
        this.statistics.derivatives = 1;
        if !this.events.discrete_states.is_empty() {
            let states = &mut this.events.discrete_states;
            this.problem.initial_discrete_states(time, x, states);
            this.events.before.copy_from_slice(&this.events.discrete_states);
        }
        this.proposed_step = match (this.options.fixed_step, this.options.initial_step) {
            (Some(step), _) | (None, Some(step)) => step,
            (None, None) => this.estimate_first_step(),
        };
        Ok(this)
    }

    /// Continues an integration from a saved state, with the same bits if the problem and the options are the
    /// same.
    ///
    /// # Errors
    /// If the state does not fit to this program or to the problem, and as [`Integrator::new`].
    pub fn resume(mut problem: P, options: Options, state: State) -> Result<Self, SetupError> {
        options.check()?;
        let structure = problem.structure();
        let n = structure.dimension();
        let stride = n.next_multiple_of(LANES);
        check_state(&state, n, recorded_states(&structure, &options))?;
        check_scales(&structure.scales, options.fixed_step.is_none())?;
        let (weights, zone_weights) = weights(&structure, options.relative_tolerance, stride);
        let interval_end = start_interval(&mut problem, &state)?;
        let tableau = options.method.tableau();
        let zero = || vec![0.0; stride];
        let mut x = zero();
        x[..n].copy_from_slice(&state.x);
        let all_stages = vec![0.0; stride * MAXIMUM_STAGES];
        let newton = match tableau.family {
            Family::DiagonallyImplicit => Newton::new(&structure, options.relative_tolerance, stride),
            _ => Newton::default(),
        };
        let mut this = Self {
            events: EventDetector::new(&structure, state.discrete_states.clone(), options.maximum_events),
            predictor: DiscontinuityPredictor::new(&structure),
            structure,
            problem,
            options,
            tableau,
            last_method: tableau,
            trial_method: tableau,
            spectral_radius: f64::INFINITY,
            dimension: n,
            stride,
            plain_weights: weights.clone(),
            zone_weights,
            weights,
            time: state.time,
            previous_time: state.time,
            interval_start: state.interval_start,
            interval_end,
            proposed_step: state.proposed_step,
            prediction: state.prediction,
            controller: state.controller.clone(),
            statistics: state.statistics.clone(),
            previous_x: x.clone(),
            x,
            dx: zero(),
            df_dt: zero(),
            autonomous: true,
            linearized: false,
            stages: all_stages.clone(),
            attempt: Attempt::NONE,
            trial_stages: all_stages,
            trial_x: zero(),
            trial_dx: zero(),
            argument: zero(),
            stage_derivative: zero(),
            newton,
            correction: DenseCorrection::new(stride),
        };
        this.evaluate_uncounted();
        if let Some(index) = this.first_not_finite() {
            let value = this.dx[index];
            return Err(SetupError::NotFiniteDerivative {
                time: this.time,
                index,
                value,
            });
        }
        this.restore_esdirk(&state);
        Ok(this)
    }

    /// Returns all that is needed to continue with the same bits.
    #[must_use]
    pub fn state(&self) -> State {
        State {
            version: STATE_VERSION,
            time: self.time,
            x: self.x().to_vec(),
            discrete_states: self.events.discrete_states.clone(),
            interval_start: self.interval_start,
            proposed_step: self.proposed_step,
            prediction: self.prediction,
            controller: self.controller.clone(),
            last_stage_derivative: match self.tableau.family {
                Family::DiagonallyImplicit => self.derivative().to_vec(),
                _ => Vec::new(),
            },
            linearization_point: self.newton.cache.saved_point(self.dimension),
            statistics: self.statistics.clone(),
        }
    }

    /// Checks whether a saved state can belong to this problem.
    ///
    /// # Errors
    /// If the state does not fit to this program or to the problem.
    pub fn check_state(&self, state: &State) -> Result<(), SetupError> {
        check_state(state, self.dimension, self.events.discrete_states.len())
    }

    /// Returns to a saved state of the same problem and options, with the same bits as
    /// [`Integrator::resume`], without allocation. The last step is forgotten: nothing can be interpolated.
    ///
    /// # Errors
    /// If the state does not fit to this program or to the problem; nothing has changed then.
    pub fn restore(&mut self, state: &State) -> Result<(), SetupError> {
        self.check_state(state)?;
        let interval_end = start_interval(&mut self.problem, state)?;
        let n = self.dimension;
        self.x[..n].copy_from_slice(&state.x);
        self.previous_x.copy_from_slice(&self.x);
        self.events
            .discrete_states
            .copy_from_slice(&state.discrete_states);
        self.events.before.copy_from_slice(&state.discrete_states);
        self.events.events.clear();
        (self.time, self.previous_time) = (state.time, state.time);
        (self.interval_start, self.interval_end) = (state.interval_start, interval_end);
        self.proposed_step = state.proposed_step;
        self.prediction = state.prediction;
        self.controller.clone_from(&state.controller);
        self.statistics.clone_from(&state.statistics);
        self.evaluate_uncounted();
        self.restore_esdirk(state);
        Ok(())
    }

    /// Evaluates the derivative without counting: an uninterrupted run has it from its last step.
    fn evaluate_uncounted(&mut self) {
        let counted = self.statistics.derivatives;
        self.evaluate_derivative();
        self.statistics.derivatives = counted;
    }

    /// Restores what ESDIRK methods carry from step to step.
    fn restore_esdirk(&mut self, state: &State) {
        if self.tableau.family == Family::DiagonallyImplicit {
            for (dx, saved) in self.dx.iter_mut().zip(&state.last_stage_derivative) {
                *dx = *saved;
            }
            self.restore_matrix(state.linearization_point.as_ref());
        }
    }

    /// Continues after a change of the right-hand side without a jump: it is evaluated again, the memory of
    /// the step-size controller is kept. A motion that a caller continues piece by piece costs no restart
    /// this way.
    pub fn reevaluate(&mut self) {
        self.evaluate_derivative();
        self.prediction = None;
    }

    /// Continues after a jump of the right-hand side: it is evaluated again, the memory of the step-size
    /// controller is dropped.
    pub fn restart(&mut self) {
        self.reevaluate();
        self.controller.restart();
    }

    /// Returns the length of the first step: Hairer, Nørsett & Wanner (1993), section II.4.
    fn estimate_first_step(&mut self) -> f64 {
        let n = self.dimension;
        let tolerance = self.options.relative_tolerance;
        let size = |a: &[f64], b: &[f64]| {
            let pairs = a.iter().zip(b).zip(&self.weights);
            pairs.fold(0.0_f64, |most, ((a, b), weight)| most.max((a - b).abs() * weight))
        };
        let zero = vec![0.0; self.stride];
        let longest = self.options.maximum_step.min(self.interval_end - self.time);
        let first = size(&self.dx, &zero);
        // In units of the scales, not of the tolerance.
        let trial = if first > tuning::SMALL_DERIVATIVE {
            tuning::TARGET / (tolerance * first)
        } else {
            tuning::DEFAULT * self.time.abs().max(1.0)
        };
        let trial = trial.min(longest);
        for ((target, x), dx) in self.argument.iter_mut().zip(&self.x).zip(&self.dx) {
            *target = x + trial * dx;
        }
        self.problem
            .derivative(self.time + trial, &self.argument[..n], &mut self.trial_dx[..n]);
        self.statistics.derivatives += 1;
        let second = size(&self.trial_dx, &self.dx) / trial;
        let most = first.max(second);
        let step = if most > tuning::SMALL_DERIVATIVE {
            let exponent = 1.0 / f64::from(self.tableau.embedded_order + 1);
            libm::pow(tuning::TARGET / most, exponent)
        } else {
            tuning::MAXIMUM_FACTOR * trial
        };
        let step = if step.is_finite() {
            step.min(tuning::MAXIMUM_FACTOR * trial)
        } else {
            trial
        };
        step.min(longest)
            .max(self.options.minimum_step)
            .max(tuning::RESOLUTION * f64::EPSILON * self.time.abs())
    }
}

/// Returns the number of discrete states that are recorded.
fn recorded_states(structure: &ProblemStructure, options: &Options) -> usize {
    if options.record_events {
        structure.discrete_states()
    } else {
        0
    }
}

/// Checks whether a state can belong to a problem with so many states and recorded discrete states.
fn check_state(state: &State, dimension: usize, discrete_states: usize) -> Result<(), SetupError> {
    if !state.time.is_finite() {
        return Err(SetupError::Time(state.time));
    }
    state.check(dimension, discrete_states)?;
    let mut states = state.x.iter().enumerate();
    match states.find(|(_, value)| value.is_nan() || value.abs() > LARGEST_STATE) {
        Some((index, &value)) => Err(SetupError::NotFiniteState { index, value }),
        None => Ok(()),
    }
}

/// Checks the error scales of a problem.
fn check_scales(scales: &[f64], controlled: bool) -> Result<(), SetupError> {
    if let Some((index, &value)) = scales.iter().enumerate().find(|(_, s)| s.is_nan() || **s <= 0.0) {
        return Err(SetupError::Scale { index, value });
    }
    if !scales.is_empty() && controlled && scales.iter().all(|scale| scale.is_infinite()) {
        return Err(SetupError::NothingControlled);
    }
    Ok(())
}

/// Returns the reciprocals of admissible errors outside of regularization zones, and of the bounds in zones.
fn weights(structure: &ProblemStructure, tolerance: f64, stride: usize) -> (Vec<f64>, Vec<f64>) {
    let (mut weights, mut zone_weights) = (vec![0.0; stride], vec![0.0; stride]);
    for (weight, scale) in weights.iter_mut().zip(&structure.scales) {
        *weight = 1.0 / (tolerance * scale);
    }
    for (weight, bound) in weights.iter_mut().zip(&structure.error_bounds) {
        *weight = weight.max(1.0 / bound);
    }
    for (weight, bound) in zone_weights.iter_mut().zip(&structure.zone_error_bounds) {
        *weight = 1.0 / bound;
    }
    (weights, zone_weights)
}

/// Brings a problem to the smooth interval of the time dependence in which a state lies; returns its end.
fn start_interval<P: Problem>(problem: &mut P, state: &State) -> Result<f64, SetupError> {
    let end = problem.next_time_discontinuity(state.interval_start);
    if end.is_nan() || end <= state.interval_start || end < state.time {
        return Err(SetupError::TimeDiscontinuity {
            start: state.interval_start,
            end,
        });
    }
    Ok(end)
}
