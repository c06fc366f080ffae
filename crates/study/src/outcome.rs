//! The outcome of a run of any model: whether it came to its end with numbers to use, and if not, where and
//! why.
//!
//! Exit codes, `complete` in the summary, tables, pages, rows of studies, assessments and Python ask it
//! ([`RunSummary::outcome`](crate::summary::RunSummary::outcome)).

use quantity::SixDigits;

use crate::summary_value::SummaryValue;

/// The outcome of a run.
#[derive(Clone, Debug, PartialEq)]
pub enum Outcome {
    /// It came to its end, and its energy ledger closes to 1e-2.
    Complete,
    /// A wheel left its rail, which is a result: the run ends there.
    Derailed(RunEnd),
    /// It stopped on its way: it could not go on, or was told to stop.
    Stopped(RunEnd),
    /// It came to its end, but its energy ledger does not close to 1e-2: the reason.
    Failed(String),
}

/// The place at which a run ended before its time.
#[derive(Clone, Debug, PartialEq)]
pub struct RunEnd {
    /// Time, s.
    pub time: f64,
    /// The reason.
    pub reason: String,
    /// Distance along the track that was reached, if the model runs on one.
    pub distance: Option<SummaryValue>,
}

impl Outcome {
    /// Returns it in one word: `complete`, `derailed`, `stopped`, `failed`.
    #[must_use]
    pub fn word(&self) -> &'static str {
        match self {
            Self::Complete => "complete",
            Self::Derailed(_) => "derailed",
            Self::Stopped(_) => "stopped",
            Self::Failed(_) => "failed",
        }
    }

    /// Returns where the run ended, if it ended before its time.
    #[must_use]
    pub fn end(&self) -> Option<&RunEnd> {
        match self {
            Self::Derailed(end) | Self::Stopped(end) => Some(end),
            Self::Complete | Self::Failed(_) => None,
        }
    }

    /// Returns the predicate of a sentence on the run, with the reason; `None` of a complete run.
    #[must_use]
    pub fn told(&self) -> Option<String> {
        let (verb, end) = match self {
            Self::Complete => return None,
            Self::Failed(reason) => return Some(format!("has failed: {reason}")),
            Self::Derailed(end) => ("derailed", end),
            Self::Stopped(end) => ("stopped", end),
        };
        let time = SixDigits(end.time);
        Some(format!("{verb} at {time} s and is incomplete: {}", end.reason))
    }

    /// Returns the sentence on what its numbers stand for; `None` of a complete run.
    #[must_use]
    pub fn numbers(&self) -> Option<String> {
        match self {
            Self::Complete => None,
            Self::Failed(_) => Some("Do not use its numbers.".to_owned()),
            Self::Derailed(end) | Self::Stopped(end) => Some(format!(
                "All values, statistics and margins are of the part until {}, not of the whole run.",
                end.place()
            )),
        }
    }
}

impl RunEnd {
    /// Returns time and distance in words.
    #[must_use]
    pub fn place(&self) -> String {
        let time = SixDigits(self.time);
        match &self.distance {
            None => format!("{time} s"),
            Some(own) => format!("{time} s ({:.1} {} along the track)", own.value, own.unit),
        }
    }
}
