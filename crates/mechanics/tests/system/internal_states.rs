//! analytic, energy: an element with a pair of internal states, a mass of its own that swings on a spring
//! beside the body.

use crate::common::integrate;
use integrate::Options;
use mechanics::body::Body;
use mechanics::element::{Element, Wrench};
use mechanics::frame::Frame;

use mechanics::link::{Marker, RelativeMotion};
use mechanics::system::{Held, Model, StaticFriction, System};
use mechanics::vector::Vector;
use numerics::scalar::Real;

/// A state that is a rate comes as the way of this time, s.
const WAY: f64 = 1e-3;

/// A mass between two springs and dampers along the x axis of marker B: one to marker A, one to marker B.
/// Its place is the first state, its velocity the second.
#[derive(Clone, Debug)]
pub struct Absorber {
    pub mass: f64,
    /// To marker A, to marker B.
    pub stiffness: [f64; 2],
    pub damping: [f64; 2],
    /// A force on the mass, N, which counts as stored energy.
    pub load: f64,
}

impl Element for Absorber {
    fn name(&self) -> &str {
        "absorber"
    }

    fn has_states(&self) -> bool {
        true
    }

    fn does_work(&self) -> bool {
        true
    }

    fn evaluate<S: Real>(&self, motion: &RelativeMotion<S>) -> Wrench<S> {
        self.evaluate_with(motion, [S::zero(); 2]).0
    }

    fn evaluate_with<S: Real>(
        &self,
        motion: &RelativeMotion<S>,
        [place, way]: [S; 2],
    ) -> (Wrench<S>, [S; 2]) {
        let ([k, ground], [c, drag]) = (self.stiffness, self.damping);
        let speed = way * (1.0 / WAY);
        let [x, y, _] = motion.position.0;
        let [v, ..] = motion.velocity.0;
        let pull = (place - x) * k + (speed - v) * c;
        let acceleration = (pull * -1.0 - place * ground - speed * drag + self.load) * (1.0 / self.mass);
        let slip = speed - v;
        let wrench = Wrench {
            force: Vector([pull, S::zero(), S::zero()]),
            // One that does no work here, but depends on all that there is.
            moment: Vector([S::zero(), S::zero(), motion.rotation.0[1][0] * place * y * 3.0]),
            powers: [slip * slip * c + speed * speed * drag, S::zero()],
        };
        (wrench, [speed, acceleration * WAY])
    }

    fn energy(&self, motion: &RelativeMotion<f64>) -> f64 {
        self.energy_with(motion, [0.0; 2])
    }

    fn energy_with(&self, motion: &RelativeMotion<f64>, [place, way]: [f64; 2]) -> f64 {
        let ([k, ground], speed) = (self.stiffness, way / WAY);
        let stretch = place - motion.position.0[0];
        0.5 * (self.mass * speed * speed + k * stretch * stretch + ground * place * place) - self.load * place
    }
}

pub const ABSORBER: Absorber = Absorber {
    mass: 0.5,
    stiffness: [400.0, 900.0],
    damping: [2.0, 1.0],
    load: 0.0,
};

const MASS: f64 = 2.0;

/// A body that moves along x alone, beside an absorber on a wall; `reversed` hangs the element the other way.
fn system(load: f64, reversed: bool) -> System {
    let mut body = Body::free("mass", MASS, [1.0; 3], [0.1, 0.0, 0.0, 0.0, 0.0, 0.0]);
    body.free = [true, false, false, false, false, false];
    let wall = Body::prescribed("wall", Frame::fixed([0.0; 3], [0.0; 3]));
    let mut model = Model::new(vec![wall, body], [0.0; 3]);
    let at = Marker::new([0.0; 3], [0.0; 3]);
    let element = Absorber { load, ..ABSORBER };
    match reversed {
        false => model.add(element, (1, at), (0, at)),
        true => model.add(element, (0, at), (1, at)),
    }
    System::new(model).unwrap()
}

/// The roots of `(M s² + c s + k) (m s² + (c + d) s + k + g) = (c s + k)²`: two masses in a row.
#[test]
fn analytic_vibrations_of_two_masses_in_a_row() {
    let mut system = system(0.0, false);
    let x = vec![0.0; system.initial_state().len()];
    let found = system.eigenvalues(0.0, &x, 1.0).unwrap();
    let ([k, g], [c, d]) = (ABSORBER.stiffness, ABSORBER.damping);
    let mut oscillating = 0;
    for [re, im] in found {
        let times = |[a, b]: [f64; 2], [p, q]: [f64; 2]| [a * p - b * q, a * q + b * p];
        let s = [re, im];
        let line = |by: f64, free: f64| [by * re + free, by * im];
        let square = times(s, s);
        let plus = |[a, b]: [f64; 2], [p, q]: [f64; 2], m: f64| [m * a + p, m * b + q];
        let own = plus(square, line(c, k), MASS);
        let inner = plus(square, line(c + d, k + g), ABSORBER.mass);
        let [left, right] = [times(own, inner), times(line(c, k), line(c, k))];
        let size = k * (k + g);
        assert!(
            libm::hypot(left[0] - right[0], left[1] - right[1]) < 1e-8 * size,
            "{re} {im}"
        );
        oscillating += usize::from(im > 1.0);
    }
    assert_eq!(oscillating, 2);
}

/// At rest under a load on the inner mass, `s = F/g` and the body is where that is; states that follow at
/// once leave the body on both springs in series.
#[test]
fn analytic_rest_and_vibration_on_springs_in_series() {
    let ([k, g], load) = (ABSORBER.stiffness, 36.0);
    let mut system = system(load, false);
    let start = system.initial_state();
    let rest = system.equilibrium(0.0, &start, StaticFriction::Without).unwrap();
    let seen = system.observe(0.0, &rest);
    let [place, way] = seen.elements[0].states;
    assert!(
        (place - load / g).abs() < 1e-12 && way.abs() < 1e-12,
        "{place} {way}"
    );
    assert!((seen.bodies[1].origin.0[0] - load / g).abs() < 1e-12);
    let found = system.vibrations(0.0, &rest, Held::default()).unwrap();
    let frequency = (k * g / (k + g) / MASS).sqrt() / std::f64::consts::TAU;
    let [only] = &found.modes[..] else {
        panic!("{found:?}")
    };
    assert!(
        (only.frequency / frequency - 1.0).abs() < 1e-9,
        "{} {frequency}",
        only.frequency
    );
}

/// Stored and lost energy of a swing, hung either way: where marker B moves with the body, the mass swings
/// relative to the body, as if it had no weight of its own.
#[test]
fn energy_of_a_swing_is_in_the_ledger() {
    for reversed in [false, true] {
        let system = system(5.0, reversed);
        let start = system.initial_state();
        let mut copy = system.clone();
        let stored = copy.observe(0.0, &start).energies.total();
        let options = Options {
            relative_tolerance: 1e-8,
            ..Options::default()
        };
        let end = integrate(system, options, &start, 1.0, |_| {}).x().to_vec();
        let seen = copy.observe(1.0, &end);
        assert!(seen.losses > 0.1, "{}", seen.losses);
        assert!(
            seen.residual(stored).abs() < 1e-6 * seen.losses,
            "{:e}",
            seen.residual(stored)
        );
        assert!((copy.energies(1.0, &end).total() - seen.energies.total()).abs() < 1e-12);
    }
}
