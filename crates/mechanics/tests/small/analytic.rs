//! Laws against their closed forms.

use std::f64::consts::PI;

use mechanics::quasi_static::{Direction, QuasiStaticWedge};
use mechanics::small::{
    Accumulator, Branch, Column, Curve, GapDamper, Law, Options, SpringDamper, SurfaceFriction, System,
};
use mechanics::system::Mode;

use crate::common::Random;
use crate::half_truck::{INCH, LBF, LBF_PER_INCH, straight, wedge};
use crate::models::{against_ground, at, at_deflection, one, wedge_at};

pub fn close(value: f64, expected: f64, tolerance: f64) {
    assert!(
        (value - expected).abs() <= tolerance,
        "{value} instead of {expected} (within {tolerance})"
    );
}

/// A column without profile.
pub fn plain(toe_out: bool) -> Column {
    Column::Plain { toe_out }
}

#[test]
fn curves_mirror_continue_and_integrate() {
    let mirrored = Curve::mirrored_from_origin(vec![[0.0, 0.0], [2.0, 4.0], [3.0, 10.0]]).unwrap();
    for (x, y) in [(1.0, 2.0), (2.5, 7.0), (5.0, 22.0), (-1.0, -2.0), (-5.0, -22.0)] {
        assert_eq!(mirrored.evaluate(x), y);
    }
    // an abscissa of zero alone does not mirror
    let one_sided = Curve::mirrored_from_origin(vec![[0.0, -5.0], [1.0, 0.0], [2.0, 0.0]]).unwrap();
    assert_eq!((one_sided.evaluate(-1.0), one_sided.evaluate(7.0)), (-10.0, 0.0));
    close(mirrored.integral(5.0), 4.0 + 7.0 + 2.0 * 16.0, 1e-12);
    close(mirrored.integral(-5.0), 4.0 + 7.0 + 2.0 * 16.0, 1e-12);
    close(one_sided.integral(-1.0), 7.5, 1e-12);
    let mut random = Random(3);
    for _ in 0..200 {
        let mut x = -1.5;
        let points = (0..6).map(|_| {
            x += random.between(0.1, 0.8);
            [x, random.between(-3.0, 3.0)]
        });
        let curve = Curve::new(points.collect()).unwrap();
        let (low, high) = (random.between(-2.0, 0.5), random.between(0.5, 2.0));
        let clamped = curve.clamped(low, high);
        for _ in 0..20 {
            let x = random.between(-4.0, 6.0);
            close(clamped.evaluate(x), curve.evaluate(x).clamp(low, high), 1e-9);
            // the integral's derivative is the curve
            let h = 1e-5;
            let slope = (clamped.integral(x + h) - clamped.integral(x - h)) / (2.0 * h);
            close(slope, clamped.evaluate(x), 2e-3);
        }
        assert_eq!(clamped.integral(0.0), 0.0);
    }
}

/// A limit of 1e9 lbf on a soft spring does not cost digits of the energy near zero.
#[test]
fn far_limits_keep_the_digits_of_energies() {
    let curve = Curve::linear(10.0).clamped(-4.4e9, 4.4e9);
    close(curve.integral(0.01), 0.5 * 10.0 * 1e-4, 1e-18);
}

#[test]
fn a_spring_and_damper_in_parallel_are_clamped_together() {
    let law = SpringDamper {
        spring: Some(Curve::linear(100.0)),
        damper: Some(Curve::linear(7.0)),
        compression_limit: -50.0,
        extension_limit: 20.0,
    };
    let mut system = against_ground(one(1, law), Options::default());
    for (s, v, force) in [
        (0.1, 0.5, 13.5),
        (0.3, 0.0, 20.0),
        (0.1, 3.0, 20.0),
        (-0.6, 5.0, -25.0),
        (-1.0, 0.0, -50.0),
    ] {
        let state = at(&mut system, [0.0, s, 0.0], [0.0, v, 0.0]).connections[0].clone();
        close(state.forces[0], force, 1e-12);
        assert_eq!((state.strokes[0], state.velocities[0]), (s, v));
    }
    // -f acts on body A
    let seen = at(&mut system, [0.0, 0.1, 0.0], [0.0; 3]);
    close(seen.bodies[0].accelerations[1], -10.0, 1e-12);
}

#[test]
fn a_gap_is_empty_inside_and_never_pulls_at_its_lower_end() {
    let law = GapDamper {
        spring: None,
        damper: Some(Curve::linear(10.0)),
        low: -0.1,
        high: 0.2,
    };
    let mut system = against_ground(Law::Gap(2, law.clone()), Options::default());
    let mut force = |s: f64, v: f64| at(&mut system, [0.0, 0.0, s], [0.0, 0.0, v]).connections[0].forces[0];
    assert_eq!([force(0.0, 3.0), force(-0.05, -3.0), force(0.19, 3.0)], [0.0; 3]);
    assert_eq!([force(-0.2, -3.0), force(-0.2, 3.0)], [-30.0, 0.0]);
    assert_eq!([force(0.3, -3.0), force(0.3, 3.0)], [0.0, 30.0]);
    let options = Options {
        gap_tension: mechanics::small::GapTension::Allowed,
        ..Options::default()
    };
    let mut system = against_ground(Law::Gap(2, law), options);
    assert_eq!(
        at(&mut system, [0.0, 0.0, -0.2], [0.0, 0.0, 3.0]).connections[0].forces[0],
        30.0
    );
}

#[test]
fn strokes_follow_the_levers() {
    let law = Law::Springs(
        (0..6)
            .map(|k| (k, SpringDamper::spring(Curve::linear(1.0))))
            .collect(),
    );
    let mut model = crate::models::model(
        vec![
            mechanics::small::Body::free("a", [1.0, 2.0, 3.0], [true; 6], 1.0, [1.0; 3]),
            mechanics::small::Body::ground(),
        ],
        vec![crate::models::connection(0, 1, [1.5, 2.7, 3.9], law)],
    );
    model.gravity = 9.0;
    let mut system = System::new(model).unwrap();
    let (lx, ly, lz) = (0.5, 0.7, 0.9);
    let [x, y, z, phi, theta, psi] = [0.1, 0.2, 0.3, 0.01, 0.02, 0.03];
    let mut state = system.initial_state();
    state[..6].copy_from_slice(&[x, y, z, phi, theta, psi]);
    let seen = system.observe(0.0, &state);
    let strokes = [
        x + theta * lz - psi * ly,
        y - phi * lz + psi * lx,
        z + phi * ly - theta * lx,
        phi,
        theta,
        psi,
    ];
    for (value, expected) in seen.connections[0].strokes.iter().zip(strokes) {
        close(*value, expected, 1e-15);
    }
    // the moment of a force about the centre of gravity is l × F
    let f = strokes.map(|s| -s);
    let moment = [
        f[3] + ly * f[2] - lz * f[1],
        f[4] + lz * f[0] - lx * f[2],
        f[5] + lx * f[1] - ly * f[0],
    ];
    for k in 0..3 {
        close(seen.bodies[0].accelerations[3 + k], moment[k], 1e-14);
        close(
            seen.bodies[0].accelerations[k],
            f[k] - if k == 2 { 9.0 } else { 0.0 },
            1e-14,
        );
    }
}

#[test]
fn surface_friction_holds_and_slips_on_one_circle() {
    let law = SurfaceFriction {
        coordinates: [2, 0, 1],
        spring: Curve::new(vec![[0.0, -100.0], [0.5, 0.0], [1.0, 0.0]]).unwrap(),
        damper: None,
        coefficient: 0.5,
        accumulator: Accumulator::Bristle {
            stiffness: 1000.0,
            damping: 1.0,
        },
    };
    let mut system = against_ground(Law::Surface(law), Options::default());
    // N = 150 N, limit 75 N
    let held = at_deflection(&mut system, [0.0, 0.0, -0.25], [0.0; 3], [0.03, -0.04]);
    let state = &held.connections[0];
    assert_eq!(state.mode, Some(Mode::Stick));
    for (value, expected) in state.forces.iter().zip([-150.0, 30.0, -40.0]) {
        close(*value, expected, 1e-12);
    }
    let slips = at_deflection(&mut system, [0.0, 0.0, -0.25], [30.0, -40.0, 0.0], [0.075, -0.1]);
    let state = &slips.connections[0];
    assert_eq!(state.mode, Some(Mode::Slip));
    for (value, expected) in state.forces.iter().zip([-150.0, 45.0, -60.0]) {
        close(*value, expected, 1e-12);
    }
    let lifted = at(&mut system, [0.0, 0.0, 0.6], [3.0, 0.0, 0.0]);
    assert_eq!(lifted.connections[0].forces, [0.0; 3]);
    assert_eq!(lifted.connections[0].mode, Some(Mode::Open));
}

/// N/F_s for μ = 0.4: the numbers of a hand calculation.
#[test]
fn wedge_slides_as_its_statics_say() {
    let options = Options::default();
    // angle, toe in degrees, down, up; none: jams
    let table = [
        (false, 0.2, Some(1.0290), 1.7149),
        (true, 0.2, Some(0.7751), 1.4617),
        (false, -0.2, None, 0.5666),
        (true, -0.2, None, 0.4800),
    ];
    for (constant, toe, down, up) in table {
        let wedge = wedge(constant, straight(toe, 1.0));
        let z = -0.5 * INCH;
        let sliding = wedge_at(&wedge, &options, z, -10.0);
        let jammed = down.is_none();
        assert_eq!(sliding.jammed, jammed, "{constant} {toe}");
        match down {
            Some(down) => close(sliding.column_normal / sliding.coil_force, down, 5e-5),
            None => assert_eq!(sliding.column_normal, wedge.normal_limit),
        }
        close(
            sliding.column_friction,
            0.4 * sliding.column_normal,
            1e-9 * sliding.column_normal,
        );
        let sliding = wedge_at(&wedge, &options, z, 10.0);
        close(sliding.column_normal / sliding.coil_force, up, 5e-5);
        assert!(!sliding.jammed);
        close(
            sliding.column_friction,
            -0.4 * sliding.column_normal,
            1e-9 * sliding.column_normal,
        );
        assert_eq!(sliding.mobilised, -1.0);
        // rise and coil: gap over tan θ
        let rise = -z * f64::to_radians(toe).tan() / wedge.angle.tan();
        close(sliding.rise, rise, 1e-15);
        let coil = match constant {
            true => 3702.2 * LBF - 1979.0 * LBF_PER_INCH * rise,
            false => -3000.0 * LBF_PER_INCH * (z + rise),
        };
        close(sliding.coil_force, coil, 1e-9 * coil);
    }
    // no angle: toe out is the branch
    for (constant, down, up) in [(false, 3104.3, 5173.3), (true, 2882.7, 5435.9)] {
        let wedge = wedge(constant, plain(true));
        let force = if constant { 3702.2 } else { 3000.0 };
        let sliding = wedge_at(&wedge, &options, -INCH, -1.0);
        close(sliding.coil_force, force * LBF, 1e-9);
        close(sliding.column_normal / LBF, down, 0.05);
        close(
            wedge_at(&wedge, &options, -INCH, 1.0).column_normal / LBF,
            up,
            0.05,
        );
    }
}

/// Against the other derivation in this crate, for any angles and coefficients.
#[test]
fn wedge_slides_as_the_massless_wedge() {
    let mut random = Random(11);
    let (mut slid, mut jams) = (0, 0);
    for _ in 0..400 {
        let toe = random.between(-0.1, 0.1);
        let column = Column::Profile {
            depth: Curve::linear(-toe.tan()),
            direction: 1.0,
        };
        let mut law = wedge(false, column);
        law.angle = random.between(0.4, 0.9);
        law.slope_friction = random.between(0.05, 0.6);
        law.column_friction = random.between(0.05, 0.6);
        law.normal_limit = 1e9;
        let other = QuasiStaticWedge {
            angle: law.angle,
            toe,
            column_friction: law.column_friction,
            slope_friction: law.slope_friction,
        };
        for (direction, velocity) in [(Direction::Down, -1e5), (Direction::Up, 1e5)] {
            let state = wedge_at(&law, &Options::default(), -INCH, velocity);
            match other.slide(direction, other.branch(direction), state.coil_force) {
                Some(sliding) => {
                    slid += 1;
                    assert!(!state.jammed);
                    close(
                        state.column_normal,
                        sliding.column_normal,
                        1e-9 * sliding.column_normal,
                    );
                    close(
                        state.slope_normal,
                        sliding.slope_normal,
                        1e-9 * sliding.slope_normal,
                    );
                }
                None => {
                    jams += 1;
                    assert!(state.jammed);
                    assert_eq!(state.column_normal, 1e9);
                }
            }
        }
    }
    assert!(slid > 500 && jams > 50, "{slid} {jams}");
}

/// While it sticks the wedge is balanced, both coefficients being used by the same fraction.
#[test]
fn a_sticking_wedge_is_balanced() {
    let mut random = Random(5);
    let mut stuck = 0;
    for _ in 0..300 {
        let toe = random.between(-0.05, 0.05);
        let column = Column::Profile {
            depth: Curve::linear(-toe.tan()),
            direction: if random.between(-1.0, 1.0) > 0.0 {
                1.0
            } else {
                -1.0
            },
        };
        let mut law = wedge(random.between(-1.0, 1.0) > 0.0, column);
        law.slope_friction = random.between(0.05, 0.45);
        law.column_friction = random.between(0.05, 0.45);
        let (slope_friction, friction) = (law.slope_friction, law.column_friction);
        let mut system = against_ground(Law::Wedge(law.clone()), Options::default());
        let deflection = [
            random.between(-0.003, 0.003) * INCH,
            random.between(-0.001, 0.001) * INCH,
        ];
        let place = [0.0, 0.0, random.between(-1.0, -0.2) * INCH];
        let seen = at_deflection(&mut system, place, [0.0; 3], deflection);
        let connection = &seen.connections[0];
        if connection.mode != Some(Mode::Stick) {
            continue;
        }
        stuck += 1;
        let w = connection.wedge.unwrap();
        let (s, c) = law.angle.sin_cos();
        let (p_s, p_c) = toe.sin_cos();
        let slope = w.mobilised
            * if toe < 0.0 {
                slope_friction
            } else {
                -slope_friction
            };
        let size = w.coil_force;
        close(
            w.column_friction,
            -1e6 * LBF_PER_INCH * deflection[0],
            1e-9 * size,
        );
        close(
            w.column_friction,
            friction * w.mobilised * w.column_normal,
            1e-9 * size,
        );
        let across = w.column_normal * p_c + w.column_friction * p_s;
        close(across, w.slope_normal * (c + slope * s), 1e-9 * size);
        let up = w.coil_force - w.column_normal * p_s + w.column_friction * p_c;
        close(up, w.slope_normal * (s - slope * c), 1e-8 * size);
        assert!(w.mobilised.abs() < 1.0);
        // the connection's forces: vertical, longitudinal, lateral
        let Column::Profile { direction, .. } = law.column else {
            unreachable!()
        };
        let coil = if law.coil_in_bolster { 0.0 } else { w.coil_force };
        let vertical = coil + w.column_friction * p_c - w.column_normal * p_s;
        close(connection.forces[0], -vertical, 1e-9 * size);
        close(connection.forces[1], direction * across, 1e-9 * size);
        close(
            connection.forces[2],
            1e6 * LBF_PER_INCH * deflection[1],
            1e-9 * size,
        );
    }
    assert!(stuck > 50, "{stuck}");
}

/// Sticking and slipping meet: forces do not jump at the limit, in whatever direction, jammed or not.
#[test]
fn sticking_and_slipping_meet_at_the_limit() {
    let mut random = Random(8);
    let mut jams = 0;
    for _ in 0..200 {
        let mut law = wedge(false, straight(random.between(-1.0, 1.0), 1.0));
        law.slope_friction = random.between(0.25, 0.45);
        law.column_friction = random.between(0.25, 0.45);
        let mut system = against_ground(Law::Wedge(law), Options::default());
        let (s, c) = random.between(-PI, PI).sin_cos();
        let mut at = |size: f64| {
            let deflection = [size * s, size * c];
            at_deflection(&mut system, [0.0, 0.0, -0.5 * INCH], [0.0; 3], deflection).connections[0].clone()
        };
        // any deflection in this direction tells the limit
        let limit = at(1e-6).wedge.unwrap();
        jams += usize::from(limit.jammed);
        let size = limit.friction_limit / (1e6 * LBF_PER_INCH);
        let (below, above) = (at(size * (1.0 - 1e-10)), at(size * (1.0 + 1e-10)));
        assert_eq!((below.mode, above.mode), (Some(Mode::Stick), Some(Mode::Slip)));
        for k in 0..3 {
            close(below.forces[k], above.forces[k], 1e-6 * limit.friction_limit);
        }
        let normals = [below, above].map(|state| state.wedge.unwrap().column_normal);
        close(normals[0], normals[1], 1e-6 * normals[1]);
    }
    assert!(jams > 10, "{jams}");
}

/// Longitudinal motion opens or closes the gap; the wedge rises and its coil with it.
#[test]
fn rise_follows_the_gap() {
    for direction in [1.0, -1.0] {
        let law = wedge(true, straight(0.0, direction));
        let mut system = against_ground(Law::Wedge(law.clone()), Options::default());
        // the bolster goes away from its column by 0.1 in
        let seen = at(&mut system, [-direction * 0.1 * INCH, 0.0, 0.0], [0.0; 3]);
        let state = seen.connections[0].wedge.unwrap();
        close(state.rise, 0.1 * INCH / law.angle.tan(), 1e-15);
        close(
            state.coil_force,
            3702.2 * LBF - 1979.0 * LBF_PER_INCH * state.rise,
            1e-8,
        );
        // the column pushes it back
        assert!(seen.bodies[0].accelerations[0] * direction < 0.0);
    }
}

/// The older elements: viscous up to the limit.
#[test]
fn a_viscous_wedge_creeps_and_slips() {
    let mut law = wedge(true, plain(true));
    let lvb = 1e4 * LBF_PER_INCH;
    law.accumulator = Accumulator::Viscous { damping: lvb };
    for v in [0.05, -0.05] {
        let state = wedge_at(&law, &Options::default(), 0.0, v * INCH);
        close(state.column_friction, -1e4 * LBF * v, 1e-9);
        close(
            state.column_friction,
            0.4 * state.mobilised * state.column_normal,
            1e-9,
        );
    }
    close(
        wedge_at(&law, &Options::default(), 0.0, 1.0).column_friction / LBF,
        -0.4 * 5435.9,
        0.05,
    );
    close(
        wedge_at(&law, &Options::default(), 0.0, -1.0).column_friction / LBF,
        0.4 * 2882.7,
        0.05,
    );
}

/// By velocity instead of by force: the branch changes with the sign of the velocity, whatever the accumulator holds.
#[test]
fn the_branch_by_velocity() {
    let options = Options {
        branch: Branch::Velocity {
            reference_speed: 1e-6,
        },
        ..Options::default()
    };
    let law = wedge(true, plain(true));
    let mut system = against_ground(Law::Wedge(law), options);
    let hold = [-0.001 * INCH, 0.0];
    for (v, expected) in [(-1e-4, 2882.7), (1e-4, 5435.9)] {
        let seen = at_deflection(&mut system, [0.0; 3], [0.0, 0.0, v], hold);
        let state = seen.connections[0].wedge.unwrap();
        close(state.column_normal / LBF, expected, 0.05);
        close(state.column_friction / LBF, 1000.0 - 1e3 * v / INCH, 1e-6);
    }
}
