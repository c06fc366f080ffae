//! Shapes of irregularities: their values, and that slopes are those of differences.

use wheelrail::track::shape::Shape;

const JOINTS: Shape = Shape::Joints {
    depth: 0.019,
    spacing: 11.8872,
    joints: 10,
    rounding: 0.3048,
    start: 30.0,
};
const SHAPES: [Shape; 4] = [
    JOINTS,
    Shape::Sine {
        amplitude: 0.016,
        wavelength: 11.8872,
        cycles: 5,
        start: 20.0,
    },
    Shape::Dip {
        depth: 0.01,
        length: 6.0,
        start: 10.0,
    },
    Shape::Jog {
        offset: -0.02,
        length: 5.0,
        start: 12.0,
    },
];

#[test]
fn analytic_slopes_are_those_of_differences_and_values_are_continuous() {
    let h = 1e-6;
    for shape in SHAPES {
        let mut largest = 0.0_f64;
        for i in 0..4000 {
            let s = 0.05 * f64::from(i) + 0.000_37;
            let (down, here, up) = (shape.at(s - h), shape.at(s), shape.at(s + h));
            assert!((up[0] - down[0]).abs() < 1e-7, "{shape:?} jumps at {s}");
            assert!(
                ((up[0] - down[0]) / (2.0 * h) - here[1]).abs() < 1e-7,
                "{shape:?} at {s}"
            );
            assert!(
                ((up[1] - down[1]) / (2.0 * h) - here[2]).abs() < 1e-6,
                "{shape:?} at {s}"
            );
            largest = largest.max(here[0].abs());
        }
        assert!(largest > 0.009, "{shape:?}");
    }
}

/// Joints are low by the depth less what rounds the tip; rails are level in the middle. Two rails with their
/// joints half a rail apart have a cross level of at most the depth.
#[test]
fn analytic_joints_and_their_cross_level() {
    let Shape::Joints {
        depth,
        spacing,
        start,
        ..
    } = JOINTS
    else {
        panic!("joints")
    };
    let lowest = JOINTS.at(start + 3.0 * spacing);
    let expected = -depth * (1.0 - 0.5 * std::f64::consts::PI * 0.3048 / spacing);
    assert!(
        (lowest[0] - expected).abs() < 1e-2 * depth && lowest[1].abs() < 1e-12,
        "{lowest:?}"
    );
    assert!(JOINTS.at(start + 3.5 * spacing)[0].abs() < 1e-12);
    assert_eq!(JOINTS.at(start - spacing), [0.0; 3]);
    assert_eq!(JOINTS.at(start + 10.0 * spacing), [0.0; 3]);
    let cross_level = |s: f64| JOINTS.at(s)[0] - JOINTS.at(s - 0.5 * spacing)[0];
    let largest = (0..2000)
        .map(|i| cross_level(60.0 + 0.01 * f64::from(i)).abs())
        .fold(0.0, f64::max);
    assert!(largest <= depth && largest > 0.95 * depth, "{largest}");
}
