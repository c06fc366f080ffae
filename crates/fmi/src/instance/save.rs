//! Saving and restoring an instance.

mod check;

use serde::{Deserialize, Serialize};

use super::{Experiment, Instance, Phase};
use crate::Error;
use crate::element::Interface;
use crate::element_state::ElementState;
use crate::extrapolate::Point;
use crate::limits;
use crate::watch::Doubt;

/// Version of [`Saved`].
const VERSION: u32 = 3;

/// A saved instance: plain data, restorable in another process.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Saved {
    version: u32,
    /// The description that the instance belongs to.
    token: String,
    interface: Interface,
    phase: Phase,
    start: f64,
    stop: Option<f64>,
    tolerance: Option<f64>,
    time: f64,
    parameters: Vec<f64>,
    options: Vec<i32>,
    inputs: Vec<f64>,
    /// Those from which the element started.
    start_inputs: Vec<f64>,
    slopes: Vec<Option<f64>>,
    set: Vec<bool>,
    past: Vec<Point>,
    doubts: Vec<Doubt>,
    restartable: bool,
    stale: bool,
    element: Option<ElementState>,
}

impl Saved {
    /// Returns the state as bytes: JSON, whose numbers read back to the last bit.
    ///
    /// # Errors
    /// Never, with what an instance has given.
    pub fn to_bytes(&self) -> Result<Vec<u8>, Error> {
        serde_json::to_vec(self).map_err(|error| Error::new(format!("the state cannot be written: {error}")))
    }

    /// Reads what [`Saved::to_bytes`] wrote.
    ///
    /// # Errors
    /// These are no bytes of such a state, or more than [`limits::RECORD_FILE`].
    pub fn from_bytes(bytes: &[u8]) -> Result<Self, Error> {
        if bytes.len() as u64 > limits::RECORD_FILE {
            return Err(Error::new(format!(
                "{} bytes are no saved state; at most {} are read",
                bytes.len(),
                limits::RECORD_FILE
            )));
        }
        serde_json::from_slice(bytes)
            .map_err(|error| Error::new(format!("these bytes are no saved state of an instance: {error}")))
    }
}

impl Instance {
    /// Returns its state.
    #[must_use]
    pub fn save(&self) -> Saved {
        Saved {
            version: VERSION,
            token: self.token.clone(),
            interface: self.interface,
            phase: self.phase,
            start: self.experiment.start,
            stop: self.experiment.stop,
            tolerance: self.experiment.tolerance,
            time: self.time,
            parameters: self.values.parameters.clone(),
            options: self.values.options.clone(),
            inputs: self.values.inputs.clone(),
            start_inputs: self.values.start_inputs.clone(),
            slopes: self.values.slopes.clone(),
            set: self.values.set.clone(),
            past: self.values.past.clone(),
            doubts: self.values.doubts.clone(),
            restartable: self.values.restartable,
            stale: self.stale,
            element: self.element.as_ref().map(|element| element.save()),
        }
    }

    /// Goes back to a saved state, of this or of another instance of the same FMU and kind of interface.
    ///
    /// # Errors
    /// The state is of another version, FMU or kind of interface, or damaged; nothing has changed then.
    pub fn restore(&mut self, saved: &Saved) -> Result<(), Error> {
        if saved.version != VERSION {
            return Err(Error::new(format!(
                "the saved state has version {}; this library reads version {VERSION}",
                saved.version
            )));
        }
        if saved.token != self.token {
            return Err(Error::new(
                "the saved state belongs to another FMU; restore one that this FMU has given",
            ));
        }
        if saved.interface != self.interface {
            return Err(Error::new(
                "the saved state belongs to the other kind of interface (model exchange or co-simulation)",
            ));
        }
        saved.check(self)?;
        // What was set before the start makes another element.
        let keeps = saved.element.is_some()
            && self.element.is_some()
            && !self.phase.is_before_start()
            && same_bits(&saved.parameters, &self.values.parameters)
            && same_bits(&saved.start_inputs, &self.values.start_inputs)
            && saved.options == self.values.options
            && (saved.start, saved.tolerance) == (self.experiment.start, self.experiment.tolerance);
        let mut fresh = None;
        if let Some(state) = &saved.element {
            if keeps {
                if let Some(element) = &mut self.element {
                    element.restore(state)?;
                }
            } else {
                let mut other = self.twin(saved);
                other.build()?.restore(state)?;
                fresh = other.element.take();
            }
        }
        if !keeps {
            self.element = fresh;
        }
        self.phase = saved.phase;
        self.experiment = Experiment {
            start: saved.start,
            stop: saved.stop,
            tolerance: saved.tolerance,
        };
        self.time = saved.time;
        self.values.parameters.clone_from(&saved.parameters);
        self.values.options.clone_from(&saved.options);
        self.values.inputs.clone_from(&saved.inputs);
        self.values.start_inputs.clone_from(&saved.start_inputs);
        self.values.slopes.clone_from(&saved.slopes);
        self.values.set.clone_from(&saved.set);
        self.values.past.clone_from(&saved.past);
        self.values.doubts.clone_from(&saved.doubts);
        self.values.restartable = saved.restartable;
        self.stale = saved.stale;
        self.changed();
        Ok(())
    }

    /// Returns an instance beside this one, with the values of a saved one and no element yet.
    fn twin(&self, saved: &Saved) -> Self {
        let mut values = self.values.clone();
        values.parameters.clone_from(&saved.parameters);
        values.options.clone_from(&saved.options);
        values.inputs.clone_from(&saved.start_inputs);
        Self {
            description: self.description.clone(),
            token: self.token.clone(),
            source: self.source.clone(),
            version: self.version,
            interface: self.interface,
            name: self.name.clone(),
            phase: Phase::Initialization,
            experiment: Experiment {
                start: saved.start,
                stop: saved.stop,
                tolerance: saved.tolerance,
            },
            values,
            time: saved.start,
            element: None,
            stale: false,
            outputs: None,
            columns: None,
            log_events: false,
            log: Vec::new(),
            warned: Vec::new(),
        }
    }
}

fn same_bits(a: &[f64], b: &[f64]) -> bool {
    a.len() == b.len() && a.iter().zip(b).all(|(a, b)| a.to_bits() == b.to_bits())
}
