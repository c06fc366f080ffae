//! The points that were computed, kept in a folder so that they survive the end of the program.
//!
//! ```text
//! space.json      what the points are of: parameters with their ranges, statements with their predicates
//! points.jsonl    one line of JSON a point, appended as it is done; one that was cut off is computed again
//! ```

use std::collections::BTreeMap;
use std::fs::{self, OpenOptions, TryLockError};
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::sync::{Mutex, PoisonError};

use input::file::{Expected, ReadError, Reason, read, read_text};
use input::{FileType, limits};
use miette::Diagnostic;
use serde::{Deserialize, Serialize};
use staging::Locked;
use thiserror::Error;

use super::axes::AXES;
use super::point::PointOutcome;
use super::space::{FRICTIONS, PointPlace, Space};
use crate::claims::{ClaimVerdict, claims};

/// The folder, beside the report.
pub const FOLDER: &str = "sensitivity";
const SPACE_FILE: &str = "space.json";
/// The file of the points.
pub const POINTS_FILE: &str = "points.jsonl";
/// Version of both files.
const SCHEMA: &str = "wedgelab.sensitivity_points/1";

const SPACE_EXPECTED: Expected = Expected {
    what: "description of points",
    types: &[FileType::Json],
    most: limits::RECORD_FILE,
};
/// The expected file of points. Damage at the beginning may look like anything.
const POINTS_EXPECTED: Expected = Expected {
    what: "file of points",
    types: &FileType::ALL,
    most: limits::RECORD_FILE,
};

/// Reasons why points cannot be kept.
#[derive(Debug, Error, Diagnostic)]
pub enum PointsFileError {
    /// A file or folder cannot be read or written.
    #[error("cannot read or write `{}`: {reason}", .file.display())]
    #[diagnostic(help(
        "the points kept before are whole; look for space and rights, or choose another folder with --out"
    ))]
    File {
        /// The file.
        file: PathBuf,
        /// The reason.
        reason: io::Error,
    },
    /// The folder holds points of another space, of other statements or of another version.
    #[error("`{}` holds points of another space or of other statements", .folder.display())]
    #[diagnostic(help("begin anew with --force, or choose another folder with --out"))]
    Changed {
        /// The folder.
        folder: PathBuf,
    },
    /// Another program works there.
    #[error("another program computes points in `{}`", .folder.display())]
    #[diagnostic(help("wait for it, or choose another folder with --out"))]
    Busy {
        /// The folder.
        folder: PathBuf,
    },
}

/// A line.
#[derive(Debug, Serialize, Deserialize)]
struct Line {
    /// [`PointPlace::key`].
    point: String,
    /// The settings there.
    set: Vec<String>,
    /// A letter for each statement: h holds, n does not, u cannot be decided.
    verdicts: String,
    /// [`PointOutcome::axes`].
    axes: Vec<bool>,
    /// [`PointOutcome::unsound`].
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    unsound: Vec<String>,
}

fn letter(verdict: ClaimVerdict) -> char {
    match verdict {
        ClaimVerdict::Holds => 'h',
        ClaimVerdict::DoesNot => 'n',
        ClaimVerdict::CannotBeDecided => 'u',
    }
}

fn verdict(letter: char) -> Option<ClaimVerdict> {
    [
        ClaimVerdict::Holds,
        ClaimVerdict::DoesNot,
        ClaimVerdict::CannotBeDecided,
    ]
    .into_iter()
    .find(|verdict| self::letter(*verdict) == letter)
}

/// The points of a folder.
#[derive(Debug)]
pub struct PointsFile {
    folder: PathBuf,
    found: BTreeMap<String, PointOutcome>,
    points: Mutex<Locked>,
}

impl PointsFile {
    /// Opens the folder, which is made if it is not there. With `anew`, points of another space are dropped.
    ///
    /// # Errors
    /// It cannot be read or written, another program works there, or it holds points of another space.
    pub fn open(folder: &Path, space: &Space, anew: bool) -> Result<Self, PointsFileError> {
        let failed = |file: &Path| {
            let file = file.to_owned();
            move |reason| PointsFileError::File { file, reason }
        };
        fs::create_dir_all(folder).map_err(failed(folder))?;
        let file = folder.join(POINTS_FILE);
        let opened = OpenOptions::new()
            .read(true)
            .append(true)
            .create(true)
            .open(&file);
        let mut points = Locked::new(opened.map_err(failed(&file))?).map_err(|error| match error {
            TryLockError::WouldBlock => PointsFileError::Busy {
                folder: folder.to_owned(),
            },
            TryLockError::Error(reason) => failed(&file)(reason),
        })?;
        let description = describe(space);
        let manifest = folder.join(SPACE_FILE);
        let length = points.file().metadata().map_err(failed(&file))?.len();
        let is_same = read_text(&manifest, &SPACE_EXPECTED).is_ok_and(|found| found == description);
        if !is_same {
            if length > 0 && !anew {
                return Err(PointsFileError::Changed {
                    folder: folder.to_owned(),
                });
            }
            points.file().set_len(0).map_err(failed(&file))?;
            fs::write(&manifest, &description).map_err(failed(&manifest))?;
        }
        let text = read(&file, &POINTS_EXPECTED).map_err(|error| failed(&file)(reason(error)))?;
        if text.last().is_some_and(|last| *last != b'\n') {
            // The next line must not go on in one that was cut off.
            points.file().write_all(b"\n").map_err(failed(&file))?;
        }
        let lines = text.split(|byte| *byte == b'\n');
        Ok(Self {
            folder: folder.to_owned(),
            found: lines.filter_map(|line| point(line, space)).collect(),
            points: Mutex::new(points),
        })
    }

    /// Those of these places that are not there.
    #[must_use]
    pub fn missing(&self, places: &[PointPlace]) -> Vec<PointPlace> {
        let missing = places
            .iter()
            .filter(|place| !self.found.contains_key(&place.key()));
        missing.copied().collect()
    }

    /// Returns the stored outcome at a place.
    #[must_use]
    pub fn found(&self, place: PointPlace) -> Option<&PointOutcome> {
        self.found.get(&place.key())
    }

    /// Keeps what was found at a place: when this returns, it survives the end of the program.
    ///
    /// # Errors
    /// It cannot be written.
    pub fn keep(
        &self,
        space: &Space,
        place: PointPlace,
        found: &PointOutcome,
    ) -> Result<(), PointsFileError> {
        let line = Line {
            point: place.key(),
            set: space.set(place),
            verdicts: found.verdicts.iter().map(|verdict| letter(*verdict)).collect(),
            axes: found.axes.clone(),
            unsound: found.unsound.clone(),
        };
        let written = serde_json::to_string(&line)
            .map_err(io::Error::other)
            .and_then(|mut text| {
                text.push('\n');
                let mut points = self.points.lock().unwrap_or_else(PoisonError::into_inner);
                points.file().write_all(text.as_bytes())
            });
        written.map_err(|reason| PointsFileError::File {
            file: self.folder.join(POINTS_FILE),
            reason,
        })
    }
}

fn reason(error: ReadError) -> io::Error {
    match error.reason {
        Reason::System(reason) => reason,
        _ => io::Error::other(error.to_string()),
    }
}

/// Returns a line's point with what was found; `None` if it is cut off or damaged.
fn point(line: &[u8], space: &Space) -> Option<(String, PointOutcome)> {
    let line: Line = serde_json::from_slice(line).ok()?;
    let verdicts: Vec<ClaimVerdict> = line.verdicts.chars().map(verdict).collect::<Option<_>>()?;
    // What is set tells of a point that another version numbered otherwise.
    let is_own = PointPlace::of_key(&line.point).is_some_and(|place| space.set(place) == line.set);
    let is_whole = verdicts.len() == claims().count() && line.axes.len() == AXES.len();
    (is_own && is_whole).then_some((
        line.point,
        PointOutcome {
            verdicts,
            axes: line.axes,
            unsound: line.unsound,
        },
    ))
}

/// Returns the text that decides the outcome at a point.
fn describe(space: &Space) -> String {
    #[derive(Serialize)]
    struct Description<'d> {
        schema: &'static str,
        program: String,
        parameters: Vec<&'d study::design::Factor>,
        frictions: Vec<&'static str>,
        statements: BTreeMap<&'static str, &'static str>,
    }
    let description = Description {
        schema: SCHEMA,
        program: format!("wedgelab {}", env!("CARGO_PKG_VERSION")),
        parameters: space
            .parameters
            .iter()
            .map(|parameter| &parameter.factor)
            .collect(),
        frictions: FRICTIONS.iter().map(|friction| friction.set).collect(),
        statements: claims().map(|claim| (claim.id, claim.code)).collect(),
    };
    serde_json::to_string_pretty(&description).unwrap_or_default()
}
