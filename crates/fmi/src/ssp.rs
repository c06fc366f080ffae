//! A truck with four wedges as a system structure (SSP 1.0): five components from two FMUs, their
//! connections, their parameters.
//!
//! | file | what it is |
//! |---|---|
//! | `SystemStructure.ssd` | components, connectors with units, connections |
//! | `resources/FrictionTruck.fmu` | the truck without wedges ([`crate::truck`]), FMI 2.0 |
//! | `resources/FrictionWedge.fmu` | the wedge of the case, for all four |
//! | `resources/parameters.ssv` | what may differ from wedge to wedge, and how the truck starts; SI |
//!
//! Every force acts twice, on bolster and side frame; every motion is that of the truck. Wedges on the
//! leading side are turned by 180° about z; the truck does that, so that connections need no signs.

use study::case::Case;

use crate::Error;
use crate::description::xml::{Attributes, Xml, number};
use crate::description::{Description, Version};
use crate::package::{self, Library, Platform};
use crate::source::Source;
use crate::truck::WEDGES;
use crate::unit::Unit;
use crate::variable::{Start, Variable, VariableRole};

/// The truck's name among the components.
const TRUCK: &str = "truck";
/// The file with the values of parameters.
const PARAMETERS: &str = "resources/parameters.ssv";
/// Parameters of each wedge that the file with values holds.
const OF_WEDGES: [&str; 3] = ["toe", "column_friction", "slope_friction"];
/// Velocity of the truck upwards at the start, m/s: about 8 mm of bounce.
const BOUNCE: f64 = 0.1;
/// Length of the default experiment, s.
const STOP_TIME: f64 = 1.0;

const COMMON: &str = "http://ssp-standard.org/SSP1/SystemStructureCommon";
const DESCRIPTION: &str = "http://ssp-standard.org/SSP1/SystemStructureDescription";
const VALUES: &str = "http://ssp-standard.org/SSP1/SystemStructureParameterValues";

/// A connection: component and connector where it starts, and where it ends.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Connection {
    /// The source of the value.
    pub from: (String, String),
    /// Its destination.
    pub to: (String, String),
}

/// Returns the truck with four wedges of a case, with the library for one platform, as the bytes of its file,
/// and the connections.
///
/// # Errors
/// As [`package::fmu`].
pub fn truck(
    case: &Case,
    library: &Library,
    platform: Platform,
) -> Result<(Vec<u8>, Vec<Connection>), Error> {
    let mut files = Vec::new();
    let mut fmu = |source: Source| -> Result<Description, Error> {
        let (bytes, description) = package::fmu(&source, Version::Two, library, platform)?;
        files.push((format!("resources/{}.fmu", description.model.name()), bytes));
        Ok(description)
    };
    let case = || Box::new(case.clone());
    let (truck, wedge) = (fmu(Source::Truck(case()))?, fmu(Source::Wedge(case()))?);
    let connections = connections(&truck, &wedge)?;
    files.insert(
        0,
        (
            "SystemStructure.ssd".to_owned(),
            structure(&truck, &wedge, &connections)?.into_bytes(),
        ),
    );
    files.push((PARAMETERS.to_owned(), values(&wedge)?.into_bytes()));
    Ok((package::pack(&files)?, connections))
}

fn find<'d>(description: &'d Description, name: &str) -> Option<&'d Variable> {
    description
        .variables
        .iter()
        .find(|variable| variable.name == name)
}

/// Motions to the wedges, forces back: what the truck has for a wedge under its name.
fn connections(truck: &Description, wedge: &Description) -> Result<Vec<Connection>, Error> {
    let mut connections = Vec::new();
    for variable in &truck.variables {
        let Some((name, own)) = WEDGES.iter().find_map(|name| {
            let own = variable.name.strip_prefix(name)?.strip_prefix('_')?;
            Some(((*name).to_owned(), own.to_owned()))
        }) else {
            continue;
        };
        let here = (TRUCK.to_owned(), variable.name.clone());
        let there = (name, own);
        let role = find(wedge, &there.1).map(|other| other.role);
        connections.push(match (variable.role, role) {
            (VariableRole::Output(_), Some(VariableRole::Input(_))) => Connection {
                from: here,
                to: there,
            },
            (VariableRole::Input(_), Some(VariableRole::Output(_))) => Connection {
                from: there,
                to: here,
            },
            _ => {
                return Err(Error::new(format!(
                    "the truck's {} has no counterpart in the wedge",
                    variable.name
                )));
            }
        });
    }
    Ok(connections)
}

fn units(xml: &mut Xml, parent: &str) -> Result<(), Error> {
    xml.element(parent, &[], |xml| {
        for unit in Unit::ALL {
            let Some(name) = unit.name() else { continue };
            xml.element("ssc:Unit", &[("name", name.to_owned())], |xml| {
                xml.empty("ssc:BaseUnit", &unit.base())
            })?;
        }
        Ok(())
    })
}

fn structure(truck: &Description, wedge: &Description, connections: &[Connection]) -> Result<String, Error> {
    let root = [
        ("xmlns:ssc", COMMON.to_owned()),
        ("xmlns:ssd", DESCRIPTION.to_owned()),
        ("version", "1.0".to_owned()),
        ("name", "truck with four friction wedges".to_owned()),
        (
            "generationTool",
            format!("wedgelab {}", env!("CARGO_PKG_VERSION")),
        ),
    ];
    let mut xml = Xml::new()?;
    xml.element("ssd:SystemStructureDescription", &root, |xml| {
        xml.element("ssd:System", &[("name", "four_wedge_truck".to_owned())], |xml| {
            xml.element("ssd:ParameterBindings", &[], |xml| {
                xml.empty("ssd:ParameterBinding", &[("source", PARAMETERS.to_owned())])
            })?;
            xml.element("ssd:Elements", &[], |xml| {
                component(xml, TRUCK, truck, connections)?;
                WEDGES
                    .iter()
                    .try_for_each(|name| component(xml, name, wedge, connections))
            })?;
            xml.element("ssd:Connections", &[], |xml| {
                connections.iter().try_for_each(|connection| {
                    let attributes = [
                        ("startElement", connection.from.0.clone()),
                        ("startConnector", connection.from.1.clone()),
                        ("endElement", connection.to.0.clone()),
                        ("endConnector", connection.to.1.clone()),
                    ];
                    xml.empty("ssd:Connection", &attributes)
                })
            })
        })?;
        units(xml, "ssd:Units")?;
        let times = [("startTime", number(0.0)), ("stopTime", number(STOP_TIME))];
        xml.empty("ssd:DefaultExperiment", &times)
    })?;
    xml.finish()
}

/// Writes a component with the connectors that are connected.
fn component(
    xml: &mut Xml,
    name: &str,
    description: &Description,
    connections: &[Connection],
) -> Result<(), Error> {
    let attributes = [
        ("name", name.to_owned()),
        ("type", "application/x-fmu-sharedlibrary".to_owned()),
        ("source", format!("resources/{}.fmu", description.model.name())),
        ("implementation", "CoSimulation".to_owned()),
    ];
    xml.element("ssd:Component", &attributes, |xml| {
        xml.element("ssd:Connectors", &[], |xml| {
            for connection in connections {
                for (kind, (component, connector)) in
                    [("output", &connection.from), ("input", &connection.to)]
                {
                    if component != name {
                        continue;
                    }
                    let attributes = [("name", connector.clone()), ("kind", kind.to_owned())];
                    let unit = find(description, connector).and_then(|variable| variable.unit?.name());
                    xml.element("ssd:Connector", &attributes, |xml| {
                        xml.empty("ssc:Real", &in_unit(unit))
                    })?;
                }
            }
            Ok(())
        })
    })
}

fn in_unit(unit: Option<&'static str>) -> Attributes<'static> {
    unit.map(|unit| ("unit", unit.to_owned())).into_iter().collect()
}

fn values(wedge: &Description) -> Result<String, Error> {
    let root = [
        ("xmlns:ssc", COMMON.to_owned()),
        ("xmlns:ssv", VALUES.to_owned()),
        ("version", "1.0".to_owned()),
        ("name", "parameters of truck and wedges".to_owned()),
    ];
    let mut xml = Xml::new()?;
    xml.element("ssv:ParameterSet", &root, |xml| {
        xml.element("ssv:Parameters", &[], |xml| {
            let mut put = |name: String, value: f64, unit: Option<&'static str>| {
                xml.element("ssv:Parameter", &[("name", name)], |xml| {
                    let mut attributes = vec![("value", number(value))];
                    attributes.extend(in_unit(unit));
                    xml.empty("ssv:Real", &attributes)
                })
            };
            put(format!("{TRUCK}.body_z_rate_start"), BOUNCE, Some("m/s"))?;
            for name in WEDGES {
                for parameter in OF_WEDGES {
                    let Some(variable) = find(wedge, parameter) else {
                        continue;
                    };
                    if let Start::Float(Some(value)) = variable.start {
                        put(
                            format!("{name}.{parameter}"),
                            value,
                            variable.unit.and_then(Unit::name),
                        )?;
                    }
                }
            }
            Ok(())
        })?;
        units(xml, "ssv:Units")
    })?;
    xml.finish()
}
