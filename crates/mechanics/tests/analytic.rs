//! Motions, friction laws, contacts, coils and the massless wedge against closed forms, differences and second derivations.
#![allow(missing_docs, clippy::unwrap_used, clippy::expect_used)]

mod common;

use common::{
    ALL, Random, UP, add, body, coil, cross, difference, face, ground, model, norm, rodrigues, times,
};
use integrate::Problem;
use integrate::scalar::Dual;
use mechanics::body::Body;
use mechanics::characteristic::Characteristic;
use mechanics::coil::{Coil, CoilLaw};
use mechanics::frame::Frame;
use mechanics::friction::{FrictionLaw, bristle, tanh};
use mechanics::link::{Mount, Relative};
use mechanics::motion::{Motion, RampProfile};
use mechanics::quasi_static::{Direction, QuasiStaticWedge, SlopeFriction};
use mechanics::spline::{Spline, SplineError};
use mechanics::system::System;
use mechanics::vector::{Matrix, Vector};
use std::f64::consts::PI;

fn close(value: f64, expected: f64, tolerance: f64) {
    assert!(
        (value - expected).abs() <= tolerance,
        "{value} instead of {expected} (within {tolerance})"
    );
}

// Motions

fn at(motion: &Motion, time: f64) -> [f64; 3] {
    motion.evaluate(time, time)
}

/// First and second derivative at `time` against differences on the piece of `time`.
fn derivatives(motion: &Motion, time: f64) {
    let h = 1e-3;
    let [_, rate, second] = at(motion, time);
    let by_difference = difference(h, |d| {
        let [value, rate, _] = motion.evaluate(time + d, time);
        vec![value, rate]
    });
    let size = at(motion, time).iter().fold(1.0, |m: f64, v| m.max(v.abs()));
    close(rate, by_difference[0], 1e-11 * size);
    close(second, by_difference[1], 1e-11 * size);
}

fn sine() -> Motion {
    Motion::Sine {
        amplitude: 0.7,
        angular_frequency: 2.3,
        phase: 0.4,
    }
}
fn triangle() -> Motion {
    Motion::Triangle {
        amplitude: 0.7,
        angular_frequency: 2.3,
    }
}
fn swept() -> Motion {
    Motion::SweptSine {
        amplitude: 0.7,
        start: 1.2,
        end: 6.5,
        duration: 4.0,
    }
}
fn ramp(profile: RampProfile) -> Motion {
    Motion::Ramp {
        amplitude: -0.7,
        start: 0.5,
        duration: 1.25,
        profile,
    }
}
fn table() -> Motion {
    let times: Vec<f64> = (0..15)
        .map(|i| 0.4 * f64::from(i) + 0.05 * f64::from(i % 3))
        .collect();
    let values = times.iter().map(|t| libm::sin(1.7 * t) + 0.1 * t).collect();
    Motion::Table(Spline::new(times, values).unwrap())
}

#[test]
fn motions_and_their_derivatives() {
    let smooth = ramp(RampProfile::Smooth);
    let sum = Motion::Sum(vec![sine(), swept(), smooth.clone(), Motion::Constant(3.0)]);
    let all = [
        Motion::Constant(0.3),
        sine(),
        triangle(),
        swept(),
        smooth,
        ramp(RampProfile::Linear),
        sum,
    ];
    let mut random = Random(1);
    for motion in &all {
        for _ in 0..60 {
            derivatives(motion, random.between(-1.0, 7.0));
        }
    }
    // Differences of a spline must stay within one of its cubics.
    for k in 0..14 {
        let knot = 0.4 * f64::from(k) + 0.05 * f64::from(k % 3);
        for d in [0.01, 0.17, 0.28] {
            derivatives(&table(), knot + d);
        }
    }
}

#[test]
fn sine_and_triangle_values() {
    for i in 0..50 {
        let t = 0.11 * f64::from(i);
        close(at(&sine(), t)[0], 0.7 * (2.3 * t + 0.4).sin(), 1e-15);
        // The triangle wave of amplitude A is (2A/π) asin(sin(ω t)).
        close(
            at(&triangle(), t)[0],
            0.7 * 2.0 / PI * (2.3 * t).sin().asin(),
            1e-13,
        );
    }
    // Corners: the value is the amplitude from both sides, the rate jumps from + to -.
    let corner = 0.5 * PI / 2.3;
    let before = triangle().evaluate(corner, corner - 1e-3);
    let after = triangle().evaluate(corner, corner + 1e-3);
    close(before[0], 0.7, 1e-14);
    close(after[0], 0.7, 1e-14);
    close(before[1], 0.7 * 2.3 * 2.0 / PI, 1e-14);
    close(after[1], -before[1], 0.0);
}

#[test]
fn swept_sine_is_exact_in_phase() {
    let (start, end, duration) = (1.2, 6.5, 4.0);
    let phase = |t: f64| {
        if t < duration {
            start * t + (end - start) * t * t / (2.0 * duration)
        } else {
            0.5 * (start + end) * duration + end * (t - duration)
        }
    };
    let frequency = |t: f64| start + (end - start) * (t / duration).min(1.0);
    for i in 0..100 {
        let t = 0.073 * f64::from(i);
        let [value, rate, second] = at(&swept(), t);
        let (s, c) = phase(t).sin_cos();
        close(value, 0.7 * s, 1e-14);
        close(rate, 0.7 * c * frequency(t), 1e-13);
        // Instantaneous frequency, where value and rate tell it.
        close(
            (rate * rate + (value * frequency(t)).powi(2)).sqrt() / 0.7,
            frequency(t),
            1e-13,
        );
        let growth = if t < duration {
            (end - start) / duration
        } else {
            0.0
        };
        close(
            second,
            0.7 * (c * growth - s * frequency(t) * frequency(t)),
            1e-12,
        );
    }
    let before = swept().evaluate(duration, duration - 1e-6);
    let after = swept().evaluate(duration, duration + 1e-6);
    close(before[0], after[0], 1e-14);
    close(before[1], after[1], 1e-13);
    // Only the second derivative jumps, by A cos(φ) times the growth of the frequency.
    let jump = 0.7 * phase(duration).cos() * (end - start) / duration;
    close(before[2] - after[2], jump, 1e-12);
}

#[test]
fn ramps() {
    let smooth = ramp(RampProfile::Smooth);
    let linear = ramp(RampProfile::Linear);
    for motion in [&smooth, &linear] {
        assert_eq!(at(motion, 0.4999), [0.0; 3]);
        assert_eq!(at(motion, 1.75), [-0.7, 0.0, 0.0]);
        assert_eq!(at(motion, 99.0), [-0.7, 0.0, 0.0]);
        // Continuous at both ends.
        close(motion.evaluate(0.5, 0.6)[0], 0.0, 0.0);
        close(motion.evaluate(1.75, 1.7)[0], -0.7, 1e-15);
        // Half way in the middle (both shapes are odd about it).
        close(at(motion, 1.125)[0], -0.35, 1e-15);
    }
    close(at(&linear, 0.75)[0], -0.14, 1e-15);
    close(at(&linear, 0.75)[1], -0.56, 1e-15);
    // 10 s³ - 15 s⁴ + 6 s⁵ at s = 1/5: 0.08 - 0.024 + 0.00192
    close(at(&smooth, 0.75)[0], -0.7 * 0.05792, 1e-15);
    for [value, rate, second] in [smooth.evaluate(0.5, 0.6), smooth.evaluate(1.75, 1.7)] {
        close(rate, 0.0, 1e-14);
        close(second, 0.0, 1e-13);
        assert!(value.abs() < 1e-15 || (value + 0.7).abs() < 1e-15);
    }
    // Its rate is largest in the middle: 15/8 of the mean.
    close(at(&smooth, 1.125)[1], -0.7 / 1.25 * 1.875, 1e-14);
}

#[test]
fn breaks_are_enumerated() {
    let list = |motion: &Motion, from: f64, to: f64| -> Vec<f64> {
        let mut out = Vec::new();
        let mut time = from;
        while let Some(next) = motion.next_break(time) {
            assert!(next > time, "a break must lie ahead: {next} after {time}");
            if next > to {
                break;
            }
            out.push(next);
            time = next;
        }
        out
    };
    let same = |found: Vec<f64>, expected: Vec<f64>| {
        assert_eq!(found.len(), expected.len(), "{found:?} instead of {expected:?}");
        for (a, b) in found.iter().zip(&expected) {
            close(*a, *b, 4.0 * f64::EPSILON * b.abs());
        }
    };
    for smooth in [Motion::Constant(1.0), sine(), table()] {
        assert_eq!(smooth.next_break(-10.0), None);
    }
    // A long list: rounding must neither lose a corner nor repeat one.
    for w in [2.3, PI, 1.0 / 3.0, 7.1] {
        let motion = Motion::Triangle {
            amplitude: 1.0,
            angular_frequency: w,
        };
        let corners: Vec<f64> = (0..3000).map(|n| (f64::from(n) + 0.5) * PI / w).collect();
        same(list(&motion, 0.0, 3000.0 * PI / w), corners);
        close(motion.next_break(-0.6 * PI / w).unwrap(), -0.5 * PI / w, 1e-14);
    }
    same(list(&swept(), 0.0, 100.0), vec![4.0]);
    same(list(&ramp(RampProfile::Linear), -1.0, 100.0), vec![0.5, 1.75]);
    same(list(&ramp(RampProfile::Smooth), 0.5, 100.0), vec![1.75]);
    let half = PI / 2.3;
    let sum = Motion::Sum(vec![
        ramp(RampProfile::Linear),
        Motion::Sum(vec![triangle(), sine()]),
    ]);
    same(
        list(&sum, 0.0, 4.0),
        vec![0.5, 0.5 * half, 1.75, 1.5 * half, 2.5 * half],
    );
    assert_eq!(Motion::Sum(vec![]).next_break(0.0), None);
    // A frame breaks where any of its coordinates does.
    let mut frame = Frame::fixed([0.0; 3], [0.0; 3]);
    assert_eq!(frame.next_break(0.0), None);
    frame.motions[1] = ramp(RampProfile::Linear);
    frame.motions[4] = triangle();
    assert_eq!(frame.next_break(0.0), Some(0.5));
    close(frame.next_break(0.5).unwrap(), 0.5 * half, 1e-15);
}

#[test]
fn segments_end_at_breaks_and_keep_their_side() {
    let mut frame = Frame::fixed([0.0; 3], [0.0; 3]);
    frame.motions[2] = triangle();
    let base = Body::prescribed("base", frame);
    let one = body(
        "b",
        1.0,
        [1.0; 3],
        [0.0; 3],
        [true, false, false, false, false, false],
        [0.0; 6],
    );
    let mut system = System::new(model(vec![one, base], [0.0; 3])).unwrap();
    let corner = 0.5 * PI / 2.3;
    let x = system.initial_state();
    let rate = 0.7 * 2.3 * 2.0 / PI;
    close(system.segment(0.0), corner, 1e-15);
    let seen = system.observe(corner, &x);
    close(seen.bodies[1].velocity.0[2], rate, 1e-14);
    close(system.segment(corner), 3.0 * corner, 1e-14);
    let seen = system.observe(corner, &x);
    close(seen.bodies[1].velocity.0[2], -rate, 1e-14);
    // A copy takes the side from the other.
    let mut copy = System::new(model(system.bodies().to_vec(), [0.0; 3])).unwrap();
    copy.segment(0.0);
    close(copy.observe(corner, &x).bodies[1].velocity.0[2], rate, 1e-14);
    copy.segment_like(&system);
    close(copy.observe(corner, &x).bodies[1].velocity.0[2], -rate, 1e-14);
}

// Spline

#[test]
fn spline_reproduces_cubics() {
    let cubic = |t: f64| {
        [
            2.0 - t + 0.5 * t * t - 0.3 * t * t * t,
            -1.0 + t - 0.9 * t * t,
            1.0 - 1.8 * t,
        ]
    };
    for count in [4, 5, 6, 11] {
        let mut random = Random(count);
        let mut times = vec![-1.0];
        for i in 1..count as usize {
            times.push(times[i - 1] + random.between(0.1, 0.9));
        }
        let values = times.iter().map(|t| cubic(*t)[0]).collect();
        let spline = Spline::new(times.clone(), values).unwrap();
        let (first, last) = spline.range();
        assert_eq!((first, last), (times[0], times[times.len() - 1]));
        // Outside its abscissae the end pieces go on.
        for i in 0..=60 {
            let t = first - 0.2 + (last - first + 0.4) * f64::from(i) / 60.0;
            for (value, expected) in spline.evaluate(t).into_iter().zip(cubic(t)) {
                close(value, expected, 2e-11);
            }
        }
    }
}

#[test]
fn spline_is_twice_continuously_differentiable() {
    let mut random = Random(7);
    let times: Vec<f64> = (0..12)
        .map(|i| f64::from(i) + random.between(-0.3, 0.3))
        .collect();
    let values: Vec<f64> = times.iter().map(|_| random.between(-1.0, 1.0)).collect();
    let spline = Spline::new(times.clone(), values.clone()).unwrap();
    let third = |t: f64| (spline.evaluate(t + 0.05)[2] - spline.evaluate(t - 0.05)[2]) / 0.1;
    for i in 0..12 {
        close(spline.evaluate(times[i])[0], values[i], 1e-13);
    }
    for i in 1..11 {
        let (left, right) = (
            spline.evaluate(times[i] - 1e-12),
            spline.evaluate(times[i] + 1e-12),
        );
        for order in 0..3 {
            close(left[order], right[order], 1e-9);
        }
        let jump = (third(times[i] + 0.1) - third(times[i] - 0.1)).abs();
        // Not a knot: the third derivative does not jump at the second and the last but one; elsewhere it does.
        if i == 1 || i == 10 {
            assert!(jump < 1e-9, "{jump} at point {i}");
        } else {
            assert!(jump > 1e-3, "{jump} at point {i}");
        }
    }
}

#[test]
fn spline_converges_with_fourth_order() {
    let error = |n: u32| {
        let times: Vec<f64> = (0..=n).map(|i| 3.0 * f64::from(i) / f64::from(n)).collect();
        let values = times.iter().map(|t| libm::sin(2.0 * t)).collect();
        let spline = Spline::new(times, values).unwrap();
        let at = (0..=1500).map(|i| 3.0 * f64::from(i) / 1500.0);
        at.fold(0.0, |m: f64, t| {
            m.max((spline.evaluate(t)[0] - libm::sin(2.0 * t)).abs())
        })
    };
    let errors = [20, 40, 80, 160].map(error);
    for pair in errors.windows(2) {
        let order = (pair[0] / pair[1]).log2();
        assert!((3.8..4.6).contains(&order), "order {order}, errors {errors:?}");
    }
    assert!(errors[3] < 1e-7);
}

#[test]
fn spline_errors() {
    let new = |x: &[f64], y: &[f64]| Spline::new(x.to_vec(), y.to_vec());
    assert_eq!(
        new(&[0.0, 1.0, 2.0], &[0.0; 3]),
        Err(SplineError::TooFew { got: 3 })
    );
    assert_eq!(
        new(&[0.0, 1.0, 2.0, 3.0], &[0.0; 5]),
        Err(SplineError::Unequal {
            abscissae: 4,
            ordinates: 5
        })
    );
    for (x, value) in [([0.0, 2.0, 1.0, 3.0], 1.0), ([0.0, 2.0, 2.0, 3.0], 2.0)] {
        assert_eq!(
            new(&x, &[0.0; 4]),
            Err(SplineError::NotIncreasing {
                index: 3,
                value,
                previous: 2.0
            })
        );
    }
    for bad in [f64::NAN, f64::INFINITY] {
        assert_eq!(
            new(&[0.0, bad, 2.0, 3.0], &[0.0; 4]),
            Err(SplineError::NotFinite { index: 2 })
        );
        assert_eq!(
            new(&[0.0, 1.0, 2.0, 3.0], &[0.0, 0.0, 0.0, bad]),
            Err(SplineError::NotFinite { index: 4 })
        );
    }
    assert!(new(&[0.0, 1.0, 2.0, 3.0], &[0.0; 4]).is_ok());
}

// Friction

#[test]
fn tanh_limits_and_smoothness() {
    let (limit, v0) = (30.0, 0.02);
    let mut random = Random(2);
    for _ in 0..500 {
        let v: [f64; 2] = random.vector(0.1);
        let speed = norm(&v);
        let one = tanh::friction(limit, v0, v);
        let size = limit * (speed / v0).tanh();
        for k in 0..2 {
            close(one.force[k], -size * v[k] / speed, 1e-12);
        }
        close(one.loss, size * speed, 1e-12);
        assert_eq!(one.sticks, speed < v0);
        close(one.load, speed / v0, 1e-13);
    }
    // Far beyond the reference speed: the limit, against the velocity; never above it.
    let fast = tanh::friction(limit, v0, [-3.0, 4.0]);
    close(fast.force[0], 18.0, 1e-13);
    close(fast.force[1], -24.0, 1e-13);
    // A dashpot limit/v0 at small velocity, without a jump in value or slope; exactly zero at rest.
    assert_eq!(
        tanh::friction(limit, v0, [0.0, 0.0]).force.map(f64::abs),
        [0.0; 2]
    );
    for v in [1e-300, 1e-20, 1e-9, 1e-7] {
        let force = tanh::friction(limit, v0, [v, 0.0]).force[0];
        close(force / v, -limit / v0, 1e-9 * limit / v0);
    }
    // Value and slope where the series near zero ends (|v|/v0 = sqrt(1e-3)), on both sides of it.
    let edge = v0 * 1e-3f64.sqrt();
    for v in [0.3, 0.999, 1.0 - 1e-12, 1.0 + 1e-12, 1.001, 3.0].map(|factor| factor * edge) {
        let one = tanh::friction(
            Dual::from(limit),
            v0,
            [Dual::<1>::variable(v, 0), Dual::from(0.0)],
        );
        let t = (v / v0).tanh();
        close(one.force[0].value, -limit * t, 1e-14);
        close(one.force[0].derivative[0], -limit / v0 * (1.0 - t * t), 1e-10);
    }
}

#[test]
fn tanh_never_adds_energy() {
    let mut random = Random(3);
    for _ in 0..20_000 {
        let limit = random.between(0.0, 1e5);
        let v0 = 10f64.powf(random.between(-6.0, 0.0));
        let v = random.vector::<2>(1.0).map(|v| v * 10f64.powf(-4.0));
        let one = tanh::friction(limit, v0, v);
        assert!(one.loss >= 0.0);
        assert!(one.force[0] * v[0] + one.force[1] * v[1] <= 0.0);
        assert!(norm(&one.force) <= limit * (1.0 + 1e-15));
        close(
            one.loss,
            -(one.force[0] * v[0] + one.force[1] * v[1]),
            1e-14 * one.loss,
        );
    }
}

#[test]
fn bristle_is_continuous_where_it_begins_to_slip() {
    let (limit, stiffness, damping) = (30.0, 4e4, 90.0);
    let mut random = Random(4);
    for _ in 0..1000 {
        let v: [f64; 2] = random.vector(0.5);
        let angle = random.between(0.0, 2.0 * PI);
        // T = K e + C v with |T| = μN (1 ± tiny)
        let deflection = |factor: f64| {
            let trial = [limit * factor * angle.cos(), limit * factor * angle.sin()];
            [0, 1].map(|k| (trial[k] - damping * v[k]) / stiffness)
        };
        let inside = bristle::friction(limit, stiffness, damping, v, deflection(1.0 - 1e-9));
        let outside = bristle::friction(limit, stiffness, damping, v, deflection(1.0 + 1e-9));
        assert!(inside.sticks && !outside.sticks);
        for k in 0..2 {
            close(inside.force[k], outside.force[k], 1e-6);
            close(inside.rate[k], outside.rate[k], 1e-8);
            close(inside.rate[k], v[k], 0.0);
        }
        close(inside.loss, outside.loss, 1e-6);
        close(inside.load, 1.0 - 1e-9, 1e-12);
        close(outside.load, 1.0 + 1e-9, 1e-12);
    }
}

#[test]
fn bristle_losses_and_forces() {
    let mut random = Random(5);
    let mut both = [0; 2];
    for _ in 0..20_000 {
        let stiffness = 10f64.powf(random.between(2.0, 8.0));
        let damping = 10f64.powf(random.between(0.0, 5.0));
        let limit = 10f64.powf(random.between(-1.0, 5.0));
        let v: [f64; 2] = random.vector(2.0 * limit / damping);
        let e: [f64; 2] = random.vector(2.0 * limit / stiffness);
        let one = bristle::friction(limit, stiffness, damping, v, e);
        both[usize::from(one.sticks)] += 1;
        // F·v = -d/dt (K e²/2) - loss
        let power = one.force[0] * v[0] + one.force[1] * v[1];
        let stored = stiffness * (e[0] * one.rate[0] + e[1] * one.rate[1]);
        let size = power.abs() + stored.abs() + one.loss;
        close(power, -stored - one.loss, 1e-13 * size);
        assert!(one.loss >= 0.0);
        assert!(norm(&one.force) <= limit * (1.0 + 1e-14));
        // The defining equations.
        let trial = [0, 1].map(|k| stiffness * e[k] + damping * v[k]);
        if norm(&trial) <= limit {
            assert!(one.sticks);
            assert_eq!(one.rate, v);
            for k in 0..2 {
                close(one.force[k], -trial[k], 1e-15 * limit);
            }
        } else {
            assert!(!one.sticks);
            for k in 0..2 {
                let slider = limit * trial[k] / norm(&trial);
                close(one.force[k], -slider, 1e-13 * limit);
                close(
                    damping * one.rate[k],
                    slider - stiffness * e[k],
                    1e-13 * (limit + stiffness * e[k].abs()),
                );
            }
        }
    }
    assert!(both[0] > 1000 && both[1] > 1000);
    // No limit: no force, the bristle relaxes.
    let open = bristle::friction(0.0, 100.0, 5.0, [1.0, -2.0], [0.3, 0.4]);
    assert_eq!(open.force.map(f64::abs), [0.0; 2]);
    close(open.rate[0], -6.0, 1e-14);
    close(open.rate[1], -8.0, 1e-14);
    close(open.loss, 5.0 * 100.0, 1e-12);
}

#[test]
fn creep_speeds_of_the_laws() {
    let tanh_law = FrictionLaw::Tanh {
        reference_speed: 0.02,
    };
    for load in [0.0, 0.1, 0.5, 0.9, 0.999] {
        let speed = tanh_law.creep_speed(load);
        // At this speed the law carries this load.
        close(-tanh::friction(1.0, 0.02, [speed, 0.0]).force[0], load, 1e-13);
    }
    // 1/2 ln 3 v0 at half the limit
    close(tanh_law.creep_speed(0.5), 0.02 * 0.549_306_144_334_054_8, 1e-16);
    let bristle = FrictionLaw::Bristle {
        stiffness: 1e6,
        damping: 1e3,
    };
    assert_eq!(bristle.creep_speed(0.9), 0.0);
    assert_eq!(tanh_law.states_per_point(), 0);
    assert_eq!(bristle.states_per_point(), 2);
}

// Contact

fn seen_from_origin(position: [f64; 3], velocity: [f64; 3], omega: [f64; 3]) -> Relative<f64> {
    Relative {
        position: Vector(position),
        rotation: Matrix::identity(),
        velocity: Vector(velocity),
        angular_velocity: Vector(omega),
    }
}

#[test]
fn normal_force_of_a_contact() {
    let (k, c) = (5e4, 300.0);
    let mut random = Random(6);
    let (mut lifted, mut open, mut pushed) = (0, 0, 0);
    let law = FrictionLaw::Tanh {
        reference_speed: 0.01,
    };
    for damping in [0.0, c] {
        let one = face("f", &[[0.0; 3]], k, damping, 0.3, law);
        for _ in 0..2000 {
            let gap = random.between(-0.01, 0.005);
            let velocity: [f64; 3] = random.vector(2.0);
            let relative = seen_from_origin([gap, 0.3, -0.2], velocity, [0.0; 3]);
            let mut contacts = Vec::new();
            let sum = one.evaluate(&relative, &[], |_, contact| contacts.push(*contact));
            if gap >= 0.0 {
                open += 1;
                assert!(contacts.is_empty());
                assert_eq!(sum.force.0, [0.0; 3]);
                continue;
            }
            let [contact] = contacts[..] else {
                panic!("one point")
            };
            let normal = (-k * gap - damping * velocity[0]).max(0.0);
            close(contact.normal, normal, 1e-11);
            assert!(contact.normal >= 0.0, "contact must not pull");
            close(sum.force.0[0], normal, 1e-11);
            close(
                norm(&contact.friction.force),
                0.3 * normal * (norm(&velocity[1..]) / 0.01).tanh(),
                1e-9,
            );
            // Power of the normal force = - d/dt (k g²/2) - loss, and nothing is won.
            let stored = k * gap * velocity[0];
            close(
                normal * velocity[0],
                -stored - contact.damping_loss,
                1e-12 * (stored.abs() + (normal * velocity[0]).abs()),
            );
            assert!(contact.damping_loss >= 0.0);
            if damping == 0.0 {
                assert_eq!(contact.damping_loss, 0.0);
            }
            lifted += i32::from(normal == 0.0);
            pushed += i32::from(normal > 0.0);
        }
    }
    assert!(lifted > 50 && open > 500 && pushed > 500);
}

#[test]
fn moment_of_a_contact_about_the_body() {
    let mut random = Random(7);
    let law = FrictionLaw::Tanh {
        reference_speed: 0.01,
    };
    let points = [[0.1, 0.2, 0.3], [-0.1, 0.4, -0.2], [0.05, -0.3, 0.1]];
    let one = face("f", &points, 1e4, 10.0, 0.3, law);
    for _ in 0..50 {
        let relative = seen_from_origin([-0.5, 0.1, 0.2], random.vector(1.0), random.vector(1.0));
        let (mut force, mut moment) = ([0.0; 3], [0.0; 3]);
        let sum = one.evaluate(&relative, &[], |i, contact| {
            let f = [
                contact.normal,
                contact.friction.force[0],
                contact.friction.force[1],
            ];
            force = add(force, f);
            moment = add(moment, cross(points[i], f));
            // Velocity of a point of the body: v + ω × r.
            let v = add(relative.velocity.0, cross(relative.angular_velocity.0, points[i]));
            close(contact.gap_rate, v[0], 1e-14);
            close(contact.slip[0], v[1], 1e-14);
            close(contact.slip[1], v[2], 1e-14);
            close(contact.gap, -0.5 + points[i][0], 1e-15);
        });
        assert!(norm(&force) > 1.0);
        for k in 0..3 {
            close(sum.force.0[k], force[k], 1e-10);
            close(sum.moment.0[k], moment[k], 1e-10);
        }
    }
}

/// A plate that turns at a constant rate about an arbitrary axis, under a body that turns and moves: place, gap rate and
/// slip of a point.
#[test]
fn surface_velocity_of_a_turning_plate() {
    let mut random = Random(8);
    for case in 0..40 {
        let spin = random.between(-5.0, 5.0);
        let angles: [f64; 3] = random.vector(1.0);
        // The base's z axis is the axis of rotation: Ry(pitch) Rz(yaw) Rx(roll) z.
        let turned = |v: [f64; 3]| {
            let v = rodrigues([1.0, 0.0, 0.0], angles[0], v);
            let v = rodrigues([0.0, 0.0, 1.0], angles[2], v);
            rodrigues([0.0, 1.0, 0.0], angles[1], v)
        };
        let axis = turned([0.0, 0.0, 1.0]);
        let origin: [f64; 3] = random.vector(1.0);
        let drift = random.between(-1.0, 1.0);
        let mut frame = Frame::fixed(origin, angles);
        let straight = |rate: f64| Motion::Ramp {
            amplitude: 1000.0 * rate,
            start: 0.0,
            duration: 1000.0,
            profile: RampProfile::Linear,
        };
        frame.motions[5] = straight(spin);
        frame.motions[0] = straight(drift);
        let plate = Body::prescribed("plate", frame);
        let initial: [f64; 6] = random.vector(0.5);
        let probe = body("probe", 1.0, [1.0; 3], [0.0; 3], ALL, initial);
        let tip: [f64; 3] = random.vector(0.5);
        let mount: [f64; 3] = random.vector(0.4);
        let mut parts = model(vec![plate, probe], [0.0; 3]);
        let law = FrictionLaw::Tanh {
            reference_speed: 0.01,
        };
        // Half of the cases: the plate's normal is the axis of rotation.
        let mount_angles = if case % 2 == 0 { UP } else { random.vector(1.0) };
        parts.faces.push((
            1,
            0,
            Mount::new(mount, mount_angles),
            face("f", &[tip], 1e3, 0.0, 0.5, law),
        ));
        let mut system = System::new(parts).unwrap();
        let time = 0.7;
        system.segment(time);
        let mut x = system.initial_state();
        let yaw_rate = random.between(-2.0, 2.0);
        let glide: [f64; 3] = random.vector(1.0);
        x[6..9].copy_from_slice(&glide);
        x[11] = yaw_rate;
        let seen = system.observe(time, &x);
        // In closed form. The probe turns about Ry(pitch) z.
        let own = rodrigues([1.0, 0.0, 0.0], initial[3], tip);
        let own = rodrigues([0.0, 0.0, 1.0], initial[5], own);
        let arm = rodrigues([0.0, 1.0, 0.0], initial[4], own);
        let place = add([initial[0], initial[1], initial[2]], arm);
        let yaw_axis = rodrigues([0.0, 1.0, 0.0], initial[4], [0.0, 0.0, 1.0]);
        let velocity = add(glide, cross(times(yaw_axis, yaw_rate), arm));
        let moved = add(origin, times(turned([1.0, 0.0, 0.0]), drift * time));
        let from_axis = add(place, times(moved, -1.0));
        let surface = add(
            times(turned([1.0, 0.0, 0.0]), drift),
            cross(times(axis, spin), from_axis),
        );
        let expected = add(velocity, times(surface, -1.0));
        let state = &seen.faces[0];
        let point = &state.points[0];
        let got = state
            .axes
            .apply::<f64, f64>(Vector([point.gap_rate, point.slip[0], point.slip[1]]));
        for k in 0..3 {
            close(got.0[k], expected[k], 1e-13);
            close(state.places[0].0[k], place[k], 1e-13);
        }
        if case % 2 == 0 {
            let along: f64 = (0..3).map(|k| expected[k] * axis[k]).sum();
            close(point.gap_rate, along, 1e-13);
            close(
                norm(&point.slip),
                norm(&add(expected, times(axis, -along))),
                1e-13,
            );
        }
    }
}

/// Slip speed of a fixed point above a spinning disc: Ω times the distance from the axis.
#[test]
fn slip_speed_on_a_disc() {
    let mut frame = Frame::fixed([0.0; 3], [0.0; 3]);
    frame.motions[5] = Motion::Ramp {
        amplitude: 3000.0,
        start: 0.0,
        duration: 1000.0,
        profile: RampProfile::Linear,
    };
    let mut parts = model(
        vec![
            body(
                "probe",
                1.0,
                [1.0; 3],
                [0.0; 3],
                [false, false, true, false, false, false],
                [0.3, 0.4, -0.01, 0.0, 0.0, 0.0],
            ),
            Body::prescribed("disc", frame),
        ],
        [0.0; 3],
    );
    let law = FrictionLaw::Tanh {
        reference_speed: 1e-3,
    };
    parts.faces.push((
        0,
        1,
        Mount::new([0.0; 3], UP),
        face("f", &[[0.0; 3]], 1e3, 0.0, 0.5, law),
    ));
    let mut system = System::new(parts).unwrap();
    system.segment(0.0);
    let x = system.initial_state();
    for time in [0.0, 0.4, 1.3] {
        let seen = system.observe(time, &x);
        close(norm(&seen.faces[0].points[0].slip), 3.0 * 0.5, 1e-13);
        close(seen.faces[0].points[0].gap, -0.01, 1e-15);
        // Friction takes the point along with the disc: ω × r = 3 (-0.4, 0.3).
        let force = seen.faces[0].friction_forces[0].0;
        close(force[0], -0.8 * 0.5 * 10.0, 1e-12);
        close(force[1], 0.6 * 0.5 * 10.0, 1e-12);
        // The disc's motor delivers what friction loses: μN v.
        let dx = common::rates(&mut system, time, &x);
        close(dx[2], 5.0 * 1.5, 1e-12);
        close(dx[3], 5.0 * 1.5, 1e-12);
    }
}

// Coil

fn stiff_table() -> CoilLaw {
    let points = vec![[-0.02, -10.0], [0.0, 5.0], [0.05, 60.0], [0.06, 260.0]];
    CoilLaw::Table(Characteristic::new(points).unwrap())
}

/// Force along the coil at a length.
fn push(coil: &Coil, length: f64) -> f64 {
    let relative = seen_from_origin([0.6 * length, 0.0, 0.8 * length], [0.0; 3], [0.0; 3]);
    let force = coil.evaluate(&relative);
    close(force.length, length, 1e-15);
    close(force.force.0[0], 0.6 * force.spring, 1e-11);
    close(force.force.0[2], 0.8 * force.spring, 1e-11);
    force.spring
}

#[test]
fn force_of_a_coil_is_the_slope_of_its_energy() {
    for law in [CoilLaw::Linear { stiffness: 4000.0 }, stiff_table()] {
        for pulls in [true, false] {
            let mut one = coil([0.0; 3], [0.0; 3], 0.0, 0.3);
            (one.law, one.pulls) = (law.clone(), pulls);
            // From beyond the table on one side to beyond it on the other; not on its corners.
            for i in 0..60 {
                let length = 0.2 + 0.003_11 * f64::from(i);
                let slope = difference(1e-7, |d| vec![one.energy(length + d)])[0];
                close(push(&one, length), -slope, 1e-5);
                if !pulls {
                    assert!(push(&one, length) >= 0.0);
                }
            }
            if matches!(law, CoilLaw::Linear { .. }) || pulls {
                close(one.energy(0.3), 0.0, 1e-15);
            }
            // Energy is continuous, and never below that of the slack coil.
            let slack = one.energy(0.5);
            for i in 0..2000 {
                let length = 0.2 + 0.0001 * f64::from(i);
                let step = one.energy(length + 0.0001) - one.energy(length);
                // The largest force is 260 + 20000 · 0.04 N.
                assert!(step.abs() <= 0.0001 * 1060.0);
                if !pulls {
                    assert!(one.energy(length) >= slack - 1e-12);
                }
            }
        }
    }
}

#[test]
fn coil_forces_in_numbers() {
    let linear = coil([0.0; 3], [0.0; 3], 4000.0, 0.3);
    close(push(&linear, 0.25), 200.0, 1e-10);
    close(push(&linear, 0.35), -200.0, 1e-10);
    close(linear.energy(0.25), 5.0, 1e-12);
    let mut table = linear.clone();
    table.law = stiff_table();
    // Compressions -0.04 (beyond: 15/0.02 = 750 N/m), -0.01, 0.02, 0.055, 0.08 (beyond: 20000 N/m)
    for (compression, force) in [
        (-0.04, -25.0),
        (-0.01, -2.5),
        (0.02, 27.0),
        (0.055, 160.0),
        (0.08, 660.0),
    ] {
        close(push(&table, 0.3 - compression), force, 1e-9);
    }
    // Trapezoids: 0.05 (5+60)/2, and from there on 0.01 (60+260)/2
    close(table.energy(0.25), 1.625, 1e-12);
    close(table.energy(0.24), 1.625 + 1.6, 1e-12);
    close(table.energy(0.32), 0.05, 1e-12);
    let mut slack = linear.clone();
    slack.pulls = false;
    close(push(&slack, 0.35), 0.0, 0.0);
    close(push(&slack, 0.25), 200.0, 1e-10);
    let mut slack_table = table.clone();
    slack_table.pulls = false;
    close(push(&slack_table, 0.32), 0.0, 0.0);
    // The force comes to zero at a compression of -1/150; what it stores up to zero compression is 5²/(2·750).
    close(slack_table.energy(0.4), -25.0 / 1500.0, 1e-12);
}

#[test]
fn damping_and_line_of_action_of_a_coil() {
    let mut random = Random(9);
    for _ in 0..200 {
        let (end, cg): ([f64; 3], [f64; 3]) = (random.vector(0.3), random.vector(0.3));
        let place = add(random.vector(0.3), [0.0, 0.0, 2.0]);
        let (velocity, omega): ([f64; 3], [f64; 3]) = (random.vector(1.0), random.vector(1.0));
        let relative = seen_from_origin(place, velocity, omega);
        let mut at_end = coil(end, end, 4000.0, 1.9);
        (at_end.damping, at_end.rotational_damping) = (70.0, 9.0);
        let mut through_cg = at_end.clone();
        through_cg.acts_at = Vector(cg);
        let d = add(place, end);
        let rate = add(velocity, cross(omega, end));
        let expected: [f64; 3] =
            std::array::from_fn(|k| 4000.0 * (1.9 - norm(&d)) * d[k] / norm(&d) - 70.0 * rate[k]);
        for (one, at) in [(&at_end, end), (&through_cg, cg)] {
            let got = one.evaluate(&relative);
            // No moment about the point where it acts, but for the brake.
            let moment = add(cross(at, expected), times(omega, -9.0));
            for k in 0..3 {
                close(got.force.0[k], expected[k], 1e-10);
                close(got.moment.0[k], moment[k], 1e-10);
            }
            let spring_power =
                -4000.0 * (norm(&d) - 1.9) * (0..3).map(|k| d[k] * rate[k]).sum::<f64>() / norm(&d);
            close(
                got.loss,
                70.0 * norm(&rate).powi(2) + 9.0 * norm(&omega).powi(2),
                1e-10,
            );
            // Power on the body = spring's - loss + guide's.
            let power: f64 = (0..3)
                .map(|k| got.force.0[k] * velocity[k] + got.moment.0[k] * omega[k])
                .sum();
            close(power, spring_power - got.loss + got.guide_power, 1e-9);
        }
        assert_eq!(at_end.evaluate(&relative).guide_power, 0.0);
    }
}

// The massless wedge

const LEGS: [(f64, f64); 2] = [(32.0, 3000.0), (37.5, 3702.2)];

fn wedge(angle: f64, toe: f64, column: f64, slope: f64) -> QuasiStaticWedge {
    QuasiStaticWedge {
        angle: angle * PI / 180.0,
        toe: toe * PI / 180.0,
        column_friction: column,
        slope_friction: slope,
    }
}

#[test]
fn massless_wedge_with_toe_out() {
    // Down: N_c, μN_c; up: N_c, μN_c; lbf (the formulas have no units).
    let numbers = [
        [
            (0.2, [3087.1, 1234.8, 5144.6, 2057.8]),
            (0.0, [3104.3, 1241.7, 5173.3, 2069.3]),
            (-0.2, [3121.8, 1248.7, 5202.4, 2080.9]),
        ],
        [
            (0.2, [2869.7, 1147.9, 5411.3, 2164.5]),
            (0.0, [2882.7, 1153.1, 5435.9, 2174.4]),
            (-0.2, [2895.9, 1158.4, 5460.8, 2184.3]),
        ],
    ];
    for ((angle, force), rows) in LEGS.into_iter().zip(numbers) {
        for (toe, [down, down_friction, up, up_friction]) in rows {
            let one = wedge(angle, toe, 0.4, 0.4);
            let down_found = one
                .slide(Direction::Down, SlopeFriction::DownSlope, force)
                .unwrap();
            let up_found = one.slide(Direction::Up, SlopeFriction::UpSlope, force).unwrap();
            close(down_found.column_normal, down, 0.05);
            close(down_found.column_friction, down_friction, 0.05);
            close(up_found.column_normal, up, 0.05);
            close(up_found.column_friction, up_friction, 0.05);
        }
    }
}

#[test]
fn massless_wedge_with_toe_in() {
    for ((angle, force), (normal, friction)) in LEGS.into_iter().zip([(1699.9, 680.0), (1777.2, 710.9)]) {
        let one = wedge(angle, -0.2, 0.4, 0.4);
        let up = one.slide(Direction::Up, SlopeFriction::DownSlope, force).unwrap();
        close(up.column_normal, normal, 0.05);
        close(up.column_friction, friction, 0.05);
        assert_eq!(
            one.slide(Direction::Down, SlopeFriction::UpSlope, force),
            None,
            "it jams"
        );
    }
}

#[test]
fn massless_wedge_on_a_frictionless_slope() {
    for ((angle, force), (down, up)) in LEGS.into_iter().zip([(13341.0, 2927.0), (10079.0, 3171.5)]) {
        let one = wedge(angle, 0.0, 0.4, 0.0);
        for slope in [SlopeFriction::UpSlope, SlopeFriction::DownSlope] {
            let found = |direction| one.slide(direction, slope, force).unwrap().column_normal;
            close(found(Direction::Down), down, 0.5);
            close(found(Direction::Up), up, if angle == 32.0 { 0.5 } else { 0.05 });
            // N = F / (tan θ - a μ)
            let t = one.angle.tan();
            close(found(Direction::Down), force / (t - 0.4), 1e-6);
            close(found(Direction::Up), force / (t + 0.4), 1e-6);
        }
    }
}

#[test]
fn branches_and_jam() {
    use Direction::{Down, Up};
    use SlopeFriction::{DownSlope, UpSlope};
    for (toe, down, up) in [
        (0.2, DownSlope, UpSlope),
        (0.0, DownSlope, UpSlope),
        (-0.2, UpSlope, DownSlope),
    ] {
        let one = wedge(32.0, toe, 0.4, 0.4);
        assert_eq!((one.branch(Down), one.branch(Up)), (down, up));
    }
    for (angle, critical) in [(32.0, 0.287), (37.5, 0.339)] {
        let value = wedge(angle, 0.0, 0.4, 0.4).critical_friction();
        close(value, critical, 0.0005);
        let jams = |mu: f64| wedge(angle, 0.0, mu, mu).slide(Down, UpSlope, 1.0).is_none();
        assert!(!jams(value * (1.0 - 1e-9)) && jams(value * (1.0 + 1e-9)));
        let margin = |mu: f64| wedge(angle, 0.0, mu, mu).jam_margin(Down, UpSlope);
        close(margin(value), 0.0, 1e-15);
        assert!(margin(0.9 * value) > 0.0 && margin(1.1 * value) < 0.0);
    }
}

/// Force balance of the wedge, with the contact forces along normals and tangents, solved as two linear equations.
#[test]
fn massless_wedge_in_force_balance() {
    let mut random = Random(10);
    let (mut sliding, mut jammed) = (0, 0);
    for _ in 0..5000 {
        let one = QuasiStaticWedge {
            angle: random.between(0.2, 1.2),
            toe: random.between(-0.02, 0.02),
            column_friction: random.between(0.0, 0.8),
            slope_friction: random.between(0.0, 0.8),
        };
        let force = random.between(100.0, 5000.0);
        for direction in [Direction::Down, Direction::Up] {
            for slope in [SlopeFriction::UpSlope, SlopeFriction::DownSlope] {
                let (st, ct) = one.angle.sin_cos();
                let (sp, cp) = one.toe.sin_cos();
                // The bolster takes the wedge along: friction of the column acts up while it moves down.
                let up = if direction == Direction::Down { 1.0 } else { -1.0 };
                let along = if slope == SlopeFriction::UpSlope {
                    1.0
                } else {
                    -1.0
                };
                // Columns: force per normal force on the column (normal (cos φ, -sin φ), upwards (sin φ, cos φ))
                // and on the slope (normal (-cos θ, -sin θ), upwards (-sin θ, cos θ)).
                let (mc, ms) = (up * one.column_friction, along * one.slope_friction);
                let column = [cp + mc * sp, -sp + mc * cp];
                let incline = [-ct - ms * st, -st + ms * ct];
                let determinant = column[0] * incline[1] - column[1] * incline[0];
                let normal = incline[0] * force / determinant;
                let slope_normal = -column[0] * force / determinant;
                match one.slide(direction, slope, force) {
                    Some(found) => {
                        sliding += 1;
                        let size = normal.abs() + slope_normal.abs();
                        close(found.column_normal, normal, 1e-9 * size);
                        close(found.slope_normal, slope_normal, 1e-9 * size);
                        close(found.column_friction, one.column_friction * normal, 1e-9 * size);
                        assert!(found.column_normal >= 0.0 && found.slope_normal >= 0.0);
                    }
                    None => {
                        jammed += 1;
                        assert!(
                            normal < 0.0 || slope_normal < 0.0,
                            "{one:?} {direction:?} {slope:?}"
                        );
                    }
                }
            }
        }
    }
    assert!(sliding > 1000 && jammed > 100);
}

#[test]
fn places_and_masses_of_prescribed_bodies() {
    // A prescribed body's mass has no effect: also not on the energies.
    let mut frame = Frame::fixed([1.0, 2.0, 3.0], [0.0; 3]);
    frame.motions[0] = sine();
    let light = Body::prescribed("base", frame);
    let heavy = Body {
        mass: 50.0,
        inertia: [1.0, 2.0, 3.0],
        ..light.clone()
    };
    let probe = body("probe", 1.0, [1.0; 3], [0.0; 3], ALL, [0.0; 6]);
    let [without, with] = [light, heavy].map(|base| {
        let mut system = System::new(model(vec![probe.clone(), base, ground()], [0.0, 0.0, -9.8])).unwrap();
        system.segment(0.0);
        let x = system.initial_state();
        let seen = system.observe(0.4, &x);
        close(
            seen.bodies[1].travel.0[0],
            0.7 * (2.3f64 * 0.4 + 0.4).sin(),
            1e-15,
        );
        seen.energies
    });
    assert_eq!(without, with);
}
