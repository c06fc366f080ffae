//! analytic, energy: a rail that rolls under its wheel.

use crate::common;
use common::{INCH, POLACH, freight, on_beams, on_rails, track};
use integrate::{Integrator, Options};
use mechanics::element::Element;
use mechanics::link::RelativeMotion;
use mechanics::vector::{Matrix, Vector, rotation_x};
use rolling::beam::RailBeam;
use rolling::rig::{Rig, RigStart, Wheels};
use rolling::wheel::WheelOnRail;
use wheelrail::contact::Side;
use wheelrail::track::{CurveElements, Line, Segment, SpiralForm};

/// What a state that is a rate stands for, s.
const WAY: f64 = 1e-3;

fn curve() -> Vec<Segment> {
    let elements = CurveElements {
        curvature: 1.0 / 250.0,
        superelevation: 0.1,
    };
    vec![
        Segment::Tangent(20.0),
        Segment::Spiral(40.0, SpiralForm::Bloss),
        Segment::Curve(100.0, elements),
    ]
}

/// A wheel on a rail that has rolled is the wheel rolled back about the base on a rail that has not: forces
/// turn with the rail, and what it does to the rail's roll is the moment about the base.
#[test]
fn analytic_a_rolled_rail_is_a_wheel_rolled_back() {
    let setup = on_beams(on_rails(&freight(), track(&curve(), Vec::new()), POLACH, 12.0));
    let Wheels::OnRails { search, law, .. } = &setup.wheels else {
        unreachable!()
    };
    let own = RailBeam::rail_136re().rolling();
    for (index, side) in [Side::Left, Side::Right].into_iter().enumerate() {
        let rigid = WheelOnRail {
            name: "wheel".to_owned(),
            lines: setup.lines.clone(),
            side,
            search: search[index].clone(),
            law: law.clone(),
            roll: None,
        };
        let rolling = WheelOnRail {
            roll: Some(own),
            ..rigid.clone()
        };
        let sign = [1.0, -1.0][index];
        let line = [Line::Left, Line::Right][index];
        let section = setup.lines.section_at(line, 90.0);
        let axes = Matrix(section.axes).transpose();
        for (roll, rate, lateral) in [(2e-3, 0.3, 0.0), (-1e-3, -0.2, 3e-3), (5e-3, 0.0, -2e-3)] {
            let turned: Matrix<f64> = rotation_x(libm::sincos(1e-3));
            let motion = RelativeMotion {
                position: Vector(section.origin)
                    + axes.apply::<f64, f64>(Vector([0.0, sign * (7.0 * INCH / 2000.0) + lateral, 0.457])),
                rotation: axes.times(turned),
                velocity: axes.apply(Vector([12.0, 0.05, -0.01])),
                angular_velocity: axes.apply(Vector([0.01, 26.3, 0.05])),
            };
            let states = [roll * own.height, rate * own.height * WAY];
            let (wrench, rates) = rolling.evaluate_with(&motion, states);
            // By rigid motions about the base, outwards.
            let base =
                Vector(section.origin) + axes.apply::<f64, f64>(Vector([0.0, sign * own.base, -own.height]));
            let outwards: Matrix<f64> = rotation_x(libm::sincos(-sign * roll));
            let outwards: Matrix<f64> = axes.times(outwards.times(axes.transpose()));
            let turning: Vector<f64> = axes.apply(Vector([-sign * rate, 0.0, 0.0]));
            let arm = motion.position - base;
            let back = |v: Vector<f64>| -> Vector<f64> { outwards.apply_transposed(v) };
            let rolled_back = RelativeMotion {
                position: base + back(arm),
                rotation: outwards.transpose().times(motion.rotation),
                velocity: back(motion.velocity - turning.cross::<f64, f64>(arm)),
                angular_velocity: back(motion.angular_velocity - turning),
            };
            let expected = rigid.evaluate(&rolled_back);
            let size = wrench.force.0[2];
            assert!(size > 1e4, "{side:?} {size}");
            let (force, moment): (Vector<f64>, Vector<f64>) =
                (outwards.apply(expected.force), outwards.apply(expected.moment));
            for i in 0..3 {
                assert!((wrench.force.0[i] - force.0[i]).abs() < 1e-9 * size);
                assert!((wrench.moment.0[i] - moment.0[i]).abs() < 1e-9 * size);
            }
            let about: Vector<f64> = moment + arm.cross::<f64, f64>(force);
            let on_rail = sign * axes.column(0).dot::<f64, f64>(about);
            let acceleration = (on_rail - own.stiffness * roll - own.damping * rate) / own.inertia;
            let found = rates[1] / (WAY * own.height);
            assert!(
                (found / acceleration - 1.0).abs() < 1e-9,
                "{found} {acceleration}"
            );
            assert!((rates[0] - rate * own.height).abs() < 1e-15);
            let lost = expected.powers[0] + own.damping * rate * rate;
            assert!((wrench.powers[0] / lost - 1.0).abs() < 1e-9);
        }
    }
}

/// In a curve rails roll to where their stiffness balances the forces at the patches, added up by hand; the
/// ledger closes on the way there.
#[test]
fn energy_rails_roll_in_a_curve() {
    let setup = on_beams(on_rails(&freight(), track(&curve(), Vec::new()), POLACH, 12.0));
    let start = RigStart {
        distance: 1.0,
        ..RigStart::default()
    };
    let mut rig = Rig::new(&setup, start).unwrap();
    let stored = rig.system.observe(0.0, &rig.start).energies.total();
    let options = Options {
        relative_tolerance: 1e-6,
        ..Options::default()
    };
    let mut integrator = Integrator::new(rig.system.clone(), options, 0.0, &rig.start).unwrap();
    let end = 9.0;
    while integrator.time() < end {
        integrator.step_to(end).unwrap();
    }
    let seen = rig.system.observe(integrator.time(), integrator.x());
    let own = RailBeam::rail_136re().rolling();
    let mut moments = [0.0; 2];
    rig.patches(&seen, |side, patch| {
        let (place, normal, across) = (patch.patch.place, patch.patch.normal(), patch.patch.across());
        let of = |k: usize| {
            (normal[k] * patch.forces.normal + across[k] * patch.forces.creep.y) * patch.patch.share
        };
        let index = usize::from(matches!(side, Side::Right));
        // On the rail: the opposite ones.
        moments[index] += -of(1) * (place[2] + own.height) + of(2) * (place[1] - own.base);
    });
    let states: Vec<[f64; 2]> = seen.elements.iter().map(|element| element.states).collect();
    let rolls: Vec<f64> = states
        .iter()
        .filter(|own| own[0] != 0.0)
        .map(|own_| own_[0] / own.height)
        .collect();
    let [left, right] = rolls[..] else {
        panic!("{states:?}")
    };
    for (roll, moment) in [left, right].into_iter().zip(moments) {
        assert!(
            (roll * own.stiffness / moment - 1.0).abs() < 2e-3,
            "{roll} {moment}"
        );
    }
    // The curve is to the left, its outer rail is pushed outwards.
    assert!(right > 5e-4 && right < 5e-3, "{left} {right}");
    let residual = seen.residual(stored);
    assert!(
        residual.abs() < 1e-4 * seen.losses,
        "{residual} of {}",
        seen.losses
    );
}
