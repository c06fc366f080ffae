//! Cases: what a user writes, read, completed, checked and turned into SI.
//!
//! A case file is TOML in which every dimensional value is text with a unit. Three layers make a
//! case: the thesis's values of its damping, the file over them, and `--set` over both. They are
//! merged as trees that know where each value was written, so that every mistake
//! is shown in the text it was made in. The merged tree is read into a [`CaseDocument`], which
//! keeps what was typed, and that is turned into [`wedge::parameters::Parameters`] and
//! [`Simulation`].

pub mod bounds;
pub mod builtin;
pub(crate) mod defaults;
pub(crate) mod document;
pub(crate) mod duration;
pub(crate) mod face;
pub(crate) mod face_values;
pub(crate) mod field;
pub(crate) mod model;
pub(crate) mod motion;
pub(crate) mod name;
pub(crate) mod overrides;
pub(crate) mod problem;
pub(crate) mod read;
pub(crate) mod resolve;
pub mod rise;
pub(crate) mod section;
mod table;
pub(crate) mod tables;
pub(crate) mod toe;
pub(crate) mod tree;
pub(crate) mod units;
mod values;
pub(crate) mod write;

pub use document::{
    ActsAt, CaseDocument, CoilForce, CoilSection, ContactSection, Coordinate, Damping, EnvironmentSection,
    FrictionLaw, FrictionSection, NeighbourSection, SimulationSection, Start, Toe, ToeDirection,
    WedgeSection,
};
pub use face::FaceSection;
pub use face_values::{PadSection, Surface};
pub use field::{Field, FieldSection, Input, TypedNumber};
pub use motion::{CaseMotion, MotionProfile};
pub use problem::{CaseError, Problem};
pub use table::QuantityTable;
pub use tables::Tables;

use input::file::{Expected, Reason, read_text};
use input::{FileType, limits};
use integrate::{Family, Method, Options};
use problem::{Problems, TomlSource};
use quantity::System;
use std::path::Path;
use wedge::parameters::Parameters;

use model::{Model, model};

/// A case that is ready to run.
#[derive(Clone, Debug, PartialEq)]
pub struct Case {
    /// A name that can be the name of a folder.
    pub name: String,
    /// One line for people; may be empty.
    pub title: String,
    /// The typed case, completed.
    pub document: CaseDocument,
    /// The physical parameters, SI, valid.
    pub parameters: Parameters,
    /// The settings of the run.
    pub simulation: Simulation,
    /// True if the case file, with the values of `--set` over it, says nothing of wedge, coil, contact,
    /// friction and motions: they are defaults.
    pub nothing_given: bool,
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

impl Case {
    /// Reads a case file and lays `--set` overrides (`path.key=value`) over it. A case without a
    /// name takes that of its file.
    ///
    /// # Errors
    /// The file cannot be read, or something in it, in a table it names, or in an override is
    /// wrong; all mistakes are reported together.
    pub fn read(path: &Path, overrides: &[String]) -> Result<Self, CaseError> {
        let text = text_of(path)?;
        let folder = path.parent().unwrap_or(Path::new(""));
        Self::parse(&path.display().to_string(), &text, folder, overrides)
    }

    /// As [`Case::read`], from a text. `source` names it in messages; `tables` says where tables
    /// are looked for: a folder, or [`Tables`] that restrict which files are read.
    ///
    /// # Errors
    /// As [`Case::read`].
    pub fn parse<'t>(
        source: &str,
        text: &str,
        tables: impl Into<Tables<'t>>,
        overrides: &[String],
    ) -> Result<Self, CaseError> {
        let (tree, problems) = tree_with_overrides(source, text, overrides)?;
        let nothing_given = !tree.gives_values();
        let case = Self::of_tree(tree, source, tables.into(), problems)?;
        Ok(Self {
            nothing_given,
            ..case
        })
    }

    /// Completes, reads and checks a tree; `problems` are those found on the way to it.
    fn of_tree(
        mut tree: tree::TableNode,
        source: &str,
        tables: Tables<'_>,
        mut problems: Problems,
    ) -> Result<Self, CaseError> {
        if let Some(other @ (Model::Truck | Model::Car)) = model(&tree, &mut problems) {
            let name = if other == Model::Car { "car" } else { "truck" };
            let problem = Problem::new(format!(
                "{source} is the case of a {name}; a single wedge's is expected"
            ));
            let help = format!("`wedgelab run` takes both; here leave out model = \"{name}\"");
            let problem = problem.help(help);
            problems.push(match tree.place_of("model") {
                Some(place) => problem.at(place).label(format!("a {name}")),
                None => problem,
            });
            return Err(CaseError::new(problems));
        }
        let default_name = name::of_source(source);
        let document = read::document(&mut tree, default_name, tables, &mut problems);
        let Some(document) = document.filter(|_| problems.is_empty()) else {
            return Err(CaseError::new(problems));
        };
        let parameters = resolve::parameters(&document).map_err(|error| {
            let problem = Problem::new(format!("`{}`: {}", error.path, error.reason))
                .help("see `wedgelab case` for a case that is valid");
            CaseError::from(match tree.place_of(&error.path) {
                Some(place) => problem.at(place),
                None => problem,
            })
        })?;
        let simulation = resolve::simulation(&document.simulation);
        Ok(Case {
            name: document.name.clone(),
            title: document.title.clone(),
            document,
            parameters,
            simulation,
            nothing_given: false,
        })
    }

    /// Makes a case of a document, checking it as if it were read; tables in files are taken
    /// from the document. Messages show the text of [`CaseDocument::to_toml`].
    ///
    /// # Errors
    /// As [`Case::read`].
    pub fn from_document(document: &CaseDocument) -> Result<Self, CaseError> {
        let text = document.clone().with_tables_embedded().to_toml();
        let mut case = Self::parse("case.toml", &text, Tables::nowhere(), &[])?;
        case.document = document.clone();
        Ok(case)
    }
}

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
