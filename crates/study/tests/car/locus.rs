//! The root locus over a parameter.

use std::ops::ControlFlow;

use study::car::builtin;
use study::car::stability::stability;
use study::case::CaseError;
use study::locus::{Locus, LocusError, Vary, VaryError, locus};

const CAR: &str = "car_hunting_empty";
const SPEED: f64 = 30.0;

fn linear() -> Vec<String> {
    ["wheels.geometry=linear", "track.support.kind=rigid"]
        .map(str::to_owned)
        .to_vec()
}

fn read(set: &[String]) -> Result<study::car::CarCase, CaseError> {
    builtin::case_with(CAR, &[&linear(), set].concat())
}

fn over(text: &str, steps: u32) -> Result<Locus, LocusError> {
    let vary = Vary::parse(text, steps).unwrap();
    locus(&vary, SPEED, read, |_| ControlFlow::Continue(()))
}

/// A range has a key, two dots, two different ends of one unit.
#[test]
fn input_ranges_that_are_none_say_why() {
    let wrong = |text: &str| Vary::parse(text, 6).unwrap_err();
    for text in ["wheels.conicity", "=1..2", "wheels.conicity="] {
        assert_eq!(wrong(text), VaryError::NoKey(text.to_owned()));
    }
    assert!(matches!(wrong("a.b=0.1"), VaryError::NoRange { .. }));
    assert!(matches!(wrong("a.b=0.1..fast"), VaryError::NoNumber { end, .. } if end == "fast"));
    assert!(matches!(wrong("a.b=..0.3"), VaryError::NoNumber { end, .. } if end.is_empty()));
    for text in ["a.b=1 in..2 mm", "a.b=1..2 in", "a.b=1 lbf/in..2"] {
        assert!(matches!(wrong(text), VaryError::Units { .. }), "{text}");
    }
    assert!(matches!(wrong("a.b=1 in..1.0 in"), VaryError::OneValue { .. }));
    assert_eq!(Vary::parse("a.b=1..2", 1), Err(VaryError::Steps(1)));
    let vary = Vary::parse(" a.b = 2000 lbf/in .. 5000 lbf/in ", 4).unwrap();
    assert_eq!((vary.key(), vary.unit()), ("a.b", "lbf/in"));
    assert_eq!(vary.values(), [2000.0, 3000.0, 4000.0, 5000.0]);
    // Values between the ends are those that a user would type.
    let vary = Vary::parse("a.b=0.1..-1", 6).unwrap();
    assert_eq!(vary.values(), [0.1, -0.12, -0.34, -0.56, -0.78, -1.0]);
}

/// Keys that choose or name something are refused before anything is read; a number and a key that the case
/// has not are not.
#[test]
fn input_keys_of_no_number_are_refused() {
    let case = read(&[]).unwrap();
    let check = |key: &str| Vary::parse(&format!("{key}=1..2"), 2).unwrap().check(&case);
    for key in ["wheels.geometry", "lading.kind", "name"] {
        let error = check(key).unwrap_err();
        assert!(matches!(&error, VaryError::NotNumber { .. }), "{key}");
        assert!(error.to_string().contains(key) && !error.remedy().is_empty());
    }
    assert_eq!(check("wheels.conicity"), Ok(()));
    assert_eq!(check("wheels.none"), Ok(()));
}

/// A value that makes no car is named, and so is one of a key that there is not or of a wrong unit.
#[test]
fn input_values_that_make_no_car_are_named() {
    for (text, value) in [
        ("wheels.conicity=0.1..-0.5", "wheels.conicity = -0.5"),
        ("wheels.conicty=0.1..0.2", "wheels.conicty = 0.1"),
        ("wheels.conicity=1 in..2 in", "wheels.conicity = 1 in"),
    ] {
        let error = over(text, 2).unwrap_err();
        assert!(matches!(error, LocusError::Case { .. }));
        assert!(error.to_string().contains(value), "{error}");
    }
}

/// The ends of a range are the cases of the ends by themselves.
#[test]
fn analytic_ends_equal_separate_runs() {
    let found = over("wheels.conicity=0.05..0.2", 3).unwrap();
    assert!(found.complete && found.values.len() == 3);
    for (place, set) in [(0, "wheels.conicity=0.05"), (2, "wheels.conicity=0.2")] {
        let case = read(&[set.to_owned()]).unwrap();
        // Both branches come before the curve over the amplitude, which is not wanted.
        let alone = stability(&case, &[SPEED], |share| match share > 0.15 {
            true => ControlFlow::Break(()),
            false => ControlFlow::Continue(()),
        });
        let alone = alone.unwrap();
        for (branch, own) in found.branches.iter().zip(&alone.branches) {
            assert_eq!(branch.kind, own.kind);
            assert_eq!(branch.modes[place], own.modes[0], "{set}");
        }
        assert_eq!(alone.branches.len(), 2);
    }
}

/// Without friction the more conical wheels are, the faster hunting grows and swings; Klingel's frequency of
/// free wheelsets goes with the root of the conicity.
#[test]
fn limits_conicity_makes_wheelsets_hunt() {
    let found = over("wheels.conicity=0.05..0.2", 4).unwrap();
    let absent = &found.branches[1];
    let most: Vec<_> = (0..4)
        .map(|number| absent.most(number).unwrap().clone())
        .collect();
    for pair in most.windows(2) {
        assert!(pair[1].growth > pair[0].growth, "{most:?}");
        assert!(pair[1].frequency > pair[0].frequency, "{most:?}");
    }
    let ratio = most[3].frequency / most[0].frequency;
    assert!((ratio / 2.0 - 1.0).abs() < 0.1, "{ratio}");
    assert!(!found.is_flat());
}

/// What only limits friction changes nothing where it sticks or is absent, and the locus says so; one that is
/// stopped keeps what was computed.
#[test]
fn limits_a_coefficient_of_friction_makes_no_locus() {
    let found = over("truck.center_plate.friction=0.1..0.4", 2).unwrap();
    assert!(found.is_flat());
    let vary = Vary::parse("wheels.conicity=0.05..0.2", 3).unwrap();
    let stopped = locus(&vary, SPEED, read, |_| ControlFlow::Break(())).unwrap();
    assert!(!stopped.complete && stopped.values == [0.05]);
}
