//! analytic: heading, spin, and place along a circle of curve do not matter; both ends' derivatives.

use crate::common;
use std::f64::consts::{FRAC_PI_2, TAU};
use std::sync::Arc;

use common::{BODY, POLACH, freight, linear, on_beams, on_rails, track};
use integrate::{Integrator, Options, Problem};
use mechanics::element::Element;
use mechanics::link::RelativeMotion;
use mechanics::vector::{Matrix, Vector, rotation_x, rotation_y, rotation_z};
use rolling::linear::LinearOnTrack;
use rolling::rig::{Rig, RigError, RigStart, Setup, WHEELSET, Wheels};
use rolling::track::RailSupport;
use rolling::wheel::{Search, WheelOnRail};
use rolling::wheelset::coordinate;
use wheelrail::contact::{CreepLaw, LinearWheelset, Side};
use wheelrail::track::{CurveElements, Line, RailLines, Segment};

/// Returns a circle of 10 deg of curve, to the left, and its radius.
fn circle() -> (CurveElements, f64) {
    let curve = CurveElements::of_degree(10.0_f64.to_radians(), 0.0);
    (curve, 1.0 / curve.curvature)
}

fn curved() -> Setup {
    let (curve, radius) = circle();
    let mut setup = on_rails(
        &freight(),
        track(&[Segment::Curve(TAU * radius, curve)], Vec::new()),
        POLACH,
        60.0 / 3.6,
    );
    // The carriage turns with the track and holds the wheelset's yaw to it.
    setup.carriage.stiffness = [2e6, 2e7];
    setup
}

fn left_wheel(setup: &Setup) -> WheelOnRail {
    let Wheels::OnRails { search, law, .. } = &setup.wheels else {
        unreachable!()
    };
    WheelOnRail {
        name: "wheel".to_owned(),
        lines: setup.lines.clone(),
        side: Side::Left,
        search: search[0].clone(),
        law: law.clone(),
        roll: None,
    }
}

/// Returns a wheel's motion at a distance, in the section's axes: place, yaw, roll, spin, velocities.
fn motion(
    lines: &RailLines,
    distance: f64,
    place: [f64; 3],
    [yaw, roll, spin]: [f64; 3],
) -> RelativeMotion<f64> {
    let section = lines.section_at(Line::Left, distance);
    let columns = section.axes;
    let axes = Matrix([0, 1, 2].map(|i| [columns[0][i], columns[1][i], columns[2][i]]));
    let own: Matrix<f64> = rotation_z(libm::sincos(yaw)).times(rotation_x(libm::sincos(roll)));
    let own: Matrix<f64> = own.times(rotation_y(libm::sincos(spin)));
    let arm: Vector<f64> = axes.apply(Vector(place));
    RelativeMotion {
        position: Vector(section.origin) + arm,
        rotation: axes.times(own),
        velocity: axes.apply(Vector([16.0, 0.05, -0.01])),
        angular_velocity: axes.apply(Vector([0.01, 35.2, 0.09])),
    }
}

/// The same pose in the section gives the same forces in it, all round the circle and at any angle of spin.
#[test]
fn analytic_forces_do_not_depend_on_heading_and_spin_angle() {
    let setup = curved();
    let wheel = left_wheel(&setup);
    let (_, radius) = circle();
    for (lateral, height) in [(0.0, 0.457), (0.0116, 0.4574)] {
        let at = |part: f64, spin: f64| {
            let distance = part * TAU * radius;
            let motion = motion(&setup.lines, distance, [0.0, lateral, height], [3e-3, 1e-3, spin]);
            let wrench = wheel.evaluate(&motion);
            let section = setup.lines.section_at(Line::Left, distance);
            (
                section.of(wrench.force.0),
                section.of(wrench.moment.0),
                wrench.powers,
            )
        };
        let first = at(0.1, 0.0);
        assert!(first.0[2] > 2e4, "{first:?}");
        for (part, spin) in [(0.1, 1.3), (0.25, 5e4), (0.5, -3.0), (0.77, 9.0), (0.95, 1e6)] {
            let found = at(part, spin);
            let size = first.0[2];
            for i in 0..3 {
                assert!(
                    (found.0[i] - first.0[i]).abs() < 1e-9 * size,
                    "{part} {spin}: {found:?} {first:?}"
                );
                assert!(
                    (found.1[i] - first.1[i]).abs() < 1e-9 * size,
                    "{part} {spin}: {found:?} {first:?}"
                );
            }
            assert!((found.2[0] - first.2[0]).abs() < 1e-9 * first.2[0]);
        }
    }
}

/// Once round the circle from several headings: the forces of the steady state are the same at all times and
/// headings.
#[test]
fn analytic_a_circle_of_curve_from_any_heading_has_the_same_forces() {
    let (_, radius) = circle();
    let mut expected: Option<[f64; 4]> = None;
    // One lap from a heading, and the quarter in which the body's angles pass 90 and 270 degrees from others.
    for (heading, part) in [(0.7, 1.0), (FRAC_PI_2, 0.1), (3.9, 0.15)] {
        let setup = Setup { heading, ..curved() };
        let start = RigStart {
            distance: 1.0,
            ..RigStart::default()
        };
        let mut rig = Rig::new(&setup, start).unwrap();
        let options = Options {
            relative_tolerance: 1e-4,
            ..Options::default()
        };
        let mut integrator = Integrator::new(rig.system.clone(), options, 0.0, &rig.start).unwrap();
        let end = part * TAU * radius / setup.carriage.speed;
        let times: Vec<f64> = (0..6).map(|k| 5.0 + f64::from(k) * (end - 5.0) / 5.0).collect();
        for time in times {
            while integrator.time() < time {
                integrator.step_to(time).unwrap();
            }
            let seen = rig.system.observe(integrator.time(), integrator.x());
            let mut found = [0.0; 4];
            rig.patches(&seen, |side, patch| {
                let index = usize::from(side == Side::Right);
                found[index] += patch.forces.normal * patch.patch.share;
                found[2 + index] += patch.forces.creep.y * patch.patch.share;
            });
            let expected = *expected.get_or_insert(found);
            for (found, expected) in found.iter().zip(expected) {
                assert!(
                    (found - expected).abs() < 1e-6 * 1.4e5,
                    "heading {heading}, {time} s: {found} {expected}"
                );
            }
        }
        assert!(expected.is_some_and(|found| found[2].abs() > 1e3));
    }
}

/// Creep forces in a curve lead the wheelset: the lateral balance of all forces is the centripetal force.
#[test]
fn analytic_lateral_balance_in_a_curve() {
    let setup = curved();
    let (_, radius) = circle();
    let start = RigStart {
        distance: 1.0,
        ..RigStart::default()
    };
    let mut rig = Rig::new(&setup, start).unwrap();
    let mut integrator = Integrator::new(rig.system.clone(), Options::default(), 0.0, &rig.start).unwrap();
    while integrator.time() < 10.0 {
        integrator.step_to(10.0).unwrap();
    }
    let seen = rig.system.observe(integrator.time(), integrator.x());
    let lateral = rig.relative(&setup.lines, &seen)[1];
    let body = &seen.bodies[WHEELSET];
    let section = setup.lines.section(Line::Center, body.origin.0);
    let total: f64 = (0..3)
        .map(|element| section.of(seen.elements[element].force.0)[1])
        .sum();
    let speed: f64 = section.of(body.velocity.0)[0];
    let centripetal = BODY.mass * speed * speed / (radius - lateral);
    assert!((total / centripetal - 1.0).abs() < 1e-4, "{total} {centripetal}");
}

/// The Jacobian of a rig against central differences of its rates: flange contact on sprung rails in a curve,
/// all creep laws; linear wheels.
#[test]
fn analytic_jacobian_is_that_of_differences() {
    let mut flanging = curved();
    flanging.support = Some(RailSupport::default_support("rail", 9.81));
    let rough = |law: CreepLaw| {
        let mut setup = flanging.clone();
        if let Wheels::OnRails { law: own, .. } = &mut setup.wheels {
            own.creep = law;
        }
        setup
    };
    let mut wheels = linear(
        [1250.0, 700.0, 2.5e5, 2.5e6],
        [1e7, 1e7],
        [0.05, 0.45, 0.7452],
        40.0,
    );
    // Softer in roll: rounding of 1e14 N·m/rad would be seen.
    if let Wheels::Linear { support, .. } = &mut wheels.wheels {
        support[1] = 1e9;
    }
    for setup in [
        rough(CreepLaw::Polach(wheelrail::creep::polach::DRY)),
        rough(CreepLaw::ShenHedrickElkins),
        on_beams(rough(CreepLaw::Polach(wheelrail::creep::polach::DRY))),
        wheels,
    ] {
        let start = RigStart {
            distance: 30.0,
            ..RigStart::default()
        };
        let mut rig = Rig::new(&setup, start).unwrap();
        let mut x = rig.start.clone();
        // Some lateral displacement, yaw, roll and rates.
        let speeds = rig.system.layout().speeds;
        for (own, moved) in [
            (coordinate::LATERAL, 1e-3),
            (coordinate::HEADING, 2e-3),
            (coordinate::ROLL, 5e-5),
            (coordinate::SPIN, 0.9),
        ] {
            let position = rig.system.position_of(WHEELSET, own).unwrap();
            x[position] += moved;
            x[speeds + position] += 0.3 * moved;
        }
        let n = 2 * speeds + rig.system.layout().internals;
        // Rails roll, if they do.
        for (state, value) in x[2 * speeds..n].iter_mut().zip([3e-4, 1e-5, -2e-4, 2e-5]) {
            *state = value;
        }
        let (mut dx, mut unused) = (vec![0.0; x.len()], vec![0.0; x.len()]);
        rig.system.derivative(0.0, &x, &mut dx);
        rig.system.linearize(0.0, &x, &dx, &mut unused);
        let shift = 1e3;
        rig.system.factor(shift).unwrap();
        for column in 0..n {
            let is_speed = (speeds..2 * speeds).contains(&column);
            let step = if is_speed { 3e-5 } else { 3e-8 };
            let [low, high] = [-step, step].map(|step| {
                let mut moved = x.clone();
                moved[column] += step;
                let mut dx = vec![0.0; x.len()];
                rig.system.derivative(0.0, &moved, &mut dx);
                dx
            });
            // (σ - J) e = σ e - difference, so that solving gives e back.
            let mut solved: Vec<f64> = (0..x.len()).map(|i| -(high[i] - low[i]) / (2.0 * step)).collect();
            solved[column] += shift;
            // Differences are good to some 1e-8 of the column.
            let size = solved[..n].iter().fold(0.0, |m: f64, own| m.max(own.abs())) / shift;
            rig.system.solve(&mut solved);
            for (i, value) in solved.iter().enumerate().take(n) {
                let expected = f64::from(u8::from(i == column));
                assert!(
                    (value - expected).abs() < 1e-5 + 3e-8 * size,
                    "column {column}, row {i}: {value}"
                );
            }
        }
    }
}

/// About steady rolling the element on the core gives what the two-coordinate law gives, spin and gravity
/// included: the law leaves out that rolling turns the planes of contact, so roll is zero here.
#[test]
fn analytic_linear_wheels_are_the_linear_law() {
    let setup = linear([1250.0, 700.0, 0.0, 0.0], [1e7, 8e6], [0.05, 0.45, 0.7452], 20.0);
    let Wheels::Linear {
        mut wheelset,
        support,
    } = setup.wheels
    else {
        unreachable!()
    };
    wheelset.spin = true;
    (wheelset.creep.f23, wheelset.creep.f33) = (2e4, 30.0);
    wheelset.axle_load = 1e5;
    let element = LinearOnTrack {
        name: String::new(),
        lines: setup.lines.clone(),
        wheelset,
        support,
        slowest: 1e-6,
    };
    let law: LinearWheelset = wheelset;
    let speed = 20.0;
    let radius = wheelset.geometry.radius;
    for (shift, yaw, shift_rate, yaw_rate) in [
        (1e-5, 0.0, 0.0, 0.0),
        (0.0, 1e-5, 0.0, 0.0),
        (0.0, 0.0, 1e-4, 0.0),
        (0.0, 0.0, 0.0, 1e-4),
    ] {
        let rotation = rotation_z(libm::sincos(yaw));
        let spin: Vector<f64> = rotation.column(1).scale(speed / radius);
        let wrench = element.evaluate(&RelativeMotion {
            position: Vector([30.0, shift, radius]),
            rotation,
            velocity: Vector([speed, shift_rate, 0.0]),
            angular_velocity: spin + Vector([0.0, 0.0, yaw_rate]),
        });
        let expected = law.forces([shift, yaw], [shift_rate, yaw_rate], speed);
        let found = [wrench.force.0[1], wrench.moment.0[2]];
        let size = expected[0].abs().max(expected[1].abs());
        for (found, expected) in found.iter().zip(expected) {
            assert!(
                (found - expected).abs() < 1e-4 * size,
                "{shift} {yaw} {shift_rate} {yaw_rate}: {found} {expected}"
            );
        }
        assert!(wrench.powers[0] >= 0.0);
    }
}

/// At rest sprung rails carry half the load each.
#[test]
fn analytic_sprung_rails_sink_under_their_load() {
    let mut setup = on_rails(
        &freight(),
        track(&[Segment::Tangent(50.0)], Vec::new()),
        POLACH,
        0.0,
    );
    setup.support = Some(RailSupport::default_support("rail", 9.81));
    let start = RigStart {
        distance: 10.0,
        ..RigStart::default()
    };
    let mut rig = Rig::new(&setup, start).unwrap();
    let mut integrator = Integrator::new(rig.system.clone(), Options::default(), 0.0, &rig.start).unwrap();
    while integrator.time() < 2.0 {
        integrator.step_to(2.0).unwrap();
    }
    let seen = rig.system.observe(2.0, integrator.x());
    let load = 280e3 + 1250.0 * 9.81;
    for rail in rolling::rig::RAILS {
        let sunk = -seen.bodies[rail].origin.0[2];
        assert!((sunk / (0.5 * load / 80e6) - 1.0).abs() < 1e-4, "{sunk}");
    }
}

/// A wheelset that is not over its rails, or has no load, is refused in words.
#[test]
fn input_a_wheelset_off_its_rails_is_refused() {
    let setup = on_rails(
        &freight(),
        track(&[Segment::Tangent(50.0)], Vec::new()),
        POLACH,
        1.0,
    );
    for (lateral, load) in [(0.4, 280e3), (0.0, -1e6)] {
        let mut setup = setup.clone();
        setup.carriage.load = load;
        let start = RigStart {
            distance: 10.0,
            lateral,
            yaw: 0.0,
        };
        let error = Rig::new(&setup, start).unwrap_err();
        assert!(matches!(error, RigError::NotCarried { .. }));
        assert!(error.to_string().contains("do not carry"), "{error}");
    }
    // The tables are a way of search too.
    let (wheels, _) = freight();
    let table = wheelrail::contact::ContactTable::new(wheels.pairs()[0].clone(), 1e-4).unwrap();
    let mut with_table = setup.clone();
    if let Wheels::OnRails { search, .. } = &mut with_table.wheels {
        *search = [0, 1].map(|_| Search::Table(Arc::new(table.clone())));
    }
    assert!(Rig::new(&with_table, RigStart::default()).is_ok());
}
