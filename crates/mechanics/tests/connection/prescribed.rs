//! Prescribed bodies with linearized kinematics whose motions a caller replaces step by step.

use integrate::{Integrator, Method, Options};
use mechanics::body::Body;
use mechanics::connection::{Law, SpringDamper};
use mechanics::curve::Curve;
use mechanics::motion::Motion;
use mechanics::system::{InputError, Model, System};

use crate::half_truck::{ALL, vertical};
use crate::models::{connection, model, observation, run};

const AMPLITUDE: f64 = 0.02;
const FREQUENCY: f64 = 7.0;
const END: f64 = 1.0;

fn sine() -> Motion {
    Motion::Sine {
        amplitude: AMPLITUDE,
        angular_frequency: FREQUENCY,
        phase: 0.3,
    }
}

/// Returns a body on a spring with a damper, on a body that moves up and down.
fn on_a_mover(motion: Motion) -> Model {
    let bodies = vec![
        Body::linearized("body", [0.0; 3], ALL, 100.0, [10.0; 3]),
        Body::linearized_prescribed("mover", [0.0; 3], vertical(motion)),
        Body::ground(),
    ];
    let mut spring = SpringDamper::spring(Curve::linear(5e4));
    spring.damper = Some(Curve::linear(300.0));
    let law = Law::Springs(vec![(2, spring)]);
    model(bodies, vec![connection(0, 1, [0.0; 3], law)])
}

fn value_and_rate(time: f64) -> [f64; 2] {
    let [value, rate, _] = sine().evaluate(time, time);
    [value, rate]
}

#[test]
fn driven_by_cubics_a_body_moves_as_by_the_motion_itself() {
    let whole = System::new(on_a_mover(sine())).unwrap();
    let done = run(&whole, Method::default(), 1e-9, &whole.initial_state(), END);
    let expected = observation(&done);

    let mut system = System::new(on_a_mover(Motion::line(0.0, value_and_rate(0.0)))).unwrap();
    let x = system.initial_state();
    let start = system.observe(0.0, &x).energies.total();
    let options = Options {
        relative_tolerance: 1e-9,
        ..Options::default()
    };
    let mut integrator = Integrator::new(system, options, 0.0, &x).unwrap();
    let steps = 500;
    for step in 1..=steps {
        let (from, to) = (integrator.time(), END * f64::from(step) / f64::from(steps));
        let cubic = Motion::between(from, to - from, value_and_rate(from), value_and_rate(to));
        integrator.problem_mut().set_motions(1, vertical(cubic)).unwrap();
        integrator.reevaluate();
        while integrator.time() < to {
            integrator.step_to(to).unwrap();
        }
    }
    let observation = observation(&integrator);
    let (position, work) = (observation.bodies[0].coordinates[2], observation.work);
    assert!(
        (position - expected.bodies[0].coordinates[2]).abs() < 1e-6 * AMPLITUDE,
        "{position}"
    );
    // The work of the motions is in the ledger, and it closes.
    assert!(work > 1.0 && (work / expected.work - 1.0).abs() < 1e-6, "{work}");
    assert!(observation.residual(start).abs() < 1e-6 * work);
    assert_eq!(observation.bodies[1].coordinates[2], value_and_rate(END)[0]);
}

#[test]
fn only_prescribed_bodies_that_can_move_are_driven() {
    let mut system = System::new(on_a_mover(sine())).unwrap();
    let motions = || vertical(Motion::line(0.0, [0.0, 1.0]));
    for body in [0, 2] {
        let refused = system.set_motions(body, motions());
        assert!(
            matches!(refused, Err(InputError::NotPrescribed { .. })),
            "{body}: {refused:?}"
        );
    }
    assert!(matches!(
        system.set_motions(3, motions()),
        Err(InputError::NoSuch { count: 3, .. })
    ));
    assert_eq!(system.set_motions(1, motions()), Ok(()));
}
