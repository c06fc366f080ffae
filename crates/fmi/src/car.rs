//! A freight car on its track, as data of [`crate::system`]: a case with `model = "car"`.
//!
//! The track is inside, and the drive of the case holds the speed. Inputs move what each rail lies on under
//! each wheel, besides the track's own irregularities (a bridge, a rig), push the car body, and give the
//! forces of its couplers, beside those of the case: a program of a train closes the loop over places and
//! speeds of their pivots. Outputs are the fixed columns of its results: wheel forces, places of axles,
//! accelerations, nests, wedges and couplers.

use std::sync::Arc;

use study::car::CarCase;
use study::car::columns::CarTable;
use study::run::RunCase;

use crate::Error;
use quantity::Kind;

use crate::element::{Entries, QuantityEntry, Setting};
use crate::source::{Made, Model};
use crate::system::{
    Inputs, Plant, PortDirection, Ports, accumulators, contacts, internals, is_driven, ledger, load,
    motions_along_axes, options,
};

/// A freight car on its track.
pub(crate) struct CarModel;

impl Model for CarModel {
    type Origin = CarCase;

    const NAME: &'static str = "FreightCar";
    const TEXT: &'static str = "Freight car on its track: body and lading on two three-piece trucks with \
                                friction wedges, whose wheelsets roll on rails";
    const CONVENTIONS: &'static str = "Fixed axes: x forward and y left where the track starts, z up. \
                                       Vertical wheel forces act on the rail, positive down; lateral ones \
                                       are positive where they spread the gauge. Places of axles are those \
                                       against the track's center line, positive to the left. Forces of \
                                       couplers are positive in buff; their angles are positive where they \
                                       point to the left of the car.";

    fn made(case: &CarCase, setting: Option<&Setting>) -> Result<Made, Error> {
        plant(case, setting)?.made(setting)
    }
}

/// Returns the car of a case under these settings; inputs can move its rails.
///
/// # Errors
/// The case makes no car, or has wedges without mass or a body that twists.
pub fn plant(case: &CarCase, setting: Option<&Setting>) -> Result<Plant, Error> {
    let mut parameters = case.parameters.clone();
    if parameters.has_connections() {
        return Err(Error::new(
            "FMUs of cars have wedges with mass, and those of the case have none or an empirical warp \
             spring; take wedge bodies",
        ));
    }
    if parameters.torsion.is_some() {
        return Err(Error::new(
            "FMUs of cars have rigid bodies, whose loads are inputs at one center of gravity; leave \
             car.torsion_stiffness out",
        ));
    }
    parameters.movable_rails = true;
    parameters.couplers.are_inputs = true;
    let table = CarTable::new(&parameters).map_err(Error::of)?;
    let car = table.car();
    let (system, initial) = (car.system.clone(), car.initial_state.clone());
    let start = system.clone().observe(0.0, &initial).energies.total();
    let (entries, ports) = all(&table);
    let table = Arc::new(table);
    let watched = Arc::clone(&table);
    Ok(Plant {
        table: Some(Box::new(move |seen, rates, row| {
            table.read(seen, rates, start, row);
        })),
        table_takes_rates: true,
        derailed: Some(Box::new(move |seen| watched.derailed(seen))),
        rolls: true,
        initial: Some(initial),
        driven: is_driven(setting),
        ..Plant::new(system, entries, ports, case.options())
    })
}

fn all(table: &CarTable) -> (Entries, Ports) {
    let car = table.car();
    let system = &car.system;
    let mut inputs = Inputs::default();
    for body in car.numbers.beds.iter().flatten().flatten() {
        inputs.add_rail_bed((*body, &system.bodies()[*body]));
    }
    let body = car.numbers.body;
    for axis in 0..3 {
        let direction = PortDirection::along_axis((body, &system.bodies()[body]), axis);
        let text = "the car body with its lading from outside, at its center of gravity, fixed axes";
        inputs.add_load(direction, load("", "car_body", axis, text));
    }
    for (end, name) in ["leading", "trailing"].into_iter().enumerate() {
        let Some([along, aside]) = car.coupler_inputs(end) else {
            continue;
        };
        let text = format!(
            "force of the {name} coupler along its line, positive in buff (it pushes the car), added to that \
             of the case"
        );
        let entry = QuantityEntry::of(Kind::Force, format!("force_of_coupler_{name}"), text);
        inputs.add_factor(along, 1.0, entry.starting(0.0));
        let text = format!("force at the pivot of the {name} coupler on the car body, to its left");
        let entry = QuantityEntry::of(Kind::Force, format!("lateral_force_of_coupler_{name}"), text);
        // Marker A is pushed to the right by what points to the left.
        inputs.add_factor(aside, -1.0, entry.starting(0.0));
    }
    let mut states = motions_along_axes(system, "");
    states.extend(internals(system));
    states.extend(accumulators(system));
    let (modes, indicators) = contacts(system);
    let own = Entries {
        options: options(
            "who moves what rails lie on: 0 the inputs rail_bed_*, 1 nobody: they lie as the track says",
            (0, "without effect: a car starts as its case says"),
        ),
        states,
        columns: ledger("work of the drive, of moved rails and of loads less stored energy and losses"),
        modes,
        indicators,
        ..Entries::default()
    };
    inputs.finish(system, own, table.columns(), |number, _| number < table.fixed())
}
