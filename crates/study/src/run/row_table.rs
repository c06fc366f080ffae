//! The rows of a run, and what its saved state has of them.

use std::collections::BTreeMap;

use mechanics::output::Column;
use quantity::System as Units;
use serde::{Deserialize, Serialize};

use super::append;
use crate::metrics::Extremes;
use crate::run_error::{NotFinite, RunError, check_finite, check_length, damaged};

/// The rows of a run, SI, one vector a column. A run that goes on from a saved state has the rows after it;
/// of the time and of the columns that its summary reads row by row it has all rows since the start, and of
/// all columns the extremes.
#[derive(Clone, Debug, Default)]
pub(crate) struct RowTable {
    /// Names of the columns.
    names: Vec<String>,
    values: Vec<Vec<f64>>,
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
        let names: Vec<String> = columns.iter().map(|column| column.name.clone()).collect();
        Self {
            values: vec![Vec::new(); columns.len()],
            kept: (1..names.len()).filter(|place| kept(&names[*place])).collect(),
            names,
            ..Self::default()
        }
    }

    /// Appends a row at a time, s.
    ///
    /// # Errors
    /// A value is not finite; nothing is appended then.
    pub fn append(&mut self, columns: &[Column], row: &[f64], time: f64) -> Result<(), NotFinite> {
        append(&mut self.values, columns, row, time)
    }

    /// Returns all rows since the start of the time or of a column that the summary reads row by row; those
    /// after the saved state of another one; nothing if there is no column of this name.
    pub fn column(&self, name: &str) -> &[f64] {
        let place = self.names.iter().position(|own| own == name);
        place.map_or(&[][..], |place| self.values[place].as_slice())
    }

    /// Returns the columns as [`RowTable::column`] does, in their order.
    pub fn columns(&self) -> &[Vec<f64>] {
        &self.values
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
    pub fn summary_extremes(&self, columns: &[Column], units: Units) -> BTreeMap<String, Extremes> {
        let all = columns.iter().enumerate().skip(1);
        all.filter_map(|(place, column)| Some(self.extremes(place)?.named(column, units)))
            .collect()
    }

    /// Returns the rows after the saved state.
    pub fn into_values(mut self) -> Vec<Vec<f64>> {
        for place in self.kept.into_iter().chain([0]) {
            self.values[place].drain(..self.before);
        }
        self.values
    }

    /// Returns what a saved state has of the rows.
    pub fn saved(&self) -> SavedRows {
        let kept = self.kept.iter();
        SavedRows {
            columns: kept
                .map(|place| (self.names[*place].clone(), self.values[*place].clone()))
                .collect(),
            extremes: (0..self.names.len())
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
            let Some(values) = saved.columns.remove(&self.names[*place]) else {
                let name = &self.names[*place];
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
        check_length(EXTREMES, saved.extremes.len(), self.names.len())?;
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
