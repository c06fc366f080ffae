//! Points from the files of MiniProf (Greenwood Engineering): `.whl` wheel, `.ban` rail, `.mpt` either.
//!
//! **New files** begin with lines `key=value`; an empty line ends them; rows follow. `ColumnDef` names the
//! columns, of which X and Y count; without it these are the first two. `XOffset` and `YOffset` are added.
//! `DiameterTaperline` is the diameter at the taper line, which lies `WheelDiameterTaperline` (70 if not
//! said) from the back of the flange. **Old files** begin with eight lines of text. Files of rows alone are
//! read too. Lengths are mm. After `!`, `"`, `%` and `#` comes a comment.
//!
//! X counts from the back of a wheel's flange to the field side, and grows to the field side of a rail. Y of
//! a wheel is positive towards the tip of the flange, Y of a rail up; files with the other sense exist, so
//! that the shape decides. Rows may run from either side.
//!
//! Sources: keys, columns, offsets and the two headers as the program CONTACT reads them (its open source,
//! revision 2707, 2025).

use input::Separated;

use super::{Points, WheelDatum, line_error, number_of};
use crate::profile::{ProfileError, ProfileKind, StatedLengths};

/// Lines of the header of old files.
const OLD_HEADER: usize = 8;
const MILLIMETER: f64 = 1e-3;
const ROW: &str = "MiniProf's files have lines key=value, an empty line, and rows of numbers in mm; old ones \
                   eight lines of text before the rows";

impl Points {
    /// Reads MiniProf's format; `name` is what messages call it, `kind` is that of the file's extension.
    ///
    /// # Errors
    /// A line is wrong, or there are too many.
    pub fn from_miniprof(name: &str, text: &str, kind: Option<ProfileKind>) -> Result<Self, ProfileError> {
        let mut read = Self {
            kind,
            datum: Some(WheelDatum::FlangeBack),
            any_sense: true,
            ..Self::new(name, &[])
        };
        let mut header = Header::default();
        let first = text.lines().map(uncommented).find(|line| !line.is_empty());
        let old = first.is_some_and(|line| !line.contains('=') && !is_row(line));
        let skipped = if old { OLD_HEADER } else { 0 };
        // Spaces separate; a comma is a decimal sign.
        let mut table = Separated::of("\t");
        for (index, line) in text.lines().enumerate().skip(skipped) {
            let number = index + 1;
            let line = uncommented(line);
            if line.is_empty() {
                continue;
            }
            if let Some((key, value)) = line.split_once('=') {
                header.set(name, number, key.trim(), value.trim())?;
                continue;
            }
            let cells: Vec<&str> = row(line).collect();
            let mut point = [0.0; 2];
            for (axis, value) in point.iter_mut().enumerate() {
                let cell = cells.get(header.columns[axis]).copied().unwrap_or("");
                *value = number_of(&mut table, name, number, cell)?;
            }
            read.push(
                [0, 1].map(|axis| MILLIMETER * (point[axis] + header.offsets[axis])),
                number,
            )?;
        }
        read.stated = StatedLengths {
            radius: header.diameter.map(|diameter| 0.5 * MILLIMETER * diameter),
            ..StatedLengths::default()
        };
        read.tape_from_back = header.tape_line.map(|length| MILLIMETER * length);
        Ok(read)
    }
}

fn uncommented(line: &str) -> &str {
    line.split(['!', '"', '%', '#']).next().unwrap_or("").trim()
}

/// Returns the cells of a row.
fn row(line: &str) -> impl Iterator<Item = &str> {
    line.split(|sign: char| sign.is_whitespace() || sign == ';')
        .map(|cell| cell.trim_end_matches(','))
        .filter(|cell| !cell.is_empty())
}

/// Returns whether a line holds numbers alone, at least two.
fn is_row(line: &str) -> bool {
    let mut table = Separated::of("\t");
    row(line).count() > 1 && row(line).all(|cell| table.number(cell).is_ok())
}

/// The keys that count.
struct Header {
    /// Columns of X and Y.
    columns: [usize; 2],
    /// XOffset and YOffset, mm.
    offsets: [f64; 2],
    /// Diameter at the taper line, mm.
    diameter: Option<f64>,
    /// Distance of the taper line from the back of the flange, mm.
    tape_line: Option<f64>,
}

impl Default for Header {
    fn default() -> Self {
        Self {
            columns: [0, 1],
            offsets: [0.0; 2],
            diameter: None,
            tape_line: None,
        }
    }
}

impl Header {
    fn set(&mut self, name: &str, line: usize, key: &str, value: &str) -> Result<(), ProfileError> {
        let number = || number_of(&mut Separated::of("\t"), name, line, value);
        // Devices write zero for what was not measured.
        let positive = || number().map(|number| (number > 0.0).then_some(number));
        match key.to_ascii_lowercase().as_str() {
            "columndef" => {
                let place = |wanted: &str| {
                    let found = value
                        .split(',')
                        .position(|own| own.trim().eq_ignore_ascii_case(wanted));
                    let missing = || format!("ColumnDef names no column {wanted}");
                    found.ok_or_else(|| line_error(name, line, missing(), ROW))
                };
                self.columns = [place("X")?, place("Y")?];
            }
            "xoffset" => self.offsets[0] = number()?,
            "yoffset" => self.offsets[1] = number()?,
            "diametertaperline" => self.diameter = positive()?,
            "wheeldiametertaperline" => self.tape_line = positive()?,
            _ => {}
        }
        Ok(())
    }
}
