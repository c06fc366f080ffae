//! The equilibrium at a time beyond a break of the motions once took the piece of the motions at time zero,
//! so that a ramp that had long ended had not begun.

use mechanics::body::Body;
use mechanics::connection::{Connection, Law, SpringDamper};
use mechanics::curve::Curve;
use mechanics::motion::{Motion, RampProfile};
use mechanics::system::{Model, StaticFriction, System};

#[test]
fn an_equilibrium_follows_a_motion_that_has_ended() {
    let mut motions: [Motion; 6] = std::array::from_fn(|_| Motion::Constant(0.0));
    motions[5] = Motion::Ramp {
        amplitude: 0.012,
        start: 0.0,
        duration: 0.1,
        profile: RampProfile::HalfCosine,
    };
    let body = Body::linearized(
        "body",
        [0.0; 3],
        [false, false, false, false, false, true],
        1.0,
        [1.0; 3],
    );
    let spring = Law::Springs(vec![(5, SpringDamper::spring(Curve::linear(1e5)))]);
    let mut system = System::new(Model {
        bodies: vec![body, Body::linearized_prescribed("input", [0.0; 3], motions)],
        connections: vec![Connection {
            account: String::new(),
            name: "yaw".to_owned(),
            a: 0,
            b: 1,
            point: [0.0; 3],
            markers: None,
            law: spring,
        }],
        ..Model::default()
    })
    .unwrap();
    let x = system.initial_state();
    let rest = system.equilibrium(10.0, &x, StaticFriction::Without).unwrap();
    assert!((rest[0] - 0.012).abs() < 1e-9, "{}", rest[0]);
    let start = system.equilibrium(0.0, &x, StaticFriction::Without).unwrap();
    assert!(start[0].abs() < 1e-12, "{}", start[0]);
}
