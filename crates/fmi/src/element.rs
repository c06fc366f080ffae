//! The elements whose quantities the variables show.

use mechanics::plausibility::{Location, PlausibilityFinding};
use quantity::Kind;
use serde::{Deserialize, Serialize};

use crate::Error;
use crate::element_state::ElementState;
use crate::unit::Unit;
use crate::variable::Start;

/// The interface type of an instance.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum Interface {
    /// The importer integrates.
    ModelExchange,
    /// The instance integrates itself from one communication point to the next.
    CoSimulation,
}

/// A quantity of an element, as a variable shows it.
#[derive(Clone, Debug, PartialEq)]
pub struct QuantityEntry {
    /// Its name.
    pub name: String,
    /// The description.
    pub text: String,
    /// Its unit.
    pub unit: Option<Unit>,
    /// Type and start value.
    pub start: Start,
    /// Its usual size.
    pub nominal: Option<f64>,
    /// Least and greatest admissible value.
    pub reach: Option<[f64; 2]>,
    /// True if it may change while a simulation runs (parameters).
    pub tunable: bool,
    /// For a position the input that is its rate.
    pub rate: Option<usize>,
    /// True if it is an output too (states).
    pub output: bool,
}

impl QuantityEntry {
    /// Returns a real number of a kind, which is calculated.
    pub(crate) fn of(kind: Kind, name: impl Into<String>, text: impl Into<String>) -> Self {
        Self::real(name, Some(Unit::Of(kind)), None, text)
    }

    /// Returns the same with a start value.
    pub(crate) fn starting(self, value: f64) -> Self {
        Self {
            start: Start::Float(Some(value)),
            ..self
        }
    }

    /// Returns the same with a usual size.
    pub(crate) fn of_size(self, nominal: f64) -> Self {
        Self {
            nominal: Some(nominal),
            ..self
        }
    }

    /// Returns a real number.
    #[must_use]
    pub fn real(
        name: impl Into<String>,
        unit: Option<Unit>,
        start: Option<f64>,
        text: impl Into<String>,
    ) -> Self {
        Self {
            name: name.into(),
            text: text.into(),
            unit,
            start: Start::Float(start),
            nominal: None,
            reach: None,
            tunable: false,
            rate: None,
            output: false,
        }
    }

    /// Returns an integer between two values.
    #[must_use]
    pub fn integer(name: &str, start: Option<i32>, reach: [i32; 2], text: impl Into<String>) -> Self {
        Self {
            start: Start::Integer(start),
            reach: Some(reach.map(f64::from)),
            ..Self::real(name, None, None, text)
        }
    }

    /// Returns a truth value.
    #[must_use]
    pub fn boolean(name: &str, start: bool, text: impl Into<String>) -> Self {
        Self {
            start: Start::Boolean(start),
            ..Self::real(name, None, None, text)
        }
    }
}

/// Returns the input that is the rate of a position, at rest at the start.
pub(crate) fn rate_input(kind: Kind, position: &str) -> QuantityEntry {
    let text = format!("rate of {position}; never set, co-simulation finds it from {position}");
    QuantityEntry::of(kind, format!("{position}_rate"), text).starting(0.0)
}

/// Returns the relative residual of the energy ledger.
pub(crate) fn relative_residual() -> QuantityEntry {
    QuantityEntry::real(
        "ledger_relative_residual",
        None,
        None,
        "residual of the energy ledger now over the largest of work, losses and change of stored energy \
         since the start",
    )
}

/// All quantities of an element.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Entries {
    /// Real parameters.
    pub parameters: Vec<QuantityEntry>,
    /// Options: integers and truth values.
    pub options: Vec<QuantityEntry>,
    /// Inputs, positions and rates of neighbours first.
    pub inputs: Vec<QuantityEntry>,
    /// Outputs.
    pub outputs: Vec<QuantityEntry>,
    /// Outputs depend on states alone, not on inputs.
    pub outputs_of_states: bool,
    /// Continuous states.
    pub states: Vec<QuantityEntry>,
    /// Number of them, at the end of the list, that are only accumulated: nothing depends on them.
    pub accumulators: usize,
    /// States whose rate is another state, by number; the others' rates depend on everything.
    pub kinematic: Vec<(usize, usize)>,
    /// Values to observe.
    pub columns: Vec<QuantityEntry>,
    /// Contact states.
    pub modes: Vec<QuantityEntry>,
    /// Event indicators.
    pub indicators: Vec<QuantityEntry>,
}

/// The setting from which an element starts.
#[derive(Clone, Debug, PartialEq)]
pub struct Setting {
    /// The interface by which it is used.
    pub interface: Interface,
    /// Values of the real parameters.
    pub parameters: Vec<f64>,
    /// Values of the options; truth values are 0 and 1.
    pub options: Vec<i32>,
    /// Values of the inputs.
    pub inputs: Vec<f64>,
    /// Tolerance of the experiment, if the importer has given one.
    pub tolerance: Option<f64>,
    /// Time at the start, s.
    pub start_time: f64,
}

impl Setting {
    /// Returns the value of an option.
    pub(crate) fn option(&self, place: usize) -> i32 {
        self.options.get(place).copied().unwrap_or(0)
    }
}

/// Derivatives of rates and outputs along a direction.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Slopes {
    /// Of the rates of the states.
    pub rates: Vec<f64>,
    /// Of the outputs.
    pub outputs: Vec<f64>,
}

/// An element at work, from the initialization on. Lists have the lengths and orders of [`Entries`]; SI
/// units.
pub trait Element: Send {
    /// Returns the continuous states.
    fn states(&self) -> &[f64];
    /// Sets time and continuous states (model exchange).
    ///
    /// # Errors
    /// Values that are not finite, or too many or few.
    fn set_states(&mut self, time: f64, states: &[f64]) -> Result<(), Error>;
    /// Sets the inputs at this instant.
    ///
    /// # Errors
    /// Values that are not finite, or outside their reach.
    fn set_inputs(&mut self, inputs: &[f64]) -> Result<(), Error>;
    /// Takes over tunable parameters; the others are as they were.
    ///
    /// # Errors
    /// Values outside their reach.
    fn tune(&mut self, parameters: &[f64]) -> Result<(), Error>;
    /// Integrates to a time (co-simulation), the inputs going smoothly from where they are to `end`.
    ///
    /// # Errors
    /// The integration cannot go on.
    fn step(&mut self, end: &[f64], time: f64) -> Result<(), Error>;
    /// Returns the number of steps that the integrator has attempted so far (co-simulation).
    fn attempts(&self) -> u64 {
        0
    }
    /// Writes the rates of the states.
    ///
    /// # Errors
    /// `out` has another length.
    fn rates(&mut self, out: &mut [f64]) -> Result<(), Error>;
    /// The event indicators: never exactly zero.
    fn indicators(&mut self, out: &mut [f64]);
    /// Returns the contact states.
    fn modes(&self) -> &[u8];
    /// Brings the contact states up to date.
    fn update_modes(&mut self) -> bool;
    /// Returns the time of the next time event (s), if there is one, at an event (model exchange).
    fn next_time_event(&mut self) -> Option<f64> {
        None
    }
    /// Writes the outputs.
    ///
    /// # Errors
    /// Never, with an element that was built here.
    fn outputs(&mut self, out: &mut [f64]) -> Result<(), Error>;
    /// Returns the values to observe.
    fn columns(&mut self, out: &mut [f64]);
    /// Returns what has been implausible so far, the present instant included.
    fn findings(&mut self) -> Vec<PlausibilityFinding>;
    /// Returns in words that a wheel has left its rail at the present instant, if one has.
    fn derailed(&mut self) -> Option<String> {
        None
    }
    /// Returns the place of a finding in words.
    fn place(&self, location: Location) -> String;
    /// Derivatives along a direction of states and inputs.
    ///
    /// # Errors
    /// Lists of other lengths.
    fn jacobian_vector_product(&mut self, states: &[f64], inputs: &[f64]) -> Result<Slopes, Error>;
    /// Returns its state, to go on from with the same bits.
    fn save(&self) -> ElementState;
    /// Goes back to a saved state.
    ///
    /// # Errors
    /// The state is of another element.
    fn restore(&mut self, state: &ElementState) -> Result<(), Error>;
}
