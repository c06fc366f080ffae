//! One attempt at a step: the stages of the method, the new states and their error. It goes from one right-hand side to the next.

use super::Integrator;
use super::underway::{Phase, Underway};
use crate::error::Reason;
use crate::explicit::TSITOURAS;
use crate::problem::Problem;
use crate::stages::{add, all_finite, combine, largest, leading_states, scale};
use crate::tableau::Family;

/// Steps shorter than this, in units of the fastest answer of the problem, are explicit. The method is stable down to -3.5 on the real
/// axis and all but stable up to 2 on the imaginary one; bounds of answers are larger than the answers.
const EXPLICIT: f64 = 3.0;

/// By how much errors of explicit steps count more. Their estimate is some five times the error itself, which adds up in the energy ledger; that of the
/// linearly implicit methods is ten to twenty times as large.
const CAUTION: f64 = 4.0;

/// By how much errors of linearly implicit steps count more in which something breaks away. They are up to 400 times what is estimated.
const DAMPED: f64 = 10.0;

/// Why an attempt failed, with the state to blame.
pub(super) struct Failure {
    pub reason: Reason,
    pub index: Option<usize>,
}

/// How far an attempt came: until it wants a right-hand side (nothing), or to its end with the size of its error.
pub(super) type Advance = Result<Option<f64>, Failure>;

/// The stage of the explicit method whose argument is the new state.
pub(super) const EXPLICIT_END: usize = 6;
const _: () = assert!(TSITOURAS.alpha.len() == EXPLICIT_END + 2);

impl<P: Problem> Integrator<P> {
    /// Goes on with the attempt under way.
    ///
    /// Only a checked attempt tells which state is to blame for a value that is not finite.
    #[inline(always)]
    pub(super) fn advance(&mut self) -> Advance {
        match self.underway.phase {
            Phase::Implicit(stage) => self.after_stage(stage),
            Phase::End => self.after_end(),
            Phase::Explicit(stage) => self.after_explicit_stage(stage),
            Phase::Newton(point) => self.after_newton(point),
            Phase::Idle | Phase::Start => {
                if self.tableau.family == Family::DiagonallyImplicit {
                    self.begin_newton()
                } else if self.is_explicit(self.underway.step) {
                    self.begin_explicit()
                } else if self.is_calm() {
                    self.begin_collocation()
                } else {
                    self.begin_implicit()
                }
            }
        }
    }

    #[inline(never)]
    fn begin_implicit(&mut self) -> Advance {
        let (stride, tableau) = (self.stride, self.tableau);
        self.trial_method = tableau;
        self.linearize_here();
        let inverse = 1.0 / self.underway.step;
        self.factor(inverse / tableau.gamma)?;
        self.trial_stages[..stride].copy_from_slice(&self.dx);
        self.solve_stage(0)
    }

    /// Whether a step of this length from the place reached is explicit.
    #[inline(always)]
    pub(super) fn is_explicit(&self, step: f64) -> bool {
        self.options.explicit_steps && step * self.stiffness <= EXPLICIT
    }

    /// Has the Jacobian matrix at the place reached.
    #[inline(always)]
    pub(super) fn linearize_here(&mut self) {
        let n = self.dimension;
        if !self.linearized {
            self.df_dt.fill(0.0);
            self.problem
                .linearize(self.time, &self.x[..n], &self.dx[..n], &mut self.df_dt[..n]);
            self.statistics.jacobians += 1;
            self.linearized = true;
            self.autonomous = self.df_dt.iter().all(|value| *value == 0.0);
        }
    }

    /// Factors the matrix that is there.
    #[inline(always)]
    pub(super) fn factor(&mut self, shift: f64) -> Result<(), Failure> {
        self.statistics.factorizations += 1;
        self.problem.factor(shift).map_err(|singular| Failure {
            reason: Reason::Singular {
                block: singular.block,
            },
            index: None,
        })
    }

    /// The last stage of the attempt: its error.
    #[inline(always)]
    pub(super) fn last_trial_stage(&self) -> &[f64] {
        &self.trial_stages[(self.trial_method.stages() - 1) * self.stride..][..self.stride]
    }

    /// Writes the error of a method whose last row makes it of the stages.
    #[inline(always)]
    pub(super) fn write_error(&mut self) {
        let (stride, last) = (self.stride, self.trial_method.stages() - 1);
        let (done, error) = self.trial_stages.split_at_mut(last * stride);
        let error = &mut error[..stride];
        error.fill(0.0);
        for (weight, stage) in self.trial_method.a[last].iter().zip(done.chunks_exact(stride)) {
            add(error, *weight, stage);
        }
    }

    #[inline(always)]
    fn after_stage(&mut self, i: usize) -> Advance {
        let (n, stride, tableau) = (self.dimension, self.stride, self.tableau);
        if self.underway.checked && !all_finite(&self.slope) {
            return Err(not_finite(&self.slope[..n]));
        }
        let (done, rest) = self.trial_stages.split_at_mut(i * stride);
        let inverse = 1.0 / self.underway.step;
        combine(
            &mut rest[..stride],
            &self.slope,
            inverse,
            tableau.c[i],
            done,
            stride,
        );
        self.solve_stage(i)
    }

    /// Solves for a stage, and wants the next one.
    #[inline(always)]
    fn solve_stage(&mut self, i: usize) -> Advance {
        let (n, stride, tableau) = (self.dimension, self.stride, self.tableau);
        let Underway { step, target, .. } = self.underway;
        let next = i + 1;
        let done = &mut self.trial_stages[..next * stride];
        let stage = &mut done[i * stride..];
        let d = tableau.d[i] * step;
        if !self.autonomous && d != 0.0 {
            add(stage, d, &self.df_dt);
        }
        self.problem.solve(&mut stage[..n]);
        if next == tableau.stages() {
            return self.end_of_stages();
        }
        if self.extends[next] {
            add(&mut self.argument, 1.0, stage);
        } else {
            let argument = &mut self.argument[..self.widths[next]];
            combine(argument, &self.x, 1.0, tableau.a[next], done, stride);
        }
        let time = stage_time(tableau.alpha[next], self.time, step, target);
        self.want(time, Phase::Implicit(next));
        Ok(None)
    }

    #[inline(always)]
    fn end_of_stages(&mut self) -> Advance {
        let (n, stride, count) = (self.dimension, self.stride, self.tableau.stages());
        self.statistics.derivatives += count as u64 - 1;
        self.statistics.solves += count as u64;

        let last = &self.trial_stages[(count - 1) * stride..][..stride];
        for ((new, old), u) in self.trial_x.iter_mut().zip(&self.argument).zip(last) {
            *new = old + u;
        }
        if !all_finite(&self.trial_x) {
            return Err(not_finite(&self.trial_x[..n]));
        }
        let mut error = largest(last, &self.weights);
        if self.foresees() && error <= 1.0 && error * DAMPED > 1.0 {
            self.peer_at_end();
            if self.kinks.break_away() {
                error *= DAMPED;
            }
        }
        if error > 1.0 && self.options.fixed_step.is_none() {
            return Ok(Some(error));
        }
        // The derivative at the end belongs to the step: a step into a place where there is none is rejected.
        self.underway.error = error;
        self.want(self.underway.target, Phase::End);
        Ok(None)
    }

    #[inline(always)]
    fn after_end(&mut self) -> Advance {
        self.statistics.derivatives += 1;
        if !all_finite(&self.trial_dx) {
            return Err(not_finite(&self.trial_dx[..self.dimension]));
        }
        Ok(Some(self.underway.error))
    }

    /// The same by the explicit method, where nothing is stiff.
    #[inline(never)]
    fn begin_explicit(&mut self) -> Advance {
        self.trial_method = &TSITOURAS;
        let first = &mut self.trial_stages[..self.stride];
        scale(first, self.underway.step, &self.dx);
        self.want_explicit_stage(1);
        Ok(None)
    }

    fn want_explicit_stage(&mut self, i: usize) {
        let Underway { step, target, .. } = self.underway;
        let argument = if i == EXPLICIT_END {
            &mut self.trial_x[..]
        } else {
            &mut self.argument[..leading_states(&self.problem)]
        };
        let done = &self.trial_stages[..i * self.stride];
        combine(argument, &self.x, 1.0, TSITOURAS.a[i], done, self.stride);
        let time = stage_time(TSITOURAS.alpha[i], self.time, step, target);
        self.want(time, Phase::Explicit(i));
    }

    #[inline(never)]
    fn after_explicit_stage(&mut self, i: usize) -> Advance {
        let n = self.dimension;
        self.statistics.derivatives += 1;
        let slope = if i == EXPLICIT_END {
            &self.trial_dx
        } else {
            &self.slope
        };
        if self.underway.checked && !all_finite(slope) {
            return Err(not_finite(&slope[..n]));
        }
        let stage = &mut self.trial_stages[i * self.stride..][..self.stride];
        scale(stage, self.underway.step, slope);
        if i < EXPLICIT_END {
            self.want_explicit_stage(i + 1);
            return Ok(None);
        }
        let error = self.explicit_error()?;
        // Across a kink the estimate of an explicit method's error can be small by chance, again and again until it is; that of a
        // linearly implicit one, whose Jacobian matrix is that of the wrong side, is large.
        if self.underway.landing.is_some() || error > 1.0 {
            return Ok(Some(error));
        }
        self.peer_at_end();
        if !self.kinks.cross() {
            return Ok(Some(error));
        }
        self.stiffness = f64::INFINITY;
        self.begin_implicit()
    }

    /// Sees what tells kinks at the end of the attempt.
    pub(super) fn peer_at_end(&mut self) {
        let x = &self.trial_x[..self.dimension];
        self.kinks.peer(&mut self.problem, self.underway.target, x);
    }

    /// The size of the error of an explicit step all of whose stages are there.
    fn explicit_error(&mut self) -> Result<f64, Failure> {
        for values in [&self.trial_x, &self.trial_dx] {
            if !all_finite(values) {
                return Err(not_finite(&values[..self.dimension]));
            }
        }
        self.write_error();
        Ok(CAUTION * largest(self.last_trial_stage(), &self.weights))
    }
}

/// The time of a stage; the last ones stand at the end itself.
#[inline(always)]
pub(super) fn stage_time(alpha: f64, start: f64, step: f64, target: f64) -> f64 {
    if alpha == 1.0 {
        target
    } else {
        start + alpha * step
    }
}

/// The equations of the step cannot be solved: nobody is to blame.
#[cold]
pub(super) fn unsolved() -> Failure {
    Failure {
        reason: Reason::Unsolved,
        index: None,
    }
}

/// The first value that is not finite is to blame.
#[cold]
pub(super) fn not_finite(values: &[f64]) -> Failure {
    Failure {
        reason: Reason::NotFinite,
        index: values.iter().position(|value| !value.is_finite()),
    }
}
