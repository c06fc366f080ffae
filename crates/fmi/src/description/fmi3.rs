//! `modelDescription.xml` of FMI 3.0.

use super::document::{self, Dialect, unknown_at_start};
use super::xml::{Xml, list};
use super::{Description, Version};
use crate::Error;
use crate::variable::{Variable, VariableRole};

pub(super) fn write(description: &Description) -> Result<String, Error> {
    let dialect = Dialect {
        version: Version::Three,
        number: "3.0",
        token: "instantiationToken",
        states: ["canGetAndSetFMUState", "canSerializeFMUState"],
        derivatives: "providesDirectionalDerivatives",
        simulation: &["canHandleVariableCommunicationStepSize"],
        types: ["Float64", "Int32", "Boolean"],
        index: |reference| reference,
        root: |_| Vec::new(),
        variable: |xml, element, attributes, typed| xml.empty(element, &[attributes, typed].concat()),
        structure,
    };
    document::write(description, &dialect)
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
    for variable in description.those(unknown_at_start) {
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
