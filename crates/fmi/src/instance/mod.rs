//! One instance of an FMU: the state machine of the standard, for both versions and both kinds of interface.
//!
//! Every call returns a result; a refused call changes nothing. What is to be logged is collected in
//! [`Instance::take_log`].

mod access;
mod phase;
mod save;
mod step;
mod warn;

pub use phase::Phase;
pub use save::Saved;
pub use step::EventUpdate;
use warn::Warned;

use std::path::Path;
use std::sync::Arc;

use numerics::processor::{self, OldProcessor};
use serde::{Deserialize, Serialize};
use study::case::Case;

use crate::description::{Description, Version};
use crate::element::{Element, Interface, Setting};
use crate::extrapolate::Point;
use crate::source::{FmuModel, Source};
use crate::variable::Start;
use crate::watch::{Doubt, positions};
use crate::{Category, Error, Severity, resources};

/// A message for the importer's log.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Message {
    /// The severity.
    pub severity: Severity,
    /// The subject.
    pub category: Category,
    /// The text.
    pub text: String,
}

/// Times of the experiment.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Experiment {
    start: f64,
    stop: Option<f64>,
    tolerance: Option<f64>,
}

/// The values that an importer has set.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Values {
    parameters: Vec<f64>,
    options: Vec<i32>,
    inputs: Vec<f64>,
    /// The inputs from which the element started.
    start_inputs: Vec<f64>,
    /// Derivatives of the inputs, for the next step only.
    slopes: Vec<Option<f64>>,
    /// True for each input that has been set since the initialization.
    set: Vec<bool>,
    /// Inputs at earlier points, the latest last.
    past: Vec<Point>,
    /// Doubts about positions and their rates.
    doubts: Vec<Doubt>,
    /// The first step may be made again, see [`Instance::begin_again`].
    restartable: bool,
}

/// An instance.
pub struct Instance {
    description: Arc<Description>,
    token: String,
    source: Arc<Source>,
    version: Version,
    interface: Interface,
    name: String,
    phase: Phase,
    experiment: Experiment,
    values: Values,
    time: f64,
    element: Option<Box<dyn Element>>,
    /// Inputs have been set that the element does not know yet.
    stale: bool,
    /// Outputs and columns as computed last, if they are those of now.
    outputs: Option<Vec<f64>>,
    columns: Option<Vec<f64>>,
    /// True if changes of contact states are logged.
    log_events: bool,
    log: Vec<Message>,
    /// The warnings that have been given: each is given once.
    warned: Vec<Warned>,
}

impl std::fmt::Debug for Instance {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Instance")
            .field("name", &self.name)
            .field("model", &self.description.model)
            .field("interface", &self.interface)
            .field("phase", &self.phase)
            .field("time", &self.time)
            .finish_non_exhaustive()
    }
}

impl Instance {
    /// Returns an instance of the FMU whose `resources` lie in a folder.
    ///
    /// # Errors
    /// The folder is not that of an FMU of this program, the token is not that of its description, or the
    /// library was compiled for other processors.
    pub fn new(
        name: &str,
        token: &str,
        folder: &Path,
        version: Version,
        interface: Interface,
    ) -> Result<Self, Error> {
        processor::check().map_err(|error| Error::new(format!("{error}. {}", OldProcessor::ADVICE)))?;
        Self::of(name, Some(token), resources::read(folder)?, version, interface)
    }

    /// Returns an instance of a model that is made of a case; the token is compared if there is one.
    ///
    /// # Errors
    /// The case makes no such model, or the token is another one.
    pub fn of_case(
        name: &str,
        token: Option<&str>,
        model: FmuModel,
        case: Case,
        version: Version,
        interface: Interface,
    ) -> Result<Self, Error> {
        let source = Source::of_case(model, case)
            .ok_or_else(|| Error::new(format!("{} is not made of a case", model.name())))?;
        Self::of(name, token, source, version, interface)
    }

    /// Returns an instance of what is made of a source; the token is compared if there is one.
    ///
    /// # Errors
    /// Nothing can be made of the source, or the token is another one.
    pub fn of(
        name: &str,
        token: Option<&str>,
        source: Source,
        version: Version,
        interface: Interface,
    ) -> Result<Self, Error> {
        let description = Description::new(&source)?;
        let own = description.token(version);
        if let Some(token) = token.filter(|token| *token != own) {
            return Err(Error::new(format!(
                "the token {token} is not that of this FMU, {own}: modelDescription.xml and library do not \
                 belong together"
            )));
        }
        let values = Values::of(&description);
        Ok(Self {
            description: Arc::new(description),
            token: own,
            source: Arc::new(source),
            version,
            interface,
            name: name.to_owned(),
            phase: Phase::Instantiated,
            experiment: Experiment::default(),
            time: 0.0,
            values,
            element: None,
            stale: false,
            outputs: None,
            columns: None,
            log_events: false,
            log: Vec::new(),
            warned: Vec::new(),
        })
    }

    /// Returns its name.
    #[must_use]
    pub fn name(&self) -> &str {
        &self.name
    }
    /// Returns the description of the model.
    #[must_use]
    pub fn description(&self) -> &Description {
        &self.description
    }
    /// Returns the interface by which it is used.
    #[must_use]
    pub fn interface(&self) -> Interface {
        self.interface
    }
    /// Returns the version of the standard that it is used by.
    #[must_use]
    pub fn version(&self) -> Version {
        self.version
    }
    /// Returns the phase of its life cycle.
    #[must_use]
    pub fn phase(&self) -> Phase {
        self.phase
    }
    /// Time, s.
    #[must_use]
    pub fn time(&self) -> f64 {
        self.time
    }
    /// Messages collected since the last call.
    pub fn take_log(&mut self) -> Vec<Message> {
        std::mem::take(&mut self.log)
    }
    /// Says whether changes of contact states are logged.
    pub fn log_events(&mut self, on: bool) {
        self.log_events = on;
    }

    /// Sets times and tolerance of the experiment.
    ///
    /// # Errors
    /// Called too late, or values that are not finite or out of order.
    pub fn set_experiment(
        &mut self,
        start: f64,
        stop: Option<f64>,
        tolerance: Option<f64>,
    ) -> Result<(), Error> {
        self.require("the experiment is set up", &[Phase::Instantiated])?;
        let experiment = Experiment {
            start,
            stop,
            tolerance,
        };
        check_experiment(experiment)?;
        // One that was built to read its values has another start.
        self.element = None;
        self.changed();
        self.experiment = experiment;
        self.time = start;
        Ok(())
    }

    /// Begins the initialization.
    ///
    /// # Errors
    /// Called out of order.
    pub fn enter_initialization(&mut self) -> Result<(), Error> {
        self.require("initialization begins", &[Phase::Instantiated])?;
        self.phase = Phase::Initialization;
        Ok(())
    }

    /// Ends the initialization: the element starts from what has been set.
    ///
    /// # Errors
    /// Called out of order, or no element starts from these values.
    pub fn exit_initialization(&mut self) -> Result<(), Error> {
        self.require("initialization ends", &[Phase::Initialization])?;
        self.build()?;
        self.values.past.push(Point {
            time: self.time,
            inputs: self.values.inputs.clone(),
        });
        self.phase = match self.interface {
            Interface::ModelExchange => Phase::Event,
            Interface::CoSimulation => Phase::Step,
        };
        Ok(())
    }

    /// Ends the simulation.
    ///
    /// # Errors
    /// Called out of order.
    pub fn terminate(&mut self) -> Result<(), Error> {
        self.require(
            "the simulation ends",
            &[Phase::Event, Phase::Continuous, Phase::Step, Phase::Failed],
        )?;
        self.phase = Phase::Terminated;
        Ok(())
    }

    /// Goes back to the state after instantiation: all start values are those of the description again.
    pub fn reset(&mut self) {
        self.phase = Phase::Instantiated;
        self.experiment = Experiment::default();
        self.values = Values::of(&self.description);
        self.time = 0.0;
        self.element = None;
        self.changed();
        self.stale = false;
        self.warned.clear();
    }

    /// Returns the element under these values, starting from these inputs.
    fn made(
        &self,
        values: &Values,
        inputs: &[f64],
        experiment: Experiment,
    ) -> Result<Box<dyn Element>, Error> {
        let setting = Setting {
            interface: self.interface,
            parameters: values.parameters.clone(),
            options: values.options.clone(),
            inputs: inputs.to_vec(),
            tolerance: experiment.tolerance,
            start_time: experiment.start,
        };
        self.source.element(&self.description.entries, &setting)
    }

    /// Returns the element under the values set so far.
    fn build(&mut self) -> Result<&mut Box<dyn Element>, Error> {
        if self.element.is_none() {
            let element = self.made(&self.values, &self.values.inputs, self.experiment)?;
            self.values.start_inputs.clone_from(&self.values.inputs);
            self.stale = false;
            self.element = Some(element);
        }
        self.element
            .as_mut()
            .ok_or_else(|| Error::new("the element is missing"))
    }

    /// Returns the element, knowing all inputs that have been set.
    fn fresh(&mut self) -> Result<&mut Box<dyn Element>, Error> {
        if self.stale && self.interface == Interface::ModelExchange {
            let inputs = self.values.inputs.clone();
            self.build()?.set_inputs(&inputs)?;
            self.stale = false;
        }
        self.build()
    }

    /// Discards outputs computed before a change.
    fn changed(&mut self) {
        self.outputs = None;
        self.columns = None;
    }

    fn say(&mut self, severity: Severity, category: Category, text: String) {
        self.log.push(Message {
            severity,
            category,
            text,
        });
    }
}

/// Checks whether times and tolerance can be those of an experiment.
fn check_experiment(experiment: Experiment) -> Result<(), Error> {
    let Experiment {
        start,
        stop,
        tolerance,
    } = experiment;
    if !start.is_finite() {
        return Err(Error::new(format!(
            "the start time is {start}; it must be finite"
        )));
    }
    if let Some(stop) = stop.filter(|stop| stop.is_nan() || *stop < start) {
        return Err(Error::new(format!(
            "the stop time is {stop}; it must not be before the start time {start}"
        )));
    }
    if let Some(tolerance) = tolerance.filter(|tolerance| !(*tolerance > 0.0 && *tolerance < 1.0)) {
        return Err(Error::new(format!(
            "the tolerance is {tolerance}; it must lie between 0 and 1"
        )));
    }
    Ok(())
}

impl Values {
    fn of(description: &Description) -> Self {
        let entries = &description.entries;
        let real = |entry: &crate::element::QuantityEntry| match entry.start {
            Start::Float(Some(start)) => start,
            _ => 0.0,
        };
        Self {
            parameters: entries.parameters.iter().map(real).collect(),
            options: entries
                .options
                .iter()
                .map(|entry| match entry.start {
                    Start::Integer(Some(start)) => start,
                    Start::Boolean(start) => i32::from(start),
                    _ => 0,
                })
                .collect(),
            inputs: entries.inputs.iter().map(real).collect(),
            start_inputs: entries.inputs.iter().map(real).collect(),
            slopes: vec![None; entries.inputs.len()],
            set: vec![false; entries.inputs.len()],
            past: Vec::new(),
            doubts: vec![Doubt::default(); positions(&entries.inputs).count()],
            restartable: true,
        }
    }
}
