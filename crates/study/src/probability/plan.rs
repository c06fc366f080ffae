//! A plan: what is uncertain, and the probability that is asked for.

use std::path::Path;

use quantity::{Kind, System as Units};
use serde::Serialize;

use super::distribution::{Distribution, discrete};
use super::{Answer, Estimator, Goal, read};
use crate::car::limits::{Bound, Mark};
use crate::case::CaseError;
use crate::design::{Value, fingerprint};
use crate::measures::Definitions;
use crate::models::{AnyCase, CaseSource};
use crate::records::{self, Record, Status};
use crate::remote_run::RemoteRun;

/// Version of what a plan computes: it grows when the same document asks for other runs.
const PLAN_VERSION: u32 = 1;

/// The values that an uncertain parameter may have.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(untagged)]
pub enum UncertainValues {
    /// Numbers of one unit.
    Numbers {
        /// Their distribution.
        #[serde(flatten)]
        of: Distribution,
        /// Their unit as typed; empty for pure numbers.
        unit: String,
    },
    /// Some values, each with its weight.
    Discrete {
        /// The values.
        values: Vec<Value>,
        /// Their weights.
        weights: Vec<f64>,
    },
}

/// An uncertain parameter, and those that take the same value with it.
#[derive(Clone, Debug, PartialEq)]
pub struct Uncertain {
    /// The paths, as `--set` takes them; the first one names it.
    pub paths: Vec<String>,
    /// Its values.
    pub values: UncertainValues,
    /// Where its distribution is from.
    pub mark: Mark,
    /// The source or the reason in words; may be empty for a guess.
    pub text: String,
}

impl Uncertain {
    /// Returns its name: the first path.
    #[must_use]
    pub fn name(&self) -> &str {
        self.paths.first().map_or("", String::as_str)
    }

    /// Returns its value at a standard normal value.
    #[must_use]
    pub fn at(&self, u: f64) -> Value {
        match &self.values {
            UncertainValues::Numbers { of, unit } => Value::Number {
                value: of.at(u),
                unit: unit.clone(),
            },
            UncertainValues::Discrete { values, weights } => {
                let found = values.get(discrete(weights, u)).cloned();
                found.unwrap_or(Value::Toml(String::new()))
            }
        }
    }

    /// Returns the unit of its numbers; `None` if it has others.
    #[must_use]
    pub fn unit(&self) -> Option<&str> {
        match &self.values {
            UncertainValues::Numbers { unit, .. } => Some(unit),
            UncertainValues::Discrete { .. } => None,
        }
    }

    /// Returns the settings of one of its values, as `--set` takes them.
    fn overrides(&self, value: &Value) -> impl Iterator<Item = String> {
        let paths = self.paths.iter();
        paths.map(move |path| format!("{path}={}", value.to_toml(path)))
    }
}

/// The limit of a measure.
#[derive(Clone, Debug, PartialEq)]
pub struct PlanLimit {
    /// The measure's name.
    pub measure: String,
    /// What it is, a few words.
    pub text: String,
    /// Its kind of quantity.
    pub kind: Kind,
    /// Its side and its value, SI.
    pub goal: Goal,
    /// Its value as typed.
    pub value: f64,
    /// Its unit as typed; empty for pure numbers.
    pub unit: String,
    /// The rule that sets it: set of limits, name, source; empty if it is the plan's own.
    pub rule: String,
}

/// A plan.
#[derive(Clone, Debug)]
pub struct Plan {
    /// A name that can be the name of a folder.
    pub name: String,
    /// One line for people; may be empty.
    pub title: String,
    /// The uncertain parameters.
    pub uncertain: Vec<Uncertain>,
    /// Values that hold for all runs, as `--set` takes them.
    pub set: Vec<String>,
    /// The limit.
    pub limit: PlanLimit,
    /// The method.
    pub estimator: Estimator,
    /// Base samples of Sobol' indices; zero: none are asked for.
    pub indices: u64,
    /// The confidence of bounds.
    pub confidence: f64,
    /// The case without anything uncertain.
    pub base: AnyCase,
    pub(super) measures: Definitions,
    pub(super) source: CaseSource,
}

/// The values that decide the runs of a plan; two plans with the same description have the same runs. A limit
/// decides nothing where runs are only counted.
#[derive(Clone, Debug, Serialize)]
pub struct Description<'p> {
    version: u32,
    program: String,
    method: &'p Estimator,
    uncertain: Vec<(&'p [String], &'p UncertainValues)>,
    #[serde(skip_serializing_if = "Option::is_none")]
    limit: Option<(&'p str, &'p str, f64)>,
    indices: u64,
    set: &'p [String],
    case: String,
}

impl Plan {
    /// Reads a plan from a file.
    ///
    /// # Errors
    /// It cannot be read, or something in it or in its case is wrong: all mistakes are reported together.
    pub fn read(path: &Path) -> Result<Self, CaseError> {
        read::file(path)
    }

    /// Reads a plan from a text that `file` names in messages; the case is looked for in `folder`.
    ///
    /// # Errors
    /// As [`Plan::read`].
    pub fn parse(file: &str, text: &str, folder: &Path) -> Result<Self, CaseError> {
        read::text(file, text, folder)
    }

    /// Returns the units of results.
    #[must_use]
    pub fn units(&self) -> Units {
        self.base.units()
    }

    /// Returns the greatest number of runs.
    #[must_use]
    pub fn most_runs(&self) -> u64 {
        let sample = match &self.estimator {
            Estimator::Count { runs, .. } => *runs,
            Estimator::Subset(own) => own.most_runs,
        };
        sample + self.indices * (self.uncertain.len() as u64 + 2)
    }

    /// Returns the number of the first runs, whose points are independent of each other's results.
    #[must_use]
    pub fn independent_runs(&self) -> u64 {
        match &self.estimator {
            Estimator::Count { runs, .. } => *runs,
            Estimator::Subset(own) => (own.samples * own.repeats) as u64,
        }
    }

    /// Returns the seed.
    #[must_use]
    pub fn seed(&self) -> u64 {
        match &self.estimator {
            Estimator::Count { seed, .. } => *seed,
            Estimator::Subset(own) => own.seed,
        }
    }

    /// Returns the values of the uncertain parameters at a point.
    #[must_use]
    pub fn values(&self, point: &[f64]) -> Vec<Value> {
        self.uncertain
            .iter()
            .zip(point)
            .map(|(own, u)| own.at(*u))
            .collect()
    }

    /// Returns the case at a point.
    ///
    /// # Errors
    /// The values do not go together.
    pub fn case(&self, point: &[f64]) -> Result<AnyCase, CaseError> {
        let all: Vec<String> = self.set.iter().cloned().chain(self.overrides(point)).collect();
        self.source.case(&all)
    }

    /// Returns the settings of a point, as `--set` takes them.
    fn overrides(&self, point: &[f64]) -> Vec<String> {
        let values = self.values(point);
        let uncertain = self.uncertain.iter().zip(&values);
        uncertain.flat_map(|(own, value)| own.overrides(value)).collect()
    }

    /// Returns the run of a point for a worker elsewhere.
    #[must_use]
    pub fn elsewhere(&self, number: u64, point: &[f64]) -> RemoteRun {
        RemoteRun {
            source: self.source.clone(),
            common: self.set.clone(),
            own: self.overrides(point),
            number,
            fingerprint: self.fingerprint(),
        }
    }

    /// Runs the case at a point. Whatever goes wrong, it is a record.
    #[must_use]
    pub fn run(&self, number: u64, point: &[f64]) -> Record {
        records::run_made(&self.measures, number, || self.case(point))
    }

    /// Returns the measure that a record has of the limited quantity, SI.
    #[must_use]
    pub fn measured(&self, record: &Record) -> Option<f64> {
        self.measures.get(&record.measures, &self.limit.measure)
    }

    /// Returns the answer of a record.
    #[must_use]
    pub fn answer(&self, record: &Record) -> Answer {
        match record.status {
            Status::Derailed => Answer::Beyond,
            Status::Complete => self.measured(record).map_or(Answer::Unknown, Answer::Value),
            Status::Refused | Status::Stopped | Status::Failed => Answer::Unknown,
        }
    }

    /// Returns everything that decides its runs.
    #[must_use]
    pub fn description(&self) -> Description<'_> {
        let limit = || {
            let goal = self.limit.goal;
            (self.limit.measure.as_str(), goal.bound.name(), goal.limit)
        };
        Description {
            version: PLAN_VERSION,
            program: format!("wedgelab {}", env!("CARGO_PKG_VERSION")),
            method: &self.estimator,
            uncertain: self
                .uncertain
                .iter()
                .map(|own| (own.paths.as_slice(), &own.values))
                .collect(),
            limit: matches!(self.estimator, Estimator::Subset(_)).then(limit),
            indices: self.indices,
            set: &self.set,
            case: self.source.description(&self.base),
        }
    }

    /// Returns the description in short: other plans have another number, as good as certainly.
    #[must_use]
    pub fn fingerprint(&self) -> u64 {
        fingerprint(&self.description())
    }

    /// Returns the side of the limit at which values are beyond it, in words.
    #[must_use]
    pub fn beyond_in_words(&self) -> &'static str {
        match self.limit.goal.bound {
            Bound::AtMost => "above",
            Bound::AtLeast => "below",
        }
    }
}
