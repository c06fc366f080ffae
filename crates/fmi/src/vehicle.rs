//! A vehicle of bodies and elements, as data of [`crate::system`]: a case with `model = "vehicle"`.
//!
//! Bodies that are prescribed move as the inputs say, or as the case says; bodies that are free are loaded by
//! inputs. Outputs are the columns of its results.

use mechanics::body::COORDINATES;
use mechanics::motion::Motion;
use mechanics::output::Column;
use mechanics::system::System;
use study::vehicle::VehicleCase;
use vehicle::{Vehicle, View};

use crate::Error;
use crate::element::{Entries, QuantityEntry, Setting};
use crate::system::{
    MOTION, Plant, Ports, StartState, SystemElement, accumulators, add_loads, add_motion, add_table,
    contacts, internals, ledger, motions, options,
};

/// Returns the vehicle of a case; its prescribed bodies move as the case says, or are `driven`.
///
/// # Errors
/// The case makes no vehicle, or one on a track.
pub fn plant(case: &VehicleCase, driven: bool) -> Result<Plant, Error> {
    if case.description.on_track.is_some() {
        return Err(Error::new(
            "FMUs are made of vehicles without a track; a car on a track is one with model = \"car\"",
        ));
    }
    let made = |case: &VehicleCase| case.vehicle().map_err(|error| Error::new(error.to_string()));
    let vehicle = made(case)?;
    let (entries, ports) = all(case, &vehicle);
    // The columns are those of the case, whoever moves its bodies: others know nothing more.
    let channels = vehicle.channels.clone();
    let vehicle = if driven { made(&drivable(case))? } else { vehicle };
    let (system, initial) = (vehicle.system.clone(), vehicle.initial_state.clone());
    Ok(Plant {
        entries,
        ports,
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
        derailed: None,
        numbers: [Vec::new(), Vec::new()],
        rolls: false,
        residual_of_stored: false,
        options: case.simulation.options(),
        initial: Some(initial),
        system,
    })
}

/// Returns the vehicle under these settings, at its start.
///
/// # Errors
/// As [`plant`]; or values that are not finite, or the integrator refuses the start.
pub fn element(case: &VehicleCase, setting: &Setting) -> Result<SystemElement, Error> {
    let driven = setting.options.get(MOTION).copied().unwrap_or(0) == 0;
    SystemElement::new(plant(case, driven)?, setting, StartState::Initial, driven)
}

/// Returns the same case with prescribed bodies that can be moved, and without loads of its own.
fn drivable(case: &VehicleCase) -> VehicleCase {
    let mut case = case.clone();
    for body in &mut case.description.bodies {
        for motion in &mut body.motion.coordinates {
            let [value, rate, _] = motion.evaluate(0.0, 0.0);
            *motion = Motion::line(0.0, [value, rate]);
        }
        body.applied.fill(Motion::Constant(0.0));
    }
    case
}

fn all(case: &VehicleCase, vehicle: &Vehicle) -> (Entries, Ports) {
    let system = &vehicle.system;
    let layout = system.layout();
    let (mut ports, mut inputs) = (Ports::default(), Vec::new());
    let bodies = case.description.bodies.len();
    for (body, own) in system.bodies().iter().enumerate().skip(1).take(bodies) {
        if own.is_prescribed() {
            for coordinate in 0..6 {
                let name = format!("{}_{}_motion", own.name, COORDINATES[coordinate]);
                let text = "displacement of the prescribed body from its nominal place, or angle; read if \
                            motion = 0";
                add_motion((&mut inputs, &mut ports), (body, own), coordinate, (&name, text));
            }
        } else {
            let text = format!("{} from outside, at its center of gravity", own.name);
            add_loads((&mut inputs, &mut ports), (body, own), (&own.name, &text));
        }
    }
    let (modes, indicators) = contacts(system);
    let mut entries = Entries {
        options: options(
            "who moves prescribed bodies: 0 the inputs *_motion, 1 the case, whose loads act too then",
            (0, "without effect: a vehicle starts as its case says"),
        ),
        inputs,
        outputs_of_states: false,
        accumulators: layout.quadratures + 1,
        kinematic: (0..layout.speeds).map(|q| (q, q + layout.speeds)).collect(),
        states: states(system),
        columns: ledger("work of prescribed bodies and of loads less stored energy and losses"),
        modes,
        indicators,
        ..Entries::default()
    };
    let columns: Vec<Column> = vehicle.columns().cloned().collect();
    add_table((&mut entries, &mut ports), &columns, |_, _| true);
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
