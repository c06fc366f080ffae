//! Three-piece trucks with four wedges that have mass: cases, runs, results.
//!
//! [`TruckCase`] is what a user writes, completed and in SI; [`builtin`] has the rigs; [`run`] records a run.

pub(crate) mod assumptions;
pub mod builtin;
pub mod columns;
mod control_coils;
mod energies;
pub mod loop_curve;
pub mod run;
pub(crate) mod sections;
pub mod summary;
pub mod warp;
mod wedge_kinds;
pub(crate) mod wedges;

use std::path::Path;

use integrate::Method;
use quantity::{Kind, System};
use truck::{Lading, Parameters};

use crate::case::field::{FieldSection, Reach};
use crate::case::model::{Model, model};
use crate::case::problem::{Problem, Problems};
use crate::case::section::Range;
use crate::case::tree::TableNode;
use crate::case::{self, CaseError, Simulation, Tables, name};
use crate::reader::{CaseReader, CaseText, check_motions};
pub use ::truck::WEDGE_NAMES;
pub use sections::{Condition, Load};

/// The case of a truck, ready to run.
#[derive(Clone, Debug, PartialEq)]
pub struct TruckCase {
    /// A name that can be the name of a folder.
    pub name: String,
    /// One line for people; may be empty.
    pub title: String,
    /// The truck, SI.
    pub parameters: Parameters,
    /// Time for which its motions are held before time zero, s.
    pub settle: f64,
    /// The settings of the run. Its start is one of the parameters.
    pub simulation: Simulation,
    text: CaseText,
}

impl TruckCase {
    /// Reads a case file and lays `--set` overrides (`path.key=value`) over it. A case without a name takes
    /// that of its file.
    ///
    /// # Errors
    /// The file cannot be read, or something in it, in a table it names, or in an override is wrong; all
    /// mistakes are reported together.
    pub fn read(path: &Path, overrides: &[String]) -> Result<Self, CaseError> {
        let text = case::text_of(path)?;
        let folder = path.parent().unwrap_or(Path::new(""));
        Self::parse(&path.display().to_string(), &text, folder, overrides)
    }

    /// As [`TruckCase::read`], from a text. `source` names it in messages; `tables` says where tables are
    /// looked for.
    ///
    /// # Errors
    /// As [`TruckCase::read`].
    pub fn parse<'t>(
        source: &str,
        text: &str,
        tables: impl Into<Tables<'t>>,
        overrides: &[String],
    ) -> Result<Self, CaseError> {
        let (tree, problems) = case::tree_with_overrides(source, text, overrides)?;
        Self::of_tree(&tree, source, tables.into(), problems)
    }

    /// Lays values over the text of a case: TOML as in a case file, but a bare number where a quantity is
    /// expected is in SI units (a toe in rad, positive out). Tables are merged key by key; a motion of
    /// another shape replaces the whole motion.
    ///
    /// # Errors
    /// As [`TruckCase::parse`].
    pub fn of_values<'t>(
        source: &str,
        text: &str,
        values: Option<&str>,
        tables: impl Into<Tables<'t>>,
    ) -> Result<Self, CaseError> {
        let tree = case::tree_with_values(source, text, values)?;
        Self::of_tree(&tree, source, tables.into(), Problems::new())
    }

    /// Reads a tree; `problems` are those found on the way to it.
    pub(crate) fn of_tree(
        tree: &TableNode,
        source: &str,
        tables: Tables<'_>,
        mut problems: Problems,
    ) -> Result<Self, CaseError> {
        if let Some(other) = model(tree, &mut problems).filter(|own| *own != Model::Truck) {
            let what = if other == Model::Car {
                "a car"
            } else {
                "a single wedge"
            };
            let problem = Problem::new(format!("{source} is the case of {what}; a truck's is expected"));
            problems.push(problem.help("write model = \"truck\" in its first line"));
        }
        let default_name = name::of_source(source);
        let case = read(tree, default_name, tables, &mut problems);
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

    /// Returns the same with the points of tables from files written into it, so that it runs from anywhere.
    #[must_use]
    pub fn to_toml_embedded(&self) -> &str {
        &self.text.embedded
    }

    /// Returns the whole case as fields, in the order of [`TruckCase::to_toml`] and with its texts.
    #[must_use]
    pub fn fields(&self) -> &[FieldSection] {
        &self.text.fields
    }
}

/// Reads a case, section by section.
fn read(
    tree: &TableNode,
    default_name: &str,
    tables: Tables<'_>,
    problems: &mut Problems,
) -> Option<TruckCase> {
    let mut r = CaseReader::new(tree, tables, problems);
    let [name, title] = r.head(
        default_name,
        Model::Truck,
        "\"truck\", or \"wedge\" for a single one",
    )?;

    r.section(
        "truck",
        "The truck. Axes: x forward, y left, z up from the top of rail, origin at its center.",
    );
    let (condition, damping) = sections::condition_and_damping(&mut r, "[friction]");
    let mut parameters = Parameters::new(damping);
    sections::truck_places(&mut r, &mut parameters.geometry);
    let coils = sections::coils(&mut r);
    r.section("load", "What stands on the truck.");
    let (mut load, mut lading) = (Load::Nothing, Lading::Loaded);
    let comment =
        "\"nothing\": the bolster is alone; \"half_car\": rigid with it; \"car_body\": on the center plate";
    r.choice("kind", sections::LOADS, &mut load, comment);
    let comment =
        "\"loaded\": 263,000 lbf on rail; \"empty\": 62,600 lbf. Coils keep their loads: an empty car rises";
    r.choice("lading", sections::LADINGS, &mut lading, comment);
    sections::bolster(&mut r, &mut parameters, load, lading);
    let mut draft = wedges::all(&mut r, &mut parameters, condition.friction(), &coils);
    sections::side_frames(&mut r, &mut parameters, |r, geometry| {
        wedges::columns_of_all(r, geometry, &mut draft);
    });
    wedges::single(&mut r, &mut parameters, &draft);
    sections::load_springs(&mut r, &mut parameters, &coils);
    sections::stops(&mut r, &mut parameters);
    sections::warp_spring(&mut r, &mut parameters);
    sections::wheelsets(&mut r, &mut parameters);
    r.section("environment", "");
    let gravity = (Kind::Acceleration, Range::NotNegative, Reach::FromZero(9.80665));
    r.quantity("gravity", gravity, &mut parameters.gravity, "standard gravity");
    sections::car_body(&mut r, &mut parameters, load, lading);
    sections::check_something_moves(&mut r, &parameters);
    let settle = sections::start(&mut r, &mut parameters);
    let simulation = simulation(&mut r);
    let text = r.finish("a truck's case");
    Some(TruckCase {
        name,
        title,
        parameters,
        settle,
        simulation,
        text,
    })
}

fn simulation(r: &mut CaseReader<'_>) -> Simulation {
    let usual = Simulation {
        duration: 10.0,
        output_interval: 0.01,
        relative_tolerance: 1e-6,
        output_units: System::Us,
        method: Method::default(),
    };
    let interval = "time between two rows of the result; steps are chosen freely";
    let units = "\"us\" (in, lbf) or \"si\" (m, N)";
    let (simulation, duration) = r.simulation(usual, interval, units);
    if let Some(duration) = &duration {
        check_motions(r, duration);
    }
    // Read with [start].
    r.expect("simulation", &["start"]);
    simulation
}
