//! A three-piece truck with wedge bodies, as data of [`crate::system`]: a case with `model = "truck"`.
//!
//! Bolster, side frames and wheelsets that are prescribed move as the inputs say, or as the case says; bodies
//! that are free are loaded by inputs. Outputs are the fixed columns of its results: warp angle and moment,
//! loads of nests, forces and places of wedges.

use integrate::Options;
use mechanics::body::COORDINATES;
use mechanics::motion::Motion;
use mechanics::system::System;
use study::truck::TruckCase;
use study::truck::columns::TruckTable;
use wedge::parameters::Start as CaseStart;

use crate::Error;
use crate::element::{Entries, QuantityEntry, Setting};
use crate::system::{
    MOTION, Plant, Ports, START, StartState, SystemElement, accumulators, add_loads, add_motion, add_table,
    contacts, internals, ledger, motions, options,
};

/// Returns the truck of a case; its prescribed bodies move as the case says, or are `driven`.
///
/// # Errors
/// The case makes no truck, or it settles first.
pub fn plant(case: &TruckCase, driven: bool) -> Result<Plant, Error> {
    if case.settle > 0.0 {
        return Err(Error::new(
            "`start.settle` is more than 0 s: an FMU starts where its case starts; let the importer settle \
             it",
        ));
    }
    let moved = if driven { drivable(case) } else { case.clone() };
    let table = TruckTable::new(&moved).map_err(|error| Error::new(error.to_string()))?;
    let system = table.system().clone();
    let (entries, ports) = all(case, &system, &table);
    let start = system
        .clone()
        .observe(0.0, &system.initial_state())
        .energies
        .total();
    Ok(Plant {
        entries,
        ports,
        table: Some(Box::new(move |seen, _, row| {
            table.read(seen, start, row);
        })),
        numbers: [Vec::new(), Vec::new()],
        rolls: false,
        residual_of_stored: false,
        options: Options {
            relative_tolerance: case.simulation.relative_tolerance,
            ..Options::default()
        },
        initial: None,
        table_takes_rates: false,
        derailed: None,
        system,
    })
}

/// Returns the truck under these settings, at its start.
///
/// # Errors
/// As [`plant`]; or values that are not finite, no equilibrium, or the integrator refuses the start.
pub fn element(case: &TruckCase, setting: &Setting) -> Result<SystemElement, Error> {
    let option = |place: usize| setting.options.get(place).copied().unwrap_or(0);
    let start = match option(START) {
        0 => StartState::Initial,
        _ => StartState::Equilibrium,
    };
    let driven = option(MOTION) == 0;
    SystemElement::new(plant(case, driven)?, setting, start, driven)
}

/// Returns the same case with prescribed bodies that can be moved, since a system takes what is held for
/// fixed, and without loads of its own.
fn drivable(case: &TruckCase) -> TruckCase {
    let mut case = case.clone();
    let parameters = &mut case.parameters;
    let side_frames = parameters
        .side_frames
        .iter_mut()
        .map(|side_frame| &mut side_frame.motion);
    let wheelsets = parameters
        .wheelsets
        .iter_mut()
        .flat_map(|wheelsets| &mut wheelsets.motions);
    let bodies = std::iter::once(&mut parameters.bolster.motion)
        .chain(side_frames)
        .chain(wheelsets);
    for motion in bodies.flat_map(|body| &mut body.coordinates) {
        let [value, rate, _] = motion.evaluate(0.0, 0.0);
        *motion = Motion::line(0.0, [value, rate]);
    }
    let side_frames = parameters.side_frames.iter_mut().map(|own| &mut own.applied);
    let car_body = parameters.car_body.iter_mut().map(|car| &mut car.applied);
    let loads = std::iter::once(&mut parameters.bolster.applied)
        .chain(side_frames)
        .chain(car_body);
    loads.flatten().for_each(|load| *load = Motion::Constant(0.0));
    case
}

fn all(case: &TruckCase, system: &System, table: &TruckTable) -> (Entries, Ports) {
    let layout = system.layout();
    let (mut ports, mut inputs) = (Ports::default(), Vec::new());
    for (body, own) in system.bodies().iter().enumerate() {
        // Without adapters nothing stands on the wheelsets.
        let is_used = case.parameters.wheelsets.is_some() || !own.name.ends_with("wheelset");
        for coordinate in (0..6).filter(|_| own.is_prescribed() && is_used) {
            let name = format!("{}_{}_motion", own.name, COORDINATES[coordinate]);
            let text =
                "displacement of the prescribed body from its nominal place, or angle; read if motion = 0";
            add_motion((&mut inputs, &mut ports), (body, own), coordinate, (&name, text));
        }
    }
    for (body, own) in system.bodies().iter().enumerate() {
        if !own.name.ends_with("wedge") {
            let text = format!(
                "the {} from outside, at its center of gravity",
                own.name.replace('_', " ")
            );
            add_loads((&mut inputs, &mut ports), (body, own), (&own.name, &text));
        }
    }
    let equilibrium = case.parameters.start == CaseStart::Equilibrium;
    let (modes, indicators) = contacts(system);
    let mut entries = Entries {
        options: options(
            "who moves prescribed bodies: 0 the inputs bolster_*, left_side_frame_*, ..., 1 the case, whose \
             loads act too then",
            (
                i32::from(equilibrium),
                "the truck at the start: 0 at rest in the nominal layout, 1 at rest in static equilibrium \
                 without friction",
            ),
        ),
        inputs,
        outputs_of_states: false,
        accumulators: layout.quadratures + 1,
        kinematic: (0..layout.speeds).map(|q| (q, q + layout.speeds)).collect(),
        states: states(system),
        columns: ledger("work of the prescribed bodies and of the loads less stored energy and losses"),
        modes,
        indicators,
        ..Entries::default()
    };
    add_table((&mut entries, &mut ports), table.columns(), |number, _| {
        number < table.fixed()
    });
    (entries, ports)
}

fn states(system: &System) -> Vec<QuantityEntry> {
    let mut states = motions(system, |body| system.bodies()[body].name.clone());
    for state in &mut states {
        state.output = true;
    }
    states.extend(internals(system));
    states.extend(accumulators(system));
    states
}
