//! The models that a case may be about.

use super::problem::Problems;
use super::section::{Names, Section};
use super::tree::Table;

/// The models that a case file may be about.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Model {
    Wedge,
    Truck,
    Car,
}

/// Their names.
pub(crate) const MODELS: Names<Model> = &[
    ("wedge", Model::Wedge),
    ("truck", Model::Truck),
    ("car", Model::Car),
];

/// Returns the model of a case; a wedge if none is named.
pub(crate) fn model(tree: &Table, problems: &mut Problems) -> Option<Model> {
    let top = Section {
        path: String::new(),
        table: tree,
        place: None,
    };
    match tree.get("model") {
        None => Some(Model::Wedge),
        Some(_) => top.choice("model", MODELS, problems),
    }
}
