//! The result of a run.

use mechanics::output::Column;

use crate::summary::Summary;

/// A run's result: the table of outputs and the summary. Values in SI units.
#[derive(Clone, Debug)]
pub struct RunResult<S = Summary> {
    /// The columns of the table.
    pub columns: Vec<Column>,
    /// The values, one vector a column.
    pub values: Vec<Vec<f64>>,
    /// The summary, in the case's output units.
    pub summary: S,
}

impl<S> RunResult<S> {
    /// Returns it with a summary of another type.
    #[must_use]
    pub fn with_summary<T>(self, change: impl FnOnce(S) -> T) -> RunResult<T> {
        RunResult {
            columns: self.columns,
            values: self.values,
            summary: change(self.summary),
        }
    }

    /// Number of rows.
    #[must_use]
    pub fn rows(&self) -> usize {
        self.values.first().map_or(0, Vec::len)
    }

    /// Forgets the columns that are not wanted, by their names without unit.
    pub fn keep_columns(&mut self, wanted: impl Fn(&str) -> bool) {
        let keep: Vec<bool> = self.columns.iter().map(|column| wanted(&column.name)).collect();
        let mut kept = keep.iter();
        self.columns.retain(|_| kept.next().is_some_and(|keep| *keep));
        let mut kept = keep.iter();
        self.values.retain(|_| kept.next().is_some_and(|keep| *keep));
    }

    /// Returns the values (SI) of the column with this name (without unit).
    #[must_use]
    pub fn column(&self, name: &str) -> Option<&[f64]> {
        let index = self.columns.iter().position(|column| column.name == name)?;
        Some(&self.values[index])
    }
}
