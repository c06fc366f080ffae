//! analytic, input: Hertz's contact.

use numerics::scalar::Dual;
use wheelrail::hertz::{EllipseShape, Hertz, HertzError, Material, elliptic_integrals};

const STEEL: Material = Material {
    youngs_modulus: 207e9,
    poisson: 0.27,
};

/// Semi-axes and approach by the angle θ with cos θ = |B - A| / (A + B), from exact elliptic integrals of
/// another program, to four decimals.
#[test]
fn analytic_semi_axes_and_approach_by_the_table() {
    for (degrees, major, minor, approach) in [
        (1.0, 36.9319, 0.1313, 0.1211),
        (6.0, 9.7883, 0.2552, 0.3274),
        (20.0, 3.8160, 0.4121, 0.6038),
        (45.0, 1.9265, 0.6038, 0.8547),
        (60.0, 1.4858, 0.7171, 0.9376),
        (75.0, 1.2020, 0.8448, 0.9847),
        (85.0, 1.0609, 0.9442, 0.9983),
        (90.0, 1.0, 1.0, 1.0),
    ] {
        let cosine = f64::cos(f64::to_radians(degrees));
        let shape = EllipseShape::of((1.0 - cosine) / (1.0 + cosine));
        for (found, expected) in [
            (shape.major, major),
            (shape.minor, minor),
            (shape.approach, approach),
        ] {
            assert!(
                (found - expected).abs() < 6e-5,
                "{degrees}°: {found}, {expected} expected"
            );
        }
    }
}

/// A 36 in wheel on a crown of 10 in under 160 kN, from another program.
#[test]
fn analytic_a_wheel_on_a_rail_crown() {
    let hertz = Hertz::new(STEEL, 1.0 / 0.4572, 1.0 / 0.254).unwrap();
    let [a, b] = hertz.semi_axes(160e3);
    assert!(
        (a - 8.660e-3).abs() < 1e-6 && (b - 5.856e-3).abs() < 1e-6,
        "{a} {b}"
    );
    assert!((hertz.greatest_pressure(160e3) / 1506e6 - 1.0).abs() < 5e-4);
    assert!((hertz.approach(160e3) - 0.1495e-3).abs() < 1e-7);
    assert!((hertz.load(hertz.approach(160e3)) / 160e3 - 1.0).abs() < 1e-12);
    // Turned by a quarter, the ellipse turns with it.
    let turned = Hertz::new(STEEL, 1.0 / 0.254, 1.0 / 0.4572).unwrap();
    assert_eq!(turned.semi_axes(160e3), [b, a]);
}

/// Two spheres: a³ = 3 N R/(4 E*) with 1/R the sum of curvatures, d = a²/R.
#[test]
fn analytic_spheres() {
    let hertz = Hertz::new(STEEL, 1.0 / 0.3, 1.0 / 0.3).unwrap();
    let modulus = STEEL.composite_modulus();
    let [a, b] = hertz.semi_axes(5e4);
    let expected = (3.0 * 5e4 * 0.3 / (4.0 * modulus)).cbrt();
    assert!((a / expected - 1.0).abs() < 1e-12 && (b / expected - 1.0).abs() < 1e-12);
    assert!((hertz.approach(5e4) / (a * a / 0.3) - 1.0).abs() < 1e-12);
}

/// Legendre's relation K(m) E(1-m) + E(m) K(1-m) - K(m) K(1-m) = π/2.
#[test]
fn analytic_elliptic_integrals_obey_legendres_relation() {
    for i in 1..20 {
        let g = 0.05 * f64::from(i);
        let [k, e] = elliptic_integrals(g);
        let [k1, e1] = elliptic_integrals((1.0 - g * g).sqrt());
        let sum = k * e1 + e * k1 - k * k1;
        assert!((sum - std::f64::consts::FRAC_PI_2).abs() < 1e-13, "{g}: {sum}");
    }
}

#[test]
fn analytic_derivatives_of_load_and_semi_axes() {
    let hertz = Hertz::new(STEEL, 2.0, 4.0).unwrap();
    let (d, h) = (1e-4, 1e-8);
    let found = hertz.load(Dual::<1>::variable(d, 0)).derivative[0];
    let expected = (hertz.load(d + h) - hertz.load(d - h)) / (2.0 * h);
    assert!((found / expected - 1.0).abs() < 1e-6);
    let [found, _] = hertz.semi_axes(Dual::<1>::variable(1e5, 0));
    let [up, down] = [1e5 + 10.0, 1e5 - 10.0].map(|load| hertz.semi_axes(load)[0]);
    assert!((found.derivative[0] / ((up - down) / 20.0) - 1.0).abs() < 1e-6);
    assert_eq!(hertz.load(-1e-5), 0.0);
}

#[test]
fn input_what_no_ellipse_is_made_of_is_refused() {
    for (rolling, lateral, place) in [
        (0.0, 1.0, "along"),
        (1.0, -0.5, "across"),
        (1.0, f64::NAN, "across"),
    ] {
        let error = Hertz::new(STEEL, rolling, lateral).unwrap_err();
        assert!(error.to_string().contains(place), "{error}");
    }
    let soft = Material {
        youngs_modulus: -1.0,
        ..STEEL
    };
    assert!(matches!(
        Hertz::new(soft, 1.0, 1.0),
        Err(HertzError::Material { .. })
    ));
    let swelling = Material {
        poisson: 0.7,
        ..STEEL
    };
    assert!(
        Hertz::new(swelling, 1.0, 1.0)
            .unwrap_err()
            .to_string()
            .contains("Poisson")
    );
}
