//! Motions and splines.

use super::*;

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

pub fn sine() -> Motion {
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
        ramp(RampProfile::HalfCosine),
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
    let cosine = ramp(RampProfile::HalfCosine);
    close(at(&cosine, 0.5 + 1.25 / 3.0)[0], -0.7 * 0.25, 1e-15);
    assert_eq!([at(&cosine, 0.4)[0], at(&cosine, 1.8)[0]], [0.0, -0.7]);
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
    close(system.next_time_discontinuity(0.0), corner, 1e-15);
    let observation = system.observe(corner, &x);
    close(observation.bodies[1].velocity.0[2], rate, 1e-14);
    close(system.next_time_discontinuity(corner), 3.0 * corner, 1e-14);
    let observation = system.observe(corner, &x);
    close(observation.bodies[1].velocity.0[2], -rate, 1e-14);
    // A copy takes the side from the other.
    let mut copy = System::new(model(system.bodies().to_vec(), [0.0; 3])).unwrap();
    copy.next_time_discontinuity(0.0);
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
        // Not a knot: the third derivative does not jump at the second and the last but one; elsewhere it
        // does.
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

/// A table whose rows are next to each other was taken, and its curvatures were no numbers.
#[test]
fn issue_029_points_too_close_to_each_other_make_no_spline() {
    let close = vec![0.0, 1e-311, 0.5, 1.0];
    let found = Spline::new(close, vec![0.0, 0.5, 0.7, 0.0]);
    assert!(matches!(found, Err(SplineError::Steep { .. })), "{found:?}");
}
