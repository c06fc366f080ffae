//! The second start of runs near limits.
//!
//! What wedges have locked in by friction lasts until they slip, so that a result near a limit may hang on
//! the start of its run. The run that keeps a limit least is therefore computed once more where its margin is
//! within [`NEAR`]: from the shaken car, or from the equilibrium if its own start is shaken.

use car::{StartKind, Wheels};
use serde::Serialize;

use super::{Certificate, LimitVerdict};
use crate::car::CarCase;
use crate::car::locked_in::name;
use crate::models::AnyCase;
use crate::records::{self, Record, Status};

/// Margin, in parts of the limit, up to which a result is near it, kept or not: a choice.
pub const NEAR: f64 = 0.15;

/// The same run from another start.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct OtherStart {
    /// The start of the run itself: `equilibrium`, `nominal` or `shaken`.
    pub own_start: String,
    /// The other one.
    pub start: String,
    /// The measured value from there, in the limit's unit; `None` if that run has none.
    pub value: Option<f64>,
    /// Its margin, in parts of the limit.
    pub margin: Option<f64>,
    /// `kept` or `exceeded`, `unknown` without a value.
    pub verdict: &'static str,
    /// The reason for a value that is missing, or the derailment; may be empty.
    pub note: String,
}

/// A run from its other start: the names of its own and of the other one, and what came of it.
pub type Repeated = (u64, [&'static str; 2], Record);

/// Returns the numbers of the runs that are near a limit, each once.
#[must_use]
pub fn near(verdicts: &[LimitVerdict]) -> Vec<u64> {
    let worst = verdicts.iter().filter_map(|own| own.worst.as_ref());
    let near = worst.filter(|own| own.margin.abs() <= NEAR && !own.until_derailed);
    let mut runs: Vec<u64> = near.map(|own| own.run).collect();
    runs.sort_unstable();
    runs.dedup();
    runs
}

impl Certificate {
    /// Computes a run of it, by its number and its case, from its other start; `None` for a car on linear
    /// wheels, which has no other one.
    #[must_use]
    pub fn repeat(&self, number: u64, case: &AnyCase) -> Option<Repeated> {
        let case = case.car()?;
        if matches!(case.parameters.wheels, Wheels::Linear { .. }) {
            return None;
        }
        let own = case.parameters.start.kind;
        let other = match own {
            StartKind::Shaken => StartKind::Equilibrium,
            StartKind::Equilibrium | StartKind::Nominal => StartKind::Shaken,
        };
        let mut case = CarCase::clone(case);
        case.parameters.start.kind = other;
        let record = records::run_case(&self.study, number, &case.into());
        Some((number, [own, other].map(name), record))
    }

    /// Notes the values of repeated runs beside those of the verdicts that are near a limit.
    pub fn note(&self, verdicts: &mut [LimitVerdict], repeated: &[Repeated]) {
        for own in verdicts {
            let Some(worst) = own.worst.as_ref().filter(|own| own.margin.abs() <= NEAR) else {
                continue;
            };
            let Some((_, [own_start, start], record)) = repeated.iter().find(|(run, ..)| *run == worst.run)
            else {
                continue;
            };
            let limit = &self.limits.limits[own.limit];
            let usable = matches!(record.status, Status::Complete | Status::Derailed);
            let measured = self.study.measures().get(&record.measures, limit.measure.name);
            let value = measured
                .filter(|own| usable && own.is_finite())
                .map(|own| limit.in_unit(own));
            let margin = value.map(|own| limit.margin(own));
            let verdict = match (record.status, margin) {
                (Status::Derailed, _) => "exceeded",
                (_, Some(margin)) if margin >= 0.0 => "kept",
                (_, Some(_)) => "exceeded",
                (_, None) => "unknown",
            };
            own.other_start = Some(OtherStart {
                own_start: (*own_start).to_owned(),
                start: (*start).to_owned(),
                value,
                margin,
                verdict,
                note: record.reason.clone(),
            });
        }
    }
}

impl OtherStart {
    /// Returns it in words; `value` (of the run itself) and `unit` are those of the limit.
    #[must_use]
    pub fn words(&self, value: f64, unit: &str) -> String {
        let unit = if unit.is_empty() {
            String::new()
        } else {
            format!(" {unit}")
        };
        let other = match (self.value, self.margin) {
            (Some(value), Some(margin)) => {
                let margin = 100.0 * margin;
                format!("{value:.3}{unit} (margin {margin:.1} %, {})", self.verdict)
            }
            _ => self.verdict.to_owned(),
        };
        let note = match self.note.as_str() {
            "" => String::new(),
            note => format!(": {note}"),
        };
        format!(
            "{value:.3}{unit} with start.kind = \"{}\", {other} with \"{}\"{note}",
            self.own_start, self.start
        )
    }
}
