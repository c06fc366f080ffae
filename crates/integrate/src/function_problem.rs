//! Problems made of functions.

use crate::discontinuity::DiscontinuityFunctions;
use crate::event::EventGroup;
use crate::problem::{Problem, ProblemStructure};
use numerics::BlockLu;
use numerics::Singular;

type VectorFunction<'a> = Box<dyn FnMut(f64, &[f64], &mut [f64]) + Send + 'a>;
type ScalarFunction<'a> = Box<dyn FnMut(f64, &[f64]) -> f64 + Send + 'a>;
type Discontinuities<'a> = Box<dyn FnMut(f64, &[f64], &mut DiscontinuityFunctions) + Send + 'a>;
type InitialStates<'a> = Box<dyn FnMut(f64, &[f64], &mut [u8]) + Send + 'a>;
type EventFunctions<'a> = Box<dyn FnMut(f64, &[f64], &[u8], &mut [f64]) + Send + 'a>;
type NextState<'a> = Box<dyn FnMut(f64, &[f64], usize, u8) -> u8 + Send + 'a>;

/// Discrete states made of functions.
struct Events<'a> {
    initial: InitialStates<'a>,
    functions: EventFunctions<'a>,
    next: NextState<'a>,
}

/// A [`Problem`] made of functions, with a dense Jacobian matrix.
///
/// ```
/// use integrate::{FunctionProblem, Integrator, Options};
/// // Harmonic oscillator; its discrete state is the sign of the position.
/// let problem = FunctionProblem::new(
///     vec![1.0; 2],
///     |_, x, dx| {
///         dx[0] = x[1];
///         dx[1] = -x[0];
///     },
///     |_, _, jacobian| jacobian.copy_from_slice(&[0.0, 1.0, -1.0, 0.0]),
/// )
/// .events(
///     1,
///     |_, x, states| states[0] = u8::from(x[0] < 0.0),
///     |_, x, states, functions| functions[0] = if states[0] == 0 { x[0] + 1e-9 } else { 1e-9 - x[0] },
///     |_, _, _, state| 1 - state,
/// );
/// let mut integrator = Integrator::new(problem, Options::default(), 0.0, &[1.0, 0.0])?;
/// while integrator.events().is_empty() {
///     integrator.step_to(f64::INFINITY)?;
/// }
/// assert!((integrator.events()[0].time - std::f64::consts::FRAC_PI_2).abs() < 1e-5);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub struct FunctionProblem<'a> {
    structure: ProblemStructure,
    derivative: VectorFunction<'a>,
    jacobian: VectorFunction<'a>,
    time_derivative: Option<VectorFunction<'a>>,
    events: Option<Events<'a>>,
    spectral_radius_bound: Option<ScalarFunction<'a>>,
    discontinuities: Option<Discontinuities<'a>>,
    /// In ascending order.
    time_discontinuities: Vec<f64>,
    matrix: BlockLu,
}

impl std::fmt::Debug for FunctionProblem<'_> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("FunctionProblem")
            .field("structure", &self.structure)
            .finish_non_exhaustive()
    }
}

impl<'a> FunctionProblem<'a> {
    /// Returns a problem with as many states as there are error scales. `derivative(t, x, dx)` writes the
    /// right-hand side, `jacobian(t, x, matrix)` its partial derivatives row by row (the matrix is filled
    /// with zeros before).
    pub fn new(
        scales: Vec<f64>,
        derivative: impl FnMut(f64, &[f64], &mut [f64]) + Send + 'a,
        jacobian: impl FnMut(f64, &[f64], &mut [f64]) + Send + 'a,
    ) -> Self {
        let matrix = BlockLu::new(&[scales.len()], &[]);
        Self {
            structure: ProblemStructure::new(scales),
            derivative: Box::new(derivative),
            jacobian: Box::new(jacobian),
            time_derivative: None,
            events: None,
            spectral_radius_bound: None,
            discontinuities: None,
            time_discontinuities: Vec::new(),
            matrix,
        }
    }

    /// Adds ∂f/∂t for a right-hand side that depends on time: `function(t, x, df_dt)` writes it.
    #[must_use]
    pub fn time_derivative(mut self, function: impl FnMut(f64, &[f64], &mut [f64]) + Send + 'a) -> Self {
        self.time_derivative = Some(Box::new(function));
        self
    }

    /// Adds the times at which f or a derivative of f jumps, see [`Problem::next_time_discontinuity`].
    #[must_use]
    pub fn time_discontinuities(mut self, mut times: Vec<f64>) -> Self {
        times.sort_by(f64::total_cmp);
        self.time_discontinuities = times;
        self
    }

    /// Adds the functions from which discontinuities are predicted, see [`Problem::discontinuities`]:
    /// `function(t, x, functions)` writes so many values and slips.
    #[must_use]
    pub fn discontinuities(
        mut self,
        values: usize,
        slips: usize,
        function: impl FnMut(f64, &[f64], &mut DiscontinuityFunctions) + Send + 'a,
    ) -> Self {
        (self.structure.discontinuity_values, self.structure.slips) = (values, slips);
        self.discontinuities = Some(Box::new(function));
        self
    }

    /// States that there are no other discontinuities, see [`ProblemStructure::discontinuities_complete`].
    #[must_use]
    pub fn discontinuities_complete(mut self) -> Self {
        self.structure.discontinuities_complete = true;
        self
    }

    /// Adds a bound of the spectral radius, 1/s, see [`Problem::spectral_radius_bound`].
    #[must_use]
    pub fn spectral_radius_bound(mut self, function: impl FnMut(f64, &[f64]) -> f64 + Send + 'a) -> Self {
        self.spectral_radius_bound = Some(Box::new(function));
        self
    }

    /// Sets the number of leading states that are displacements, see [`ProblemStructure::displacements`]; by
    /// default all are.
    #[must_use]
    pub fn displacements(mut self, count: usize) -> Self {
        self.structure.displacements = count;
        self
    }

    /// Adds error bounds in regularization zones, see [`ProblemStructure::zone_error_bounds`].
    #[must_use]
    pub fn zone_error_bounds(mut self, bounds: Vec<f64>) -> Self {
        self.structure.zone_error_bounds = bounds;
        self
    }

    /// Adds so many discrete states: `initial(t, x, states)` writes them at the start, `functions(t, x,
    /// states, functions)` their event functions, `next(t, x, index, state)` returns the successor of one.
    /// See [`Problem::event_functions`] and [`Problem::next_discrete_state`].
    #[must_use]
    pub fn events(
        mut self,
        count: usize,
        initial: impl FnMut(f64, &[f64], &mut [u8]) + Send + 'a,
        functions: impl FnMut(f64, &[f64], &[u8], &mut [f64]) + Send + 'a,
        next: impl FnMut(f64, &[f64], usize, u8) -> u8 + Send + 'a,
    ) -> Self {
        let states = self.structure.dimension();
        // The event variables are the time and all states.
        self.structure.event_groups = vec![EventGroup {
            discrete_states: 0..count,
            variables: 0..1 + states,
            states: std::iter::once(0..states).collect(),
        }];
        self.events = Some(Events {
            initial: Box::new(initial),
            functions: Box::new(functions),
            next: Box::new(next),
        });
        self
    }
}

impl Problem for FunctionProblem<'_> {
    fn structure(&self) -> ProblemStructure {
        self.structure.clone()
    }

    fn next_time_discontinuity(&mut self, start: f64) -> f64 {
        self.time_discontinuities
            .iter()
            .copied()
            .find(|time| *time > start)
            .unwrap_or(f64::INFINITY)
    }

    fn derivative(&mut self, time: f64, x: &[f64], dx: &mut [f64]) {
        (self.derivative)(time, x, dx);
    }

    fn linearize(&mut self, time: f64, x: &[f64], _dx: &[f64], df_dt: &mut [f64]) {
        self.matrix.clear();
        if let Some(block) = self.matrix.block_mut(0, 0) {
            (self.jacobian)(time, x, block);
        }
        if let Some(function) = &mut self.time_derivative {
            function(time, x, df_dt);
        }
    }

    fn spectral_radius_bound(&mut self, time: f64, x: &[f64]) -> f64 {
        match &mut self.spectral_radius_bound {
            Some(function) => function(time, x),
            None => f64::INFINITY,
        }
    }

    fn factor(&mut self, shift: f64) -> Result<(), Singular> {
        self.matrix.factor_shifted(shift)
    }

    fn solve(&mut self, b: &mut [f64]) {
        self.matrix.solve(b);
    }

    fn discontinuities(&mut self, time: f64, x: &[f64], functions: &mut DiscontinuityFunctions) {
        if let Some(function) = &mut self.discontinuities {
            function(time, x, functions);
        }
    }

    fn initial_discrete_states(&mut self, time: f64, x: &[f64], discrete_states: &mut [u8]) {
        if let Some(events) = &mut self.events {
            (events.initial)(time, x, discrete_states);
        }
    }

    fn event_variables(&mut self, _: Option<usize>, time: f64, x: &[f64], variables: &mut [f64]) {
        variables[0] = time;
        variables[1..].copy_from_slice(x);
    }

    fn event_functions(
        &mut self,
        _: usize,
        variables: &[f64],
        discrete_states: &[u8],
        functions: &mut [f64],
    ) {
        if let Some(events) = &mut self.events {
            (events.functions)(variables[0], &variables[1..], discrete_states, functions);
        }
    }

    fn next_discrete_state(&mut self, _: usize, variables: &[f64], index: usize, state: u8) -> u8 {
        match &mut self.events {
            Some(events) => (events.next)(variables[0], &variables[1..], index, state),
            None => state,
        }
    }
}
