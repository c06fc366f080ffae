//! Models that make no system are refused, with words that help.

use mechanics::body::Body;
use mechanics::connection::{
    Accumulator, ColumnFace, ConnectionError, GapDamper, Law, Options, SpringDamper, SurfaceFriction,
};
use mechanics::contact::FrictionDirections;
use mechanics::curve::{Curve, CurveError};
use mechanics::system::{Model, ModelError, System};

use crate::half_truck::{ALL, wedge};
use crate::models::{connection, model};

fn refused(change: impl FnOnce(&mut Model)) -> ModelError {
    let bodies = vec![
        Body::linearized("a", [0.0; 3], ALL, 1.0, [1.0; 3]),
        Body::ground(),
        Body::ground(),
    ];
    let law = Law::Springs(vec![(0, SpringDamper::spring(Curve::linear(1.0)))]);
    let mut model = model(bodies, vec![connection(0, 1, [0.0; 3], law)]);
    assert!(System::new(model.clone()).is_ok());
    change(&mut model);
    System::new(model).unwrap_err()
}

fn of_wedge(change: impl FnOnce(&mut mechanics::connection::Wedge)) -> ModelError {
    let mut law = wedge(false, ColumnFace::Plain { toe_out: true });
    change(&mut law);
    refused(|model| model.connections[0].law = Law::Wedge(law))
}

#[test]
fn wrong_models_are_refused() {
    let no_body = refused(|model| model.connections[0].b = 7);
    assert!(matches!(
        no_body,
        ModelError::Connection(ConnectionError::NoSuchBody {
            number: 7,
            count: 3,
            ..
        })
    ));
    assert!(matches!(
        refused(|model| model.connections[0].b = 0),
        ModelError::Connection(ConnectionError::Itself { .. })
    ));
    let fixed = refused(|model| (model.connections[0].a, model.connections[0].b) = (1, 2));
    assert!(matches!(
        fixed,
        ModelError::Connection(ConnectionError::NothingToMove { .. })
    ));
    let none = refused(|model| model.bodies[0] = Body::linearized("a", [0.0; 3], [false; 6], 1.0, [1.0; 3]));
    assert!(matches!(none, ModelError::NothingFree));
    let light = refused(|model| model.bodies[0] = Body::linearized("a", [0.0; 3], ALL, 1.0, [1.0, 0.0, 1.0]));
    assert!(light.to_string().contains("pitch"), "{light}");
    let spring = SpringDamper::spring(Curve::linear(1.0));
    let sixth = refused(|model| model.connections[0].law = Law::Springs(vec![(6, spring)]));
    assert!(matches!(
        sixth,
        ModelError::Connection(ConnectionError::Coordinate { coordinate: 6, .. })
    ));
    let twice = SurfaceFriction {
        clamped: false,
        directions: FrictionDirections::Two,
        coordinates: [2, 1, 1],
        spring: Curve::linear(1.0),
        damper: None,
        coefficient: 0.5,
        accumulator: Accumulator::Viscous { damping: 1.0 },
    };
    let twice = refused(|model| model.connections[0].law = Law::Surface(twice));
    assert!(matches!(
        twice,
        ModelError::Connection(ConnectionError::Coordinate { coordinate: 1, .. })
    ));
    let gap = GapDamper {
        spring: None,
        damper: None,
        low: 1.0,
        high: 0.0,
    };
    let gap = refused(|model| model.connections[0].law = Law::Gap(2, gap));
    assert!(gap.to_string().contains("upper end"), "{gap}");
    let options = refused(|model| model.options.accumulator_damping = 0.0);
    assert!(options.to_string().contains("accumulator_damping"), "{options}");
}

#[test]
fn wrong_wedges_are_refused() {
    for (error, word) in [
        (of_wedge(|law| law.angle = 0.0), "between 0 and"),
        (
            of_wedge(|law| (law.angle, law.slope_friction) = (1.4, 0.4)),
            "angle of friction",
        ),
        (of_wedge(|law| law.column_friction = -0.1), "column"),
        (of_wedge(|law| law.normal_limit = 0.0), "normal limit"),
        (
            of_wedge(|law| law.accumulator = Accumulator::Viscous { damping: 0.0 }),
            "LVB",
        ),
        (
            of_wedge(|law| {
                law.accumulator = Accumulator::Bristle {
                    stiffness: 1.0,
                    damping: f64::NAN,
                }
            }),
            "damping",
        ),
        (
            of_wedge(|law| {
                law.column = ColumnFace::Profile {
                    depth: Curve::linear(2.0),
                    direction: 1.0,
                }
            }),
            "inclination",
        ),
        (
            of_wedge(|law| {
                law.column = ColumnFace::Profile {
                    depth: Curve::linear(0.0),
                    direction: 0.5,
                }
            }),
            "1 or -1",
        ),
    ] {
        assert!(error.to_string().contains(word), "{error}");
    }
}

#[test]
fn wrong_curves_are_refused() {
    assert_eq!(Curve::new(vec![]), Err(CurveError::Empty));
    let not = Curve::new(vec![[0.0, 0.0], [1.0, f64::NAN]]);
    assert_eq!(not, Err(CurveError::NotFinite { index: 2 }));
    let back = Curve::new(vec![[0.0, 0.0], [1.0, 0.0], [1.0, 2.0]]);
    assert!(matches!(back, Err(CurveError::NotIncreasing { index: 3, .. })));
}

/// Choices read and write, and say in words what they are.
#[test]
fn options_are_named_in_words() {
    let options = Options::default();
    let text = serde_json::to_string(&options).unwrap();
    assert_eq!(serde_json::from_str::<Options>(&text).unwrap(), options);
    let words = options.describe();
    assert!(words.len() >= 15);
    for word in [
        "branch",
        "never tension",
        "circle",
        "mobilised",
        "capped",
        "gyroscopic",
        "roll",
    ] {
        assert!(words.iter().any(|line| line.contains(word)), "{word}");
    }
    let other = Options {
        plain_toe_angle: f64::to_radians(0.2),
        ..Options::default()
    };
    assert_ne!(other.describe(), words);
}
