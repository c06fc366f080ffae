//! Tables of results, read back: those of runs, and any CSV file of the same form.
//!
//! The form is that of [`csv`](crate::csv): a line of names, *what* then *unit* (`wedge_x_in`, `wedge_x_m`),
//! then lines of numbers, one of the columns being `time_s`, which increases. Columns may be fewer, more, and
//! in any order; a name without a known unit is a pure number. Lines that begin with `#` and empty lines do
//! not count.
//!
//! Parquet files ([`result_parquet`]) are read with the same names.
//!
//! Numbers are kept as written, so that nothing is lost; [`TableColumn::si`] and [`TableColumn::in_units`]
//! convert. Those in other units than results are written with (`force_kN`, `speed [km/h]`) are converted
//! when they are read.

use std::fs;
use std::io;
use std::path::{Path, PathBuf};

use ::csv::{ReaderBuilder, Trim};
use input::file::{Expected, read};
use input::{FileType, limits, shortened};
use quantity::{Kind, System as Units, nearest};

pub use error::TableError;
use header::{Header, HeaderLocation};

use crate::result_parquet;

mod error;
mod header;

/// The expected file of a result.
const RESULT_FILE: Expected = Expected {
    what: "table of results",
    types: &[FileType::Results, FileType::Parquet],
    most: limits::RESULT_FILE,
};

/// A column.
#[derive(Clone, Debug, PartialEq)]
pub struct TableColumn {
    /// Its name without unit, such as `wedge_x`.
    pub name: String,
    /// The kind of quantity. Where moments and energies are written alike and the name is none of ours, a
    /// moment.
    pub kind: Kind,
    /// The system of units of [`TableColumn::written`].
    pub units: Units,
    /// The numbers as they stand in the file, or converted to `units` from units of their own.
    pub written: Vec<f64>,
}

impl TableColumn {
    /// Returns the values in SI units.
    #[must_use]
    pub fn si(&self) -> Vec<f64> {
        self.in_units(Units::Si)
    }

    /// Returns the values in a system of units; in its own, the same bits as written.
    #[must_use]
    pub fn in_units(&self, units: Units) -> Vec<f64> {
        if units == self.units {
            return self.written.clone();
        }
        let (own, other) = (self.kind.from_si(self.units), self.kind.from_si(units));
        self.written.iter().map(|value| value / own * other).collect()
    }
}

/// A table of results.
#[derive(Clone, Debug, PartialEq)]
pub struct ResultTable {
    /// The file that it was read from.
    pub file: PathBuf,
    /// The units in which it was written.
    pub units: Units,
    columns: Vec<TableColumn>,
    time: usize,
}

impl ResultTable {
    /// Reads a result: a folder with a `result.parquet`, else a `result.csv`; such a file, or another CSV or
    /// Parquet file of the same form.
    ///
    /// # Errors
    /// There is no such result, it is no table, or the table is wrong: see [`TableError`].
    pub fn read(path: &Path) -> Result<Self, TableError> {
        let file = locate(path)?;
        let bytes = read(&file, &RESULT_FILE).map_err(|error| TableError::of_file(&file, error))?;
        match FileType::of(&bytes) {
            Some(FileType::Parquet) => Self::of_numbers(&file, result_parquet::read(&file, bytes)?),
            _ => Self::parse(&file, &bytes),
        }
    }

    /// Returns the table of columns with their names, of a Parquet file. Its rows count as lines of a CSV
    /// file do: the names are the first.
    fn of_numbers(file: &Path, mut columns: result_parquet::Read) -> Result<Self, TableError> {
        let names: Vec<&str> = columns.iter().map(|(name, _)| name.as_str()).collect();
        let header = header::read(&HeaderLocation { file, line: 1 }, &names)?;
        for (own, (_, values)) in header.names.iter().zip(&mut columns) {
            values
                .iter_mut()
                .for_each(|value| *value = own.in_units(*value, header.units));
        }
        for (index, (name, values)) in columns.iter().enumerate() {
            for (row, value) in values.iter().enumerate() {
                let before = row.checked_sub(1).map(|row| values[row]);
                check(
                    file,
                    row as u64 + 2,
                    (index, name, *value),
                    before.filter(|_| index == header.time),
                )?;
            }
        }
        Self::new(
            file,
            header,
            columns.into_iter().map(|(_, values)| values).collect(),
        )
    }

    fn new(file: &Path, header: Header, columns: Vec<Vec<f64>>) -> Result<Self, TableError> {
        let file = file.to_owned();
        if columns.iter().all(Vec::is_empty) {
            return Err(TableError::NoRows { file });
        }
        Ok(Self {
            file,
            units: header.units,
            time: header.time,
            columns: header
                .names
                .into_iter()
                .zip(columns)
                .map(|(name, written)| TableColumn {
                    name: name.base,
                    kind: name.kind,
                    units: header.units,
                    written,
                })
                .collect(),
        })
    }

    /// Understands the content of a file.
    ///
    /// # Errors
    /// As [`ResultTable::read`].
    pub fn parse(file: &Path, bytes: &[u8]) -> Result<Self, TableError> {
        let text = text_of(file, bytes)?;
        let mut reader = ReaderBuilder::new()
            .has_headers(false)
            .flexible(true)
            .trim(Trim::All)
            .comment(Some(b'#'))
            .from_reader(text.as_bytes());
        let mut rows = Rows {
            file,
            header: None,
            columns: Vec::new(),
            short: None,
            cells: 0,
        };
        for record in reader.records() {
            // The text is UTF-8 and lengths may differ: what is left are errors of reading from memory, which
            // has none.
            let record = record.map_err(|error| TableError::Unreadable {
                file: file.to_owned(),
                reason: io::Error::other(error),
            })?;
            let cells: Vec<&str> = record.iter().collect();
            if cells != [""] {
                rows.add(record.position().map_or(0, |place| line_of(text, place)), &cells)?;
            }
        }
        rows.finish().ok_or_else(|| TableError::foreign(file, "empty"))?
    }

    /// Returns all columns, in the order of the file.
    #[must_use]
    pub fn columns(&self) -> &[TableColumn] {
        &self.columns
    }

    /// Returns the times, s.
    #[must_use]
    pub fn times(&self) -> &[f64] {
        // Seconds in every system of units.
        &self.columns[self.time].written
    }

    /// Returns the column with this name, written with or without unit.
    ///
    /// # Errors
    /// There is none; the error names those that are near.
    pub fn column(&self, name: &str) -> Result<&TableColumn, TableError> {
        self.find(name).ok_or_else(|| {
            let names = self.columns.iter().map(|column| column.name.as_str());
            TableError::NoColumn {
                file: self.file.clone(),
                name: name.to_owned(),
                advice: error::suggest(name, names),
            }
        })
    }

    /// Gives the column of this name, written with or without unit, another name (without unit), if there is
    /// one.
    pub fn rename(&mut self, name: &str, new: &str) {
        let old = self.find(name).map(|column| column.name.clone());
        let found = self
            .columns
            .iter_mut()
            .find(|column| Some(&column.name) == old.as_ref());
        if let Some(column) = found {
            new.clone_into(&mut column.name);
        }
    }

    /// Keeps the rows whose times lie between two times (s), these included; returns how many.
    pub fn keep(&mut self, from: f64, to: f64) -> usize {
        let times = self.times();
        let first = times.partition_point(|time| *time < from);
        let last = times.partition_point(|time| *time <= to).max(first);
        for column in &mut self.columns {
            column.written.truncate(last);
            column.written.drain(..first);
        }
        last - first
    }

    /// Returns the column with this name, if there is one.
    #[must_use]
    pub fn find(&self, name: &str) -> Option<&TableColumn> {
        let full = |column: &TableColumn, units| match column.kind.suffix(units) {
            "" => false,
            suffix => name.strip_suffix(suffix).and_then(|base| base.strip_suffix('_')) == Some(&column.name),
        };
        let by_name = self.columns.iter().find(|column| column.name == name);
        by_name.or_else(|| {
            let mut columns = self.columns.iter();
            columns.find(|column| full(column, Units::Us) || full(column, Units::Si))
        })
    }
}

/// The rows that have been read so far.
struct Rows<'f> {
    file: &'f Path,
    header: Option<(Header, u64)>,
    columns: Vec<Vec<f64>>,
    /// A line with too few cells: cut off if no other follows.
    short: Option<(u64, usize)>,
    /// Number of cells.
    cells: usize,
}

impl Rows<'_> {
    fn add(&mut self, line: u64, cells: &[&str]) -> Result<(), TableError> {
        let Some((header, _)) = &self.header else {
            if cells.starts_with(&["run", "status"]) {
                return Err(TableError::of_study(self.file));
            }
            let place = HeaderLocation {
                file: self.file,
                line,
            };
            let header = header::read(&place, cells)?;
            self.columns = vec![Vec::new(); header.names.len()];
            self.header = Some((header, line));
            return Ok(());
        };
        let expected = header.names.len();
        self.cells += expected;
        if self.cells > limits::RESULT_CELLS {
            return Err(TableError::TooLarge {
                file: self.file.to_owned(),
                line,
            });
        }
        let ragged = |(line, found)| TableError::Ragged {
            file: self.file.to_owned(),
            line,
            found,
            expected,
        };
        if let Some(short) = self.short {
            return Err(ragged(short));
        }
        if cells.len() > expected {
            return Err(ragged((line, cells.len())));
        }
        if cells.len() < expected {
            self.short = Some((line, cells.len()));
            return Ok(());
        }
        for (index, cell) in cells.iter().enumerate() {
            let name = header.names[index].full.as_str();
            let Ok(value) = cell.parse::<f64>() else {
                return Err(not_a_number(self.file, line, (index, name), cell));
            };
            let value = header.names[index].in_units(value, header.units);
            let before = self.columns[index].last().copied();
            let before = before.filter(|_| index == header.time);
            if !value.is_finite() {
                return Err(not_a_number(self.file, line, (index, name), cell));
            }
            check(self.file, line, (index, name, value), before)?;
            self.columns[index].push(value);
        }
        Ok(())
    }

    /// Returns the table; `None` if there was not even a line of names.
    fn finish(self) -> Option<Result<ResultTable, TableError>> {
        let (header, _) = self.header?;
        if let Some((line, found)) = self.short {
            return Some(Err(TableError::Truncated {
                file: self.file.to_owned(),
                line,
                found,
                expected: header.names.len(),
            }));
        }
        Some(ResultTable::new(self.file, header, self.columns))
    }
}

/// Checks that a value of a column (its place and name) is a number and, where it is the time, later than the
/// one before.
fn check(
    file: &Path,
    line: u64,
    (index, name, value): (usize, &str, f64),
    before: Option<f64>,
) -> Result<(), TableError> {
    if !value.is_finite() {
        let text = if value.is_nan() { "nothing" } else { "infinite" };
        return Err(not_a_number(file, line, (index, name), text));
    }
    match before.filter(|before| value <= *before) {
        Some(before) => Err(TableError::NotIncreasing {
            file: file.to_owned(),
            line,
            column: index + 1,
            name: name.to_owned(),
            time: value,
            before,
        }),
        None => Ok(()),
    }
}

fn not_a_number(file: &Path, line: u64, (index, name): (usize, &str), text: &str) -> TableError {
    TableError::NotANumber {
        file: file.to_owned(),
        line,
        column: index + 1,
        name: name.to_owned(),
        text: shortened(text),
    }
}

/// Returns the line of a record. The reader's own count stands before the remarks and empty lines in front of
/// the record.
fn line_of(text: &str, place: &::csv::Position) -> u64 {
    let rest = usize::try_from(place.byte())
        .ok()
        .and_then(|byte| text.get(byte..));
    let before = rest.unwrap_or_default().lines();
    let skipped = before.take_while(|line| line.is_empty() || line.starts_with('#'));
    place.line() + skipped.count() as u64
}

/// Returns the text of a file, unless it is something else.
fn text_of<'b>(file: &Path, bytes: &'b [u8]) -> Result<&'b str, TableError> {
    let foreign = |what| TableError::foreign(file, what);
    if let Some(found) = FileType::of(bytes).filter(|found| *found != FileType::Results) {
        return Err(TableError::of_type(file, found));
    }
    let text = std::str::from_utf8(bytes).map_err(|_| foreign("no text"))?;
    if text.contains('\0') {
        return Err(foreign("no text"));
    }
    let text = text.strip_prefix('\u{feff}').unwrap_or(text);
    if let Some(long) = text.split('\n').position(|line| line.len() > limits::LINE) {
        return Err(TableError::LongLine {
            file: file.to_owned(),
            line: long as u64 + 1,
        });
    }
    match text.trim_start().chars().next() {
        None => Err(foreign("empty")),
        Some('{' | '[') => Err(foreign("no table, but looks like JSON or TOML")),
        Some('<') => Err(foreign("no table, but looks like a web page or a drawing")),
        Some(_) => Ok(text),
    }
}

/// Returns the file of a result.
fn locate(path: &Path) -> Result<PathBuf, TableError> {
    if path.is_dir() {
        if let Some(file) = in_folder(path) {
            return Ok(file);
        }
        let inside = results_below(path);
        return Err(TableError::NoResult {
            folder: path.to_owned(),
            advice: match inside.as_slice() {
                [] => "name the folder that `wedgelab run` has written, or a CSV file".to_owned(),
                some => format!("there are results in {}", some.join(", ")),
            },
        });
    }
    if path.exists() {
        return Ok(path.to_owned());
    }
    let name = path
        .file_name()
        .and_then(|name| name.to_str())
        .unwrap_or_default();
    let folder = match path.parent() {
        Some(parent) if !parent.as_os_str().is_empty() => parent,
        _ => Path::new("."),
    };
    let beside = names_in(folder);
    let advice = match nearest(name, beside.iter().map(String::as_str)) {
        Some(near) => format!("did you mean {}?", path.with_file_name(near).display()),
        None => "name the folder that `wedgelab run` has written, or a CSV file".to_owned(),
    };
    Err(TableError::NotFound {
        path: path.to_owned(),
        advice,
    })
}

/// Returns the file of the result in a folder: the Parquet file, which has all columns, before the CSV file.
#[must_use]
pub fn in_folder(folder: &Path) -> Option<PathBuf> {
    let names = [result_parquet::FILE_NAME, crate::csv::FILE_NAME];
    names
        .into_iter()
        .map(|name| folder.join(name))
        .find(|file| file.exists())
}

/// Returns whether a file has the name of the table of a run.
#[must_use]
pub fn is_of_run(file: &Path) -> bool {
    let name = file.file_name().and_then(|name| name.to_str());
    name.is_some_and(|name| [result_parquet::FILE_NAME, crate::csv::FILE_NAME].contains(&name))
}

/// Returns the first folders with results in a folder, or in its folder `runs`.
fn results_below(folder: &Path) -> Vec<String> {
    const MOST: usize = 3;
    let mut found = Vec::new();
    for inside in [folder.to_owned(), folder.join("runs")] {
        for name in names_in(&inside) {
            let result = inside.join(name);
            if in_folder(&result).is_some() && found.len() < MOST {
                found.push(result.display().to_string());
            }
        }
    }
    found
}

/// Returns the names in a folder, sorted; none if it cannot be read.
fn names_in(folder: &Path) -> Vec<String> {
    let Ok(entries) = fs::read_dir(folder) else {
        return Vec::new();
    };
    let mut names: Vec<String> = entries
        .filter_map(|entry| entry.ok()?.file_name().into_string().ok())
        .collect();
    names.sort();
    names
}
