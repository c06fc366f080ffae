//! Limits of climbing, and the lift of a wheel.

use wheelrail::climb::{LEAST, nadal, weinstock};
use wheelrail::contact::{ContactPair, Side, WheelPose};
use wheelrail::friction::{DRY, Friction, Zones};
use wheelrail::hertz::Material;
use wheelrail::profile::nominal;

/// From the equilibrium of a flange that slides down: a normal force and friction up the face.
#[test]
fn analytic_nadal_is_the_equilibrium_of_a_sliding_flange() {
    for degrees in [60.0_f64, 68.0, 70.0, 75.0, 89.0] {
        for friction in [0.0, 0.1, 0.3, 0.5, 1.0] {
            let (sine, cosine) = degrees.to_radians().sin_cos();
            let (normal, up) = (1.7, 1.7 * friction);
            let lateral = normal * sine - up * cosine;
            let vertical = normal * cosine + up * sine;
            let expected = lateral / vertical;
            assert!((nadal(degrees.to_radians(), friction) / expected - 1.0).abs() < 1e-12);
        }
    }
    // 49 CFR 213.333: 1.13 for 75 degrees and a friction of 0.5.
    assert!((nadal(75_f64.to_radians(), 0.5) - 1.13).abs() < 5e-3);
    assert!((weinstock(1.13, 0.3) - 1.43).abs() < 1e-12);
    // Friction alone holds a face of 45 degrees.
    assert_eq!(nadal(45_f64.to_radians(), 1.2), LEAST);
    assert_eq!(
        nadal(120_f64.to_radians(), 2.0),
        nadal(120_f64.to_radians(), 2.0).max(LEAST)
    );
}

/// The greatest friction is that of the worst place, in the zone of the angle, where nothing slips.
#[test]
fn analytic_greatest_friction_of_all_places() {
    let zones = |tread, gauge_face| Zones { tread, gauge_face };
    let own = Friction {
        zones: zones(0.9, 0.9),
        over: Some(
            [
                (0.0, zones(0.5, 0.2)),
                (10.0, zones(0.3, 0.4)),
                (20.0, zones(0.6, 0.1)),
            ]
            .into(),
        ),
        falling: Some(DRY),
    };
    assert!((own.greatest(75_f64.to_radians().tan()) - 0.4).abs() < 1e-12);
    assert!((own.greatest(0.0) - 0.6).abs() < 1e-12);
    assert!((own.at_rest(0.0, 5.0) - 0.4).abs() < 1e-12);
    assert_eq!(Friction::by_zone(0.5, 0.2).greatest(2.0), 0.2);
}

/// A wheel that is raised by a height has that lift; one that bears has none, one beside its rail no number.
#[test]
fn analytic_the_lift_of_a_raised_wheel() {
    let steel = Material {
        youngs_modulus: 207e9,
        poisson: 0.27,
    };
    let rail = nominal::rail_136re().unwrap();
    let radius = 0.4572;
    let pair = ContactPair::new(&nominal::aar_1b().unwrap(), radius, &rail, steel).unwrap();
    let pose = |y: f64, z: f64| WheelPose::of(Side::Left, [y, z], 0.0, 0.0);
    // Where it just bears.
    let touch = pair.touch(&pose(0.0, radius)).unwrap();
    let bears = radius + touch.overlap;
    for height in [1e-6, 1e-4, 5e-3, 20e-3] {
        let lift = pair.lift(&pose(0.0, bears + height)).unwrap();
        assert!((lift - height).abs() < 1e-10, "{lift} {height}");
    }
    assert_eq!(pair.lift(&pose(0.0, bears - 1e-4)), Some(0.0));
    assert_eq!(pair.lift(&pose(0.5, bears)), None);
}
