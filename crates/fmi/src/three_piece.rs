//! A three-piece truck with wedge bodies, as data of [`crate::system`]: a case with `model = "truck"`.
//!
//! Bolster, side frames and wheelsets that are prescribed move as the inputs say, or as the case says; bodies
//! that are free are loaded by inputs. Outputs are the fixed columns of its results: warp angle and moment,
//! loads of nests, forces and places of wedges.

use integrate::Options;
use mechanics::system::System;
use study::truck::TruckCase;
use study::truck::columns::TruckTable;
use wedge::parameters::Start as CaseStart;

use crate::Error;
use crate::element::{Entries, Setting};
use crate::source::{Made, Model};
use crate::system::{
    Inputs, Plant, Ports, StartState, all_states, contacts, is_driven, ledger, options, release,
};

/// A three-piece truck with wedge bodies.
pub(crate) struct ThreePieceTruckModel;

impl Model for ThreePieceTruckModel {
    type Origin = TruckCase;

    const NAME: &'static str = "ThreePieceTruck";
    const TEXT: &'static str = "Three-piece truck with four friction wedges that have mass: bolster, side \
                                frames, coils, stops, adapters";
    const CONVENTIONS: &'static str = "Axes: x forward, y left, z up from the top of rail, origin at the \
                                       truck's center; displacements of centers of gravity from the nominal \
                                       (loaded) layout. Angles turn by R = Ry(pitch) Rz(yaw) Rx(roll). The \
                                       warp moment acts on the bolster.";

    fn made(case: &TruckCase, setting: Option<&Setting>) -> Result<Made, Error> {
        plant(case, setting)?.made(setting)
    }
}

/// Returns the truck of a case under these settings; its prescribed bodies are driven if there are none.
///
/// # Errors
/// The case makes no truck, or it settles first.
pub fn plant(case: &TruckCase, setting: Option<&Setting>) -> Result<Plant, Error> {
    if case.settle > 0.0 {
        return Err(Error::new(
            "`start.settle` is more than 0 s: an FMU starts where its case starts; let the importer settle \
             it",
        ));
    }
    let driven = is_driven(setting);
    let moved = if driven { drivable(case) } else { case.clone() };
    let table = TruckTable::new(&moved).map_err(Error::of)?;
    let system = table.system().clone();
    let (entries, ports) = all(case, &system, &table);
    let start = system
        .clone()
        .observe(0.0, &system.initial_state())
        .energies
        .total();
    let options = Options {
        relative_tolerance: case.simulation.relative_tolerance,
        ..Options::default()
    };
    Ok(Plant {
        table: Some(Box::new(move |seen, _, row| {
            table.read(seen, start, row);
        })),
        start: StartState::asked(setting),
        driven,
        ..Plant::new(system, entries, ports, options)
    })
}

/// Returns the same case with prescribed bodies that can be moved, and without loads of its own.
fn drivable(case: &TruckCase) -> TruckCase {
    let mut case = case.clone();
    let parameters = &mut case.parameters;
    let bodies = std::iter::once((&mut parameters.bolster.motion, &mut parameters.bolster.applied));
    let side_frames = parameters.side_frames.iter_mut();
    for (motion, loads) in bodies.chain(side_frames.map(|own| (&mut own.motion, &mut own.applied))) {
        release(&mut motion.coordinates, loads);
    }
    let wheelsets = parameters.wheelsets.iter_mut().flat_map(|own| &mut own.motions);
    let car_body = parameters.car_body.iter_mut().flat_map(|car| &mut car.applied);
    release(wheelsets.flat_map(|motion| &mut motion.coordinates), car_body);
    case
}

fn all(case: &TruckCase, system: &System, table: &TruckTable) -> (Entries, Ports) {
    let mut inputs = Inputs::default();
    let bodies = || system.bodies().iter().enumerate();
    // Without adapters nothing stands on the wheelsets.
    let is_used = |name: &str| case.parameters.wheelsets.is_some() || !name.ends_with("wheelset");
    for body in bodies().filter(|(_, own)| own.is_prescribed() && is_used(&own.name)) {
        inputs.add_motions(body);
    }
    for (body, own) in bodies().filter(|(_, own)| !own.name.ends_with("wedge")) {
        let words = format!("the {}", own.name.replace('_', " "));
        inputs.add_loads((body, own), &own.name, &words);
    }
    let equilibrium = case.parameters.start == CaseStart::Equilibrium;
    let (modes, indicators) = contacts(system);
    let own = Entries {
        options: options(
            "who moves prescribed bodies: 0 the inputs bolster_*, left_side_frame_*, ..., 1 the case, whose \
             loads act too then",
            (
                i32::from(equilibrium),
                "the truck at the start: 0 at rest in the nominal layout, 1 at rest in static equilibrium \
                 without friction",
            ),
        ),
        states: all_states(system),
        columns: ledger("work of the prescribed bodies and of the loads less stored energy and losses"),
        modes,
        indicators,
        ..Entries::default()
    };
    inputs.finish(system, own, table.columns(), |number, _| number < table.fixed())
}
