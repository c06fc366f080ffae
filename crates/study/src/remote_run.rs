//! A run that another process computes, on another machine perhaps: all that it is made of, as text.

use serde::{Deserialize, Serialize};

use crate::models::CaseSource;
use crate::records;

/// A run for a worker elsewhere. It gives the same bits there as here.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct RemoteRun {
    /// The case.
    pub source: CaseSource,
    /// What all runs of the kind set, as `--set` takes it: with it the case says which measures there are.
    pub common: Vec<String>,
    /// What this run sets besides.
    pub own: Vec<String>,
    /// Its number.
    pub number: u64,
    /// The fingerprint of what it belongs to.
    pub fingerprint: u64,
}

impl RemoteRun {
    /// Computes it; gives its record as bytes. Whatever goes wrong, it is a record.
    #[must_use]
    pub fn record(&self) -> Vec<u8> {
        let all: Vec<String> = self.common.iter().chain(&self.own).cloned().collect();
        let definitions = self.source.case(&self.common).map(|base| base.definitions());
        let record = records::run_made(&definitions.unwrap_or_default(), self.number, || {
            self.source.case(&all)
        });
        let mut bytes = Vec::new();
        record.write(self.fingerprint, &mut bytes);
        bytes
    }
}
