//! Static equilibrium, and limits that have closed forms.

use mechanics::body::Body;
use mechanics::connection::{ColumnFace, Law, SpringDamper};
use mechanics::curve::Curve;
use mechanics::motion::Motion;
use mechanics::system::{StaticFriction, System};

use crate::half_truck::{self, ALL, BOLSTER, INCH, LBF, LBF_PER_INCH, straight, vertical, wedge};
use crate::models::{connection, model, rates};

/// A body on four frictionless wedges whose coils stand on the ground sinks until the coils carry its weight.
#[test]
fn four_wedges_carry_a_body() {
    let weight = 4000.0 * LBF;
    let bodies = vec![
        Body::linearized("body", [0.0, 0.0, 0.5], ALL, weight / 9.80665, [20.0, 30.0, 40.0]),
        Body::ground(),
    ];
    let mut connections = Vec::new();
    for x in [1.0, -1.0] {
        for y in [0.8, -0.8] {
            let law = wedge(false, ColumnFace::Plain { toe_out: true });
            connections.push(connection(0, 1, [x, y, 0.0], Law::Wedge(law)));
        }
    }
    let soft = SpringDamper::spring(Curve::linear(1e4));
    let hold = [0, 1, 5].map(|k| (k, soft.clone())).to_vec();
    connections.push(connection(0, 1, [0.0, 0.0, 0.5], Law::Springs(hold)));
    let mut model = model(bodies, connections);
    model.gravity[2] = -9.80665;
    let mut system = System::new(model).unwrap();
    let x = system.initial_state();
    let rest = system.equilibrium(0.0, &x, StaticFriction::Without).unwrap();
    let expected = -weight / (4.0 * 3000.0 * LBF_PER_INCH);
    assert!(
        (rest[2] - expected).abs() < 1e-9,
        "{} instead of {expected}",
        rest[2]
    );
    let observation = system.observe(0.0, &rest);
    for state in &observation.connections[..4] {
        let coil = state.wedge.unwrap();
        assert!((coil.coil_force - 0.25 * weight).abs() < 1e-3);
        assert_eq!(coil.column_friction, 0.0);
        // N = F_s cot θ without friction and toe
        let normal = coil.coil_force / f64::to_radians(32.0).tan();
        assert!((coil.column_normal - normal).abs() < 1e-6 * normal);
    }
    // with friction that follows, coil and accumulator carry together while they stick
    let rest = system.equilibrium(0.0, &x, StaticFriction::Following).unwrap();
    let observation = system.observe(0.0, &rest);
    let wedge = observation.connections[0].wedge.unwrap();
    assert!((wedge.coil_force + wedge.column_friction - 0.25 * weight).abs() < 1e-3);
    assert!(rest[2] > expected && rest[2] < 0.0);
    assert!(wedge.column_friction > 0.1 * wedge.coil_force);
    // friction cannot exceed what the branch allows: N/F_s = (cos θ - μ sin θ)/(1.16 sin θ)
    let (s, c) = f64::to_radians(32.0).sin_cos();
    let most = 0.4 * (c - 0.4 * s) / (1.16 * s);
    assert!(wedge.column_friction <= most * wedge.coil_force * (1.0 + 1e-9));
}

/// Equal and opposite longitudinal forces of leading and trailing wedges: the weight is carried by coils on
/// inclined columns. With the coil in the bolster nothing but the column's inclination lifts it.
#[test]
fn a_toe_lifts_or_drags_the_bolster() {
    for toe in [0.2, -0.2] {
        let bodies = vec![
            Body::linearized("body", [0.0; 3], ALL, 1.0, [1.0; 3]),
            Body::ground(),
        ];
        let connections = [1.0, -1.0].map(|direction| {
            connection(
                0,
                1,
                [0.2 * direction, 0.0, 0.0],
                Law::Wedge(wedge(true, straight(toe, direction))),
            )
        });
        let mut system = System::new(model(bodies, connections.to_vec())).unwrap();
        let x = system.initial_state();
        let observation = system.observe(0.0, &x);
        let w = observation.connections[0].wedge.unwrap();
        let (t, p) = (f64::to_radians(37.5), f64::to_radians(toe));
        let normal = 3702.2 * LBF * t.cos() / (t + p).sin();
        assert!((w.column_normal - normal).abs() < 1e-9 * normal);
        // toe out: the columns' normal forces point down on the wedges
        let lift = observation.bodies[0].accelerations;
        assert!(
            (lift[2] + 2.0 * normal * p.sin()).abs() < 1e-9 * normal,
            "{lift:?}"
        );
        assert!(lift[0].abs() < 1e-9 * normal);
    }
}

/// The half-truck with variable damping hangs on its input springs: 3 springs of 1e6 lbf/in against 36 000
/// lbf/in of nests and coils, and bearings that the side frames nearly leave.
#[test]
fn the_half_truck_settles() {
    let mut system = System::new(half_truck::model(false, false)).unwrap();
    let x = system.initial_state();
    let rest = system.equilibrium(0.0, &x, StaticFriction::Without).unwrap();
    let z = |body: usize| rest[system.position_of(body, 2).unwrap()];
    let (body, frame) = (z(BOLSTER), z(1));
    // balance of forces, by hand: bearings are linear until 0.031382 in
    let (inputs, nests, bearing) = (3e6, 18e3, 4.0 * 15691.0 / 0.031382);
    let (weight, frame_weight) = (319.175 * 9.80665 / INCH, 2.98 * 9.80665 / INCH);
    // inputs·z + 2 nests (z - f) = -W; nests (z - f) = bearing f - 4·15691 + w
    let preload = 4.0 * 15691.0 - frame_weight;
    let stiffness = inputs + 2.0 * nests * (1.0 - nests / (nests + bearing));
    let expected = (-weight + 2.0 * nests * preload / (nests + bearing)) / stiffness;
    let frame_expected = (nests * expected + preload) / (nests + bearing);
    assert!(
        (body / INCH - expected).abs() < 1e-6,
        "{} instead of {expected}",
        body / INCH
    );
    assert!(
        (frame / INCH - frame_expected).abs() < 1e-6,
        "{} instead of {frame_expected}",
        frame / INCH
    );
    assert!((expected + 0.0402).abs() < 2e-4 && (frame_expected - 0.0302).abs() < 2e-4);
    // with accumulators that follow it sinks a little less, and every element is inside its limit
    let held = system.equilibrium(0.0, &x, StaticFriction::Following).unwrap();
    let z = held[system.position_of(BOLSTER, 2).unwrap()];
    assert!(z < 0.0 && z > rest[system.position_of(BOLSTER, 2).unwrap()]);
    let dx = rates(&mut system, 0.0, &held);
    let n = system.layout().speeds;
    // at rest but for the dampers of inputs that move; these inputs have none
    assert!(dx[n..2 * n].iter().all(|a| a.abs() < 1e-6));
    // the inputs were held where they are, not stopped for good
    let mut dx = vec![0.0; x.len()];
    integrate::Problem::derivative(&mut system, 0.0, &x, &mut dx);
    let observation = system.observe(0.0, &x);
    assert!((observation.bodies[4].speeds[2] - 2.0 * INCH).abs() < 1e-12);
}

/// With constant damping the preloads balance the drawn layout, but for the columns' normal forces where a
/// toe inclines them: 4 · 3702.2 lbf · cos θ sin φ / sin(θ+φ) = 67 lbf down.
#[test]
fn the_half_truck_with_constant_damping_is_balanced_as_drawn() {
    for (spatial, expected) in [(false, 0.0), (true, -67.07)] {
        let mut system = System::new(half_truck::model(true, spatial)).unwrap();
        let x = system.initial_state();
        let observation = system.observe(0.0, &x);
        let force = observation.bodies[BOLSTER].accelerations[2] * 319.175 / INCH;
        assert!((force - expected).abs() < 0.3, "{force} lbf");
    }
}

/// A slope that is too small for a body to lose a ten thousandth of its weight is nearly level: the start has
/// a warning with what is left. A steeper one has no equilibrium.
#[test]
fn issue_048_a_body_that_is_nearly_at_rest_is_a_start_with_a_warning() {
    for (slope, nearly) in [(5e-4, true), (5e-3, false)] {
        let free = Body::linearized("stone", [0.0; 3], ALL, 1.0, [1.0; 3]);
        let mover = Body::linearized_prescribed("mover", [0.0; 3], vertical(Motion::Constant(0.0)));
        let spring = |k| (k, SpringDamper::spring(Curve::linear(1e4)));
        let held = Law::Springs(vec![spring(1), spring(2), spring(3), spring(4), spring(5)]);
        let mut model = model(vec![free, mover], vec![connection(0, 1, [0.0; 3], held)]);
        model.gravity = [slope, 0.0, -9.8];
        let mut system = System::new(model).unwrap();
        let x = system.initial_state();
        let error = system.equilibrium(0.0, &x, StaticFriction::Without).unwrap_err();
        assert!((error.residual - slope).abs() < 1e-9, "{error:?}");
        assert_eq!(error.nearly_at_rest(9.8).is_some(), nearly);
        match system.start_at_rest(0.0, &x, StaticFriction::Without) {
            Ok(start) => {
                let warning = start.warning.unwrap();
                assert!(
                    nearly && warning.contains("stone still accelerates by 5.0e-4"),
                    "{warning}"
                );
                assert!(warning.contains("nearly at rest"), "{warning}");
                let z = start.state[system.position_of(0, 2).unwrap()];
                assert!((z + 9.8 / 1e4).abs() < 1e-6, "{z}");
            }
            Err(_) => assert!(!nearly),
        }
    }
}

/// No equilibrium: a body that nothing holds.
#[test]
fn a_falling_body_has_no_equilibrium() {
    let free = Body::linearized("stone", [0.0; 3], ALL, 1.0, [1.0; 3]);
    let mover = Body::linearized_prescribed("mover", [0.0; 3], vertical(Motion::Constant(0.0)));
    let side = Law::Springs(vec![(0, SpringDamper::spring(Curve::linear(1.0)))]);
    let mut model = model(vec![free, mover], vec![connection(0, 1, [0.0; 3], side)]);
    model.gravity[2] = -9.8;
    let mut system = System::new(model).unwrap();
    let x = system.initial_state();
    let error = system.equilibrium(0.0, &x, StaticFriction::Without).unwrap_err();
    assert!(error.to_string().contains("stone"), "{error}");
}
