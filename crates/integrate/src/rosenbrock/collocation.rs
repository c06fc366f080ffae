//! Attempts by collocation: long steps where nothing but a vibration goes on.
//!
//! After a strike a wedge that is pressed on rings for a while, and nothing else happens: no contact opens, nothing reverses. A method of order
//! 5 needs a step for every one or two radians of that; the polynomial of collocation at seven points goes four to eight radians in a step
//! that costs not twice as much. The changes `Z_i` at the points solve `Z = h A f(x + Z)`. Along the eigenvectors of `A⁻¹` their corrections
//! come apart,
//!
//! ```text
//! (μ_k/h - J) Δw_k = Σ_j L_kj f(x + Z_j) - (μ_k/h) w_k,      Z_i = Σ_k V_ik w_k,
//! ```
//!
//! one real and three complex systems of the size of J. The first guess takes f for linear, `f(x) + J Z + c h ∂f/∂t`, and needs no
//! evaluation; where the way is smooth one round of evaluations is enough after it.

use serde::{Deserialize, Serialize};

use super::Integrator;
use super::attempt::{Advance, Failure, not_finite, stage_time, unsolved};
use super::underway::Phase;
use crate::error::SetupError;
use crate::problem::Problem;
use crate::radau::{ERROR, FROM_PARTS, NODES, PAIRS, PARTS_OF_A_LINE, POINTS, RADAU, REAL, TO_PARTS};
use crate::stages::{all_finite, combine, largest};
use crate::state::check_size;
use crate::tableau::Family;

/// So many steps of the linearly implicit method must have been smooth before; more where long steps were given up before, up to the
/// second number.
const SMOOTH: [u32; 2] = [4, 64];
/// An attempt of the linearly implicit method whose error is below this, though too large, is still a smooth one: while something rings,
/// errors rise and fall with it.
const MILD: f64 = 3.0;
/// By how much longer a step is tried than one of the linearly implicit method.
pub(super) const STRETCH: f64 = 2.2;
/// Where a step took more rounds than these it is not smooth enough.
const FEW_ROUNDS: u32 = 2;
/// Most rounds.
const MOST_ROUNDS: u32 = 3;
/// What the rounds may leave, in units of the tolerance.
const LEFT: f64 = 0.3;
/// Corrections that do not shrink by this factor are given up.
const CONTRACTION: f64 = 0.5;
/// How corrections shrink is looked at anew in steps that are longer by this factor.
const LONGER: f64 = 1.25;
/// They may shrink more than this, but not reliably.
const LEAST_RATE: f64 = 1e-3;
/// At so many points, in the first sixth of a step, nothing can have broken loose that would not be loose at the next one too.
const BEGINNING: usize = 2;

/// When steps are by collocation.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub(crate) struct Calm {
    /// How many linearly implicit steps in a row were smooth.
    smooth: u32,
    /// How many must be.
    needed: u32,
    /// By which factor corrections shrank where a second one was made last, and the length of that step; zero: nowhere yet since steps became smooth.
    rate: f64,
    rate_step: f64,
}

impl Default for Calm {
    fn default() -> Self {
        Self {
            smooth: 0,
            needed: SMOOTH[0],
            rate: 0.0,
            rate_step: 0.0,
        }
    }
}

impl Calm {
    /// Whether a run can have become so smooth.
    pub fn check(&self) -> Result<(), SetupError> {
        let [least, most] = SMOOTH;
        if !(least..=most).contains(&self.needed) {
            let value = f64::from(self.needed);
            return Err(SetupError::Damaged {
                name: "calm.needed",
                value,
            });
        }
        // Any rate serves: see `rate_of`.
        check_size("calm.rate_step", self.rate_step)
    }

    /// By which factor a second correction of a step of this length would be smaller than its first, going by what was seen: as the matrix changes
    /// along the step; one that cannot be relied on if none so long has been seen.
    fn rate_of(&self, step: f64) -> f64 {
        if step > LONGER * self.rate_step {
            return CONTRACTION;
        }
        self.rate.max(LEAST_RATE) * step / self.rate_step
    }
}

/// The rounds of an attempt.
#[derive(Debug, Default)]
pub(super) struct Collocation {
    rounds: u32,
    /// The size of the last correction, in units of the tolerance.
    size: f64,
    /// Times, states and slopes at the points.
    times: [f64; POINTS],
    places: Vec<f64>,
    slopes: Vec<f64>,
    /// Parts of the changes along the eigenvectors; the same times -μ/h; their corrections.
    parts: Vec<f64>,
    pull: Vec<f64>,
    correction: Vec<f64>,
}

impl Collocation {
    pub fn new(stride: usize) -> Self {
        let rows = || vec![0.0; POINTS * stride];
        Self {
            rounds: 0,
            size: 0.0,
            times: [0.0; POINTS],
            places: rows(),
            slopes: rows(),
            parts: rows(),
            pull: rows(),
            correction: rows(),
        }
    }
}

impl<P: Problem> Integrator<P> {
    /// Whether the next attempt is by collocation.
    #[inline(always)]
    pub(super) fn is_calm(&self) -> bool {
        self.calm.smooth >= self.calm.needed
    }

    /// Chooses the method of the step after one that was accepted. One that was cut short says little.
    #[inline]
    pub(super) fn choose_method(&mut self, cut: bool) {
        if !self.collocates {
            return;
        }
        let smooth = self.ahead.is_none() && self.passage.is_none() && !self.kinks.fade();
        match self.last_method.family {
            Family::LinearlyImplicit if smooth && !cut => {
                self.calm.smooth = self.calm.smooth.saturating_add(1);
                if self.is_calm() {
                    self.proposed_step = (STRETCH * self.proposed_step).min(self.options.maximum_step);
                }
            }
            Family::Collocation if smooth && self.collocation.rounds <= FEW_ROUNDS => {
                self.calm.needed = (self.calm.needed / 2).max(SMOOTH[0]);
            }
            _ => self.end_calm(),
        }
    }

    /// The next steps are not by collocation, and shorter.
    pub(super) fn end_calm(&mut self) {
        if self.leave_calm() {
            self.proposed_step /= STRETCH;
        }
    }

    /// The next steps are not by collocation; whether they would have been.
    pub(super) fn leave_calm(&mut self) -> bool {
        let calm = self.is_calm();
        (self.calm.smooth, self.calm.rate_step) = (0, 0.0);
        if calm {
            self.calm.needed = self.calm.needed.saturating_mul(2).min(SMOOTH[1]);
        }
        calm
    }

    /// The same after an attempt with this outcome, which was rejected; a mild one ends nothing.
    pub(super) fn lose_calm(&mut self, outcome: &Result<f64, Failure>) -> bool {
        let mild = matches!(outcome, Ok(error) if *error < MILD);
        if mild && !self.is_calm() && self.underway.landing.is_none() && self.passage.is_none() {
            return false;
        }
        self.leave_calm()
    }

    #[inline(never)]
    pub(super) fn begin_collocation(&mut self) -> Advance {
        let stride = self.stride;
        self.trial_method = &RADAU;
        self.linearize_here();
        let step = self.underway.step;
        self.factor(REAL / step)?;
        for (index, [re, im]) in PAIRS.iter().enumerate() {
            self.problem
                .factor_complex(index, [re / step, im / step])
                .map_err(|_| unsolved())?;
        }
        let rows = self.collocation.correction.chunks_exact_mut(stride);
        for (row, [all, moment]) in rows.zip(&PARTS_OF_A_LINE) {
            let slopes = self.dx.iter().zip(&self.df_dt);
            for (target, (slope, change)) in row.iter_mut().zip(slopes) {
                *target = all * slope + step * moment * change;
            }
        }
        self.collocation.parts.fill(0.0);
        self.trial_stages[..POINTS * stride].fill(0.0);
        self.correct_parts();
        for (time, node) in self.collocation.times.iter_mut().zip(NODES) {
            *time = stage_time(node, self.time, step, self.underway.target);
        }
        for round in 1..=MOST_ROUNDS {
            self.collocation.rounds = round;
            if self.correct_points()? {
                return self.end_of_points();
            }
        }
        Err(unsolved())
    }

    /// Solves for the corrections of the parts, and adds them.
    fn correct_parts(&mut self) {
        let (n, stride) = (self.dimension, self.stride);
        let inverse = 1.0 / self.underway.step;
        let Collocation {
            parts,
            pull,
            correction,
            size,
            ..
        } = &mut self.collocation;
        let (real, pairs) = correction.split_at_mut(stride);
        self.problem.solve(&mut real[..n]);
        for (index, pair) in pairs.chunks_exact_mut(2 * stride).enumerate() {
            let (re, im) = pair.split_at_mut(stride);
            self.problem.solve_complex(index, &mut re[..n], &mut im[..n]);
        }
        self.statistics.solves += 1 + PAIRS.len() as u64;
        for (part, change) in parts.iter_mut().zip(correction.iter()) {
            *part += change;
        }
        let (real, pairs) = parts.split_at(stride);
        let (pull_real, pull_pairs) = pull.split_at_mut(stride);
        for (pull, part) in pull_real.iter_mut().zip(real) {
            *pull = -inverse * REAL * part;
        }
        let both = pairs
            .chunks_exact(2 * stride)
            .zip(pull_pairs.chunks_exact_mut(2 * stride));
        for ([re, im], (part, pull)) in PAIRS.iter().zip(both) {
            let (a, b) = part.split_at(stride);
            let (pull_a, pull_b) = pull.split_at_mut(stride);
            for i in 0..stride {
                pull_a[i] = -inverse * (re * a[i] - im * b[i]);
                pull_b[i] = -inverse * (re * b[i] + im * a[i]);
            }
        }
        *size = 0.0;
        for (stage, weights) in self.trial_stages.chunks_exact_mut(stride).zip(&FROM_PARTS) {
            combine(&mut self.argument, stage, 1.0, weights, correction, stride);
            for (change, new) in stage.iter_mut().zip(&mut self.argument) {
                (*change, *new) = (*new, *new - *change);
            }
            *size = size.max(largest(&self.argument, &self.weights));
        }
    }

    /// One round: evaluates at all points at once, and corrects; whether what is left is small. (It wants nothing from its caller: the points
    /// fill a processor's lanes without other runs beside them.)
    fn correct_points(&mut self) -> Result<bool, Failure> {
        let stride = self.stride;
        let Collocation {
            times,
            places,
            slopes,
            ..
        } = &mut self.collocation;
        let changes = self.trial_stages.chunks_exact(stride);
        for (place, change) in places.chunks_exact_mut(stride).zip(changes) {
            for ((place, x), change) in place.iter_mut().zip(&self.x).zip(change) {
                *place = x + change;
            }
        }
        self.problem.derivatives(times, stride, places, slopes);
        self.statistics.derivatives += POINTS as u64;
        if !all_finite(slopes) {
            return Err(unsolved());
        }
        let Collocation {
            slopes,
            pull,
            correction,
            ..
        } = &mut self.collocation;
        let rows = correction.chunks_exact_mut(stride).zip(pull.chunks_exact(stride));
        for ((row, pull), weights) in rows.zip(&TO_PARTS) {
            combine(row, pull, 1.0, weights, slopes, stride);
        }
        let before = self.collocation.size;
        self.correct_parts();
        let Collocation { rounds, size, .. } = self.collocation;
        // The first correction is what f bends over the change itself; the bend of J, which the next one meets, is twice that.
        let rate = if rounds == 1 { 2.0 } else { 1.0 } * size / before;
        if !(size <= LEFT || rate < CONTRACTION) {
            return Err(unsolved());
        }
        // But what is stiff and turns hardly moves: sizes of states say nothing of its corrections, only earlier ones do.
        let step = self.underway.step;
        let rate = if rounds == 1 {
            rate.max(self.calm.rate_of(step))
        } else {
            (self.calm.rate, self.calm.rate_step) = (rate, step);
            rate
        };
        Ok(size <= LEFT || rate / (1.0 - rate) * size <= LEFT)
    }

    /// The points are found: the states at the end, and their error.
    fn end_of_points(&mut self) -> Advance {
        let (n, stride) = (self.dimension, self.stride);
        let (points, error) = self.trial_stages.split_at_mut(POINTS * stride);
        let error = &mut error[..stride];
        combine(error, &self.dx, REAL / self.underway.step, &ERROR, points, stride);
        self.problem.solve(&mut error[..n]);
        self.statistics.solves += 1;
        let last = &points[(POINTS - 1) * stride..];
        for ((new, old), change) in self.trial_x.iter_mut().zip(&self.x).zip(last) {
            *new = old + change;
        }
        let error = largest(error, &self.weights);
        if !all_finite(&self.trial_x) {
            return Err(not_finite(&self.trial_x[..n]));
        }
        if error > 1.0 && self.options.fixed_step.is_none() {
            return Ok(Some(error));
        }
        // What stuck may have broken loose between the ends, and be stuck again: the rounds hardly see it.
        let between = self
            .collocation
            .times
            .iter()
            .zip(self.collocation.places.chunks_exact(stride));
        for (time, place) in between.take(POINTS - 1).skip(BEGINNING) {
            self.kinks.peer(&mut self.problem, *time, &place[..n]);
            if self.kinks.break_loose() {
                return Err(unsolved());
            }
        }
        // Between its points it may have missed a kink: then it ends on the other side.
        self.peer_at_end();
        if self.kinks.cross() || self.kinks.break_away() {
            return Err(unsolved());
        }
        self.underway.error = error;
        self.want(self.underway.target, Phase::End);
        Ok(None)
    }
}
