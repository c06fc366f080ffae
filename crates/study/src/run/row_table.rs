//! The rows of a run, and what its saved state has of them.

use std::collections::BTreeMap;

use mechanics::output::Column;
use quantity::System as Units;
use serde::{Deserialize, Serialize};

use crate::finite::is_finite;
use crate::metrics::Extremes;
use crate::result::RunResult;
use crate::run_error::{NotFinite, RunError, check_finite, check_length, damaged};

/// The rows of a run, SI, one vector a column. A run that goes on from a saved state has the rows after it;
/// of the time and of the columns that its summary reads row by row it has all rows since the start, and of
/// all columns the extremes.
#[derive(Clone, Debug, Default)]
pub(crate) struct RowTable {
    columns: Vec<Column>,
    values: Vec<Vec<f64>>,
    /// The row on its way.
    row: Vec<f64>,
    /// Places of the columns that have all rows; not that of the time, which is the first column.
    kept: Vec<usize>,
    /// Number of rows before the saved state.
    before: usize,
    /// The extremes of those rows by column; empty without such rows.
    earlier: Vec<Extremes>,
}

/// The rows of a run before its state was saved, as far as its summary needs them.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct SavedRows {
    /// The values at all rows of the columns that the summary reads row by row, by name, SI.
    pub columns: BTreeMap<String, Vec<f64>>,
    /// The extremes of all columns, in their order, SI.
    pub extremes: Vec<Extremes>,
}

impl RowTable {
    /// Returns the empty table of these columns, the first of which is the time; `kept` tells by name which
    /// ones the summary reads row by row.
    pub fn new(columns: &[Column], kept: impl Fn(&str) -> bool) -> Self {
        let kept = |place: &usize| kept(&columns[*place].name);
        Self {
            values: vec![Vec::new(); columns.len()],
            kept: (1..columns.len()).filter(kept).collect(),
            row: Vec::with_capacity(columns.len()),
            columns: columns.to_vec(),
            ..Self::default()
        }
    }

    /// Returns the descriptions of the columns.
    pub fn columns(&self) -> &[Column] {
        &self.columns
    }

    /// Returns an empty row, to be filled with the values of all columns.
    pub fn begin_row(&mut self) -> &mut Vec<f64> {
        self.row.clear();
        &mut self.row
    }

    /// Returns the row that is being filled, or was filled last.
    pub fn row(&mut self) -> &mut Vec<f64> {
        &mut self.row
    }

    /// Appends the row that was filled, at a time, s.
    ///
    /// # Errors
    /// A value is not finite; nothing is appended then.
    pub fn append(&mut self, time: f64) -> Result<(), NotFinite> {
        if let Some(index) = self.row.iter().position(|value| !is_finite(*value)) {
            return Err(NotFinite {
                column: self.columns[index].name.clone(),
                value: self.row[index],
                time,
            });
        }
        for (column, value) in self.values.iter_mut().zip(&self.row) {
            column.push(*value);
        }
        Ok(())
    }

    /// Returns all rows since the start of the time or of a column that the summary reads row by row; those
    /// after the saved state of another one; nothing if there is no column of this name.
    pub fn column(&self, name: &str) -> &[f64] {
        let place = self.columns.iter().position(|own| own.name == name);
        place.map_or(&[][..], |place| self.values[place].as_slice())
    }

    /// Returns the values of all columns as [`RowTable::column`] does, in their order.
    pub fn values(&self) -> &[Vec<f64>] {
        &self.values
    }

    /// Returns the number of rows after the saved state.
    pub fn rows(&self) -> usize {
        self.column("time").len() - self.before
    }

    /// Returns the number of rows before the saved state.
    pub fn before(&self) -> usize {
        self.before
    }

    /// Returns the extremes of the column at this place over all rows since the start; none without rows.
    pub fn extremes(&self, place: usize) -> Option<Extremes> {
        let whole = place == 0 || self.kept.contains(&place);
        let from = if whole { self.before } else { 0 };
        let times = &self.values[0][self.before..];
        let own = Extremes::of(times, &self.values[place][from..]);
        match (self.earlier.get(place), own) {
            (Some(earlier), Some(own)) => Some(earlier.clone().then(own)),
            (earlier, own) => earlier.cloned().or(own),
        }
    }

    /// Returns the extremes of all columns but the time by their names with units, in output units.
    pub fn summary_extremes(&self, units: Units) -> BTreeMap<String, Extremes> {
        self.extremes_of_first(self.columns.len(), units)
    }

    /// Returns the same of this number of columns at the beginning.
    pub fn extremes_of_first(&self, number: usize, units: Units) -> BTreeMap<String, Extremes> {
        let all = self.columns.iter().enumerate().take(number).skip(1);
        all.filter_map(|(place, column)| Some(self.extremes(place)?.named(column, units)))
            .collect()
    }

    /// Returns the result of the run: the rows after the saved state, with the summary.
    pub fn into_result<S>(mut self, summary: S) -> RunResult<S> {
        for place in self.kept.into_iter().chain([0]) {
            self.values[place].drain(..self.before);
        }
        RunResult {
            columns: self.columns,
            values: self.values,
            summary,
        }
    }

    /// Returns what a saved state has of the rows.
    pub fn saved(&self) -> SavedRows {
        let kept = self.kept.iter();
        SavedRows {
            columns: kept
                .map(|place| (self.columns[*place].name.clone(), self.values[*place].clone()))
                .collect(),
            extremes: (0..self.columns.len())
                .filter_map(|place| self.extremes(place))
                .collect(),
        }
    }

    /// Goes on from saved rows, which lie at these times, s.
    ///
    /// # Errors
    /// No run with this table can have had them.
    pub fn restore(&mut self, mut saved: SavedRows, times: &[f64]) -> Result<(), RunError> {
        const COLUMNS: &str = "counts.table.columns";
        const EXTREMES: &str = "counts.table.extremes";
        for place in &self.kept {
            let Some(values) = saved.columns.remove(&self.columns[*place].name) else {
                let name = &self.columns[*place].name;
                return damaged(COLUMNS, format!("without `{name}`"), "all that the summary needs");
            };
            check_length(COLUMNS, values.len(), times.len())?;
            values
                .iter()
                .try_for_each(|value| check_finite(COLUMNS, *value))?;
            self.values[*place] = values;
        }
        if let Some(name) = saved.columns.keys().next() {
            let name = format!("with `{}`", input::shortened(name));
            return damaged(COLUMNS, name, "what the summary needs alone");
        }
        check_length(EXTREMES, saved.extremes.len(), self.columns.len())?;
        let last = times.last().copied().unwrap_or_default();
        for own in &saved.extremes {
            let [least, most] = [own.minimum, own.maximum];
            if !(least.is_finite() && most.is_finite() && least <= most) {
                let found = format!("from {least} to {most}");
                return damaged(EXTREMES, found, "finite, the least value first");
            }
            for time in [own.minimum_time, own.maximum_time] {
                if !(0.0..=last).contains(&time) {
                    return damaged(
                        EXTREMES,
                        format!("at {time} s"),
                        format!("between 0 and {last} s"),
                    );
                }
            }
        }
        self.values[0] = times.to_vec();
        self.before = times.len();
        self.earlier = saved.extremes;
        Ok(())
    }
}
