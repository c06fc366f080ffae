//! Natural frequencies and shapes against closed forms.

use std::f64::consts::PI;

use mechanics::body::Body;
use mechanics::connection::{Accumulator, ColumnFace, Law, SpringDamper, SurfaceFriction};
use mechanics::contact::FrictionDirections;
use mechanics::curve::Curve;
use mechanics::system::{Held, StaticFriction, System};

use crate::half_truck::{ALL, LBF_PER_INCH, straight, wedge};
use crate::models::{connection, model};

fn spring(stiffness: f64) -> SpringDamper {
    SpringDamper::spring(Curve::linear(stiffness))
}

/// Two masses in a chain: ω² of k/m (3 ± √5)/2.
#[test]
fn a_chain_of_two_masses() {
    let (k, m) = (300.0, 2.0);
    let free = [true, false, false, false, false, false];
    let bodies = vec![
        Body::ground(),
        Body::linearized("a", [0.0; 3], free, m, [1.0; 3]),
        Body::linearized("b", [1.0, 0.0, 0.0], free, m, [1.0; 3]),
    ];
    let law = || Law::Springs(vec![(0, spring(k))]);
    let connections = vec![
        connection(1, 0, [0.0; 3], law()),
        connection(2, 1, [0.5, 0.0, 0.0], law()),
    ];
    let mut system = System::new(model(bodies, connections)).unwrap();
    let x = system.initial_state();
    let found = system.vibrations(0.0, &x, Held::All).unwrap();
    assert_eq!(found.asymmetry, 0.0);
    for (mode, sign) in found.modes.iter().zip([-1.0, 1.0]) {
        let expected = (k / m * 0.5 * (3.0 + sign * 5f64.sqrt())).sqrt() / (2.0 * PI);
        assert!((mode.frequency - expected).abs() < 1e-12 * expected);
        // shapes: (1, golden ratio) and (golden ratio, -1)
        let ratio = mode.shape[1] / mode.shape[0];
        let golden = 0.5 * (1.0 - sign * 5f64.sqrt());
        assert!((ratio - golden).abs() < 1e-9, "{ratio} instead of {golden}");
    }
}

/// A body on four springs: heave, and roll and pitch through the levers; yaw and longitudinal through a stuck
/// surface.
#[test]
fn a_body_on_four_springs() {
    let (k, m, inertia, lever) = (1000.0, 50.0, [3.0, 5.0, 7.0], [0.6, 0.4]);
    let bodies = vec![
        Body::linearized("b", [0.0, 0.0, 0.0], ALL, m, inertia),
        Body::ground(),
    ];
    let mut connections = Vec::new();
    for x in [1.0, -1.0] {
        for y in [1.0, -1.0] {
            let at = [x * lever[0], y * lever[1], 0.0];
            connections.push(connection(0, 1, at, Law::Springs(vec![(2, spring(k))])));
        }
    }
    let (held, coupled) = (4e4, 2.0);
    let surface = SurfaceFriction {
        clamped: false,
        directions: FrictionDirections::Two,
        coordinates: [2, 0, 1],
        spring: Curve::new(vec![[-1.0, -100.0], [1.0, -100.0]]).unwrap(),
        damper: None,
        coefficient: 0.5,
        accumulator: Accumulator::Bristle {
            stiffness: held,
            damping: 10.0,
        },
    };
    for x in [coupled, -coupled] {
        connections.push(connection(0, 1, [x, 0.0, 0.0], Law::Surface(surface.clone())));
    }
    let mut system = System::new(model(bodies, connections)).unwrap();
    let x = system.initial_state();
    let found = system.vibrations(0.0, &x, Held::All).unwrap();
    let mut expected: Vec<f64> = vec![
        4.0 * k / m,
        4.0 * k * lever[1] * lever[1] / inertia[0],
        4.0 * k * lever[0] * lever[0] / inertia[1],
        2.0 * held / m,
        2.0 * held / m,
        2.0 * held * coupled * coupled / inertia[2],
    ];
    expected.sort_by(f64::total_cmp);
    for (mode, expected) in found.modes.iter().zip(expected) {
        assert!(
            (mode.eigenvalue[0] - expected).abs() < 1e-9 * expected,
            "{mode:?} {expected}"
        );
        assert!((mode.frequency - expected.sqrt() / (2.0 * PI)).abs() < 1e-9 * expected.sqrt());
    }
}

/// A stuck plain wedge is its coil and its accumulator side by side. One with a toe has a stiffness without
/// symmetry: eigenvalues and shapes then solve the general problem.
#[test]
fn a_body_on_wedges() {
    let (mass, inertia) = (2000.0, [300.0, 400.0, 500.0]);
    let build = |column: &dyn Fn(f64) -> ColumnFace| {
        let bodies = vec![
            Body::linearized("b", [0.0; 3], ALL, mass, inertia),
            Body::ground(),
        ];
        let wedges = [1.0, -1.0].map(|direction| {
            let law = Law::Wedge(wedge(false, column(direction)));
            connection(0, 1, [0.3 * direction, 0.0, 0.0], law)
        });
        System::new(model(bodies, wedges.to_vec())).unwrap()
    };
    let mut system = build(&|_| ColumnFace::Plain { toe_out: true });
    let mut x = system.initial_state();
    x[2] = -0.01;
    let found = system.vibrations(0.0, &x, Held::All).unwrap();
    let heave = 2.0 * (3000.0 + 1e6) * LBF_PER_INCH / mass;
    let close = |a: f64, b: f64| (a - b).abs() < 1e-9 * b;
    assert!(
        found.modes.iter().any(|mode| close(mode.eigenvalue[0], heave)),
        "{found:?}"
    );
    let mut system = build(&|direction| straight(5.0, direction));
    let mut x = system.initial_state();
    x[2] = -0.01;
    let at = system.deflection_of(0).unwrap();
    x[at] = 1e-4;
    x[0] = 0.002;
    let found = system.vibrations(0.0, &x, Held::All).unwrap();
    assert!(found.asymmetry > 1e-6);
    let stiffness = system.stiffness_matrix(0.0, &x, Held::All);
    let n = 6;
    let inertia: Vec<f64> = [[mass; 3], inertia].concat();
    for mode in &found.modes {
        let [value, imaginary] = mode.eigenvalue;
        assert!(imaginary.abs() < 1e-6 * value.abs().max(1.0));
        for i in 0..n {
            let left: f64 = (0..n).map(|j| stiffness[i * n + j] * mode.shape[j]).sum();
            let right = value * inertia[i] * mode.shape[i];
            let size = found.modes[n - 1].eigenvalue[0] * inertia[i].sqrt();
            assert!(
                (left - right).abs() < 1e-9 * size,
                "{mode:?} row {i}: {left} {right}"
            );
        }
    }
}

/// The stiffness is the derivative of the forces where nothing has states.
#[test]
fn stiffness_is_minus_the_derivative_of_forces() {
    let mut model = crate::half_truck::model(true, true);
    for connection in &mut model.connections {
        match &mut connection.law {
            Law::Surface(law) => law.coefficient = 0.0,
            Law::Wedge(law) => (law.column_friction, law.slope_friction) = (0.0, 0.0),
            _ => {}
        }
    }
    for connection in &mut model.connections {
        let viscous = Accumulator::Viscous { damping: 1.0 };
        match &mut connection.law {
            Law::Surface(law) => law.accumulator = viscous,
            Law::Wedge(law) => law.accumulator = viscous,
            _ => {}
        }
    }
    let bodies = model.bodies.clone();
    let mut system = System::new(model).unwrap();
    let n = system.layout().speeds;
    assert_eq!(n, 18);
    let mut random = crate::common::Random(9);
    let mut x = system.initial_state();
    for value in &mut x[..n] {
        *value = random.between(-1e-4, 1e-4);
    }
    let stiffness = system.stiffness_matrix(0.0, &x, Held::All);
    let h = 1e-7;
    for j in 0..n {
        let mut force = |d: f64| {
            let mut y = x.clone();
            y[j] += d;
            system.observe(0.0, &y).bodies[..3]
                .iter()
                .flat_map(|b| b.accelerations)
                .collect::<Vec<f64>>()
        };
        let (up, down) = (force(h), force(-h));
        for i in 0..n {
            let body = &bodies[i / 6];
            let own = if i % 6 < 3 {
                body.mass
            } else {
                body.inertia[i % 6 - 3]
            };
            let expected = -(up[i] - down[i]) / (2.0 * h) * own;
            let size = stiffness.iter().fold(0.0, |m: f64, k| m.max(k.abs()));
            assert!(
                (stiffness[i * n + j] - expected).abs() < 1e-6 * size,
                "({i}, {j})"
            );
        }
    }
}

/// The half-truck's heave while its wedges slide: bolster and side frames in phase across, two masses on
/// inputs, nests with coils, bearings. With stuck wedges their accumulators stiffen it.
#[test]
fn heave_of_the_half_truck() {
    let mut system = System::new(crate::half_truck::model(false, false)).unwrap();
    let x = system.initial_state();
    let rest = system.equilibrium(0.0, &x, StaticFriction::Without).unwrap();
    let (inputs, nests, bearings) = (3e6, 36e3, 8.0 * 15691.0 / 0.031382);
    let (m1, m2) = (319.175, 2.0 * 2.98);
    let heave = |nests: f64| {
        let (a, d) = ((inputs + nests) / m1, (nests + bearings) / m2);
        let coupling = nests * nests / (m1 * m2);
        let low = 0.5 * (a + d) - (0.25 * (a - d) * (a - d) + coupling).sqrt();
        low.sqrt() / (2.0 * PI)
    };
    for (held, expected) in [
        (Held::Nothing, heave(nests)),
        (Held::Surfaces, heave(nests)),
        (Held::All, heave(nests + 4e6)),
    ] {
        let found = system.vibrations(0.0, &rest, held).unwrap();
        let near = found.modes.iter().map(|mode| (mode.frequency - expected).abs());
        assert!(
            near.fold(f64::INFINITY, f64::min) < 1e-6 * expected,
            "{expected} Hz: {found:?}"
        );
    }
    assert!((heave(nests) - 15.52).abs() < 5e-3);
}
