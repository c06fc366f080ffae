//! Reasons why results cannot be compared.

use std::path::PathBuf;

use miette::Diagnostic;
use thiserror::Error;

use crate::table::TableError;
use study::case::CaseError;
use study::sections::CutError;

/// Reasons why results cannot be compared.
#[derive(Debug, Error, Diagnostic)]
pub enum ComparisonError {
    /// A result has not the column.
    #[error(transparent)]
    #[diagnostic(transparent)]
    Table(#[from] TableError),
    /// No column but the time is in all of them.
    #[error("`{}` and `{}` have no column in common but the time", .first.display(), .second.display())]
    #[diagnostic(help("{advice}"))]
    NothingInCommon {
        /// The first result.
        first: PathBuf,
        /// The one that shares nothing with it, or with those in between.
        second: PathBuf,
        /// Names that are near each other.
        advice: String,
    },
    /// Runs of different models.
    #[error(
        "`{}` is a run of {own} and `{}` one of {other}: a name that both have need not be the same quantity",
        .first.display(), .second.display()
    )]
    #[diagnostic(help(
        "choose by --columns those that are (both have {common}), with --map NAME=OTHER where names differ"
    ))]
    Models {
        /// The first result.
        first: PathBuf,
        /// What it is a run of.
        own: &'static str,
        /// The other.
        second: PathBuf,
        /// What the other is a run of.
        other: &'static str,
        /// Names of columns that both have.
        common: String,
    },
    /// Columns of the same names, none of which can be compared.
    #[error(
        "no column of `{}` and `{}` can be compared: {reasons}",
        .first.display(), .second.display()
    )]
    #[diagnostic(help("{advice}"))]
    NothingComparable {
        /// The first result.
        first: PathBuf,
        /// The other.
        second: PathBuf,
        /// The reasons, column by column.
        reasons: String,
        /// What to write instead.
        advice: String,
    },
    /// A column without unit that has one in the other result.
    #[error(
        "`{column}` has no unit in `{}`, and is {kind} in `{}`",
        .first.display(), .second.display()
    )]
    #[diagnostic(help("{advice}"))]
    NoUnit {
        /// The column.
        column: String,
        /// The result in which it has no unit.
        first: PathBuf,
        /// The one in which it has one.
        second: PathBuf,
        /// Its kind there.
        kind: &'static str,
        /// The names with unit.
        advice: String,
    },
    /// Two columns of one name measure different things.
    #[error("`{column}` is {own} in `{}` and {other} in `{}`", .first.display(), .second.display())]
    #[diagnostic(help("rename one of the two, or leave the column out with --columns"))]
    Kinds {
        /// The column.
        column: String,
        /// The first result.
        first: PathBuf,
        /// Its kind in the first.
        own: &'static str,
        /// The other.
        second: PathBuf,
        /// Its kind in the other.
        other: &'static str,
    },
    /// Numbers so large that differences, means or squares of them are not finite.
    #[error(
        "the comparison of `{column}` with `{result}` is not finite: its numbers are too large to compute \
         with"
    )]
    #[diagnostic(help("look for wrong units or damage in this column, or leave it out with --columns"))]
    NotFinite {
        /// The column.
        column: String,
        /// The result that is compared with the first one.
        result: String,
    },
    /// The time was asked for as a column.
    #[error("columns are compared at the same times; the time itself cannot be compared")]
    #[diagnostic(help("name other columns, such as vertical_wedge_force"))]
    Time,
    /// Sections of a length, and a result that has no distance.
    #[error(
        "`{}` has no column `distance` with a unit of length, and sections along the track need it",
        .file.display()
    )]
    #[diagnostic(help("{advice}"))]
    NoDistance {
        /// The result.
        file: PathBuf,
        /// What to do.
        advice: String,
    },
    /// No column is left but the one along which sections are cut.
    #[error(
        "sections are cut along `{column}`, which cannot be compared itself, and no other column is left"
    )]
    #[diagnostic(help("name other columns by --columns"))]
    Axis {
        /// The column.
        column: &'static str,
    },
    /// The axis that is cut turns back.
    #[error(
        "`{column}` in `{}` falls from {before} to {value} at its row {row}; sections need one that rises",
        .file.display()
    )]
    #[diagnostic(help(
        "leave rows out with --from and --to, or cut by time: --sections \"2 s\", or a file with from [s], \
         to [s]"
    ))]
    NotRising {
        /// The result.
        file: PathBuf,
        /// The column.
        column: &'static str,
        /// The row of numbers, from 1.
        row: usize,
        /// The value before, in words.
        before: String,
        /// The value, in words.
        value: String,
    },
    /// No part of the axis is in all results.
    #[error("the results have no part of `{axis}` in common: {spans}")]
    #[diagnostic(help("sections lie where all results are: run the case over the measured part"))]
    NothingBeside {
        /// The column.
        axis: &'static str,
        /// From where to where each of them goes.
        spans: String,
    },
    /// A section with fewer than two rows of a result.
    #[error(
        "`{}` has {rows} row{} in {section}; each section needs two or more",
        .file.display(), if *.rows == 1 { "" } else { "s" }
    )]
    #[diagnostic(help("name longer sections, or results with more rows"))]
    NoRows {
        /// The result.
        file: PathBuf,
        /// Its rows in the section.
        rows: usize,
        /// The section, in words.
        section: String,
    },
    /// There are no sections.
    #[error("{0}")]
    #[diagnostic(help("{}", .0.help()))]
    Sections(#[from] CutError),
    /// A file of accepted differences does not fit the results.
    #[error(transparent)]
    #[diagnostic(transparent)]
    Acceptance(#[from] CaseError),
    /// There are not two times within the span that all have.
    #[error("the results have no span of time in common: {spans}")]
    #[diagnostic(help("results are compared at equal times: run the cases over the same times"))]
    NoCommonTime {
        /// From when to when each of them goes.
        spans: String,
    },
}
