//! Foreseeing kinks: where the right-hand side is going to bend, by the dense output of the last step continued beyond its end.
//!
//! A step across a kink has an error of low order, and a linearly implicit one has the Jacobian matrix of the wrong side: it is
//! rejected, several times, until the step has shrunk to the kink. A step that ends just behind the kink (or just before a thin layer in
//! which a direction reverses) costs nothing, and the next one begins on the right side. What is foreseen only chooses the length of
//! the next step: errors are controlled as ever.

use serde::{Deserialize, Serialize};

use crate::error::SetupError;
use crate::lanes::LANES;
use crate::methods::tableau::Family;
use crate::problem::Problem;
use crate::search::Search;
use crate::stages::{Dense, leading_states};
use crate::state::check_length;

/// How far the dense output is continued at most, in lengths of its step.
const REACH: f64 = 6.0;
/// The same of an explicit step: the first one behind a kink may be much shorter than the next.
const EXPLICIT_REACH: f64 = 60.0;
/// A continued dense output is trusted while its error, that of the step times a power of its reach, is below this.
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
/// By how much faster than in the last step, an explicit one, what tells kinks may go in the next.
const HASTE: f64 = 4.0;
/// Rounds of the search.
const ROUNDS: usize = 15;
/// The part of the planned step that a step to a kink may have in one go: where it lies farther away, it is enough to know about where.
pub(crate) const WHOLE_LANDING: f64 = 0.7;
/// About: the place of a distant kink may change by this part of its distance from one round to the next.
const CERTAIN: f64 = 0.01;
/// A direction that reverses: the layer begins at this size.
const EDGE: f64 = 4.0;
/// An error of a speed may have this part of the slowest slip.
const SLACK: f64 = 0.05;
/// A direction breaks away if it comes from below this size and grows by this much and by this factor.
const HELD: f64 = 3.0;
const GROWTH: (f64, f64) = (1.0, 1.5);
/// Below this size the tail of a layer still holds a direction.
const TAIL: f64 = 12.0;
/// Behind a layer the direction is larger than this.
const OUT: f64 = 3.0;
/// It does reverse if what is across its old direction is smaller than this when its part along that comes to the edge.
const NARROW: f64 = 5.0 * EDGE;
/// A direction that changed by more than this in a step is still on its way through its layer.
const MOVING: f64 = 0.5;

/// What a problem tells of its kinks at a time and a state, see [`Problem::kinks`].
#[derive(Clone, Debug, Default)]
pub struct KinkSigns {
    /// Smooth functions across whose zeros the right-hand side has a kink.
    pub values: Vec<f64>,
    /// Plane vectors around whose zero, in a circle of radius 1, the right-hand side changes as across a jump (the slip of a contact
    /// point over the reference speed of its friction law); not a number where there is nothing to reverse.
    pub directions: Vec<[f64; 2]>,
}

impl KinkSigns {
    /// Room for what a problem tells.
    pub(crate) fn of<P: Problem>(problem: &P) -> Self {
        let (values, directions) = problem.kink_counts();
        Self {
            values: vec![0.0; values],
            directions: vec![[0.0; 2]; directions],
        }
    }
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
    /// The part of the direction along [`Layer::from`] where it begins.
    size: f64,
    /// Number of the direction.
    direction: usize,
    /// Where it points before.
    from: [f64; 2],
}

impl Ahead {
    /// Whether this can lie ahead of a problem that tells so many directions.
    pub fn check(&self, directions: usize) -> Result<(), SetupError> {
        let (time, layer) = match self {
            Self::Kink(time) => (*time, None),
            Self::Layer(time, layer) => (*time, Some(layer)),
            Self::InLayer(layer) => (0.0, Some(layer)),
        };
        if !time.is_finite() {
            let name = "ahead";
            return Err(SetupError::Damaged { name, value: time });
        }
        layer.map_or(Ok(()), |layer| layer.check(directions))
    }
}

impl Layer {
    fn check(&self, directions: usize) -> Result<(), SetupError> {
        if self.direction >= directions {
            let (what, found) = (
                "directions, of which a layer names one by its number,",
                self.direction,
            );
            return Err(SetupError::Dimension {
                what,
                expected: directions,
                found,
            });
        }
        check_length("layer.length", self.length)?;
        let [x, y] = self.from;
        let parts = [("layer.size", self.size), ("layer.from", x), ("layer.from", y)];
        match parts.into_iter().find(|(_, value)| !value.is_finite()) {
            Some((name, value)) => Err(SetupError::Damaged { name, value }),
            None => Ok(()),
        }
    }
}

/// A layer on the way through.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub(crate) struct Passage {
    pub layer: Layer,
    /// Length of the steps before it.
    pub planned: f64,
}

impl Passage {
    /// Whether a problem that tells so many directions can be on this way.
    pub fn check(&self, directions: usize) -> Result<(), SetupError> {
        check_length("passage.planned", self.planned)?;
        self.layer.check(directions)
    }
}

/// Scratch memory.
#[derive(Clone, Debug)]
pub(crate) struct Kinks {
    signs: KinkSigns,
    /// What was looked at last, and before: at the end and at the start of a step.
    here: KinkSigns,
    before: KinkSigns,
    /// The size of the smallest direction here.
    slowest: f64,
    /// Unit vectors of the directions here; zero: not to be looked at.
    towards: Vec<[f64; 2]>,
    /// Values, parts of the directions along `towards` beyond the edge, squares of their sizes: here, and along the dense output.
    now: Vec<f64>,
    search: Search,
    /// States on the continued dense output; only the leading ones, padded, are brought up to date.
    x: Vec<f64>,
    dimension: usize,
    leading: usize,
}

impl Kinks {
    pub fn new<P: Problem>(problem: &P) -> Self {
        let (values, directions) = problem.kink_counts();
        let signs = KinkSigns::of(problem);
        let functions = values + 2 * directions;
        Self {
            here: signs.clone(),
            before: signs.clone(),
            signs,
            slowest: f64::INFINITY,
            towards: vec![[0.0; 2]; directions],
            now: vec![0.0; functions],
            search: Search::new(functions),
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
        std::mem::swap(&mut self.here, &mut self.before);
        problem.kinks(time, x, &mut self.here);
        self.point();
    }

    /// The same, where the place was peered at last.
    pub fn look_again(&mut self) {
        if !self.are_told() {
            return;
        }
        std::mem::swap(&mut self.here, &mut self.before);
        std::mem::swap(&mut self.here, &mut self.signs);
        self.point();
    }

    /// Notes which way the directions point.
    fn point(&mut self) {
        let mut least = f64::INFINITY;
        for (towards, direction) in self.towards.iter_mut().zip(&self.here.directions) {
            let square = square(direction);
            // passes over what is not a number
            least = least.min(square);
            *towards = if square > 4.0 * EDGE * EDGE {
                let size = square.sqrt();
                direction.map(|part| part / size)
            } else {
                [0.0; 2]
            };
        }
        self.slowest = least.sqrt();
        project(&self.here, &self.towards, &mut self.now);
    }

    /// Peers at the end of an attempt from the place that was looked at last. Before [`Kinks::cross`] and [`Kinks::break_away`].
    pub fn peer<P: Problem>(&mut self, problem: &mut P, time: f64, x: &[f64]) {
        if self.are_told() {
            problem.kinks(time, x, &mut self.signs);
        }
    }

    /// Whether a kink or the edge of a layer lies between the place that was looked at last and the one peered at.
    pub fn cross(&mut self) -> bool {
        self.are_told() && self.compare()
    }

    /// Whether a direction that its layer held at the place that was looked at last breaks away on the way to the one peered at.
    ///
    /// The Jacobian matrix of the start knows only the hold, which damps a direction as stiffly as a weld; the stages and the estimate of the error
    /// of a linearly implicit step are damped with it.
    pub fn break_away(&self) -> bool {
        let mut pairs = self.here.directions.iter().zip(&self.signs.directions);
        pairs.any(|(from, to)| {
            let (from, to) = (square(from).sqrt(), square(to).sqrt());
            from < HELD && to > (from + GROWTH.0).max(GROWTH.1 * from)
        })
    }

    /// Whether a layer held a direction, if only by its tail, at the place that was looked at last or at the one before; true where the problem
    /// tells of no directions.
    pub fn hold(&self) -> bool {
        let mut all = self.here.directions.iter().chain(&self.before.directions);
        self.here.directions.is_empty() || all.any(|direction| square(direction) < TAIL * TAIL)
    }

    /// By how much bounds on errors in layers widen at the place that was looked at last: see [`Problem::layer_bounds`].
    pub fn slack(&self) -> f64 {
        (self.slowest * SLACK).max(1.0)
    }

    /// Whether a layer that was foreseen here is here: what was continued too far foresees others.
    pub fn has_come(&self, layer: &Layer) -> bool {
        square(&self.here.directions[layer.direction]).sqrt() < NARROW.max(2.0 * layer.size)
    }

    /// Whether what reverses in a layer, or comes to stick in it, is still on its way.
    pub fn moves(&self, layer: &Layer) -> bool {
        let [here, before] = [&self.here, &self.before].map(|signs| signs.directions[layer.direction]);
        square(&[here[0] - before[0], here[1] - before[1]]) > MOVING * MOVING
    }

    /// Whether a layer lies behind: what reversed in it is large again, and points elsewhere.
    pub fn is_behind(&self, layer: &Layer) -> bool {
        let direction = &self.here.directions[layer.direction];
        let size = square(direction).sqrt();
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
        let explicit = dense.tableau.family == Family::Explicit;
        let most = if explicit { EXPLICIT_REACH } else { REACH };
        let mut reach = (length / dense.step).min(most);
        if error * fifth(1.0 + reach) > TRUST {
            reach = libm::pow(TRUST / error, 0.2) - 1.0;
        }
        if explicit && self.are_far(reach) {
            return None;
        }
        let far = 1.0 + WHOLE_LANDING * (length / dense.step);
        loop {
            let Found { low, high, index } = self.locate(problem, dense, 1.0 + reach, far, error)?;
            let values = self.here.values.len();
            let Some(direction) = index.checked_sub(values) else {
                let end = (high + overshoot(error, fifth(high))).max(1.0 + NEAR_KINK);
                return Some(Ahead::Kink(dense.start + end * dense.step));
            };
            let number = values + self.here.directions.len() + direction;
            let across = |at: &[f64]| {
                let along = at[index] + EDGE;
                at[number] - along * along
            };
            if across(self.search.low()).max(across(self.search.high())) < NARROW * NARROW {
                // Along the line between the ends of the bracket.
                let (at_low, at_high) = (self.search.low()[index], self.search.high()[index]);
                let fall = (at_low - at_high) / (high - low);
                let middle = (at_low + EDGE) / fall * dense.step;
                let layer = |length| Layer {
                    length,
                    size: at_low + EDGE,
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

    /// Whether no function can come to zero within a part of the last step, which is short beside everything that answers, if none goes on more
    /// than a few times as fast as in it.
    fn are_far(&self, reach: f64) -> bool {
        let most = HASTE * reach;
        let mut values = self.here.values.iter().zip(&self.before.values);
        let directions = self.here.directions.iter().zip(&self.before.directions);
        // What is not a number is not far.
        values.all(|(now, before)| now.abs() > most * (now - before).abs())
            && directions.zip(&self.towards).all(|((now, before), towards)| {
                let change = towards[0] * (now[0] - before[0]) + towards[1] * (now[1] - before[1]);
                let along = towards[0] * now[0] + towards[1] * now[1] - EDGE;
                *towards == [0.0; 2] || along > most * change.abs()
            })
    }

    /// The functions at a place on the continued dense output, to the search; whether one of them has changed its sign.
    fn evaluate<P: Problem>(&mut self, problem: &mut P, dense: &Dense<'_>, theta: f64) -> bool {
        dense.evaluate(theta, &mut self.x[..self.leading]);
        let time = dense.start + theta * dense.step;
        problem.kinks(time, &self.x[..self.dimension], &mut self.signs);
        self.compare()
    }

    /// The functions by the signs just evaluated, to the search; whether one of them has changed its sign.
    fn compare(&mut self) -> bool {
        project(&self.signs, &self.towards, self.search.next());
        let functions = self.signs.values.len() + self.signs.directions.len();
        crossed(&self.now[..functions], self.search.next())
    }

    /// A short bracket around the first zero up to `high`, and the function that has it; the place alone if it is certain to lie
    /// beyond `far`.
    fn locate<P: Problem>(
        &mut self,
        problem: &mut P,
        dense: &Dense<'_>,
        high: f64,
        far: f64,
        error: f64,
    ) -> Option<Found> {
        self.search.clear();
        if !self.evaluate(problem, dense, high) {
            return None;
        }
        self.search.put_high(high);
        self.search.next().copy_from_slice(&self.now);
        self.search.put_low(1.0);
        project(&self.before, &self.towards, self.search.next());
        self.search.put_aside(0.0);
        let mut last = f64::INFINITY;
        for _ in 0..ROUNDS {
            let (low, high) = self.search.ends();
            let width = overshoot(error, fifth(high));
            if high - low <= width {
                break;
            }
            let (index, expected) = self.first_zero(|index| self.search.zero(index))?;
            let reached = expected - 1.0;
            if expected > far && (expected - last).abs() < CERTAIN * reached && !self.reverses() {
                let high = expected;
                return Some(Found { low, high, index });
            }
            last = expected;
            let theta = self.search.place(expected, width);
            if self.evaluate(problem, dense, theta) {
                self.search.put_high(theta);
            } else {
                self.search.put_low(theta);
            }
        }
        let (low, high) = self.search.ends();
        let line = |index| {
            let (at_low, at_high): (f64, f64) = (self.search.low()[index], self.search.high()[index]);
            at_low / (at_low - at_high)
        };
        let (index, _) = self.first_zero(line)?;
        Some(Found { low, high, index })
    }

    /// The function that changes its sign in the bracket and comes to zero first, and where.
    #[inline]
    fn first_zero(&self, zero: impl Fn(usize) -> f64) -> Option<(usize, f64)> {
        let mut first: Option<(usize, f64)> = None;
        let functions = self.here.values.len() + self.here.directions.len();
        let ends = self.now.iter().zip(self.search.high());
        for (index, (now, high)) in ends.take(functions).enumerate() {
            if now * high < 0.0 {
                let place = zero(index);
                if first.is_none_or(|(_, least)| place < least) {
                    first = Some((index, place));
                }
            }
        }
        first
    }

    /// Whether a direction reverses in the bracket.
    fn reverses(&self) -> bool {
        let values = self.here.values.len();
        crossed(&self.now[values..], &self.search.high()[values..])
    }
}

/// Where the first zero lies.
struct Found {
    low: f64,
    high: f64,
    /// The function that has it.
    index: usize,
}

/// Values, parts of the directions along `towards` beyond the edge, squares of the sizes of directions.
fn project(signs: &KinkSigns, towards: &[[f64; 2]], functions: &mut [f64]) {
    let (values, rest) = functions.split_at_mut(signs.values.len());
    let (parts, squares) = rest.split_at_mut(signs.directions.len());
    values.copy_from_slice(&signs.values);
    let targets = parts.iter_mut().zip(squares);
    for (((part, size), towards), direction) in targets.zip(towards).zip(&signs.directions) {
        let along = towards[0] * direction[0] + towards[1] * direction[1];
        *part = if *towards == [0.0; 2] { 1.0 } else { along - EDGE };
        *size = square(direction);
    }
}

/// How far behind a kink a step should land where an error of the last step has grown by `spread`, in lengths of that step.
fn overshoot(error: f64, spread: f64) -> f64 {
    OVERSHOOT * (4.0 * error * spread).clamp(LEAST_OVERSHOOT, 1.0)
}

/// The square of the length of a plane vector.
pub(crate) fn square([a, b]: &[f64; 2]) -> f64 {
    a * a + b * b
}

fn fifth(x: f64) -> f64 {
    x * x * (x * x) * x
}

fn crossed(now: &[f64], then: &[f64]) -> bool {
    now.iter().zip(then).any(|(now, then)| now * then < 0.0)
}
