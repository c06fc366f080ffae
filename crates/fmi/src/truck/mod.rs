//! The half-truck without its wedges, as data of [`crate::system`]: with four FMUs of wedges it is the truck.
//!
//! Bodies, springs, bearing adapters and stops are those of the built-in system file of the constantly damped
//! half-truck ([`FILE`]), with small displacements ([`mechanics::connection`]); its friction wedges and the
//! springs that drive its bolster are left out. The forces of wedges are inputs; the motions of the points
//! where the wedges are, are outputs. These depend on states alone, so that truck and wedges make no
//! algebraic loop.
//!
//! Axes of wedges: a wedge has x from the column towards the bolster. Trailing wedges (columns behind the
//! bolster) have the axes of the truck; leading ones are turned by 180° about z: x, y, roll and pitch change
//! their signs, z and yaw do not. The points that the neighbours of a wedge turn about lie half the length of
//! the wedge apart, as in the wedge itself, around the point of the connection in the file.

mod entries;

use integrate::Options;
use mechanics::connection::Law;
use mechanics::system::System;
use nucars::read::read_system;
use nucars::truck::{Choices, Truck};
use study::case::Case;
use wedge::Parameters;

use crate::Error;
use crate::element::Setting;
use crate::source::{Made, Model};
use crate::system::{LoadPort, Plant, PortDirection, Ports, Reading, StartPort};

/// The file that the truck is made of.
pub const FILE: &str = "Bolst_wedge_sf_68_constant.sys";

/// Names of the wedges; the first is at the left of the leading side.
pub const WEDGES: [&str; 4] = ["leading_left", "leading_right", "trailing_left", "trailing_right"];
/// Numbers of their connections in the file.
const CONNECTIONS: [u32; 4] = [127, 128, 129, 130];
/// The body that carries the load, among the bodies of the system.
pub const BODY: usize = 1;

/// For each wedge the displacements of the points that bolster and side frame turn about.
type Points = [[[PortDirection; 6]; 2]; 4];

/// A half-truck without its wedges.
pub(crate) struct TruckModel;

impl Model for TruckModel {
    type Origin = Case;

    const NAME: &'static str = "FrictionTruck";
    const TEXT: &'static str = "Loaded half of a three-piece truck without its four friction wedges: half a \
                                car on a bolster, side frames, springs";
    const CONVENTIONS: &'static str = "Axes: x forward, y left, z up; displacements from the drawn position, \
                                       small angles. Quantities of a wedge are in the axes of that wedge, \
                                       which has x from the column towards the bolster.";

    fn made(case: &Case, setting: Option<&Setting>) -> Result<Made, Error> {
        plant(case)?.made(setting)
    }
}

/// Returns the truck that has room for the wedges of a case.
///
/// # Errors
/// Never, with the built-in file.
pub fn plant(case: &Case) -> Result<Plant, Error> {
    let (system, points) = system(&case.parameters)?;
    let options = Options {
        relative_tolerance: case.simulation.relative_tolerance,
        ..Options::default()
    };
    let entries = entries::entries(&system);
    Ok(Plant {
        residual_of_stored: true,
        ..Plant::new(system, entries, ports(&points), options)
    })
}

/// Returns the system, and the points where the wedges are.
fn system(wedge: &Parameters) -> Result<(System, Points), Error> {
    let failed = |error: &dyn std::fmt::Display| Error::new(format!("the file {FILE} of the truck: {error}"));
    let source = nucars::builtin::source(FILE).ok_or_else(|| failed(&"it is missing"))?;
    let file = read_system(&source).strict().map_err(|error| failed(&error))?;
    let truck = Truck::new(&file, None, &Choices::default()).map_err(|error| failed(&error))?;
    let half = 0.25 * wedge.bottom_length();
    let mut points = Vec::with_capacity(WEDGES.len());
    for number in CONNECTIONS {
        let connection = truck
            .connection(number)
            .and_then(|place| truck.model.connections.get(place))
            .ok_or_else(|| failed(&"a wedge is missing"))?;
        let (a, b) = (connection.a, connection.b);
        let center = |body: usize| truck.model.bodies[body].frame.origin;
        // The column lies on the other side of the wedge than the bolster.
        let turned = connection.point[0] > center(a)[0];
        points.push([(a, half), (b, -half)].map(|(body, ahead)| {
            let center = center(body);
            let mut lever: [f64; 3] = std::array::from_fn(|k| connection.point[k] - center[k]);
            lever[0] += if turned { -ahead } else { ahead };
            PortDirection::of_point(body, lever, turned)
        }));
    }
    let points = points.try_into().map_err(|_| failed(&"it has not four wedges"))?;
    let mut model = truck.model.clone();
    let inputs: Vec<usize> = (0..model.bodies.len())
        .filter(|body| {
            file.input_bodies
                .iter()
                .any(|input| *input.id == truck.bodies[*body])
        })
        .collect();
    model.connections.retain(|own| {
        !matches!(own.law, Law::Wedge(_)) && !inputs.contains(&own.a) && !inputs.contains(&own.b)
    });
    let system = System::new(model).map_err(|error| failed(&error))?;
    Ok((system, points))
}

/// For each wedge and neighbour, force and moment are inputs, displacements and their rates outputs; the last
/// six inputs are the load on the body.
fn ports(points: &Points) -> Ports {
    let wedges = || points.iter().flatten();
    let body: [PortDirection; 6] = std::array::from_fn(|k| PortDirection::coordinate(BODY, k));
    let starts = [false, true].into_iter().flat_map(|rate| {
        (0..6).map(move |coordinate| StartPort {
            body: BODY,
            coordinate,
            rate,
        })
    });
    Ports {
        loads: wedges()
            .flatten()
            .chain(&body)
            .enumerate()
            .map(|(input, direction)| LoadPort {
                input,
                direction: *direction,
            })
            .collect(),
        starts: starts.collect(),
        outputs: wedges()
            .flat_map(|six| {
                let rates = six.map(Reading::Rate);
                six.map(Reading::Displacement).into_iter().chain(rates)
            })
            .collect(),
        ..Ports::default()
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]

    use super::*;
    use crate::element::{Element, Interface};
    use crate::system::SystemElement;

    fn made() -> (System, Points) {
        let damping = wedge::parameters::Damping::Constant;
        system(&wedge::thesis::parameters(damping, 0.0, 0.0)).unwrap()
    }

    /// Numbers without pattern.
    fn number(k: usize) -> f64 {
        f64::from(((k * 7919 + 13) % 101) as u32) - 50.0
    }

    fn element_under(inputs: Vec<f64>) -> SystemElement {
        let case = study::case::builtin::case("cdrun_toe_0_psi_0").unwrap();
        let setting = Setting {
            interface: Interface::ModelExchange,
            parameters: vec![0.0; 12],
            options: Vec::new(),
            inputs,
            tolerance: None,
            start_time: 0.0,
        };
        SystemElement::new(plant(&case).unwrap(), &setting).unwrap()
    }

    #[test]
    fn energy_loads_at_wedges_do_the_work_of_their_points() {
        let loads: Vec<f64> = (0..54).map(|k| if k < 48 { number(k) } else { 0.0 }).collect();
        let mut element = element_under(loads.clone());
        let mut states = element.states().to_vec();
        let speeds = element.plant.system.layout().speeds;
        for k in 0..speeds {
            states[speeds + k] = number(k + 61);
        }
        element.set_states(0.0, &states).unwrap();
        let mut outputs = vec![0.0; element.plant.entries.outputs.len()];
        element.outputs(&mut outputs).unwrap();
        // For each wedge and neighbour six displacements, then six rates.
        let rates = outputs.chunks(12).flat_map(|own| &own[6..]);
        let of_points: f64 = loads.iter().zip(rates).map(|(load, rate)| load * rate).sum();
        let mut rates = vec![0.0; states.len()];
        element.rates(&mut rates).unwrap();
        let of_bodies = rates[states.len() - 1];
        assert!(
            (of_points - of_bodies).abs() < 1e-12 * of_points.abs() && of_points.abs() > 1.0,
            "{of_points} {of_bodies}"
        );
    }

    #[test]
    fn analytic_the_springs_carry_the_truck_where_it_is_drawn() {
        let (mut system, _) = made();
        let start = system.initial_state();
        let rest = system
            .equilibrium(0.0, &start, mechanics::system::StaticFriction::Without)
            .unwrap();
        let height = rest[system.position_of(BODY, 2).unwrap()];
        // 319.175 lb s²/in · 386.09 in/s² on springs of about 51,000 lb/in, preloaded by eight times
        // 15,403.78 lb.
        assert!(height.abs() < 0.5e-3, "{height} m");
    }

    #[test]
    fn limits_a_load_from_outside_moves_the_body_alone() {
        let mut loads = vec![0.0; 54];
        let mut element = element_under(loads.clone());
        let mut without = vec![0.0; element.states().len()];
        element.rates(&mut without).unwrap();
        loads[50] = 1000.0;
        element.set_inputs(&loads).unwrap();
        let mut with = vec![0.0; without.len()];
        element.rates(&mut with).unwrap();
        let system = &element.plant.system;
        let place = system.layout().speeds + system.position_of(BODY, 2).unwrap();
        // 319.175 lb s²/in in kg.
        let mass = 319.175 * 0.453_592_37 * 9.806_65 / 0.0254;
        assert!(((with[place] - without[place]) * mass / 1000.0 - 1.0).abs() < 1e-9);
        for k in (0..with.len()).filter(|k| *k != place) {
            assert_eq!(with[k].to_bits(), without[k].to_bits());
        }
    }
}
