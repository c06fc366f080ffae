//! What an integrator needs to know about a problem.

use crate::events::SwitchGroup;
use crate::kinks::KinkSigns;

/// The matrix of a linear system is singular.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("the matrix is singular in its diagonal block {block}")]
pub struct Singular {
    /// Number of the diagonal block without a usable pivot, in the caller's numbering.
    pub block: usize,
}

/// A smooth-but-kinked, stiff initial value problem `x' = f(t, x)` that brings its own structured linear algebra.
///
/// All functions must be pure: called again with the same arguments (in the same segment) they give the same bits.
/// Functions take `&mut self` so that they may use scratch memory without allocating.
pub trait Problem {
    /// Number of states.
    fn dimension(&self) -> usize;

    /// How many leading states [`Problem::derivative`], [`Problem::linearize`], [`Problem::kinks`] and the functions of switches
    /// read: the states behind them are quadratures, on which nothing depends.
    ///
    /// These functions still get a vector of all states, but those behind may hold anything.
    fn read_states(&self) -> usize {
        self.dimension()
    }

    /// How many leading states are displacements: the rate of each is another state, or smooth like one.
    ///
    /// A method that damps fast vibrations instead of following them ([`crate::Method::TrBdf2`], [`crate::Method::Esdirk3`]) holds the tolerance in these alone.
    fn displacements(&self) -> usize {
        self.read_states()
    }

    /// Fixed error scale of each state, positive; infinite: the state is not error controlled.
    ///
    /// The size of an error is the maximum norm `max |error_i| / (relative_tolerance · scale_i)`: the tolerance
    /// holds for every state, however many other states are at rest, and adding states does not loosen it.
    /// The integrator reads the scales once, when it starts.
    fn scales(&self) -> &[f64];

    /// The largest admissible error of each state, however wide the tolerance; empty: no bound.
    ///
    /// For problems that an error above some size would change in kind: friction that reverses within a small speed.
    fn error_bounds(&self) -> &[f64] {
        &[]
    }

    /// The largest admissible error of each state while one of the directions of [`Problem::kinks`] is in its layer, however wide the
    /// tolerance; empty: no bound. Where even the smallest direction is large the bound is a twentieth of it times as wide.
    ///
    /// For speeds under friction that reverses within a small speed: an error of that size makes what sticks slide to and fro, but
    /// it hardly turns the force on what slides a thousand times as fast.
    fn layer_bounds(&self) -> &[f64] {
        &[]
    }

    /// Tells the problem that integration proceeds from `start` on one smooth piece of its explicit time
    /// dependence; returns the end of this piece, later than `start` (infinite: there is none).
    ///
    /// The integrator steps exactly to the end, calls this again when the next step begins, and restarts there:
    /// the states are continuous, the memory of the step-size control is not. Until the next call the end
    /// itself belongs to the piece before it.
    fn segment(&mut self, start: f64) -> f64 {
        let _ = start;
        f64::INFINITY
    }

    /// Writes `f(time, x)` to `dx`.
    ///
    /// Within a step that is about to be rejected `x` may be far out or not finite; so may then be `dx`.
    fn derivative(&mut self, time: f64, x: &[f64], dx: &mut [f64]);

    /// Evaluates and keeps the Jacobian matrix `J = ∂f/∂x` at `(time, x)`, where `f` is `dx`; writes `∂f/∂t`.
    ///
    /// `df_dt` comes filled with zeros: an autonomous problem need not touch it.
    fn linearize(&mut self, time: f64, x: &[f64], dx: &[f64], df_dt: &mut [f64]);

    /// Evaluates and keeps a matrix that is near enough to `J` for Newton's method: small terms may be missing. `unused` has the
    /// length of `dx`; what is written there is lost.
    fn linearize_for_newton(&mut self, time: f64, x: &[f64], dx: &[f64], unused: &mut [f64]) {
        unused.fill(0.0);
        self.linearize(time, x, dx, unused);
    }

    /// How fast the fastest part of the problem answers near `(time, x)`, 1/s: a bound of the size of the eigenvalues of J, which need
    /// not be sharp; infinite: not known.
    ///
    /// Steps that are short beside it are made by an explicit method of order 5(4), which needs no Jacobian matrix.
    fn stiffness(&mut self, time: f64, x: &[f64]) -> f64 {
        let _ = (time, x);
        f64::INFINITY
    }

    /// Factors `shift·I - J`.
    ///
    /// # Errors
    /// Where the matrix is singular; the integrator tries again with a shorter step, that is, a larger shift.
    fn factor(&mut self, shift: f64) -> Result<(), Singular>;

    /// Solves `(shift·I - J) y = b` in place, with the matrix of the last successful [`Problem::factor`].
    fn solve(&mut self, b: &mut [f64]);

    /// How many values and directions [`Problem::kinks`] writes.
    fn kink_counts(&self) -> (usize, usize) {
        (0, 0)
    }

    /// Writes what tells kinks of `f` beforehand: a step is made to end where the first one is foreseen.
    fn kinks(&mut self, time: f64, x: &[f64], signs: &mut KinkSigns) {
        let _ = (time, x, signs);
    }

    /// Whether [`Problem::kinks`] tells all kinks there are, so that between them derivatives change little: Newton's method then keeps
    /// its matrix while it is on its piece.
    fn tells_pieces(&self) -> bool {
        false
    }

    /// Number of discrete switches (contact open, sticking, slipping, ...): modes with hysteresis that are recorded
    /// and timed. They do not change `f`.
    fn switch_count(&self) -> usize {
        0
    }

    /// Writes the modes at the very beginning.
    fn initial_modes(&mut self, time: f64, x: &[f64], modes: &mut [u8]) {
        let _ = (time, x, modes);
    }

    /// How many signs tell the margins and modes of all switches: gaps and loads of contacts, say.
    fn sign_count(&self) -> usize {
        0
    }

    /// Writes the signs of all switches at `(time, x)`. They must be continuous in time, and do not know of modes.
    fn signs(&mut self, time: f64, x: &[f64], signs: &mut [f64]) {
        let _ = (time, x, signs);
    }

    /// How switches that have nothing to do with each other fall into groups: all switches and signs in their order, each in one group.
    /// Changes are then searched in one group after the other, which for many groups costs much less. Without this all are one group.
    fn switch_groups(&self) -> Vec<SwitchGroup> {
        let all = SwitchGroup {
            switches: 0..self.switch_count(),
            signs: 0..self.sign_count(),
            states: std::iter::once(0..self.read_states()).collect(),
        };
        vec![all]
    }

    /// Writes the signs of one group, the same as [`Problem::signs`] does; of `x` only the states of this group are what they should be.
    fn group_signs(&mut self, group: usize, time: f64, x: &[f64], signs: &mut [f64]) {
        let _ = group;
        self.signs(time, x, signs);
    }

    /// Writes, by the signs of a group, a margin for each of its switches: positive while the switch stays in `modes[i]`, not positive when
    /// it must leave. Margins must be continuous in the signs.
    fn group_margins(&mut self, group: usize, signs: &[f64], modes: &[u8], margins: &mut [f64]) {
        let _ = (group, signs, modes, margins);
    }

    /// The mode to which switch `index` of a group goes from `mode` where, by these signs, its margin has come to zero or below.
    ///
    /// Returning `mode` means that there is no event; the switch is then not asked again within this step.
    fn next_mode(&mut self, group: usize, signs: &[f64], index: usize, mode: u8) -> u8 {
        let _ = (group, signs, index);
        mode
    }
}

impl<P: Problem + ?Sized> Problem for &mut P {
    fn dimension(&self) -> usize {
        (**self).dimension()
    }
    fn read_states(&self) -> usize {
        (**self).read_states()
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

    fn layer_bounds(&self) -> &[f64] {
        (**self).layer_bounds()
    }
    fn segment(&mut self, start: f64) -> f64 {
        (**self).segment(start)
    }
    fn derivative(&mut self, time: f64, x: &[f64], dx: &mut [f64]) {
        (**self).derivative(time, x, dx);
    }
    fn linearize(&mut self, time: f64, x: &[f64], dx: &[f64], df_dt: &mut [f64]) {
        (**self).linearize(time, x, dx, df_dt);
    }
    fn linearize_for_newton(&mut self, time: f64, x: &[f64], dx: &[f64], unused: &mut [f64]) {
        (**self).linearize_for_newton(time, x, dx, unused);
    }
    fn stiffness(&mut self, time: f64, x: &[f64]) -> f64 {
        (**self).stiffness(time, x)
    }
    fn factor(&mut self, shift: f64) -> Result<(), Singular> {
        (**self).factor(shift)
    }
    fn solve(&mut self, b: &mut [f64]) {
        (**self).solve(b);
    }
    fn kink_counts(&self) -> (usize, usize) {
        (**self).kink_counts()
    }
    fn kinks(&mut self, time: f64, x: &[f64], signs: &mut KinkSigns) {
        (**self).kinks(time, x, signs);
    }
    fn tells_pieces(&self) -> bool {
        (**self).tells_pieces()
    }
    fn switch_count(&self) -> usize {
        (**self).switch_count()
    }
    fn initial_modes(&mut self, time: f64, x: &[f64], modes: &mut [u8]) {
        (**self).initial_modes(time, x, modes);
    }
    fn sign_count(&self) -> usize {
        (**self).sign_count()
    }
    fn signs(&mut self, time: f64, x: &[f64], signs: &mut [f64]) {
        (**self).signs(time, x, signs);
    }
    fn switch_groups(&self) -> Vec<SwitchGroup> {
        (**self).switch_groups()
    }
    fn group_signs(&mut self, group: usize, time: f64, x: &[f64], signs: &mut [f64]) {
        (**self).group_signs(group, time, x, signs);
    }
    fn group_margins(&mut self, group: usize, signs: &[f64], modes: &[u8], margins: &mut [f64]) {
        (**self).group_margins(group, signs, modes, margins);
    }
    fn next_mode(&mut self, group: usize, signs: &[f64], index: usize, mode: u8) -> u8 {
        (**self).next_mode(group, signs, index, mode)
    }
}
