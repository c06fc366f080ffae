//! Cars that cannot stand, and accelerometers on those that do.

use crate::common;
use car::{BuildError, Car, Loads, Mass, Parameters, StartKind, Support};
use common::{INCH, POUND_FORCE, at_start, loaded, put_on_gauge, run, tangent};
use integrate::Problem;

const GRAVITY: f64 = 9.806_65;

/// Returns the loaded car with a mass (kip) at a place (in) as its lading.
fn laden(kip: f64, place: [f64; 3]) -> Parameters {
    let mut parameters = loaded(tangent(60.0), 2.0);
    parameters.lading = vec![Mass {
        name: "coil".to_owned(),
        mass: kip * 1e3 * POUND_FORCE / GRAVITY,
        place: place.map(|own| own * INCH),
        inertia: [1e5; 3],
    }];
    parameters
}

/// Returns the car on rails of a gauge (in).
fn on_gauge(gauge: f64) -> Parameters {
    let mut parameters = loaded(tangent(60.0), 0.0);
    put_on_gauge(&mut parameters, gauge);
    parameters
}

/// A start in the nominal layout does not help either.
#[test]
fn issue_048_wheels_that_do_not_reach_both_rails_are_told() {
    for kind in [StartKind::Equilibrium, StartKind::Nominal] {
        let mut parameters = on_gauge(66.0);
        parameters.start.kind = kind;
        let error = Car::new(&parameters).unwrap_err();
        assert!(matches!(error, BuildError::Reach { .. }), "{error}");
        let text = error.to_string();
        for part in [
            "do not reach both rails",
            "66.00 in",
            "64.81 in",
            "lower the gauge to",
        ] {
            assert!(text.contains(part), "{part}: {text}");
        }
    }
    Car::new(&on_gauge(56.5)).unwrap();
}

/// Beyond the side bearings and the trucks the distance is that of the center of gravity; below, a car that
/// leans over is told with its height, and one that stands is none.
#[test]
fn issue_048_a_car_that_tips_is_told_with_its_center_of_gravity() {
    for (place, over) in [
        ([0.0, 40.0, 100.0], Support::SideBearings),
        ([400.0, 0.0, 100.0], Support::Trucks),
    ] {
        let parameters = laden(200.0, place);
        let Err(BuildError::Tips(tipping)) = Car::new(&parameters) else {
            panic!("{place:?}");
        };
        let [forward, left, _] = parameters.center_of_gravity();
        let beyond = match over {
            Support::SideBearings => left - parameters.side_bearing_distance(),
            Support::Trucks => forward - 0.5 * parameters.truck_distance,
        };
        assert!(
            tipping.over == over && (tipping.outside - beyond).abs() < 1e-12,
            "{tipping:?}"
        );
        let text = tipping.to_string();
        let inches = format!("({:.1} in) outside", beyond / INCH);
        assert!(text.contains("the car tips") && text.contains(&inches), "{text}");
    }
    for place in [[0.0, -20.0, 200.0], [0.0, -2.0, 1500.0]] {
        let Err(BuildError::Tips(tipping)) = Car::new(&laden(200.0, place)) else {
            panic!("{place:?}");
        };
        assert!(
            tipping.lean.is_some_and(|lean| lean > 0.02 && lean < 0.2),
            "{tipping:?}"
        );
        let text = tipping.to_string();
        assert!(
            text.contains("the car tips to the right") && text.contains("coils of one side"),
            "{text}"
        );
    }
    assert_eq!(laden(200.0, [0.0, 12.0, 70.0]).tips_over(), None);
    Car::new(&laden(200.0, [0.0, 12.0, 70.0])).unwrap();
}

/// Lengths in inches are asked for, and bounds are in order.
#[test]
fn issue_048_distances_in_another_unit_are_hinted_at() {
    let mut parameters = loaded(tangent(60.0), 0.0);
    parameters.truck_distance = 486.0;
    let error = parameters.check().unwrap_err();
    assert!(error.to_string().contains("between 1 and 100 m"), "{error}");
    assert!(
        error.remedy().unwrap().contains("inches (\"486 in\")"),
        "{error:?}"
    );
    let mut parameters = loaded(tangent(60.0), 0.0);
    parameters.truck_distance = 60.0;
    let error = parameters.check().unwrap_err();
    assert!(error.to_string().contains("the track is 60.00 m long"), "{error}");
    let mut parameters = loaded(tangent(60.0), 0.0);
    parameters.accelerometer_height = Some(30.0);
    let error = parameters.check().unwrap_err();
    assert!(
        error.remedy().unwrap().contains("inches (\"30 in\")"),
        "{error:?}"
    );
}

/// At rest a leaning car shows gravity's part along its left; the height of the center plate is the default,
/// and accelerations of a rolling body change linearly with the height.
#[test]
fn issue_048_accelerometers_have_a_height_and_show_gravity() {
    let mut parameters = laden(200.0, [0.0, 12.0, 70.0]);
    // Friction that holds the leaning body builds up in the first second.
    let ran = run(&parameters, 2.0, 0.01, 1e-5);
    let late: Vec<&Loads> = ran
        .loads
        .iter()
        .filter(|(time, _)| *time > 1.0)
        .map(|(_, own)| own)
        .collect();
    let mean = |of: &dyn Fn(&Loads) -> f64| late.iter().map(|own| of(own)).sum::<f64>() / late.len() as f64;
    let roll = mean(&|own| own.body_angles[0]);
    assert!(roll < -5e-3, "{roll}");
    for end in 0..2 {
        let shown = mean(&|own| own.ends[end].lateral_acceleration);
        assert!(
            (shown / (GRAVITY * roll.sin()) - 1.0).abs() < 0.1,
            "{shown} {roll}"
        );
    }
    parameters.start.kind = StartKind::Nominal;
    let at = |height: Option<f64>| {
        let mut parameters = parameters.clone();
        parameters.accelerometer_height = height;
        at_start(&Car::new(&parameters).unwrap()).ends
    };
    let usual = parameters.plate_heights()[0];
    assert!((usual / INCH - 30.0).abs() < 1.0, "{usual}");
    assert_eq!(at(None), at(Some(usual)));
    let lateral = [1.0, 2.0, 3.0].map(|height| at(Some(height))[0].lateral_acceleration);
    let [low, high] = [lateral[1] - lateral[0], lateral[2] - lateral[1]];
    assert!(
        low.abs() > 1e-3 && (low - high).abs() < 1e-9 * low.abs(),
        "{lateral:?}"
    );
    assert_eq!(at(None)[0].lateral, at(Some(3.0))[0].lateral);
}

/// Accelerometers on bolsters and side frames against a second derivation: the velocities of the centers of
/// gravity along the flow of the state, and gravity along the left of each body.
#[test]
fn analytic_accelerometers_of_trucks_show_acceleration_and_gravity() {
    let mut parameters = laden(100.0, [0.0, 12.0, 70.0]);
    parameters.start.kind = StartKind::Nominal;
    parameters.start.wheelset_shifts = [5e-3, -3e-3, 4e-3, 0.0];
    let mut car = Car::new(&parameters).unwrap();
    let mut x = car.initial_state.clone();
    let mut rates = vec![0.0; x.len()];
    // Some way into the motion, where bodies turn.
    for _ in 0..400 {
        car.system.derivative(0.0, &x, &mut rates);
        for (own, rate) in x.iter_mut().zip(&rates) {
            *own += 1e-6 * rate;
        }
    }
    car.system.derivative(0.0, &x, &mut rates);
    let seen = car.system.observe(0.0, &x);
    let shown = car.loads(&seen, &rates).truck_accelerations;
    let step = 1e-7;
    let [before, after] = [-step, step].map(|step| {
        let moved: Vec<f64> = x.iter().zip(&rates).map(|(x, rate)| x + step * rate).collect();
        car.system.observe(0.0, &moved)
    });
    for truck in 0..2 {
        let [left, right] = car.numbers.side_frames[truck];
        for (part, number) in [car.numbers.bolsters[truck], left, right].into_iter().enumerate() {
            let velocity = |seen: &mechanics::system::Observation| {
                let own = &seen.bodies[number];
                let arm = own.center_of_gravity - own.origin;
                let turned: mechanics::vector::Vector<f64> = own.angular_velocity.cross(arm);
                own.velocity + turned
            };
            let [a, b] = [velocity(&before), velocity(&after)];
            // Roll, left side up, of a body whose axes in the nominal layout are along those of the track.
            let own = &seen.bodies[number];
            let nominal = mechanics::orientation::fixed(car.system.bodies()[number].frame.orientation);
            let left = own.rotation.times(nominal.transpose()).column(1).0;
            let expected: f64 = (0..3)
                .map(|k| left[k] * ((b.0[k] - a.0[k]) / (2.0 * step) + [0.0, 0.0, GRAVITY][k]))
                .sum();
            let found = shown[truck][part];
            assert!(expected.abs() > 1e-3, "{expected}");
            assert!(
                (found - expected).abs() < 1e-4 * expected.abs().max(1.0),
                "{found} {expected}"
            );
        }
    }
}
