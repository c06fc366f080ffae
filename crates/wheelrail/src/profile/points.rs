//! Points of a profile from files: CSV with units in its header, Simpack `.prr` and `.prw`.
//!
//! **CSV.** Lines that begin with `#` are comments. The first other line is the header: one column for y, one
//! for z, each with its unit in brackets, such as `y [mm], z [mm]` or `y_gauge (in); z_down (in)`. Names say
//! the sense:
//!
//! | column | positive |
//! |---|---|
//! | `y`, `y_field` | towards the field side, away from the track's center |
//! | `y_gauge` | towards the gauge side |
//! | `z`, `z_up` | up |
//! | `z_down` | down |
//!
//! Other columns are left aside. Commas, semicolons and tabs separate; numbers have decimal points, or
//! decimal commas between semicolons and tabs.
//!
//! **Simpack.** `!` and `%` begin comments, between points too. Of the keys, the unit factor, shifts,
//! rotation, bounds and mirroring are applied in the order of their numbers in the file; approximations and
//! weights are not. y is then positive to the field side (to the right, on the right side of the track) and z
//! down.

use std::path::Path;

use input::file::{Expected, Reason};
use input::{FileType, Separated, limits, shortened};
use quantity::{Kind as Dimension, Quantity};

use super::ProfileKind;
use super::error::{ProfileError, ProfilePlace};

/// Points of a profile, m: y to the field side, z up.
#[derive(Clone, Debug, PartialEq)]
pub struct Points {
    /// The file as named, or a name.
    pub name: String,
    /// The kind that the file names.
    pub kind: Option<ProfileKind>,
    /// y and z, m.
    pub points: Vec<[f64; 2]>,
    /// The line of each point, from 1; the number of the point where there is no file.
    pub lines: Vec<usize>,
}

impl Points {
    /// Returns points (m, y to the field side, z up) that come from no file.
    #[must_use]
    pub fn new(name: &str, points: &[[f64; 2]]) -> Self {
        Self {
            name: name.to_owned(),
            kind: None,
            points: points.to_vec(),
            lines: (1..=points.len()).collect(),
        }
    }

    /// Reads a file; its extension says which format it has.
    ///
    /// # Errors
    /// The file is not read, or a line of it is wrong.
    pub fn read(path: &Path) -> Result<Self, ProfileError> {
        let expected = Expected {
            what: "profile",
            types: &[FileType::Profile],
            most: limits::TEXT_FILE,
        };
        let extension = path.extension().and_then(|extension| extension.to_str());
        let parse: fn(&str, &str) -> Result<Self, ProfileError> =
            match extension.map(str::to_ascii_lowercase).as_deref() {
                Some("csv") => Self::from_csv,
                Some("prr" | "prw") => Self::from_simpack,
                _ => {
                    // What it is tells more than that its name tells nothing.
                    input::file::read(path, &expected).map_err(|error| match error.reason {
                        Reason::WrongType(_) => ProfileError::Read(error),
                        _ => ProfileError::UnknownFile {
                            path: path.to_owned(),
                        },
                    })?;
                    return Err(ProfileError::UnknownFile {
                        path: path.to_owned(),
                    });
                }
            };
        let text = input::file::read_text(path, &expected)?;
        parse(&path.display().to_string(), &text)
    }

    /// Returns the place of a point.
    #[must_use]
    pub fn place(&self, point: usize) -> ProfilePlace {
        ProfilePlace::line(&self.name, self.lines[point])
    }

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
        for (index, cell) in table.cells(header).enumerate() {
            let Some((axis, sign, unit)) = column(cell) else {
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
        let mut read = Self::new(name, &[]);
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

    /// Reads Simpack's format; `name` is what messages call it.
    ///
    /// # Errors
    /// A line is wrong, or there are too many.
    pub fn from_simpack(name: &str, text: &str) -> Result<Self, ProfileError> {
        let mut read = Self::new(name, &[]);
        let mut keys = SimpackKeys::default();
        // Spaces separate, points are the decimal signs.
        let mut table = Separated::of("");
        let (mut block, mut ended, mut last) = (String::new(), false, 1);
        for (index, line) in text.lines().enumerate() {
            let number = index + 1;
            last = number;
            let line = line.split(['!', '%']).next().unwrap_or("").trim();
            if line.is_empty() {
                continue;
            }
            if let Some(opened) = line.strip_suffix(".begin") {
                block = opened.to_ascii_lowercase();
            } else if line.ends_with(".end") {
                ended |= block == "point";
                block = String::new();
            } else if block == "point" {
                let mut cells = line.split_whitespace();
                let mut point = [0.0; 2];
                for value in &mut point {
                    *value = number_of(&mut table, name, number, cells.next().unwrap_or(""))?;
                }
                read.push(point, number)?;
            } else if let Some((key, value)) = line.split_once('=') {
                keys.set(name, number, &block, key.trim(), value.trim())?;
            }
        }
        if !ended {
            return Err(line_error(
                name,
                last,
                "the block of points does not end".into(),
                "a file of Simpack has its points between point.begin and point.end",
            ));
        }
        keys.apply(&mut read);
        Ok(read)
    }

    fn push(&mut self, point: [f64; 2], line: usize) -> Result<(), ProfileError> {
        if self.points.len() == limits::TABLE_ROWS {
            return Err(line_error(
                &self.name,
                line,
                format!("there are more than {} points", limits::TABLE_ROWS),
                "take points at least 0.01 mm apart",
            ));
        }
        self.points.push(point);
        self.lines.push(line);
        Ok(())
    }
}

const POINT: &str = "write one point a line, its numbers with decimal points, such as -12.5 (or with decimal \
                     commas, where semicolons or tabs stand between the columns)";
const HEADER: &str = "write a header such as: y [mm], z [mm] (y to the field side, z up; y_gauge and z_down \
                      for the opposite)";

fn line_error(name: &str, line: usize, found: String, remedy: &str) -> ProfileError {
    ProfileError::Line {
        place: ProfilePlace::line(name, line),
        found,
        remedy: remedy.to_owned(),
    }
}

fn number_of(table: &mut Separated, name: &str, line: usize, cell: &str) -> Result<f64, ProfileError> {
    match table.number(cell) {
        Ok(number) if number.abs() < 1e9 => Ok(number),
        Ok(number) => Err(line_error(name, line, format!("{number} is too large"), POINT)),
        Err(error) => Err(line_error(name, line, error.to_string(), POINT)),
    }
}

/// Returns axis, sign and unit of a column's title; none if it is another column.
fn column(cell: &str) -> Option<(usize, f64, Option<&str>)> {
    let cell = cell.trim().trim_matches('"').trim();
    let (title, unit) = match cell.find(['[', '(']) {
        Some(at) => (
            cell[..at].trim(),
            Some(cell[at + 1..].trim_end_matches([']', ')']).trim()),
        ),
        None => (cell, None),
    };
    let (axis, sign) = match title.to_ascii_lowercase().as_str() {
        "y" | "y_field" => (0, 1.0),
        "y_gauge" => (0, -1.0),
        "z" | "z_up" => (1, 1.0),
        "z_down" => (1, -1.0),
        _ => return None,
    };
    Some((axis, sign, unit.filter(|unit| !unit.is_empty())))
}

/// The keys that change points.
#[derive(Clone, Debug)]
struct SimpackKeys {
    kind: Option<ProfileKind>,
    shift: [f64; 2],
    rotate: f64,
    bounds: [[f64; 2]; 2],
    mirror: [bool; 2],
    /// User units in 1 m and 1 rad.
    units: [f64; 2],
}

impl Default for SimpackKeys {
    fn default() -> Self {
        Self {
            kind: None,
            shift: [0.0; 2],
            rotate: 0.0,
            bounds: [[1.0, 0.0]; 2],
            mirror: [false; 2],
            units: [1.0; 2],
        }
    }
}

impl SimpackKeys {
    fn set(
        &mut self,
        name: &str,
        line: usize,
        block: &str,
        key: &str,
        value: &str,
    ) -> Result<(), ProfileError> {
        let number = || number_of(&mut Separated::of(""), name, line, value);
        match (block, key) {
            ("header", "type") => {
                self.kind = Some(match number()? {
                    0.0 => ProfileKind::Rail,
                    1.0 => ProfileKind::Wheel,
                    other => {
                        let found = format!("the type {other} is unknown");
                        return Err(line_error(name, line, found, "0 is a rail, 1 is a wheel"));
                    }
                });
            }
            (_, "shift.y") => self.shift[0] = number()?,
            (_, "shift.z") => self.shift[1] = number()?,
            (_, "rotate") => self.rotate = number()?,
            (_, "bound.y.min") => self.bounds[0][0] = number()?,
            (_, "bound.y.max") => self.bounds[0][1] = number()?,
            (_, "bound.z.min") => self.bounds[1][0] = number()?,
            (_, "bound.z.max") => self.bounds[1][1] = number()?,
            (_, "mirror.y") => self.mirror[0] = number()? != 0.0,
            (_, "mirror.z") => self.mirror[1] = number()? != 0.0,
            (_, "units.len.f") => self.units[0] = positive(name, line, number()?)?,
            (_, "units.ang.f") => self.units[1] = positive(name, line, number()?)?,
            _ => {}
        }
        Ok(())
    }

    fn apply(&self, read: &mut Points) {
        read.kind = self.kind;
        let (sine, cosine) = libm::sincos(self.rotate / self.units[1]);
        let (points, lines) = (std::mem::take(&mut read.points), std::mem::take(&mut read.lines));
        for ([y, z], line) in points.into_iter().zip(lines) {
            let (y, z) = (y + self.shift[0], z + self.shift[1]);
            let (y, z) = (y * cosine - z * sine, y * sine + z * cosine);
            let inside = |value: f64, [low, high]: [f64; 2]| low > high || (low..=high).contains(&value);
            if !(inside(y, self.bounds[0]) && inside(z, self.bounds[1])) {
                continue;
            }
            let sign = self.mirror.map(|mirrored| if mirrored { -1.0 } else { 1.0 });
            // Simpack's z points down.
            read.points
                .push([sign[0] * y / self.units[0], -sign[1] * z / self.units[0]]);
            read.lines.push(line);
        }
    }
}

fn positive(name: &str, line: usize, number: f64) -> Result<f64, ProfileError> {
    match number > 0.0 {
        true => Ok(number),
        false => Err(line_error(
            name,
            line,
            format!("the unit factor {number} is not positive"),
            "1000 stands for mm, 1 for m",
        )),
    }
}
