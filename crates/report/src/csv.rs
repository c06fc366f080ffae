//! `result.csv`: one row an output time, one column an output; and other tables of the same form.
//!
//! A header of full names (`wedge_x_in`), numbers in the shortest decimal form that reads back to the same
//! bits, a point as decimal sign, `,` between columns, and `\n` at the end of every line. Contact states are
//! integers. What is missing or no number is an empty cell; texts with a comma, a quotation mark or an end of
//! line are in quotation marks (RFC 4180).

use std::fmt::Display;
use std::io::{self, Write};

use mechanics::output::Column;
use quantity::{Kind, System as Units};
use study::result::RunResult;

use crate::parquet::Cell;

/// The file's name.
pub const FILE_NAME: &str = "result.csv";

/// Writes the table in the units of the result's summary, row by row.
///
/// # Errors
/// The writer's.
pub fn write(result: &RunResult, out: &mut dyn Write) -> io::Result<()> {
    write_columns(&result.columns, &result.values, result.summary.units, out)
}

/// Writes columns with their values (SI, one vector a column, all of the same length) in a system of units.
///
/// # Errors
/// The writer's; or the columns differ in length.
pub fn write_columns(
    columns: &[Column],
    values: &[Vec<f64>],
    units: Units,
    out: &mut dyn Write,
) -> io::Result<()> {
    if columns.len() != values.len() {
        return Err(differing());
    }
    let values = values.iter().map(Vec::as_slice);
    write_table(&columns.iter().zip(values).collect::<Vec<_>>(), units, out)
}

/// A table: descriptions of columns with their values, SI, all of the same length.
pub type Table<'t> = [(&'t Column, &'t [f64])];

/// Writes a table in a system of units.
///
/// # Errors
/// The writer's; or the columns differ in length.
pub fn write_table(table: &Table<'_>, units: Units, out: &mut dyn Write) -> io::Result<()> {
    let rows = rows_of(table)?;
    let mut cells = RowWriter::new(out);
    for (column, _) in table {
        cells.text(&column.full_name(units));
    }
    cells.end()?;
    for row in 0..rows {
        for (column, values) in table {
            cells.number(converted(values[row], column.kind, units));
        }
        cells.end()?;
    }
    Ok(())
}

/// Returns the number of rows of a table.
///
/// # Errors
/// The columns differ in length.
pub(crate) fn rows_of(table: &Table<'_>) -> io::Result<usize> {
    let rows = table.first().map_or(0, |(_, values)| values.len());
    match table.iter().any(|(_, values)| values.len() != rows) {
        true => Err(differing()),
        false => Ok(rows),
    }
}

fn differing() -> io::Error {
    io::Error::other("the columns of the result differ in length")
}

/// Returns an SI value as files have it.
#[must_use]
pub fn converted(si: f64, kind: Kind, units: Units) -> f64 {
    si * kind.from_si(units)
}

/// Returns a number without the errors of a conversion: to twelve digits.
#[must_use]
pub fn rounded(value: f64) -> f64 {
    format!("{value:.11e}").parse().unwrap_or(value)
}

/// Writes the names of columns.
///
/// # Errors
/// The writer's.
pub fn write_header<'n>(names: impl Iterator<Item = &'n str>, out: &mut dyn Write) -> io::Result<()> {
    RowWriter::new(out).texts(names).end()
}

/// Writes a row.
///
/// # Errors
/// The writer's.
pub fn write_cells(cells: &[Cell<'_>], out: &mut dyn Write) -> io::Result<()> {
    let mut row = RowWriter::new(out);
    for cell in cells {
        match cell {
            Cell::Integer(value) => row.shown(value),
            Cell::Number(value) if value.is_finite() => row.number(*value),
            Cell::Number(_) | Cell::Missing => row.missing(),
            Cell::Text(text) => row.text(text),
        };
    }
    row.end()
}

/// Writes a table cell by cell; [`RowWriter::end`] ends a row. All tables of this crate are written by it.
pub struct RowWriter<'w> {
    out: &'w mut dyn Write,
    line: Vec<u8>,
    /// Whether the row has a cell: the first may be empty.
    begun: bool,
    decimal: ryu::Buffer,
}

impl<'w> RowWriter<'w> {
    /// Returns a writer of rows.
    pub fn new(out: &'w mut dyn Write) -> Self {
        Self {
            out,
            line: Vec::new(),
            begun: false,
            decimal: ryu::Buffer::new(),
        }
    }

    /// Adds an empty cell.
    pub fn missing(&mut self) -> &mut Self {
        if self.begun {
            self.line.push(b',');
        }
        self.begun = true;
        self
    }

    /// Adds a text, in quotation marks where it has a comma, a quotation mark or an end of line.
    pub fn text(&mut self, text: &str) -> &mut Self {
        self.missing();
        if text.contains(['"', ',', '\n', '\r']) {
            self.line
                .extend_from_slice(format!("\"{}\"", text.replace('"', "\"\"")).as_bytes());
        } else {
            self.line.extend_from_slice(text.as_bytes());
        }
        self
    }

    /// Adds texts.
    pub fn texts<'t>(&mut self, texts: impl IntoIterator<Item = &'t str>) -> &mut Self {
        for text in texts {
            self.text(text);
        }
        self
    }

    /// Adds a number in its shortest form, with an exponent where that is shorter.
    pub fn number(&mut self, value: f64) -> &mut Self {
        self.missing();
        let text = self.decimal.format(value);
        self.line
            .extend_from_slice(text.strip_suffix(".0").unwrap_or(text).as_bytes());
        self
    }

    /// Adds a number as it is displayed.
    pub fn shown(&mut self, number: impl Display) -> &mut Self {
        self.missing();
        write!(self.line, "{number}").unwrap_or_default();
        self
    }

    /// Adds a number without the errors of a conversion: to twelve digits.
    pub fn plain(&mut self, number: f64) -> &mut Self {
        self.shown(rounded(number))
    }

    /// Adds a number as it is displayed, or an empty cell where it is not finite.
    pub fn finite(&mut self, number: f64) -> &mut Self {
        match number.is_finite() {
            true => self.shown(number),
            false => self.missing(),
        }
    }

    /// Ends the row.
    ///
    /// # Errors
    /// The writer's.
    pub fn end(&mut self) -> io::Result<()> {
        self.line.push(b'\n');
        self.out.write_all(&self.line)?;
        self.line.clear();
        self.begun = false;
        Ok(())
    }
}
