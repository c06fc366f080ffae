//! analytic, input: contact of a wheel and a rail against closed forms, brute force, differences.

use crate::common;
use common::{
    POSES, RADIUS, STEEL, VELOCITIES, conformal_pair, forces, freight_pair, height, inclined_rail, law,
    motion, six, values,
};
use numerics::scalar::Dual;
use wheelrail::contact::{ContactPair, CreepLaw, Side, WheelMotion, WheelPose};
use wheelrail::creep::fastsim::StripGrid;
use wheelrail::creep::polach;
use wheelrail::hertz::{Hertz, Material};
use wheelrail::profile::{ChainElement, Profile, ProfileError, ProfileKind, nominal};

/// A cone on an arc: the arc's slope is the cone's at the contact; place, radius, curvatures, Hertz's load.
#[test]
fn analytic_a_cone_on_a_cylinder() {
    let (cone, crown) = (0.05f64, 0.3);
    let wheel = nominal::cone(cone, 0.05).unwrap();
    let rail = nominal::cylinder(crown, 0.035).unwrap();
    let pair = ContactPair::new(&wheel, RADIUS, &rail, STEEL).unwrap();
    let cosine = 1.0 / (1.0 + cone * cone).sqrt();
    // The rail's point with the cone's slope, and the height of the cone that touches it.
    let (y, z) = (-crown * cone * cosine, crown * (cosine - 1.0));
    for (lateral, approach) in [(0.0, 5e-5), (4e-3, 1e-4), (-7e-3, 2e-5)] {
        let touching = z + RADIUS - cone * (y - lateral);
        let pose = WheelPose::of(Side::Left, [lateral, touching - approach / cosine], 0.0, 0.0);
        let found = pair.patches_at(&pose);
        assert_eq!(found.len(), 1);
        let patch = &found[0];
        assert_eq!(patch.share, 1.0);
        // The overlap is a parabola up to terms of the order of w² λ/R = 1e-5 m.
        assert!((patch.place[1] - y).abs() < 5e-6, "{} {y}", patch.place[1]);
        assert!(patch.place[0].abs() < 1e-15);
        let radius = RADIUS - cone * (y - lateral);
        assert!((patch.radius - radius).abs() < 3e-7 && (patch.profile - (y - lateral)).abs() < 5e-6);
        assert!((patch.angle() - cone.atan()).abs() < 1e-5);
        assert!(
            (patch.approach / approach - 1.0).abs() < 1e-3,
            "{}",
            patch.approach
        );
        let exact = [cosine / radius, 1.0 / crown];
        for (found, exact) in patch.curvatures.iter().zip(exact) {
            assert!((found / exact - 1.0).abs() < 2e-3, "{found} {exact}");
        }
        let hertz = Hertz::new(STEEL, exact[0], exact[1]).unwrap();
        let load = hertz.load(approach);
        let still = WheelMotion {
            velocity: [0.0; 3],
            angular_velocity: [0.0; 3],
        };
        let law = law(CreepLaw::Frictionless);
        let on_wheel = law.on_wheel(&pair, Side::Left, &pose, &still, |_, forces| {
            for (found, exact) in forces.axes.iter().zip(hertz.semi_axes(load)) {
                assert!((found / exact - 1.0).abs() < 1e-3, "{found} {exact}");
            }
        });
        let expected = [0.0, -load * cone * cosine, load * cosine];
        for (found, exact) in on_wheel.force.iter().zip(expected) {
            assert!((found - exact).abs() < 2e-3 * load, "{found} {exact}");
        }
        // Sinking by v raises the load by 1.5 α v cos δ.
        let sinking = WheelMotion {
            velocity: [0.0, 0.0, -0.1],
            ..still
        };
        let damped = law.on_wheel(&pair, Side::Left, &pose, &sinking, |_, _| {}).force[2];
        let factor = 1.0 + 1.5 * 0.3 * 0.1 * cosine;
        assert!((damped / on_wheel.force[2] - factor).abs() < 1e-5);
        // Rising fast, nothing pulls.
        let rising = WheelMotion {
            velocity: [0.0, 0.0, 10.0],
            ..still
        };
        let none = law.on_wheel(&pair, Side::Left, &pose, &rising, |_, _| {});
        assert_eq!(none.force, [0.0; 3]);
    }
}

/// A yawed cone touches behind its axle: `sin θ = -tan ψ r'`, and the place of contact is
/// `r sin θ cos ψ - u sin ψ`.
#[test]
fn analytic_a_yawed_cone_touches_ahead_or_behind() {
    let cone = 0.1;
    let wheel = nominal::cone(cone, 0.05).unwrap();
    let rail = nominal::cylinder(0.3, 0.06).unwrap();
    let pair = ContactPair::new(&wheel, RADIUS, &rail, STEEL).unwrap();
    for yaw in [0.02f64, -0.05] {
        let pose = WheelPose::of(Side::Left, [0.0, RADIUS], yaw, 0.0);
        let touch = pair.touch(&pose).unwrap();
        let sine = yaw.tan() * cone;
        let expected = touch.radius * sine * yaw.cos() - touch.profile * yaw.sin();
        assert!((touch.place[0] - expected).abs() < 1e-12, "{:?}", touch.place);
    }
}

/// Returns the largest overlap of the whole surface of a yawed and rolled wheel with the rail, on a grid of
/// its profile and its circumference: no silhouette, no search.
fn brute_force(wheel: &Profile, rail: &Profile, [y, z, yaw, roll]: [f64; 4]) -> f64 {
    let rail: Vec<[f64; 2]> = rail
        .curve()
        .sample(2e-5)
        .iter()
        .map(|(_, point)| point.position)
        .collect();
    let at = |y: f64| {
        let next = rail
            .partition_point(|point| point[0] < y)
            .clamp(1, rail.len() - 1);
        let ([y0, z0], [y1, z1]) = (rail[next - 1], rail[next]);
        z0 + (z1 - z0) * (y - y0) / (y1 - y0)
    };
    let (first, last) = (rail[0][0], rail[rail.len() - 1][0]);
    let ((sy, cy), (sr, cr)) = (yaw.sin_cos(), roll.sin_cos());
    let mut best = f64::NEG_INFINITY;
    for (_, point) in wheel.curve().sample(5e-5) {
        let [u, drop] = point.position;
        let radius = RADIUS - drop;
        for i in -400..=400 {
            let angle = 5e-4 * f64::from(i);
            let (along, down) = (radius * angle.sin(), -radius * angle.cos());
            // Rz(yaw) Rx(roll) of (along, u, down).
            let across = u * cr - down * sr;
            let place = [sy * along + cy * across + y, u * sr + down * cr + z];
            if place[0] > first && place[0] < last {
                best = f64::max(best, at(place[0]) - place[1]);
            }
        }
    }
    best
}

#[test]
fn analytic_the_largest_overlap_is_that_of_the_whole_surface() {
    let (wheel, rail) = (nominal::aar_1b().unwrap(), inclined_rail());
    let pair = freight_pair();
    for [lateral, _, yaw, roll] in [
        [-3e-3, 0.0, 0.0, 0.0],
        [3e-3, 0.0, 1e-2, 3e-3],
        [1.2e-2, 0.0, 2e-2, 0.0],
        [1.4e-2, 0.0, -4e-2, -5e-3],
    ] {
        let pose = WheelPose::of(Side::Left, [lateral, RADIUS], yaw, roll);
        let found = pair.touch(&pose).unwrap().overlap;
        let expected = brute_force(&wheel, &rail, [lateral, RADIUS, yaw, roll]);
        assert!(
            (found - expected).abs() < 2e-6 + 1e-3 * expected.abs(),
            "{lateral} {yaw}: {found}, {expected} on the grid"
        );
    }
}

/// Compares the derivatives of all forces and moments by pose and velocities with central differences, each
/// against the largest of its kind (force, moment) in its column.
pub fn assert_derivatives(pair: &ContactPair, creep: CreepLaw, pose: [f64; 4], within: f64) {
    let law = law(creep);
    let at = values(pair, pose);
    let dual = std::array::from_fn(|i| Dual::<10>::variable(at[i], i));
    let found = forces(pair, &law, Side::Left, dual);
    let plain = six(&forces(pair, &law, Side::Left, at));
    let rows: [Dual<10>; 6] = std::array::from_fn(|i| {
        if i < 3 {
            found.force[i]
        } else {
            found.moment[i - 3]
        }
    });
    for (row, plain) in rows.iter().zip(plain) {
        assert!((row.value - plain).abs() < 1e-6, "{} {plain}", row.value);
    }
    let steps = [1e-9, 1e-9, 1e-6, 1e-6, 1e-4, 1e-6, 1e-6, 1e-6, 1e-6, 1e-6];
    for (column, step) in steps.into_iter().enumerate() {
        let moved = |by: f64| {
            let mut moved = at;
            moved[column] += by;
            six(&forces(pair, &law, Side::Left, moved))
        };
        let (up, down) = (moved(step), moved(-step));
        let differences: [f64; 6] = std::array::from_fn(|i| (up[i] - down[i]) / (2.0 * step));
        for (i, (row, difference)) in rows.iter().zip(differences).enumerate() {
            let kind = if i < 3 { 0..3 } else { 3..6 };
            let scale = differences[kind]
                .iter()
                .fold(1.0, |most: f64, d| most.max(d.abs()));
            let derivative = row.derivative[column];
            assert!(
                (derivative - difference).abs() < within * scale,
                "{creep:?} {pose:?} row {i} column {column}: {derivative} {difference} of {scale}"
            );
        }
    }
}

#[test]
fn analytic_derivatives_are_those_of_differences() {
    let pair = freight_pair();
    let grid = StripGrid {
        cells: 21,
        strips: 21,
    };
    for (creep, within) in [
        (CreepLaw::Frictionless, 2e-5),
        (CreepLaw::Linear, 2e-5),
        (CreepLaw::ShenHedrickElkins, 2e-5),
        (CreepLaw::Polach(polach::DRY), 2e-5),
        (CreepLaw::Fastsim(grid), 2e-3),
    ] {
        for pose in POSES {
            assert_derivatives(&pair, creep, pose, within);
        }
    }
}

/// The same where an area is divided into parts that are joined by half, and where flange and tread touch
/// together.
#[test]
fn analytic_derivatives_of_divided_areas_are_those_of_differences() {
    let (conformal, freight) = (conformal_pair(), freight_pair());
    for (pair, pose) in [
        (&conformal, [-6.0e-3, 1e-4, 0.0, 0.0]),
        (&conformal, [-5.6e-3, 1e-4, 2e-3, 1e-3]),
        (&freight, [1.142e-2, 1.5e-4, 0.0, 0.0]),
    ] {
        let [lateral, _, yaw, roll] = pose;
        let own = WheelPose::of(Side::Left, [lateral, height(pair, pose)], yaw, roll);
        assert!(pair.patches_at(&own).len() > 1, "{pose:?}");
        assert_derivatives(pair, CreepLaw::Polach(polach::DRY), pose, 5e-5);
    }
}

/// The sizes of derivatives are those of Hertz: stiffness 1.5 N/d along the normal.
#[test]
fn analytic_the_vertical_stiffness_is_hertzs() {
    let pair = freight_pair();
    let law = law(CreepLaw::Frictionless);
    let at = values(&pair, POSES[0]);
    let mut dual = at.map(Dual::<1>::from);
    dual[1] = Dual::variable(at[1], 0);
    for value in &mut dual[4..] {
        *value = Dual::from(0.0);
    }
    let found = forces(&pair, &law, Side::Left, dual).force[2];
    let patch = pair.patches_at(&WheelPose::of(Side::Left, [at[0], at[1]], at[2], at[3]))[0];
    let expected = -1.5 * found.value / patch.approach * patch.cosine;
    assert!(
        (found.derivative[0] / expected - 1.0).abs() < 0.02,
        "{} {expected}",
        found.derivative[0]
    );
    assert!(expected < -1e8 && expected > -3e9, "{expected} N/m");
}

/// The right side is the mirror image of the left one.
#[test]
fn analytic_the_right_side_mirrors_the_left_one() {
    let pair = freight_pair();
    let law = law(CreepLaw::Polach(polach::DRY));
    for pose in POSES {
        let at = values(&pair, pose);
        let mut mirrored = at;
        for odd in [0, 2, 3, 5, 7, 9] {
            mirrored[odd] = -mirrored[odd];
        }
        let (left, right) = (
            six(&forces(&pair, &law, Side::Left, at)),
            six(&forces(&pair, &law, Side::Right, mirrored)),
        );
        assert!(left[2] > 1e4);
        for (i, sign) in [1.0, -1.0, 1.0, -1.0, 1.0, -1.0].into_iter().enumerate() {
            assert!(
                (left[i] - sign * right[i]).abs() < 1e-6 * left[2],
                "{i}: {} {}",
                left[i],
                right[i]
            );
        }
    }
}

/// The power of all forces is what creep dissipates and what goes into the normal force.
#[test]
fn analytic_powers_balance() {
    let pair = freight_pair();
    let grid = StripGrid {
        cells: 21,
        strips: 21,
    };
    for creep in [CreepLaw::Fastsim(grid), CreepLaw::Polach(polach::DRY)] {
        let law = law(creep);
        for pose in POSES {
            let at = values(&pair, pose);
            let own = WheelPose::of(Side::Left, [at[0], at[1]], at[2], at[3]);
            let motion = motion(VELOCITIES);
            let mut normal_power = 0.0;
            let found = law.on_wheel(&pair, Side::Left, &own, &motion, |patch, forces| {
                let arm = [
                    patch.place[0],
                    patch.place[1] - own.center[0],
                    patch.place[2] - own.center[1],
                ];
                let [p, q, r] = motion.angular_velocity;
                let [x, y, z] = arm;
                let velocity = [
                    motion.velocity[0] + q * z - r * y,
                    motion.velocity[1] + r * x - p * z,
                    motion.velocity[2] + p * y - q * x,
                ];
                let along: f64 = velocity.iter().zip(patch.normal()).map(|(v, n)| v * n).sum();
                normal_power += patch.share * forces.normal * along;
            });
            let power: f64 = (0..3)
                .map(|i| found.force[i] * motion.velocity[i] + found.moment[i] * motion.angular_velocity[i])
                .sum();
            let residual = power - normal_power + found.creep_power;
            assert!(
                residual.abs() < 1e-9 * found.creep_power.abs().max(1.0),
                "{residual} of {}",
                found.creep_power
            );
            assert!(
                found.creep_power > 0.0,
                "{creep:?} {pose:?}: {}",
                found.creep_power
            );
        }
    }
}

/// Guiding by the flange, a 1:20 tread on a rail inclined by 1:40 touches at two places (a published
/// statement about AAR treads); in the middle at one.
#[test]
fn analytic_flange_and_tread_touch_together() {
    let pair = freight_pair();
    let mut together = 0;
    for i in 0..200 {
        let lateral = -3e-3 + 1e-4 * f64::from(i);
        let pose = [lateral, 1e-4, 0.0, 0.0];
        let z = height(&pair, pose);
        let found = pair.patches_at(&WheelPose::of(Side::Left, [lateral, z], 0.0, 0.0));
        assert!(!found.is_empty());
        if lateral < 2e-3 {
            assert_eq!(found.len(), 1, "{lateral}");
        }
        let apart: Vec<_> = found.iter().filter(|patch| patch.share == 1.0).collect();
        if let [first, second] = apart[..] {
            let [flange, tread] = if first.place[1] < second.place[1] {
                [first, second]
            } else {
                [second, first]
            };
            assert!(flange.slope > 1.0 && tread.slope < 0.1, "{flange:?} {tread:?}");
            assert!(tread.place[1] - flange.place[1] > 0.01);
            together += 1;
        }
    }
    assert!(together > 0);
}

#[test]
fn input_wrong_profiles_are_refused() {
    let (wheel, rail) = (nominal::aar_1b().unwrap(), inclined_rail());
    assert!(matches!(
        ContactPair::new(&rail, RADIUS, &rail, STEEL),
        Err(ProfileError::Kind { .. })
    ));
    assert!(matches!(
        ContactPair::new(&wheel, 457.2, &rail, STEEL),
        Err(ProfileError::Length { .. })
    ));
    let soft = Material {
        youngs_modulus: 0.0,
        ..STEEL
    };
    assert!(ContactPair::new(&wheel, RADIUS, &rail, soft).is_err());
    let line = ChainElement::Line {
        point: [0.0, 0.0],
        angle: 1.5,
    };
    let steep =
        Profile::of_chain("steep", ProfileKind::Wheel, [-1e-3, -0.02], &[line], [1e-3, 0.02]).unwrap();
    let error = ContactPair::new(&steep, RADIUS, &rail, STEEL).unwrap_err();
    assert!(error.to_string().contains("steep than 82°"), "{error}");
    let aside = rail.moved([1.0, 0.0]);
    let error = ContactPair::new(&wheel, RADIUS, &aside, STEEL).unwrap_err();
    assert!(error.to_string().contains("does not pass y = 0"), "{error}");
}
