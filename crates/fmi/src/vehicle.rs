//! A vehicle of bodies and elements, as data of [`crate::system`]: a case with `model = "vehicle"`.
//!
//! Without a track, bodies that are prescribed move as the inputs say, or as the case says; bodies that are
//! free are loaded by inputs. On a track, which is inside with its drive, inputs move what each rail lies on
//! under each wheel and load the bodies. Outputs are the columns of its results.

use mechanics::output::Column;
use study::run::RunCase;
use study::vehicle::VehicleCase;
use vehicle::{Vehicle, View};

use crate::Error;
use crate::element::{Entries, Setting};
use crate::source::{Made, Model};
use crate::system::{
    DerailmentWatch, Inputs, Plant, Ports, accumulators, all_states, contacts, internals, is_driven, ledger,
    motions_along_axes, options, release,
};

/// A vehicle of bodies and elements.
pub(crate) struct VehicleModel;

impl Model for VehicleModel {
    type Origin = VehicleCase;

    const NAME: &'static str = "Vehicle";
    const TEXT: &'static str = "Vehicle of rigid bodies and force elements that its case names, on its track \
                                if it has wheelsets";
    const CONVENTIONS: &'static str = "Fixed axes: x forward, y left, z up; displacements of centers of \
                                       gravity from the nominal layout. Angles turn by R = Ry(pitch) Rz(yaw) \
                                       Rx(roll). Forces of elements act on the body with end a; pushes are \
                                       positive. On a track the fixed axes are those of its beginning; \
                                       outputs of bodies and wheelsets are against the track, states are \
                                       not. Vertical wheel forces act on the rail, positive down; lateral \
                                       ones are positive where they spread the gauge. Inputs that are \
                                       moments act about the axes of angles, which turn with the body's \
                                       heading.";

    fn made(case: &VehicleCase, setting: Option<&Setting>) -> Result<Made, Error> {
        plant(case, setting)?.made(setting)
    }
}

/// Returns the vehicle of a case under these settings. Without a track its prescribed bodies are driven if
/// there are none; on one inputs can move its rails, and its loads act whoever moves these.
///
/// # Errors
/// The case makes no vehicle.
pub fn plant(case: &VehicleCase, setting: Option<&Setting>) -> Result<Plant, Error> {
    let on_track = case.description.on_track.is_some();
    let vehicle = movable(case).vehicle().map_err(Error::of)?;
    let (entries, ports) = all(case, &vehicle);
    // The columns are those of the case, whoever moves its bodies: others know nothing more.
    let channels = vehicle.channels.clone();
    let driven = is_driven(setting);
    let vehicle = if driven && !on_track {
        drivable(case).vehicle().map_err(Error::of)?
    } else {
        vehicle
    };
    let (system, initial) = (vehicle.system.clone(), vehicle.initial_state.clone());
    let axles = vehicle.axles.clone();
    let derailed: DerailmentWatch =
        Box::new(move |seen| axles.iter().find_map(|axle| Some(axle.left_rail(seen)?.1)));
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
        derailed: on_track.then_some(derailed),
        rolls: on_track,
        initial: Some(initial),
        driven,
        ..Plant::new(system, entries, ports, case.options())
    })
}

/// Returns the same case with rails that can be moved, if it has any.
fn movable(case: &VehicleCase) -> VehicleCase {
    let mut case = case.clone();
    if let Some(on) = &mut case.description.on_track {
        on.movable_rails = true;
    }
    case
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
    for body in vehicle.axles.iter().filter_map(|axle| axle.beds).flatten() {
        inputs.add_rail_bed((body, &system.bodies()[body]));
    }
    let (modes, indicators) = contacts(system);
    let (moves, states) = if case.description.on_track.is_some() {
        // Columns of bodies are against the track, and have the plain names.
        let mut states = motions_along_axes(system, "fixed_");
        states.extend(internals(system));
        states.extend(accumulators(system));
        let moves = "who moves what rails lie on: 0 the inputs *_rail_bed_*, 1 nobody: they lie as the track \
                     says; the case's loads act in either case";
        (moves, states)
    } else {
        let moves =
            "who moves prescribed bodies: 0 the inputs *_motion, 1 the case, whose loads act too then";
        (moves, all_states(system))
    };
    let own = Entries {
        options: options(moves, (0, "without effect: a vehicle starts as its case says")),
        states,
        columns: ledger("work of prescribed bodies, of drives and of loads less stored energy and losses"),
        modes,
        indicators,
        ..Entries::default()
    };
    let columns: Vec<Column> = vehicle.columns().cloned().collect();
    inputs.finish(system, own, &columns, |_, _| true)
}
