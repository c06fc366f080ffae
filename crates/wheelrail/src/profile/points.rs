//! Points of a profile from files: CSV with units in its header, Simpack, MiniProf, VAMPIRE.
//!
//! | file | format |
//! |---|---|
//! | `.csv` | units and senses in the header, see below |
//! | `.prw`, `.prr` | Simpack |
//! | `.whl`, `.ban`, `.mpt` | MiniProf: a header of keys, eight lines of text, or rows alone |
//! | `.whe`, `.rai`, `.ral` | VAMPIRE, both sides in one file |
//!
//! Letters of extensions may be capitals. CONTACT's lists of such files over distance or angle are read by
//! [`SlicedProfile`](super::SlicedProfile).
//!
//! **CSV.** Lines that begin with `#` are comments. The first other line is the header: one column for y, one
//! for z, each with its unit in brackets, such as `y [mm], z [mm]` or `y_gauge (in); z_down (in)`. Names say
//! the sense:
//!
//! | column | positive |
//! |---|---|
//! | `y`, `y_field` | towards the field side, away from the track's center |
//! | `y_gauge` | towards the gauge side |
//! | `y_from_back` | towards the field side, from the back of a wheel's flange |
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

mod csv;
mod miniprof;
mod simpack;
mod vampire;

use std::path::Path;

use input::file::{Expected, Reason};
use input::{FileType, Separated, limits};

use super::error::{ProfileError, ProfilePlace};
use super::{ProfileKind, ProfileNotice, StatedLengths, WheelDatum};
use crate::contact::Side;

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
    /// Where y = 0 of a wheel lies; none if the file does not say.
    pub datum: Option<WheelDatum>,
    /// Distance of the tape circle from the back of the flange, m, for points measured from there; none if
    /// the file does not say.
    pub tape_from_back: Option<f64>,
    /// Whether z may point up or down in such files, so that the shape decides.
    pub any_sense: bool,
    /// Whether the highest point of a rail is its top of rail, whatever z it has.
    pub top_is_datum: bool,
    /// Lengths that the file states.
    pub stated: StatedLengths,
    /// Doubts about the file.
    pub notices: Vec<ProfileNotice>,
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
            datum: None,
            tape_from_back: None,
            any_sense: false,
            top_is_datum: false,
            stated: StatedLengths::default(),
            notices: Vec::new(),
        }
    }

    /// Reads a file; its extension says which format it has. `side` says which one is meant where a file has
    /// both sides of the track.
    ///
    /// # Errors
    /// The file is not read, or a line of it is wrong.
    pub fn read(path: &Path, side: Option<Side>) -> Result<Self, ProfileError> {
        let expected = Expected {
            what: "profile",
            types: &[FileType::Profile],
            most: limits::TEXT_FILE,
        };
        let extension = path.extension().and_then(|extension| extension.to_str());
        let parse: fn(&str, &str, Option<Side>) -> Result<Self, ProfileError> =
            match extension.map(str::to_ascii_lowercase).as_deref() {
                Some("csv") => |name, text, _| Self::from_csv(name, text),
                Some("prr" | "prw") => |name, text, _| Self::from_simpack(name, text),
                Some("whl") => |name, text, _| Self::from_miniprof(name, text, Some(ProfileKind::Wheel)),
                Some("ban") => |name, text, _| Self::from_miniprof(name, text, Some(ProfileKind::Rail)),
                Some("mpt") => |name, text, _| Self::from_miniprof(name, text, None),
                Some("whe" | "rai" | "ral") => Self::from_vampire,
                Some("slcs" | "slcw") => {
                    return Err(ProfileError::ListOfSlices {
                        path: path.to_owned(),
                    });
                }
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
        parse(&path.display().to_string(), &text, side)
    }

    /// Returns the place of a point.
    #[must_use]
    pub fn place(&self, point: usize) -> ProfilePlace {
        ProfilePlace::line(&self.name, self.lines[point])
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
pub(super) fn line_error(name: &str, line: usize, found: String, remedy: &str) -> ProfileError {
    ProfileError::Line {
        place: ProfilePlace::line(name, line),
        found,
        remedy: remedy.to_owned(),
    }
}

pub(super) fn number_of(
    table: &mut Separated,
    name: &str,
    line: usize,
    cell: &str,
) -> Result<f64, ProfileError> {
    match table.number(cell) {
        Ok(number) if number.abs() < 1e9 => Ok(number),
        Ok(number) => Err(line_error(name, line, format!("{number} is too large"), POINT)),
        Err(error) => Err(line_error(name, line, error.to_string(), POINT)),
    }
}
