//! Carriers: what goes with a body but does not turn with its last angle, as bearings do with an axle that
//! spins.

use integrate::{Integrator, Method, Options, Problem};
use mechanics::body::Body;
use mechanics::contact::{ContactFace, ContactPoint, Interface};
use mechanics::elements::ShearSpring;
use mechanics::energy_balance::EnergyBalance;
use mechanics::frame::Frame;
use mechanics::friction::FrictionLaw;
use mechanics::link::Marker;
use mechanics::surface::Plane;
use mechanics::system::{Model, ModelError, System};
use mechanics::vector::Vector;

/// Returns a rotor (body 0) that spins about its x axis on springs to the ground (1); on its carrier (3)
/// rests a frame (2) by two points with friction and a spring; the rotor's own springs to the ground stand on
/// the carrier, too.
fn model(spin: f64) -> Model {
    let mut rotor = Body::free("rotor", 100.0, [8.0, 5.0, 5.0], [0.1, -0.2, 0.05, 0.3, 0.4, 0.06]);
    rotor.frame = Frame::fixed([0.5, 0.0, 0.2], [0.2, -0.4, 0.3]);
    rotor.initial[3] = spin;
    let frame = Body::free(
        "frame",
        40.0,
        [2.0, 3.0, 4.0],
        [0.6, -0.25, 0.62, 0.01, -0.02, 0.03],
    );
    let ground = Body::prescribed("ground", Frame::fixed([0.0; 3], [0.0; 3]));
    let mut model = Model::new(vec![rotor, ground, frame], [0.0, 0.0, -9.81]);
    let carrier = model.add_carrier("bearings", 0);
    assert_eq!(carrier, 3);
    let spring = |name: &str| ShearSpring {
        name: name.to_owned(),
        preload: 500.0,
        stiffness: 3e4,
        shear_stiffness: 2e4,
        damping: 40.0,
        solid: None,
    };
    for (i, x) in [0.4, -0.4].into_iter().enumerate() {
        let (own, ground) = (
            Marker::new([x, 0.1, -0.2], [0.0; 3]),
            Marker::new([x, 0.0, 0.0], [0.0; 3]),
        );
        model.add(spring(&format!("spring_{i}")), (carrier, own), (1, ground));
    }
    let upper = (2, Marker::new([0.0, 0.0, -0.2], [0.0; 3]));
    model.add(
        spring("upper"),
        upper,
        (carrier, Marker::new([0.0, 0.0, 0.2], [0.1, 0.2, 0.0])),
    );
    let point = |x: f64| ContactPoint {
        position: Vector([x, 0.0, -0.3]),
        stiffness: 1e5,
        damping: 50.0,
        share: 0.5,
    };
    let face = ContactFace {
        name: "face".to_owned(),
        points: vec![point(0.2), point(-0.2)],
        surface: Plane,
        coefficient: 0.3,
        law: FrictionLaw::Bristle {
            stiffness: 1e5,
            damping: 100.0,
        },
    };
    let up = Marker::new([0.0, 0.0, 0.3], [0.0, -std::f64::consts::FRAC_PI_2, 0.0]);
    model.faces.push((2, carrier, up, face));
    let own = Interface {
        first_arm: 0.3,
        ..Interface::default()
    };
    model.interfaces.push((0, own));
    model
}

/// Returns a state in motion, with the last angle (rad) of the rotor and its rate (rad/s).
fn state(system: &System, spin: f64, rate: f64) -> Vec<f64> {
    let mut x = system.initial_state();
    let layout = system.layout();
    for (k, value) in x[layout.speeds..layout.speeds + 12].iter_mut().enumerate() {
        *value = [0.2, -0.1, 0.3, 0.4, -0.5, 0.25, 0.1, 0.3, -0.2, 0.5, -0.4, 0.3][k];
    }
    for (k, value) in x[2 * layout.speeds..2 * layout.speeds + 4].iter_mut().enumerate() {
        *value = [1e-3, -5e-4, 2e-4, 7e-4][k];
    }
    let place = system.position_of(0, 3).unwrap();
    x[place] = spin;
    x[layout.speeds + place] = rate;
    x
}

/// Column by column, by central differences.
#[test]
fn convergence_the_jacobian_matrix_of_elements_on_a_carrier() {
    let mut system = System::new(model(0.3)).unwrap();
    let n = system.layout().len();
    let x = state(&system, 1.3, 7.0);
    let (mut rates, mut unused) = (vec![0.0; n], vec![0.0; n]);
    system.derivative(0.0, &x, &mut rates);
    system.linearize(0.0, &x, &rates, &mut unused);
    // (shift - J)⁻¹ times (shift - J) by differences is the unit matrix.
    let shift = 50.0;
    system.factor(shift).unwrap();
    for j in 0..n - system.layout().quadratures {
        let step = 1e-6;
        let [mut up, mut down] = [x.clone(), x.clone()];
        (up[j], down[j]) = (x[j] + step, x[j] - step);
        let (mut high, mut low) = (vec![0.0; n], vec![0.0; n]);
        system.derivative(0.0, &up, &mut high);
        system.derivative(0.0, &down, &mut low);
        let mut column: Vec<f64> = (0..n).map(|i| -(high[i] - low[i]) / (2.0 * step)).collect();
        column[j] += shift;
        let size = column.iter().fold(1.0, |most: f64, value| most.max(value.abs()));
        system.solve(&mut column);
        for (i, value) in column.iter().enumerate() {
            let exact = if i == j { 1.0 } else { 0.0 };
            assert!(
                (value - exact).abs() < 3e-9 * size,
                "({i}, {j}): {value}, column of size {size}"
            );
        }
    }
}

/// The last angle stands in no force, and nothing acts on it: its rate changes by the gyroscopic terms of
/// the other angles alone, which vanish where they rest.
#[test]
fn analytic_nothing_acts_on_the_spin() {
    let mut system = System::new(model(0.3)).unwrap();
    let n = system.layout().len();
    let place = system.position_of(0, 3).unwrap();
    let speeds = system.layout().speeds;
    let (mut at_zero, mut later) = (vec![0.0; n], vec![0.0; n]);
    let (a, b) = (state(&system, 0.0, 7.0), state(&system, 2.1, 7.0));
    system.derivative(0.0, &a, &mut at_zero);
    system.derivative(0.0, &b, &mut later);
    let largest = at_zero.iter().fold(0.0, |most: f64, rate| most.max(rate.abs()));
    for (i, (zero, later)) in at_zero.iter().zip(&later).enumerate() {
        assert!(
            (zero - later).abs() < 1e-12 * largest,
            "rate {i}: {zero} and {later}"
        );
    }
    // Symmetric about its axis: the angular velocity about it is constant.
    let mut resting = a.clone();
    for k in [4, 5] {
        resting[speeds + system.position_of(0, k).unwrap()] = 0.0;
    }
    system.derivative(0.0, &resting, &mut at_zero);
    let yaw = resting[system.position_of(0, 5).unwrap()];
    let heading = at_zero[speeds + system.position_of(0, 4).unwrap()];
    let spin = at_zero[speeds + place];
    assert!(
        (spin + yaw.sin() * heading).abs() < 1e-10 * largest,
        "{spin} {heading}"
    );
}

#[test]
fn energy_closes_with_elements_on_a_carrier() {
    let mut system = System::new(model(0.0)).unwrap();
    let x = state(&system, 0.0, 20.0);
    let start = system.observe(0.0, &x).energies.total();
    let options = Options {
        relative_tolerance: 1e-10,
        ..Options::of(Method::Rodas5P)
    };
    let mut integrator = Integrator::new(system.clone(), options, 0.0, &x).unwrap();
    let mut balance = EnergyBalance::new(start);
    while integrator.time() < 0.5 {
        integrator.step_to(0.5).unwrap();
        let seen = system.observe(integrator.time(), integrator.x());
        balance.note(integrator.time(), &system.ledger_entries(&seen, start));
    }
    let residual = balance.relative_residual();
    assert!(residual < 1e-7, "{residual}");
}

#[test]
fn input_a_carrier_of_a_carrier_is_refused() {
    let mut model = model(0.0);
    model.add_carrier("second", 3);
    assert!(matches!(
        System::new(model),
        Err(ModelError::Carrier { body: 3, .. })
    ));
}
