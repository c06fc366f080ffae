//! Results settle as the tolerance falls.

use integrate::Method;
use mechanics::system::System;

use crate::half_truck;
use crate::models::{observation, run};

#[test]
fn the_half_truck_converges_with_the_tolerance() {
    let system = System::new(half_truck::model(true, true)).unwrap();
    let x = system.initial_state();
    let at = |tolerance: f64| {
        let done = run(&system, Method::Rodas5P, tolerance, &x, 0.4);
        let observation = observation(&done);
        let wedge = observation.connections.iter().find_map(|c| c.wedge).unwrap();
        [
            observation.bodies[0].coordinates[2],
            wedge.column_friction,
            observation.quadratures[0],
        ]
    };
    let reference = at(1e-10);
    let errors = [1e-3, 1e-5, 1e-7].map(|tolerance| {
        let now = at(tolerance);
        (0..3)
            .map(|k| ((now[k] - reference[k]) / reference[k]).abs())
            .fold(0.0, f64::max)
    });
    assert!(
        errors[1] < errors[0] && errors[2] < errors[1] && errors[2] < 0.02 * errors[0],
        "{errors:?}"
    );
    assert!(errors[1] < 1e-5 && errors[2] < 1e-7, "{errors:?}");
}

/// Two methods of different order agree.
#[test]
fn methods_agree() {
    let system = System::new(half_truck::model(false, false)).unwrap();
    let x = system.initial_state();
    let [a, b] = [(Method::Rodas5P, 1e-8), (Method::Esdirk3, 1e-11)].map(|(method, tolerance)| {
        let done = run(&system, method, tolerance, &x, 0.3);
        observation(&done).bodies[0].coordinates[2]
    });
    assert!((a - b).abs() < 1e-7 * a.abs(), "{a} {b}");
}
