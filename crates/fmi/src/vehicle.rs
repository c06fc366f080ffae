//! A vehicle of bodies and elements, as data of [`crate::system`]: a case with `model = "vehicle"`.
//!
//! Bodies that are prescribed move as the inputs say, or as the case says; bodies that are free are loaded by
//! inputs. Outputs are the columns of its results.

use mechanics::output::Column;
use study::vehicle::VehicleCase;
use vehicle::{Vehicle, View};

use crate::Error;
use crate::element::{Entries, Setting};
use crate::source::{Made, Model};
use crate::system::{Inputs, Plant, Ports, all_states, contacts, is_driven, ledger, options, release};

/// A vehicle of bodies and elements.
pub(crate) struct VehicleModel;

impl Model for VehicleModel {
    type Origin = VehicleCase;

    const NAME: &'static str = "Vehicle";
    const TEXT: &'static str = "Vehicle of rigid bodies and force elements that its case names";
    const CONVENTIONS: &'static str = "Fixed axes: x forward, y left, z up; displacements of centers of \
                                       gravity from the nominal layout. Angles turn by R = Ry(pitch) Rz(yaw) \
                                       Rx(roll). Forces of elements act on the body with end a; pushes are \
                                       positive.";

    fn made(case: &VehicleCase, setting: Option<&Setting>) -> Result<Made, Error> {
        plant(case, setting)?.made(setting)
    }
}

/// Returns the vehicle of a case under these settings; its prescribed bodies are driven if there are none.
///
/// # Errors
/// The case makes no vehicle, or one on a track.
pub fn plant(case: &VehicleCase, setting: Option<&Setting>) -> Result<Plant, Error> {
    if case.description.on_track.is_some() {
        return Err(Error::new(
            "FMUs are made of vehicles without a track; a car on a track is one with model = \"car\"",
        ));
    }
    let vehicle = case.vehicle().map_err(Error::of)?;
    let (entries, ports) = all(case, &vehicle);
    // The columns are those of the case, whoever moves its bodies: others know nothing more.
    let channels = vehicle.channels.clone();
    let driven = is_driven(setting);
    let vehicle = if driven {
        drivable(case).vehicle().map_err(Error::of)?
    } else {
        vehicle
    };
    let (system, initial) = (vehicle.system.clone(), vehicle.initial_state.clone());
    Ok(Plant {
        table: Some(Box::new(move |seen, rates, row| {
            let view = View {
                seen,
                rates,
                system: &vehicle.system,
            };
            for channels in &channels {
                channels.read(&view, row);
            }
        })),
        table_takes_rates: true,
        initial: Some(initial),
        driven,
        ..Plant::new(system, entries, ports, case.simulation.options())
    })
}

/// Returns the same case with prescribed bodies that can be moved, and without loads of its own.
fn drivable(case: &VehicleCase) -> VehicleCase {
    let mut case = case.clone();
    for body in &mut case.description.bodies {
        release(&mut body.motion.coordinates, &mut body.applied);
    }
    case
}

fn all(case: &VehicleCase, vehicle: &Vehicle) -> (Entries, Ports) {
    let system = &vehicle.system;
    let mut inputs = Inputs::default();
    let bodies = case.description.bodies.len();
    for (body, own) in system.bodies().iter().enumerate().skip(1).take(bodies) {
        if own.is_prescribed() {
            inputs.add_motions((body, own));
        } else {
            inputs.add_loads((body, own), &own.name, &own.name);
        }
    }
    let (modes, indicators) = contacts(system);
    let own = Entries {
        options: options(
            "who moves prescribed bodies: 0 the inputs *_motion, 1 the case, whose loads act too then",
            (0, "without effect: a vehicle starts as its case says"),
        ),
        states: all_states(system),
        columns: ledger("work of prescribed bodies and of loads less stored energy and losses"),
        modes,
        indicators,
        ..Entries::default()
    };
    let columns: Vec<Column> = vehicle.columns().cloned().collect();
    inputs.finish(system, own, &columns, |_, _| true)
}
