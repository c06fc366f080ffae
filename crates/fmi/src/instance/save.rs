//! Saving and restoring an instance.

mod check;

use serde::{Deserialize, Serialize};

use super::{Experiment, Instance, Phase, Values};
use crate::Error;
use crate::element::Interface;
use crate::element_state::ElementState;
use crate::limits;

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
    experiment: Experiment,
    time: f64,
    values: Values,
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
            experiment: self.experiment,
            time: self.time,
            values: self.values.clone(),
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
            && same_bits(&saved.values.parameters, &self.values.parameters)
            && same_bits(&saved.values.start_inputs, &self.values.start_inputs)
            && saved.values.options == self.values.options
            && saved.experiment.start == self.experiment.start
            && saved.experiment.tolerance == self.experiment.tolerance;
        let mut fresh = None;
        match (&saved.element, &mut self.element) {
            (Some(state), Some(element)) if keeps => element.restore(state)?,
            (Some(state), _) => {
                let inputs = &saved.values.start_inputs;
                let mut other = self.made(&saved.values, inputs, saved.experiment)?;
                other.restore(state)?;
                fresh = Some(other);
            }
            (None, _) => {}
        }
        if !keeps {
            self.element = fresh;
        }
        self.phase = saved.phase;
        self.experiment = saved.experiment;
        self.time = saved.time;
        self.values = saved.values.clone();
        self.stale = saved.stale;
        self.changed();
        Ok(())
    }
}

fn same_bits(a: &[f64], b: &[f64]) -> bool {
    a.len() == b.len() && a.iter().zip(b).all(|(a, b)| a.to_bits() == b.to_bits())
}
