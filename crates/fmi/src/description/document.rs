//! `modelDescription.xml`: what both versions of the standard have in common.

use super::xml::{Attributes, Xml, number};
use super::{Description, Version};
use crate::variable::{Causality, Start, Variable, VariableRole};
use crate::{Category, Error};

/// What a version calls things.
pub(super) struct Dialect {
    pub version: Version,
    pub number: &'static str,
    /// The attribute of the token by which library and description recognize each other.
    pub token: &'static str,
    /// The attributes that say that states can be saved, and written as bytes.
    pub states: [&'static str; 2],
    pub derivatives: &'static str,
    /// Further abilities in co-simulation.
    pub simulation: &'static [&'static str],
    /// The elements of real, whole and Boolean variables.
    pub types: [&'static str; 3],
    /// The number by which a variable names another one, from its reference.
    pub index: fn(u32) -> u32,
    /// Further attributes of the root.
    pub root: fn(&Description) -> Attributes<'static>,
    /// Writes a variable of an element, with its attributes and those of its type.
    pub variable: fn(&mut Xml, &'static str, Attributes<'_>, Attributes<'_>) -> Result<(), Error>,
    pub structure: fn(&mut Xml, &Description) -> Result<(), Error>,
}

/// Returns the description as this version writes it.
pub(super) fn write(description: &Description, own: &Dialect) -> Result<String, Error> {
    let mut xml = Xml::new()?;
    let program = env!("CARGO_PKG_VERSION");
    let mut root = vec![
        ("fmiVersion", own.number.to_owned()),
        ("modelName", description.model.name().to_owned()),
        (own.token, description.token(own.version)),
        ("description", description.text.clone()),
        ("version", program.to_owned()),
        ("license", "MIT OR Apache-2.0".to_owned()),
        ("generationTool", format!("wedgelab {program}")),
        ("variableNamingConvention", "structured".to_owned()),
    ];
    root.extend((own.root)(description));
    xml.element("fmiModelDescription", &root, |xml| {
        let yes = |name| (name, "true".to_owned());
        let [saved, serialized] = own.states.map(yes);
        let derivatives = (own.derivatives, description.model.has_derivatives().to_string());
        let name = ("modelIdentifier", description.model.name().to_owned());
        let mut abilities = vec![name, saved, serialized, derivatives];
        xml.empty("ModelExchange", &abilities)?;
        abilities.extend(own.simulation.iter().copied().map(yes));
        xml.empty("CoSimulation", &abilities)?;
        xml.units()?;
        xml.element("LogCategories", &[], |xml| {
            for category in Category::ALL {
                let attributes = vec![
                    ("name", category.name().to_owned()),
                    ("description", category.text().to_owned()),
                ];
                xml.empty("Category", &attributes)?;
            }
            Ok(())
        })?;
        let experiment = vec![
            ("startTime", number(0.0)),
            ("stopTime", number(description.stop_time)),
            ("tolerance", number(description.tolerance)),
            ("stepSize", number(description.step)),
        ];
        xml.empty("DefaultExperiment", &experiment)?;
        xml.element("ModelVariables", &[], |xml| {
            let mut variables = description.variables.iter();
            variables.try_for_each(|variable| write_variable(xml, description, own, variable))
        })?;
        xml.element("ModelStructure", &[], |xml| (own.structure)(xml, description))
    })?;
    xml.finish()
}

fn write_variable(
    xml: &mut Xml,
    description: &Description,
    own: &Dialect,
    variable: &Variable,
) -> Result<(), Error> {
    let mut attributes = vec![
        ("name", variable.name.clone()),
        ("valueReference", variable.reference.to_string()),
        ("description", variable.text.clone()),
        ("causality", variable.causality.name().to_owned()),
        ("variability", variable.variability.name().to_owned()),
    ];
    match variable.causality {
        Causality::Parameter => attributes.push(("initial", "exact".to_owned())),
        Causality::Output | Causality::Local => attributes.push(("initial", "calculated".to_owned())),
        Causality::Input | Causality::Independent => {}
    }
    let mut typed: Attributes<'_> = Vec::new();
    let [real, integer, boolean] = own.types;
    let element = match variable.start {
        Start::Float(start) => {
            if let Some(unit) = variable.unit {
                typed.extend(unit.name().map(|name| ("unit", name.to_owned())));
                let display = unit.display();
                typed.extend(display.map(|display| ("displayUnit", display.name.to_owned())));
            }
            typed.extend(variable.nominal.map(|nominal| ("nominal", number(nominal))));
            typed.extend(start.map(|start| ("start", number(start))));
            if let VariableRole::Rate(state) = variable.role {
                let index = description.reference(VariableRole::State(state)).map(own.index);
                typed.extend(index.map(|index| ("derivative", index.to_string())));
            }
            real
        }
        Start::Integer(start) => {
            if let Some([least, greatest]) = variable.reach {
                typed.extend([("min", least.to_string()), ("max", greatest.to_string())]);
            }
            typed.extend(start.map(|start| ("start", start.to_string())));
            integer
        }
        Start::Boolean(start) => {
            typed.push(("start", start.to_string()));
            boolean
        }
    };
    (own.variable)(xml, element, attributes, typed)
}

/// Returns whether a variable is unknown at the start. There everything depends on all inputs and parameters,
/// which is what no list of dependencies means.
pub(super) fn unknown_at_start(role: VariableRole) -> bool {
    matches!(
        role,
        VariableRole::Output(_)
            | VariableRole::ContactState(_)
            | VariableRole::State(_)
            | VariableRole::Rate(_)
    )
}
