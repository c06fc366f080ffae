//! Freight cars on track: cases, runs, statistics, results.
//!
//! [`CarCase`] is what a user writes, completed and in SI; [`regime`] has the tracks and speeds of the field,
//! [`builtin`] cases on them; [`statistics`] says what rules for the assessment of cars ask, [`limits`]
//! beside what they allow; [`run`] records a run, [`motions`] what a picture of it needs; [`stability`]
//! linearizes, [`locus`] over any parameter; [`hunting`] ramps the speed, [`onset`] holds it.

pub(crate) mod assumptions;
pub mod builtin;
pub mod certificate;
mod checks;
pub mod columns;
pub mod conditions;
mod derailment;
pub mod hunting;
mod lading;
pub mod limits;
pub mod locked_in;
pub mod locus;
pub mod mode_shape;
pub mod motions;
mod named;
pub mod onset;
pub mod other_start;
mod packed;
mod peaks;
pub mod regime;
pub mod run;
mod sections;
pub mod speeds;
pub mod stability;
pub mod static_table;
pub mod statistics;
pub mod summary;
mod track;
mod trucks;
mod wheels;
pub mod worst;

use std::path::Path;

use car::Parameters;

use crate::case::field::FieldSection;
use crate::case::model::{Model, model};
use crate::case::problem::{Problem, Problems};
use crate::case::tables::NamedFile;
use crate::case::tree::TableNode;
use crate::case::{self, CaseError, Simulation, Tables, name};
use crate::output_files::OutputFiles;
use crate::reader::{CaseReader, CaseText};
use statistics::Rules;

/// The case of a car, ready to run.
#[derive(Clone, Debug)]
pub struct CarCase {
    /// A name that can be the name of a folder.
    pub name: String,
    /// One line for people; may be empty.
    pub title: String,
    /// The car on its track, SI.
    pub parameters: Parameters,
    /// The rules of statistics.
    pub rules: Rules,
    /// The files of its time histories.
    pub output_files: OutputFiles,
    /// The settings of the run.
    pub simulation: Simulation,
    /// What [`stability`](mod@stability) looks at besides.
    pub stability: sections::StabilityKeys,
    /// Warnings of reading.
    pub doubts: Vec<String>,
    /// Profiles and measured tables that were read.
    files: Vec<NamedFile>,
    text: CaseText,
}

impl PartialEq for CarCase {
    /// Two cases are the same if their completed case files are.
    fn eq(&self, other: &Self) -> bool {
        self.text.embedded == other.text.embedded
    }
}

impl CarCase {
    /// Reads a case file and lays `--set` overrides (`path.key=value`) over it. A case without a name takes
    /// that of its file.
    ///
    /// # Errors
    /// The file cannot be read, or something in it, in a file it names, or in an override is wrong; all
    /// mistakes are reported together.
    pub fn read(path: &Path, overrides: &[String]) -> Result<Self, CaseError> {
        let text = case::text_of(path)?;
        let folder = path.parent().unwrap_or(Path::new(""));
        Self::parse(&path.display().to_string(), &text, folder, overrides)
    }

    /// As [`CarCase::read`], from a text. `source` names it in messages; `tables` says where files that it
    /// names are looked for.
    ///
    /// # Errors
    /// As [`CarCase::read`].
    pub fn parse<'t>(
        source: &str,
        text: &str,
        tables: impl Into<Tables<'t>>,
        overrides: &[String],
    ) -> Result<Self, CaseError> {
        let (tree, problems) = case::tree_with_overrides(source, text, overrides)?;
        Self::of_tree(tree, source, tables.into(), problems)
    }

    /// Lays values over the text of a case: TOML as in a case file, but a bare number where a quantity is
    /// expected is in SI units. Tables are merged key by key; the lists of a track and of a lading are
    /// replaced.
    ///
    /// # Errors
    /// As [`CarCase::parse`].
    pub fn of_values<'t>(
        source: &str,
        text: &str,
        values: Option<&str>,
        tables: impl Into<Tables<'t>>,
    ) -> Result<Self, CaseError> {
        let tree = case::tree_with_values(source, text, values)?;
        Self::of_tree(tree, source, tables.into(), Problems::new())
    }

    /// Reads a tree; `problems` are those found on the way to it.
    fn of_tree(
        mut tree: TableNode,
        source: &str,
        tables: Tables<'_>,
        mut problems: Problems,
    ) -> Result<Self, CaseError> {
        if model(&tree, &mut problems).is_some_and(|model| model != Model::Car) {
            let problem = Problem::new(format!("{source} is no case of a car"));
            problems.push(problem.help("write model = \"car\" in its first line"));
        }
        trucks::complete(&mut tree, &mut problems);
        let case = read(&tree, name::of_source(source), tables, &mut problems);
        match case.filter(|_| problems.is_empty()) {
            Some(case) => Ok(case),
            None => Err(CaseError::new(problems)),
        }
    }

    /// Returns the same case under another name.
    #[must_use]
    pub fn named(&self, name: &str) -> Self {
        Self {
            name: name.to_owned(),
            text: self.text.named(name),
            ..self.clone()
        }
    }

    /// Returns the whole case as TOML: every key in groups, each with what it means. Reads back to the same
    /// case.
    #[must_use]
    pub fn to_toml(&self) -> &str {
        &self.text.typed
    }

    /// Returns the same with the contents of a track file written into it. Profiles of wheels and rails and
    /// measured tables stay files.
    #[must_use]
    pub fn to_toml_embedded(&self) -> &str {
        &self.text.embedded
    }

    /// Returns the whole case as fields, in the order of [`CarCase::to_toml`] and with its texts.
    #[must_use]
    pub fn fields(&self) -> &[FieldSection] {
        &self.text.fields
    }

    /// Returns a value of the case as typed or by default; empty if there is none at this path.
    fn typed(&self, path: &str) -> &str {
        let fields = self.text.fields.iter().flat_map(|section| &section.fields);
        let found = fields.into_iter().find(|field| field.path == path);
        found.map_or("", |field| field.text.as_str())
    }

    /// Returns the speed at the start, m/s.
    #[must_use]
    pub fn speed(&self) -> f64 {
        self.parameters.start.speed
    }
}

/// Reads a case, section by section.
fn read(
    tree: &TableNode,
    default_name: &str,
    tables: Tables<'_>,
    problems: &mut Problems,
) -> Option<CarCase> {
    let mut r = CaseReader::new(tree, tables, problems);
    let [name, title] = r.head(default_name, Model::Car, "\"car\": a freight car on track")?;
    let drawn = sections::everything(&mut r);
    let files = std::mem::take(&mut r.files);
    let text = r.finish("a car's case");
    let sections::CarSections {
        parameters,
        rules,
        output_files,
        simulation,
        stability,
        doubts,
    } = drawn?;
    Some(CarCase {
        name,
        title,
        parameters,
        rules,
        output_files,
        simulation,
        stability,
        doubts,
        files,
        text,
    })
}
