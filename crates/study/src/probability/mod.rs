//! Probabilities: how likely a measure of a run is to lie beyond a limit where parameters are uncertain.
//!
//! A [`Plan`] (`docs/probability.md`) names a case, its uncertain parameters with a distribution and a
//! mark each, a measure with its limit, and a method. [`estimate`] knows nothing of cases: it asks an
//! evaluator for the answers at points of the standard normal space, so that closed forms test it.
//!
//! What is not known is never left out: a run without a value counts as beyond the limit in the upper bound
//! and as within it in the lower one; a derailment is beyond every limit.

pub mod bounds;
pub mod distribution;
pub mod indices;
pub mod normal;
mod plan;
mod read;
pub mod sample;
pub mod subset;
mod summary;

use serde::Serialize;

pub use plan::{Description, Plan, PlanLimit, Uncertain, UncertainValues};
pub use summary::{ProbabilityRun, ProbabilitySummary, UncertainSummary, UnknownReason};

use crate::car::limits::Bound;
use sample::Counting;
use subset::{Repeat, RepeatEnd, Subset};

/// The answer of a run.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Answer {
    /// The measure.
    Value(f64),
    /// A derailment: beyond every limit.
    Beyond,
    /// No value: it was refused, stopped, failed, or has no such measure.
    Unknown,
}

/// A function that answers at points of the standard normal space, in their order.
pub type Evaluate<'e, E> = dyn FnMut(&[Vec<f64>]) -> Result<Vec<Answer>, E> + 'e;

/// The limit of a measure.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Goal {
    /// Its side.
    pub bound: Bound,
    /// Its value, SI.
    pub limit: f64,
}

impl Goal {
    fn sign(self) -> f64 {
        match self.bound {
            Bound::AtMost => 1.0,
            Bound::AtLeast => -1.0,
        }
    }

    /// Returns the answer as a number that grows towards the limit and beyond.
    fn score(self, answer: Answer) -> f64 {
        match answer {
            Answer::Value(value) => self.sign() * value,
            Answer::Beyond | Answer::Unknown => f64::INFINITY,
        }
    }

    fn score_limit(self) -> f64 {
        self.sign() * self.limit
    }

    /// Returns the value of a score.
    fn value(self, score: f64) -> f64 {
        self.sign() * score
    }

    /// Returns whether an answer lies beyond the limit; `None` if that is not known.
    #[must_use]
    pub fn is_beyond(self, answer: Answer) -> Option<bool> {
        match answer {
            Answer::Unknown => None,
            _ => Some(self.score(answer) > self.score_limit()),
        }
    }
}

/// An interval.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Interval {
    /// Its lower end.
    pub low: f64,
    /// Its upper end.
    pub high: f64,
}

/// The method of an estimate.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
#[serde(tag = "method", rename_all = "snake_case")]
pub enum Estimator {
    /// Count what lies beyond the limit.
    Count {
        /// The choice of points.
        counting: Counting,
        /// Their number.
        runs: u64,
        /// The seed.
        seed: u64,
    },
    /// Subset simulation.
    Subset(Subset),
}

/// An estimate of a probability.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Estimate {
    /// The probability: the least and the greatest by what is not known.
    pub probability: Interval,
    /// The confidence bounds, which hold what is not known too.
    pub bounds: Interval,
    /// The confidence.
    pub confidence: f64,
    /// Number of runs.
    pub runs: u64,
    /// Number of runs beyond the limit, derailments too.
    pub beyond: u64,
    /// Number of runs that derailed.
    pub derailed: u64,
    /// Number of runs of which it is not known.
    pub unknown: u64,
    /// The least probability that the sample can tell from none.
    pub least_told: f64,
    /// Repeats of subset simulation.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub repeats: Vec<Repeat>,
}

impl Estimate {
    /// Returns whether the sample gives an upper bound only.
    #[must_use]
    pub fn is_upper_bound_only(&self) -> bool {
        self.bounds.low <= 0.0
    }
}

/// Estimates the probability to lie beyond a limit.
///
/// # Errors
/// The evaluator's.
pub fn estimate<E>(
    estimator: &Estimator,
    (dimensions, goal, confidence): (usize, Goal, f64),
    evaluate: &mut Evaluate<'_, E>,
) -> Result<Estimate, E> {
    let mut counts = Counts::default();
    let mut counted = |points: &[Vec<f64>]| {
        let answers = evaluate(points)?;
        for answer in &answers {
            counts.add(*answer, goal);
        }
        Ok(answers)
    };
    match estimator {
        Estimator::Count { counting, runs, seed } => {
            counted(&sample::points(*counting, *runs, dimensions, *seed))?;
            Ok(counts.estimate(confidence))
        }
        Estimator::Subset(settings) => {
            let repeats = subset::simulate(settings, goal, dimensions, &mut counted)?;
            Ok(counts.of_repeats(repeats, settings, confidence))
        }
    }
}

#[derive(Clone, Copy, Default)]
struct Counts {
    runs: u64,
    beyond: u64,
    derailed: u64,
    unknown: u64,
}

impl Counts {
    fn add(&mut self, answer: Answer, goal: Goal) {
        self.runs += 1;
        self.derailed += u64::from(answer == Answer::Beyond);
        match goal.is_beyond(answer) {
            Some(beyond) => self.beyond += u64::from(beyond),
            None => self.unknown += 1,
        }
    }

    fn estimate(self, confidence: f64) -> Estimate {
        let ends = [self.beyond, self.beyond + self.unknown];
        let mut bounds = bounds::counted(ends, self.runs, confidence);
        if ends == [0, 0] {
            // Nothing is below: the whole uncertainty lies above.
            bounds.high = bounds::none_seen(self.runs, confidence);
        }
        let share = |count: u64| count as f64 / self.runs as f64;
        Estimate {
            probability: Interval {
                low: share(ends[0]),
                high: share(ends[1]),
            },
            bounds,
            confidence,
            runs: self.runs,
            beyond: self.beyond,
            derailed: self.derailed,
            unknown: self.unknown,
            least_told: bounds::none_seen(self.runs, confidence),
            repeats: Vec::new(),
        }
    }

    fn of_repeats(self, repeats: Vec<Repeat>, settings: &Subset, confidence: f64) -> Estimate {
        if repeats
            .iter()
            .all(|own| own.end == RepeatEnd::Reached && own.levels.len() == 1)
        {
            // All samples are independent: they are counted.
            let counted = self.estimate(confidence);
            return Estimate { repeats, ..counted };
        }
        let read = |of: &dyn Fn(&Repeat) -> f64| -> Vec<f64> { repeats.iter().map(of).collect() };
        let (least, most) = (read(&|own| own.least), read(&|own| own.probability));
        let mean = |values: &[f64]| values.iter().sum::<f64>() / values.len() as f64;
        let mut bounds = bounds::mean_of_lognormal([&least, &most], confidence);
        // A threshold before the limit only bounds the probability from above, whatever the scatter says.
        let ended_before = repeats.iter().filter(|own| own.end != RepeatEnd::Reached);
        bounds.high = ended_before.fold(bounds.high, |high, own| high.max(own.probability));
        Estimate {
            probability: Interval {
                low: mean(&least),
                high: mean(&most),
            },
            bounds,
            confidence,
            runs: self.runs,
            beyond: self.beyond,
            derailed: self.derailed,
            unknown: self.unknown,
            least_told: libm::pow(1.0 / settings.parts as f64, settings.levels as f64),
            repeats,
        }
    }
}
