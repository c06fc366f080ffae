//! A step under way: it stops wherever it wants a right-hand side, which the caller evaluates.

use super::Integrator;
use super::attempt::EXPLICIT_END;
use super::newton::Point;
use crate::kinks::Ahead;
use crate::problem::Problem;

/// How far [`Integrator::go_on`] came.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Progress {
    /// A right-hand side is wanted: [`Integrator::wanted`].
    Wants,
    /// The step is made.
    Accepted,
}

/// An evaluation of a right-hand side that is wanted: `f(time, x)` is to be written to `dx`, as [`Problem::derivative`] does it.
#[derive(Debug)]
pub struct Call<'a, P> {
    /// Whose right-hand side.
    pub problem: &'a mut P,
    /// When.
    pub time: f64,
    /// At which states.
    pub x: &'a [f64],
    /// Where it goes.
    pub dx: &'a mut [f64],
}

impl<P: Problem> Call<'_, P> {
    /// Lets the problem itself evaluate it.
    #[inline(always)]
    pub fn evaluate(&mut self) {
        self.problem.derivative(self.time, self.x, self.dx);
    }
}

/// What an attempt does next, or for which of its evaluations it waits.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Phase {
    /// No step is being made.
    Idle,
    /// It begins.
    Start,
    /// It waits for this stage of the explicit method.
    Explicit(usize),
    /// It waits for this stage of the linearly implicit method.
    Implicit(usize),
    /// It waits for this point of a stage that Newton's method looks for.
    Newton(Point),
    /// It waits for the derivative at the end.
    End,
}

/// The step being made.
#[derive(Clone, Copy, Debug)]
pub(super) struct Underway {
    pub phase: Phase,
    /// The time of the evaluation that is wanted.
    pub wanted: f64,
    /// Where it must end at the latest.
    pub end: f64,
    /// The length that was planned.
    pub proposed: f64,
    /// Length and end of the attempt.
    pub step: f64,
    pub target: f64,
    /// The kink behind which the attempt is to end.
    pub landing: Option<Ahead>,
    /// Whether it was cut short by something ahead.
    pub cut: bool,
    /// The error of the attempt, while it waits for the derivative at the end.
    pub error: f64,
    /// The error of the last attempt that was rejected because of it, in units of the tolerance.
    pub scaled_error: f64,
    /// Whether the attempt is made only to see where a value that is not finite begins.
    pub checked: bool,
    /// The state that was to blame before that.
    pub blamed: Option<usize>,
}

impl Underway {
    pub const NONE: Self = Self {
        phase: Phase::Idle,
        wanted: f64::NAN,
        end: f64::NAN,
        proposed: f64::NAN,
        step: f64::NAN,
        target: f64::NAN,
        landing: None,
        cut: false,
        error: 0.0,
        scaled_error: 0.0,
        checked: false,
        blamed: None,
    };
}

impl<P: Problem> Integrator<P> {
    /// The evaluation for which [`Integrator::go_on`] has stopped; between steps it means nothing.
    #[inline(always)]
    pub fn wanted(&mut self) -> Call<'_, P> {
        let n = self.dimension;
        let (x, dx) = match self.underway.phase {
            Phase::End | Phase::Explicit(EXPLICIT_END) => (&self.trial_x, &mut self.trial_dx),
            _ => (&self.argument, &mut self.slope),
        };
        Call {
            problem: &mut self.problem,
            time: self.underway.wanted,
            x: &x[..n],
            dx: &mut dx[..n],
        }
    }

    /// Stops the attempt until a right-hand side is there.
    #[inline(always)]
    pub(super) fn want(&mut self, time: f64, phase: Phase) {
        self.underway.wanted = time;
        self.underway.phase = phase;
    }
}
