//! `result.csv`: one row an output time, one column an output; and other tables of the same form.
//!
//! A header of full names (`wedge_x_in`), numbers in the shortest decimal form that reads back to the same
//! bits, a point as decimal sign, `,` between columns, and `\n` at the end of every line. Contact states are
//! integers. What is missing or no number is an empty cell; texts with a comma, a quotation mark or an end of
//! line are in quotation marks (RFC 4180).

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
    let rows = values.first().map_or(0, Vec::len);
    if columns.len() != values.len() || values.iter().any(|values| values.len() != rows) {
        return Err(io::Error::other("the columns of the result differ in length"));
    }
    let mut line = Vec::new();
    for column in columns {
        separate(&mut line);
        line.extend_from_slice(column.full_name(units).as_bytes());
    }
    end(&mut line, out)?;
    let kinds: Vec<Kind> = columns.iter().map(|column| column.kind).collect();
    let mut decimal = ryu::Buffer::new();
    for row in 0..rows {
        for (kind, values) in kinds.iter().zip(values) {
            separate(&mut line);
            let value = converted(values[row], *kind, units);
            number(&mut line, value, &mut decimal);
        }
        end(&mut line, out)?;
    }
    Ok(())
}

/// Returns an SI value as files have it.
#[must_use]
pub fn converted(si: f64, kind: Kind, units: Units) -> f64 {
    si * kind.from_si(units)
}

/// Writes the names of columns.
///
/// # Errors
/// The writer's.
pub fn write_header<'n>(names: impl Iterator<Item = &'n str>, out: &mut dyn Write) -> io::Result<()> {
    let mut line = Vec::new();
    for (place, name) in names.enumerate() {
        next(&mut line, place);
        quoted(&mut line, name);
    }
    end(&mut line, out)
}

/// Writes a row.
///
/// # Errors
/// The writer's.
pub fn write_cells(cells: &[Cell<'_>], out: &mut dyn Write) -> io::Result<()> {
    let (mut line, mut decimal) = (Vec::new(), ryu::Buffer::new());
    for (place, cell) in cells.iter().enumerate() {
        next(&mut line, place);
        match cell {
            Cell::Integer(value) => line.extend_from_slice(value.to_string().as_bytes()),
            Cell::Number(value) if value.is_finite() => number(&mut line, *value, &mut decimal),
            Cell::Number(_) | Cell::Missing => {}
            Cell::Text(text) => quoted(&mut line, text),
        }
    }
    end(&mut line, out)
}

fn number(line: &mut Vec<u8>, value: f64, decimal: &mut ryu::Buffer) {
    let text = decimal.format(value);
    line.extend_from_slice(text.strip_suffix(".0").unwrap_or(text).as_bytes());
}

fn quoted(line: &mut Vec<u8>, text: &str) {
    if text.contains(['"', ',', '\n', '\r']) {
        line.extend_from_slice(format!("\"{}\"", text.replace('"', "\"\"")).as_bytes());
    } else {
        line.extend_from_slice(text.as_bytes());
    }
}

/// The first cells may be empty, so that it is the place that tells whether a comma is due.
fn next(line: &mut Vec<u8>, place: usize) {
    if place > 0 {
        line.push(b',');
    }
}

fn separate(line: &mut Vec<u8>) {
    if !line.is_empty() {
        line.push(b',');
    }
}

fn end(line: &mut Vec<u8>, out: &mut dyn Write) -> io::Result<()> {
    line.push(b'\n');
    out.write_all(line)?;
    line.clear();
    Ok(())
}
