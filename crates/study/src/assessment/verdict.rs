//! The verdicts on limits over all speeds of a regime, and its worst run.

use serde::Serialize;

use super::Assessed;
use super::dependence::Dependence;
use crate::records::Status;

/// The verdict on a limit in a regime and a condition, over all speeds.
#[derive(Clone, Debug, PartialEq)]
pub struct LimitVerdict {
    /// The number of the regime.
    pub regime: usize,
    /// The number of the condition.
    pub condition: usize,
    /// The number of the limit.
    pub limit: usize,
    /// The run with the least margin, its speed, value and margin; `None` if no run has one.
    pub worst: Option<WorstSpeed>,
    /// Speeds at which a wheel left its rail.
    pub derailed: Vec<String>,
    /// Speeds of runs without a value.
    pub missing: Vec<String>,
    /// The worst run of the speeds that were asked for, where others were added.
    pub asked: Option<WorstSpeed>,
    /// What it depends on.
    pub depends: Dependence,
}

/// The run that keeps a limit least.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct WorstSpeed {
    /// Its number.
    pub run: u64,
    /// Its speed as typed.
    pub speed: String,
    /// The measured value, in the limit's unit.
    pub value: f64,
    /// The limit for that run, in its unit.
    pub limit_value: f64,
    /// The margin, in parts of the limit.
    pub margin: f64,
    /// True if a wheel left its rail in that run: value and margin are of the part until then.
    pub until_derailed: bool,
}

impl LimitVerdict {
    /// Returns `kept`, `exceeded`, or `unknown` if a run is missing and none exceeds it.
    #[must_use]
    pub fn word(&self) -> &'static str {
        let exceeded = self.worst.as_ref().is_some_and(|own| own.margin < 0.0);
        if exceeded || !self.derailed.is_empty() {
            return "exceeded";
        }
        match self.missing.is_empty() && self.worst.is_some() {
            true => "kept",
            false => "unknown",
        }
    }
}

/// Returns the verdicts on the limits, by regime, condition and limit.
#[must_use]
pub fn verdicts(runs: &[Assessed]) -> Vec<LimitVerdict> {
    let mut found: Vec<LimitVerdict> = Vec::new();
    for run in runs {
        for check in &run.checks {
            let key = (run.regime, run.condition, check.limit);
            let place = found
                .iter()
                .position(|own| (own.regime, own.condition, own.limit) == key);
            let place = place.unwrap_or_else(|| {
                found.push(LimitVerdict {
                    regime: run.regime,
                    condition: run.condition,
                    limit: check.limit,
                    worst: None,
                    derailed: Vec::new(),
                    missing: Vec::new(),
                    asked: None,
                    depends: Dependence::default(),
                });
                found.len() - 1
            });
            let own = &mut found[place];
            if run.derailed {
                own.derailed.push(run.speed.clone());
            }
            let (Some(value), Some(limit_value), Some(margin)) = (check.value, check.allowed, check.margin)
            else {
                own.missing.push(run.speed.clone());
                continue;
            };
            let this = WorstSpeed {
                run: run.run,
                speed: run.speed.clone(),
                value,
                limit_value,
                margin,
                until_derailed: run.derailed,
            };
            let worse = |than: &Option<WorstSpeed>| than.as_ref().is_none_or(|worst| margin < worst.margin);
            if !run.refined && worse(&own.asked) {
                own.asked = Some(this.clone());
            }
            if worse(&own.worst) {
                own.worst = Some(this);
            }
        }
    }
    for own in &mut found {
        let same = own.asked.as_ref().map(|own| own.run) == own.worst.as_ref().map(|own| own.run);
        own.asked = own.asked.take().filter(|_| !same);
    }
    found.sort_by_key(|own| (own.condition, own.regime, own.limit));
    found
}

/// Returns the run of a regime that is worst: the first in which a wheel left its rail, else that with the
/// least margin, else the fastest; `None` if none is complete or derailed.
#[must_use]
pub fn worst_run(runs: &[Assessed], regime: usize) -> Option<&Assessed> {
    let complete = Status::Complete.name();
    let own = runs
        .iter()
        .filter(|run| run.regime == regime && (run.derailed || run.status == complete));
    let rank = |run: &Assessed| run.least().unwrap_or(f64::INFINITY);
    own.min_by(|a, b| {
        rank(a)
            .total_cmp(&rank(b))
            .then(b.speed_si.total_cmp(&a.speed_si))
    })
}
