//! Elements of the catalog against closed forms, and the energy ledger of all of them together.
#![allow(missing_docs, clippy::unwrap_used)]

mod analytic;
mod energy;
mod limits;

use std::sync::Arc;

use integrate::{Integrator, Options, Problem};
use mechanics::system::Observation;
use vehicle::catalog::{Attachment, CatalogElement, Element};
use vehicle::{Description, RigidBody, StartKind, Vehicle, View};

/// An element from body `a` to body `b` (0: ground), with the places of its ends.
pub fn element(
    name: &str,
    law: impl CatalogElement + 'static,
    (a, at): (usize, [f64; 3]),
    (b, to): (usize, [f64; 3]),
) -> Element {
    Element {
        name: name.to_owned(),
        ends: [Attachment { body: a, at }, Attachment { body: b, at: to }],
        law: Arc::new(law),
    }
}

/// A body that is free along these coordinates.
pub fn body(name: &str, mass: f64, inertia: f64, place: [f64; 3], free: &[usize]) -> RigidBody {
    let mut own = RigidBody::new(name, mass, [inertia; 3], place);
    own.free = std::array::from_fn(|k| free.contains(&k));
    own
}

pub fn vehicle(bodies: Vec<RigidBody>, elements: Vec<Element>, gravity: f64, start: StartKind) -> Vehicle {
    Vehicle::new(&Description {
        bodies,
        elements,
        gravity,
        start,
        ..Description::default()
    })
    .unwrap()
}

/// The value of a channel at a state.
pub fn value(vehicle: &mut Vehicle, name: &str, time: f64, x: &[f64]) -> f64 {
    let seen = vehicle.system.observe(time, x);
    let mut rates = vec![0.0; x.len()];
    vehicle.system.derivative(time, x, &mut rates);
    let view = View {
        seen: &seen,
        rates: &rates,
        system: &vehicle.system,
    };
    let mut row = Vec::new();
    for channels in &vehicle.channels {
        channels.read(&view, &mut row);
    }
    let place = vehicle.columns().position(|own| own.name == name);
    row[place.unwrap_or_else(|| panic!("no channel {name}"))]
}

/// Integrates to these times; `see` gets the observation and the state at each.
pub fn run(vehicle: &Vehicle, times: &[f64], tolerance: f64, mut see: impl FnMut(f64, &Observation, &[f64])) {
    let options = Options {
        relative_tolerance: tolerance,
        ..Options::default()
    };
    let mut system = vehicle.system.clone();
    let mut integrator =
        Integrator::new(vehicle.system.clone(), options, 0.0, &vehicle.initial_state).unwrap();
    for time in times {
        while integrator.time() < *time {
            integrator.step_to(*time).unwrap();
        }
        system.segment_like(integrator.problem());
        let x = integrator.x().to_vec();
        let seen = system.observe(*time, &x);
        see(*time, &seen, &x);
    }
}
