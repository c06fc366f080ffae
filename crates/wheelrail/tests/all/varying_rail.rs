//! A rail whose section changes along the track.

use std::sync::Arc;

use numerics::scalar::{Dual, Real};
use wheelrail::contact::{
    ContactLaw, ContactPair, ContactTable, CreepLaw, FindPatches, Side, VaryingRail, WheelMotion, WheelPose,
    stored_energy,
};
use wheelrail::creep::polach;
use wheelrail::profile::{Profile, SlicedProfile, nominal};

use crate::common::{POSES, RADIUS, STEEL, VELOCITIES, height, inclined_rail, law};

/// A rail that is lowered, and worn at its gauge corner by another crown.
fn worn(fall: f64) -> Arc<Profile> {
    let other = nominal::rail_136re_8in().unwrap().inclined(0.05);
    let [_, top] = other.top();
    Arc::new(other.moved([-1e-3, -top - fall]))
}

fn sliced(slices: &[(f64, &Arc<Profile>)]) -> SlicedProfile {
    let slices = slices.iter().map(|(place, own)| (*place, (*own).clone()));
    SlicedProfile::of_rails("rail", slices.collect()).unwrap()
}

fn pair_on(rail: &SlicedProfile) -> ContactPair {
    let plain = ContactPair::new(&nominal::aar_1b().unwrap(), RADIUS, &inclined_rail(), STEEL).unwrap();
    plain.on(Arc::new(VaryingRail::new(rail).unwrap()))
}

fn pose_at<S: Real>(along: S, [y, z, yaw, roll]: [S; 4]) -> WheelPose<S> {
    WheelPose {
        along,
        ..WheelPose::of(Side::Left, [y, z], yaw, roll)
    }
}

pub(crate) fn motion<S: Real>(values: [f64; 6]) -> WheelMotion<S> {
    let [a, b, c, d, e, f] = values.map(S::from);
    WheelMotion {
        velocity: [a, b, c],
        angular_velocity: [d, e, f],
    }
}

/// Force and moment on the wheel.
fn wrench<S: Real>(pair: &ContactPair, law: &ContactLaw, pose: &WheelPose<S>) -> [S; 6] {
    let found = law.on_wheel(pair, Side::Left, pose, &motion(VELOCITIES), |_, _| ());
    let [a, b, c] = found.force;
    let [d, e, f] = found.moment;
    [a, b, c, d, e, f]
}

/// A rail that falls as a whole is a plane that falls: the force leans back by the slope, gives no moment
/// about the axle, and a wheel that follows the slope is not damped.
#[test]
fn analytic_a_falling_rail_tilts_the_contact() {
    let high = Arc::new(inclined_rail());
    for slope in [-2e-3, 1e-3, 5e-3] {
        let low = Arc::new(high.moved([0.0, slope]));
        let pair = pair_on(&sliced(&[(0.0, &high), (1.0, &low)]));
        let level = ContactPair::new(&nominal::aar_1b().unwrap(), RADIUS, &high, STEEL).unwrap();
        let center = height(&level, [0.0, 1e-4, 0.0, 0.0]);
        let pose = pose_at(0.5, [0.0, center + 0.5 * slope, 0.0, 0.0]);
        let patches = pair.patches_at(&pose);
        let expected = level.patches_at(&pose_at(0.0, [0.0, center, 0.0, 0.0]));
        assert_eq!(patches.len(), expected.len());
        for (own, expected) in patches.iter().zip(&expected) {
            assert!((own.approach / expected.approach - 1.0).abs() < 1e-6);
            assert!((own.place[0] - own.radius * slope).abs() < 1e-9);
            assert!((own.climb.unwrap() - slope).abs() < 1e-12);
        }
        let frictionless = law(CreepLaw::Frictionless);
        let along = motion([10.0, 0.0, 10.0 * slope, 0.0, 10.0 / RADIUS, 0.0]);
        let found = frictionless.on_wheel(&pair, Side::Left, &pose, &along, |_, forces| {
            assert!(forces.rate.abs() < 1e-9, "{}", forces.rate);
        });
        let [x, _, z] = found.force;
        assert!((x / z + slope).abs() < 1e-12, "{x} {z}");
        assert!(found.moment[1].abs() < 1e-9 * z * RADIUS, "{:?}", found.moment);
    }
}

/// Between two slices the rail is the section that a reader of the list gives there.
#[test]
fn cross_code_a_place_between_slices_is_the_section_there() {
    let (new, old) = (Arc::new(inclined_rail()), worn(3e-3));
    let rail = sliced(&[(10.0, &new), (14.0, &old)]);
    let varying = pair_on(&rail);
    let law = law(CreepLaw::Polach(polach::DRY));
    for place in [11.0, 12.0, 13.3] {
        let section = rail.at(place).unwrap();
        let wheel = nominal::aar_1b().unwrap();
        let plain = ContactPair::new(&wheel, RADIUS, &section, STEEL).unwrap();
        for pose in POSES {
            let [y, _, yaw, roll] = pose;
            let z = height(&plain, pose);
            let [own, other] = [&varying, &plain].map(|pair| {
                let mut load = 0.0;
                let mut at = 0.0;
                let pose = pose_at(place, [y, z, yaw, roll]);
                law.on_wheel(pair, Side::Left, &pose, &motion(VELOCITIES), |patch, forces| {
                    load += forces.elastic * patch.share;
                    at += forces.elastic * patch.share * patch.place[1];
                });
                [load, at / load]
            });
            assert!(
                (own[0] / other[0] - 1.0).abs() < 2e-3,
                "{place} {pose:?}: {own:?} {other:?}"
            );
            assert!(
                (own[1] - other[1]).abs() < 2e-5,
                "{place} {pose:?}: {own:?} {other:?}"
            );
        }
    }
}

/// Derivatives by the place along the track and by the pose are those of differences, near a slice too.
#[test]
fn analytic_derivatives_along_the_track() {
    let (new, old) = (Arc::new(inclined_rail()), worn(1e-3));
    let pair = pair_on(&sliced(&[(0.0, &new), (1.0, &old), (1.5, &new)]));
    let law = law(CreepLaw::Polach(polach::DRY));
    for place in [0.4, 0.997, 1.002] {
        for pose in POSES {
            let [y, _, yaw, roll] = pose;
            let section = |along: f64| {
                let touch = pair
                    .touch(&pose_at(along, [y, RADIUS + 1e-3, yaw, roll]))
                    .unwrap();
                RADIUS + 1e-3 + touch.overlap - 1e-4
            };
            let z = section(place);
            let values = [place, y, z, yaw, roll];
            let wide: [Dual<5>; 5] = std::array::from_fn(|i| Dual::variable(values[i], i));
            let [along, y, z, yaw, roll] = wide;
            let exact = wrench(&pair, &law, &pose_at(along, [y, z, yaw, roll]));
            for i in 0..5 {
                let step = if i == 0 { 1e-6 } else { 1e-8 };
                let at = |sign: f64| {
                    let mut moved = values;
                    moved[i] += sign * step;
                    let [along, y, z, yaw, roll] = moved;
                    wrench(&pair, &law, &pose_at(along, [y, z, yaw, roll]))
                };
                let (above, below) = (at(1.0), at(-1.0));
                let scale = [0, 1, 2].map(|k| exact[k].derivative[i].abs()).into_iter();
                let scale = scale.fold(0.0, f64::max);
                for k in 0..6 {
                    let difference = (above[k] - below[k]) / (2.0 * step);
                    let own = exact[k].derivative[i];
                    assert!(
                        (own - difference).abs() < 2e-3 * scale,
                        "{place} {pose:?} variable {i} component {k}: {own} {difference} of {scale}"
                    );
                }
            }
        }
    }
}

/// Forces are continuous over slices, and before the first and behind the last one the rail is that slice to
/// the bit.
#[test]
fn limits_ends_and_slices() {
    let (new, old) = (Arc::new(inclined_rail()), worn(0.0));
    let pair = pair_on(&sliced(&[
        (0.0, &new),
        (1.0, &old),
        (1.002, &new),
        (9.0, &new),
        (10.0, &old),
    ]));
    let law = law(CreepLaw::Polach(polach::DRY));
    let at = |place: f64| wrench(&pair, &law, &pose_at(place, [2e-3, RADIUS - 8e-4, 1e-3, 0.0]));
    for edge in [
        -5e-3, 0.0, 5e-3, 0.995, 0.999, 1.0, 1.001, 1.002, 1.003, 8.995, 10.005,
    ] {
        let [before, behind] = [at(edge - 1e-9), at(edge + 1e-9)];
        let scale = before[2];
        for (a, b) in before.iter().zip(&behind) {
            assert!((a - b).abs() < 1e-5 * scale, "{edge}: {before:?} {behind:?}");
        }
    }
    for (place, rail) in [(-1.0, &new), (5.0, &new), (100.0, &old)] {
        let plain = ContactPair::new(&nominal::aar_1b().unwrap(), RADIUS, rail, STEEL).unwrap();
        let pose = pose_at(place, [2e-3, RADIUS - 8e-4, 1e-3, 0.0]);
        assert_eq!(at(place), wrench(&plain, &law, &pose));
    }
}

/// The power of the elastic forces is the rate of the stored energy while a wheel passes over a change of
/// height.
#[test]
fn energy_of_a_wheel_that_passes_a_change() {
    let high = Arc::new(inclined_rail());
    let low = Arc::new(high.moved([0.0, -2e-3]));
    let pair = pair_on(&sliced(&[(0.0, &high), (0.5, &low)]));
    let law = law(CreepLaw::Frictionless);
    for place in [-2e-3, 1e-3, 0.2, 0.499, 0.503] {
        let touch = pair.touch(&pose_at(place, [0.0, RADIUS, 0.0, 0.0])).unwrap();
        let z = RADIUS + touch.overlap - 1e-4;
        let pose = |time: f64| pose_at(place + 20.0 * time, [0.0, z - 0.03 * time, 0.0, 0.0]);
        let along = motion([20.0, 0.0, -0.03, 0.0, 20.0 / RADIUS, 0.0]);
        let found = law.on_wheel(&pair, Side::Left, &pose(0.0), &along, |_, _| ());
        let step = 1e-8;
        let rate = (stored_energy(&pair, &pose(step)) - stored_energy(&pair, &pose(-step))) / (2.0 * step);
        let scale = found.force[2] * 0.1;
        assert!(
            (found.elastic_power - rate).abs() < 1e-3 * scale,
            "{place}: {} {rate}",
            found.elastic_power
        );
    }
}

#[test]
fn input_no_tables_and_no_places_that_fall() {
    let (new, old) = (Arc::new(inclined_rail()), worn(1e-3));
    let pair = pair_on(&sliced(&[(0.0, &new), (1.0, &old)]));
    assert_eq!(pair.material(), STEEL);
    let error = ContactTable::new(pair, 1e-4).unwrap_err();
    assert!(
        error.to_string().contains("the rail's section changes"),
        "{error}"
    );
    for places in [[1.0, 1.0], [1.0, 0.5], [0.0, f64::NAN]] {
        let slices = places.map(|place| (place, new.clone()));
        assert!(SlicedProfile::of_rails("rail", slices.to_vec()).is_err());
    }
    assert!(SlicedProfile::of_rails("rail", Vec::new()).is_err());
}
