//! Models that make no system, tables that make no law, and what is written and read back.

use crate::common::{ALL, body, coil, face, ground, model};
use mechanics::body::Body;
use mechanics::characteristic::{Characteristic, CharacteristicError};
use mechanics::coil::{CoilLaw, CoilLine};
use mechanics::frame::Frame;
use mechanics::friction::FrictionLaw;
use mechanics::motion::{Motion, RampProfile};
use mechanics::spline::Spline;
use mechanics::system::{EnergyTermKind, Model, ModelError, System, marker_at};

const TANH: FrictionLaw = FrictionLaw::Tanh { reference_speed: 0.1 };
const BRISTLE: FrictionLaw = FrictionLaw::Bristle {
    stiffness: 1e5,
    damping: 1e2,
};

fn free(name: &str) -> Body {
    body(name, 1.0, [1.0; 3], [0.0; 3], ALL, [0.0; 6])
}

fn with_face(bodies: Vec<Body>, body: usize, on: usize) -> Model {
    let mut model = model(bodies, [0.0; 3]);
    let one = face("face", &[[0.0; 3]], 1.0, 0.0, 0.3, TANH);
    model.faces.push((body, on, marker_at([0.0; 3]), one));
    model
}

fn with_coil(bodies: Vec<Body>, body: usize, on: usize) -> Model {
    let mut model = model(bodies, [0.0; 3]);
    let one = coil([0.0; 3], [0.0; 3], 1.0, 1.0);
    model.coils.push((body, on, marker_at([0.0, 0.0, -1.0]), one));
    model
}

#[test]
fn elements_on_bodies_that_do_not_exist() {
    for build in [with_face, with_coil] {
        for (a, b, number) in [(0, 2, 2), (2, 0, 2), (7, 9, 7)] {
            let error = System::new(build(vec![free("a"), ground()], a, b)).unwrap_err();
            assert_eq!(error, ModelError::NoSuchBody { number, count: 2 });
            assert!(error.to_string().contains(&number.to_string()));
        }
    }
}

#[test]
fn elements_from_a_body_to_itself() {
    for build in [with_face, with_coil] {
        let error = System::new(build(vec![free("a"), free("lonely")], 1, 1)).unwrap_err();
        let named = "lonely".to_owned();
        assert_eq!(error, ModelError::Itself { body: named });
    }
}

#[test]
fn elements_that_carry_a_prescribed_body() {
    for build in [with_face, with_coil] {
        let error = System::new(build(vec![free("a"), ground()], 1, 0)).unwrap_err();
        let named = "ground".to_owned();
        assert_eq!(error, ModelError::NotFree { body: named });
        // The other way round it is fine.
        assert!(System::new(build(vec![free("a"), ground()], 0, 1)).is_ok());
    }
}

#[test]
fn nothing_free() {
    for bodies in [vec![], vec![ground()], vec![ground(), ground()]] {
        let error = System::new(model(bodies, [0.0; 3])).unwrap_err();
        assert_eq!(error, ModelError::NothingFree);
    }
}

#[test]
fn held_coordinates_in_a_moving_frame() {
    let mut moving = Frame::fixed([0.0; 3], [0.0; 3]);
    moving.motions[1] = Motion::Sine {
        amplitude: 1.0,
        angular_frequency: 1.0,
        phase: 0.0,
    };
    for held in 0..6 {
        let mut one = free("rider");
        one.frame = moving.clone();
        assert!(System::new(model(vec![one.clone()], [0.0; 3])).is_ok());
        one.free[held] = false;
        let error = System::new(model(vec![one.clone()], [0.0; 3])).unwrap_err();
        let named = "rider".to_owned();
        assert_eq!(error, ModelError::HeldInMovingFrame { body: named });
        // A frame that holds another pose does not move.
        one.frame.motions[1] = Motion::Sum(vec![Motion::Constant(0.3), Motion::Constant(0.1)]);
        assert!(System::new(model(vec![one], [0.0; 3])).is_ok());
    }
}

#[test]
fn places_in_the_state_vector() {
    let mut a = free("a");
    a.free = [true, false, true, false, true, true];
    a.initial = [0.1, 0.2, 0.3, 0.4, 0.5, 0.6];
    let b = free("b");
    let mut parts = with_face(vec![a, ground(), b], 0, 1);
    let marker = marker_at([0.0; 3]);
    let mut damped = face("damped", &[[0.0; 3], [1.0, 0.0, 0.0]], 1.0, 2.0, 0.3, BRISTLE);
    damped.name = "two".to_owned();
    parts.faces.push((2, 0, marker, damped));
    let mut one = coil([0.0; 3], [1.0, 0.0, 0.0], 1.0, 1.0);
    parts.coils.push((0, 1, marker_at([0.0, 0.0, -1.0]), one.clone()));
    one.damping = 1.0;
    parts.coils.push((2, 1, marker_at([0.0, 0.0, -1.0]), one));
    let system = System::new(parts).unwrap();
    let layout = system.layout();
    assert_eq!((layout.speeds, layout.internals, layout.quadratures), (10, 4, 7));
    assert_eq!(system.point_count(), 3);
    assert_eq!(system.position_of(0, 0), Some(0));
    assert_eq!(system.position_of(0, 1), None);
    assert_eq!(system.position_of(0, 5), Some(3));
    assert_eq!(system.position_of(1, 0), None);
    assert_eq!(system.position_of(2, 0), Some(4));
    assert_eq!(system.position_of(2, 5), Some(9));
    let mut expected = vec![0.1, 0.3, 0.5, 0.6];
    expected.resize(layout.len(), 0.0);
    assert_eq!(system.initial_state(), expected);
    let energy_terms: Vec<(EnergyTermKind, &str)> = system
        .energy_terms()
        .iter()
        .map(|energy_term| (energy_term.kind, energy_term.element.as_str()))
        .collect();
    assert_eq!(
        energy_terms,
        [
            (EnergyTermKind::MotionWork, ""),
            (EnergyTermKind::FrictionLoss, "face"),
            (EnergyTermKind::FrictionLoss, "two"),
            (EnergyTermKind::ContactDampingLoss, "two"),
            (EnergyTermKind::CoilGuideWork, "coil"),
            (EnergyTermKind::CoilDampingLoss, "coil_2"),
            (EnergyTermKind::CoilGuideWork, "coil_2"),
        ]
    );
}

#[test]
fn characteristics() {
    use CharacteristicError::{Falling, NotFinite, NotIncreasing, TooFew};
    let new = |points: &[[f64; 2]]| Characteristic::new(points.to_vec());
    assert_eq!(new(&[]), Err(TooFew { got: 0 }));
    assert_eq!(new(&[[0.0, 0.0]]), Err(TooFew { got: 1 }));
    for bad in [f64::NAN, f64::NEG_INFINITY] {
        assert_eq!(new(&[[0.0, 0.0], [bad, 1.0]]), Err(NotFinite { index: 2 }));
        assert_eq!(new(&[[0.0, bad], [1.0, 1.0]]), Err(NotFinite { index: 1 }));
    }
    for value in [1.0, 0.5] {
        assert_eq!(
            new(&[[0.0, 0.0], [1.0, 1.0], [value, 2.0]]),
            Err(NotIncreasing {
                index: 3,
                value,
                previous: 1.0
            })
        );
    }
    assert_eq!(
        new(&[[0.0, 2.0], [1.0, 1.0]]),
        Err(Falling {
            index: 2,
            value: 1.0,
            previous: 2.0
        })
    );
    // Level pieces are fine.
    assert!(new(&[[0.0, 1.0], [1.0, 1.0]]).is_ok());
}

#[test]
fn written_and_read_back() {
    let times: Vec<f64> = (0..6).map(|i| 0.1 * f64::from(i * i) + 1.0 / 3.0).collect();
    let values = times.iter().map(|t| t.sin()).collect();
    let mut one = free("a");
    one.frame.motions = [
        Motion::Sine {
            amplitude: 0.1,
            angular_frequency: 2.0 / 3.0,
            phase: 0.3,
        },
        Motion::Triangle {
            amplitude: 0.1,
            angular_frequency: 0.7,
        },
        Motion::SweptSine {
            amplitude: 0.1,
            start: 0.1,
            end: 1e3,
            duration: 2.0,
        },
        Motion::Ramp {
            amplitude: 0.1,
            start: 0.2,
            duration: 0.3,
            profile: RampProfile::Smooth,
        },
        Motion::Table(Spline::new(times, values).unwrap()),
        Motion::Sum(vec![Motion::Constant(0.1), Motion::Constant(1e-300)]),
    ];
    let text = serde_json::to_string(&one).unwrap();
    let back: Body = serde_json::from_str(&text).unwrap();
    assert_eq!(back, one);
    for law in [TANH, BRISTLE] {
        let text = serde_json::to_string(&law).unwrap();
        assert_eq!(serde_json::from_str::<FrictionLaw>(&text).unwrap(), law);
    }
    let table = CoilLaw::Table(Characteristic::new(vec![[0.0, 0.0], [1.0, 1.0 / 3.0]]).unwrap());
    let text = serde_json::to_string(&table).unwrap();
    assert_eq!(serde_json::from_str::<CoilLaw>(&text).unwrap(), table);
    // What is read is checked as what is built.
    assert!(serde_json::from_str::<CoilLaw>(r#"{"table":[[0.0,1.0],[0.0,2.0]]}"#).is_err());
    let short = r#"{"abscissae":[0.0,1.0,2.0],"ordinates":[0.0,1.0,2.0]}"#;
    assert!(serde_json::from_str::<Spline>(short).is_err());
    let line = serde_json::to_string(&CoilLine::CenterOfGravity).unwrap();
    assert_eq!(line, r#""center_of_gravity""#);
}
