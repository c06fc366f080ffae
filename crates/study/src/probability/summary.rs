//! What a plan comes to: its probability with bounds, what matters, and what it presumes.

use serde::Serialize;

use super::indices::{RankCorrelation, SobolIndices, rank_correlation};
use super::plan::{Plan, Uncertain, UncertainValues};
use super::sample::Counting;
use super::{Answer, Estimate, Estimator};
use crate::car::limits::Mark;
use crate::records::Record;
use crate::summary::SummaryValue;

/// Bounds that are further apart than this factor are warned of.
const WIDE: f64 = 10.0;
/// Reasons of runs without a value that are told.
const REASONS: usize = 5;

/// A run: its point in the standard normal space, and its record.
#[derive(Clone, Debug, PartialEq)]
pub struct ProbabilityRun {
    /// The point.
    pub point: Vec<f64>,
    /// The record.
    pub record: Record,
}

/// An uncertain parameter in results.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct UncertainSummary {
    /// Its paths.
    pub paths: Vec<String>,
    /// Its distribution.
    pub values: UncertainValues,
    /// Where that is from: `source`, `derived`, `remembered`, `guess`.
    pub mark: &'static str,
    /// The source or the reason; may be empty.
    pub text: String,
    /// The rank correlation of the measure with it, from the independent runs.
    pub rank_correlation: Option<RankCorrelation>,
}

/// A reason why runs have no value.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct UnknownReason {
    /// The first run.
    pub run: u64,
    /// The number of runs with this reason.
    pub runs: u64,
    /// The reason.
    pub reason: String,
}

/// The result of a plan.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ProbabilitySummary {
    /// The program and its version.
    pub program: String,
    /// The plan's name.
    pub name: String,
    /// One line for people; may be empty.
    pub title: String,
    /// The case.
    pub case: String,
    /// The measure.
    pub measure: String,
    /// What it is.
    pub measure_text: String,
    /// The side of the limit: `at_most`, `at_least`.
    pub bound: &'static str,
    /// The limit.
    pub limit: SummaryValue,
    /// The rule that sets it; may be empty.
    pub rule: String,
    /// The method and its numbers.
    pub method: Estimator,
    /// The estimate.
    pub estimate: Estimate,
    /// The upper bound over the lower one; missing where there is only an upper one.
    pub bounds_ratio: Option<f64>,
    /// The uncertain parameters.
    pub uncertain: Vec<UncertainSummary>,
    /// Sobol' indices of the measure, if they were asked for; one an uncertain parameter.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub sobol: Option<SobolIndices>,
    /// Runs of the indices, which the probability does not count.
    pub index_runs: u64,
    /// Why runs have no value: the first reasons.
    pub reasons: Vec<UnknownReason>,
    /// What to be careful about.
    pub warnings: Vec<String>,
    /// What the number presumes.
    pub assumptions: Vec<String>,
}

impl ProbabilitySummary {
    /// Returns the summary of an estimate from its runs, in their order; those of indices come last.
    #[must_use]
    pub fn new(
        plan: &Plan,
        estimate: Estimate,
        sobol: Option<SobolIndices>,
        runs: &[ProbabilityRun],
    ) -> Self {
        let independent = runs.iter().take(plan.independent_runs() as usize);
        let known: Vec<(&[f64], f64)> = independent
            .filter_map(|run| match plan.answer(&run.record) {
                Answer::Value(value) => Some((run.point.as_slice(), value)),
                Answer::Beyond | Answer::Unknown => None,
            })
            .collect();
        let correlation = |place: usize| {
            let pairs: Vec<(f64, f64)> = known
                .iter()
                .map(|(point, value)| (point[place], *value))
                .collect();
            rank_correlation(&pairs, plan.confidence)
        };
        let uncertain = plan
            .uncertain
            .iter()
            .enumerate()
            .map(|(place, own)| UncertainSummary {
                paths: own.paths.clone(),
                values: own.values.clone(),
                mark: own.mark.name(),
                text: own.text.clone(),
                rank_correlation: correlation(place),
            });
        let goal = plan.limit.goal;
        let bounds = estimate.bounds;
        Self {
            program: format!("wedgelab {}", env!("CARGO_PKG_VERSION")),
            name: plan.name.clone(),
            title: plan.title.clone(),
            case: plan.base.name().to_owned(),
            measure: plan.limit.measure.clone(),
            measure_text: plan.limit.text.clone(),
            bound: goal.bound.name(),
            limit: SummaryValue {
                value: plan.limit.value,
                unit: plan.limit.unit.clone(),
            },
            rule: plan.limit.rule.clone(),
            method: plan.estimator,
            bounds_ratio: (bounds.low > 0.0).then(|| bounds.high / bounds.low),
            uncertain: uncertain.collect(),
            warnings: warnings(plan, &estimate, sobol.as_ref()),
            assumptions: assumptions(plan),
            index_runs: runs.len() as u64 - estimate.runs,
            estimate,
            sobol,
            reasons: reasons(plan, runs),
        }
    }
}

/// Returns the first reasons why runs have no value, each once.
fn reasons(plan: &Plan, runs: &[ProbabilityRun]) -> Vec<UnknownReason> {
    let mut all: Vec<UnknownReason> = Vec::new();
    let unknown = runs
        .iter()
        .filter(|run| plan.answer(&run.record) == Answer::Unknown);
    for record in unknown.map(|run| &run.record) {
        let reason = match record.reason.as_str() {
            "" => format!("the run has no {}", plan.limit.measure),
            reason => format!("{}: {reason}", record.status.name()),
        };
        if let Some(own) = all.iter_mut().find(|own| own.reason == reason) {
            own.runs += 1;
        } else if all.len() < REASONS {
            all.push(UnknownReason {
                run: record.number,
                runs: 1,
                reason,
            });
        }
    }
    all
}

fn warnings(plan: &Plan, estimate: &Estimate, sobol: Option<&SobolIndices>) -> Vec<String> {
    let mut all = Vec::new();
    let mut warn = |text: String| all.push(text);
    if estimate.unknown > 0 {
        warn(format!(
            "{} of {} runs have no value: they count as within the limit in the lower bound and as beyond it \
             in the upper one",
            estimate.unknown, estimate.runs
        ));
    }
    if estimate.derailed > 0 {
        warn(format!(
            "{} runs derailed: they count as beyond the limit",
            estimate.derailed
        ));
    }
    let ratio = estimate.bounds.high / estimate.bounds.low;
    if !estimate.is_upper_bound_only() && ratio > WIDE {
        warn(format!(
            "the bounds span a factor of {ratio:.0}: this says an order of magnitude at best; take more runs"
        ));
    }
    let stopped = |end| estimate.repeats.iter().filter(|own| own.end == end).count();
    for (end, text) in [
        (
            super::subset::RepeatEnd::Runs,
            "used up `most_runs` before the limit: give more",
        ),
        (
            super::subset::RepeatEnd::Levels,
            "used up its `levels` before the limit: the probability is smaller than they tell",
        ),
        (
            super::subset::RepeatEnd::Stalled,
            "found no better samples: the measure does not change gradually; take method = \"monte_carlo\"",
        ),
    ] {
        let count = stopped(end);
        if count > 0 {
            warn(format!("{count} of {} repeats {text}", estimate.repeats.len()));
        }
    }
    if let Some(own) = sobol.filter(|own| own.left_out > 0) {
        warn(format!(
            "{} base samples of the indices have a run without a value or a derailment and are left out",
            own.left_out
        ));
    }
    if sobol.is_none() && plan.indices > 0 {
        warn("there are no indices: the measure does not vary, or too few runs have it".to_owned());
    }
    all
}

fn assumptions(plan: &Plan) -> Vec<String> {
    let guesses: Vec<&str> = plan
        .uncertain
        .iter()
        .filter(|own| matches!(own.mark, Mark::Guess | Mark::Remembered))
        .map(Uncertain::name)
        .collect();
    let mut all = vec![
        "uncertain parameters are independent of each other; those under `also` are equal".to_owned(),
        "everything else is as the case has it, without any scatter; errors of the model are not in the \
         probability"
            .to_owned(),
        "the probability is that of one run of this case, not of a mile or a year".to_owned(),
    ];
    if !guesses.is_empty() {
        all.push(format!(
            "distributions that are guessed or remembered: {}; the probability is no better than they are",
            guesses.join(", ")
        ));
    }
    const AS_IF: &str = ", as if the runs were independent:";
    all.push(match &plan.estimator {
        Estimator::Count { counting, .. } => match counting {
            Counting::MonteCarlo => "bounds after Clopper and Pearson".to_owned(),
            Counting::LatinHypercube => {
                format!("bounds after Clopper and Pearson{AS_IF} a Latin hypercube is at least as even")
            }
            Counting::Sobol => format!(
                "bounds after Clopper and Pearson{AS_IF} points of the Sobol' sequence are evener, so that \
                 the bounds are wider than needed"
            ),
        },
        Estimator::Subset(own) => format!(
            "bounds from the scatter of {} independent subset simulations, lognormal; regions beyond the \
             limit that the first samples do not hint at are missed",
            own.repeats
        ),
    });
    all
}
