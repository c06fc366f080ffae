//! A car that stands and runs on perfect track.

use crate::common;
use car::{Car, Loads, Mass, Parameters};
use common::{POUND_FORCE, at_start, empty, loaded, run, tangent};
use mechanics::vector::Vector;

/// Returns the vertical force of all wheels, N.
fn sum(loads: &Loads) -> f64 {
    loads.wheels.iter().flatten().map(|wheel| wheel.vertical).sum()
}

/// 263,000 lbf and 62,600 lbf.
#[test]
fn analytic_wheels_carry_the_weight() {
    for (parameters, weight) in [
        (loaded(tangent(60.0), 0.0), 263_000.0),
        (empty(tangent(60.0), 0.0), 62_600.0),
    ] {
        assert!((parameters.weight() / (weight * POUND_FORCE) - 1.0).abs() < 1e-6);
        for support in [true, false] {
            let mut parameters = parameters.clone();
            parameters.support = parameters.support.filter(|_| support);
            let loads = at_start(&Car::new(&parameters).unwrap());
            let found = sum(&loads);
            assert!((found / parameters.weight() - 1.0).abs() < 1e-7, "{found} N");
            for wheel in loads.wheels.iter().flatten() {
                assert!(
                    (wheel.vertical / (parameters.weight() / 8.0) - 1.0).abs() < 1e-4,
                    "{wheel:?}"
                );
            }
        }
    }
}

/// Forces and moments of all wheels against the weights of all bodies, where they are.
#[test]
fn analytic_lading_off_the_center_loads_what_is_below_it() {
    let mut parameters = loaded(tangent(60.0), 0.0);
    let whole = parameters.lading.remove(0);
    let part = |mass: f64, place: [f64; 3]| Mass {
        name: "bale".to_owned(),
        mass,
        place,
        inertia: whole.inertia.map(|own| own * mass / whole.mass),
    };
    let (place, mass) = (whole.place, whole.mass);
    parameters.lading = vec![
        part(0.7 * mass, [0.6, 0.05, place[2]]),
        part(0.3 * mass, [-0.2, -0.02, place[2] + 0.3]),
    ];
    let car = Car::new(&parameters).unwrap();
    let mut system = car.system.clone();
    let seen = system.observe(0.0, &car.initial_state);
    let rails = car.numbers.rails.unwrap();
    let (mut force, mut moment) = (Vector::<f64>::zero(), Vector::<f64>::zero());
    car.patches(&seen, |w, i, patch| {
        let own: Vector<f64> = patch.normal.scale(patch.forces.normal * patch.patch.share);
        let at = patch.place + seen.bodies[rails[w][i]].origin;
        force += own;
        moment += at.cross::<f64, f64>(own);
    });
    for (body, state) in system.bodies().iter().zip(&seen.bodies) {
        if body.free[3] {
            let weight = Vector([0.0, 0.0, -body.mass * parameters.gravity]);
            force += weight;
            moment += state.center_of_gravity.cross::<f64, f64>(weight);
        }
    }
    let weight = parameters.weight();
    for k in 0..3 {
        assert!(force.0[k].abs() < 1e-8 * weight, "{force:?}");
        assert!(moment.0[k].abs() < 1e-7 * weight, "{moment:?}");
    }
    // Of the center of gravity of all, 0.27 m ahead and 22 mm to the left.
    let loads = at_start(&car);
    let middle = parameters.start.distance;
    let along: f64 = loads
        .axles
        .iter()
        .zip(&loads.wheels)
        .map(|(axle, [left, right])| (axle.distance - middle) * (left.vertical + right.vertical))
        .sum();
    let expected = 0.36 * mass * parameters.gravity;
    assert!(
        (along / expected - 1.0).abs() < 0.01,
        "{along} and {expected} N·m"
    );
    let [left, right] = [0, 1].map(|i| loads.wheels.iter().map(|pair| pair[i].vertical).sum::<f64>());
    assert!(left > 1.01 * right, "{left} {right}");
}

fn largest(loads: &[(f64, Loads)], of: impl Fn(&Loads) -> f64) -> f64 {
    loads
        .iter()
        .fold(0.0, |most: f64, (_, own)| most.max(of(own).abs()))
}

/// Nothing moves sideways or rolls on perfect track, below the critical speed.
#[test]
fn limits_a_car_on_perfect_track_stays_straight() {
    for (name, parameters, duration) in [
        ("standing", loaded(tangent(60.0), 0.0), 5.0),
        ("loaded", loaded(tangent(400.0), 15.0), 20.0),
        ("empty", empty(tangent(300.0), 10.0), 20.0),
    ] {
        let ran = run(&parameters, duration, 0.1, 1e-5);
        for w in 0..4 {
            let lateral = largest(&ran.loads, |own| own.axles[w].lateral);
            assert!(lateral < 1e-6, "{name}: wheelset {w} moves by {lateral} m");
        }
        let roll = largest(&ran.loads, |own| own.body_angles[0]);
        let end = largest(&ran.loads, |own| own.ends[0].lateral);
        assert!(roll < 1e-6 && end < 1e-6, "{name}: {roll} rad, {end} m");
        let weight = parameters.weight();
        let last = ran.last();
        assert!(
            (sum(last) / weight - 1.0).abs() < 2e-3,
            "{name}: {} of {weight} N",
            sum(last)
        );
        assert!(
            (last.speed - parameters.start.speed).abs() < 0.02,
            "{name}: {} m/s",
            last.speed
        );
    }
}

fn message(change: impl Fn(&mut Parameters)) -> String {
    let mut parameters = loaded(tangent(60.0), 10.0);
    change(&mut parameters);
    Car::new(&parameters).map(|_| ()).unwrap_err().to_string()
}

#[test]
fn input_what_makes_no_car_is_named() {
    let said = message(|own| own.start.distance = 1.0);
    assert!(
        said.contains("the distance of the start") && said.contains("between 7.06 and 52.94 m"),
        "{said}"
    );
    let said = message(|own| own.lading[0].mass = -1.0);
    assert!(said.contains("the mass of lading (kg) is -1"), "{said}");
    let said = message(|own| own.trucks[1].car_body = None);
    assert!(said.contains("the rear truck has no center plate"), "{said}");
    let said = message(|own| own.lading[0].place[1] = 3.0);
    assert!(said.contains("the car tips to the left"), "{said}");
}
