//! Elements that stand nowhere, and names that run into each other.

use vehicle::catalog::{AppliedForce, Bushing, Line};
use vehicle::{Description, StartKind, Vehicle, VehicleError};

use crate::{body, element};

fn fails(description: &Description) -> String {
    Vehicle::new(description).map(|_| ()).unwrap_err().to_string()
}

#[test]
fn limits_a_line_needs_two_places() {
    let description = Description {
        bodies: vec![body("block", 1.0, 1.0, [0.0; 3], &[2])],
        elements: vec![element(
            "spring",
            Line::linear(0.0, 1.0, 0.0),
            (1, [0.0; 3]),
            (0, [0.0; 3]),
        )],
        ..Description::default()
    };
    assert!(fails(&description).contains("spring: its ends are at one place"));
}

#[test]
fn limits_a_force_on_a_prescribed_body_is_refused() {
    let force = AppliedForce {
        direction: [0.0, 0.0, 1.0],
        course: mechanics::motion::Motion::Constant(1.0),
    };
    let description = Description {
        bodies: vec![
            body("table", 1.0, 1.0, [0.0; 3], &[]),
            body("block", 1.0, 1.0, [0.0; 3], &[2]),
        ],
        elements: vec![element("force", force, (1, [0.0; 3]), (0, [0.0; 3]))],
        ..Description::default()
    };
    assert!(fails(&description).contains("table has a prescribed motion"));
}

#[test]
fn limits_names_that_run_into_each_other_are_told() {
    let bushing = || Bushing {
        stiffness: [1.0; 3],
        ..Bushing::default()
    };
    let description = Description {
        bodies: vec![body("block", 1.0, 1.0, [0.0; 3], &[2])],
        elements: vec![
            element("a", bushing(), (1, [0.0; 3]), (0, [0.0; 3])),
            element("a", bushing(), (1, [0.0; 3]), (0, [0.0; 3])),
        ],
        ..Description::default()
    };
    let error = Vehicle::new(&description).map(|_| ()).unwrap_err();
    assert!(matches!(error, VehicleError::SameColumn { name } if name == "a_force_x"));
}

/// A body that nothing holds falls: there is no rest.
#[test]
fn limits_a_body_that_falls_has_no_rest() {
    let mut description = Description {
        bodies: vec![body("block", 1.0, 1.0, [0.0; 3], &[2])],
        start: StartKind::Equilibrium,
        ..Description::default()
    };
    assert!(matches!(
        Vehicle::new(&description).map(|_| ()).unwrap_err(),
        VehicleError::Equilibrium(_)
    ));
    description.start = StartKind::Nominal;
    assert!(Vehicle::new(&description).is_ok());
}
