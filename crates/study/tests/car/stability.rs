//! Linear stability of whole cars.

use std::ops::ControlFlow;

use study::car::builtin;
use study::car::hunting::{HuntingError, HuntingSettings, hunting};
use study::car::stability::{BranchKind, stability};

/// The empty car on linear wheels: with stuck friction it does not hunt at 30 mph; vibrations are sorted and
/// within the range told; a user who stops it gets what was computed.
#[test]
fn limits_modes_of_the_empty_car() {
    let linear = ["wheels.geometry=linear", "track.support.kind=rigid"].map(str::to_owned);
    let case = builtin::case_with("car_hunting_empty", &linear).unwrap();
    let speed = 30.0 * 0.447_04;
    let found = stability(&case, &[speed], |_| ControlFlow::Continue(())).unwrap();
    assert!(found.complete && found.branches.len() == 2);
    for branch in &found.branches {
        let modes = &branch.modes[0];
        assert!(modes.len() > 5);
        assert!(modes.windows(2).all(|pair| pair[0].growth >= pair[1].growth));
        assert!(modes.iter().all(|mode| (0.05..=30.0).contains(&mode.frequency)));
    }
    assert!(found.branches[0].modes[0][0].growth < 0.0);
    let stopped = stability(&case, &[speed], |_| ControlFlow::Break(())).unwrap();
    assert!(!stopped.complete && stopped.branches.len() == 1);
}

/// With profiles on sprung rails eigenvalues are found too, though contacts are 1e7 times as fast as the car;
/// new wheels on stuck friction do not hunt at 30 mph.
#[test]
fn limits_modes_of_the_empty_car_on_profiles() {
    let case = builtin::case_with("car_hunting_empty", &[]).unwrap();
    let found = stability(&case, &[30.0 * 0.447_04], |_| ControlFlow::Continue(())).unwrap();
    let worst = &found.branches[0].modes[0][0];
    assert!(worst.growth < 0.0 && worst.growth > -2.0, "{worst:?}");
}

/// The linear benchmark posed by keys: 65, 45 and 32 mph at conicities of 0.05, 0.1 and 0.2 with 17
/// kip·in/mrad of warp stiffness, from a separate model of nine coordinates.
#[test]
fn reproduction_the_linear_benchmark_is_posed_by_keys() {
    for (conicity, expected) in [(0.05, 65.0), (0.1, 45.0), (0.2, 32.0)] {
        let keys = [
            "wheels.geometry=linear",
            "track.support.kind=rigid",
            "wheels.spin=false",
            "wheels.f11=1504000 lbf",
            "wheels.f22=1396000 lbf",
            "truck.load_springs.shear_stiffness=4450 lbf/in",
            "stability.warp_moment=255000 lbf in",
        ];
        let mut keys: Vec<String> = keys.map(str::to_owned).into();
        keys.push(format!("wheels.conicity={conicity}"));
        let case = builtin::case_with("car_hunting_empty", &keys).unwrap();
        let speeds = [0.9, 1.1].map(|own| own * expected * 0.447_04);
        let mut parts = 0;
        // The curve over the amplitude is not asked for.
        let found = stability(&case, &speeds, |_| {
            parts += 1;
            match parts < 7 {
                true => ControlFlow::Continue(()),
                false => ControlFlow::Break(()),
            }
        });
        let found = found.unwrap();
        let tied = found
            .branches
            .iter()
            .find(|own| own.kind == BranchKind::Tied)
            .unwrap();
        let critical = tied.critical.as_ref().unwrap();
        let speed = critical.speed / 0.447_04;
        assert!(
            !critical.at_lowest && (speed / expected - 1.0).abs() < 0.05,
            "{conicity}: {speed}"
        );
        assert!(critical.name.starts_with("hunting"), "{}", critical.name);
    }
}

/// Ramps that are none, and linear wheels, are refused before anything runs.
#[test]
fn input_ramps_that_are_none_are_refused() {
    let go_on = |_| ControlFlow::Break("must not run".to_owned());
    let usual = HuntingSettings {
        speeds: [10.0, 20.0],
        ramp: 10.0,
        threshold: 1e-3,
    };
    let case = builtin::case_with("car_hunting_empty", &[]).unwrap();
    for settings in [
        HuntingSettings {
            speeds: [20.0, 10.0],
            ..usual
        },
        HuntingSettings {
            speeds: [0.0, 10.0],
            ..usual
        },
        HuntingSettings { ramp: 0.0, ..usual },
        HuntingSettings {
            threshold: f64::NAN,
            ..usual
        },
    ] {
        let refused = hunting(&case, settings, go_on).unwrap_err();
        assert!(refused.to_string().contains("make no ramp"), "{refused}");
    }
    let linear = ["wheels.geometry=linear", "track.support.kind=rigid"].map(str::to_owned);
    let case = builtin::case_with("car_hunting_empty", &linear).unwrap();
    let refused = hunting(&case, usual, go_on).unwrap_err();
    assert!(matches!(refused, HuntingError::LinearWheels), "{refused}");
}

/// A user who stops it gets what was computed, marked as incomplete.
#[test]
fn limits_a_stopped_ramp_is_incomplete() {
    let case = builtin::case_with("car_hunting_roller_empty", &[]).unwrap();
    let settings = HuntingSettings {
        speeds: [20.0, 30.0],
        ramp: 10.0,
        threshold: 1e-3,
    };
    let found = hunting(&case, settings, |_| ControlFlow::Break("stopped".to_owned())).unwrap();
    assert!(!found.complete && found.rising.is_none());
    assert!(found.falling.points.is_empty());
}
