//! analytic, energy: eigenvalues of damped and driven motions; elements that do work; angles without error
//! control.

use crate::common::integrate;
use integrate::{Options, Problem};
use mechanics::body::Body;
use mechanics::element::{Element, Wrench};
use mechanics::frame::Frame;
use mechanics::link::{Marker, RelativeMotion};
use mechanics::system::{Model, System};
use mechanics::vector::Vector;
use numerics::scalar::Real;

/// A spring, a damper, and a force square to the displacement that turns with it: it does work on circles.
#[derive(Clone, Debug)]
struct Driven {
    stiffness: f64,
    damping: f64,
    circulatory: f64,
}

impl Element for Driven {
    fn name(&self) -> &str {
        "driven"
    }
    fn does_work(&self) -> bool {
        true
    }
    fn evaluate<S: Real>(&self, motion: &RelativeMotion<S>) -> Wrench<S> {
        let (d, v) = (motion.position, motion.velocity);
        let [x, y, _] = d.0;
        let circulatory = Vector([-(y * self.circulatory), x * self.circulatory, S::zero()]);
        Wrench {
            force: d.scale::<f64, S>(-self.stiffness) - v.scale::<f64, S>(self.damping) + circulatory,
            moment: Vector::zero(),
            powers: [v.dot::<S, S>(v) * self.damping, circulatory.dot::<S, S>(v)],
        }
    }
    fn energy(&self, motion: &RelativeMotion<f64>) -> f64 {
        0.5 * self.stiffness * motion.position.dot::<f64, f64>(motion.position)
    }
}

const MASS: f64 = 2.0;
const LAW: Driven = Driven {
    stiffness: 800.0,
    damping: 3.0,
    circulatory: 100.0,
};

fn system() -> System {
    let mut body = Body::free("mass", MASS, [1.0; 3], [0.1, 0.0, 0.0, 0.0, 0.0, 0.0]);
    body.free = [true, true, false, false, false, true];
    let wall = Body::prescribed("wall", Frame::fixed([0.0; 3], [0.0; 3]));
    let mut model = Model::new(vec![wall, body], [0.0; 3]);
    let at = Marker::new([0.0; 3], [0.0; 3]);
    model.add(LAW, (1, at), (0, at));
    System::new(model).unwrap()
}

/// In z = x + iy the motion is `m z'' + c z' + (k - i p) z = 0`; the yaw only drifts.
#[test]
fn analytic_eigenvalues_of_a_driven_mass() {
    let mut system = system();
    let start = system.initial_state();
    let found = system.eigenvalues(0.0, &start, 10.0).unwrap();
    assert_eq!(found.len(), 6);
    for [real, imaginary] in &found {
        // λ² m + λ c + k ∓ i p, and λ² = 0 of the yaw.
        let square = [real * real - imaginary * imaginary, 2.0 * real * imaginary];
        let value = |sign: f64| {
            [
                MASS * square[0] + LAW.damping * real + LAW.stiffness,
                MASS * square[1] + LAW.damping * imaginary - sign * LAW.circulatory,
            ]
        };
        let zero = |[a, b]: [f64; 2]| a.abs().max(b.abs()) < 1e-8 * LAW.stiffness;
        let is_drift = real.abs().max(imaginary.abs()) < 1e-6;
        assert!(
            is_drift || zero(value(1.0)) || zero(value(-1.0)),
            "{real} {imaginary}"
        );
    }
    assert!(found[0][0] > 0.4 && found[0][1] > 10.0, "{found:?}");
    assert!(found.windows(2).all(|pair| pair[0][0] >= pair[1][0]));
    // A shift that is an eigenvalue is refused, not guessed.
    assert!(system.eigenvalues(0.0, &start, f64::NAN).is_err());
}

/// The work is an entry of its own, and the ledger closes.
#[test]
fn energy_ledger_holds_the_work_of_elements() {
    let mut system = system();
    let start = system.initial_state();
    let stored = system.observe(0.0, &start).energies.total();
    let options = Options {
        relative_tolerance: 1e-8,
        ..Options::default()
    };
    let integrator = integrate(system.clone(), options, &start, 1.0, |_| {});
    let seen = system.observe(1.0, integrator.x());
    assert!(
        seen.work > 0.5 * stored && seen.losses > 0.5 * stored,
        "{} {}",
        seen.work,
        seen.losses
    );
    assert!(
        seen.residual(stored).abs() < 1e-7 * stored,
        "{}",
        seen.residual(stored)
    );
    let names: Vec<&str> = system
        .energy_terms()
        .iter()
        .map(|term| term.kind.name())
        .collect();
    assert_eq!(names, ["input_work", "element_loss", "element_work"]);
    let entries = system.ledger_entries(&seen, stored);
    assert_eq!(entries.work, seen.work);
}

/// An angle that only turns is left out of the error control; what is not free cannot be.
#[test]
fn input_a_coordinate_is_left_out_of_the_error_control() {
    let mut system = system();
    assert!(system.leave_uncontrolled(1, 5));
    assert!(!system.leave_uncontrolled(1, 3) && !system.leave_uncontrolled(0, 0));
    let position = system.position_of(1, 5).unwrap();
    let scales = system.structure().scales;
    assert_eq!(scales.iter().filter(|scale| scale.is_infinite()).count(), 1);
    assert!(scales[position].is_infinite());
}
