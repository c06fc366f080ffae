//! Wedges against their statics.

use std::f64::consts::PI;

use mechanics::connection::{Accumulator, Branch, ColumnFace, Law, Options, SlopeDirection};
use mechanics::curve::Curve;
use mechanics::quasi_static::{QuasiStaticWedge, SlidingDirection};
use mechanics::system::ContactState;
use mechanics::system::System;

use crate::analytic::{close, plain};
use crate::common::Random;
use crate::half_truck::{self, INCH, LBF, LBF_PER_INCH, straight, wedge};
use crate::models::{against_ground, at, at_deflection, wedge_at};

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
        let column = ColumnFace::Profile {
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
        for (direction, velocity) in [(SlidingDirection::Down, -1e5), (SlidingDirection::Up, 1e5)] {
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
        let column = ColumnFace::Profile {
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
        let position = [0.0, 0.0, random.between(-1.0, -0.2) * INCH];
        let observation = at_deflection(&mut system, position, [0.0; 3], deflection);
        let connection = &observation.connections[0];
        if connection.contact_state != Some(ContactState::Stick) {
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
        let ColumnFace::Profile { direction, .. } = law.column else {
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
        assert_eq!(
            (below.contact_state, above.contact_state),
            (Some(ContactState::Stick), Some(ContactState::Slip))
        );
        for k in 0..3 {
            close(below.forces[k], above.forces[k], 1e-6 * limit.friction_limit);
        }
        let normals = [below, above].map(|state| state.wedge.unwrap().column_normal);
        close(normals[0], normals[1], 1e-6 * normals[1]);
    }
    assert!(jams > 10, "{jams}");
}

/// With slope friction by its own slip: the branches of vertical sliding are those of the toe; while it
/// sticks the wedge is balanced with the slope's full friction.
#[test]
fn slope_friction_by_its_own_slip() {
    let options = Options {
        slope: SlopeDirection::OwnSlip {
            reference_speed: 1e-9,
        },
        ..Options::default()
    };
    for toe in [0.2, -0.2] {
        let law = wedge(false, straight(toe, 1.0));
        for v in [-10.0, 10.0] {
            let by_toe = wedge_at(&law, &Options::default(), -INCH, v);
            let own = wedge_at(&law, &options, -INCH, v);
            close(
                own.column_normal,
                by_toe.column_normal,
                1e-9 * by_toe.column_normal,
            );
            assert_eq!(own.jammed, by_toe.jammed);
        }
        let mut system = against_ground(Law::Wedge(law.clone()), options.clone());
        let hold = [0.0003 * INCH, 0.0];
        let observation = at_deflection(&mut system, [0.0, 0.0, -INCH], [0.0, 0.0, -1e-5], hold);
        let w = observation.connections[0].wedge.unwrap();
        let ((s, c), (p_s, p_c)) = (law.angle.sin_cos(), f64::to_radians(toe).sin_cos());
        // going down: toe out rises in its pocket and is held down, toe in is held up
        let slope = if toe > 0.0 { -0.4 } else { 0.4 };
        let up = w.coil_force - w.column_normal * p_s + w.column_friction * p_c;
        close(up, w.slope_normal * (s - slope * c), 1e-9 * w.coil_force);
        let across = w.column_normal * p_c + w.column_friction * p_s;
        close(across, w.slope_normal * (c + slope * s), 1e-9 * w.coil_force);
        close(
            w.column_friction,
            0.4 * w.mobilised * w.column_normal,
            1e-9 * w.coil_force,
        );
    }
}

/// Longitudinal motion opens or closes the gap; the wedge rises and its coil with it.
#[test]
fn rise_follows_the_gap() {
    for direction in [1.0, -1.0] {
        let law = wedge(true, straight(0.0, direction));
        let mut system = against_ground(Law::Wedge(law.clone()), Options::default());
        // the bolster goes away from its column by 0.1 in
        let observation = at(&mut system, [-direction * 0.1 * INCH, 0.0, 0.0], [0.0; 3]);
        let state = observation.connections[0].wedge.unwrap();
        close(state.rise, 0.1 * INCH / law.angle.tan(), 1e-15);
        close(
            state.coil_force,
            3702.2 * LBF - 1979.0 * LBF_PER_INCH * state.rise,
            1e-8,
        );
        // the column pushes it back
        assert!(observation.bodies[0].accelerations[0] * direction < 0.0);
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

/// By velocity instead of by force: the branch changes with the sign of the velocity, whatever the
/// accumulator holds.
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
        let observation = at_deflection(&mut system, [0.0; 3], [0.0, 0.0, v], hold);
        let state = observation.connections[0].wedge.unwrap();
        close(state.column_normal / LBF, expected, 0.05);
        close(state.column_friction / LBF, 1000.0 - 1e3 * v / INCH, 1e-6);
    }
}

/// Powers that runs sum up step by step are those of an observation.
#[test]
fn column_powers_are_those_observed() {
    let mut random = Random(12);
    let (mut given, mut taken) = (0, 0);
    for (constant, spatial) in [(true, true), (false, true), (true, false), (false, false)] {
        let mut system = System::new(half_truck::model(constant, spatial)).unwrap();
        let layout = system.layout();
        for _ in 0..40 {
            let mut x = system.initial_state();
            for i in 0..layout.speeds {
                x[i] = random.between(-0.02, 0.01);
                x[layout.speeds + i] = random.between(-0.2, 0.2);
            }
            for value in &mut x[2 * layout.speeds..][..layout.internals] {
                *value = random.between(-1e-3, 1e-3);
            }
            let time = random.between(0.0, 2.0);
            let observation = system.clone().observe(time, &x);
            let expected = observation
                .connections
                .iter()
                .enumerate()
                .filter_map(|(number, own)| {
                    let wedge = own.wedge?;
                    Some((number, -wedge.column_friction * own.velocities[0]))
                });
            let mut found = Vec::new();
            system.column_powers(time, &x, |connection, power| found.push((connection, power)));
            found.sort_by_key(|(connection, _)| *connection);
            assert!(found.iter().copied().eq(expected), "{found:?}");
            given += found.iter().filter(|(_, power)| *power > 0.0).count();
            taken += found.iter().filter(|(_, power)| *power < 0.0).count();
        }
    }
    assert!(given > 30 && taken > 30, "{given} and {taken} powers");
}
