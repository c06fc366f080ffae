//! The table of a half-truck for callers that integrate it themselves.

use mechanics::output::Column;
use mechanics::system::{Observation, System};

use super::TruckCase;
use super::table::Table;

/// The columns of the results of a half-truck, to be evaluated at any instant.
pub struct Columns {
    table: Table,
    values: Vec<Vec<f64>>,
}

impl Columns {
    /// Returns the columns that a run of the case writes; `system` is that of its model. The residual of the
    /// energy ledger is not meaningful among them: it counts from a start with no stored energy.
    #[must_use]
    pub fn new(case: &TruckCase, system: &System) -> Self {
        let table = Table::new(&case.truck, system, &case.requests, 0.0);
        Self {
            values: table.columns.iter().map(|_| Vec::with_capacity(1)).collect(),
            table,
        }
    }

    /// Returns what the columns are.
    #[must_use]
    pub fn columns(&self) -> &[Column] {
        &self.table.columns
    }

    /// Appends the values of all columns (SI) at one instant.
    pub fn read(&mut self, seen: &Observation, out: &mut Vec<f64>) {
        self.values.iter_mut().for_each(Vec::clear);
        self.table.read(seen, &mut self.values);
        out.extend(self.values.iter().flatten());
    }
}
