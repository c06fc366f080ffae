//! One attempt at a step: the stages of the method, the new states and their error.

use super::Integrator;
use crate::error::Reason;
use crate::kinks::Ahead;
use crate::methods::explicit::TSITOURAS;
use crate::methods::tableau::Family;
use crate::problem::Problem;
use crate::stages::{add, all_finite, combine, largest, leading_states, scale};

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

/// The size of an attempt's error in units of the tolerance, or why it failed.
pub(super) type Outcome = Result<f64, Failure>;

/// The attempt that is planned.
#[derive(Clone, Copy, Debug)]
pub(super) struct Attempt {
    /// Where the step must end at the latest.
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
    /// The error of the last attempt that was rejected because of it, in units of the tolerance.
    pub scaled_error: f64,
    /// Whether the attempt is made only to see where a value that is not finite begins.
    pub checked: bool,
    /// The state that was to blame before that.
    pub blamed: Option<usize>,
}

impl Attempt {
    pub const NONE: Self = Self {
        end: f64::NAN,
        proposed: f64::NAN,
        step: f64::NAN,
        target: f64::NAN,
        landing: None,
        cut: false,
        scaled_error: 0.0,
        checked: false,
        blamed: None,
    };
}

/// The stage of the explicit method whose argument is the new state.
const EXPLICIT_END: usize = 6;
const _: () = assert!(TSITOURAS.alpha.len() == EXPLICIT_END + 2);

impl<P: Problem> Integrator<P> {
    /// Makes the attempt that is planned.
    ///
    /// Only a checked attempt tells which state is to blame for a value that is not finite.
    #[inline(always)]
    pub(super) fn make_attempt(&mut self) -> Outcome {
        if self.tableau.family == Family::DiagonallyImplicit {
            self.attempt_by_newton()
        } else if self.is_explicit(self.attempt.step) {
            self.attempt_explicitly()
        } else {
            self.attempt_implicitly()
        }
    }

    /// The attempt by the linearly implicit method.
    #[inline(never)]
    fn attempt_implicitly(&mut self) -> Outcome {
        let (n, stride, tableau) = (self.dimension, self.stride, self.tableau);
        let Attempt {
            step,
            target,
            checked,
            ..
        } = self.attempt;
        self.trial_method = tableau;
        self.linearize_here();
        let inverse = 1.0 / step;
        self.factor(inverse / tableau.gamma)?;
        self.trial_stages[..stride].copy_from_slice(&self.dx);
        self.solve_stage(0);
        for i in 1..tableau.stages() {
            let (done, rest) = self.trial_stages.split_at_mut(i * stride);
            if self.extends[i] {
                add(&mut self.argument, 1.0, &done[(i - 1) * stride..]);
            } else {
                let argument = &mut self.argument[..self.widths[i]];
                combine(argument, &self.x, 1.0, tableau.a[i], done, stride);
            }
            let time = stage_time(tableau.alpha[i], self.time, step, target);
            self.problem
                .derivative(time, &self.argument[..n], &mut self.slope[..n]);
            if checked && !all_finite(&self.slope) {
                return Err(not_finite(&self.slope[..n]));
            }
            let stage = &mut rest[..stride];
            combine(stage, &self.slope, inverse, tableau.c[i], done, stride);
            self.solve_stage(i);
        }
        self.end_of_stages()
    }

    /// Whether a step of this length from the place reached is explicit.
    #[inline(always)]
    pub(super) fn is_explicit(&self, step: f64) -> bool {
        self.options.explicit_steps && step * self.stiffness <= EXPLICIT
    }

    /// Has the Jacobian matrix at the place reached.
    #[inline(always)]
    fn linearize_here(&mut self) {
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

    /// Solves for a stage, in place of its right-hand side.
    #[inline(always)]
    fn solve_stage(&mut self, i: usize) {
        let stage = &mut self.trial_stages[i * self.stride..][..self.stride];
        let d = self.tableau.d[i] * self.attempt.step;
        if !self.autonomous && d != 0.0 {
            add(stage, d, &self.df_dt);
        }
        self.problem.solve(&mut stage[..self.dimension]);
    }

    #[inline(always)]
    fn end_of_stages(&mut self) -> Outcome {
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
            return Ok(error);
        }
        self.evaluate_end()?;
        Ok(error)
    }

    /// The derivative at the end belongs to the step: a step into a place where there is none is rejected.
    #[inline(always)]
    fn evaluate_end(&mut self) -> Result<(), Failure> {
        let n = self.dimension;
        self.problem
            .derivative(self.attempt.target, &self.trial_x[..n], &mut self.trial_dx[..n]);
        self.statistics.derivatives += 1;
        if !all_finite(&self.trial_dx) {
            return Err(not_finite(&self.trial_dx[..n]));
        }
        Ok(())
    }

    /// The attempt by the explicit method, where nothing is stiff.
    #[inline(never)]
    fn attempt_explicitly(&mut self) -> Outcome {
        let (n, stride) = (self.dimension, self.stride);
        let Attempt {
            step,
            target,
            checked,
            landing,
            ..
        } = self.attempt;
        self.trial_method = &TSITOURAS;
        scale(&mut self.trial_stages[..stride], step, &self.dx);
        for i in 1..=EXPLICIT_END {
            let (argument, slope) = if i == EXPLICIT_END {
                (&mut self.trial_x[..], &mut self.trial_dx)
            } else {
                let leading = leading_states(&self.problem);
                (&mut self.argument[..leading], &mut self.slope)
            };
            let (done, rest) = self.trial_stages.split_at_mut(i * stride);
            combine(argument, &self.x, 1.0, TSITOURAS.a[i], done, stride);
            let argument = if i == EXPLICIT_END {
                &self.trial_x[..n]
            } else {
                &self.argument[..n]
            };
            let time = stage_time(TSITOURAS.alpha[i], self.time, step, target);
            self.problem.derivative(time, argument, &mut slope[..n]);
            self.statistics.derivatives += 1;
            if checked && !all_finite(slope) {
                return Err(not_finite(&slope[..n]));
            }
            scale(&mut rest[..stride], step, slope);
        }
        let error = self.explicit_error()?;
        // Across a kink the estimate of an explicit method's error can be small by chance, again and again until it is; that of a
        // linearly implicit one, whose Jacobian matrix is that of the wrong side, is large.
        if landing.is_some() || error > 1.0 {
            return Ok(error);
        }
        self.peer_at_end();
        if !self.kinks.cross() {
            return Ok(error);
        }
        self.stiffness = f64::INFINITY;
        self.attempt_implicitly()
    }

    /// Sees what tells kinks at the end of the attempt.
    fn peer_at_end(&mut self) {
        let x = &self.trial_x[..self.dimension];
        self.kinks.peer(&mut self.problem, self.attempt.target, x);
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

/// The first value that is not finite is to blame.
#[cold]
pub(super) fn not_finite(values: &[f64]) -> Failure {
    Failure {
        reason: Reason::NotFinite,
        index: values.iter().position(|value| !value.is_finite()),
    }
}
