//! Vehicles as cases: bodies and elements that a user names.
//!
//! [`VehicleCase`] is what a user writes, completed and in SI; [`run`] records a run, [`summary`] has its
//! numbers, [`builtin`] the built-in vehicles. An element of one's own in Rust is an [`OwnElement`], which a
//! case takes by its kind ([`VehicleCase::parse_with`]).

mod bodies;
pub mod builtin;
mod elements;
mod like;
mod on_track;
mod parts;
pub mod run;
pub mod stability;
pub mod summary;

use std::sync::Arc;

use quantity::Kind;
use vehicle::{Description, StartKind};

pub use elements::{OwnElement, OwnKey};

use crate::car::limits::LimitSet;
use crate::car::statistics::Rules;
use crate::car::{not_round, output};
use crate::case::field::Reach;
use crate::case::model::{Model, model_case, read_case};
use crate::case::problem::Problem;
use crate::case::section::{Names, Range};
use crate::case::tables::NamedFile;
use crate::case::{CaseError, Simulation, Tables, tree_with_overrides};
use crate::output_files::OutputFiles;
use crate::reader::{CaseReader, CaseText, check_motions};

/// The case of a vehicle, ready to run.
#[derive(Clone, Debug)]
pub struct VehicleCase {
    /// A name that can be the name of a folder.
    pub name: String,
    /// One line for people; may be empty.
    pub title: String,
    /// The vehicle, SI.
    pub description: Description,
    /// The rules of statistics of a vehicle on a track.
    pub rules: Rules,
    /// Time that it settles after the start, s: statistics leave this out.
    pub settle: f64,
    /// The limits that its summary compares with; `None`: those of freight cars, built in.
    pub limits: Option<Arc<LimitSet>>,
    /// The files of its time histories.
    pub output_files: OutputFiles,
    /// The settings of the run.
    pub simulation: Simulation,
    /// Warnings of reading.
    pub doubts: Vec<String>,
    /// Profiles and measured tables that were read.
    pub(crate) files: Vec<NamedFile>,
    text: CaseText,
}

impl PartialEq for VehicleCase {
    /// Two cases are the same if their completed case files are.
    fn eq(&self, other: &Self) -> bool {
        self.text.embedded == other.text.embedded
    }
}

model_case!(VehicleCase, Model::Vehicle, like::complete, read);

impl VehicleCase {
    /// As [`VehicleCase::parse`], with kinds of elements of one's own beside those of the catalog.
    ///
    /// # Errors
    /// As [`VehicleCase::parse`].
    pub fn parse_with<'t>(
        source: &str,
        text: &str,
        tables: impl Into<Tables<'t>>,
        overrides: &[String],
        own: &'static [OwnElement],
    ) -> Result<Self, CaseError> {
        let (tree, problems) = tree_with_overrides(source, text, overrides)?;
        let from = (source, tables.into());
        read_case(Model::Vehicle, tree, from, problems, like::complete, |r, name| {
            read_with(r, name, own)
        })
    }
}

/// Starts of a vehicle.
const STARTS: Names<StartKind> = &[
    ("equilibrium", StartKind::Equilibrium),
    ("nominal", StartKind::Nominal),
];

fn read(r: &mut CaseReader<'_>, default_name: &str) -> Option<VehicleCase> {
    read_with(r, default_name, &[])
}

/// Reads a case, section by section.
fn read_with(r: &mut CaseReader<'_>, default_name: &str, own: &'static [OwnElement]) -> Option<VehicleCase> {
    let about = "\"vehicle\": bodies and elements of your own";
    let [name, title] = r.head(default_name, Model::Vehicle, about)?;
    r.section("environment", "");
    let mut description = Description {
        start: StartKind::Equilibrium,
        ..Description::default()
    };
    let gravity = (Kind::Acceleration, Range::NotNegative, Reach::FromZero(9.80665));
    let comment = "standard gravity, along -z";
    r.quantity("gravity", gravity, &mut description.gravity, comment);
    description.bodies = bodies::all(r);
    let mut parts = on_track::parts(r, &description.bodies);
    let names: Vec<&str> = std::iter::once(vehicle::GROUND)
        .chain(description.bodies.iter().map(|own| own.name.as_str()))
        .chain(parts.names.iter().map(String::as_str))
        .collect();
    let (elements, doubtful) = elements::all(r, &names, own);
    description.elements = elements;
    let (on_track, files, mut doubts) = on_track::track(r, &mut parts, &description.bodies);
    description.on_track = on_track;
    r.section("start", "How the run starts.");
    let comment = "\"equilibrium\": at rest, motions and loads held as at time zero, wedges and dry friction \
                   without friction; \"nominal\": in the nominal layout. Offsets of bodies come on top";
    r.choice("kind", STARTS, &mut description.start, comment);
    let settle = on_track::start(r, &mut description);
    let (mut output_files, mut rules) = (OutputFiles::default(), Rules::default());
    match description.on_track {
        Some(_) => output::output(r, &mut rules),
        None => r.section("output", "What is written."),
    }
    output_files.read(r);
    let interval = "time between two rows of the result; steps are chosen freely";
    let units = "\"us\" (in, lbf) or \"si\" (m, N)";
    let (simulation, duration) = r.simulation(Simulation::default(), interval, units);
    if let Some(duration) = &duration {
        check_motions(r, duration);
    }
    doubts.extend(doubtful);
    doubts.extend(self::doubts(r, &description));
    let on = description.on_track.as_ref();
    doubts.extend(on.and_then(|on| {
        let speed = on.drive.fastest(on.speed);
        not_round::rows_too_far_apart(&on.wheels, speed, simulation.output_interval)
    }));
    r.files.extend(files);
    let files = std::mem::take(&mut r.files);
    let text = r.finish("a vehicle's case");
    Some(VehicleCase {
        name,
        title,
        description,
        rules,
        settle,
        limits: None,
        output_files,
        simulation,
        doubts,
        files,
        text,
    })
}

/// Notes what makes no vehicle, and returns what is doubtful.
fn doubts(r: &mut CaseReader<'_>, description: &Description) -> Vec<String> {
    let (bodies, elements) = (&description.bodies, &description.elements);
    if bodies.is_empty() && !r.has("bodies") {
        let problem = Problem::new("the vehicle has no bodies");
        let help = "write [bodies.NAME] with weight, inertia and place, and [elements.NAME] between \
                    bodies and the ground";
        r.problems.push(problem.help(help));
    }
    let mut doubts = Vec::new();
    let held = |number: usize| {
        let ends = |own: &vehicle::catalog::Element| own.ends.iter().any(|end| end.body == number);
        let on = description.on_track.iter().flat_map(|own| &own.trucks);
        elements.iter().any(ends) || on.into_iter().any(|own| own.body == number)
    };
    for (number, body) in (1..).zip(bodies) {
        if held(number) {
            continue;
        }
        if body.is_prescribed() {
            doubts.push(format!(
                "no element is at {}, whose motion is prescribed: it does nothing; leave it out, or name it \
                 as an end of an element",
                body.name
            ));
        } else if body.free[2] && description.gravity > 0.0 {
            doubts.push(format!(
                "nothing holds {}: it falls freely; put an element between it and another body, or hold \
                 its z",
                body.name
            ));
        } else {
            doubts.push(format!(
                "nothing holds {}: it goes on as it starts; put an element between it and another body",
                body.name
            ));
        }
    }
    doubts
}
