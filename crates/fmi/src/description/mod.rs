//! The description that an importer reads: variables in their order, structure, identity; and as
//! `modelDescription.xml`.

mod document;
mod fmi2;
mod fmi3;
pub(crate) mod xml;

use sha2::{Digest, Sha256};

use crate::Error;
use crate::element::{Entries, QuantityEntry};
use crate::source::{FmuModel, Source};
use crate::unit::Unit;
use crate::variable::{Causality, Start, Variability, Variable, VariableRole};

/// The version of the standard.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Version {
    /// FMI 2.0.
    Two,
    /// FMI 3.0.
    Three,
}

/// Everything an importer can know of an FMU.
#[derive(Clone, Debug, PartialEq)]
pub struct Description {
    /// The element.
    pub model: FmuModel,
    /// The name of the case or run.
    pub case: String,
    /// The description, one line.
    pub text: String,
    /// The variables; each value reference is a place in this list.
    pub variables: Vec<Variable>,
    /// The quantities of the element.
    pub entries: Entries,
    /// Length of the default experiment, s.
    pub stop_time: f64,
    /// Its tolerance.
    pub tolerance: f64,
    /// Its step, s.
    pub step: f64,
    /// Names and bytes of the files that say what the element is made of, the case or run first.
    pub files: Vec<(String, Vec<u8>)>,
}

impl Description {
    /// Returns the description of what is made of a source.
    ///
    /// # Errors
    /// Nothing can be made of it.
    pub fn new(source: &Source) -> Result<Self, Error> {
        let entries = source.entries()?;
        let model = source.model();
        let [name, title] = source.name_and_title();
        let (first, rest) = model.origin().split_at(1);
        let kind = format!("{}{rest}", first.to_uppercase());
        let text = match title {
            "" => format!("{}. {kind}: {name}", model.text()),
            title => format!("{}. {kind}: {name}, {title}", model.text()),
        };
        let [stop_time, tolerance] = source.experiment();
        Ok(Self {
            model,
            case: name.to_owned(),
            text,
            variables: variables(&entries),
            entries,
            stop_time,
            tolerance,
            step: 1e-3,
            files: source.files()?,
        })
    }

    /// Returns the variable with a reference.
    #[must_use]
    pub fn variable(&self, reference: u32) -> Option<&Variable> {
        self.variables.get(reference as usize)
    }

    /// Returns the reference of the quantity that a variable shows.
    #[must_use]
    pub fn reference(&self, role: VariableRole) -> Option<u32> {
        self.variables
            .iter()
            .find(|variable| variable.role == role)
            .map(|variable| variable.reference)
    }

    /// Returns the token that ties the description to what the library computes: a hash of the case, of all
    /// variables, of the library's version and of the version of the standard, written as a GUID.
    #[must_use]
    pub fn token(&self, version: Version) -> String {
        let mut hash = Sha256::new();
        hash.update(env!("CARGO_PKG_VERSION"));
        hash.update(self.model.name());
        hash.update(match version {
            Version::Two => "2.0",
            Version::Three => "3.0",
        });
        for (_, bytes) in &self.files {
            hash.update(bytes);
        }
        for variable in &self.variables {
            hash.update(format!("{variable:?}"));
        }
        let hex: String = hash
            .finalize()
            .iter()
            .take(16)
            .map(|byte| format!("{byte:02x}"))
            .collect();
        let parts = [&hex[..8], &hex[8..12], &hex[12..16], &hex[16..20], &hex[20..]];
        format!("{{{}}}", parts.join("-"))
    }

    /// Returns the text of `modelDescription.xml`.
    ///
    /// # Errors
    /// The text cannot be written: a name or text holds what XML cannot.
    pub fn xml(&self, version: Version) -> Result<String, Error> {
        match version {
            Version::Two => fmi2::write(self),
            Version::Three => fmi3::write(self),
        }
    }

    /// On which variables an unknown depends; each list in the order of references.
    fn dependencies(&self, role: VariableRole) -> Vec<u32> {
        let entries = &self.entries;
        let states = entries.states.len() - entries.accumulators;
        let depends = |variable: &&Variable| match (role, variable.role) {
            // Work and losses are accumulated: nothing depends on them.
            (VariableRole::Output(_), VariableRole::State(state)) => state < states,
            (VariableRole::Output(_), VariableRole::Input(_)) => !entries.outputs_of_states,
            // A state that is an output.
            (VariableRole::State(output), VariableRole::State(state)) => output == state,
            (VariableRole::Rate(rate), other) => match entries.kinematic.iter().find(|(q, _)| *q == rate) {
                Some((_, speed)) => other == VariableRole::State(*speed),
                None => match other {
                    VariableRole::State(state) => state < states,
                    VariableRole::Input(_) => true,
                    _ => false,
                },
            },
            (VariableRole::Indicator(_), VariableRole::State(state)) => state < states,
            (VariableRole::Indicator(_), VariableRole::Input(_)) => true,
            _ => false,
        };
        self.variables
            .iter()
            .filter(depends)
            .map(|variable| variable.reference)
            .collect()
    }

    /// Outputs, in the order of references.
    fn outputs(&self) -> impl Iterator<Item = &Variable> {
        self.variables
            .iter()
            .filter(|variable| variable.causality == Causality::Output)
    }

    /// Variables with a role of a kind, in the order of references.
    fn those(&self, is: impl Fn(VariableRole) -> bool) -> impl Iterator<Item = &Variable> {
        self.variables.iter().filter(move |variable| is(variable.role))
    }
}

fn variables(entries: &Entries) -> Vec<Variable> {
    let mut variables = vec![Variable {
        reference: 0,
        name: "time".to_owned(),
        text: "time".to_owned(),
        role: VariableRole::Time,
        unit: Some(Unit::Of(quantity::Kind::Time)),
        causality: Causality::Independent,
        variability: Variability::Continuous,
        start: Start::Float(None),
        nominal: None,
        reach: None,
    }];
    let rates = entries.states.iter().map(|state| {
        let name = format!("der({})", state.name);
        let unit = state.unit.map(Unit::rate);
        QuantityEntry::real(name, unit, None, format!("rate of {}", state.name))
    });
    let rates: Vec<QuantityEntry> = rates.collect();
    type Role = fn(usize) -> VariableRole;
    use Causality::{Input, Local, Output, Parameter};
    use Variability::{Continuous, Discrete, Fixed};
    let lists: [(&[QuantityEntry], Role, Causality, Variability); 9] = [
        (&entries.inputs, VariableRole::Input, Input, Continuous),
        (&entries.outputs, VariableRole::Output, Output, Continuous),
        (&entries.modes, VariableRole::ContactState, Output, Discrete),
        (&entries.options, VariableRole::Option, Parameter, Fixed),
        (&entries.parameters, VariableRole::Parameter, Parameter, Fixed),
        (&entries.states, VariableRole::State, Local, Continuous),
        (&rates, VariableRole::Rate, Local, Continuous),
        (&entries.columns, VariableRole::Column, Local, Continuous),
        (&entries.indicators, VariableRole::Indicator, Local, Continuous),
    ];
    for (list, role, causality, variability) in lists {
        for (number, entry) in list.iter().enumerate() {
            variables.push(Variable {
                reference: variables.len() as u32,
                name: entry.name.clone(),
                text: entry.text.clone(),
                role: role(number),
                unit: entry.unit.filter(|unit| unit.name().is_some()),
                causality: if entry.output { Output } else { causality },
                variability: if entry.tunable {
                    Variability::Tunable
                } else {
                    variability
                },
                start: entry.start,
                nominal: entry.nominal,
                reach: entry.reach,
            });
        }
    }
    variables
}
