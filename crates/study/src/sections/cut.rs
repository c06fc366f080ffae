//! The sections into which results are cut: a number of them, their length, or a file.
//!
//! ```text
//! from [ft], to [ft]
//! 0, 300
//! 300, 600
//! ```

use std::path::{Path, PathBuf};

use input::file::{Expected, read_text};
use input::{limits, shortened};
use quantity::{Kind, Quantity, SixDigits, System as Units};
use thiserror::Error;

use super::FEWEST;
use crate::case::CaseError;
use crate::case::problem::{Problem, Problems, TomlSource};
use crate::case::table::{TableForm, read_csv};

/// Most sections; each has a point in the figures.
const MOST: usize = 10_000;
const HELP: &str = "write a number, a length or a time, or the name of a CSV file with the columns from and \
                    to: --sections 12, --sections \"100 m\", --sections sections.csv";

/// The axis along which results are cut.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Along {
    /// Distance along the track, m.
    Distance,
    /// Time, s.
    Time,
}

impl Along {
    /// Returns the name of its column.
    #[must_use]
    pub fn column(self) -> &'static str {
        match self {
            Self::Distance => "distance",
            Self::Time => "time",
        }
    }

    /// Returns its kind of quantity.
    #[must_use]
    pub fn kind(self) -> Kind {
        match self {
            Self::Distance => Kind::Distance,
            Self::Time => Kind::Time,
        }
    }

    /// Returns a place (m, s) in words, in a system of units.
    #[must_use]
    pub fn words(self, place: f64, units: Units) -> String {
        let kind = self.kind();
        format!("{} {}", SixDigits(place * kind.from_si(units)), kind.label(units))
    }
}

/// What is asked for.
#[derive(Clone, Debug, PartialEq)]
pub enum SectionRequest {
    /// So many of equal length.
    Count(usize),
    /// As many as there are of this length, m or s.
    Length(Along, f64),
    /// Those of a file, m or s.
    Listed(Along, Vec<[f64; 2]>),
}

/// Sections of results.
#[derive(Clone, Debug, PartialEq)]
pub struct Cut {
    /// From where to where each goes, m or s.
    pub sections: Vec<[f64; 2]>,
    /// What is left behind the last of a given length, m or s.
    pub rest: f64,
    /// Sections of a file that are left out, by their number from 1: not all results reach over them.
    pub beyond: Vec<usize>,
}

/// Reasons why there are no sections.
#[derive(Clone, Debug, PartialEq, Error)]
pub enum CutError {
    /// Fewer than two sections.
    #[error(
        "the results have {found} section{} in common, from {from} to {to}",
        if *.found == 1 { "" } else { "s" }
    )]
    TooFew {
        /// How many there are.
        found: usize,
        /// Where the common part begins, in words.
        from: String,
        /// Where it ends, in words.
        to: String,
        /// The length that gives twelve, in words.
        length: String,
    },
    /// More sections than figures can show.
    #[error("the results have {found} sections in common; at most {MOST} are compared")]
    TooMany {
        /// How many there are.
        found: usize,
    },
}

impl CutError {
    /// Returns the advice.
    #[must_use]
    pub fn help(&self) -> String {
        match self {
            Self::TooFew { length, .. } => format!(
                "a standard deviation needs two sections, and {FEWEST} to say something: --sections \
                 {FEWEST}, or sections of {length}"
            ),
            Self::TooMany { .. } => "name longer sections, or fewer of them".to_owned(),
        }
    }
}

impl SectionRequest {
    /// Reads what `--sections` says: a number of sections, their length or duration, or a file.
    ///
    /// # Errors
    /// It is none of these, or the file is wrong; all mistakes are reported together.
    pub fn parse(text: &str) -> Result<Self, CaseError> {
        let text = text.trim();
        let refused = |message: String| CaseError::from(Problem::new(message).help(HELP));
        if text.parse::<f64>().is_ok() {
            return match text.parse::<usize>() {
                Ok(count) if (2..=MOST).contains(&count) => Ok(Self::Count(count)),
                _ => Err(refused(format!(
                    "--sections {}: a whole number of sections from 2 to {MOST} is expected",
                    shortened(text)
                ))),
            };
        }
        let path = Path::new(text);
        if path.exists()
            || path
                .extension()
                .is_some_and(|own| own.eq_ignore_ascii_case("csv"))
        {
            return Self::read(path);
        }
        let quantity = Quantity::parse(text)
            .map_err(|error| refused(format!("--sections \"{}\": {error}", shortened(text))))?;
        let axes = [Along::Distance, Along::Time];
        let along = axes.into_iter().find(|own| quantity.check(own.kind()).is_ok());
        match along.filter(|_| quantity.to_si() > 0.0 && quantity.to_si().is_finite()) {
            Some(along) => Ok(Self::Length(along, quantity.to_si())),
            None => Err(refused(format!(
                "--sections \"{}\" is no length or time above zero",
                shortened(text)
            ))),
        }
    }

    /// Reads a file of sections: CSV with the columns `from` and `to`, both with the unit of a distance or a
    /// time.
    fn read(path: &Path) -> Result<Self, CaseError> {
        let expected = Expected {
            what: "file of sections",
            types: &[],
            most: limits::TEXT_FILE,
        };
        let text = read_text(path, &expected).map_err(|error| {
            let help = error.help().unwrap_or_else(|| HELP.to_owned());
            CaseError::from(Problem::new(error.to_string()).help(help))
        })?;
        Self::of_text(path, &text)
    }

    /// As from a file with this text; `path` is its name in messages.
    ///
    /// # Errors
    /// Something in it is wrong.
    pub fn of_text(path: &Path, text: &str) -> Result<Self, CaseError> {
        let along = match unit_of(text).is_some_and(|own| own.check(Kind::Time).is_ok()) {
            true => Along::Time,
            false => Along::Distance,
        };
        let form = TableForm::sections(along.kind());
        let mut problems = Problems::new();
        let source = TomlSource::new(PathBuf::from(path).display().to_string(), text);
        let rows = read_csv(&source, &form, &mut problems).unwrap_or_default();
        let mut listed: Vec<[f64; 2]> = Vec::with_capacity(rows.len());
        for row in &rows {
            let [from, to] = row.values.each_ref().map(Quantity::to_si);
            let before = listed.last().map_or(f64::NEG_INFINITY, |own| own[1]);
            let message = if to <= from {
                Some((
                    "this section does not end behind its beginning",
                    "from is below to",
                ))
            } else if from < before - 1e-9 * before.abs() {
                Some((
                    "this section begins before the one above ends",
                    "overlaps the one above",
                ))
            } else {
                None
            };
            if let Some((message, label)) = message {
                let problem = Problem::new(message).at(&row.place).label(label);
                problems.push(problem.help("sort the sections by place; none may count twice"));
            }
            listed.push([from, to]);
        }
        if problems.is_empty() && !(2..=MOST).contains(&listed.len()) {
            let message = format!(
                "{} sections in `{}`; from 2 to {MOST} are expected",
                listed.len(),
                path.display()
            );
            problems.push(Problem::new(message).help(HELP));
        }
        match problems.is_empty() {
            true => Ok(Self::Listed(along, listed)),
            false => Err(CaseError::new(problems).of("file of sections")),
        }
    }

    /// Returns the axis that it prescribes; `None` if distance and time are as good.
    #[must_use]
    pub fn along(&self) -> Option<Along> {
        match self {
            Self::Count(_) => None,
            Self::Length(along, _) | Self::Listed(along, _) => Some(*along),
        }
    }

    /// Cuts the part `[from, to]` (m, s) that all results have; words are in these units.
    ///
    /// # Errors
    /// There are fewer than two sections, or too many.
    pub fn cut(&self, along: Along, [from, to]: [f64; 2], units: Units) -> Result<Cut, CutError> {
        let equal = |length: f64, count: usize| -> Vec<[f64; 2]> {
            let place = |number: usize| match number == count {
                true => (from + length * count as f64).min(to),
                false => from + length * number as f64,
            };
            (0..count).map(|own| [place(own), place(own + 1)]).collect()
        };
        let whole = to - from;
        let mut cut = Cut {
            sections: Vec::new(),
            rest: 0.0,
            beyond: Vec::new(),
        };
        let found = match self {
            Self::Count(count) => *count,
            // A length that goes in whole numbers but for rounding loses none.
            Self::Length(_, length) => (whole / length * (1.0 + 1e-9)).floor().max(0.0) as usize,
            Self::Listed(_, listed) => {
                let slack = 1e-9 * whole;
                for (number, [first, last]) in listed.iter().enumerate() {
                    match *first >= from - slack && *last <= to + slack {
                        true => cut.sections.push([first.max(from), last.min(to)]),
                        false => cut.beyond.push(number + 1),
                    }
                }
                cut.sections.len()
            }
        };
        if found < 2 || whole <= 0.0 {
            return Err(CutError::TooFew {
                found: if whole > 0.0 { found } else { 0 },
                from: along.words(from, units),
                to: along.words(to, units),
                length: along.words(whole.max(0.0) / FEWEST as f64, units),
            });
        }
        if found > MOST {
            return Err(CutError::TooMany { found });
        }
        match self {
            Self::Count(count) => cut.sections = equal(whole / *count as f64, *count),
            Self::Length(_, length) => {
                cut.sections = equal(*length, found);
                cut.rest = (whole - length * found as f64).max(0.0);
            }
            Self::Listed(..) => {}
        }
        Ok(cut)
    }
}

/// Returns one of the unit of the first column.
fn unit_of(text: &str) -> Option<Quantity> {
    let mut lines = text.lines().map(str::trim);
    let titles = lines.find(|line| !line.is_empty() && !line.starts_with('#'))?;
    let unit = titles.split_once('[')?.1.split_once(']')?.0;
    Quantity::new(1.0, unit).ok()
}
