//! What an integrator needs to know about a problem.

use crate::discontinuity::DiscontinuityFunctions;
use crate::error::Singular;
use crate::event::EventGroup;
use crate::lanes::LANES;

/// A stiff initial value problem `x' = f(t, x)` that brings its own structured linear algebra.
///
/// The right-hand side f is piecewise smooth. Six functions are required. The others have defaults and serve:
/// quadratures and error norms ([`Problem::dynamic_states`] to [`Problem::zone_error_bounds`]), jumps in time
/// ([`Problem::next_time_discontinuity`]), explicit steps ([`Problem::spectral_radius_bound`]), prediction of
/// discontinuities ([`Problem::discontinuities`]), and discrete states with their events
/// ([`Problem::discrete_state_count`] and after). [`crate::FunctionProblem`] makes a problem from closures.
///
/// All functions are pure: with the same arguments (since the same call of
/// [`Problem::next_time_discontinuity`]) they return the same bits. They take `&mut self` so that they can
/// use scratch memory without allocation.
pub trait Problem {
    /// Returns the number of states.
    fn dimension(&self) -> usize;

    /// Returns the number of leading states on which anything depends. The states after them are quadratures:
    /// the integrator integrates them, but no function of the problem reads them, and they may hold anything.
    fn dynamic_states(&self) -> usize {
        self.dimension()
    }

    /// Returns the number of leading states that are displacements: the rate of each is another state, or
    /// as smooth as one.
    ///
    /// ESDIRK methods, which damp fast vibrations instead of following them, control the error of these
    /// alone.
    fn displacements(&self) -> usize {
        self.dynamic_states()
    }

    /// Returns the error scale of each state, positive; infinite: the error of the state is not controlled.
    ///
    /// The norm of an error is `max |error_i| / (relative_tolerance · scale_i)`. It holds the tolerance in
    /// every state, however many other states are at rest. The integrator reads the scales once, when it
    /// starts.
    fn scales(&self) -> &[f64];

    /// Returns an upper bound of the admissible error of each state, whatever the tolerance; empty: no
    /// bounds.
    ///
    /// For problems that a larger error would change in kind.
    fn error_bounds(&self) -> &[f64] {
        &[]
    }

    /// Returns an upper bound of the admissible error of each state while a slip of
    /// [`Problem::discontinuities`] is in its regularization zone; empty: no bounds. If the smallest slip has
    /// the size s > 20 the bounds are s/20 times as wide.
    ///
    /// For speeds under regularized friction: an error as large as the reference speed makes a sticking
    /// contact slide to and fro, but hardly changes the force on one that slides a thousand times as fast.
    fn zone_error_bounds(&self) -> &[f64] {
        &[]
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

    /// Writes `f(time, x)` to `dx`.
    ///
    /// In an attempt that is going to be rejected `x` may be far off or not finite; `dx` may then be so, too.
    fn derivative(&mut self, time: f64, x: &[f64], dx: &mut [f64]);

    /// Evaluates and stores the Jacobian matrix `J = ∂f/∂x` at `(time, x)`, where f is `dx`; writes `∂f/∂t`.
    ///
    /// `df_dt` is filled with zeros before: an autonomous problem need not write it.
    fn linearize(&mut self, time: f64, x: &[f64], dx: &[f64], df_dt: &mut [f64]);

    /// Evaluates and stores an approximation of J that suffices for Newton's method: small terms may be
    /// missing. `scratch` has the length of `dx`; its content is not used.
    fn linearize_for_newton(&mut self, time: f64, x: &[f64], dx: &[f64], scratch: &mut [f64]) {
        scratch.fill(0.0);
        self.linearize(time, x, dx, scratch);
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

    /// Factors `shift·I - J`.
    ///
    /// # Errors
    /// If the matrix is singular; the integrator tries again with a shorter step, that is, a larger shift.
    fn factor(&mut self, shift: f64) -> Result<(), Singular>;

    /// Solves `(shift·I - J) y = b` in place, with the factors of the last successful [`Problem::factor`].
    fn solve(&mut self, b: &mut [f64]);

    /// Returns the numbers of values and of slips that [`Problem::discontinuities`] writes.
    fn discontinuity_counts(&self) -> (usize, usize) {
        (0, 0)
    }

    /// Writes the functions from which discontinuities of f are predicted. Rosenbrock methods end a step
    /// where the first one is expected, instead of being rejected across it.
    fn discontinuities(&mut self, time: f64, x: &[f64], functions: &mut DiscontinuityFunctions) {
        let _ = (time, x, functions);
    }

    /// Returns whether [`Problem::discontinuities`] covers all discontinuities of f. Newton's method then
    /// uses a Jacobian matrix again in other stages and steps, as long as the contact state is the same.
    fn discontinuities_complete(&self) -> bool {
        false
    }

    /// Returns the number of discrete states (a contact point that is open, sticking or slipping has one).
    /// They are recorded with the times of their changes, and do not change f.
    fn discrete_state_count(&self) -> usize {
        0
    }

    /// Writes the discrete states at the start of the integration.
    fn initial_discrete_states(&mut self, time: f64, x: &[f64], discrete_states: &mut [u8]) {
        let _ = (time, x, discrete_states);
    }

    /// Returns the number of event variables.
    fn event_variable_count(&self) -> usize {
        0
    }

    /// Writes the event variables at `(time, x)`, from which event functions are computed (gaps and loads of
    /// contacts, say). They are continuous in time and do not depend on discrete states.
    fn event_variables(&mut self, time: f64, x: &[f64], variables: &mut [f64]) {
        let _ = (time, x, variables);
    }

    /// Returns groups of discrete states that do not depend on each other: all discrete states and event
    /// variables in their order, each in one group. Events are located group by group, which for many groups
    /// costs much less. By default all are one group.
    fn event_groups(&self) -> Vec<EventGroup> {
        let all = EventGroup {
            discrete_states: 0..self.discrete_state_count(),
            variables: 0..self.event_variable_count(),
            states: std::iter::once(0..self.dynamic_states()).collect(),
        };
        vec![all]
    }

    /// Writes the event variables of one group, with the same bits as [`Problem::event_variables`]; of `x`
    /// only the states of this group are valid.
    fn group_event_variables(&mut self, group: usize, time: f64, x: &[f64], variables: &mut [f64]) {
        let _ = group;
        self.event_variables(time, x, variables);
    }

    /// Writes the event function of each discrete state of a group: positive while the state lasts, zero or
    /// negative if it must change. `variables` and `discrete_states` are those of the group. Event functions
    /// are continuous in the variables.
    fn group_event_functions(
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

/// Returns the length of the part of a padded vector that holds the dynamic states.
pub(crate) fn padded_dynamic_states<P: Problem>(problem: &P) -> usize {
    problem
        .dynamic_states()
        .min(problem.dimension())
        .next_multiple_of(LANES)
}

impl<P: Problem + ?Sized> Problem for &mut P {
    fn dimension(&self) -> usize {
        (**self).dimension()
    }
    fn dynamic_states(&self) -> usize {
        (**self).dynamic_states()
    }
    fn displacements(&self) -> usize {
        (**self).displacements()
    }
    fn scales(&self) -> &[f64] {
        (**self).scales()
    }
    fn error_bounds(&self) -> &[f64] {
        (**self).error_bounds()
    }
    fn zone_error_bounds(&self) -> &[f64] {
        (**self).zone_error_bounds()
    }
    fn next_time_discontinuity(&mut self, start: f64) -> f64 {
        (**self).next_time_discontinuity(start)
    }
    fn derivative(&mut self, time: f64, x: &[f64], dx: &mut [f64]) {
        (**self).derivative(time, x, dx);
    }
    fn linearize(&mut self, time: f64, x: &[f64], dx: &[f64], df_dt: &mut [f64]) {
        (**self).linearize(time, x, dx, df_dt);
    }
    fn linearize_for_newton(&mut self, time: f64, x: &[f64], dx: &[f64], scratch: &mut [f64]) {
        (**self).linearize_for_newton(time, x, dx, scratch);
    }
    fn spectral_radius_bound(&mut self, time: f64, x: &[f64]) -> f64 {
        (**self).spectral_radius_bound(time, x)
    }
    fn factor(&mut self, shift: f64) -> Result<(), Singular> {
        (**self).factor(shift)
    }
    fn solve(&mut self, b: &mut [f64]) {
        (**self).solve(b);
    }
    fn discontinuity_counts(&self) -> (usize, usize) {
        (**self).discontinuity_counts()
    }
    fn discontinuities(&mut self, time: f64, x: &[f64], functions: &mut DiscontinuityFunctions) {
        (**self).discontinuities(time, x, functions);
    }
    fn discontinuities_complete(&self) -> bool {
        (**self).discontinuities_complete()
    }
    fn discrete_state_count(&self) -> usize {
        (**self).discrete_state_count()
    }
    fn initial_discrete_states(&mut self, time: f64, x: &[f64], discrete_states: &mut [u8]) {
        (**self).initial_discrete_states(time, x, discrete_states);
    }
    fn event_variable_count(&self) -> usize {
        (**self).event_variable_count()
    }
    fn event_variables(&mut self, time: f64, x: &[f64], variables: &mut [f64]) {
        (**self).event_variables(time, x, variables);
    }
    fn event_groups(&self) -> Vec<EventGroup> {
        (**self).event_groups()
    }
    fn group_event_variables(&mut self, group: usize, time: f64, x: &[f64], variables: &mut [f64]) {
        (**self).group_event_variables(group, time, x, variables);
    }
    fn group_event_functions(
        &mut self,
        group: usize,
        variables: &[f64],
        discrete_states: &[u8],
        functions: &mut [f64],
    ) {
        (**self).group_event_functions(group, variables, discrete_states, functions);
    }
    fn next_discrete_state(&mut self, group: usize, variables: &[f64], index: usize, state: u8) -> u8 {
        (**self).next_discrete_state(group, variables, index, state)
    }
}
