//! The integrator.

use crate::control::Controller;
use crate::error::SetupError;
use crate::events::{Event, Switches};
use crate::kinks::{Ahead, Kinks, Passage};
use crate::lanes::LANES;
use crate::methods::tableau::{Family, MAXIMUM_STAGES, Tableau};
use crate::options::Options;
use crate::problem::Problem;
use crate::stages::leading_states;
use crate::state::{STATE_VERSION, State};
use crate::statistics::Statistics;

mod attempt;
mod between;
mod guess;
mod kept;
mod newton;
mod piece;
mod reversal;
mod step;

use attempt::Attempt;
use between::Between;
pub(crate) use guess::Behind;
pub(crate) use kept::Place;
use newton::Newton;

/// Integrates a [`Problem`] step by step.
///
/// ```
/// use integrate::{Integrator, Options, Ordinary};
/// // x' = -1000 (x - cos t)
/// let problem = Ordinary::new(
///     vec![1.0],
///     |t, x, dx| dx[0] = -1000.0 * (x[0] - libm::cos(t)),
///     |_, _, jacobian| jacobian[0] = -1000.0,
/// )
/// .time_derivative(|t, _, df_dt| df_dt[0] = -1000.0 * libm::sin(t));
/// let mut integrator = Integrator::new(problem, Options::default(), 0.0, &[0.0])?;
/// while integrator.time() < 1.0 {
///     integrator.step_to(1.0)?;
/// }
/// let exact = (1e6 * libm::cos(1.0) + 1e3 * libm::sin(1.0)) / (1e6 + 1.0);
/// assert!((integrator.x()[0] - exact).abs() < 1e-6);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub struct Integrator<P: Problem> {
    problem: P,
    options: Options,
    tableau: &'static Tableau,
    /// Methods of the last accepted step, and of the step being tried.
    last_method: &'static Tableau,
    trial_method: &'static Tableau,
    /// How fast the fastest part of the problem answers at the place reached, see [`Problem::stiffness`].
    stiffness: f64,
    /// Stages whose argument is that of the stage before plus its `U`.
    extends: Vec<bool>,
    /// How many leading states the argument of each stage needs: those that the problem reads, but all where the new states come
    /// from it.
    widths: Vec<usize>,
    dimension: usize,
    /// Length of a padded vector.
    stride: usize,
    /// Reciprocal of the admissible error: relative_tolerance · scale, or the problem's bounds.
    weights: Vec<f64>,
    /// The same without bounds in layers.
    plain_weights: Vec<f64>,
    /// Reciprocal of the bounds in layers; zero: none.
    layer_weights: Vec<f64>,

    time: f64,
    previous_time: f64,
    segment_start: f64,
    segment_end: f64,
    proposed_step: f64,
    ahead: Option<Ahead>,
    passage: Option<Passage>,
    kinks: Kinks,
    controller: Controller,
    statistics: Statistics,
    switches: Switches,

    x: Vec<f64>,
    previous_x: Vec<f64>,
    /// The derivative at `(time, x)`.
    dx: Vec<f64>,
    df_dt: Vec<f64>,
    autonomous: bool,
    /// Whether the Jacobian matrix is the one at `(time, x)`.
    linearized: bool,
    /// Stages of the last accepted step.
    stages: Vec<f64>,

    // The step being tried.
    attempt: Attempt,
    trial_stages: Vec<f64>,
    trial_x: Vec<f64>,
    trial_dx: Vec<f64>,
    argument: Vec<f64>,
    slope: Vec<f64>,
    newton: Newton,
    between: Between,
    /// How long the last explicit step was that its error bounded, in units of the fastest answer; zero: there was none.
    reach: f64,
}

impl<P: Problem> std::fmt::Debug for Integrator<P> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Integrator")
            .field("method", &self.options.method)
            .field("time", &self.time)
            .field("x", &self.x())
            .field("statistics", &self.statistics)
            .finish_non_exhaustive()
    }
}

impl<P: Problem> Integrator<P> {
    /// Begins an integration.
    ///
    /// # Errors
    /// If the options, the problem's scales, the states or the derivative at the start are not admissible.
    pub fn new(problem: P, options: Options, time: f64, x: &[f64]) -> Result<Self, SetupError> {
        let state = State {
            version: STATE_VERSION,
            time,
            x: x.to_vec(),
            modes: vec![0; options.switches_of(&problem)],
            segment_start: time,
            proposed_step: 1.0,
            ahead: None,
            passage: None,
            controller: Controller::default(),
            reach: 0.0,
            slope: Vec::new(),
            behind: None,
            matrix: None,
            statistics: Statistics::default(),
        };
        let mut this = Self::resume(problem, options, state)?;
        this.statistics.derivatives = 1;
        if !this.switches.modes.is_empty() {
            this.problem.initial_modes(time, x, &mut this.switches.modes);
            this.switches.before.copy_from_slice(&this.switches.modes);
        }
        this.proposed_step = match (this.options.fixed_step, this.options.initial_step) {
            (Some(step), _) | (None, Some(step)) => step,
            (None, None) => this.estimate_step(),
        };
        Ok(this)
    }

    /// Continues an integration from a saved state, with the same bits if the problem and the options are the same.
    ///
    /// # Errors
    /// If the state does not fit to this program or to the problem, and as [`Integrator::new`].
    pub fn resume(mut problem: P, options: Options, state: State) -> Result<Self, SetupError> {
        options.check()?;
        let n = problem.dimension();
        let stride = n.next_multiple_of(LANES);
        check_state(&state, &problem, options.switches_of(&problem))?;
        let scales = problem.scales();
        if scales.len() != n {
            return Err(SetupError::Dimension {
                what: "error scales",
                expected: n,
                found: scales.len(),
            });
        }
        if let Some((index, &value)) = scales.iter().enumerate().find(|(_, s)| s.is_nan() || **s <= 0.0) {
            return Err(SetupError::Scale { index, value });
        }
        if n > 0 && options.fixed_step.is_none() && scales.iter().all(|scale| scale.is_infinite()) {
            return Err(SetupError::NothingControlled);
        }
        let zero = || vec![0.0; stride];
        let mut weights = zero();
        for (weight, scale) in weights.iter_mut().zip(scales) {
            *weight = 1.0 / (options.relative_tolerance * scale);
        }
        for (weight, bound) in weights.iter_mut().zip(problem.error_bounds()) {
            *weight = weight.max(1.0 / bound);
        }
        let mut layer_weights = zero();
        for (weight, bound) in layer_weights.iter_mut().zip(problem.layer_bounds()) {
            *weight = 1.0 / bound;
        }
        let segment_end = enter(&mut problem, &state)?;
        let tableau = options.method.tableau();
        let linearly_implicit = tableau.family == Family::LinearlyImplicit;
        let extends: Vec<bool> = (0..tableau.stages())
            .map(|i| {
                linearly_implicit
                    && i > 1
                    && tableau.a[i][..i - 1] == *tableau.a[i - 1]
                    && tableau.a[i][i - 1] == 1.0
            })
            .collect();
        let whole = extends.iter().rposition(|extends| !extends).unwrap_or(0);
        let leading = leading_states(&problem);
        let widths = (0..tableau.stages())
            .map(|i| if i < whole { leading } else { stride })
            .collect();
        let mut x = zero();
        x[..n].copy_from_slice(&state.x);
        let all_stages = vec![0.0; stride * MAXIMUM_STAGES];
        let newton = match tableau.family {
            Family::DiagonallyImplicit => Newton::new(&problem, options.relative_tolerance, stride),
            _ => Newton::default(),
        };
        let mut this = Self {
            switches: Switches::new(&problem, state.modes, options.maximum_events),
            kinks: Kinks::new(&problem),
            problem,
            options,
            tableau,
            last_method: tableau,
            trial_method: tableau,
            stiffness: f64::INFINITY,
            extends,
            widths,
            dimension: n,
            stride,
            plain_weights: weights.clone(),
            layer_weights,
            weights,
            time: state.time,
            previous_time: state.time,
            segment_start: state.segment_start,
            segment_end,
            proposed_step: state.proposed_step,
            ahead: state.ahead,
            passage: state.passage,
            controller: state.controller,
            statistics: state.statistics,
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
            slope: zero(),
            newton,
            between: Between::new(stride),
            reach: state.reach,
        };
        // Not counted: a run without a break has this evaluation from its last step.
        let counted = this.statistics.derivatives;
        this.evaluate_derivative();
        this.statistics.derivatives = counted;
        if let Some(index) = this.first_not_finite() {
            let value = this.dx[index];
            return Err(SetupError::NotFiniteDerivative {
                time: this.time,
                index,
                value,
            });
        }
        this.continue_stages(&state.slope, state.behind.as_ref(), state.matrix.as_ref());
        Ok(this)
    }

    /// All that is needed to continue with the same bits.
    #[must_use]
    pub fn state(&self) -> State {
        State {
            version: STATE_VERSION,
            time: self.time,
            x: self.x().to_vec(),
            modes: self.switches.modes.clone(),
            segment_start: self.segment_start,
            proposed_step: self.proposed_step,
            ahead: self.ahead,
            passage: self.passage,
            controller: self.controller.clone(),
            reach: self.reach,
            slope: match self.tableau.family {
                Family::DiagonallyImplicit => self.derivative().to_vec(),
                _ => Vec::new(),
            },
            behind: self.newton.behind(self.dimension),
            matrix: self.place_of_matrix(),
            statistics: self.statistics.clone(),
        }
    }

    /// Time reached.
    #[must_use]
    pub fn time(&self) -> f64 {
        self.time
    }

    /// Time at the start of the last step.
    #[must_use]
    pub fn previous_time(&self) -> f64 {
        self.previous_time
    }

    /// States reached.
    #[must_use]
    pub fn x(&self) -> &[f64] {
        &self.x[..self.dimension]
    }

    /// States at the start of the last step.
    #[must_use]
    pub fn previous_x(&self) -> &[f64] {
        &self.previous_x[..self.dimension]
    }

    /// Derivative of the states reached. (At the end of a segment: the limit from before it.)
    #[must_use]
    pub fn derivative(&self) -> &[f64] {
        &self.dx[..self.dimension]
    }

    /// Length that the next step is going to try.
    #[must_use]
    pub fn proposed_step(&self) -> f64 {
        self.proposed_step
    }

    /// The problem.
    #[must_use]
    pub fn problem(&self) -> &P {
        &self.problem
    }

    /// The problem; a change of its right-hand side must be followed by [`Integrator::refresh`].
    pub fn problem_mut(&mut self) -> &mut P {
        &mut self.problem
    }

    /// The problem, at the end.
    #[must_use]
    pub fn into_problem(self) -> P {
        self.problem
    }

    /// The options.
    #[must_use]
    pub fn options(&self) -> &Options {
        &self.options
    }

    /// What was done so far.
    #[must_use]
    pub fn statistics(&self) -> &Statistics {
        &self.statistics
    }

    /// Changes of modes in the last step, in order of time.
    #[must_use]
    pub fn events(&self) -> &[Event] {
        &self.switches.events
    }

    /// Modes of the switches at the time reached.
    #[must_use]
    pub fn modes(&self) -> &[u8] {
        &self.switches.modes
    }

    /// Modes of the switches at the start of the last step.
    #[must_use]
    pub fn modes_before_step(&self) -> &[u8] {
        &self.switches.before
    }

    /// Tells the integrator that the right-hand side has changed, but not by a jump: it is evaluated anew, the memory of the step-size
    /// control is kept. So a motion that a caller continues piece by piece costs no restart.
    pub fn renew(&mut self) {
        self.evaluate_derivative();
        self.ahead = None;
        self.passage = None;
    }

    /// Whether a saved state can belong to this problem.
    ///
    /// # Errors
    /// The state does not fit to this program or to the problem.
    pub fn admits(&self, state: &State) -> Result<(), SetupError> {
        check_state(state, &self.problem, self.switches.modes.len())
    }

    /// Goes back to a saved state of the same problem and options, with the same bits as [`Integrator::resume`], in the memory that is
    /// there. The last step is forgotten: nothing can be interpolated.
    ///
    /// # Errors
    /// The state does not fit to this program or to the problem; nothing has changed then.
    pub fn restore(&mut self, state: &State) -> Result<(), SetupError> {
        self.admits(state)?;
        let segment_end = enter(&mut self.problem, state)?;
        let n = self.dimension;
        self.x[..n].copy_from_slice(&state.x);
        self.previous_x.copy_from_slice(&self.x);
        self.switches.modes.copy_from_slice(&state.modes);
        self.switches.before.copy_from_slice(&state.modes);
        self.switches.events.clear();
        (self.time, self.previous_time) = (state.time, state.time);
        (self.segment_start, self.segment_end) = (state.segment_start, segment_end);
        self.proposed_step = state.proposed_step;
        self.ahead = state.ahead;
        self.passage = state.passage;
        self.controller.clone_from(&state.controller);
        self.reach = state.reach;
        self.statistics.clone_from(&state.statistics);
        let counted = self.statistics.derivatives;
        self.evaluate_derivative();
        self.statistics.derivatives = counted;
        self.continue_stages(&state.slope, state.behind.as_ref(), state.matrix.as_ref());
        Ok(())
    }

    /// Takes the slope with which the last step ended, that step, and the matrix that there was.
    fn continue_stages(&mut self, slope: &[f64], behind: Option<&Behind>, matrix: Option<&Place>) {
        if self.tableau.family == Family::DiagonallyImplicit {
            for (dx, slope) in self.dx.iter_mut().zip(slope) {
                *dx = *slope;
            }
            self.form_matrix_again(matrix);
            self.newton.restore_behind(behind);
        }
    }

    /// Tells the integrator that the right-hand side has changed: it is evaluated anew, and the memory of the
    /// step-size control is dropped.
    pub fn refresh(&mut self) {
        self.evaluate_derivative();
        self.ahead = None;
        self.passage = None;
        self.controller.restart();
    }
}

/// Whether a state can belong to a problem, of which so many switches are recorded.
fn check_state<P: Problem>(state: &State, problem: &P, switches: usize) -> Result<(), SetupError> {
    if !state.time.is_finite() {
        return Err(SetupError::Time(state.time));
    }
    let (_, directions) = problem.kink_counts();
    state.check(problem.dimension(), switches, directions)?;
    match state.x.iter().enumerate().find(|(_, v)| !v.is_finite()) {
        Some((index, &value)) => Err(SetupError::NotFiniteState { index, value }),
        None => Ok(()),
    }
}

/// Brings a problem to the smooth piece in which a state lies; the end of the piece.
fn enter<P: Problem>(problem: &mut P, state: &State) -> Result<f64, SetupError> {
    let end = problem.segment(state.segment_start);
    if end.is_nan() || end <= state.segment_start || end < state.time {
        return Err(SetupError::Segment {
            start: state.segment_start,
            end,
        });
    }
    Ok(end)
}
