//! Bad input to driven wedges.

use study::stepping::{CoilInput, Neighbours, SteppedState, SteppedWedge, SteppingError};

use crate::common::{YAWED, case};

fn wedge() -> SteppedWedge {
    SteppedWedge::new(&case(YAWED, &[])).unwrap()
}

#[test]
fn steps_must_be_positive_and_finite() {
    let mut wedge = wedge();
    let at = *wedge.neighbours();
    for step in [0.0, -1e-3, f64::NAN, f64::INFINITY, 1e-320] {
        let error = wedge.step(&at, step).unwrap_err();
        assert!(matches!(error, SteppingError::NoStep { .. }), "{step}: {error}");
        assert!(error.to_string().contains("must be positive"), "{error}");
    }
    wedge.step(&at, 1.0).unwrap();
    assert!(matches!(
        wedge.step(&at, 1e-300).unwrap_err(),
        SteppingError::NoStep { .. }
    ));
    wedge.step(&at, 1e-3).unwrap();
}

#[test]
fn values_that_are_not_finite_are_named() {
    let mut wedge = wedge();
    let mut at = *wedge.neighbours();
    at.bolster.position[5] = f64::NAN;
    let error = wedge.step(&at, 1e-3).unwrap_err().to_string();
    assert!(error.contains("yaw of the bolster is NaN"), "{error}");
    let mut at = *wedge.neighbours();
    at.side_frame.rate[2] = f64::INFINITY;
    let error = wedge.step(&at, 1e-3).unwrap_err().to_string();
    assert!(error.contains("rate of z of the side frame is inf"), "{error}");
    let error = wedge
        .set_coil(CoilInput::Stiffness(-1.0))
        .unwrap_err()
        .to_string();
    assert!(error.contains("stiffness is -1"), "{error}");
    let error = wedge
        .set_coil(CoilInput::Force(f64::NAN))
        .unwrap_err()
        .to_string();
    assert!(error.contains("force is NaN"), "{error}");
    let error = wedge.set_friction([0.4, -0.1]).unwrap_err().to_string();
    assert!(error.contains("friction.slope is -0.1"), "{error}");
    // Nothing has happened.
    assert_eq!(wedge.time(), 0.0);
    wedge
        .step(&Neighbours::of(&case(YAWED, &[]).parameters, 1e-3), 1e-3)
        .unwrap();
}

#[test]
fn a_wedge_that_cannot_go_on_says_so_until_it_is_restored() {
    let mut wedge = wedge();
    let state = wedge.state();
    let mut far = *wedge.neighbours();
    far.bolster.position[0] = -1e300;
    let error = wedge.step_to(&far, 1e-3).unwrap_err().to_string();
    assert!(error.contains("go back to a saved state"), "{error}");
    let at = *wedge.neighbours();
    assert!(matches!(
        wedge.step(&at, 1e-3).unwrap_err(),
        SteppingError::Failed
    ));
    wedge.restore(&state).unwrap();
    wedge.step(&at, 1e-3).unwrap();
}

#[test]
fn saved_states_of_others_are_refused() {
    let mut wedge = wedge();
    let bytes = wedge.state().to_bytes().unwrap();
    let text = String::from_utf8(bytes.clone()).unwrap();
    for (bad, what) in [
        (String::new(), "no saved state"),
        ("{}".to_owned(), "no saved state"),
        (text[..text.len() / 2].to_owned(), "no saved state"),
        (text.replacen("\"version\":2", "\"version\":7", 1), "version 7"),
        (text.replacen("\"x\":[", "\"x\":[0.0,", 1), ""),
    ] {
        let error = match SteppedState::from_bytes(bad.as_bytes()) {
            Ok(state) => wedge.restore(&state).unwrap_err(),
            Err(error) => error,
        };
        assert!(error.to_string().contains(what), "{error}");
    }
    let state = SteppedState::from_bytes(&bytes).unwrap();
    let mut other = SteppedWedge::new(&case(YAWED, &["contact.stiffness=\"3e5 lbf/in\""])).unwrap();
    assert!(matches!(
        other.restore(&state).unwrap_err(),
        SteppingError::OtherCase
    ));
    wedge.restore(&state).unwrap();
}

/// Kilometres for millimetres: no truck moves so far in one step.
#[test]
fn issue_048_neighbours_that_part_by_a_kilometre_are_refused() {
    let mut wedge = wedge();
    let start = *wedge.neighbours();
    let mut at = start;
    at.bolster.position[2] += 1000.0;
    let error = wedge.step(&at, 1.0).unwrap_err();
    assert!(matches!(error, SteppingError::TooFar { .. }), "{error}");
    for part in ["moves by 1000 m in z", "at most 1 m", "in several steps"] {
        assert!(error.to_string().contains(part), "{error}");
    }
    // Nothing has happened to the wedge; both together may go as far as they like.
    let mut both = start;
    both.bolster.position[0] += 30.0;
    both.side_frame.position[0] += 30.0;
    wedge.step(&both, 1.0).unwrap();
}
