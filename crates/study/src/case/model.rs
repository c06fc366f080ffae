//! The models that a case may be about, and what their cases have in common.

use super::problem::{Problem, Problems};
use super::section::{CaseSection, Names};
use super::tree::TableNode;
use super::{CaseError, Tables, name};
use crate::reader::CaseReader;

/// The models that a case file may be about.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Model {
    Wedge,
    Truck,
    Car,
    Vehicle,
}

/// Their names.
pub(crate) const MODELS: Names<Model> = &[
    ("wedge", Model::Wedge),
    ("truck", Model::Truck),
    ("car", Model::Car),
    ("vehicle", Model::Vehicle),
];

/// Returns the model of a case; a wedge if none is named.
pub(crate) fn model(tree: &TableNode, problems: &mut Problems) -> Option<Model> {
    let top = CaseSection {
        path: String::new(),
        table: tree,
        place: None,
    };
    match tree.get("model") {
        None => Some(Model::Wedge),
        Some(_) => top.choice("model", MODELS, problems),
    }
}

impl Model {
    /// Returns what its cases are of: `a car`.
    fn what(self) -> &'static str {
        match self {
            Self::Wedge => "a single wedge",
            Self::Truck => "a truck",
            Self::Car => "a car",
            Self::Vehicle => "a vehicle",
        }
    }

    /// Returns its name in cases.
    fn name(self) -> &'static str {
        super::section::name_of(MODELS, &self)
    }
}

/// Reads a tree as a case of a model, section by section by `read`; `problems` are those found on the way to
/// the tree, which `complete` completes.
pub(crate) fn read_case<C>(
    own: Model,
    mut tree: TableNode,
    (source, tables): (&str, Tables<'_>),
    mut problems: Problems,
    complete: impl FnOnce(&mut TableNode, &mut Problems),
    read: impl FnOnce(&mut CaseReader<'_>, &str) -> Option<C>,
) -> Result<C, CaseError> {
    if let Some(other) = model(&tree, &mut problems).filter(|other| *other != own) {
        let message = format!(
            "{source} is the case of {}; {}'s is expected",
            other.what(),
            own.what()
        );
        let help = match own {
            Model::Wedge => format!(
                "`wedgelab run` takes both; here leave out model = \"{}\"",
                other.name()
            ),
            own => format!("write model = \"{}\" in its first line", own.name()),
        };
        let problem = Problem::new(message).help(help);
        problems.push(match tree.place_of("model") {
            Some(place) => problem.at(place).label(other.what()),
            None => problem,
        });
        return Err(CaseError::new(problems));
    }
    complete(&mut tree, &mut problems);
    let mut reader = CaseReader::new(&tree, tables, &mut problems);
    let case = read(&mut reader, name::of_source(source));
    match case.filter(|_| problems.is_empty()) {
        Some(case) => Ok(case),
        None => Err(CaseError::new(problems)),
    }
}

/// What the cases of all models have: the same functions for each type of case, with its model, the function
/// that completes its tree, and the one that reads it.
macro_rules! model_case {
    ($case:ident, $model:expr, $complete:path, $read:path) => {
        impl $case {
            /// Reads a case file and lays `--set` overrides (`path.key=value`) over it. A case without a name
            /// takes that of its file.
            ///
            /// # Errors
            /// The file cannot be read, or something in it, in a file it names, or in an override is wrong;
            /// all mistakes are reported together.
            pub fn read(
                path: &std::path::Path,
                overrides: &[String],
            ) -> Result<Self, $crate::case::CaseError> {
                let text = $crate::case::text_of(path)?;
                let folder = path.parent().unwrap_or(std::path::Path::new(""));
                Self::parse(&path.display().to_string(), &text, folder, overrides)
            }

            /// As `read`, from a text. `source` names it in messages; `tables` says where files that it names
            /// are looked for: a folder, or [`Tables`](crate::case::Tables) that restrict which are read.
            ///
            /// # Errors
            /// As `read`.
            pub fn parse<'t>(
                source: &str,
                text: &str,
                tables: impl Into<$crate::case::Tables<'t>>,
                overrides: &[String],
            ) -> Result<Self, $crate::case::CaseError> {
                let (tree, problems) = $crate::case::tree_with_overrides(source, text, overrides)?;
                Self::of_tree(tree, source, tables.into(), problems)
            }

            /// Lays values over the text of a case: TOML as in a case file, but a bare number where a
            /// quantity is expected is in SI units (a toe in rad, positive out). Tables are merged key by
            /// key; a motion of another shape replaces the whole motion, and lists (a track's, a lading's)
            /// are replaced.
            ///
            /// # Errors
            /// As `parse`.
            pub fn of_values<'t>(
                source: &str,
                text: &str,
                values: Option<&str>,
                tables: impl Into<$crate::case::Tables<'t>>,
            ) -> Result<Self, $crate::case::CaseError> {
                let tree = $crate::case::tree_with_values(source, text, values)?;
                Self::of_tree(
                    tree,
                    source,
                    tables.into(),
                    $crate::case::problem::Problems::new(),
                )
            }

            /// Reads a tree; `problems` are those found on the way to it.
            pub(crate) fn of_tree(
                tree: $crate::case::tree::TableNode,
                source: &str,
                tables: $crate::case::Tables<'_>,
                problems: $crate::case::problem::Problems,
            ) -> Result<Self, $crate::case::CaseError> {
                let from = (source, tables);
                $crate::case::model::read_case($model, tree, from, problems, $complete, $read)
            }

            /// Returns the sections and keys of the case with this text, and of all that may be laid over it.
            pub(crate) fn known_keys(
                text: &str,
                overrides: &[String],
            ) -> Vec<$crate::reader::schema::KnownSection> {
                let tree = $crate::case::tree_with_overrides("case.toml", text, overrides);
                let Ok((mut tree, mut problems)) = tree else {
                    return Vec::new();
                };
                $complete(&mut tree, &mut problems);
                let tables = $crate::case::Tables::nowhere();
                let mut reader = $crate::reader::CaseReader::new(&tree, tables, &mut problems).completely();
                let _ = $read(&mut reader, "case");
                reader.into_known()
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

            /// Returns the whole case as TOML: every key in groups, each with what it means, and with the
            /// reason where its source leaves a choice. Reads back to the same case.
            #[must_use]
            pub fn to_toml(&self) -> &str {
                &self.text.typed
            }

            /// Returns the same with the points of tables and the contents of a track file written into it.
            /// Profiles of wheels and rails and measured tracks stay files.
            #[must_use]
            pub fn to_toml_embedded(&self) -> &str {
                &self.text.embedded
            }

            /// Returns the whole case as fields, in the order of [`Self::to_toml`] and with its texts.
            #[must_use]
            pub fn fields(&self) -> &[$crate::case::FieldSection] {
                &self.text.fields
            }
        }
    };
}
pub(crate) use model_case;
