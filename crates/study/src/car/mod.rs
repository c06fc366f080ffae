//! Freight cars on track: cases, runs, statistics, results.
//!
//! [`CarCase`] is what a user writes, completed and in SI; [`regime`] has the tracks and speeds of the field,
//! [`builtin`] cases on them; [`statistics`] says what rules for the assessment of cars ask, [`limits`]
//! beside what they allow; [`run`] records a run, [`motions`] what a picture of it needs; [`stability`]
//! linearizes, [`locus`](crate::locus) over any parameter; [`hunting`] ramps the speed, [`onset`] holds it.

pub(crate) mod assumptions;
pub mod builtin;
mod changes;
mod checks;
pub mod columns;
pub(crate) mod couplers;
mod derailment;
pub mod figures;
pub(crate) mod friction;
pub mod hunting;
mod lading;
pub mod limits;
pub mod locked_in;
pub mod mode_shape;
pub mod motions;
pub(crate) mod named;
pub(crate) mod not_round;
pub mod onset;
pub(crate) mod output;
pub(crate) mod peaks;
pub(crate) mod profiles;
pub(crate) mod rails;
pub mod regime;
pub mod run;
pub(crate) mod sections;
pub mod speeds;
pub mod stability;
pub mod static_table;
pub mod statistics;
pub mod summary;
pub(crate) mod track;
pub(crate) mod trucks;
pub(crate) mod wheels;
pub mod worst;

use std::sync::Arc;

use car::Parameters;

use crate::case::Simulation;
use crate::case::model::{Model, model_case};
use crate::case::tables::NamedFile;
use crate::damage::DamageLaws;
use crate::output_files::OutputFiles;
use crate::reader::{CaseReader, CaseText};
use limits::LimitSet;
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
    /// The laws of damage of wheels and rails.
    pub damage: DamageLaws,
    /// The limits that its summary compares with; `None`: those of freight cars, built in.
    pub limits: Option<Arc<LimitSet>>,
    /// The files of its time histories.
    pub output_files: OutputFiles,
    /// The settings of the run.
    pub simulation: Simulation,
    /// What [`stability`](mod@stability) looks at besides.
    pub stability: sections::StabilityKeys,
    /// Warnings of reading.
    pub doubts: Vec<String>,
    /// Profiles and measured tables that were read.
    pub(crate) files: Vec<NamedFile>,
    text: CaseText,
}

impl PartialEq for CarCase {
    /// Two cases are the same if their completed case files are.
    fn eq(&self, other: &Self) -> bool {
        self.text.embedded == other.text.embedded
    }
}

model_case!(CarCase, Model::Car, trucks::complete, read);

impl CarCase {
    /// Returns the speed at the start, m/s.
    #[must_use]
    pub fn speed(&self) -> f64 {
        self.parameters.start.speed
    }
}

/// Reads a case, section by section.
fn read(r: &mut CaseReader<'_>, default_name: &str) -> Option<CarCase> {
    let [name, title] = r.head(default_name, Model::Car, "\"car\": a freight car on track")?;
    let drawn = sections::everything(r);
    let files = std::mem::take(&mut r.files);
    let text = r.finish("a car's case");
    let sections::CarSections {
        parameters,
        rules,
        damage,
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
        damage,
        limits: None,
        output_files,
        simulation,
        stability,
        doubts,
        files,
        text,
    })
}
