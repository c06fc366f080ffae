//! Wheels that are not round: flats, harmonics, profiles that change around them.

use crate::varying_rail::motion;
use std::f64::consts::{PI, TAU};
use std::sync::Arc;

use numerics::scalar::{Dual, Real};
use wheelrail::contact::{
    ContactLaw, ContactPair, ContactTable, CreepLaw, FindPatches, Flat, Harmonic, OutOfRound, Side,
    SlicedWheel, WheelForm, WheelPose, stored_energy,
};
use wheelrail::creep::polach;
use wheelrail::profile::{SlicedProfile, nominal};

use crate::common::{POSES, RADIUS, VELOCITIES, freight_pair, height, law};

const FRESH: Flat = Flat {
    length: 0.05,
    depth: None,
    angle: 0.0,
};

fn flats(all: &[Flat]) -> OutOfRound {
    OutOfRound::new(RADIUS, all.to_vec(), Vec::new()).unwrap()
}

fn harmonics(all: &[(u32, f64, f64)]) -> OutOfRound {
    let own = all.iter().map(|(order, amplitude, angle)| Harmonic {
        order: *order,
        amplitude: *amplitude,
        angle: *angle,
    });
    OutOfRound::new(RADIUS, Vec::new(), own.collect()).unwrap()
}

fn under(form: &OutOfRound) -> ContactPair {
    freight_pair().under(WheelForm::OutOfRound(Arc::new(form.clone())))
}

/// Nominal wheels around a wheel, each with its radius larger by so much (m).
fn sliced(slices: &[(f64, f64)]) -> SlicedProfile {
    let wheel = nominal::aar_1b().unwrap();
    let made = slices
        .iter()
        .map(|(angle, grown)| (*angle, Arc::new(wheel.moved([0.0, -grown]))));
    SlicedProfile::of_wheels("wheel", made.collect()).unwrap()
}

fn sliced_pair(slices: &[(f64, f64)]) -> ContactPair {
    let wheel = SlicedWheel::new(&sliced(slices), RADIUS).unwrap();
    freight_pair().under(WheelForm::Sliced(Arc::new(wheel)))
}

fn pose_at<S: Real>(angle: S, [y, z, yaw, roll]: [S; 4]) -> WheelPose<S> {
    WheelPose {
        angle,
        ..WheelPose::of(Side::Left, [y, z], yaw, roll)
    }
}

/// The height of the axle of a wheel whose points have these radii, and how far ahead it touches: the
/// outermost point along the direction that is down.
fn lowest(radius: impl Fn(f64) -> f64, angle: f64) -> [f64; 2] {
    let mut best = [f64::NEG_INFINITY, 0.0];
    for k in -200_000..=200_000 {
        let ahead = 1e-6 * f64::from(k);
        let own = radius(angle + ahead);
        let (sine, cosine) = libm::sincos(ahead);
        if own * cosine > best[0] {
            best = [own * cosine, own * sine];
        }
    }
    best
}

/// The depth of a flat of 50 mm of a wheel of 36 in, and the heights and contacts of a wheel with a chord.
#[test]
fn analytic_a_fresh_flat_is_a_chord() {
    // l²/(8 R) to l²/(16 R²); both are 0.68 mm.
    let nearly: f64 = 0.05 * 0.05 / (8.0 * 0.4572);
    assert!((nearly - 0.6835e-3).abs() < 5e-8);
    assert!((FRESH.depth_in(0.4572) / nearly - 1.0).abs() < 8e-4);
    let own = flats(&[FRESH]);
    let half = FRESH.half_angle(RADIUS);
    assert!((own.at(0.0)[0] + FRESH.depth_in(RADIUS)).abs() < 1e-15);
    let chord = |angle: f64| {
        let angle = angle - TAU * (angle / TAU).round();
        match angle.abs() < half {
            true => RADIUS * libm::cos(half) / libm::cos(angle),
            false => RADIUS,
        }
    };
    // The outermost point is looked for in steps of a millionth.
    for angle in [-0.07, -0.054, -0.03, -0.01, -0.003, 0.003, 0.02, 0.05, 0.06, 3.0] {
        let [top, ahead] = lowest(chord, angle);
        let [found, rate, _] = own.at(angle);
        assert!(
            (found - (top - RADIUS)).abs() < 2e-8,
            "{angle}: {found} {}",
            top - RADIUS
        );
        assert!((rate - ahead).abs() < 2e-6, "{angle}: {rate} {ahead}");
    }
    // The blow: the axle's velocity over the angle changes by the length of the flat.
    let edge = 1.0001e-3 / RADIUS;
    let change = own.at(edge)[1] - own.at(-edge)[1];
    assert!((change / (0.05 - 2e-3) - 1.0).abs() < 1e-3, "{change}");
}

/// Harmonics are those of the radius, eccentricity exactly.
#[test]
fn analytic_harmonics_are_those_of_the_radius() {
    for (order, amplitude) in [(1, 2e-3), (3, 3e-4), (20, 1e-4)] {
        let own = harmonics(&[(order, amplitude, 0.4)]);
        let n = f64::from(order);
        let moved = |angle: f64| match order {
            // A circle about a point aside.
            1 => {
                let (sine, cosine) = libm::sincos(angle - 0.4);
                amplitude * cosine + (RADIUS * RADIUS - (amplitude * sine) * (amplitude * sine)).sqrt()
            }
            _ => RADIUS + amplitude * libm::cos(n * (angle - 0.4)),
        };
        let within = if order == 1 {
            1e-9
        } else {
            1.05 * (n * amplitude).powi(2) / (2.0 * RADIUS)
        };
        for angle in [-2.0, 0.0, 0.4, 0.7, 3.1] {
            let [top, _] = lowest(moved, angle);
            let [found, ..] = own.at(angle);
            assert!(
                (found - (top - RADIUS)).abs() < within,
                "{order} {angle}: {found}"
            );
        }
    }
}

/// The wheel's center is lower by the drop, and the normal force gives a moment about the axle: force times
/// the derivative of the height.
#[test]
fn analytic_the_contact_leads_by_the_slope_of_the_height() {
    let own = OutOfRound::new(
        RADIUS,
        vec![
            FRESH,
            Flat {
                length: 0.06,
                depth: Some(4e-4),
                angle: 2.0,
            },
        ],
        vec![Harmonic {
            order: 3,
            amplitude: 2e-4,
            angle: 1.0,
        }],
    )
    .unwrap();
    let (pair, round) = (under(&own), freight_pair());
    let frictionless = law(CreepLaw::Frictionless);
    for angle in [0.0, 0.02, -0.04, 1.97, 2.03, 4.0] {
        let [rise, ahead, _] = own.at(angle);
        let center = height(&round, [0.0, 1e-4, 0.0, 0.0]);
        let pose = pose_at(angle, [0.0, center + rise, 0.0, 0.0]);
        let found = pair.touch(&pose).unwrap();
        assert!((found.overlap - 1e-4).abs() < 1e-12, "{angle}: {}", found.overlap);
        let still = motion([0.0; 6]);
        let forces = frictionless.on_wheel(&pair, Side::Left, &pose, &still, |_, _| ());
        let plain = pose_at(0.0, [0.0, center, 0.0, 0.0]);
        let expected = frictionless.on_wheel(&round, Side::Left, &plain, &still, |_, _| ());
        assert!((forces.force[2] / expected.force[2] - 1.0).abs() < 1e-3);
        let moment = -forces.force[2] * ahead;
        assert!(
            (forces.moment[1] - moment).abs() < 1e-6 * forces.force[2] * 0.025,
            "{angle}"
        );
    }
}

/// Derivatives by the angle and by the pose are those of differences; of slices too, at and between them.
#[test]
fn analytic_derivatives_around_the_wheel() {
    let own = OutOfRound::new(
        RADIUS,
        vec![FRESH],
        vec![Harmonic {
            order: 5,
            amplitude: 1e-4,
            angle: 0.3,
        }],
    );
    let slices = sliced_pair(&[(-2.0, 0.0), (0.0, 3e-4), (0.4, -2e-4), (2.0, 0.0)]);
    let law = law(CreepLaw::Polach(polach::DRY));
    let wrench = |pair: &ContactPair, pose: &WheelPose<Dual<5>>| {
        let found = law.on_wheel(pair, Side::Left, pose, &motion(VELOCITIES), |_, _| ());
        [found.force, found.moment]
    };
    let plain = |pair: &ContactPair, pose: &WheelPose<f64>| {
        let found = law.on_wheel(pair, Side::Left, pose, &motion(VELOCITIES), |_, _| ());
        [found.force, found.moment]
    };
    let cases = [
        (under(&own.unwrap()), [-0.03, -1e-3, 0.04]),
        (slices, [0.3, 0.395, -1.0]),
    ];
    for (pair, angles) in cases {
        for angle in angles {
            for [y, _, yaw, roll] in POSES {
                let trial = RADIUS + 1e-3;
                let touch = pair.touch(&pose_at(angle, [y, trial, yaw, roll])).unwrap();
                let values = [angle, y, trial + touch.overlap - 1e-4, yaw, roll];
                let [a, y, z, yaw, roll] = std::array::from_fn(|i| Dual::variable(values[i], i));
                let exact = wrench(&pair, &pose_at(a, [y, z, yaw, roll]));
                for i in 0..5 {
                    let step = 1e-8;
                    let at = |sign: f64| {
                        let mut moved = values;
                        moved[i] += sign * step;
                        let [angle, y, z, yaw, roll] = moved;
                        plain(&pair, &pose_at(angle, [y, z, yaw, roll]))
                    };
                    let (above, below) = (at(1.0), at(-1.0));
                    let scale = exact[0].map(|own| own.derivative[i].abs());
                    let scale = scale.into_iter().fold(0.0, f64::max);
                    for k in 0..2 {
                        for axis in 0..3 {
                            let difference = (above[k][axis] - below[k][axis]) / (2.0 * step);
                            let own = exact[k][axis].derivative[i];
                            assert!(
                                (own - difference).abs() < 2e-3 * scale,
                                "{angle} variable {i}: {own} {difference} of {scale}"
                            );
                        }
                    }
                }
            }
        }
    }
}

/// The power of the elastic forces is the rate of the stored energy of a wheel that spins over its flat, and
/// of one with slices.
#[test]
fn energy_comes_back_by_the_spin() {
    let worn = Flat {
        length: 0.08,
        depth: Some(8e-4),
        angle: 1.0,
    };
    let frictionless = law(CreepLaw::Frictionless);
    let pairs = [
        (under(&flats(&[FRESH, worn])), [-0.03, 0.001, 0.04, 0.95, 1.06]),
        (
            sliced_pair(&[(0.0, 0.0), (0.5, 5e-4), (3.0, 0.0)]),
            [0.2, 0.495, 0.505, 1.0, 4.0],
        ),
    ];
    for (pair, angles) in pairs {
        for angle in angles {
            let touch = pair.touch(&pose_at(angle, [0.0, RADIUS, 0.0, 0.0])).unwrap();
            let z = RADIUS + touch.overlap - 1e-4;
            let spin = 20.0 / RADIUS;
            let pose = |time: f64| pose_at(angle + spin * time, [0.0, z - 0.03 * time, 0.0, 0.0]);
            let along = motion([20.0, 0.0, -0.03, 0.0, spin, 0.0]);
            let found = frictionless.on_wheel(&pair, Side::Left, &pose(0.0), &along, |_, _| ());
            let step = 1e-9;
            let rate =
                (stored_energy(&pair, &pose(step)) - stored_energy(&pair, &pose(-step))) / (2.0 * step);
            // What does not come back is that of a round wheel too: curvatures change with the overlap.
            let within = 1e-3 * found.elastic_power.abs() + 1e-5 * found.force[2];
            assert!(
                (found.elastic_power - rate).abs() < within,
                "{angle}: {} {rate}",
                found.elastic_power
            );
        }
    }
}

/// Between two slices the wheel is the section that a reader of the list gives there, and a turn brings it
/// back.
#[test]
fn cross_code_an_angle_between_slices_is_the_section_there() {
    let slices = [(-1.0, 0.0), (0.5, 8e-4), (1.5, -3e-4)];
    let (list, pair) = (sliced(&slices), sliced_pair(&slices));
    for angle in [-0.4, 1.2, 2.5, -2.0, 0.5 + 1.5 * PI] {
        let section = list.at(angle).unwrap();
        let steel = pair.material();
        let plain = ContactPair::new(&section, RADIUS, &crate::common::inclined_rail(), steel).unwrap();
        for [y, overlap, yaw, roll] in POSES {
            let z = height(&plain, [y, overlap, yaw, roll]);
            let found = pair.touch(&pose_at(angle, [y, z, yaw, roll])).unwrap();
            assert!(
                (found.overlap - overlap).abs() < 3e-7,
                "{angle}: {} {overlap}",
                found.overlap
            );
        }
        let turned = |angle: f64| pair.touch(&pose_at(angle, [0.0, RADIUS, 0.0, 0.0])).unwrap();
        assert!((turned(angle).overlap - turned(angle + TAU).overlap).abs() < 1e-13);
    }
}

/// Forces are continuous over the ends of flats and over slices, and beside a flat the wheel is round to the
/// bit.
#[test]
fn limits_ends_of_flats_and_slices() {
    let law = law(CreepLaw::Polach(polach::DRY));
    let wrench = |pair: &ContactPair, law: &ContactLaw, angle: f64| {
        let pose = pose_at(angle, [2e-3, RADIUS - 1.2e-3, 1e-3, 0.0]);
        let found = law.on_wheel(pair, Side::Left, &pose, &motion(VELOCITIES), |_, _| ());
        [found.force, found.moment]
    };
    let own = flats(&[FRESH]);
    let (half, rounded) = (FRESH.half_angle(RADIUS), 1e-3 / RADIUS);
    let pairs = [
        (under(&own), vec![-half, -rounded, 0.0, rounded, half]),
        (
            sliced_pair(&[(-1.0, 0.0), (0.5, 8e-4)]),
            vec![-1.0, 0.5, 0.5 - 5e-3 / RADIUS, PI],
        ),
    ];
    for (pair, edges) in pairs {
        for edge in edges {
            let [before, behind] = [edge - 1e-9, edge + 1e-9].map(|angle| wrench(&pair, &law, angle));
            let scale = before[0][2];
            for (a, b) in before.iter().flatten().zip(behind.iter().flatten()) {
                assert!((a - b).abs() < 1e-5 * scale, "{edge}: {before:?} {behind:?}");
            }
        }
    }
    let pair = under(&own);
    assert_eq!(wrench(&pair, &law, 1.0), wrench(&freight_pair(), &law, 1.0));
}

/// Tables of contacts have flats too.
#[test]
fn cross_code_tables_have_flats() {
    let own = flats(&[FRESH]);
    let (pair, law) = (under(&own), law(CreepLaw::Frictionless));
    let table = ContactTable::new(pair.clone(), 1e-4).unwrap();
    for angle in [0.0, 0.02, 0.04, 1.0] {
        let [rise, ..] = own.at(angle);
        let z = height(&freight_pair(), [1e-3, 1e-4, 0.0, 0.0]) + rise;
        let pose = pose_at(angle, [1e-3, z, 0.0, 0.0]);
        let still = motion([0.0; 6]);
        let a = law.on_wheel(&table, Side::Left, &pose, &still, |_, _| ());
        let b = law.on_wheel(&pair, Side::Left, &pose, &still, |_, _| ());
        assert!((a.force[2] / b.force[2] - 1.0).abs() < 0.02, "{angle}");
        assert!(
            (a.moment[1] - b.moment[1]).abs() < 0.02 * b.force[2] * 0.025,
            "{angle}"
        );
    }
}

#[test]
fn input_numbers_that_make_no_wheel() {
    let flat = |length: f64, depth: Option<f64>, angle: f64| Flat { length, depth, angle };
    let wrong = [
        vec![flat(0.0, None, 0.0)],
        vec![flat(0.3, None, 0.0)],
        vec![flat(f64::NAN, None, 0.0)],
        vec![flat(0.05, Some(0.0), 0.0)],
        vec![flat(0.05, Some(7e-4), 0.0)],
        vec![flat(0.05, None, 0.0), flat(0.05, None, 0.1)],
        vec![flat(0.05, None, PI), flat(0.05, None, -PI)],
        vec![flat(0.05, None, f64::INFINITY)],
    ];
    for own in wrong {
        assert!(
            OutOfRound::new(RADIUS, own.clone(), Vec::new()).is_err(),
            "{own:?}"
        );
    }
    for (order, amplitude) in [(0, 1e-4), (101, 1e-6), (3, 0.0), (1, 0.02), (30, 6e-4)] {
        let own = Harmonic {
            order,
            amplitude,
            angle: 0.0,
        };
        assert!(
            OutOfRound::new(RADIUS, Vec::new(), vec![own]).is_err(),
            "{order} {amplitude}"
        );
    }
    let error = SlicedWheel::new(&sliced(&[(0.0, 0.0), (7.0, 0.0)]), RADIUS).unwrap_err();
    assert!(error.to_string().contains("less than a turn"), "{error}");
    let table = ContactTable::new(sliced_pair(&[(0.0, 0.0), (1.0, 1e-3)]), 1e-4);
    assert!(
        table
            .unwrap_err()
            .to_string()
            .contains("the wheel's profile changes")
    );
}
