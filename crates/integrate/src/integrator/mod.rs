//! The integrator: one type, whose functions are in the files of this folder.
//!
//! | file | what |
//! |---|---|
//! | `mod.rs` | the type, access to its members |
//! | `start.rs` | start, save, resume and restore; the first step |
//! | `step.rs` | a step: planning, error test, acceptance, rejection |
//! | `attempt.rs` | what attempts of all methods share |
//! | `rosenbrock.rs`, `explicit.rs`, `esdirk.rs` | an attempt by a Rosenbrock, explicit or ESDIRK method |
//! | `interpolation.rs` | dense output and its correction |
//! | `memory.rs` | plain data |

use crate::controller::Controller;
use crate::discontinuity::Prediction;
use crate::discontinuity_prediction::DiscontinuityPredictor;
use crate::event::Event;
use crate::event_detection::EventDetector;
use crate::methods::tableau::Tableau;
use crate::newton::Newton;
use crate::options::Options;
use crate::problem::{Problem, ProblemStructure};
use crate::statistics::Statistics;

mod attempt;
mod esdirk;
mod explicit;
mod interpolation;
mod memory;
mod rosenbrock;
mod start;
mod step;
mod worst;

use memory::{Attempt, DenseCorrection};

/// Integrates a [`Problem`] step by step.
///
/// ```
/// use integrate::{FunctionProblem, Integrator, Options};
/// // x' = -1000 (x - cos t)
/// let problem = FunctionProblem::new(
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
    structure: ProblemStructure,
    options: Options,
    tableau: &'static Tableau,
    /// Methods of the last accepted step, and of the current attempt.
    last_method: &'static Tableau,
    trial_method: &'static Tableau,
    /// Bound of the spectral radius at the state reached, 1/s; infinite where it is not needed.
    spectral_radius: f64,
    dimension: usize,
    /// Length of a padded vector.
    stride: usize,
    /// Reciprocals of the admissible error: relative_tolerance · scale, or the problem's bounds.
    weights: Vec<f64>,
    /// The same without the bounds in regularization zones.
    plain_weights: Vec<f64>,
    /// Reciprocals of the bounds in regularization zones; zero: none.
    zone_weights: Vec<f64>,

    time: f64,
    previous_time: f64,
    /// Smooth interval of the explicit time dependence.
    interval_start: f64,
    interval_end: f64,
    proposed_step: f64,
    prediction: Option<Prediction>,
    predictor: DiscontinuityPredictor,
    controller: Controller,
    statistics: Statistics,
    events: EventDetector,

    x: Vec<f64>,
    previous_x: Vec<f64>,
    /// The derivative at `(time, x)`.
    dx: Vec<f64>,
    df_dt: Vec<f64>,
    autonomous: bool,
    /// True if the problem holds the Jacobian matrix at `(time, x)`.
    linearized: bool,
    /// Stages of the last accepted step.
    stages: Vec<f64>,

    // The current attempt.
    attempt: Attempt,
    trial_stages: Vec<f64>,
    trial_x: Vec<f64>,
    trial_dx: Vec<f64>,
    /// Argument of the current stage, and the derivative there.
    argument: Vec<f64>,
    stage_derivative: Vec<f64>,
    newton: Newton,
    correction: DenseCorrection,
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
    /// Returns the time reached.
    #[must_use]
    pub fn time(&self) -> f64 {
        self.time
    }

    /// Returns the time at the start of the last step.
    #[must_use]
    pub fn previous_time(&self) -> f64 {
        self.previous_time
    }

    /// Returns the states reached.
    #[must_use]
    pub fn x(&self) -> &[f64] {
        &self.x[..self.dimension]
    }

    /// Returns the states at the start of the last step.
    #[must_use]
    pub fn previous_x(&self) -> &[f64] {
        &self.previous_x[..self.dimension]
    }

    /// Returns the derivative of the states reached. At a time discontinuity it is the limit from before.
    #[must_use]
    pub fn derivative(&self) -> &[f64] {
        &self.dx[..self.dimension]
    }

    /// Returns the length of the next attempt.
    #[must_use]
    pub fn proposed_step(&self) -> f64 {
        self.proposed_step
    }

    /// Returns the problem.
    #[must_use]
    pub fn problem(&self) -> &P {
        &self.problem
    }

    /// Returns the problem. After a change of its right-hand side call [`Integrator::restart`] or
    /// [`Integrator::reevaluate`].
    pub fn problem_mut(&mut self) -> &mut P {
        &mut self.problem
    }

    /// Returns the options.
    #[must_use]
    pub fn options(&self) -> &Options {
        &self.options
    }

    /// Returns the counters.
    #[must_use]
    pub fn statistics(&self) -> &Statistics {
        &self.statistics
    }

    /// Returns the events of the last step in order of time.
    #[must_use]
    pub fn events(&self) -> &[Event] {
        &self.events.events
    }

    /// Returns the discrete states at the time reached.
    #[must_use]
    pub fn discrete_states(&self) -> &[u8] {
        &self.events.discrete_states
    }

    /// Returns the discrete states at the start of the last step.
    #[must_use]
    pub fn discrete_states_before_step(&self) -> &[u8] {
        &self.events.before
    }
}
