//! Motions about steady running as pictures of a car show them.

use std::f64::consts::TAU;

use car::{FrictionState, SteadyCar, growing};
use std::ops::ControlFlow;
use study::car::mode_shape::{ModeRecording, MotionOf, PERIODS, ROWS, ShownMotion, motions, record};
use study::car::stability::{BranchKind, stability};
use study::car::{CarCase, builtin};

/// Returns the empty car on linear wheels, which grow restless at 60 mph without friction.
fn case() -> CarCase {
    let linear = ["wheels.geometry=linear", "track.support.kind=rigid"].map(str::to_owned);
    builtin::case_with("car_hunting_empty", &linear).unwrap()
}

const SPEED: f64 = 60.0 * 0.447_04;

/// Returns the vibration that grows most, 5 mm large at the wheelset that moves most, and the car.
fn fastest(case: &CarCase) -> (SteadyCar, ShownMotion) {
    let mut steady = SteadyCar::new(&case.parameters).unwrap();
    let modes = steady.vibrations(SPEED, FrictionState::Absent).unwrap();
    let mode = growing(&modes).unwrap();
    let lateral = laterals(&steady).map(|place| mode.shape[place].norm());
    let scale = 5e-3 / lateral.into_iter().fold(0.0, f64::max);
    let shape = mode.shape.iter().map(|own| [scale * own.re, scale * own.im]);
    let motion = ShownMotion {
        of: MotionOf::Branch(BranchKind::Absent, true),
        name: "hunting".to_owned(),
        speed: SPEED,
        frequency: mode.frequency(),
        shape: shape.collect(),
    };
    (steady, motion)
}

/// Returns the places of the lateral coordinates of the wheelsets in the state.
fn laterals(steady: &SteadyCar) -> [usize; 4] {
    let car = steady.car();
    car.numbers
        .wheelsets
        .map(|body| car.system.position_of(body, 0).unwrap())
}

/// Returns a column less its value in steady running.
fn moved(own: &ModeRecording, name: &str) -> Vec<f64> {
    let place = own
        .result
        .columns
        .iter()
        .position(|own| own.name == name)
        .unwrap();
    let values = own.result.values[place].iter();
    values.map(|value| value - own.rest[place]).collect()
}

/// Wheelsets go to and fro as the shape says, with its amplitudes and phases, and the body as its own
/// coordinates say up to what turning adds.
#[test]
fn analytic_columns_of_a_motion_reproduce_its_shape() {
    let case = case();
    let (steady, motion) = fastest(&case);
    let own = record(&case, &steady, &motion).unwrap();
    let times = own.result.column("time").unwrap();
    assert_eq!(times.len(), PERIODS * ROWS + 1);
    assert!((times[ROWS] * motion.frequency - 1.0).abs() < 1e-12);
    let mut most = 0.0_f64;
    for (axle, place) in (1..).zip(laterals(&steady)) {
        let [re, im] = motion.shape[place];
        let lateral = moved(&own, &format!("axle_{axle}_lateral"));
        for (time, value) in times.iter().zip(lateral) {
            let phase = TAU * motion.frequency * time;
            let wanted = re * phase.cos() - im * phase.sin();
            assert!(
                (value - wanted).abs() < 1e-9,
                "axle {axle}: {value} m, {wanted} m"
            );
            most = most.max(value.abs());
        }
    }
    // Forty rows a period miss a peak by (π/40)²/2 at most.
    assert!((most / 5e-3 - 1.0).abs() < 4e-3, "{most} m");
    assert!(own.result.column("axle_1_left_vertical").is_none(), "no forces");
    assert_eq!(own.rest.len(), own.result.columns.len());
}

/// A motion whose parts have all one phase goes through steady running twice a period, and comes back to
/// where it began.
#[test]
fn limits_a_motion_through_zero_is_steady_running() {
    let case = case();
    let (steady, mut motion) = fastest(&case);
    for part in &mut motion.shape {
        part[1] = 0.0;
    }
    let own = record(&case, &steady, &motion).unwrap();
    let mut moves = 0;
    for (column, (values, rest)) in own
        .result
        .columns
        .iter()
        .zip(own.result.values.iter().zip(&own.rest))
    {
        if column.name == "time" {
            continue;
        }
        for row in [ROWS / 4, 3 * ROWS / 4] {
            let name = &column.name;
            assert!(
                (values[row] - rest).abs() < 1e-12,
                "{name}: {} is not {rest}",
                values[row]
            );
        }
        assert!((values[0] - values[ROWS]).abs() < 1e-12, "{}", column.name);
        moves += usize::from((values[0] - rest).abs() > 1e-6);
    }
    // At least place and heading of each wheelset.
    assert!(moves >= 8, "{moves} columns move");
}

/// Of what is found, the largest and the smallest neutral motion and those of the branches are shown, each as
/// large as said.
#[test]
fn limits_motions_that_are_shown_are_as_large_as_said() {
    let case = builtin::case_with("car_hunting_roller_empty", &[]).unwrap();
    let found = stability(
        &case,
        &[SPEED, SPEED * 80.0 / 60.0],
        |_| ControlFlow::Continue(()),
    )
    .unwrap();
    let all = motions(&found);
    assert!(
        all.iter()
            .any(|own| matches!(own.of, MotionOf::Branch(BranchKind::Absent, _)))
    );
    let with_motion = found.curve.iter().filter(|own| own.critical.is_some());
    let amplitudes: Vec<f64> = with_motion.map(|own| own.amplitude).collect();
    let shown: Vec<&ShownMotion> = all
        .iter()
        .filter(|own| matches!(own.of, MotionOf::Amplitude(_)))
        .collect();
    assert!(amplitudes.len() > 1 && shown.len() == 2, "{amplitudes:?}");
    for own in shown {
        let MotionOf::Amplitude(amplitude) = own.of else {
            continue;
        };
        assert!([amplitudes.first(), amplitudes.last()].contains(&Some(&amplitude)));
        let lateral = laterals(&found.steady).map(|place| own.shape[place]);
        let most = lateral
            .iter()
            .fold(0.0_f64, |most, [re, im]| most.max(re.hypot(*im)));
        assert!((most / amplitude - 1.0).abs() < 1e-6, "{most} m of {amplitude} m");
    }
}
