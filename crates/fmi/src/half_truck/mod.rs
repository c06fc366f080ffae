//! A half-truck from files of NUCARS, as data of [`crate::system`]: the run of a run file, or one of the
//! built-in runs.
//!
//! Its input bodies move as the inputs say, or as the files say. The FMU holds the texts of the files and the
//! settings of the run ([`RESOURCE`]); names of files are kept without their folders.

mod entries;

use std::path::Path;

use integrate::Options;
use mechanics::system::System;
use nucars::Severity;
use nucars::file_sets::{RunFiles, Texts};
use serde::{Deserialize, Serialize};
use study::half_truck::columns::Columns;
use study::half_truck::files::{Settings, case_of_run};
use study::half_truck::{HalfTruckCase, HalfTruckStart, catalog};
use study::packed::PackedFile;

use crate::Error;
use crate::element::Setting;
use crate::limits;
use crate::source::{Made, Model, Origin};
use crate::system::{Plant, StartState, is_driven};

/// The file with the run.
pub const RESOURCE: &str = "run.json";
/// Version of that file.
const VERSION: u32 = 1;

/// The file with the run, as it is written.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Resource {
    version: u32,
    settings: Settings,
    run: RunSource,
}

/// What the run is made of.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
enum RunSource {
    /// The built-in run of this name.
    BuiltIn(String),
    /// Files.
    Files(Box<Texts>),
}

/// A run of a half-truck, and what it is made of.
#[derive(Clone, Debug)]
pub struct HalfTruck {
    case: HalfTruckCase,
    text: String,
}

impl HalfTruck {
    /// Returns the built-in run of this name.
    ///
    /// # Errors
    /// There is none, or the settings make no run of it.
    pub fn built_in(name: &str, settings: &Settings) -> Result<Self, Error> {
        Self::of(Resource {
            version: VERSION,
            settings: settings.clone(),
            run: RunSource::BuiltIn(name.to_owned()),
        })
    }

    /// Returns the run of these files.
    ///
    /// # Errors
    /// The files have errors, or they and the settings make no run.
    pub fn of_files(texts: Texts, settings: &Settings) -> Result<Self, Error> {
        let mut texts = texts;
        let Texts {
            run,
            system,
            data,
            input,
        } = &mut texts;
        for text in [run, system, data, input].into_iter().flatten() {
            if let Some(name) = Path::new(&text.name).file_name() {
                text.name = name.to_string_lossy().into_owned();
            }
        }
        Self::of(Resource {
            version: VERSION,
            settings: settings.clone(),
            run: RunSource::Files(Box::new(texts)),
        })
    }

    /// Returns the run of a file [`RESOURCE`].
    ///
    /// # Errors
    /// It is damaged.
    pub fn parse(text: &str) -> Result<Self, Error> {
        let damaged =
            |error: &dyn std::fmt::Display| Error::new(format!("the FMU's {RESOURCE} is damaged: {error}"));
        let resource: Resource = serde_json::from_str(text).map_err(|error| damaged(&error))?;
        if resource.version != VERSION {
            return Err(Error::new(format!(
                "the FMU's {RESOURCE} has version {}; this library reads version {VERSION}",
                resource.version
            )));
        }
        Self::of(resource).map_err(|error| damaged(&error))
    }

    fn of(resource: Resource) -> Result<Self, Error> {
        let settings = &resource.settings;
        check(settings)?;
        let case = match &resource.run {
            RunSource::BuiltIn(name) => catalog::entry(name)
                .ok_or_else(|| {
                    let name = input::shortened(name);
                    Error::new(format!("there is no built-in run `{name}` of a half-truck"))
                })?
                .case_with(settings)
                .map_err(Error::of)?,
            RunSource::Files(texts) => of_texts(texts, settings)?,
        };
        if !case.wedge_bodies.is_empty() {
            return Err(Error::new(
                "FMUs of half-trucks have massless wedges, and wedges=bodies is set; leave it out, or \
                 export a truck or a wedge"
                    .to_owned(),
            ));
        }
        let text = serde_json::to_string_pretty(&resource)
            .map_err(|error| Error::new(format!("the run cannot be written: {error}")))?;
        Ok(Self { case, text })
    }

    /// Returns the run.
    #[must_use]
    pub fn case(&self) -> &HalfTruckCase {
        &self.case
    }

    /// Returns the text of the file [`RESOURCE`].
    #[must_use]
    pub fn text(&self) -> &str {
        &self.text
    }

    /// Returns the half-truck under these settings; without any, inputs move its input bodies.
    ///
    /// # Errors
    /// The files make no system.
    pub fn plant(&self, setting: Option<&Setting>) -> Result<Plant, Error> {
        let case = &self.case;
        let system = System::new(case.truck.model.clone()).map_err(Error::of)?;
        let columns = Columns::new(case, &system);
        let (entries, ports) = entries::all(case, &system, columns.columns());
        let options = Options {
            relative_tolerance: case.relative_tolerance,
            ..Options::default()
        };
        Ok(Plant {
            table: Some(Box::new(move |seen, _, row| columns.read(seen, row))),
            numbers: [case.truck.bodies.clone(), case.truck.connections.clone()],
            start: StartState::asked(setting),
            driven: is_driven(setting),
            ..Plant::new(system, entries, ports, options)
        })
    }
}

/// A half-truck with its wedges.
pub(crate) struct HalfTruckModel;

impl Model for HalfTruckModel {
    type Origin = HalfTruck;

    const NAME: &'static str = "HalfTruck";
    const TEXT: &'static str = "Loaded half of a three-piece truck from files of NUCARS: half a car on a \
                                bolster, friction wedges, side frames, springs";
    const CONVENTIONS: &'static str = "Axes: x forward, y left, z up; displacements of centers of gravity \
                                       from the drawn position, small angles. Bodies, wedges and connections \
                                       have the numbers of the files; forces of connections are positive in \
                                       extension.";

    fn made(half_truck: &HalfTruck, setting: Option<&Setting>) -> Result<Made, Error> {
        half_truck.plant(setting)?.made(setting)
    }
}

impl Origin for HalfTruck {
    type Case = HalfTruckCase;

    const WORD: &'static str = "run";
    const FILE: (&'static str, u64) = (RESOURCE, limits::RECORD_FILE);

    fn case(&self) -> (&HalfTruckCase, &str) {
        (&self.case, &self.case.title)
    }

    fn packed(&self) -> (String, Vec<PackedFile>) {
        (self.text.clone(), Vec::new())
    }

    fn parse(text: &str, _: &Path) -> Result<Self, Error> {
        Self::parse(text)
    }
}

/// Checks settings that may have been edited by hand; the others are checked where they are used.
fn check(settings: &Settings) -> Result<(), Error> {
    let tolerance = settings.relative_tolerance;
    if !(tolerance > 0.0 && tolerance < 1.0) {
        return Err(Error::new(format!(
            "`relative_tolerance` is {tolerance}; it must lie between 0 and 1"
        )));
    }
    match settings.choices.speed {
        Some(speed) if !(speed > 0.0 && speed.is_finite()) => Err(Error::new(format!(
            "`speed` is {speed}; it must be positive and finite"
        ))),
        _ => Ok(()),
    }
}

fn of_texts(texts: &Texts, settings: &Settings) -> Result<HalfTruckCase, Error> {
    let files = RunFiles::of_texts(texts).map_err(Error::of)?;
    let mut all = files.findings().flat_map(|findings| findings.list());
    if let Some(first) = all.find(|one| one.severity() == Severity::Error) {
        let count = files.count(Severity::Error);
        return Err(Error::new(format!(
            "its files have {count} error(s), the first of which is: {first}; `wedgelab nucars check` \
             tells all with their places"
        )));
    }
    let name = texts.run.as_ref().map_or("", |run| &*run.name);
    case_of_run(Path::new(name), &files, settings).map_err(Error::of)
}

/// Returns the text of an option for the start of a run.
fn start_option(start: HalfTruckStart) -> i32 {
    match start {
        HalfTruckStart::Drawn => 0,
        HalfTruckStart::Equilibrium => 1,
    }
}
