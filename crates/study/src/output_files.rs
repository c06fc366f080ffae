//! The files that the time histories of a run are written into, and their columns.

use mechanics::output::Column;
use quantity::{System as Units, fits_pattern, is_pattern, nearest};
use thiserror::Error;

use crate::case::field::{Written, quoted};
use crate::case::problem::{Problem, Problems};
use crate::case::section::CaseSection;
use crate::case::tree::NodeValue;
use crate::reader::CaseReader;
use crate::reader::schema::Form;

/// A format of the table of a run.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum TableFormat {
    /// `result.parquet`.
    Parquet,
    /// `result.csv`.
    Csv,
    /// `result.mat`.
    Mat,
}

impl TableFormat {
    /// The formats with their names in cases and commands.
    pub const NAMES: &'static [(&'static str, Self)] =
        &[("parquet", Self::Parquet), ("csv", Self::Csv), ("mat", Self::Mat)];
}

/// The files that the time histories of a run are written into.
#[derive(Clone, Debug, PartialEq)]
pub struct OutputFiles {
    /// Their formats.
    pub tables: Vec<TableFormat>,
    /// Patterns of the columns that are written at all; the time always is.
    pub columns: Vec<String>,
    /// Patterns of the columns of the CSV file where a Parquet file is beside it. Without one the CSV file
    /// has all that are written.
    pub csv_columns: Vec<String>,
}

/// A pattern that fits no column of a run.
#[derive(Clone, Debug, PartialEq, Error)]
#[error("no column of the run fits `{pattern}`")]
pub struct NoSuchColumn {
    /// The pattern.
    pub pattern: String,
    /// What to write instead.
    pub advice: String,
}

/// All columns.
const ALL: &str = "*";
/// The columns that the CSV file of a car has beside a Parquet file.
const OF_CARS: [&str; 4] = ["time", "distance", "speed", "body_roll"];

impl Default for OutputFiles {
    /// All columns as CSV and MAT-file.
    fn default() -> Self {
        Self {
            tables: vec![TableFormat::Csv, TableFormat::Mat],
            columns: vec![ALL.to_owned()],
            csv_columns: vec![ALL.to_owned()],
        }
    }
}

impl OutputFiles {
    /// Returns the files of a car: all columns as Parquet, and a few of them as CSV.
    #[must_use]
    pub fn of_car() -> Self {
        Self {
            tables: vec![TableFormat::Parquet, TableFormat::Csv],
            csv_columns: OF_CARS.map(str::to_owned).to_vec(),
            ..Self::default()
        }
    }

    /// Returns whether the table is written in a format.
    #[must_use]
    pub fn has(&self, format: TableFormat) -> bool {
        self.tables.contains(&format)
    }

    /// Returns whether a column is written into a file of this format, by its names without and with unit.
    #[must_use]
    pub fn writes(&self, format: TableFormat, column: &Column, units: Units) -> bool {
        let short = format == TableFormat::Csv && self.has(TableFormat::Parquet);
        column.name == "time"
            || fits_any(&self.columns, column, units)
                && (!short || fits_any(&self.csv_columns, column, units))
    }

    /// Returns whether it has patterns besides the usual ones, which all runs of a model fit.
    #[must_use]
    pub fn is_to_be_checked(&self) -> bool {
        let all = |patterns: &[String]| *patterns == [ALL.to_owned()];
        let usual = all(&self.csv_columns) || self.csv_columns == OF_CARS;
        !(all(&self.columns) && usual)
    }

    /// Checks that each pattern fits a column of a run.
    ///
    /// # Errors
    /// One does not; the error names columns that are near.
    pub fn check(&self, columns: &[Column], units: Units) -> Result<(), NoSuchColumn> {
        for pattern in self.columns.iter().chain(&self.csv_columns) {
            if !columns.iter().any(|column| fits(pattern, column, units)) {
                return Err(NoSuchColumn {
                    pattern: pattern.clone(),
                    advice: advice(pattern, columns),
                });
            }
        }
        Ok(())
    }

    /// Reads the keys of the current section.
    pub(crate) fn read(&mut self, r: &mut CaseReader<'_>) {
        r.several(
            "tables",
            TableFormat::NAMES,
            &mut self.tables,
            "files of time histories: result.parquet, result.csv, result.mat",
        );
        let comment = "columns that they have, as names or patterns such as \"axle_1_*\"; the time always";
        self.columns = patterns(r, "columns", &self.columns, comment);
        let comment = "of these, the columns of a result.csv that is beside a result.parquet";
        self.csv_columns = patterns(r, "csv_columns", &self.csv_columns, comment);
    }
}

fn fits(pattern: &str, column: &Column, units: Units) -> bool {
    fits_pattern(pattern, &column.name) || fits_pattern(pattern, &column.full_name(units))
}

fn fits_any(patterns: &[String], column: &Column, units: Units) -> bool {
    patterns.iter().any(|pattern| fits(pattern, column, units))
}

/// Returns what to write instead of a pattern that fits no column.
fn advice(pattern: &str, columns: &[Column]) -> String {
    const MOST: usize = 6;
    let names = || columns.iter().map(|column| column.name.as_str());
    let plain = pattern.replace(['*', '?'], "");
    if let Some(near) = nearest(plain.trim_matches('_'), names()) {
        return format!("did you mean {near}?");
    }
    let longest = pattern.split(['*', '?']).max_by_key(|part| part.len());
    // The longest beginning of the pattern's longest part that some name has in it.
    let part = longest.unwrap_or_default();
    let beginnings = part
        .char_indices()
        .map(|(end, sign)| &part[..end + sign.len_utf8()]);
    let known = beginnings
        .rev()
        .find(|own| own.len() > 2 && names().any(|name| name.contains(own)));
    let shown: Vec<&str> = names()
        .filter(|name| known.is_none_or(|own| name.contains(own)))
        .collect();
    let more = match shown.len().saturating_sub(MOST) {
        0 => String::new(),
        more => format!(", and {more} more"),
    };
    let list = shown[..shown.len().min(MOST)].join(", ");
    let what = if is_pattern(pattern) {
        "; `*` is any text, `?` any character"
    } else {
        ""
    };
    format!("columns are {list}{more}{what}")
}

/// Reads a list of names or patterns.
fn patterns(r: &mut CaseReader<'_>, key: &'static str, usual: &[String], comment: &str) -> Vec<String> {
    let read = |section: &CaseSection<'_>, problems: &mut Problems| {
        let help = format!("write {key} = [\"axle_1_*\", \"body_roll\"], or [\"*\"] for all");
        let node = section.require(key, &help, problems)?;
        let mut found = Vec::new();
        let items = match &node.value {
            NodeValue::List(items) => items.as_slice(),
            _ => std::slice::from_ref(node),
        };
        for item in items {
            match &item.value {
                NodeValue::Text(text) if !text.is_empty() => found.push(text.clone()),
                other => {
                    let path = section.path_of(key);
                    let message = match other {
                        NodeValue::Text(_) => format!("`{path}` has an empty name"),
                        other => format!("`{path}` has {}; names in quotes are expected", other.describe()),
                    };
                    let problem = Problem::new(message).at(&item.place).label("a name is expected");
                    problems.push(problem.help(help));
                    return None;
                }
            }
        }
        Some(found)
    };
    let write = |own: &Vec<String>| {
        let list: Vec<String> = own.iter().map(|name| quoted(name)).collect();
        Written::toml(format!("[{}]", list.join(", ")))
    };
    r.other(key, Form::Other, comment, usual.to_vec(), read, write)
}
