//! Errors in a table of results.

use std::io;
use std::path::{Path, PathBuf};

use input::file::{ReadError, Reason};
use input::{FileType, limits};
use miette::Diagnostic;
use quantity::nearest;
use thiserror::Error;

/// Reasons why a table of results cannot be read, or has not what is wanted of it. Lines and columns count
/// from one.
#[derive(Debug, Error, Diagnostic)]
pub enum TableError {
    /// There is no such file or folder.
    #[error("there is no result `{}`", .path.display())]
    #[diagnostic(help("{advice}"))]
    NotFound {
        /// The requested thing.
        path: PathBuf,
        /// The name that may have been meant.
        advice: String,
    },
    /// A folder without a result.
    #[error("the folder `{}` holds no result.parquet or result.csv", .folder.display())]
    #[diagnostic(help("{advice}"))]
    NoResult {
        /// The folder.
        folder: PathBuf,
        /// The advice: folders and files that may be results.
        advice: String,
    },
    /// The system does not let us read it.
    #[error("cannot read `{}`: {reason}", .file.display())]
    #[diagnostic(help("look for rights, and whether another program holds the file"))]
    Unreadable {
        /// The file.
        file: PathBuf,
        /// The reason.
        reason: io::Error,
    },
    /// Not a table of numbers as text at all.
    #[error("`{}` is {what}; a table is expected: lines of numbers with `,` between them, below a line of \
             names", .file.display())]
    #[diagnostic(help("{advice}"))]
    Foreign {
        /// The file.
        file: PathBuf,
        /// The type that it seems to have.
        what: &'static str,
        /// The command that takes such a file, or the file to name instead.
        advice: String,
    },
    /// A Parquet file that cannot be understood.
    #[error("the Parquet table `{}` is damaged: {reason}", .file.display())]
    #[diagnostic(help("write or copy it again; `wedgelab run` on the case.toml beside it makes it"))]
    Damaged {
        /// The file.
        file: PathBuf,
        /// The finding.
        reason: String,
    },
    /// It is larger than what is read, or has more numbers.
    #[error("`{}`, line {line}: the table has more than {} numbers", .file.display(), limits::RESULT_CELLS)]
    #[diagnostic(help("leave out columns, or every second row"))]
    TooLarge {
        /// The file.
        file: PathBuf,
        /// The line that is one too many.
        line: u64,
    },
    /// A line is longer than what is read.
    #[error("`{}`, line {line}: the line has more than {} bytes", .file.display(), limits::LINE)]
    #[diagnostic(help("look whether the file has line ends; a table has a line for each time"))]
    LongLine {
        /// The file.
        file: PathBuf,
        /// The line.
        line: u64,
    },
    /// The first line holds no names that columns may have.
    #[error("`{}`, line {line}: {problem}", .file.display())]
    #[diagnostic(help("{advice}"))]
    Header {
        /// The file.
        file: PathBuf,
        /// The line of names.
        line: u64,
        /// The findings.
        problem: String,
        /// The advice.
        advice: String,
    },
    /// Two columns have the same name.
    #[error("`{}`, line {line}: columns {first} and {second} are both `{name}`", .file.display())]
    #[diagnostic(help("leave one of them out"))]
    Duplicate {
        /// The file.
        file: PathBuf,
        /// The line of names.
        line: u64,
        /// The name without unit.
        name: String,
        /// The first of the two.
        first: usize,
        /// The second.
        second: usize,
    },
    /// Columns in US customary units and in SI units.
    #[error("`{}`, line {line}: `{us}` is in US customary units and `{si}` in SI units", .file.display())]
    #[diagnostic(help("a table is in one system of units: convert the columns of the other"))]
    Mixed {
        /// The file.
        file: PathBuf,
        /// The line of names.
        line: u64,
        /// The first column in US customary units.
        us: String,
        /// The first column in SI units.
        si: String,
    },
    /// Names without numbers below.
    #[error("`{}` has a line of names and no numbers below it", .file.display())]
    #[diagnostic(help("the run that wrote it may have been stopped; run it again"))]
    NoRows {
        /// The file.
        file: PathBuf,
    },
    /// The last line ends too early.
    #[error("`{}`, line {line}: the last line has {found} of {expected} numbers: the file is cut \
             off", .file.display())]
    #[diagnostic(help("write or copy it again, or remove its last line"))]
    Truncated {
        /// The file.
        file: PathBuf,
        /// The line.
        line: u64,
        /// Number of its numbers.
        found: usize,
        /// The expected number.
        expected: usize,
    },
    /// A line with too few or too many numbers.
    #[error("`{}`, line {line}: {found} cells, where the line of names has {expected}", .file.display())]
    #[diagnostic(help("every line has one number a column, `,` between them and a point as decimal sign"))]
    Ragged {
        /// The file.
        file: PathBuf,
        /// The line.
        line: u64,
        /// Number of its cells.
        found: usize,
        /// The expected number.
        expected: usize,
    },
    /// A cell that is no finite number.
    #[error("`{}`, line {line}, column {column} (`{name}`): \"{text}\" is not a finite \
             number", .file.display())]
    #[diagnostic(help("every cell below the names is a number such as -12.5 or 1.5e-3"))]
    NotANumber {
        /// The file.
        file: PathBuf,
        /// The line.
        line: u64,
        /// The column.
        column: usize,
        /// The column's name as in the file.
        name: String,
        /// The value there.
        text: String,
    },
    /// Time stands still or runs back.
    #[error("`{}`, line {line}, column {column} (`{name}`): the time {time} s follows {before} \
             s", .file.display())]
    #[diagnostic(help(
        "times increase from line to line: sort the lines, or remove those that repeat a time"
    ))]
    NotIncreasing {
        /// The file.
        file: PathBuf,
        /// The line.
        line: u64,
        /// The column.
        column: usize,
        /// The column's name as in the file.
        name: String,
        /// The time, s.
        time: f64,
        /// The time of the line before, s.
        before: f64,
    },
    /// A column that is wanted is not there.
    #[error("`{}` has no column `{name}`", .file.display())]
    #[diagnostic(help("{advice}"))]
    NoColumn {
        /// The file.
        file: PathBuf,
        /// The column wanted.
        name: String,
        /// The name that may have been meant.
        advice: String,
    },
}

impl TableError {
    /// Returns a file that holds something else.
    pub(crate) fn foreign(file: &Path, what: &'static str) -> Self {
        Self::Foreign {
            file: file.to_owned(),
            what,
            advice:
                "name a result.parquet or result.csv, the folder it is in, or another table with columns \
                     such as time_s, wedge_x_in"
                    .to_owned(),
        }
    }

    /// Returns the table of a study, which has no times.
    pub(crate) fn of_study(file: &Path) -> Self {
        Self::Foreign {
            file: file.to_owned(),
            what: "the table of a study, which has no times",
            advice: "its page, index.html beside it, draws it; spreadsheets, pandas and DuckDB read it"
                .to_owned(),
        }
    }

    /// Returns a file of another type.
    pub(super) fn of_type(file: &Path, found: FileType) -> Self {
        Self::Foreign {
            file: file.to_owned(),
            what: found.name(),
            advice: found.advice(&file.display().to_string()),
        }
    }

    /// Returns a file that was not read.
    pub(super) fn of_file(file: &Path, error: ReadError) -> Self {
        match error.reason {
            Reason::WrongType(found) => Self::of_type(file, found),
            Reason::System(reason) => Self::Unreadable {
                file: file.to_owned(),
                reason,
            },
            _ => Self::Unreadable {
                file: file.to_owned(),
                reason: io::Error::other(error.to_string()),
            },
        }
    }
}

/// "did you mean ...?" among the names of columns.
pub(super) fn suggest<'n>(typed: &str, names: impl Iterator<Item = &'n str> + Clone) -> String {
    const MOST: usize = 6;
    if let Some(near) = nearest(typed, names.clone()) {
        return format!("did you mean {near}?");
    }
    // Part of a name, or its words in another order.
    let words: Vec<String> = typed.to_lowercase().split('_').map(str::to_owned).collect();
    let has_all = |name: &&str| {
        words
            .iter()
            .all(|word| !word.is_empty() && name.to_lowercase().contains(word))
    };
    let alike: Vec<&str> = names.clone().filter(has_all).collect();
    let (list, beginning) = if alike.is_empty() {
        (names.collect(), "its columns are")
    } else {
        (alike, "columns with these words are")
    };
    let shown = list.iter().take(MOST).copied().collect::<Vec<&str>>().join(", ");
    match list.len().saturating_sub(MOST) {
        0 => format!("{beginning} {shown}"),
        more => format!("{beginning} {shown}, and {more} more"),
    }
}
