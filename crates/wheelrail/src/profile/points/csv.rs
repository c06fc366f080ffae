//! Points from CSV with units in its header; see [`points`](super) for its columns.

use input::{Separated, shortened};
use quantity::{Kind as Dimension, Quantity};

use super::{POINT, Points, WheelDatum, line_error, number_of};
use crate::profile::ProfileError;

const HEADER: &str = "write a header such as: y [mm], z [mm] (y to the field side, z up; y_gauge and z_down \
                      for the opposite; y_from_back for y from the back of a wheel's flange)";

impl Points {
    /// Reads CSV; `name` is what messages call it.
    ///
    /// # Errors
    /// A line is wrong, or there are too many.
    pub fn from_csv(name: &str, text: &str) -> Result<Self, ProfileError> {
        let mut lines = text.lines().enumerate().filter(|(_, line)| {
            let line = line.trim();
            !line.is_empty() && !line.starts_with('#')
        });
        let Some((number, header)) = lines.next() else {
            return Err(line_error(name, 1, "there is no header".into(), HEADER));
        };
        let mut table = Separated::of(header);
        let titles = table.cells(header).count();
        let mut columns: [Option<(usize, f64)>; 2] = [None; 2];
        let mut datum = None;
        for (index, cell) in table.cells(header).enumerate() {
            let Some((axis, sign, unit, from_back)) = column(cell) else {
                continue;
            };
            let Some(unit) = unit else {
                let found = format!("the column {} has no unit", shortened(cell.trim()));
                return Err(line_error(name, number + 1, found, HEADER));
            };
            let factor = Quantity::parse_as(&format!("1 {unit}"), Dimension::Length);
            let factor = factor.map_err(|error| {
                let found = format!("the unit of the column {}: {error}", shortened(cell.trim()));
                line_error(name, number + 1, found, &error.help())
            })?;
            if columns[axis].replace((index, sign * factor.to_si())).is_some() {
                let found = format!("there are two columns {}", ["y", "z"][axis]);
                return Err(line_error(name, number + 1, found, "keep one of them"));
            }
            if from_back {
                datum = Some(WheelDatum::FlangeBack);
            }
        }
        let [Some(y), Some(z)] = columns else {
            let missing = if columns[0].is_none() { "y" } else { "z" };
            return Err(line_error(
                name,
                number + 1,
                format!("the header has no column {missing}"),
                HEADER,
            ));
        };
        let mut read = Self {
            datum,
            ..Self::new(name, &[])
        };
        for (number, line) in lines {
            if let Some(found) = table.surplus(line, titles) {
                return Err(line_error(name, number + 1, found, POINT));
            }
            let cells: Vec<&str> = table.cells(line).collect();
            let mut point = [0.0; 2];
            for (axis, (index, factor)) in [y, z].into_iter().enumerate() {
                let cell = cells.get(index).copied().unwrap_or("");
                point[axis] = factor * number_of(&mut table, name, number + 1, cell)?;
            }
            read.push(point, number + 1)?;
        }
        Ok(read)
    }
}

/// Returns axis, sign and unit of a column's title, and whether it counts from the back of the flange; none
/// if it is another column.
fn column(cell: &str) -> Option<(usize, f64, Option<&str>, bool)> {
    let cell = cell.trim().trim_matches('"').trim();
    let (title, unit) = match cell.find(['[', '(']) {
        Some(at) => (
            cell[..at].trim(),
            Some(cell[at + 1..].trim_end_matches([']', ')']).trim()),
        ),
        None => (cell, None),
    };
    let title = title.to_ascii_lowercase();
    let (axis, sign) = match title.as_str() {
        "y" | "y_field" | "y_from_back" => (0, 1.0),
        "y_gauge" => (0, -1.0),
        "z" | "z_up" => (1, 1.0),
        "z_down" => (1, -1.0),
        _ => return None,
    };
    let unit = unit.filter(|unit| !unit.is_empty());
    Some((axis, sign, unit, title == "y_from_back"))
}
