//! The models that a case may be about.

use super::problem::Problems;
use super::section::{CaseSection, Names};
use super::tree::TableNode;

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
