//! The run file (`.RUN`): which files belong together, and how long the run is.

use super::{RawSection, Title};
use crate::source::Spanned;

/// A run file.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct RunFile {
    /// `\RUN TITLE`.
    pub title: Title,
    /// `\SYSTEM FILE`; the case of its letters need not be the file's.
    pub system: Option<Spanned<String>>,
    /// `\DATA FILE`.
    pub data: Option<Spanned<String>>,
    /// `\INPUT FILE`.
    pub input: Option<Spanned<String>>,
    /// `\CONTROL CONSTANTS`.
    pub control: Option<Control>,
    /// `\STEPPING CONSTANTS`.
    pub stepping: Option<Stepping>,
    /// Sections that are switched off or unknown.
    pub other: Vec<RawSection>,
}

/// `\CONTROL CONSTANTS`; their meaning is not published.
#[derive(Clone, Debug, PartialEq)]
pub struct Control {
    /// Presumably the kind of analysis.
    pub analysis: Spanned<u32>,
    /// Presumably equilibrium or restart.
    pub option: Spanned<u32>,
    /// A truth value.
    pub flag: Spanned<bool>,
}

/// `\STEPPING CONSTANTS`.
#[derive(Clone, Debug, PartialEq)]
pub struct Stepping {
    /// Presumably the largest step, s.
    pub step: Spanned<f64>,
    /// End of the run, s.
    pub end: Spanned<f64>,
    /// Interval of the results, s.
    pub output: Spanned<f64>,
}
