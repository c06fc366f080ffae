//! The static table of a car: its weight, wheels, heights, coils and wedges at the start of its run.
//!
//! Irregularities and shifts of wheelsets and body at the start are no part of it: it is that of the same
//! start on straight perfect track, and without speed, which makes creep forces.

use car::{BuildError, Car, Parameters, Start, Statics};
use quantity::{Kind, System as Units};

use super::columns::CarTable;
use super::stability::straight;
use super::statistics::SIDES;
use crate::statics::StaticTable;
use crate::summary::SummaryValue;

/// Difference of weight and wheel loads, over the weight, of a car that is at rest.
const AT_REST: f64 = 0.01;

/// Returns the static table of a car with these parameters, whose table of results this is.
///
/// # Errors
/// The car on straight track cannot be made.
pub fn static_table(
    table: &CarTable,
    parameters: &Parameters,
    units: Units,
) -> Result<StaticTable, BuildError> {
    let own = at_rest(table.car(), parameters)?;
    let force = |value: f64| SummaryValue::new(value, Kind::Force, units);
    let mut found = StaticTable {
        weight_on_rail: Some(force(own.weight)),
        ..StaticTable::default()
    };
    // In the nominal layout wheels may not touch, or overlap with their rails.
    let on_wheels: f64 = own.wheels.as_flattened().iter().sum();
    found.disturbed = (on_wheels / own.weight - 1.0).abs() > AT_REST;
    let wheels = match found.disturbed {
        true => table.static_loads(),
        false => own.wheels,
    };
    for (axle, loads) in (1..).zip(wheels) {
        let sides = SIDES.into_iter().zip(loads);
        let named = sides.map(|(side, load)| (format!("axle_{axle}_{side}"), force(load)));
        found.wheels.extend(named);
    }
    let [front, rear] = own.couplers;
    let heights = [
        ("center_of_gravity", own.height),
        ("body_center_of_gravity", own.body_height),
        ("front_coupler", front),
        ("rear_coupler", rear),
    ];
    let length = |value: f64| SummaryValue::new(value, Kind::Length, units);
    let named = heights.map(|(name, height)| (name.to_owned(), length(height)));
    found.heights.extend(named);
    let trucks = own.trucks.iter().zip(table.wedges_at_start());
    for (prefix, (coils, wedges)) in ["truck_1_", "truck_2_"].iter().zip(trucks) {
        found.add_truck(prefix, coils, wedges, units);
    }
    Ok(found)
}

fn at_rest(car: &Car, parameters: &Parameters) -> Result<Statics, BuildError> {
    let start = &parameters.start;
    let aside = start.body_shift != 0.0 || start.wheelset_shifts != [0.0; 4];
    if !aside && parameters.track.irregularities.is_empty() {
        return Ok(still(car));
    }
    let mut own = straight(parameters);
    own.start = Start {
        kind: start.kind,
        ..own.start
    };
    Ok(still(&Car::new(&own)?))
}

fn still(car: &Car) -> Statics {
    let mut system = car.system.clone();
    let layout = system.layout();
    let mut still = car.initial_state.clone();
    still[layout.speeds..2 * layout.speeds].fill(0.0);
    car.statics(&system.observe(0.0, &still))
}
