//! The contents of files, typed, with the place of every value.
//!
//! Values stay as typed, in the files' units: lb, in, s, rad (wedge angles: degrees), masses in lb·s²/in.
//! Axes: x forward from the leading axle, y to the left, z up from the rail.

mod data;
mod element;
mod input;
mod run;
mod system;

pub use data::{
    BodyDofs, Component, DataFile, DataRequest, DataSection, DofQuantity, ElementQuantity, Sum, Terms,
};
pub use element::{Characteristic, DirectionGroup, DirectionPair, Law, Single, Toe, Triple, UnknownValue};
pub use input::{Argument, History, HistoryShape, InputFile, Segment};
pub use run::{Control, RunFile, Stepping};
pub use system::{Body, Connection, Dof, DofKind, Element, InputBody, PiecewiseLinear, SystemFile};

use crate::source::Spanned;

/// The title of a file, and the free text below it.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Title {
    /// The first line.
    pub text: Spanned<String>,
    /// The lines up to the next keyword, without comments and blank lines.
    pub notes: Vec<Spanned<String>>,
}

/// A section that is kept but not understood.
#[derive(Clone, Debug, PartialEq)]
pub struct RawSection {
    /// Its keyword in capitals, without `\`.
    pub keyword: Spanned<String>,
    /// Switched off by `$` before the `\`; otherwise its keyword is unknown.
    pub off: bool,
    /// Its lines, without blank ones and comments.
    pub lines: Vec<Spanned<String>>,
}
