//! Friction by speed, load and place, and the stick-slip oscillation that it excites.

use crate::common::{UP, coil, difference, face, ground, integrate, model, norm, options, over, rates};
use integrate::Method;
use mechanics::body::Body;
use mechanics::contact::{Interface, Sliding};
use mechanics::frame::Frame;
use mechanics::friction::FrictionLaw;
use mechanics::link::Marker;
use mechanics::motion::Motion;
use mechanics::system::System;

const TANH: FrictionLaw = FrictionLaw::Tanh {
    reference_speed: 1e-3,
};

#[test]
fn analytic_friction_limit_by_speed_load_and_place() {
    let sliding = Sliding {
        ratio: 0.6,
        stribeck_speed: 0.2,
        half_load: 500.0,
    };
    let interface = Interface {
        sliding,
        friction_factors: vec![1.0, 0.5],
        ..Interface::default()
    };
    let points = [[0.1, 0.0, 0.0], [-0.1, 0.0, 0.0]];
    let built = over(&points, interface, TANH, [0.0, 0.0, -2e-4, 0.0, 0.0, 0.0]);
    let mut system = System::new(built).unwrap();
    let mut x = system.initial_state();
    let speeds = system.layout().speeds;
    for speed in [0.05, 0.2, 1.0, 30.0] {
        x[speeds + 1] = speed;
        let seen = system.observe(0.0, &x);
        let normal = 1e6 * 2e-4;
        let by_speed = 0.6 + 0.4 / (1.0 + (speed / 0.2).powi(2));
        // The face carries twice the load of a point with half of it.
        let by_load = 1.0 / (1.0 + 2.0 * normal / 500.0);
        for (point, factor) in seen.faces[0].points.iter().zip([1.0, 0.5]) {
            let expected = 0.4 * normal * factor * by_speed * by_load;
            assert!((norm(&point.friction.force) / expected - 1.0).abs() < 1e-12);
        }
        let slope = difference(1e-3, |d| {
            let mut moved = x.clone();
            moved[speeds + 1] += d;
            rates(&mut system, 0.0, &moved)
        });
        assert!(slope[speeds + 1].is_finite());
    }
}

const MASS: f64 = 1.0;
const GRAVITY: f64 = 10.0;
const SPRING: f64 = 100.0;
const BELT: f64 = 0.1;
const REST: f64 = 0.5;
const RATIO: f64 = 0.6;

/// Returns the periods of a mass on a belt that a spring holds, from one beginning of a slip to the next.
fn periods(law: FrictionLaw, stribeck_speed: f64) -> Vec<f64> {
    let mut belt = ground();
    belt.frame.motions[0] = Motion::line(0.0, [0.0, BELT]);
    let block = Body {
        name: "block".into(),
        mass: MASS,
        free: [true, false, true, false, false, false],
        ..Body::prescribed("block", Frame::fixed([0.0; 3], [0.0; 3]))
    };
    let mut built = model(vec![ground(), belt, block], [0.0, 0.0, -GRAVITY]);
    let points = face("belt", &[[0.0; 3]], 1e6, 200.0, REST, law);
    built.faces.push((2, 1, Marker::new([0.0; 3], UP), points));
    built.interfaces.push((
        0,
        Interface {
            sliding: Sliding {
                ratio: RATIO,
                stribeck_speed,
                ..Sliding::default()
            },
            ..Interface::default()
        },
    ));
    built.coils.push((
        2,
        0,
        Marker::new([-1.0, 0.0, 0.0], [0.0; 3]),
        coil([0.0; 3], [0.0; 3], SPRING, 1.0),
    ));
    let system = System::new(built).unwrap();
    let mut x = system.initial_state();
    x[1] = -MASS * GRAVITY / 1e6;
    x[2] = BELT;
    let (mut tops, mut before): (Vec<f64>, [f64; 2]) = (Vec::new(), [0.0, BELT]);
    integrate(system, options(Method::Rodas5P, 1e-7), &x, 6.0, |own| {
        let now = [own.time(), own.x()[2]];
        // The mass comes to rest against the ground once a period, at its farthest.
        if before[1] > 0.0 && now[1] <= 0.0 {
            tops.push(before[0] + (now[0] - before[0]) * before[1] / (before[1] - now[1]));
        }
        before = now;
    });
    tops.windows(2).map(|pair| pair[1] - pair[0]).collect()
}

/// Stick: carried by the belt through twice the drop of friction over the spring. Slip: half an oscillation
/// about the force of sliding that meets the belt's speed again.
#[test]
fn analytic_stick_slip_period_of_a_drop_of_friction() {
    let omega = (SPRING / MASS).sqrt();
    let drop = REST * (1.0 - RATIO) * MASS * GRAVITY / SPRING;
    let pi = std::f64::consts::PI;
    let period = 2.0 * drop / BELT + 2.0 / omega * (pi - libm::atan(drop * omega / BELT));
    let tanh = FrictionLaw::Tanh {
        reference_speed: 5e-7,
    };
    let bristle = FrictionLaw::Bristle {
        stiffness: 1e7,
        damping: 1e3,
    };
    for law in [tanh, bristle] {
        let found = periods(law, 5e-5);
        assert!(found.len() > 4, "{found:?}");
        for own in &found[1..] {
            assert!((own / period - 1.0).abs() < 5e-3, "{law:?}: {own} {period}");
        }
    }
}

/// With a wide Stribeck curve: the same with ideal stick, the slip by Runge and Kutta's method in small
/// steps.
#[test]
fn analytic_stick_slip_period_of_a_stribeck_curve() {
    let stribeck = 0.15;
    let normal = MASS * GRAVITY;
    // The mass at rest against the belt breaks away at x = μ N / k.
    let acceleration = |x: f64, v: f64| {
        let slip = v - BELT;
        let limit = REST * normal * (RATIO + (1.0 - RATIO) / (1.0 + (slip / stribeck).powi(2)));
        (-SPRING * x + limit) / MASS
    };
    let (mut x, mut v, mut time, h) = (REST * normal / SPRING, BELT, 0.0, 1e-5);
    // A little over the top, from where it slides.
    v -= 1e-9;
    loop {
        let k1 = (v, acceleration(x, v));
        let k2 = (
            v + 0.5 * h * k1.1,
            acceleration(x + 0.5 * h * k1.0, v + 0.5 * h * k1.1),
        );
        let k3 = (
            v + 0.5 * h * k2.1,
            acceleration(x + 0.5 * h * k2.0, v + 0.5 * h * k2.1),
        );
        let k4 = (v + h * k3.1, acceleration(x + h * k3.0, v + h * k3.1));
        x += h / 6.0 * (k1.0 + 2.0 * k2.0 + 2.0 * k3.0 + k4.0);
        v += h / 6.0 * (k1.1 + 2.0 * k2.1 + 2.0 * k3.1 + k4.1);
        time += h;
        if time > 0.05 && v >= BELT {
            break;
        }
        assert!(time < 3.0);
    }
    let period = time + (REST * normal / SPRING - x) / BELT;
    let bristle = FrictionLaw::Bristle {
        stiffness: 1e6,
        damping: 1e3,
    };
    for own in &periods(bristle, stribeck)[1..] {
        assert!((own / period - 1.0).abs() < 5e-3, "{own} {period}");
    }
}
