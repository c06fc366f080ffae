//! `modelDescription.xml` of FMI 2.0.

use super::xml::{Attributes, Xml, list, number};
use super::{Description, Version};
use crate::variable::{Causality, Start, Variability, Variable, VariableRole};
use crate::{Category, Error};

pub(super) fn write(description: &Description) -> Result<String, Error> {
    let mut xml = Xml::new()?;
    let root = vec![
        ("fmiVersion", "2.0".to_owned()),
        ("modelName", description.model.name().to_owned()),
        ("guid", description.token(Version::Two)),
        ("description", description.text.clone()),
        ("version", env!("CARGO_PKG_VERSION").to_owned()),
        ("license", "MIT OR Apache-2.0".to_owned()),
        (
            "generationTool",
            format!("wedgelab {}", env!("CARGO_PKG_VERSION")),
        ),
        ("variableNamingConvention", "structured".to_owned()),
        (
            "numberOfEventIndicators",
            description.entries.indicators.len().to_string(),
        ),
    ];
    xml.element("fmiModelDescription", &root, |xml| {
        let yes = |name| (name, "true".to_owned());
        let common = || {
            vec![
                ("modelIdentifier", description.model.name().to_owned()),
                yes("canGetAndSetFMUstate"),
                yes("canSerializeFMUstate"),
                (
                    "providesDirectionalDerivative",
                    description.model.has_derivatives().to_string(),
                ),
            ]
        };
        xml.empty("ModelExchange", &common())?;
        let mut simulation = common();
        simulation.extend([
            yes("canHandleVariableCommunicationStepSize"),
            yes("canInterpolateInputs"),
        ]);
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
    xml.element("ScalarVariable", &attributes, |xml| {
        let mut typed: Attributes<'_> = Vec::new();
        let name = match variable.start {
            Start::Float(start) => {
                if let Some(unit) = variable.unit {
                    typed.extend(unit.name().map(|name| ("unit", name.to_owned())));
                    typed.extend(
                        unit.display()
                            .map(|display| ("displayUnit", display.name.to_owned())),
                    );
                }
                typed.extend(variable.nominal.map(|nominal| ("nominal", number(nominal))));
                typed.extend(start.map(|start| ("start", number(start))));
                if let VariableRole::Rate(state) = variable.role {
                    let index = description.reference(VariableRole::State(state)).map(index);
                    typed.extend(index.map(|index| ("derivative", index.to_string())));
                }
                "Real"
            }
            Start::Integer(start) => {
                if let Some([least, greatest]) = variable.reach {
                    typed.extend([("min", least.to_string()), ("max", greatest.to_string())]);
                }
                typed.extend(start.map(|start| ("start", start.to_string())));
                "Integer"
            }
            Start::Boolean(start) => {
                typed.push(("start", start.to_string()));
                "Boolean"
            }
        };
        xml.empty(name, &typed)
    })
}

/// FMI 2.0 counts variables from 1.
fn index(reference: u32) -> u32 {
    reference + 1
}

fn structure(xml: &mut Xml, description: &Description) -> Result<(), Error> {
    let unknown = |variable: &Variable| {
        let dependencies = list(description.dependencies(variable.role).into_iter().map(index));
        vec![
            ("index", index(variable.reference).to_string()),
            ("dependencies", dependencies),
        ]
    };
    let rates = || description.those(|role| matches!(role, VariableRole::Rate(_)));
    xml.element("Outputs", &[], |xml| {
        description
            .outputs()
            .try_for_each(|variable| xml.empty("Unknown", &unknown(variable)))
    })?;
    xml.element("Derivatives", &[], |xml| {
        rates().try_for_each(|variable| xml.empty("Unknown", &unknown(variable)))
    })?;
    xml.element("InitialUnknowns", &[], |xml| {
        // At the start everything depends on all inputs and parameters, which is what no list means.
        description
            .those(|role| {
                matches!(
                    role,
                    VariableRole::Output(_)
                        | VariableRole::ContactState(_)
                        | VariableRole::State(_)
                        | VariableRole::Rate(_)
                )
            })
            .filter(|variable| variable.variability != Variability::Fixed)
            .try_for_each(|variable| {
                xml.empty("Unknown", &[("index", index(variable.reference).to_string())])
            })
    })
}
