//! Elements, connections and applied loads on bodies with finite and with linearized kinematics in one
//! system: derivatives, the energy ledger, closed forms.

use crate::common::{Random, integrate};
use integrate::{Options, Problem};
use mechanics::body::Body;
use mechanics::connection::{Connection, Law, SpringDamper};
use mechanics::contact::{ContactFace, ContactPoint};
use mechanics::curve::Curve;
use mechanics::elements::{ShearSpring, Solid};
use mechanics::frame::Frame;
use mechanics::friction::FrictionLaw;
use mechanics::link::Marker;
use mechanics::motion::Motion;
use mechanics::surface::Plane;
use mechanics::system::{AppliedLoad, Model, ModelError, System};

fn sine(amplitude: f64, angular_frequency: f64, phase: f64) -> Motion {
    Motion::Sine {
        amplitude,
        angular_frequency,
        phase,
    }
}

fn motions(random: &mut Random, size: f64) -> [Motion; 6] {
    std::array::from_fn(|_| {
        sine(
            size * random.between(0.3, 1.0),
            random.between(1.0, 4.0),
            random.between(0.0, 3.0),
        )
    })
}

fn spring() -> ShearSpring {
    ShearSpring {
        name: "spring".to_owned(),
        preload: 120.0,
        stiffness: 3e3,
        shear_stiffness: 2e3,
        damping: 15.0,
        solid: Some(Solid {
            at: -0.02,
            stiffness: 3e4,
        }),
    }
}

fn link(a: usize, b: usize, point: [f64; 3]) -> Connection {
    let law = SpringDamper {
        damper: Some(Curve::linear(20.0)),
        ..SpringDamper::spring(Curve::linear(4e3))
    };
    Connection {
        account: String::new(),
        name: "link".to_owned(),
        a,
        b,
        point,
        markers: None,
        law: Law::Springs((0..3).map(|k| (k, law.clone())).collect()),
    }
}

/// Bodies: two prescribed ones and two free ones, of either kinematics; springs, connections and a face with
/// bristles between them, loads on both free bodies.
fn mixed(random: &mut Random) -> System {
    let mut frame = Frame::fixed([0.0, 0.1, -0.3], [0.0; 3]);
    frame.motions = motions(random, 0.02);
    let mut finite = Body::free("finite", 4.0, [0.06, 0.05, 0.08], [0.0; 6]);
    finite.frame = Frame::fixed([0.1, 0.0, 0.1], [0.0; 3]);
    let bodies = vec![
        Body::prescribed("driver", frame),
        Body::linearized_prescribed("slow_driver", [0.2, 0.0, -0.2], motions(random, 0.02)),
        finite,
        Body::linearized("linearized", [0.0, 0.2, 0.3], [true; 6], 5.0, [0.1, 0.12, 0.09]),
    ];
    let mut model = Model::new(bodies, [0.0, 0.0, -9.8]);
    let mut marker = |turn: f64| Marker::new(random.vector(0.2), random.vector(turn));
    for (a, b) in [(2, 0), (2, 1), (3, 0), (3, 1), (3, 2), (2, 3)] {
        model.add(spring(), (a, marker(0.0)), (b, marker(0.2)));
    }
    let corner = |y: f64, z: f64| ContactPoint {
        position: mechanics::vector::Vector([-0.01, y, z]),
        stiffness: 2e4,
        damping: 30.0,
        share: 0.5,
    };
    let face = ContactFace {
        name: "face".to_owned(),
        points: vec![corner(0.1, 0.05), corner(-0.1, 0.05)],
        surface: Plane,
        coefficient: 0.3,
        law: FrictionLaw::Bristle {
            stiffness: 1e4,
            damping: 20.0,
        },
    };
    model.faces = vec![(3, 2, Marker::new([-0.1, 0.2, 0.2], [0.0, 0.1, 0.05]), face)];
    model.connections = vec![
        link(2, 3, [0.1, 0.1, 0.2]),
        link(2, 0, [-0.1, 0.1, 0.0]),
        link(3, 1, [0.1, 0.0, 0.1]),
        link(1, 2, [0.0, -0.1, 0.1]),
    ];
    for (body, coordinate, size) in [(2, 0, 20.0), (2, 4, 3.0), (3, 2, 30.0), (3, 5, 2.0)] {
        model.loads.push(AppliedLoad {
            body,
            coordinate,
            course: sine(size, 3.0, 0.4),
        });
    }
    System::new(model).unwrap()
}

/// `(σ - J) y = σ y - J y` for any y, with J y and ∂f/∂t by differences.
#[test]
fn analytic_derivatives_of_mixed_kinematics_against_differences() {
    for seed in 0..6 {
        let mut random = Random(seed);
        let mut system = mixed(&mut random);
        let (time, shift, h) = (0.3, 50.0, 1e-6);
        system.next_time_discontinuity(0.0);
        let mut x = system.initial_state();
        let n = system.layout().speeds;
        for value in &mut x[..n] {
            *value += random.between(-0.03, 0.03);
        }
        for value in &mut x[n..2 * n] {
            *value = random.between(-1.0, 1.0);
        }
        for value in &mut x[2 * n..2 * n + system.layout().internals] {
            *value = random.between(-1e-4, 1e-4);
        }
        let dimension = x.len();
        let direction: Vec<f64> = (0..dimension).map(|_| random.between(-1.0, 1.0)).collect();
        let mut value = |time: f64, x: &[f64]| {
            let mut dx = vec![0.0; dimension];
            system.derivative(time, x, &mut dx);
            dx
        };
        let moved =
            |sign: f64| -> Vec<f64> { x.iter().zip(&direction).map(|(x, y)| x + sign * h * y).collect() };
        let slope = |up: Vec<f64>, down: Vec<f64>| -> Vec<f64> {
            up.iter()
                .zip(down)
                .map(|(up, down)| (up - down) / (2.0 * h))
                .collect()
        };
        let dx = value(time, &x);
        let by_time = slope(value(time + h, &x), value(time - h, &x));
        let by_state = slope(value(time, &moved(1.0)), value(time, &moved(-1.0)));
        let mut df_dt = vec![0.0; dimension];
        system.linearize(time, &x, &dx, &mut df_dt);
        let size = by_time.iter().fold(1.0, |m: f64, v| m.max(v.abs()));
        for (number, (found, expected)) in df_dt.iter().zip(&by_time).enumerate() {
            assert!(
                (found - expected).abs() < 1e-6 * size,
                "{number}: {found} {expected}, seed {seed}"
            );
        }
        system.factor(shift).unwrap();
        let right = direction.iter().zip(&by_state).map(|(y, jy)| shift * y - jy);
        let mut right: Vec<f64> = right.collect();
        system.solve(&mut right);
        for (number, (found, expected)) in right.iter().zip(&direction).enumerate() {
            assert!(
                (found - expected).abs() < 1e-5,
                "{number}: {found} {expected}, seed {seed}"
            );
        }
    }
}

/// Stored and lost energy account for the work of motions and loads.
#[test]
fn energy_the_ledger_closes_over_mixed_kinematics() {
    for seed in 0..3 {
        let mut system = mixed(&mut Random(seed));
        let start = system.initial_state();
        let stored = system.observe(0.0, &start).energies.total();
        let options = Options {
            relative_tolerance: 1e-8,
            ..Options::default()
        };
        let integrator = integrate(system.clone(), options, &start, 1.0, |_| {});
        let end = system.observe(1.0, integrator.x());
        assert!(
            end.work.abs() > 0.1 && end.losses > 1.0,
            "{} {}",
            end.work,
            end.losses
        );
        assert!(
            end.residual(stored).abs() < 1e-6 * end.losses,
            "{:e} of {}",
            end.residual(stored),
            end.losses
        );
    }
}

/// A mass on a spring from rest under the load F sin Ωt: `x = F (sin Ωt - Ω/ω sin ωt) / (k - m Ω²)`, with
/// either kinematics, on a spring as a connection or as an element; the work is what mass and spring hold.
#[test]
fn analytic_a_mass_on_a_spring_under_a_load() {
    let (mass, stiffness, load, frequency, end): (f64, f64, f64, f64, f64) = (4.0, 4e3, 50.0, 20.0, 0.7);
    let own = f64::sqrt(stiffness / mass);
    let expected = load * ((frequency * end).sin() - frequency / own * (own * end).sin())
        / (stiffness - mass * frequency * frequency);
    let bodies = [
        Body::free("mass", mass, [1.0; 3], [0.0; 6]),
        Body::linearized("mass", [0.0; 3], [true; 6], mass, [1.0; 3]),
    ];
    for (kind, body) in bodies.into_iter().enumerate() {
        for element in [false, true] {
            let mut model = Model::new(vec![Body::ground(), body.clone()], [0.0; 3]);
            if element {
                let spring = ShearSpring {
                    preload: 1e4,
                    shear_stiffness: stiffness,
                    damping: 0.0,
                    solid: None,
                    ..spring()
                };
                let at = Marker::new([0.0; 3], [0.0; 3]);
                model.add(spring, (1, at), (0, at));
                model.gravity = [0.0, 0.0, -1e4 / mass];
            } else {
                let law = SpringDamper::spring(Curve::linear(stiffness));
                model.connections.push(Connection {
                    law: Law::Springs(vec![(0, law)]),
                    ..link(1, 0, [0.0; 3])
                });
            }
            model.loads.push(AppliedLoad {
                body: 1,
                coordinate: 0,
                course: sine(load, frequency, 0.0),
            });
            let mut system = System::new(model).unwrap();
            let start = system.initial_state();
            let options = Options {
                relative_tolerance: 1e-9,
                ..Options::default()
            };
            let integrator = integrate(system.clone(), options, &start, end, |_| {});
            let (x, speed) = (integrator.x()[0], integrator.x()[6]);
            assert!(
                (x - expected).abs() < 1e-6 * expected.abs(),
                "{x} {expected}, {kind} {element}"
            );
            let observation = system.observe(end, integrator.x());
            let held = 0.5 * (mass * speed * speed + stiffness * x * x);
            assert!(
                (observation.work - held).abs() < 1e-6 * held,
                "{} {held}",
                observation.work
            );
        }
    }
}

/// A load needs a coordinate that is free.
#[test]
fn input_loads_on_what_cannot_move_are_refused() {
    let mut body = Body::free("mass", 1.0, [1.0; 3], [0.0; 6]);
    body.free[4] = false;
    for (number, coordinate, message) in [
        (0, 4, "a load is applied to pitch of mass, which is not free"),
        (1, 0, "a load is applied to x of ground, which is not free"),
        (7, 0, "there are only 2"),
    ] {
        let mut model = Model::new(vec![body.clone(), Body::ground()], [0.0; 3]);
        model.loads.push(AppliedLoad {
            body: number,
            coordinate,
            course: Motion::Constant(1.0),
        });
        let error: ModelError = System::new(model).unwrap_err();
        assert!(error.to_string().contains(message), "{error}");
    }
}
