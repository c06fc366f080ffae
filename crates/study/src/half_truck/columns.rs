//! The table of a half-truck for callers that integrate it themselves.

use mechanics::output::Column;
use mechanics::system::{Observation, System};

use super::HalfTruckCase;
use super::table::OutputTable;

/// The columns of the results of a half-truck, to be evaluated at any instant.
pub struct Columns(OutputTable);

impl Columns {
    /// Returns the columns that a run of the case writes; `system` is that of its model. The residual of the
    /// energy ledger is not meaningful among them: it counts from a start with no stored energy.
    #[must_use]
    pub fn new(case: &HalfTruckCase, system: &System) -> Self {
        Self(OutputTable::new(case, system))
    }

    /// Returns the descriptions of the columns.
    #[must_use]
    pub fn columns(&self) -> &[Column] {
        &self.0.columns
    }

    /// Appends the values of all columns (SI) at one instant.
    pub fn read(&self, seen: &Observation, out: &mut Vec<f64>) {
        self.0.read(seen, 0.0, out);
    }
}
