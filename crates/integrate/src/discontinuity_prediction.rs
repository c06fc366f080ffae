//! Prediction of discontinuities by extrapolating the dense output of the last step beyond its end.
//!
//! A step across a discontinuity has an error of low order, and a Rosenbrock step has the Jacobian matrix of
//! the wrong side: it is rejected, several times, until the step has shrunk to the discontinuity. A step that
//! ends just after a discontinuity, or just before a regularization zone in which a slip reverses, costs
//! nothing, and the next step begins on the right side. A prediction chooses only the length of the next
//! step; the error is controlled as in any other. Decision 0012.

use crate::dense_output::DenseOutput;
use crate::discontinuity::{DiscontinuityFunctions, Prediction, square};
use crate::problem::{Problem, ProblemStructure};
use crate::root_search::RootSearch;
use crate::tuning::discontinuity as tuning;
use numerics::lanes::LANES;

/// Evaluates the discontinuity functions of a problem and predicts their zeros.
///
/// Functions are numbered: first all values, then for each slip its component along its direction less
/// [`tuning::ZONE_EDGE`], then for each slip the square of its size (only to tell reversal from turning).
#[derive(Clone, Debug)]
pub(crate) struct DiscontinuityPredictor {
    /// At the end of the current attempt, or on the extrapolation.
    trial: DiscontinuityFunctions,
    /// At the end and at the start of the last step.
    here: DiscontinuityFunctions,
    before: DiscontinuityFunctions,
    /// Size of the smallest slip here.
    smallest_slip: f64,
    /// Unit vectors of the slips here; zero: the slip is not watched.
    directions: Vec<[f64; 2]>,
    /// The functions here.
    functions: Vec<f64>,
    search: RootSearch,
    /// States on the extrapolation; only the dynamic ones are valid.
    x: Vec<f64>,
    dimension: usize,
    /// Number of dynamic states, padded.
    leading: usize,
}

/// A bracket around the first zero, in lengths of the last step from its start, and the function that has it.
struct Located {
    low: f64,
    high: f64,
    index: usize,
}

impl DiscontinuityPredictor {
    pub fn new(structure: &ProblemStructure) -> Self {
        let (values, slips) = (structure.discontinuity_values, structure.slips);
        let zeros = DiscontinuityFunctions::zeros(values, slips);
        let functions = values + 2 * slips;
        Self {
            here: zeros.clone(),
            before: zeros.clone(),
            trial: zeros,
            smallest_slip: f64::INFINITY,
            directions: vec![[0.0; 2]; slips],
            functions: vec![0.0; functions],
            search: RootSearch::new(functions),
            x: vec![0.0; structure.dimension().next_multiple_of(LANES)],
            dimension: structure.dimension(),
            leading: structure.padded_dynamic_states(),
        }
    }

    /// Returns whether the problem has discontinuity functions.
    pub fn is_active(&self) -> bool {
        !self.functions.is_empty()
    }

    /// Evaluates the functions at the end of a step. The methods below refer to this point as "here".
    pub fn evaluate<P: Problem>(&mut self, problem: &mut P, time: f64, x: &[f64]) {
        if !self.is_active() {
            return;
        }
        std::mem::swap(&mut self.here, &mut self.before);
        problem.discontinuities(time, x, &mut self.here);
        self.update_directions();
    }

    fn update_directions(&mut self) {
        let mut smallest = f64::INFINITY;
        for (direction, slip) in self.directions.iter_mut().zip(&self.here.slips) {
            let square = square(slip);
            // A slip that is not a number is ignored.
            smallest = smallest.min(square);
            *direction = if square > tuning::WATCHED * tuning::WATCHED {
                let size = square.sqrt();
                slip.map(|component| component / size)
            } else {
                [0.0; 2]
            };
        }
        self.smallest_slip = smallest.sqrt();
        combine(&self.here, &self.directions, &mut self.functions);
    }

    /// Evaluates the functions at the end of an attempt that begins here.
    pub fn evaluate_trial<P: Problem>(&mut self, problem: &mut P, time: f64, x: &[f64]) {
        if self.is_active() {
            problem.discontinuities(time, x, &mut self.trial);
        }
    }

    /// Returns whether a stick-to-slip transition lies between here and the trial.
    ///
    /// The Jacobian matrix at the start of the step knows only the sticking friction, which damps the slip
    /// like a weld. The stages of a Rosenbrock step and its error estimate are damped with it.
    pub fn trial_leaves_stick(&self) -> bool {
        let mut pairs = self.here.slips.iter().zip(&self.trial.slips);
        pairs.any(|(from, to)| {
            let (from, to) = (square(from).sqrt(), square(to).sqrt());
            from < tuning::STICKING && to > (from + tuning::RELEASE_GROWTH).max(tuning::RELEASE_FACTOR * from)
        })
    }

    /// Returns whether friction held a slip here or at the start of the last step, if only by the tail of its
    /// law; true if the problem has no slips.
    pub fn any_slip_held(&self) -> bool {
        let mut all = self.here.slips.iter().chain(&self.before.slips);
        self.here.slips.is_empty() || all.any(|slip| square(slip) < tuning::TAIL * tuning::TAIL)
    }

    /// Returns the factor by which error bounds in zones widen here, see
    /// [`ProblemStructure::zone_error_bounds`].
    pub fn bound_widening(&self) -> f64 {
        (self.smallest_slip * tuning::BOUND_WIDENING).max(1.0)
    }

    /// Returns the first discontinuity within `length` of the end of a step whose scaled error was `error`.
    pub fn predict<P: Problem>(
        &mut self,
        problem: &mut P,
        dense: &DenseOutput<'_>,
        length: f64,
        error: f64,
    ) -> Option<Prediction> {
        if !self.is_active() || dense.step <= 0.0 {
            return None;
        }
        let mut horizon = (length / dense.step).min(tuning::HORIZON);
        if error * fifth_power(1.0 + horizon) > tuning::MAXIMUM_ERROR {
            horizon = libm::pow(tuning::MAXIMUM_ERROR / error, 0.2) - 1.0;
        }
        loop {
            let Located { low, high, index } = self.locate(problem, dense, 1.0 + horizon, error)?;
            let values = self.here.values.len();
            let at = |theta: f64| dense.start + theta * dense.step;
            let Some(slip) = index.checked_sub(values) else {
                let end = (high + overshoot(error, fifth_power(high))).max(1.0 + tuning::NEAREST);
                return Some(Prediction {
                    time: at(end),
                    zone_step: None,
                });
            };
            if !self.reverses(slip) {
                // It only turns.
                self.directions[slip] = [0.0; 2];
                continue;
            }
            // The zero of the slip, by the line between the ends of the bracket.
            let (at_low, at_high) = (self.search.low()[index], self.search.high()[index]);
            let fall = (at_low - at_high) / (high - low);
            let to_zero = (at_low + tuning::ZONE_EDGE) / fall * dense.step;
            return (to_zero > tuning::NEAREST * dense.step && to_zero.is_finite()).then(|| {
                if low < 1.0 + tuning::NEAREST_ZONE {
                    // The next step starts in the zone.
                    let first = (low - 1.0) * dense.step + to_zero;
                    Prediction {
                        time: dense.end,
                        zone_step: Some(first),
                    }
                } else {
                    Prediction {
                        time: at(low),
                        zone_step: Some(to_zero),
                    }
                }
            });
        }
    }

    /// Returns whether a slip passes near zero in the bracket, instead of only turning.
    fn reverses(&self, slip: usize) -> bool {
        let along = self.here.values.len() + slip;
        let size = along + self.here.slips.len();
        let across = |functions: &[f64]| {
            let component = functions[along] + tuning::ZONE_EDGE;
            functions[size] - component * component
        };
        let largest = across(self.search.low()).max(across(self.search.high()));
        largest < tuning::REVERSAL_WIDTH * tuning::REVERSAL_WIDTH
    }

    /// Evaluates the functions on the extrapolation, for the search; returns whether one has changed its
    /// sign.
    fn evaluate_at<P: Problem>(&mut self, problem: &mut P, dense: &DenseOutput<'_>, theta: f64) -> bool {
        dense.evaluate(theta, &mut self.x[..self.leading]);
        let time = dense.start + theta * dense.step;
        problem.discontinuities(time, &self.x[..self.dimension], &mut self.trial);
        combine(&self.trial, &self.directions, self.search.values_mut());
        let functions = self.trial.values.len() + self.trial.slips.len();
        any_sign_change(&self.functions[..functions], self.search.values_mut())
    }

    /// Returns a short bracket around the first zero up to `high`.
    fn locate<P: Problem>(
        &mut self,
        problem: &mut P,
        dense: &DenseOutput<'_>,
        high: f64,
        error: f64,
    ) -> Option<Located> {
        self.search.clear();
        if !self.evaluate_at(problem, dense, high) {
            return None;
        }
        self.search.set_high(high);
        self.search.values_mut().copy_from_slice(&self.functions);
        self.search.set_low(1.0);
        combine(&self.before, &self.directions, self.search.values_mut());
        self.search.set_outside(0.0);
        for _ in 0..tuning::MAXIMUM_ITERATIONS {
            let (low, high) = self.search.ends();
            let width = overshoot(error, fifth_power(high));
            if high - low <= width {
                break;
            }
            let (_, expected) = self.first_zero(|index| self.search.zero(index))?;
            let theta = self.search.next_point(expected, width);
            if self.evaluate_at(problem, dense, theta) {
                self.search.set_high(theta);
            } else {
                self.search.set_low(theta);
            }
        }
        let (low, high) = self.search.ends();
        let line = |index| {
            let (at_low, at_high): (f64, f64) = (self.search.low()[index], self.search.high()[index]);
            at_low / (at_low - at_high)
        };
        let (index, _) = self.first_zero(line)?;
        Some(Located { low, high, index })
    }

    /// Returns the function that changes its sign in the bracket and has the first zero, and that zero.
    #[inline]
    fn first_zero(&self, zero: impl Fn(usize) -> f64) -> Option<(usize, f64)> {
        let mut first: Option<(usize, f64)> = None;
        let functions = self.here.values.len() + self.here.slips.len();
        let ends = self.functions.iter().zip(self.search.high());
        for (index, (now, high)) in ends.take(functions).enumerate() {
            if now * high < 0.0 {
                let found = zero(index);
                if first.is_none_or(|(_, smallest)| found < smallest) {
                    first = Some((index, found));
                }
            }
        }
        first
    }
}

/// Writes all functions, numbered as in [`DiscontinuityPredictor`].
fn combine(from: &DiscontinuityFunctions, directions: &[[f64; 2]], functions: &mut [f64]) {
    let (values, rest) = functions.split_at_mut(from.values.len());
    let (components, squares) = rest.split_at_mut(from.slips.len());
    values.copy_from_slice(&from.values);
    let targets = components.iter_mut().zip(squares);
    for (((component, size), direction), slip) in targets.zip(directions).zip(&from.slips) {
        let beyond_edge = direction[0] * slip[0] + direction[1] * slip[1] - tuning::ZONE_EDGE;
        let watched = (direction[0] != 0.0) | (direction[1] != 0.0);
        *component = if watched { beyond_edge } else { 1.0 };
        *size = square(slip);
    }
}

/// Returns the distance after a discontinuity at which a step should end, in lengths of the last step, if the
/// error of that step has grown by `growth`.
fn overshoot(error: f64, growth: f64) -> f64 {
    tuning::OVERSHOOT * (tuning::OVERSHOOT_SAFETY * error * growth).clamp(tuning::MINIMUM_OVERSHOOT, 1.0)
}

fn fifth_power(x: f64) -> f64 {
    x * x * (x * x) * x
}

fn any_sign_change(now: &[f64], then: &[f64]) -> bool {
    now.iter().zip(then).any(|(now, then)| now * then < 0.0)
}
