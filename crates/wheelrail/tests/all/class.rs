//! The class of a track from its geometry: closed forms of sines, steps and joints against the rule's limits.

use std::f64::consts::PI;

use wheelrail::track::class_limits::{CLASS_LIMITS, ClassQuantity, SPEEDS};
use wheelrail::track::shape::Shape;
use wheelrail::track::{
    CenterLine, ClassValue, CurveElements, Direction, Irregularity, Placed, Rails, Segment, SpiralForm,
    Track, TrackClass,
};

const FOOT: f64 = 0.3048;
const INCH: f64 = 0.0254;

fn tangent() -> CenterLine {
    CenterLine::new(&[Segment::Tangent(1000.0 * FOOT)], 59.5 * INCH, &[]).unwrap()
}

fn placed(rails: Rails, direction: Direction, shape: Shape) -> Placed {
    Placed {
        rails,
        direction,
        irregularity: Irregularity::Shape(shape),
    }
}

fn class(center_line: CenterLine, irregularities: Vec<Placed>) -> TrackClass {
    let track = Track {
        center_line,
        irregularities,
    };
    TrackClass::of(&track, 0.5 * FOOT)
}

fn value<'c>(class: &'c TrackClass, name: &str) -> &'c ClassValue {
    class.values.iter().find(|own| own.limit.name == name).unwrap()
}

fn sine(amplitude: f64, wavelength: f64) -> Shape {
    Shape::Sine {
        amplitude: amplitude * INCH,
        wavelength: wavelength * FOOT,
        cycles: 8,
        start: 200.0 * FOOT,
    }
}

/// The largest 62-ft offset of a sine is A (1 - cos(π L/λ)) at its crests; limits of 213.63 for the profile
/// decide the class.
#[test]
fn analytic_profiles_of_sines() {
    for (wavelength, offset, expected) in [(62.0, 2.1, 3), (50.0, 1.2, 5), (100.0, 2.6, 2), (62.0, 3.1, 0)] {
        let amplitude = offset / (1.0 - (62.0 * PI / wavelength).cos());
        let found = class(
            tangent(),
            vec![placed(
                Rails::Both,
                Direction::Vertical,
                sine(amplitude, wavelength),
            )],
        );
        let profile = value(&found, "profile 62 ft");
        assert!(
            (profile.value / INCH - offset).abs() < 2e-3 * offset,
            "{profile:?}"
        );
        // A crest or a trough between the second and the last but one.
        let turns = (profile.at / FOOT - 200.0) / wavelength - 0.25;
        assert!((2.0 * turns - (2.0 * turns).round()).abs() < 0.05, "{turns}");
        assert_eq!(
            (profile.class, found.class()),
            (expected, expected),
            "{wavelength} {offset}"
        );
        let governing = found.governing().unwrap();
        assert_eq!(governing.limit.name, "profile 62 ft");
    }
}

/// A step of the alignment held for long has half its height as its offset; on a tangent the worse rail
/// counts.
#[test]
fn analytic_alinement_of_a_step() {
    let jog = Shape::Jog {
        offset: 2.2 * INCH,
        length: 0.1 * FOOT,
        start: 500.2 * FOOT,
    };
    let found = class(tangent(), vec![placed(Rails::Both, Direction::Lateral, jog)]);
    let alinement = value(&found, "alinement 62 ft, tangent");
    assert!((alinement.value / INCH - 1.1).abs() < 1e-9, "{alinement:?}");
    assert!((alinement.at / FOOT - 500.0).abs() < 32.0);
    assert_eq!((alinement.class, found.class()), (4, 4));
    assert!(!found.values.iter().any(|own| own.limit.name.ends_with("curve")));
    // Classes 6 to 9 have chords of their own; 1.1 in of 124 ft keeps class 7.
    assert_eq!(value(&found, "alinement 124 ft").class, 7);
    assert_eq!(value(&found, "alinement 31 ft").class, 5);
}

/// Gauge is 56.5 in and what both rails deviate; its play to the limit governs.
#[test]
fn analytic_gauge_wide_and_narrow() {
    let dip = |depth: f64| Shape::Dip {
        depth: -depth * INCH,
        length: 200.0 * FOOT,
        start: 300.0 * FOOT,
    };
    let wide = class(
        tangent(),
        vec![placed(Rails::Against, Direction::Lateral, dip(1.2))],
    );
    let gauge = value(&wide, "gauge, widest");
    assert!((gauge.value / INCH - 57.7).abs() < 1e-6 && (gauge.at / FOOT - 400.0).abs() < 1e-6);
    assert_eq!((gauge.class, wide.class()), (3, 3));
    assert_eq!(wide.governing().unwrap().limit.name, "gauge, widest");
    let narrow = class(
        tangent(),
        vec![placed(Rails::Against, Direction::Lateral, dip(-0.6))],
    );
    let gauge = value(&narrow, "gauge, narrowest");
    assert!((gauge.value / INCH - 55.9).abs() < 1e-6);
    assert_eq!((gauge.class, narrow.class()), (0, 0));
}

/// Cross level of a dip of one rail; warp of a step within 62 ft; both of a long slow change.
#[test]
fn analytic_cross_level_and_warp() {
    let jog = |offset: f64, length: f64| Shape::Jog {
        offset: offset * INCH,
        length: length * FOOT,
        start: 300.0 * FOOT,
    };
    let step = class(
        tangent(),
        vec![placed(Rails::Left, Direction::Vertical, jog(1.2, 40.0))],
    );
    assert!((value(&step, "cross level").value / INCH - 1.2).abs() < 1e-9);
    assert!((value(&step, "warp in 62 ft").value / INCH - 1.2).abs() < 1e-9);
    assert_eq!(value(&step, "cross level").class, 4);
    // h (1 - cos(π u/L))/2 changes most over 62 ft about its middle: h sin(π 31/L).
    let slow = class(
        tangent(),
        vec![placed(Rails::Left, Direction::Vertical, jog(3.5, 400.0))],
    );
    let warp = value(&slow, "warp in 62 ft");
    let expected = 3.5 * (PI * 31.0 / 400.0).sin();
    assert!((warp.value / INCH - expected).abs() < 1e-6, "{warp:?} {expected}");
    assert!((warp.at / FOOT - 531.0).abs() < 1.0);
    assert_eq!(value(&slow, "cross level").class, 0);
}

/// In a curve only reverse elevation counts as cross level, the outer rail's alinement alone, and the runoff
/// of a spiral is warp.
#[test]
fn analytic_curves_have_limits_of_their_own() {
    let curve = |superelevation: f64| {
        let elements = CurveElements::of_degree(4f64.to_radians(), superelevation * INCH);
        let segments = [
            Segment::Tangent(200.0 * FOOT),
            Segment::Spiral(248.0 * FOOT, SpiralForm::Clothoid),
            Segment::Curve(800.0 * FOOT, elements),
        ];
        CenterLine::new(&segments, 59.5 * INCH, &[]).unwrap()
    };
    let raised = class(curve(4.0), Vec::new());
    // A spiral of 248 ft raises 1 in in 62 ft; its first feet are flatter than a tenth of a degree.
    assert!((value(&raised, "warp in 62 ft").value / INCH - 1.0).abs() < 1e-6);
    assert!(value(&raised, "cross level").value / INCH < 0.11);
    assert_eq!(raised.class(), 5);
    let reverse = class(curve(-1.5), Vec::new());
    assert!((value(&reverse, "cross level").value / INCH - 1.5).abs() < 1e-9);
    assert_eq!(reverse.class(), 3);
    // To the left the right rail is the outer one.
    let wave = |rails| {
        let shape = Shape::Sine {
            amplitude: 0.34 * INCH,
            wavelength: 62.0 * FOOT,
            cycles: 4,
            start: 700.0 * FOOT,
        };
        class(curve(4.0), vec![placed(rails, Direction::Lateral, shape)])
    };
    let outer = wave(Rails::Right);
    let found = value(&outer, "alinement 62 ft, curve");
    assert!(
        (found.value / INCH - 0.68).abs() < 2e-3 && found.class == 4,
        "{found:?}"
    );
    assert!(value(&wave(Rails::Left), "alinement 62 ft, curve").value < 1e-12);
}

/// Ten staggered joints of 3/4 in: the cross level goes from one side to the other by twice the depth of the
/// rounded tip; six joints are too few.
#[test]
fn analytic_staggered_joints() {
    let joints = |joints: usize| {
        let side = |rails, start: f64| {
            let shape = Shape::Joints {
                depth: 0.75 * INCH,
                spacing: 39.0 * FOOT,
                joints,
                rounding: FOOT,
                start: start * FOOT,
            };
            placed(rails, Direction::Vertical, shape)
        };
        class(
            tangent(),
            vec![side(Rails::Left, 300.0), side(Rails::Right, 319.5)],
        )
    };
    let found = joints(5);
    let staggered = value(&found, "seven staggered joints");
    let tip = 0.75 * (1.0 - PI / (2.0 * 39.0));
    assert!((staggered.value / INCH - 2.0 * tip).abs() < 0.01, "{staggered:?}");
    assert_eq!(staggered.class, 1);
    let few = joints(2);
    assert!(
        !few.values
            .iter()
            .any(|own| own.limit.name == "seven staggered joints")
    );
}

/// Perfect track keeps class 5; classes grow stricter; each row has a paragraph and a mark.
#[test]
fn limits_of_the_classes() {
    let perfect = class(tangent(), Vec::new());
    assert_eq!(perfect.class(), 5);
    assert!(perfect.governing().is_some());
    assert!(SPEEDS.windows(2).all(|pair| pair[0] < pair[1]));
    for limit in CLASS_LIMITS {
        assert!(limit.paragraph.starts_with("213."), "{limit:?}");
        assert!(["read", "remembered"].contains(&limit.mark.words()));
        let given: Vec<f64> = limit.limits.iter().flatten().copied().collect();
        assert!(!given.is_empty());
        let stricter = |pair: &[f64]| match limit.quantity {
            ClassQuantity::NarrowestGauge => pair[0] <= pair[1],
            _ => pair[0] >= pair[1],
        };
        assert!(given.windows(2).all(stricter), "{limit:?}");
    }
}
