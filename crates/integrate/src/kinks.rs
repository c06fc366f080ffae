//! Foreseeing kinks: where the right-hand side is going to bend, by the dense output of the last step continued beyond its end.
//!
//! A step across a kink has an error of low order, and a linearly implicit one has the Jacobian matrix of the wrong side: it is
//! rejected, several times, until the step has shrunk to the kink. A step that ends just behind the kink (or just before a thin layer in
//! which a direction reverses) costs nothing, and the next one begins on the right side. What is foreseen only chooses the length of
//! the next step: errors are controlled as ever.

use serde::{Deserialize, Serialize};

use crate::lanes::LANES;
use crate::problem::Problem;
use crate::stages::{Dense, leading_states};

/// How far the dense output is continued at most, in lengths of its step.
const REACH: f64 = 6.0;
/// A continued dense output is trusted while its error, that of the step times the fifth power of its reach, is below this.
const TRUST: f64 = 100.0;
/// How far behind a kink a step lands at most, and how closely it is located, in lengths of the last step; less where the
/// continued dense output is more exact than the tolerance.
const OVERSHOOT: f64 = 2e-3;
/// The least part of it.
const LEAST_OVERSHOOT: f64 = 1e-6;
/// A landing nearer than this to where we are, in lengths of the last step, is not worth a step of its own.
const NEAR_KINK: f64 = 1e-4;
/// The same before a layer.
const NEAR_LAYER: f64 = 0.05;
/// Rounds of the search.
const ROUNDS: usize = 15;
/// A direction that reverses: the layer begins at this size.
const EDGE: f64 = 4.0;
/// An error of a speed may have this part of the slowest slip.
const SLACK: f64 = 0.05;
/// Behind a layer the direction is larger than this.
const OUT: f64 = 3.0;
/// It does reverse if all of it has become smaller than this when its part along the old direction comes to the edge.
const NARROW: f64 = 5.0 * EDGE;

/// What a problem tells of its kinks at a time and a state, see [`Problem::kinks`].
#[derive(Clone, Debug, Default)]
pub struct KinkSigns {
    /// Smooth functions across whose zeros the right-hand side has a kink.
    pub values: Vec<f64>,
    /// Plane vectors around whose zero, in a circle of radius 1, the right-hand side changes as across a jump (the slip of a contact
    /// point over the reference speed of its friction law); not a number where there is nothing to reverse.
    pub directions: Vec<[f64; 2]>,
}

/// What lies ahead.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub(crate) enum Ahead {
    /// A kink: the next step should end at this time, just behind it.
    Kink(f64),
    /// A thin layer: the next step should end at this time, before it.
    Layer(f64, Layer),
    /// A thin layer right ahead.
    InLayer(Layer),
}

/// A thin layer in which a direction reverses.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub(crate) struct Layer {
    /// Length of the first step in it.
    pub length: f64,
    /// Number of the direction.
    direction: usize,
    /// Where it points before.
    from: [f64; 2],
}

/// A layer on the way through.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub(crate) struct Passage {
    pub layer: Layer,
    /// Length of the steps before it.
    pub planned: f64,
}

/// Scratch memory.
#[derive(Clone, Debug)]
pub(crate) struct Kinks {
    signs: KinkSigns,
    /// Unit vectors of the directions at the start; zero: not to be looked at.
    towards: Vec<[f64; 2]>,
    now: Vec<f64>,
    low: Vec<f64>,
    high: Vec<f64>,
    trial: Vec<f64>,
    /// States on the continued dense output; only the leading ones, padded, are brought up to date.
    x: Vec<f64>,
    dimension: usize,
    leading: usize,
}

impl Kinks {
    pub fn new<P: Problem>(problem: &P) -> Self {
        let (values, directions) = problem.kink_counts();
        let zero = || vec![0.0; values + directions];
        Self {
            signs: KinkSigns {
                values: vec![0.0; values],
                directions: vec![[0.0; 2]; directions],
            },
            towards: vec![[0.0; 2]; directions],
            now: zero(),
            low: zero(),
            high: zero(),
            trial: zero(),
            x: vec![0.0; problem.dimension().next_multiple_of(LANES)],
            dimension: problem.dimension(),
            leading: leading_states(problem),
        }
    }

    /// Whether the problem tells of any.
    pub fn are_told(&self) -> bool {
        !self.now.is_empty()
    }

    /// Looks at a place, the end of a step: where the functions are, and which way the directions point. Before [`Kinks::slack`],
    /// [`Kinks::is_behind`] and [`Kinks::foresee`].
    pub fn look<P: Problem>(&mut self, problem: &mut P, time: f64, x: &[f64]) {
        if !self.are_told() {
            return;
        }
        problem.kinks(time, x, &mut self.signs);
        for (towards, direction) in self.towards.iter_mut().zip(&self.signs.directions) {
            let size = size(direction);
            *towards = if size > 2.0 * EDGE {
                direction.map(|part| part / size)
            } else {
                [0.0; 2]
            };
        }
        self.project();
        self.now.copy_from_slice(&self.trial);
    }

    /// By how much bounds on errors in layers widen at the place that was looked at last: see [`Problem::layer_bounds`].
    pub fn slack(&self) -> f64 {
        // `min` passes over what is not a number.
        let slowest = self
            .signs
            .directions
            .iter()
            .map(size)
            .fold(f64::INFINITY, f64::min);
        (slowest * SLACK).max(1.0)
    }

    /// Whether a layer lies behind: what reversed in it is large again, and points elsewhere.
    pub fn is_behind(&self, layer: &Layer) -> bool {
        let direction = &self.signs.directions[layer.direction];
        let size = size(direction);
        size > OUT && direction[0] * layer.from[0] + direction[1] * layer.from[1] < 0.5 * size
    }

    /// Where the next step should end if there is a kink within `length` of the end of a step, whose scaled error was `error`.
    pub fn foresee<P: Problem>(
        &mut self,
        problem: &mut P,
        dense: &Dense<'_>,
        length: f64,
        error: f64,
    ) -> Option<Ahead> {
        if !self.are_told() || dense.step <= 0.0 {
            return None;
        }
        let mut reach = (length / dense.step).min(REACH);
        if error * fifth(1.0 + reach) > TRUST {
            reach = libm::pow(TRUST / error, 0.2) - 1.0;
        }
        loop {
            let (low, high, index) = self.locate(problem, dense, 1.0 + reach, error)?;
            let Some(direction) = index.checked_sub(self.signs.values.len()) else {
                let end = (high + overshoot(error, high)).max(1.0 + NEAR_KINK);
                return Some(Ahead::Kink(dense.start + end * dense.step));
            };
            self.evaluate(problem, dense, low);
            if size(&self.signs.directions[direction]) < NARROW {
                // Along the line between the ends of the bracket.
                let fall = (self.low[index] - self.high[index]) / (high - low);
                let middle = (self.low[index] + EDGE) / fall * dense.step;
                let layer = |length| Layer {
                    length,
                    direction,
                    from: self.towards[direction],
                };
                return if !(middle > NEAR_KINK * dense.step && middle.is_finite()) {
                    None
                } else if low < 1.0 + NEAR_LAYER {
                    Some(Ahead::InLayer(layer((low - 1.0) * dense.step + middle)))
                } else {
                    Some(Ahead::Layer(dense.start + low * dense.step, layer(middle)))
                };
            }
            // It only turns.
            self.towards[direction] = [0.0; 2];
        }
    }

    /// The functions at a place on the continued dense output, to `trial`.
    fn evaluate<P: Problem>(&mut self, problem: &mut P, dense: &Dense<'_>, theta: f64) {
        dense.evaluate(theta, &mut self.x[..self.leading]);
        let time = dense.start + theta * dense.step;
        problem.kinks(time, &self.x[..self.dimension], &mut self.signs);
        self.project();
    }

    fn project(&mut self) {
        let (values, directions) = self.trial.split_at_mut(self.signs.values.len());
        values.copy_from_slice(&self.signs.values);
        for ((part, towards), direction) in directions
            .iter_mut()
            .zip(&self.towards)
            .zip(&self.signs.directions)
        {
            let along = towards[0] * direction[0] + towards[1] * direction[1];
            *part = if *towards == [0.0; 2] { 1.0 } else { along - EDGE };
        }
    }

    /// A short bracket around the first zero up to `high`, and the function that has it.
    fn locate<P: Problem>(
        &mut self,
        problem: &mut P,
        dense: &Dense<'_>,
        mut high: f64,
        error: f64,
    ) -> Option<(f64, f64, usize)> {
        let mut low = 1.0;
        self.low.copy_from_slice(&self.now);
        self.evaluate(problem, dense, high);
        std::mem::swap(&mut self.high, &mut self.trial);
        self.first_zero()?;
        for round in 0..ROUNDS {
            let width = overshoot(error, high);
            if high - low <= width {
                break;
            }
            // The first zero of straight lines, once a little behind it and once before, so that the bracket closes; then the middle.
            let fraction = self.first_zero().map_or(0.5, |(_, fraction)| fraction);
            let guess = low + (high - low) * fraction;
            let theta = match round % 3 {
                0 => guess + 0.5 * width,
                1 => guess - 0.5 * width,
                _ => 0.5 * (low + high),
            };
            let theta = theta.clamp(low + 0.25 * width, high - 0.25 * width);
            self.evaluate(problem, dense, theta);
            let end = if crossed(&self.now, &self.trial) {
                high = theta;
                &mut self.high
            } else {
                low = theta;
                &mut self.low
            };
            std::mem::swap(end, &mut self.trial);
        }
        self.first_zero().map(|(index, _)| (low, high, index))
    }

    /// The function whose line between the ends of the bracket comes to zero first, and where, as a fraction of the bracket.
    fn first_zero(&self) -> Option<(usize, f64)> {
        let mut first: Option<(usize, f64)> = None;
        for (index, ((now, low), high)) in self.now.iter().zip(&self.low).zip(&self.high).enumerate() {
            if now * high < 0.0 {
                let fraction = low / (low - high);
                if first.is_none_or(|(_, least)| fraction < least) {
                    first = Some((index, fraction));
                }
            }
        }
        first
    }
}

/// How far behind a kink at a place on the continued dense output of a step with this error a step should land, in lengths of the step.
fn overshoot(error: f64, theta: f64) -> f64 {
    OVERSHOOT * (4.0 * error * fifth(theta)).clamp(LEAST_OVERSHOOT, 1.0)
}

/// The length of a plane vector.
fn size([a, b]: &[f64; 2]) -> f64 {
    (a * a + b * b).sqrt()
}

fn fifth(x: f64) -> f64 {
    x * x * (x * x) * x
}

fn crossed(now: &[f64], then: &[f64]) -> bool {
    now.iter().zip(then).any(|(now, then)| now * then < 0.0)
}
