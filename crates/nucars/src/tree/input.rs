//! The input file (`.INP`): histories of prescribed motions.

use super::{RawSection, Title};
use crate::source::{At, Spanned};

/// An input file.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct InputFile {
    /// `\INPUT TITLE`.
    pub title: Title,
    /// `\INPUT HISTORY DATA`.
    pub histories: Vec<History>,
    /// Sections that are switched off or unknown.
    pub other: Vec<RawSection>,
    pub(crate) lost: bool,
}

impl InputFile {
    /// Returns the history with this number.
    pub fn history(&self, number: u32) -> Option<&History> {
        self.histories.iter().find(|history| *history.number == number)
    }
}

/// The argument of a history.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Argument {
    /// 1: time, s.
    Time,
    /// 2: distance, ft.
    Distance,
}

/// A history: segments one after the other.
#[derive(Clone, Debug, PartialEq)]
pub struct History {
    /// Its number, which input bodies use.
    pub number: Spanned<u32>,
    /// The argument of the function.
    pub argument: Spanned<Argument>,
    /// Its segments.
    pub segments: Vec<Segment>,
    /// The whole record.
    pub span: At,
}

/// The shape of a segment on top of its base line.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum HistoryShape {
    /// 0: the base line alone.
    Null,
    /// 1: cusp.
    Cusp,
    /// 2: bend: from 0 to the amplitude over the first coefficient.
    Bend,
    /// 3: sine.
    Sin,
    /// 4: sine swept between two frequencies, Hz.
    Ssin,
}

impl HistoryShape {
    /// All of them, by their codes 0 to 4.
    pub const ALL: [HistoryShape; 5] = [
        HistoryShape::Null,
        HistoryShape::Cusp,
        HistoryShape::Bend,
        HistoryShape::Sin,
        HistoryShape::Ssin,
    ];

    /// Returns the shape with this code.
    pub fn from_code(code: u32) -> Option<Self> {
        HistoryShape::ALL.get(usize::try_from(code).ok()?).copied()
    }

    /// Returns its code.
    pub fn code(self) -> u32 {
        self as u32
    }

    /// Returns its name.
    pub fn name(self) -> &'static str {
        ["NULL", "CUSP", "BEND", "SIN", "SSIN"][self as usize]
    }
}

/// A segment of a history.
#[derive(Clone, Debug, PartialEq)]
pub struct Segment {
    /// Its number in the history, from 1.
    pub number: Spanned<u32>,
    /// Its shape.
    pub shape: Spanned<HistoryShape>,
    /// Its end, s or ft.
    pub end: Spanned<f64>,
    /// The base line at its start and its end, in or rad.
    pub base: [Spanned<f64>; 2],
    /// The two coefficients of the shape: SIN and SSIN: first and last frequency, Hz; BEND: rise and
    /// repetition, s or ft.
    pub coefficients: [Spanned<f64>; 2],
    /// Amplitude, in or rad.
    pub amplitude: Spanned<f64>,
    /// The whole record.
    pub span: At,
}
