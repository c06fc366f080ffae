//! A wheel driven to climb its rail.

use crate::common;
use common::{POLACH, freight, on_rails, track};
use mechanics::element::Element;
use mechanics::link::RelativeMotion;
use mechanics::vector::{Matrix, Vector, rotation_z};
use rolling::rig::Wheels;
use rolling::wheel::WheelOnRail;
use wheelrail::contact::{ContactLaw, CreepLaw, Side};
use wheelrail::creep::fastsim::StripGrid;
use wheelrail::friction::Friction;
use wheelrail::track::Segment;

/// Returns the zero of a falling function.
fn zero([mut low, mut high]: [f64; 2], falling: impl Fn(f64) -> f64) -> f64 {
    for _ in 0..25 {
        let middle = 0.5 * (low + high);
        *(if falling(middle) > 0.0 {
            &mut low
        } else {
            &mut high
        }) = middle;
    }
    0.5 * (low + high)
}

/// Returns the largest ratio of lateral to vertical force on the way over the flange, of a left wheel under a
/// load (N) at an angle of attack (rad) whose axle turns freely; and the tangent of the contact angle there.
fn largest_ratio(law: ContactLaw, attack: f64, load: f64) -> [f64; 2] {
    let wheels = freight();
    let half = 0.5 * wheels.1;
    let setup = on_rails(
        &wheels,
        track(&[Segment::Tangent(40.0)], Vec::new()),
        law.clone(),
        10.0,
    );
    let Wheels::OnRails { search, .. } = &setup.wheels else {
        unreachable!()
    };
    let wheel = WheelOnRail {
        name: "wheel".to_owned(),
        lines: setup.lines.clone(),
        side: Side::Left,
        search: search[0].clone(),
        law,
        roll: None,
    };
    let rotation: Matrix<f64> = rotation_z(libm::sincos(attack));
    let axle: Vector<f64> = rotation.column(1);
    let motion = |shift: f64, height: f64, spin: f64| RelativeMotion {
        position: Vector([20.0, half + shift, height]),
        rotation,
        velocity: Vector([10.0, 0.0, 0.0]),
        angular_velocity: axle.scale(spin),
    };
    let free = |shift: f64, height: f64| {
        // A wheel that turns faster is held back.
        let torque = |spin: f64| {
            wheel
                .evaluate(&motion(shift, height, spin))
                .moment
                .dot::<f64, f64>(axle)
        };
        motion(shift, height, zero([19.0, 24.0], torque))
    };
    let mut largest = [0.0_f64; 2];
    // At 50 mrad the flange comes to the rail at 8.2 mm, and the tread is lifted from 8.3 mm on.
    for step in 0..12 {
        let shift = 8.268e-3 + 0.01e-3 * f64::from(step);
        let up = |height: f64| wheel.evaluate(&free(shift, height)).force.0[2] - load;
        let own = free(shift, zero([0.45, 0.465], up));
        let [_, lateral, vertical] = wheel.evaluate(&own).force.0;
        let mut most = (0.0, 0.0);
        wheel.patches(&own, [0.0; 2], |patch| {
            let [x, y, z] = patch.normal.0;
            if patch.forces.normal > most.0 {
                most = (patch.forces.normal, libm::hypot(x, y) / z);
            }
        });
        if (vertical / load - 1.0).abs() < 1e-3 && -lateral / vertical > largest[0] {
            largest = [-lateral / vertical, most.1];
        }
    }
    largest
}

/// Nadal's limit `(tan δ - μ)/(1 + μ tan δ)` by creep laws that saturate, at an angle of attack of 50 mrad.
/// The flange of 75° then meets the rail 90 mm ahead of the axle, where the wheel is 8 mm higher: the contact
/// angle δ there is that of the tip's beginning, 70°. Polach's law comes near to its saturation but slowly:
/// 15 % above.
#[test]
fn analytic_a_wheel_that_climbs_reaches_nadals_limit() {
    let fastsim = CreepLaw::Fastsim(StripGrid {
        cells: 20,
        strips: 20,
    });
    for (name, creep, friction) in [
        ("FASTSIM", fastsim, 0.4),
        ("Shen-Hedrick-Elkins", CreepLaw::ShenHedrickElkins, 0.4),
        ("Shen-Hedrick-Elkins", CreepLaw::ShenHedrickElkins, 0.3),
    ] {
        let law = ContactLaw {
            creep,
            friction: Friction::constant(friction),
            damping: 0.0,
            ..POLACH
        };
        let [found, slope] = largest_ratio(law, 0.05, 100e3);
        let nadal = (slope - friction) / (1.0 + friction * slope);
        assert!((69.0_f64..75.5).contains(&slope.atan().to_degrees()), "{slope}");
        assert!(
            (found / nadal - 1.0).abs() < 0.02,
            "{name} {friction}: {found}, {nadal} by Nadal"
        );
    }
}
