//! limits: continuity of contact forces, their work on closed paths, derailed wheels.

use crate::common;
use common::{RADIUS, VELOCITIES, conformal_pair, freight_pair, height, law, motion, six};
use wheelrail::contact::{ContactLaw, CreepLaw, Side, WheelMotion, WheelPose};
use wheelrail::creep::polach;

/// Forces are continuous where patches appear, merge and part: halving the step halves the largest change.
#[test]
fn limits_forces_are_continuous_over_lateral_shifts() {
    let conformal = conformal_pair();
    let freight = freight_pair();
    for (pair, range) in [(&conformal, [-6.5e-3, -5.0e-3]), (&freight, [9.5e-3, 1.142e-2])] {
        let law = law(CreepLaw::Polach(polach::DRY));
        for (overlap, yaw) in [(5e-5, 0.0), (1.5e-4, 4e-3)] {
            let mut several = false;
            // The height follows the touching at the beginning in a straight line.
            let [begin, end] = [0.0, 1e-4].map(|by| height(pair, [range[0] + by, overlap, yaw, 0.0]));
            let rise = (end - begin) / 1e-4;
            let mut largest = |count: usize| {
                let mut before: Option<[f64; 6]> = None;
                let mut most: f64 = 0.0;
                for i in 0..=count {
                    let lateral = range[0] + (range[1] - range[0]) * i as f64 / count as f64;
                    let z = begin + rise * (lateral - range[0]);
                    let pose = WheelPose::of(Side::Left, [lateral, z], yaw, 0.0);
                    let mut count = 0;
                    let found = law.on_wheel(pair, Side::Left, &pose, &motion(VELOCITIES), |_, _| count += 1);
                    several |= count > 1;
                    let own = six(&found);
                    if let Some(before) = before {
                        for (a, b) in own.iter().zip(before) {
                            most = most.max((a - b).abs());
                        }
                    }
                    before = Some(own);
                }
                most
            };
            let [coarse, fine] = [4000, 16000].map(&mut largest);
            assert!(
                coarse > 0.0 && fine < 0.3 * coarse,
                "{overlap} {yaw}: {coarse} {fine}"
            );
            assert!(several, "no place with several patches");
        }
    }
}

/// Round a closed path of lateral place and height the normal forces do little work: the part of the
/// contact's energy that does not come back.
#[test]
fn limits_little_work_is_lost_on_a_closed_path() {
    let pair = freight_pair();
    let law = ContactLaw {
        damping: 0.0,
        ..law(CreepLaw::Frictionless)
    };
    let still = WheelMotion {
        velocity: [0.0; 3],
        angular_velocity: [0.0; 3],
    };
    let middle = [-3e-3, height(&pair, [-3e-3, 1e-4, 0.0, 0.0])];
    let count = 2000;
    let (mut work, mut turned) = (0.0, 0.0);
    for i in 0..count {
        let angle = std::f64::consts::TAU * (f64::from(i) + 0.5) / f64::from(count);
        let place = [
            middle[0] + 2e-3 * angle.cos(),
            middle[1] + 5e-5 * angle.sin() - 1e-4 * angle.cos(),
        ];
        let pose = WheelPose::of(Side::Left, place, 0.0, 0.0);
        let force = law.on_wheel(&pair, Side::Left, &pose, &still, |_, _| {}).force;
        let step = std::f64::consts::TAU / f64::from(count);
        let rates = [-2e-3 * angle.sin(), 5e-5 * angle.cos() + 1e-4 * angle.sin()];
        let own = (force[1] * rates[0] + force[2] * rates[1]) * step;
        work += own;
        turned += own.abs();
    }
    assert!(work.abs() < 0.01 * turned, "{work} J of {turned} J");
}

/// Wheels above the rail, beside it, far below, or turned over: results, never a failure.
#[test]
fn limits_derailed_wheels_are_results() {
    let pair = freight_pair();
    let law = law(CreepLaw::Polach(polach::DRY));
    for (lateral, z, yaw, roll) in [
        (0.0, RADIUS + 0.2, 0.0, 0.0),
        (0.5, RADIUS, 0.0, 0.0),
        (-0.5, RADIUS, 0.0, 0.0),
    ] {
        let pose = WheelPose::of(Side::Left, [lateral, z], yaw, roll);
        assert!(pair.patches_at(&pose).is_empty());
    }
    assert!(
        pair.touch(&WheelPose::of(Side::Left, [0.5, RADIUS], 0.0, 0.0))
            .is_none()
    );
    // The tip of the flange on the rail's head: level contact, 1 in above the tread's height.
    let on_tip = WheelPose::of(Side::Left, [0.06, RADIUS + 0.0254 - 1e-4], 0.0, 0.0);
    let found = pair.patches_at(&on_tip);
    assert_eq!(found.len(), 1);
    assert!(
        found[0].slope.abs() < 0.05 && found[0].profile < -0.05,
        "{found:?}"
    );
    for i in 0..3000 {
        let x = f64::from(i);
        let pose = WheelPose::of(
            Side::Right,
            [0.2 * (1.3 * x).sin(), RADIUS + 0.03 * (0.7 * x).sin()],
            1.5 * (0.37 * x).sin(),
            (0.11 * x).sin(),
        );
        let found = law.on_wheel(&pair, Side::Right, &pose, &motion(VELOCITIES), |_, _| {});
        assert!(six(&found).iter().all(|value| value.is_finite()), "{pose:?}");
    }
}
