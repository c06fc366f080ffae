//! Cases: what a user writes, read, completed, checked and turned into SI.
//!
//! A case file is TOML in which every dimensional value is text with a unit, and `--set` lays values over it.
//! Both are merged as trees that know where each value was written, so that every mistake is shown in the
//! text it was made in. The merged tree is read key by key over the defaults: one line for each key says its
//! name, kind, range, default and meaning, and gives its value, its line of the complete case file and its
//! field in the explorer.

pub mod bounds;
pub mod builtin;
pub(crate) mod coil;
pub(crate) mod face;
pub(crate) mod face_values;
pub(crate) mod field;
pub(crate) mod friction;
pub(crate) mod model;
pub(crate) mod motion;
pub(crate) mod name;
pub(crate) mod names;
pub(crate) mod overrides;
pub(crate) mod page;
pub(crate) mod problem;
pub(crate) mod read;
pub mod rise;
pub(crate) mod section;
pub(crate) mod table;
pub(crate) mod tables;
pub(crate) mod toe;
pub(crate) mod tree;
pub(crate) mod units;

pub use field::{Field, FieldSection, Input, TypedNumber};
pub use problem::{CaseError, Problem};
pub use tables::Tables;

use input::file::{Expected, Reason, read_text};
use input::{FileType, limits};
use integrate::{Family, Method, Options};
use problem::{Problems, TomlSource};
use quantity::System;
use std::path::Path;
use wedge::parameters::Parameters;

use crate::reader::CaseText;

/// A case that is ready to run.
#[derive(Clone, Debug, PartialEq)]
pub struct Case {
    /// A name that can be the name of a folder.
    pub name: String,
    /// One line for people; may be empty.
    pub title: String,
    /// The physical parameters, SI, valid.
    pub parameters: Parameters,
    /// The settings of the run.
    pub simulation: Simulation,
    /// True if the case file, with the values of `--set` over it, says nothing of wedge, coil, contact,
    /// friction and motions: they are defaults.
    pub nothing_given: bool,
    pub(crate) text: CaseText,
}

/// The settings of a case's run. The start is one of the [`Parameters`].
#[derive(Clone, Debug, PartialEq)]
pub struct Simulation {
    /// Time the run ends, s; it begins at zero.
    pub duration: f64,
    /// Time between two rows of the result, s; not longer than the duration.
    pub output_interval: f64,
    /// Relative tolerance of the integrator, between 0 and 1.
    pub relative_tolerance: f64,
    /// Units of the result.
    pub output_units: System,
    /// Integration method.
    pub method: Method,
}

impl Default for Simulation {
    fn default() -> Self {
        Self {
            duration: 10.0,
            output_interval: 0.01,
            relative_tolerance: 1e-6,
            output_units: System::Us,
            method: Method::default(),
        }
    }
}

impl Simulation {
    /// Returns the integrator's options. Methods that damp end their steps at every row at least, so that
    /// rows are resolved.
    pub fn options(&self) -> Options {
        Options {
            relative_tolerance: self.relative_tolerance,
            maximum_step: match self.method.tableau().family {
                Family::DiagonallyImplicit => self.output_interval,
                _ => f64::INFINITY,
            },
            ..Options::of(self.method)
        }
    }
}

model::model_case!(Case, model::Model::Wedge, read::complete, read::case);

/// Reads the text of a case file as a tree with `--set` overrides over it; returns the mistakes in these too.
pub(crate) fn tree_with_overrides(
    source: &str,
    text: &str,
    overrides: &[String],
) -> Result<(tree::TableNode, Problems), CaseError> {
    let mut tree = tree_of(source, text)?;
    let problems = overrides::apply(&mut tree, overrides);
    Ok((tree, problems))
}

/// Reads the text of a case file as a tree with values over it: TOML, in which a bare number is in SI units.
pub(crate) fn tree_with_values(
    source: &str,
    text: &str,
    values: Option<&str>,
) -> Result<tree::TableNode, CaseError> {
    let below = tree_of(source, text)?;
    let Some(values) = values else {
        return Ok(below);
    };
    let mut tree = tree::parse(&TomlSource::in_si("values", values)).map_err(CaseError::new)?;
    tree.complete_from(&below);
    Ok(tree)
}

fn tree_of(source: &str, text: &str) -> Result<tree::TableNode, CaseError> {
    let text = text.strip_prefix('\u{feff}').unwrap_or(text);
    let tree = tree::parse(&TomlSource::new(source, text)).map_err(CaseError::new)?;
    refuse_study(&tree, source)?;
    Ok(tree)
}

/// Refuses a study file, or a track file, where a case is expected.
fn refuse_study(tree: &tree::TableNode, source: &str) -> Result<(), CaseError> {
    if let Some(segments) = tree.entry("segments") {
        let problem = Problem::new(format!("{source} is a track file; a case file is expected"));
        let problem = problem.at(&segments.key_place).label("only a track has this");
        return Err(problem
            .help(format!("`wedgelab track show {source}` shows it"))
            .into());
    }
    let Some(study) = STUDY_KEYS.iter().find_map(|key| tree.entry(key)) else {
        return Ok(());
    };
    let problem = Problem::new(format!("{source} is a study file; a case file is expected"));
    let problem = problem.at(&study.key_place).label("only a study has this");
    Err(problem.help(FileType::Study.advice(source)).into())
}

/// Tables that only a single wedge's case has, or a vehicle's too, and neither a study nor a track.
pub(crate) const CASE_TABLES: [&str; 10] = [
    "wedge",
    "control_coil",
    "contact",
    "friction",
    "column_face",
    "slope_face",
    "side_frame",
    "bolster",
    "environment",
    "simulation",
];

/// Keys that only a study has.
pub(crate) const STUDY_KEYS: [&str; 4] = ["sampling", "vary", "variants", "case"];

/// The expected case file.
pub(crate) const CASE_FILE: Expected = Expected {
    what: "case file",
    // Which of them it is, the keys of its tree say.
    types: &[FileType::Case, FileType::Study, FileType::Track],
    most: limits::TEXT_FILE,
};

/// Returns the text of a case file.
///
/// # Errors
/// There is no such file, or it cannot be read, or it is not text, something else than a case, or too large.
pub fn text_of(path: &Path) -> Result<String, CaseError> {
    let missing = "check the path; `wedgelab case NAME` prints a built-in case to start from";
    text_of_file(path, &CASE_FILE, missing)
}

/// Returns the text of a file of TOML; `missing` is the advice where there is no such file.
///
/// # Errors
/// As [`text_of`].
pub(crate) fn text_of_file(path: &Path, expected: &Expected, missing: &str) -> Result<String, CaseError> {
    read_text(path, expected).map_err(|error| {
        let help = match error.reason {
            Reason::NotFound => missing.to_owned(),
            _ => error
                .help()
                .unwrap_or_else(|| format!("a {} is TOML, saved as UTF-8", expected.what)),
        };
        Problem::new(error.to_string()).help(help).into()
    })
}
