//! The models: a row for each in [`MODELS`], which all lists of models and of built-in cases ask; cases and
//! summaries of whatever model.

use std::sync::Arc;

use serde::{Deserialize, Serialize};

mod list;

use crate::car::{self, CarCase};
use crate::case::builtin::{self, BuiltIn, CaseGroup, own_name};
use crate::case::model::Model;
use crate::case::problem::Problems;
use crate::case::tree::TableNode;
use crate::case::{Case, CaseError, Problem, Tables};
use crate::half_truck::{self, HalfTruckCase, catalog};
use crate::truck::{self, TruckCase};
use crate::vehicle::{self, VehicleCase};
use crate::{summary as wedge, wheelset};

use list::{any_case, any_summary};

any_case! {
    $
    /// A wedge's.
    Wedge(Case) = "wedge", wedge;
    /// A half-truck's.
    HalfTruck(HalfTruckCase) = "half-truck", half_truck;
    /// A truck's.
    Truck(TruckCase) = "truck", truck;
    /// A car's.
    Car(CarCase) = "car", car;
    /// A vehicle's.
    Vehicle(VehicleCase) = "vehicle", vehicle;
}

any_summary! {
    $
    /// Of a wedge.
    Wedge(wedge::Summary),
    /// Of a half-truck from files of NUCARS.
    HalfTruck(half_truck::HalfTruckSummary),
    /// Of a three-piece truck.
    Truck(truck::summary::TruckSummary),
    /// Of a car.
    Car(car::summary::CarSummary),
    /// Of a vehicle.
    Vehicle(vehicle::summary::VehicleSummary),
    /// Of a wheelset.
    Wheelset(wheelset::summary::WheelsetSummary),
}

// After the lists, whose macros they use.
mod case;
mod every_key;
mod model_case;
mod source;
mod summary;

pub use every_key::{ModelKeys, Variant};
pub use model_case::{ModelCase, StudyCase};
pub use source::CaseSource;
pub use summary::ModelSummary;

/// A model.
#[derive(Debug)]
pub struct ModelEntry {
    /// Its name.
    pub name: &'static str,
    /// Its name in a sentence, with the article.
    pub what: &'static str,
    /// The schema of the summaries of its runs.
    pub schema: &'static str,
    /// The command that runs it.
    pub command: &'static str,
    /// The class of its cases in Python; empty if there is none.
    pub class: &'static str,
    /// Reads the summary of a run from JSON.
    pub summary: fn(&[u8]) -> serde_json::Result<AnySummary>,
    /// Its case files, if it has any.
    case_files: Option<CaseFiles>,
}

/// The case files of a model.
#[derive(Debug)]
struct CaseFiles {
    /// The model that they name.
    model: Model,
    /// The built-in ones.
    groups: fn() -> &'static [CaseGroup],
    keys: ModelKeys,
    /// Reads one: its tree, its name, the folder of its tables, the mistakes found so far.
    read: fn(TableNode, &str, Tables<'_>, Problems) -> Result<AnyCase, CaseError>,
}

/// The models, those with case files in the order in which their built-in cases are listed.
pub static MODELS: [ModelEntry; 6] = [
    ModelEntry {
        name: "wedge",
        what: "a friction wedge",
        schema: wedge::SCHEMA,
        command: "run",
        class: "Case",
        summary: wedge::Summary::of_json,
        case_files: Some(CaseFiles {
            model: Model::Wedge,
            groups: builtin::groups,
            keys: builtin::KEYS,
            read: |tree, source, tables, problems| Ok(Case::of_tree(tree, source, tables, problems)?.into()),
        }),
    },
    ModelEntry {
        name: "half-truck",
        what: "a half-truck from files of NUCARS",
        schema: half_truck::SCHEMA,
        command: "nucars run",
        class: "HalfTruckCase",
        summary: half_truck::HalfTruckSummary::of_json,
        case_files: None,
    },
    ModelEntry {
        name: "truck",
        what: "a three-piece truck",
        schema: truck::summary::SCHEMA,
        command: "run",
        class: "TruckCase",
        summary: truck::summary::TruckSummary::of_json,
        case_files: Some(CaseFiles {
            model: Model::Truck,
            groups: truck::builtin::groups,
            keys: truck::builtin::KEYS,
            read: |tree, source, tables, problems| {
                Ok(TruckCase::of_tree(tree, source, tables, problems)?.into())
            },
        }),
    },
    ModelEntry {
        name: "car",
        what: "a car on track",
        schema: car::summary::SCHEMA,
        command: "run",
        class: "CarCase",
        summary: car::summary::CarSummary::of_json,
        case_files: Some(CaseFiles {
            model: Model::Car,
            groups: car::builtin::groups,
            keys: car::builtin::KEYS,
            read: |tree, source, tables, problems| {
                Ok(CarCase::of_tree(tree, source, tables, problems)?.into())
            },
        }),
    },
    ModelEntry {
        name: "vehicle",
        what: "a vehicle",
        schema: vehicle::summary::SCHEMA,
        command: "run",
        class: "VehicleCase",
        summary: vehicle::summary::VehicleSummary::of_json,
        case_files: Some(CaseFiles {
            model: Model::Vehicle,
            groups: vehicle::builtin::groups,
            keys: vehicle::builtin::KEYS,
            read: |tree, source, tables, problems| {
                Ok(VehicleCase::of_tree(tree, source, tables, problems)?.into())
            },
        }),
    },
    ModelEntry {
        name: "wheelset",
        what: "a wheelset on a track",
        schema: wheelset::summary::SCHEMA,
        command: "wheelrail run",
        class: "",
        summary: wheelset::summary::WheelsetSummary::of_json,
        case_files: None,
    },
];

/// Returns the model whose summaries name this schema.
#[must_use]
pub fn of_schema(schema: &str) -> Option<&'static ModelEntry> {
    MODELS.iter().find(|model| model.schema == schema)
}

/// Returns the names of the models that have case files, with all keys of these.
pub fn case_keys() -> impl Iterator<Item = (&'static str, &'static ModelKeys)> {
    let files = |model: &'static ModelEntry| Some((model.name, &model.case_files.as_ref()?.keys));
    MODELS.iter().filter_map(files)
}

/// Returns the groups of built-in cases of all models.
pub fn groups() -> impl Iterator<Item = &'static CaseGroup> {
    let files = MODELS.iter().filter_map(|model| model.case_files.as_ref());
    files.flat_map(|files| (files.groups)())
}

/// Returns the names of the built-in cases of all models.
pub fn built_in_names() -> impl Iterator<Item = &'static str> {
    groups().flat_map(|group| &group.cases).map(|case| &*case.name)
}

/// Returns the built-in case of this name, of whatever model.
#[must_use]
pub fn built_in(name: &str) -> Option<&'static BuiltIn> {
    let name = own_name(name);
    groups()
        .flat_map(|group| &group.cases)
        .find(|case| case.name == name)
}

/// Returns the mistake of a user who asks a model for a built-in case that it does not have: the case may be
/// of another model.
#[must_use]
pub fn no_built_in(name: &str, error: CaseError) -> CaseError {
    let has = |model: &&ModelEntry| match &model.case_files {
        Some(files) => (files.groups)()
            .iter()
            .flat_map(|group| &group.cases)
            .any(|case| case.name == name),
        None => model.schema == half_truck::SCHEMA && catalog::entry(name).is_some(),
    };
    let Some(model) = MODELS.iter().find(has) else {
        return error;
    };
    Problem::new(format!("\"{name}\" is a built-in {}", model.name))
        .help(format!(
            "`wedgelab {} {name}` runs it; in Python `{}` takes it",
            model.command, model.class
        ))
        .into()
}
