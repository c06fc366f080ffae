//! Three-piece trucks with four wedges that have mass: cases, runs, results.
//!
//! [`TruckCase`] is what a user writes, completed and in SI; [`builtin`] has the rigs; [`run`] records a run.

pub(crate) mod assumptions;
pub mod builtin;
pub(crate) mod channels;
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

use quantity::Kind;
use truck::{Lading, Parameters};

use crate::case::Simulation;
use crate::case::field::Reach;
use crate::case::model::{Model, model_case};
use crate::case::problem::Problems;
use crate::case::section::Range;
use crate::case::tree::TableNode;
use crate::damage;
use crate::reader::{CaseReader, CaseText, check_motions};
use crate::wear::mounted::WedgeLaw;
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
    /// The law by which its wedges wear.
    pub wear: WedgeLaw,
    /// The settings of the run. Its start is one of the parameters.
    pub simulation: Simulation,
    text: CaseText,
}

model_case!(TruckCase, Model::Truck, complete, read);

/// A truck's case is read as it stands.
fn complete(_: &mut TableNode, _: &mut Problems) {}

/// Reads a case, section by section.
fn read(r: &mut CaseReader<'_>, default_name: &str) -> Option<TruckCase> {
    let [name, title] = r.head(
        default_name,
        Model::Truck,
        "\"truck\", or \"wedge\" for a single one",
    )?;

    r.section(
        "truck",
        "The truck. Axes: x forward, y left, z up from the top of rail, origin at its center.",
    );
    let (condition, damping) = sections::condition_and_damping(r, "[friction]");
    let mut parameters = Parameters::new(damping);
    sections::truck_places(r, &mut parameters.geometry);
    let coils = sections::coils(r);
    r.section("load", "What stands on the truck.");
    let (mut load, mut lading) = (Load::Nothing, Lading::Loaded);
    let comment =
        "\"nothing\": the bolster is alone; \"half_car\": rigid with it; \"car_body\": on the center plate";
    r.choice("kind", sections::LOADS, &mut load, comment);
    let comment =
        "\"loaded\": 263,000 lbf on rail; \"empty\": 62,600 lbf. Coils keep their loads: an empty car rises";
    r.choice("lading", sections::LADINGS, &mut lading, comment);
    sections::bolster(r, &mut parameters, load, lading);
    let mut draft = wedges::all(r, &mut parameters, condition.friction(), &coils);
    sections::side_frames(r, &mut parameters, |r, geometry| {
        wedges::columns_of_all(r, geometry, &mut draft);
    });
    wedges::single(r, &mut parameters, &draft);
    sections::load_springs(r, &mut parameters, &coils);
    sections::stops(r, &mut parameters);
    sections::warp_spring(r, &mut parameters);
    sections::wheelsets(r, &mut parameters);
    r.section("environment", "");
    let gravity = (Kind::Acceleration, Range::NotNegative, Reach::FromZero(9.80665));
    r.quantity("gravity", gravity, &mut parameters.gravity, "standard gravity");
    sections::car_body(r, &mut parameters, load, lading);
    sections::check_something_moves(r, &parameters);
    let settle = sections::start(r, &mut parameters);
    let wear = damage::read_of_wedges(r);
    let simulation = simulation(r);
    let text = r.finish("a truck's case");
    Some(TruckCase {
        name,
        title,
        parameters,
        settle,
        wear,
        simulation,
        text,
    })
}

fn simulation(r: &mut CaseReader<'_>) -> Simulation {
    let interval = "time between two rows of the result; steps are chosen freely";
    let units = "\"us\" (in, lbf) or \"si\" (m, N)";
    let (simulation, duration) = r.simulation(Simulation::default(), interval, units);
    if let Some(duration) = &duration {
        check_motions(r, duration);
    }
    // Read with [start].
    r.expect("simulation", &["start"]);
    simulation
}
