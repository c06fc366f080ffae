//! `modelDescription.xml` of FMI 3.0.

use super::xml::{Attributes, Xml, list, number};
use super::{Description, Version};
use crate::variable::{Causality, Start, Variable, VariableRole};
use crate::{Category, Error};

pub(super) fn write(description: &Description) -> Result<String, Error> {
    let mut xml = Xml::new()?;
    let root = vec![
        ("fmiVersion", "3.0".to_owned()),
        ("modelName", description.model.name().to_owned()),
        ("instantiationToken", description.token(Version::Three)),
        ("description", description.text.clone()),
        ("version", env!("CARGO_PKG_VERSION").to_owned()),
        ("license", "MIT OR Apache-2.0".to_owned()),
        (
            "generationTool",
            format!("wedgelab {}", env!("CARGO_PKG_VERSION")),
        ),
        ("variableNamingConvention", "structured".to_owned()),
    ];
    xml.element("fmiModelDescription", &root, |xml| {
        let yes = |name| (name, "true".to_owned());
        let common = || {
            vec![
                ("modelIdentifier", description.model.name().to_owned()),
                yes("canGetAndSetFMUState"),
                yes("canSerializeFMUState"),
                (
                    "providesDirectionalDerivatives",
                    description.model.has_derivatives().to_string(),
                ),
            ]
        };
        xml.empty("ModelExchange", &common())?;
        let mut simulation = common();
        simulation.push(yes("canHandleVariableCommunicationStepSize"));
        xml.empty("CoSimulation", &simulation)?;
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
            for variable in &description.variables {
                write_variable(xml, description, variable)?;
            }
            Ok(())
        })?;
        xml.element("ModelStructure", &[], |xml| structure(xml, description))
    })?;
    xml.finish()
}

fn write_variable(xml: &mut Xml, description: &Description, variable: &Variable) -> Result<(), Error> {
    let mut attributes: Attributes<'_> = vec![
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
    let name = match variable.start {
        Start::Float(start) => {
            if let Some(unit) = variable.unit {
                attributes.extend(unit.name().map(|name| ("unit", name.to_owned())));
                attributes.extend(
                    unit.display()
                        .map(|display| ("displayUnit", display.name.to_owned())),
                );
            }
            attributes.extend(variable.nominal.map(|nominal| ("nominal", number(nominal))));
            attributes.extend(start.map(|start| ("start", number(start))));
            if let VariableRole::Rate(state) = variable.role {
                let reference = description.reference(VariableRole::State(state));
                attributes.extend(reference.map(|reference| ("derivative", reference.to_string())));
            }
            "Float64"
        }
        Start::Integer(start) => {
            if let Some([least, greatest]) = variable.reach {
                attributes.extend([("min", least.to_string()), ("max", greatest.to_string())]);
            }
            attributes.extend(start.map(|start| ("start", start.to_string())));
            "Int32"
        }
        Start::Boolean(start) => {
            attributes.push(("start", start.to_string()));
            "Boolean"
        }
    };
    xml.empty(name, &attributes)
}

fn structure(xml: &mut Xml, description: &Description) -> Result<(), Error> {
    let with_dependencies = |xml: &mut Xml, name: &str, variable: &Variable| {
        let dependencies = list(description.dependencies(variable.role).into_iter());
        let attributes = vec![
            ("valueReference", variable.reference.to_string()),
            ("dependencies", dependencies),
        ];
        xml.empty(name, &attributes)
    };
    for variable in description.outputs() {
        with_dependencies(xml, "Output", variable)?;
    }
    for variable in description.those(|role| matches!(role, VariableRole::Rate(_))) {
        with_dependencies(xml, "ContinuousStateDerivative", variable)?;
    }
    // At the start everything depends on all inputs and parameters, which is what no list means.
    for variable in description.those(|role| {
        matches!(
            role,
            VariableRole::Output(_)
                | VariableRole::ContactState(_)
                | VariableRole::State(_)
                | VariableRole::Rate(_)
        )
    }) {
        xml.empty(
            "InitialUnknown",
            &[("valueReference", variable.reference.to_string())],
        )?;
    }
    for variable in description.those(|role| matches!(role, VariableRole::Indicator(_))) {
        with_dependencies(xml, "EventIndicator", variable)?;
    }
    Ok(())
}
