//! Small models for tests.

use integrate::{Integrator, Method, Options as Settings, Problem};
use mechanics::body::Body;
use mechanics::connection::{Connection, Law, Options, SpringDamper, Wedge, WedgeState};
use mechanics::motion::Motion;
use mechanics::system::{Model, Observation, System};

use crate::half_truck::{ALL, vertical};

pub fn connection(a: usize, b: usize, point: [f64; 3], law: Law) -> Connection {
    Connection {
        account: String::new(),
        name: "connection".to_owned(),
        a,
        b,
        point,
        markers: None,
        law,
    }
}

pub fn model(bodies: Vec<Body>, connections: Vec<Connection>) -> Model {
    Model {
        bodies,
        connections,
        ..Model::default()
    }
}

/// Returns a spring on one coordinate.
pub fn one(coordinate: usize, law: SpringDamper) -> Law {
    Law::Springs(vec![(coordinate, law)])
}

/// Returns one law between a free unit body (A) and the ground (B), at the body's center.
pub fn against_ground(law: Law, options: Options) -> System {
    let body = Body::linearized("body", [0.0; 3], ALL, 1.0, [1.0; 3]);
    let mut model = model(vec![body, Body::ground()], vec![connection(0, 1, [0.0; 3], law)]);
    model.options = options;
    System::new(model).unwrap()
}

/// Returns the forces of a law at displacements and velocities of its body A (x, y, z).
pub fn at(system: &mut System, position: [f64; 3], velocity: [f64; 3]) -> Observation {
    at_deflection(system, position, velocity, [0.0; 2])
}

pub fn at_deflection(
    system: &mut System,
    position: [f64; 3],
    velocity: [f64; 3],
    deflection: [f64; 2],
) -> Observation {
    let mut x = system.initial_state();
    x[..3].copy_from_slice(&position);
    x[6..9].copy_from_slice(&velocity);
    if let Some(at) = system.deflection_of(0) {
        x[at..at + 2].copy_from_slice(&deflection);
    }
    system.observe(0.0, &x)
}

/// Internal forces of a wedge at an extension and its rate.
pub fn wedge_at(wedge: &Wedge, options: &Options, z: f64, velocity: f64) -> WedgeState {
    let mut system = against_ground(Law::Wedge(wedge.clone()), options.clone());
    at(&mut system, [0.0, 0.0, z], [0.0, 0.0, velocity]).connections[0]
        .wedge
        .unwrap()
}

/// Returns a law between a body that is moved up and down (A) and one so heavy that it stays (B).
pub fn prescribed(law: Law, motion: Motion) -> System {
    let mover = Body::linearized_prescribed("mover", [0.0; 3], vertical(motion));
    let heavy = Body::linearized(
        "heavy",
        [0.0; 3],
        [true, true, true, false, false, false],
        1e15,
        [1.0; 3],
    );
    System::new(model(vec![mover, heavy], vec![connection(0, 1, [0.0; 3], law)])).unwrap()
}

/// Integrates to `end`.
pub fn run(system: &System, method: Method, tolerance: f64, x: &[f64], end: f64) -> Integrator<System> {
    let settings = Settings {
        method,
        relative_tolerance: tolerance,
        ..Settings::default()
    };
    let mut integrator = Integrator::new(system.clone(), settings, 0.0, x).unwrap();
    while integrator.time() < end {
        integrator.step_to(end).unwrap();
    }
    integrator
}

/// Returns the observation at the end of a run.
pub fn observation(integrator: &Integrator<System>) -> Observation {
    let mut twin = integrator.problem().clone();
    twin.observe(integrator.time(), integrator.x())
}

/// Returns the right-hand side.
pub fn rates(system: &mut System, time: f64, x: &[f64]) -> Vec<f64> {
    let mut dx = vec![0.0; x.len()];
    system.derivative(time, x, &mut dx);
    dx
}
