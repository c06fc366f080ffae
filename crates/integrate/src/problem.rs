//! The functions of a problem that an integrator needs.

use crate::discontinuity::DiscontinuityFunctions;
use crate::event::EventGroup;
use numerics::Singular;
use numerics::lanes::LANES;

/// Numbers of states and functions of a problem, its error scales and bounds.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ProblemStructure {
    /// Error scale of each state, positive; infinite: the error of the state is not controlled.
    ///
    /// The norm of an error is `max |error_i| / (relative_tolerance · scale_i)`. It holds the tolerance in
    /// every state, however many other states are at rest.
    pub scales: Vec<f64>,
    /// Number of leading states on which anything depends. The states after them are quadratures: the
    /// integrator integrates them, but no function of the problem reads them, and they may hold anything.
    pub dynamic_states: usize,
    /// Number of leading states that are displacements: the rate of each is another state, or as smooth as
    /// one. ESDIRK methods, which damp fast vibrations instead of following them, control the error of these
    /// alone.
    pub displacements: usize,
    /// Upper bound of the admissible error of each state, whatever the tolerance; empty: no bounds. For
    /// problems that a larger error would change in kind.
    pub error_bounds: Vec<f64>,
    /// Upper bound of the admissible error of each state while a slip of [`Problem::discontinuities`] is in
    /// its regularization zone; empty: no bounds. If the smallest slip has the size s > 20 the bounds are
    /// s/20 times as wide.
    ///
    /// For speeds under regularized friction: an error as large as the reference speed makes a sticking
    /// contact slide to and fro, but hardly changes the force on one that slides a thousand times as fast.
    pub zone_error_bounds: Vec<f64>,
    /// Number of values that [`Problem::discontinuities`] writes.
    pub discontinuity_values: usize,
    /// Number of slips that [`Problem::discontinuities`] writes.
    pub slips: usize,
    /// True if [`Problem::discontinuities`] covers all discontinuities of f. Newton's method then uses a
    /// Jacobian matrix again in other stages and steps, as long as the contact state is the same.
    pub discontinuities_complete: bool,
    /// Groups of discrete states that do not depend on each other: all discrete states and event variables in
    /// their order, each in one group; empty: there are no discrete states. Events are located group by
    /// group, which for many groups costs much less than for one group of all.
    pub event_groups: Vec<EventGroup>,
}

impl ProblemStructure {
    /// Returns the structure of a problem with these error scales, one for each state. All states are
    /// dynamic and displacements; there are no bounds, discontinuity functions and discrete states.
    #[must_use]
    pub fn new(scales: Vec<f64>) -> Self {
        let states = scales.len();
        Self {
            scales,
            dynamic_states: states,
            displacements: states,
            ..Self::default()
        }
    }

    /// Returns the number of states.
    #[must_use]
    pub fn dimension(&self) -> usize {
        self.scales.len()
    }

    /// Returns the number of discrete states.
    #[must_use]
    pub fn discrete_states(&self) -> usize {
        self.event_groups
            .last()
            .map_or(0, |group| group.discrete_states.end)
    }

    /// Returns the number of event variables.
    #[must_use]
    pub fn event_variables(&self) -> usize {
        self.event_groups.last().map_or(0, |group| group.variables.end)
    }

    /// Returns the length of the part of a padded vector that holds the dynamic states.
    pub(crate) fn padded_dynamic_states(&self) -> usize {
        self.dynamic_states.min(self.dimension()).next_multiple_of(LANES)
    }
}

/// A stiff initial value problem `x' = f(t, x)` that brings its own structured linear algebra.
///
/// The right-hand side f is piecewise smooth. Five functions are required. The others have defaults and
/// serve: jumps in time ([`Problem::next_time_discontinuity`]), Newton's method
/// ([`Problem::linearize_for_newton`]), explicit steps ([`Problem::spectral_radius_bound`]), prediction of
/// discontinuities ([`Problem::discontinuities`]), and discrete states with their events
/// ([`Problem::initial_discrete_states`] and after). [`crate::FunctionProblem`] makes a problem from
/// closures.
///
/// All functions are pure: with the same arguments (since the same call of
/// [`Problem::next_time_discontinuity`]) they return the same bits. They take `&mut self` so that they can
/// use scratch memory without allocation.
pub trait Problem {
    /// Returns the numbers of states and functions, and the scales of errors. The integrator asks once, when
    /// it starts.
    fn structure(&self) -> ProblemStructure;

    /// Writes `f(time, x)` to `dx`.
    ///
    /// In an attempt that is going to be rejected `x` may be far off or not finite; `dx` may then be so, too.
    fn derivative(&mut self, time: f64, x: &[f64], dx: &mut [f64]);

    /// Evaluates and stores the Jacobian matrix `J = ∂f/∂x` at `(time, x)`, where f is `dx`; writes `∂f/∂t`.
    ///
    /// `df_dt` is filled with zeros before: an autonomous problem need not write it.
    fn linearize(&mut self, time: f64, x: &[f64], dx: &[f64], df_dt: &mut [f64]);

    /// Factors `shift·I - J`.
    ///
    /// # Errors
    /// If the matrix is singular; the integrator tries again with a shorter step, that is, a larger shift.
    fn factor(&mut self, shift: f64) -> Result<(), Singular>;

    /// Solves `(shift·I - J) y = b` in place, with the factors of the last successful [`Problem::factor`].
    fn solve(&mut self, b: &mut [f64]);

    /// Evaluates and stores an approximation of J that suffices for Newton's method: small terms may be
    /// missing. `scratch` has the length of `dx`; its content is not used.
    fn linearize_for_newton(&mut self, time: f64, x: &[f64], dx: &[f64], scratch: &mut [f64]) {
        scratch.fill(0.0);
        self.linearize(time, x, dx, scratch);
    }

    /// Solves the equations of an implicit stage for some states alone, the others being as they are: writes
    /// `z = base_z + f_z(time, x)/shift` into `x` for states z whose rates depend on no other z. Newton's
    /// method calls it before each derivative; it then needs fewer corrections where these states switch
    /// (nonlinear elimination: P. Lanzkron, D. Rose, J. Wilkes, SIAM J. Sci. Comput. 17 (1996) 538).
    fn settle(&mut self, time: f64, shift: f64, base: &[f64], x: &mut [f64]) {
        let _ = (time, shift, base, x);
    }

    /// Starts the smooth interval of the explicit time dependence that begins at `start`; returns its end,
    /// the first time after `start` at which f or a derivative of f jumps in time (infinite: there is none).
    ///
    /// A step ends exactly there. When the next step begins, the integrator calls this again and restarts the
    /// step-size controller; the states are continuous. Until that call f at the end itself is the limit from
    /// before it.
    fn next_time_discontinuity(&mut self, start: f64) -> f64 {
        let _ = start;
        f64::INFINITY
    }

    /// Returns an upper bound of the spectral radius of ∂f/∂x at `(time, x)`, 1/s. It need not be sharp.
    /// Returns infinity if unknown.
    ///
    /// With it, Rosenbrock methods make short steps by an explicit method of order 5(4), which needs no
    /// Jacobian.
    fn spectral_radius_bound(&mut self, time: f64, x: &[f64]) -> f64 {
        let _ = (time, x);
        f64::INFINITY
    }

    /// Writes the functions from which discontinuities of f are predicted. Rosenbrock methods end a step
    /// where the first one is expected, instead of being rejected across it.
    fn discontinuities(&mut self, time: f64, x: &[f64], functions: &mut DiscontinuityFunctions) {
        let _ = (time, x, functions);
    }

    /// Writes the discrete states at the start of the integration. (A contact point that is open, sticking or
    /// slipping has one. They are recorded with the times of their changes, and do not change f.)
    fn initial_discrete_states(&mut self, time: f64, x: &[f64], discrete_states: &mut [u8]) {
        let _ = (time, x, discrete_states);
    }

    /// Writes the event variables of one group, or of all groups (none), at `(time, x)`: what event functions
    /// are computed from (gaps and loads of contacts, say). They are continuous in time and do not depend on
    /// discrete states. Of one group only the states that it names are valid in `x`, and the bits are the
    /// same.
    fn event_variables(&mut self, group: Option<usize>, time: f64, x: &[f64], variables: &mut [f64]) {
        let _ = (group, time, x, variables);
    }

    /// Writes the event function of each discrete state of a group: positive while the state lasts, zero or
    /// negative if it must change. `variables` and `discrete_states` are those of the group. Event functions
    /// are continuous in the variables.
    fn event_functions(
        &mut self,
        group: usize,
        variables: &[f64],
        discrete_states: &[u8],
        functions: &mut [f64],
    ) {
        let _ = (group, variables, discrete_states, functions);
    }

    /// Returns the successor of discrete state `index` of a group, whose event function has fallen to zero or
    /// below.
    ///
    /// If it returns `state` there is no event, and the discrete state is not checked again in this step.
    fn next_discrete_state(&mut self, group: usize, variables: &[f64], index: usize, state: u8) -> u8 {
        let _ = (group, variables, index);
        state
    }
}
