//! `result.csv`: one row an output time, one column an output; and other tables of the same form.
//!
//! A header of full names (`wedge_x_in`), numbers in the shortest decimal form that reads back to the same
//! bits, a point as decimal sign, `,` between columns, and `\n` at the end of every line. Contact states are
//! integers. What is missing or no number is an empty cell; texts with a comma, a quotation mark or an end of
//! line are in quotation marks (RFC 4180).

use std::io::{self, Write};

use quantity::{Kind, System as Units};
use study::result::RunResult;

use crate::output_table::{Cell, Description, RunTable};

/// The file's name.
pub const FILE_NAME: &str = "result.csv";

/// Writes the table of a run in the units of its summary.
///
/// # Errors
/// The writer's; or the columns differ in length.
pub fn write(result: &RunResult, out: &mut dyn Write) -> io::Result<()> {
    let columns = result.columns.iter().zip(&result.values);
    RunTable::of_run(columns, result.summary.units)?.write_csv(out)
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

/// Writes a table line by line.
pub struct Lines<'w> {
    out: &'w mut dyn Write,
    line: Vec<u8>,
    decimal: ryu::Buffer,
}

impl<'w> Lines<'w> {
    /// Writes the names of columns.
    ///
    /// # Errors
    /// The writer's.
    pub fn new(columns: &[Description], out: &'w mut dyn Write) -> io::Result<Self> {
        let mut lines = Self {
            out,
            line: Vec::new(),
            decimal: ryu::Buffer::new(),
        };
        lines.row(columns.iter().map(|column| Cell::from(column.name.as_str())))?;
        Ok(lines)
    }

    /// Writes a row.
    ///
    /// # Errors
    /// The writer's.
    pub fn row<'c>(&mut self, cells: impl IntoIterator<Item = Cell<'c>>) -> io::Result<()> {
        self.line.clear();
        for (place, cell) in cells.into_iter().enumerate() {
            if place > 0 {
                self.line.push(b',');
            }
            match cell {
                Cell::Integer(value) => write!(self.line, "{value}")?,
                Cell::Number(value) if !value.is_nan() => {
                    let text = self.decimal.format(value);
                    let text = text.strip_suffix(".0").unwrap_or(text);
                    self.line.extend_from_slice(text.as_bytes());
                }
                Cell::Decimal(value) if value.is_finite() => write!(self.line, "{value}")?,
                Cell::Text(text) if text.contains(['"', ',', '\n', '\r']) => {
                    write!(self.line, "\"{}\"", text.replace('"', "\"\""))?;
                }
                Cell::Text(text) => self.line.extend_from_slice(text.as_bytes()),
                Cell::Number(_) | Cell::Decimal(_) | Cell::Missing => {}
            }
        }
        self.line.push(b'\n');
        self.out.write_all(&self.line)
    }
}
