//! Mistakes in measured tables: what, where, and what to do.

use quantity::SixDigits;
use thiserror::Error;

use super::chord::ChordError;
use super::gaps::Gap;
use super::segments::TrackError;

/// Reasons why a measured table is no track.
#[derive(Debug, Error)]
pub enum MeasuredError {
    /// The file cannot be read.
    #[error(transparent)]
    File(#[from] input::file::ReadError),
    /// A line is wrong.
    #[error("{name}:{line}: {found}")]
    Line {
        /// The file.
        name: String,
        /// The line, from 1.
        line: usize,
        /// The kind found there.
        found: String,
        /// The advice.
        remedy: String,
    },
    /// Only mid-chord offsets where space curves are expected.
    #[error(
        "{name}: the column {column} holds mid-chord offsets; an irregularity of 39 ft appears in offsets \
         of 62 ft 0.72 times as large, one of 31 ft not at all: offsets are no profile"
    )]
    MidChord {
        /// The file.
        name: String,
        /// The column.
        column: String,
    },
    /// A column of another kind than the form that is asked for.
    #[error("{name}: {column} holds {held}, and another form is asked for")]
    OtherKind {
        /// The file.
        name: String,
        /// The column.
        column: &'static str,
        /// What it holds, in words.
        held: String,
    },
    /// Something that is needed is not in the table.
    #[error("{name}: there is no column {needed}")]
    Missing {
        /// The file.
        name: String,
        /// The missing column.
        needed: &'static str,
    },
    /// A gap that is too long to be filled.
    #[error(
        "{name}: {gap}: a gap of {} m; up to {} m are filled",
        SixDigits(gap.length()), SixDigits(*longest)
    )]
    Gap {
        /// The file.
        name: String,
        /// The gap.
        gap: Gap,
        /// Length up to which gaps are filled, m.
        longest: f64,
    },
    /// A column that has no number at an end of the table.
    #[error("{name}: {column} has no number in {rows} rows at {at} m, at an end of the table")]
    End {
        /// The file.
        name: String,
        /// The column.
        column: &'static str,
        /// The number of rows.
        rows: usize,
        /// The distance of the table's end, m.
        at: SixDigits,
    },
    /// Values cannot be a spline.
    #[error("{what}")]
    Samples {
        /// The mistake.
        what: String,
    },
    /// Offsets cannot be inverted.
    #[error(transparent)]
    Chord(#[from] ChordError),
    /// The center line cannot be.
    #[error(transparent)]
    Track(#[from] TrackError),
}

impl MeasuredError {
    /// Returns the line of the table, from 1, if the mistake lies in one.
    #[must_use]
    pub const fn line(&self) -> Option<usize> {
        match self {
            Self::Line { line, .. } => Some(*line),
            _ => None,
        }
    }

    /// Returns the remedy.
    #[must_use]
    pub fn remedy(&self) -> String {
        match self {
            Self::Line { remedy, .. } => remedy.clone(),
            Self::MidChord { .. } => "give space curves; or write form = \"mid_chord\" with chord = \"62 \
                                      ft\" and the wavelengths over which to invert it, such as shortest \
                                      = \"35 ft\", longest = \"370 ft\""
                .to_owned(),
            Self::OtherKind { .. } => "state the form and the chord of these columns, or read columns of \
                                       another form by another [[irregularities]] with its own columns"
                .to_owned(),
            Self::Gap { .. } => "measure the gap, or state the length up to which the spline is to fill \
                                 gaps, such as gaps = \"20 ft\": waves shorter than twice that length are \
                                 lost in it; where only the milepost jumps, write a station equation"
                .to_owned(),
            Self::End { .. } => "leave these rows out: a table may end before the track (beyond = \
                                 \"level\") and begin later (start)"
                .to_owned(),
            Self::Missing { .. } => "docs/wheelrail.md lists the columns".to_owned(),
            Self::Chord(_) => "state other wavelengths, or give space curves".to_owned(),
            Self::File(_) | Self::Samples { .. } | Self::Track(_) => "look at the table".to_owned(),
        }
    }
}
