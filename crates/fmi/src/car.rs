//! A freight car on its track, as data of [`crate::system`]: a case with `model = "car"`.
//!
//! The track is inside, and the drive of the case holds the speed. Inputs move what each rail lies on under
//! each wheel, besides the track's own irregularities (a bridge, a rig), and push the car body. Outputs are
//! the fixed columns of its results: wheel forces, places of axles, accelerations, nests and wedges.

use std::sync::Arc;

use mechanics::orientation::fixed;
use mechanics::system::System;
use mechanics::vector::Vector;
use study::car::CarCase;
use study::car::columns::CarTable;

use crate::Error;
use crate::element::{Entries, QuantityEntry, Setting};
use crate::system::{
    LoadPort, MOTION, Plant, PortDirection, Ports, StartState, SystemElement, accumulators, add_motion,
    add_table, contacts, internals, ledger, load, motions_along_axes, options,
};

/// Axes along which rails are moved and the body is pushed.
const AXES: usize = 3;

/// Returns the car of a case; inputs can move its rails.
///
/// # Errors
/// The case makes no car, or has wedges without mass.
pub fn plant(case: &CarCase) -> Result<Plant, Error> {
    let mut parameters = case.parameters.clone();
    if parameters.has_connections() {
        return Err(Error::new(
            "FMUs of cars have wedges with mass, and those of the case have none or an empirical warp \
             spring; take wedge bodies",
        ));
    }
    parameters.movable_rails = true;
    let table = CarTable::new(&parameters).map_err(|error| Error::new(error.to_string()))?;
    let car = table.car();
    let (system, initial) = (car.system.clone(), car.initial_state.clone());
    let start = system.clone().observe(0.0, &initial).energies.total();
    let (entries, ports) = all(&table);
    let table = Arc::new(table);
    let watched = Arc::clone(&table);
    Ok(Plant {
        entries,
        ports,
        table: Some(Box::new(move |seen, rates, row| {
            table.read(seen, rates, start, row);
        })),
        table_takes_rates: true,
        derailed: Some(Box::new(move |seen| watched.derailed(seen))),
        numbers: [Vec::new(), Vec::new()],
        rolls: true,
        residual_of_stored: false,
        options: case.simulation.options(),
        initial: Some(initial),
        system,
    })
}

/// Returns the car under these settings, at its start.
///
/// # Errors
/// As [`plant`]; or values that are not finite, or the integrator refuses the start.
pub fn element(case: &CarCase, setting: &Setting) -> Result<SystemElement, Error> {
    let driven = setting.options.get(MOTION).copied().unwrap_or(0) == 0;
    SystemElement::new(plant(case)?, setting, StartState::Initial, driven)
}

fn all(table: &CarTable) -> (Entries, Ports) {
    let car = table.car();
    let system = &car.system;
    let (mut ports, mut inputs) = (Ports::default(), Vec::new());
    for body in car.numbers.beds.iter().flatten().flatten() {
        let own = &system.bodies()[*body];
        for (coordinate, axis) in ["x", "y", "z"].into_iter().enumerate() {
            let name = format!("{}_{axis}_motion", own.name);
            let text = "displacement of what the rail lies on under this wheel, along the fixed axes, added \
                        to the track's irregularities; read if motion = 0";
            add_motion((&mut inputs, &mut ports), (*body, own), coordinate, (&name, text));
        }
    }
    let body = car.numbers.body;
    let frame = fixed(system.bodies()[body].frame.orientation);
    for axis in 0..AXES {
        let mut row = [0.0; 6];
        for (k, part) in row.iter_mut().take(AXES).enumerate() {
            let Vector(column) = frame.column(k);
            *part = column[axis];
        }
        ports.loads.push(LoadPort {
            input: inputs.len(),
            direction: PortDirection { body, row },
        });
        let text = "the car body with its lading from outside, at its center of gravity, fixed axes";
        inputs.push(load("", "car_body", axis, text));
    }
    let layout = system.layout();
    let (modes, indicators) = contacts(system);
    let mut entries = Entries {
        options: options(
            "who moves what rails lie on: 0 the inputs rail_bed_*, 1 nobody: they lie as the track says",
            (0, "without effect: a car starts as its case says"),
        ),
        inputs,
        outputs_of_states: false,
        accumulators: layout.quadratures + 1,
        kinematic: (0..layout.speeds).map(|q| (q, q + layout.speeds)).collect(),
        states: states(system),
        columns: ledger("work of the drive, of moved rails and of loads less stored energy and losses"),
        modes,
        indicators,
        ..Entries::default()
    };
    let fixed = table.fixed();
    add_table((&mut entries, &mut ports), table.columns(), |number, _| {
        number < fixed
    });
    (entries, ports)
}

fn states(system: &System) -> Vec<QuantityEntry> {
    let mut states = motions_along_axes(system);
    states.extend(internals(system));
    states.extend(accumulators(system));
    states
}
