//! Getting and setting variables.

use super::{Instance, Phase};
use crate::Error;
use crate::element::{Interface, QuantityEntry};
use crate::variable::{Causality, Start, Variability, Variable, VariableRole};

/// The type that a call is for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Type {
    Float,
    Integer,
    Boolean,
}

impl Type {
    fn of(start: Start) -> Self {
        match start {
            Start::Float(_) => Self::Float,
            Start::Integer(_) => Self::Integer,
            Start::Boolean(_) => Self::Boolean,
        }
    }

    fn name(self) -> &'static str {
        match self {
            Self::Float => "real",
            Self::Integer => "integer",
            Self::Boolean => "Boolean",
        }
    }
}

fn unknown(reference: u32, count: usize) -> Error {
    Error::new(format!(
        "there is no variable with value reference {reference}; those of modelDescription.xml go from 0 to \
         {}",
        count.saturating_sub(1)
    ))
}

impl Instance {
    fn find(&self, reference: u32, wanted: Type) -> Result<&Variable, Error> {
        let variable = self
            .description
            .variable(reference)
            .ok_or_else(|| unknown(reference, self.description.variables.len()))?;
        let own = Type::of(variable.start);
        if own != wanted {
            return Err(Error::new(format!(
                "`{}` (value reference {reference}) is of the type {}, not {}",
                variable.name,
                own.name(),
                wanted.name()
            )));
        }
        Ok(variable)
    }

    /// Returns the value of a real variable.
    ///
    /// # Errors
    /// There is no such variable, or no element starts from the values set so far.
    pub fn get_float(&mut self, reference: u32) -> Result<f64, Error> {
        let role = self.find(reference, Type::Float)?.role;
        let entries = &self.description.entries;
        let room = |list: &[QuantityEntry]| vec![0.0; list.len()];
        let value = match role {
            VariableRole::Time => Some(self.time),
            VariableRole::Input(i) => self.values.inputs.get(i).copied(),
            VariableRole::Parameter(i) => self.values.parameters.get(i).copied(),
            VariableRole::State(i) => self.fresh()?.states().get(i).copied(),
            VariableRole::Output(i) => {
                if self.outputs.is_none() {
                    let mut outputs = room(&entries.outputs);
                    self.fresh()?.outputs(&mut outputs)?;
                    self.outputs = Some(outputs);
                }
                self.outputs.as_ref().and_then(|outputs| outputs.get(i).copied())
            }
            VariableRole::Column(i) => {
                if self.columns.is_none() {
                    let mut columns = room(&entries.columns);
                    self.fresh()?.columns(&mut columns);
                    self.columns = Some(columns);
                }
                self.columns.as_ref().and_then(|columns| columns.get(i).copied())
            }
            VariableRole::Rate(i) => {
                let mut rates = room(&entries.states);
                self.fresh()?.rates(&mut rates)?;
                rates.get(i).copied()
            }
            VariableRole::Indicator(i) => {
                let mut indicators = room(&entries.indicators);
                self.fresh()?.indicators(&mut indicators);
                indicators.get(i).copied()
            }
            VariableRole::Option(_) | VariableRole::ContactState(_) => None,
        };
        value.ok_or_else(|| Error::new(format!("the variable {reference} has no value")))
    }

    /// Returns the value of an integer variable.
    ///
    /// # Errors
    /// There is no such variable, or no element starts from the values set so far.
    pub fn get_integer(&mut self, reference: u32) -> Result<i32, Error> {
        match self.find(reference, Type::Integer)?.role {
            VariableRole::ContactState(i) => {
                let mode = self.fresh()?.modes().get(i).copied();
                Ok(i32::from(mode.unwrap_or(0)))
            }
            VariableRole::Option(i) => Ok(self.values.options.get(i).copied().unwrap_or(0)),
            _ => Err(Error::new(format!("the variable {reference} has no value"))),
        }
    }

    /// Returns the value of a Boolean variable.
    ///
    /// # Errors
    /// There is no such variable.
    pub fn get_boolean(&mut self, reference: u32) -> Result<bool, Error> {
        match self.find(reference, Type::Boolean)?.role {
            VariableRole::Option(i) => Ok(self.values.options.get(i).copied().unwrap_or(0) != 0),
            _ => Err(Error::new(format!("the variable {reference} has no value"))),
        }
    }

    /// Checks whether a variable may be set now.
    fn check_settable(&self, variable: &Variable) -> Result<(), Error> {
        let refused = |why: &str| {
            Err(Error::new(format!(
                "`{}` (value reference {}) cannot be set: {why}",
                variable.name, variable.reference
            )))
        };
        if matches!(self.phase, Phase::Terminated | Phase::Failed) {
            return refused(&format!("the instance is in the state `{}`", self.phase.name()));
        }
        match (variable.causality, variable.variability) {
            (Causality::Input, _) => Ok(()),
            (Causality::Parameter, Variability::Fixed) if self.phase.is_before_start() => Ok(()),
            (Causality::Parameter, Variability::Fixed) => {
                refused("it is a fixed parameter, to be set before the initialization has ended")
            }
            (Causality::Parameter, _) if self.phase == Phase::Continuous => {
                refused("it is a tunable parameter, to be set in event mode")
            }
            (Causality::Parameter, _) => Ok(()),
            (causality, _) => refused(&format!("its causality is {}", causality.name())),
        }
    }

    /// Checks whether a real variable can be set to a value now, as far as that can be said without setting
    /// it.
    ///
    /// # Errors
    /// There is no such variable, it cannot be set now, or the value is not finite.
    pub fn may_set_float(&self, reference: u32, value: f64) -> Result<(), Error> {
        let variable = self.find(reference, Type::Float)?;
        self.check_settable(variable)?;
        if !value.is_finite() {
            return Err(Error::new(format!(
                "`{}` cannot be set to {value}: it must be finite",
                variable.name
            )));
        }
        Ok(())
    }

    /// Sets a real variable.
    ///
    /// # Errors
    /// There is no such variable, it cannot be set now, or the value is not finite.
    pub fn set_float(&mut self, reference: u32, value: f64) -> Result<(), Error> {
        self.may_set_float(reference, value)?;
        let role = self.find(reference, Type::Float)?.role;
        match role {
            VariableRole::Input(i) => {
                if let Some(input) = self.values.inputs.get_mut(i) {
                    *input = value;
                }
                if let Some(set) = self.values.set.get_mut(i) {
                    *set |= !self.phase.is_before_start();
                }
                self.stale = true;
                if self.phase.is_before_start() {
                    self.element = None;
                }
                if self.interface == Interface::ModelExchange || self.phase.is_before_start() {
                    self.changed();
                }
            }
            VariableRole::Parameter(i) => {
                let mut parameters = self.values.parameters.clone();
                if let Some(parameter) = parameters.get_mut(i) {
                    *parameter = value;
                }
                if self.phase.is_before_start() {
                    self.element = None;
                } else {
                    self.build()?.tune(&parameters)?;
                }
                self.values.parameters = parameters;
                self.changed();
            }
            _ => {}
        }
        Ok(())
    }

    fn may_set_option(&self, reference: u32, value: i32, wanted: Type) -> Result<(), Error> {
        let variable = self.find(reference, wanted)?;
        self.check_settable(variable)?;
        let value = f64::from(value);
        match variable.reach {
            Some([least, greatest]) if !(least..=greatest).contains(&value) => Err(Error::new(format!(
                "`{}` cannot be set to {value}: it goes from {least} to {greatest}",
                variable.name
            ))),
            _ => Ok(()),
        }
    }

    fn set_option(&mut self, reference: u32, value: i32, wanted: Type) -> Result<(), Error> {
        self.may_set_option(reference, value, wanted)?;
        if let VariableRole::Option(i) = self.find(reference, wanted)?.role {
            if let Some(option) = self.values.options.get_mut(i) {
                *option = value;
            }
            self.element = None;
            self.changed();
        }
        Ok(())
    }

    /// Checks whether an integer variable can be set to a value now.
    ///
    /// # Errors
    /// There is no such variable, it cannot be set now, or the value is outside its reach.
    pub fn may_set_integer(&self, reference: u32, value: i32) -> Result<(), Error> {
        self.may_set_option(reference, value, Type::Integer)
    }

    /// Checks whether a Boolean variable can be set now.
    ///
    /// # Errors
    /// There is no such variable, or it cannot be set now.
    pub fn may_set_boolean(&self, reference: u32, value: bool) -> Result<(), Error> {
        self.may_set_option(reference, i32::from(value), Type::Boolean)
    }

    /// Sets an integer variable.
    ///
    /// # Errors
    /// There is no such variable, it cannot be set now, or the value is outside its reach.
    pub fn set_integer(&mut self, reference: u32, value: i32) -> Result<(), Error> {
        self.set_option(reference, value, Type::Integer)
    }

    /// Sets a Boolean variable.
    ///
    /// # Errors
    /// There is no such variable, or it cannot be set now.
    pub fn set_boolean(&mut self, reference: u32, value: bool) -> Result<(), Error> {
        self.set_option(reference, i32::from(value), Type::Boolean)
    }

    /// Sets the derivative by time of an input for the next step.
    ///
    /// # Errors
    /// There is no such input, another order than 1, or a value that is not finite.
    pub fn set_input_derivative(&mut self, reference: u32, order: i32, value: f64) -> Result<(), Error> {
        let variable = self.find(reference, Type::Float)?;
        let VariableRole::Input(i) = variable.role else {
            return Err(Error::new(format!("`{}` is no input", variable.name)));
        };
        if order != 1 {
            return Err(Error::new(format!(
                "a derivative of order {order} of `{}`: only first derivatives are used",
                variable.name
            )));
        }
        if !value.is_finite() {
            return Err(Error::new(format!(
                "the derivative of `{}` is {value}; it must be finite",
                variable.name
            )));
        }
        self.require("input derivatives are set", &[Phase::Initialization, Phase::Step])?;
        if let Some(slope) = self.values.slopes.get_mut(i) {
            *slope = Some(value);
        }
        Ok(())
    }

    /// Writes the derivatives of unknowns (outputs and rates of states) along a direction of knowns (inputs
    /// and states).
    ///
    /// # Errors
    /// A variable is no unknown or known, lists of different lengths, or called too early.
    pub fn directional_derivative(
        &mut self,
        unknowns: &[u32],
        knowns: &[u32],
        seed: &[f64],
        out: &mut [f64],
    ) -> Result<(), Error> {
        self.require(
            "derivatives are asked for",
            &[
                Phase::Initialization,
                Phase::Event,
                Phase::Continuous,
                Phase::Step,
                Phase::Terminated,
            ],
        )?;
        if knowns.len() != seed.len() || unknowns.len() != out.len() {
            return Err(Error::new(format!(
                "{} knowns with {} seeds, {} unknowns with room for {}",
                knowns.len(),
                seed.len(),
                unknowns.len(),
                out.len()
            )));
        }
        let entries = &self.description.entries;
        let mut states = vec![0.0; entries.states.len()];
        let mut inputs = vec![0.0; entries.inputs.len()];
        for (reference, value) in knowns.iter().zip(seed) {
            let variable = self.find(*reference, Type::Float)?;
            let place = match variable.role {
                VariableRole::State(i) => states.get_mut(i),
                VariableRole::Input(i) => inputs.get_mut(i),
                _ => None,
            };
            match place {
                Some(place) => *place += value,
                None => {
                    return Err(Error::new(format!(
                        "`{}` is no known of the model structure: inputs and states are",
                        variable.name
                    )));
                }
            }
        }
        let slopes = self.fresh()?.jacobian_vector_product(&states, &inputs)?;
        for (reference, target) in unknowns.iter().zip(out) {
            let variable = self.find(*reference, Type::Float)?;
            let value = match variable.role {
                VariableRole::Output(i) => slopes.outputs.get(i),
                VariableRole::Rate(i) => slopes.rates.get(i),
                _ => None,
            };
            *target = *value.ok_or_else(|| {
                Error::new(format!(
                    "`{}` is no unknown of the model structure: outputs and rates of states are",
                    variable.name
                ))
            })?;
        }
        Ok(())
    }
}
