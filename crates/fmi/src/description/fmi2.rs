//! `modelDescription.xml` of FMI 2.0.

use super::document::{self, Dialect, unknown_at_start};
use super::xml::{Xml, list};
use super::{Description, Version};
use crate::Error;
use crate::variable::{Variability, Variable, VariableRole};

pub(super) fn write(description: &Description) -> Result<String, Error> {
    let dialect = Dialect {
        version: Version::Two,
        number: "2.0",
        token: "guid",
        states: ["canGetAndSetFMUstate", "canSerializeFMUstate"],
        derivatives: "providesDirectionalDerivative",
        simulation: &["canHandleVariableCommunicationStepSize", "canInterpolateInputs"],
        types: ["Real", "Integer", "Boolean"],
        index,
        root: |description| {
            let count = description.entries.indicators.len();
            vec![("numberOfEventIndicators", count.to_string())]
        },
        variable: |xml, element, attributes, typed| {
            xml.element("ScalarVariable", &attributes, |xml| xml.empty(element, &typed))
        },
        structure,
    };
    document::write(description, &dialect)
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
    // The standard has no empty list.
    if rates().next().is_some() {
        xml.element("Derivatives", &[], |xml| {
            rates().try_for_each(|variable| xml.empty("Unknown", &unknown(variable)))
        })?;
    }
    xml.element("InitialUnknowns", &[], |xml| {
        description
            .those(unknown_at_start)
            .filter(|variable| variable.variability != Variability::Fixed)
            .try_for_each(|variable| {
                xml.empty("Unknown", &[("index", index(variable.reference).to_string())])
            })
    })
}
