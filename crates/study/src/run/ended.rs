//! What the summaries of all models say of a run that has ended, or has stopped on its way.

use integrate::Statistics;
use mechanics::energy_balance::Verdict;

use super::{Recorder, RowTable, Run, RunCase};
use crate::energy;
use crate::finite::not_finite;
use crate::summary::{LedgerSummary, Stopped};

/// The version of the program.
pub(crate) const PROGRAM: &str = concat!("wedgelab ", env!("CARGO_PKG_VERSION"));

/// The part that the summaries of all models have.
pub(crate) struct Ended {
    /// [`PROGRAM`].
    pub program: String,
    /// Whether it came to its end and its energy ledger closes.
    pub complete: bool,
    /// Reason and time of the stop; none of a run that has derailed, whose derailment is a result.
    pub stopped: Option<Stopped>,
    /// The reason for not using its numbers.
    pub failed: Option<String>,
    /// The warnings about its energy ledger and its start.
    pub warnings: Vec<String>,
    /// Number of rows.
    pub rows: usize,
    /// Counters of the integrator.
    pub statistics: Statistics,
}

impl<C: RunCase> Run<C> {
    /// Returns what all summaries say of a run with these rows. `what_to_do` is the advice on an energy
    /// ledger that does not close.
    pub(crate) fn ended(&self, stopped: Option<Stopped>, rows: &RowTable, what_to_do: &str) -> Ended {
        let balance = &self.energy_balance;
        let complete = stopped.is_none() && self.is_finished() && balance.verdict() != Verdict::Failed;
        let warnings = energy::warning(balance, what_to_do).into_iter();
        Ended {
            program: PROGRAM.to_owned(),
            complete,
            stopped: stopped.filter(|_| !self.recorder.has_derailed()),
            failed: energy::failure(balance, what_to_do),
            warnings: warnings.chain(self.start_warning.clone()).collect(),
            rows: rows.rows(),
            statistics: self.integrator.statistics().clone(),
        }
    }

    /// Returns the energy ledger at the end; with one that is not finite the run has stopped.
    pub(crate) fn last_ledger(&mut self, ended: &mut Ended) -> LedgerSummary {
        let ledger = self.ledger(self.case.units());
        let not_finite = not_finite(&ledger);
        self.stop(ended, not_finite);
        ledger
    }

    /// Stops a run that has not been stopped, if something of its results (in words) is not a finite number.
    pub(crate) fn stop(&self, ended: &mut Ended, not_finite: Option<String>) {
        if let Some(what) = not_finite.filter(|_| ended.stopped.is_none()) {
            ended.complete = false;
            ended.stopped = Some(self.stopped(format!("{what} is not a finite number")));
        }
    }
}
