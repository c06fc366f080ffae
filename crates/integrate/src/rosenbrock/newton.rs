//! One attempt of a diagonally implicit method: its stages are found by Newton's method with a search along its corrections.
//!
//! It begins where [`super::guess`] says. A stage is the zero of `F(z) = (base - z)/(hγ) + f(t, z)`; a correction is `d = (I/(hγ) - J)⁻¹ F(z)`. The matrix is one that is there
//! and fits, where the problem tells of that ([`super::kept`]), else that at the guess (of the first stage, where nothing is told), kept while the next
//! correction, by the same matrix, is a fifth of the last one or smaller. Where a correction
//! gets across a kink - slip that would reverse, a contact that would open -, the next one points back. Then the zero of their
//! product is looked for between both ends (where slip reverses, [`super::reversal`]; regula falsi, Illinois), and the matrix is formed there: without that search, Newton's
//! method goes to and fro between both sides of a reversal, and steps must be as short as the layer of friction is thin.
//!
//! Natural corrections and monotonicity: P. Deuflhard, *Newton Methods for Nonlinear Problems*, Springer 2004, section 3.

use super::Integrator;
use super::attempt::{Attempt, Failure, Outcome, not_finite, stage_time};
use super::guess::{Behind, Way};
use super::kept::{Fit, Kept};
use super::reversal::Reversal;
use crate::error::Reason;
use crate::kinks::KinkSigns;
use crate::problem::Problem;
use crate::stages::{
    add, add_difference, all_finite, combine, largest, largest_if_finite, leading_states, scale,
    scale_difference,
};

/// The last correction by a fresh matrix, relative to the tolerance. What it leaves is smaller still.
const LAST_CORRECTION: f64 = 0.03;
/// The same where a problem tells layers, in widths of a layer.
const LAST_IN_LAYER: f64 = 0.4;
/// How much smaller what a correction by an old matrix leaves must be, as far as the last two tell;
const SURE: f64 = 0.01;
/// and where the matrix does not fit.
const VERY_SURE: f64 = 0.001;
/// The matrix is kept while corrections shrink by this factor.
const CONTRACTION: f64 = 0.2;
/// How far the next correction may point back, and where a search along it ends.
const BACK: f64 = 0.1;
/// Most matrices a stage, and most evaluations a search, the first of them where a reversal seems to lie.
const MOST_ROUNDS: u32 = 8;
const MOST_IN_SEARCH: u32 = 12;
const MOST_AIMED: u32 = 4;

/// What a round of Newton's method came to.
enum Round {
    /// The argument is the stage.
    Found,
    /// The argument is another guess.
    OtherGuess,
    /// The argument is where a correction leads.
    Corrected,
}

/// A search along a correction: fractions of it, and what the next correction is along it there.
#[derive(Clone, Copy, Debug, Default)]
struct Search {
    low: (f64, f64),
    high: (f64, f64),
    at: f64,
    /// Which end was moved last: the value of one that stays twice is halved.
    moved_low: Option<bool>,
    count: u32,
    /// What it is that the correction gets across.
    reversal: Option<Reversal>,
}

impl Search {
    /// Between a correction's start and its end.
    fn up_to(along: f64) -> Self {
        Self {
            low: (0.0, 1.0),
            high: (1.0, along),
            at: 1.0,
            ..Self::default()
        }
    }

    /// The next fraction, after `along` was found at the last one.
    fn next(&mut self, along: f64) -> f64 {
        let ((a, fa), (b, fb)) = (self.low, self.high);
        let aimed = match &self.reversal {
            Some(reversal) if self.count < MOST_AIMED => reversal.rest(self.at, along),
            _ => None,
        };
        self.count += 1;
        self.at = aimed
            .filter(|at| a < *at && *at < b)
            .unwrap_or((a * fb - b * fa) / (fb - fa));
        self.at
    }

    /// Notes what was found; whether the search is over.
    fn note(&mut self, along: f64) -> bool {
        if along.abs() < BACK || self.count >= MOST_IN_SEARCH {
            return true;
        }
        let moves_low = along > 0.0;
        if moves_low {
            self.low = (self.at, along);
            if self.moved_low == Some(true) {
                self.high.1 *= 0.5;
            }
        } else {
            self.high = (self.at, along);
            if self.moved_low == Some(false) {
                self.low.1 *= 0.5;
            }
        }
        self.moved_low = Some(moves_low);
        false
    }
}

/// A stage being found.
#[derive(Debug, Default)]
pub(super) struct Newton {
    stage: usize,
    /// Its time.
    pub time: f64,
    rounds: u32,
    /// The size of the correction; 1: so small that nothing is left to do.
    size: f64,
    search: Search,
    pub kept: Kept,
    /// Whether the matrix was kept because it fits at the guess.
    fits: bool,
    /// Whether the guess is the cubic; then `next` is the straight one.
    curved: bool,
    /// The last step, if it ended smoothly.
    knows_behind: bool,
    behind: Behind,
    /// What tells kinks at both ends of a correction.
    ends: [KinkSigns; 2],
    base: Vec<f64>,
    /// Where the correction starts.
    from: Vec<f64>,
    correction: Vec<f64>,
    next: Vec<f64>,
    /// Reciprocals of the last correction's admissible sizes.
    weights: Vec<f64>,
    /// Reciprocals of admissible errors.
    pub controlled: Vec<f64>,
}

impl Newton {
    /// For a problem; vectors have `stride` entries.
    pub fn new<P: Problem>(problem: &P, tolerance: f64, stride: usize) -> Self {
        let zero = || vec![0.0; stride];
        let (mut weights, mut controlled) = (zero(), zero());
        let kept = Kept::new(problem, stride);
        let scales = problem.scales();
        for (weight, scale) in weights.iter_mut().zip(scales).take(problem.read_states()) {
            *weight = 1.0 / (LAST_CORRECTION * tolerance * scale);
        }
        for (weight, bound) in weights.iter_mut().zip(problem.layer_bounds()) {
            *weight = weight.max(1.0 / (LAST_IN_LAYER * bound));
        }
        for (weight, scale) in controlled.iter_mut().zip(scales).take(problem.displacements()) {
            *weight = 1.0 / (tolerance * scale);
        }
        Self {
            kept,
            ends: [KinkSigns::of(problem), KinkSigns::of(problem)],
            behind: Behind {
                step: 0.0,
                x: zero(),
                first: zero(),
            },
            base: zero(),
            from: zero(),
            correction: zero(),
            next: zero(),
            weights,
            controlled,
            ..Self::default()
        }
    }

    /// Whether the last stage needed no matrix but the one that fitted where it began.
    fn was_smooth(&self) -> bool {
        self.fits && self.rounds == 1
    }

    /// Takes the step that was made, from states `x` by the change `first` at the slope there.
    pub fn leave_behind(&mut self, step: f64, x: &[f64], first: &[f64]) {
        self.knows_behind = self.was_smooth();
        if self.knows_behind {
            self.behind.step = step;
            self.behind.x.copy_from_slice(x);
            self.behind.first.copy_from_slice(first);
        }
    }

    /// The last step, for a saved run, with vectors of `n` entries.
    pub fn behind(&self, n: usize) -> Option<Behind> {
        let Behind { step, x, first } = &self.behind;
        self.knows_behind.then(|| Behind {
            step: *step,
            x: x[..n].to_vec(),
            first: first[..n].to_vec(),
        })
    }

    /// Has the last step as a saved run had it.
    pub fn restore_behind(&mut self, saved: Option<&Behind>) {
        self.knows_behind = saved.is_some();
        if let Some(saved) = saved {
            let n = saved.x.len();
            self.behind.step = saved.step;
            self.behind.x[..n].copy_from_slice(&saved.x);
            self.behind.first[..n].copy_from_slice(&saved.first);
        }
    }

    /// Nothing is known any more of the right-hand side before.
    pub fn forget(&mut self) {
        self.kept.forget();
        self.knows_behind = false;
    }

    /// The next correction's part along this one, relative to it.
    fn along(&self) -> f64 {
        let (mut product, mut square) = (0.0, 0.0);
        for ((d, next), weight) in self.correction.iter().zip(&self.next).zip(&self.weights) {
            let d = d * weight;
            product += d * (next * weight);
            square += d * d;
        }
        product / square
    }
}

impl<P: Problem> Integrator<P> {
    /// The attempt by a diagonally implicit method.
    #[inline(never)]
    pub(super) fn attempt_by_newton(&mut self) -> Outcome {
        let (stride, last) = (self.stride, self.tableau.stages() - 2);
        self.trial_method = self.tableau;
        scale(&mut self.trial_stages[..stride], self.attempt.step, &self.dx);
        for stage in 1..=last {
            self.guess_stage(stage);
            self.find_stage()?;
            let found = &mut self.trial_stages[stage * stride..][..stride];
            let inverse = 1.0 / self.tableau.gamma;
            scale_difference(found, inverse, &self.argument, &self.newton.base);
        }
        self.trial_x.copy_from_slice(&self.argument);
        if !all_finite(&self.trial_x) {
            return Err(not_finite(&self.trial_x[..self.dimension]));
        }
        let last = &self.trial_stages[last * stride..][..stride];
        scale(&mut self.trial_dx, 1.0 / self.attempt.step, last);
        self.write_error();
        Ok(largest(self.last_trial_stage(), &self.newton.controlled))
    }

    /// Begins a stage: its base, its time, and as argument a guess of its states.
    fn guess_stage(&mut self, i: usize) {
        let Attempt {
            step: length, target, ..
        } = self.attempt;
        let (stride, tableau) = (self.stride, self.tableau);
        let newton = &mut self.newton;
        let smooth = newton.was_smooth();
        (newton.stage, newton.rounds) = (i, 0);
        newton.time = stage_time(tableau.alpha[i], self.time, length, target);
        let done = &self.trial_stages[..i * stride];
        combine(&mut newton.base, &self.x, 1.0, tableau.a[i], done, stride);
        // From the last step, then from the stage before, where the argument is. Where nothing is known of the last step, its slope is.
        let (way, cubic) = if i == 1 {
            self.argument.copy_from_slice(&self.x);
            let Behind { step, x, first } = &newton.behind;
            let step = if newton.knows_behind { *step } else { length };
            let way = Way {
                start: x,
                first: (first, 1.0),
                last: (&self.dx, step),
                further: tableau.alpha[1] * length / step,
                by_slope: true,
            };
            (way, newton.knows_behind)
        } else {
            let reached = tableau.alpha[i - 1];
            let way = Way {
                start: &self.x,
                first: (&done[..stride], reached),
                last: (&done[(i - 1) * stride..], reached),
                further: (tableau.alpha[i] - reached) / reached,
                by_slope: false,
            };
            (way, smooth)
        };
        // Of what is only integrated no guess is needed.
        let read = ..leading_states(&self.problem);
        newton.curved = way.go_on(
            cubic,
            &newton.weights,
            &mut self.argument[read],
            &mut newton.next[read],
        );
    }

    /// The slope at the argument.
    fn evaluate_stage(&mut self) {
        let n = self.dimension;
        self.problem
            .derivative(self.newton.time, &self.argument[..n], &mut self.slope[..n]);
        self.statistics.derivatives += 1;
    }

    /// Goes from the guess to where the stage's equations hold: the argument.
    #[inline(never)]
    fn find_stage(&mut self) -> Result<(), Failure> {
        self.evaluate_stage();
        loop {
            match self.newton_round()? {
                Round::Found => return Ok(()),
                Round::OtherGuess => self.evaluate_stage(),
                Round::Corrected => {
                    if self.follow_corrections() {
                        return Ok(());
                    }
                }
            }
        }
    }

    /// Goes where corrections by the same matrix lead while they shrink; whether the stage is found. Else a matrix is to be formed at
    /// the argument, whose slope is there.
    fn follow_corrections(&mut self) -> bool {
        let size = loop {
            self.evaluate_stage();
            let size = self.next_correction();
            let newton = &self.newton;
            let leaves =
                |part: f64| size <= part || (size < newton.size && size * size <= part * newton.size);
            let doubtful = newton.fits && !leaves(VERY_SURE);
            if leaves(SURE) && (!doubtful || self.still_fits()) {
                add(&mut self.argument, 1.0, &self.newton.next);
                return true;
            }
            if size < CONTRACTION * self.newton.size {
                self.correct(size);
            } else {
                break size;
            }
        };
        let mut along = self.along(size);
        if along >= -BACK {
            return false;
        }
        self.newton.search = Search::up_to(along);
        let reversal = self.reversal();
        self.newton.search.reversal = reversal;
        loop {
            let newton = &mut self.newton;
            let fraction = newton.search.next(along);
            self.argument.copy_from_slice(&newton.from);
            add(&mut self.argument, fraction, &newton.correction);
            self.evaluate_stage();
            let size = self.next_correction();
            along = self.along(size);
            if self.newton.search.note(along) {
                return false;
            }
        }
    }

    /// The next correction's part along this one; of one that is not finite (its size is infinite): straight back.
    fn along(&self, size: f64) -> f64 {
        if size.is_finite() {
            self.newton.along()
        } else {
            -1.0
        }
    }

    /// What the last correction, whose end is the argument, gets across.
    fn reversal(&mut self) -> Option<Reversal> {
        let (n, time) = (self.dimension, self.newton.time);
        let Newton { ends, from, .. } = &mut self.newton;
        let [start, end] = ends;
        if end.directions.is_empty() {
            return None;
        }
        self.problem.kinks(time, &self.argument[..n], end);
        self.problem.kinks(time, &from[..n], start);
        Reversal::first(start, end)
    }

    /// 1/(hγ).
    fn newton_shift(&self) -> f64 {
        1.0 / (self.tableau.gamma * self.attempt.step)
    }

    /// The next correction, at the argument by the matrix that is there; its size, infinite where anything is not finite.
    fn next_correction(&mut self) -> f64 {
        let shift = self.newton_shift();
        let newton = &mut self.newton;
        add_difference(&mut newton.next, &self.slope, shift, &newton.base, &self.argument);
        self.problem.solve(&mut newton.next[..self.dimension]);
        self.statistics.solves += 1;
        largest_if_finite(&newton.next, &newton.weights)
    }

    /// A correction from the argument, by the matrix there.
    fn newton_round(&mut self) -> Result<Round, Failure> {
        let n = self.dimension;
        let finite = all_finite(&self.slope);
        let curved = std::mem::take(&mut self.newton.curved);
        if !finite && !curved {
            return Err(not_finite(&self.slope[..n]));
        }
        let rounds = self.newton.rounds + 1;
        if rounds > MOST_ROUNDS {
            return Err(Failure {
                reason: Reason::Unsolved,
                index: None,
            });
        }
        let fit = if rounds == 1 {
            self.fit_here()
        } else {
            // The one in use has failed.
            self.look_here(self.newton.time);
            Fit::Other
        };
        if curved && (!finite || fit != Fit::Same) {
            let newton = &self.newton;
            let read = ..leading_states(&self.problem);
            self.argument[read].copy_from_slice(&newton.next[read]);
            return Ok(Round::OtherGuess);
        }
        self.newton.rounds = rounds;
        let known = self.have_matrix(fit)?;
        let size = self.next_correction();
        let newton = &mut self.newton;
        if size == f64::INFINITY {
            return Err(not_finite(&newton.next[..n]));
        }
        if size <= 1.0 && known {
            add(&mut self.argument, 1.0, &newton.next);
            return Ok(Round::Found);
        }
        self.correct(size);
        Ok(Round::Corrected)
    }

    /// Has a matrix for a round, factored, where so much is known of the one in use; whether it is known to be that of the place, or about that.
    fn have_matrix(&mut self, fit: Fit) -> Result<bool, Failure> {
        // A later stage begins with the matrix of the one before.
        let form = match fit {
            Fit::Same => false,
            Fit::Other => true,
            Fit::Unknown => self.newton.stage == 1,
        };
        self.newton.fits = fit == Fit::Same;
        if form {
            self.form_matrix();
        }
        self.factor_kept(self.newton_shift())?;
        Ok(form || self.newton.fits)
    }

    /// Goes where the next correction, of this size, leads.
    fn correct(&mut self, size: f64) {
        let newton = &mut self.newton;
        newton.size = size;
        newton.from.copy_from_slice(&self.argument);
        std::mem::swap(&mut newton.correction, &mut newton.next);
        add(&mut self.argument, 1.0, &newton.correction);
    }
}
