//! States between the ends of the last step.
//!
//! The ends of an implicit step lie where the stiff forces are in balance; its dense output need not. A point that sticks creeps with a
//! part of the reference speed of its friction, and what the polynomial misses of that changes its friction by as large a part: a
//! step that is exact to a fifth of the tolerance at its end can be off by half of the friction force in its middle. So the states `u` of the dense
//! output are settled: what they miss is followed for the time γh by one step of the implicit Euler method,
//!
//! ```text
//! δ/(γh) = f(u + δ) - u',
//! ```
//!
//! which takes away what answers faster (`f(u) - u'` is what `u` misses of the equations), and adds to the rest no more than
//! the error of the dense output itself. By Newton's method, with the matrix at `u`.

use super::Integrator;
use crate::methods::tableau::Family;
use crate::problem::Problem;
use crate::stages::{Dense, all_finite};

/// In a step that is shorter than this, in units of the fastest answer, nothing is settled: the dense output is as exact as its ends.
const STIFF: f64 = 100.0;
/// Nor where it misses less than this in the middle of the step, in units of the tolerance.
const NOTHING: f64 = 0.002;
/// A correction by the matrix of the step is good enough if it is smaller than this,
const SMALL: f64 = 0.05;
/// and one by the matrix at the place is the last one.
const LAST: f64 = 0.002;
/// The matrix is formed anew where corrections do not shrink by this factor;
const SLOW: f64 = 0.2;
/// not by this one, they are given up, with the dense output as it is.
const CONTRACTION: f64 = 0.7;
/// Most corrections.
const MOST_ROUNDS: u32 = 8;

/// What is known of the matrix of the last step.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
enum Matrix {
    /// It is not to be had, or not needed: nothing is settled.
    #[default]
    Gone,
    /// It is there, and nothing was settled yet: the middle of the step tells whether anything is.
    Fresh,
    /// It is there.
    There,
    /// Another one is there, and it can be formed again.
    Replaced,
}

/// Scratch memory.
#[derive(Debug, Default)]
pub(super) struct Between {
    matrix: Matrix,
    /// The dense output, and where the search for what is settled has come.
    start: Vec<f64>,
    x: Vec<f64>,
    /// The slope of the dense output, and what f says; then the correction.
    slope: Vec<f64>,
    rate: Vec<f64>,
}

impl Between {
    /// For vectors of `stride` entries.
    pub fn new(stride: usize) -> Self {
        Self {
            matrix: Matrix::Gone,
            start: vec![0.0; stride],
            x: vec![0.0; stride],
            slope: vec![0.0; stride],
            rate: vec![0.0; stride],
        }
    }

    /// A step of this family was accepted. Where it is explicit nothing is stiff.
    pub fn open(&mut self, family: Family) {
        self.matrix = match family {
            Family::LinearlyImplicit => Matrix::Fresh,
            Family::DiagonallyImplicit | Family::Explicit => Matrix::Gone,
        };
    }

    /// From here on nothing is settled in the last step: its matrix or its right-hand side may be another one.
    pub fn close(&mut self) {
        self.matrix = Matrix::Gone;
    }
}

impl<P: Problem> Integrator<P> {
    /// The limit of the next step on the way to `end`, if states are wanted at `row`: that time, where only the ends of steps are exact. A method
    /// whose tolerance holds for displacements alone has speeds in balance with friction at its stages, but not between them, and
    /// nothing is settled in its steps.
    #[must_use]
    pub fn limit_before(&self, row: f64, end: f64) -> f64 {
        match self.tableau.family {
            Family::DiagonallyImplicit => row.min(end),
            Family::LinearlyImplicit | Family::Explicit => end,
        }
    }

    /// States at a time inside the last step, to the order of the method's dense output; where they are held by something stiff as it holds them at that
    /// time. Best asked for before the next step begins: from then on it is [`Integrator::interpolate_range`].
    ///
    /// # Panics
    /// If `out` does not have the length of the problem.
    pub fn interpolate(&mut self, time: f64, out: &mut [f64]) {
        assert_eq!(out.len(), self.dimension, "length of the interpolated states");
        self.interpolate_range(time, 0, out);
        if time <= self.previous_time || time >= self.time {
            return;
        }
        if self.between.matrix == Matrix::Fresh {
            self.between.matrix = if self.misses() {
                Matrix::There
            } else {
                Matrix::Gone
            };
        }
        if self.between.matrix != Matrix::Gone {
            self.settle(time, out);
        }
    }

    /// States `first ..` as many as `out` takes, at a time inside the last step, by the method's dense output.
    ///
    /// # Panics
    /// If there are not as many states.
    pub fn interpolate_range(&self, time: f64, first: usize, out: &mut [f64]) {
        assert!(
            first + out.len() <= self.dimension,
            "range of the interpolated states"
        );
        let dense = self.dense();
        dense.evaluate_range(dense.fraction(time), first, out);
    }

    fn dense(&self) -> Dense<'_> {
        Dense {
            tableau: self.last_method,
            start: self.previous_time,
            step: self.time - self.previous_time,
            end: self.time,
            x0: &self.previous_x,
            x1: &self.x,
            stages: &self.stages,
        }
    }

    /// Whether the dense output of the last step misses anything in its middle, by the matrix of the step. Where everything slips fast
    /// friction hardly follows the slip.
    fn misses(&mut self) -> bool {
        let shift = self.settling_shift();
        let middle = 0.5 * (self.previous_time + self.time);
        self.kinks.hold() && self.is_stiff_at(middle) && self.correct_between(shift) > NOTHING
    }

    /// 1/(γh).
    fn settling_shift(&self) -> f64 {
        1.0 / (self.last_method.gamma * (self.time - self.previous_time))
    }

    /// Has the dense output and its slope at a time, and the derivative where anything answers fast there; whether it does.
    fn is_stiff_at(&mut self, time: f64) -> bool {
        let mut between = std::mem::take(&mut self.between);
        let dense = self.dense();
        let theta = dense.fraction(time);
        dense.evaluate(theta, &mut between.start);
        dense.slope(theta, &mut between.slope);
        between.x.copy_from_slice(&between.start);
        self.between = between;
        let step = self.time - self.previous_time;
        let x = &self.between.x[..self.dimension];
        step * self.problem.stiffness(time, x) >= STIFF && self.evaluate_between(time)
    }

    /// Has the derivative; whether it is finite.
    fn evaluate_between(&mut self, time: f64) -> bool {
        let Between { x, rate, .. } = &mut self.between;
        self.problem
            .derivative(time, &x[..self.dimension], &mut rate[..self.dimension]);
        all_finite(rate)
    }

    /// Settles the states of the dense output at a time, if Newton's method finds where.
    fn settle(&mut self, time: f64, out: &mut [f64]) {
        let (reads, shift) = (self.problem.read_states(), self.settling_shift());
        if !self.is_stiff_at(time) || !self.has_matrix(shift) {
            return;
        }
        // By the matrix of the step, which costs little.
        let mut size = self.correct_between(shift);
        let (mut enough, mut old) = (SMALL, true);
        for round in 0..MOST_ROUNDS {
            if size <= enough {
                out[..reads].copy_from_slice(&self.between.x[..reads]);
                return;
            }
            if round == 0 {
                let Between { x, start, .. } = &mut self.between;
                x.copy_from_slice(start);
            }
            if !self.evaluate_between(time) || (old && !self.replace_matrix(time, shift)) {
                return;
            }
            let before = size;
            size = self.correct_between(shift);
            if round > 0 && size > CONTRACTION * before {
                return;
            }
            (enough, old) = (LAST, round > 0 && size > SLOW * before);
        }
    }

    /// Has the matrix of the last step.
    fn has_matrix(&mut self, shift: f64) -> bool {
        if self.between.matrix == Matrix::There {
            return true;
        }
        let n = self.dimension;
        // The derivative at the start was left here when the step was accepted.
        let (x, dx) = (&self.previous_x[..n], &self.trial_dx[..n]);
        self.df_dt.fill(0.0);
        self.problem
            .linearize(self.previous_time, x, dx, &mut self.df_dt[..n]);
        (self.between.matrix, self.linearized) = (Matrix::There, false);
        self.problem.factor(shift).is_ok()
    }

    /// Has the matrix at a time between the ends, where the derivative is known.
    fn replace_matrix(&mut self, time: f64, shift: f64) -> bool {
        let n = self.dimension;
        let Between { x, rate, .. } = &self.between;
        self.problem
            .linearize_for_newton(time, &x[..n], &rate[..n], &mut self.df_dt[..n]);
        (self.between.matrix, self.linearized) = (Matrix::Replaced, false);
        self.problem.factor(shift).is_ok()
    }

    /// Corrects the states by the derivative there and the matrix that is there: by how much at most.
    fn correct_between(&mut self, shift: f64) -> f64 {
        let Between {
            start,
            x,
            rate,
            slope,
            ..
        } = &mut self.between;
        let places = x.iter().zip(start);
        for ((rate, slope), (x, start)) in rate.iter_mut().zip(slope).zip(places) {
            *rate -= *slope + shift * (*x - *start);
        }
        self.problem.solve(&mut rate[..self.dimension]);
        if !all_finite(rate) {
            return f64::INFINITY;
        }
        let mut most = 0.0_f64;
        let corrections = rate.iter().zip(&self.weights);
        for (x, (correction, weight)) in x.iter_mut().zip(corrections).take(self.problem.read_states()) {
            *x += correction;
            most = most.max(correction.abs() * weight);
        }
        most
    }
}
