//! Force elements of any kind: derivatives at both ends, momentum, the energy ledger; bodies with finite and
//! with linearized kinematics.

use crate::common::Random;
use crate::internal_states::ABSORBER;
use integrate::{Integrator, Method, Options, Problem};
use mechanics::body::Body;
use mechanics::coil::{Coil, CoilLaw};
use mechanics::connection::{Connection, Law, SpringDamper};
use mechanics::curve::Curve;
use mechanics::element::{Element, Inputs, Placement, Wrench};
use mechanics::frame::Frame;
use mechanics::link::{Marker, RelativeMotion};
use mechanics::motion::Motion;
use mechanics::system::{Model, ModelError, System};
use mechanics::vector::Vector;
use numerics::scalar::Real;

/// A bushing, and what share of its energy it owns up to.
#[derive(Clone, Debug)]
struct Bushing {
    stiffness: f64,
    damping: f64,
    /// Torsional stiffness and damping by those of displacements, m².
    torsion: f64,
    reported: f64,
}

const BUSHING: Bushing = Bushing {
    stiffness: 3e4,
    damping: 80.0,
    torsion: 0.04,
    reported: 1.0,
};

impl Element for Bushing {
    fn name(&self) -> &str {
        "bushing"
    }
    fn evaluate<S: Real>(&self, motion: &RelativeMotion<S>) -> Wrench<S> {
        let (k, c, t) = (self.stiffness, self.damping, self.torsion);
        let (v, w) = (motion.velocity, motion.angular_velocity);
        let rotations = motion.small_rotations();
        Wrench {
            force: motion.position.scale::<f64, S>(-k) - v.scale::<f64, S>(c),
            moment: rotations.scale::<f64, S>(-k * t) - w.scale::<f64, S>(c * t),
            powers: [(v.dot::<S, S>(v) + w.dot::<S, S>(w) * t) * c, S::zero()],
        }
    }
    fn energy(&self, motion: &RelativeMotion<f64>) -> f64 {
        let (d, r) = (motion.position, motion.small_rotations());
        0.5 * self.reported * self.stiffness * (d.dot::<f64, f64>(d) + self.torsion * r.dot::<f64, f64>(r))
    }
}

fn coil() -> Coil {
    Coil {
        end: Vector([0.1, -0.2, 0.05]),
        acts_at: Vector([0.1, -0.2, 0.05]),
        law: CoilLaw::Linear { stiffness: 5e3 },
        free_length: 0.4,
        damping: 30.0,
        rotational_damping: 0.0,
        pulls: true,
    }
}

/// The coil as an element whose marker A is its end.
#[derive(Clone, Debug)]
struct Strut(Coil);

impl Element for Strut {
    fn name(&self) -> &str {
        "strut"
    }
    fn evaluate<S: Real>(&self, motion: &RelativeMotion<S>) -> Wrench<S> {
        self.0.evaluate(motion)
    }
    fn energy(&self, motion: &RelativeMotion<f64>) -> f64 {
        Element::energy(&self.0, motion)
    }
    fn inputs(&self) -> Inputs {
        self.0.inputs()
    }
}

fn free(name: &str, random: &mut Random, frame: Frame) -> Body {
    let mut body = Body::free(name, 2.0, [0.03, 0.05, 0.04], random.vector(0.2));
    body.center_of_gravity = random.vector(0.1);
    body.frame = frame;
    body
}

fn moving(random: &mut Random) -> Frame {
    let mut frame = Frame::fixed(random.vector(0.5), random.vector(0.5));
    for motion in &mut frame.motions {
        *motion = Motion::Sine {
            amplitude: random.between(0.02, 0.1),
            angular_frequency: random.between(1.0, 4.0),
            phase: random.between(0.0, 3.0),
        };
    }
    frame
}

/// Returns two free bodies and a prescribed one, bushings and elements with internal states between all of
/// them, a coil; frames at rest or moving.
fn chain(random: &mut Random, frames: [Frame; 2]) -> System {
    let [first, second] = frames;
    let bodies = vec![
        Body::prescribed("driver", moving(random)),
        free("first", random, first),
        free("second", random, second),
    ];
    let mut model = Model::new(bodies, [0.0, 0.0, -9.8]);
    let mut marker = || Marker::new(random.vector(0.3), random.vector(0.4));
    model.add(BUSHING, (1, marker()), (0, marker()));
    model.add(BUSHING, (2, marker()), (1, marker()));
    model.add(Strut(coil()), (1, marker()), (2, marker()));
    for (a, b) in [(2, 1), (1, 0), (0, 2)] {
        model.add(ABSORBER, (a, marker()), (b, marker()));
    }
    model.coils = vec![(2, 1, marker(), coil())];
    System::new(model).unwrap()
}

fn state(system: &System, random: &mut Random) -> Vec<f64> {
    let mut x = system.initial_state();
    let n = system.layout().speeds;
    for value in &mut x[..n] {
        *value += random.between(-0.1, 0.1);
    }
    for value in &mut x[n..2 * n] {
        *value = random.between(-1.0, 1.0);
    }
    for value in &mut x[2 * n..2 * n + system.layout().internals] {
        *value = random.between(-1e-3, 1e-3);
    }
    x
}

/// `(σ - J) y = σ y - J y` for any y, with J y and ∂f/∂t by differences.
#[test]
fn analytic_derivatives_at_both_ends_against_differences() {
    let still = || Frame::fixed([0.1, 0.2, -0.1], [0.2, -0.1, 0.3]);
    for seed in 0..8 {
        let mut random = Random(seed);
        let frames = match seed % 3 {
            0 => [still(), still()],
            1 => [moving(&mut random), still()],
            _ => [still(), moving(&mut random)],
        };
        let mut system = chain(&mut random, frames);
        let (time, shift, h) = (0.3, 50.0, 1e-6);
        system.next_time_discontinuity(0.0);
        let x = state(&system, &mut random);
        let dimension = x.len();
        let mut value = |time: f64, x: &[f64]| {
            let mut dx = vec![0.0; dimension];
            system.derivative(time, x, &mut dx);
            dx
        };
        let along = |up: Vec<f64>, down: Vec<f64>| -> Vec<f64> {
            up.iter()
                .zip(down)
                .map(|(up, down)| (up - down) / (2.0 * h))
                .collect()
        };
        let dx = value(time, &x);
        let by_time = along(value(time + h, &x), value(time - h, &x));
        let direction: Vec<f64> = (0..dimension).map(|_| random.between(-1.0, 1.0)).collect();
        let moved =
            |sign: f64| -> Vec<f64> { x.iter().zip(&direction).map(|(x, y)| x + sign * h * y).collect() };
        let by_state = along(value(time, &moved(1.0)), value(time, &moved(-1.0)));
        let mut df_dt = vec![0.0; dimension];
        system.linearize(time, &x, &dx, &mut df_dt);
        let size = by_time.iter().fold(1.0, |m: f64, v| m.max(v.abs()));
        for (found, expected) in df_dt.iter().zip(&by_time) {
            assert!(
                (found - expected).abs() < 1e-6 * size,
                "{found} {expected}, seed {seed}"
            );
        }
        system.factor(shift).unwrap();
        let mut right: Vec<f64> = direction
            .iter()
            .zip(&by_state)
            .map(|(y, jy)| shift * y - jy)
            .collect();
        system.solve(&mut right);
        for (found, expected) in right.iter().zip(&direction) {
            assert!((found - expected).abs() < 1e-5, "{found} {expected}, seed {seed}");
        }
    }
}

/// The same coil in the model's list of coils and as an element at its end.
#[test]
fn analytic_a_coil_is_an_element_at_its_end() {
    let mut random = Random(4);
    let frame = || Frame::fixed([0.0; 3], [0.0; 3]);
    let bodies = vec![free("a", &mut random, frame()), free("b", &mut random, frame())];
    let seat = Marker::new(random.vector(0.3), random.vector(0.4));
    let mut listed = Model::new(bodies.clone(), [0.0; 3]);
    listed.coils = vec![(0, 1, seat, coil())];
    let mut added = Model::new(bodies, [0.0; 3]);
    added.add(
        Strut(coil()),
        (0, Marker::new(coil().end.0, [0.3, 0.2, 0.1])),
        (1, seat),
    );
    let (mut listed, mut added) = (System::new(listed).unwrap(), System::new(added).unwrap());
    let x = state(&listed, &mut random);
    let (mut one, mut two) = (vec![0.0; x.len()], vec![0.0; x.len()]);
    listed.derivative(0.0, &x, &mut one);
    added.derivative(0.0, &x, &mut two);
    for (one, two) in one.iter().zip(&two) {
        assert!((one - two).abs() < 1e-10 * (1.0 + one.abs()), "{one} {two}");
    }
    let (one, two) = (listed.observe(0.0, &x), added.observe(0.0, &x));
    assert!((one.energies.coil - two.energies.element).abs() < 1e-10);
}

fn run(system: &System, end: f64) -> (f64, f64) {
    let mut copy = system.clone();
    let start = system.initial_state();
    let stored = copy.observe(0.0, &start).energies.total();
    let options = Options {
        relative_tolerance: 1e-8,
        ..Options::default()
    };
    let mut integrator = Integrator::new(system.clone(), options, 0.0, &start).unwrap();
    while integrator.time() < end {
        integrator.step_to(end).unwrap();
    }
    let observation = copy.observe(end, integrator.x());
    (observation.residual(stored).abs(), observation.losses)
}

/// Stored and lost energy account for the work, with a driver that turns and bodies in moving frames; an
/// element that hides a tenth of its energy is found out.
#[test]
fn energy_an_element_that_is_left_out_of_the_ledger_is_noticed() {
    let frame = Frame::fixed([0.0; 3], [0.0; 3]);
    for reported in [1.0, 0.9] {
        let mut random = Random(11);
        let driver = Body::prescribed("driver", moving(&mut random));
        let (one, two) = (
            free("one", &mut random, frame.clone()),
            free("two", &mut random, frame.clone()),
        );
        let mut model = Model::new(vec![driver, one, two], [0.0, 0.0, -9.8]);
        // Without torsion: beyond small rotations it has no energy of its own.
        let bushing = Bushing {
            torsion: 0.0,
            reported,
            ..BUSHING
        };
        let mut marker = || Marker::new(random.vector(0.2), random.vector(0.2));
        for (a, b) in [(1, 0), (2, 1), (2, 0)] {
            model.add(bushing.clone(), (a, marker()), (b, marker()));
        }
        let (residual, losses) = run(&System::new(model).unwrap(), 0.5);
        if reported == 1.0 {
            assert!(residual < 1e-5 * losses, "{residual:e} of {losses}");
        } else {
            assert!(residual > 1e-3 * losses, "{residual:e} of {losses}");
        }
    }
}

/// Momentum and angular momentum of two free bodies change by nothing that acts between them.
#[test]
fn analytic_momentum_is_conserved() {
    let mut random = Random(2);
    let frame = || Frame::fixed([0.0; 3], [0.0; 3]);
    let bodies = vec![free("a", &mut random, frame()), free("b", &mut random, frame())];
    let mut model = Model::new(bodies, [0.0; 3]);
    let mut marker = || Marker::new(random.vector(0.3), random.vector(0.4));
    model.add(BUSHING, (0, marker()), (1, marker()));
    model.add(Strut(coil()), (1, marker()), (0, marker()));
    let mut system = System::new(model).unwrap();
    let x = state(&system, &mut random);
    let (h, mut dx) = (1e-6, vec![0.0; x.len()]);
    system.derivative(0.0, &x, &mut dx);
    let mut momenta = |sign: f64| {
        let moved: Vec<f64> = x.iter().zip(&dx).map(|(x, rate)| x + sign * h * rate).collect();
        let observation = system.observe(0.0, &moved);
        let (mut linear, mut angular) = (Vector([0.0; 3]), Vector([0.0; 3]));
        for (state, body) in observation.bodies.iter().zip(system.bodies()) {
            let arm = state.center_of_gravity - state.origin;
            let velocity: Vector<f64> = state.velocity + state.angular_velocity.cross::<f64, f64>(arm);
            let own: Vector<f64> = state.rotation.apply_transposed(state.angular_velocity);
            let spin = Vector([0, 1, 2].map(|k| body.inertia[k] * own.0[k]));
            let momentum: Vector<f64> = velocity.scale(body.mass);
            linear += momentum;
            angular += state.center_of_gravity.cross::<f64, f64>(momentum);
            angular += state.rotation.apply::<f64, f64>(spin);
        }
        [linear, angular]
    };
    let (up, down) = (momenta(1.0), momenta(-1.0));
    let forces = dx.iter().fold(0.0, |m: f64, rate| m.max(rate.abs()));
    for (up, down) in up.into_iter().zip(down) {
        for rate in (up - down).0 {
            assert!((rate / (2.0 * h)).abs() < 1e-6 * forces, "{rate:e}");
        }
    }
}

const SPRINGS: [[f64; 3]; 4] = [
    [0.3, 0.2, -0.1],
    [0.3, -0.2, -0.1],
    [-0.3, 0.2, -0.1],
    [-0.3, -0.2, -0.1],
];

/// A body on four springs with finite and with linearized kinematics: accelerations differ by the square of
/// the angles.
#[test]
fn limits_a_linearized_body_is_a_finite_one_at_small_angles() {
    let (mass, inertia, stiffness) = (5.0, [0.1, 0.2, 0.25], 2e3);
    let nowhere = [0.0; 6];
    let mut finite = Model::new(
        vec![
            Body::prescribed("wall", Frame::fixed([0.0; 3], [0.0; 3])),
            Body::free("body", mass, inertia, nowhere),
        ],
        [0.0; 3],
    );
    let spring = Bushing {
        stiffness,
        damping: 0.0,
        torsion: 0.0,
        reported: 1.0,
    };
    let mut linear = Model::new(
        vec![
            Body::ground(),
            Body::linearized("body", [0.0; 3], [true; 6], mass, inertia),
        ],
        [0.0; 3],
    );
    for point in SPRINGS {
        let marker = Marker::new(point, [0.0; 3]);
        finite.add(spring.clone(), (1, marker), (0, marker));
        let law = SpringDamper::spring(Curve::linear(stiffness));
        linear.connections.push(Connection {
            account: String::new(),
            name: "spring".to_owned(),
            a: 0,
            b: 1,
            point,
            markers: None,
            law: Law::Springs((0..3).map(|k| (k, law.clone())).collect()),
        });
    }
    let (mut finite, mut linear) = (System::new(finite).unwrap(), System::new(linear).unwrap());
    let shape = [0.3, -0.2, 0.4, 1.0, -0.7, 0.8];
    let mut differences = Vec::new();
    for size in [1e-2, 1e-3] {
        let (mut x, mut y) = (finite.initial_state(), linear.initial_state());
        for (k, value) in shape.iter().enumerate() {
            (x[k], y[k]) = (size * value, size * value);
        }
        let (mut dx, mut dy) = (vec![0.0; x.len()], vec![0.0; y.len()]);
        finite.derivative(0.0, &x, &mut dx);
        linear.derivative(0.0, &y, &mut dy);
        let parts = dx[6..12].iter().zip(&dy[6..12]);
        let (difference, largest) = parts.fold((0.0, 0.0), |(d, m): (f64, f64), (a, b)| {
            (d.max((a - b).abs()), m.max(b.abs()))
        });
        assert!(difference < 3.0 * size * largest, "{difference} of {largest}");
        differences.push(difference);
    }
    // A hundredth, to a tenth of it.
    let ratio = differences[0] / differences[1];
    assert!((90.0..110.0).contains(&ratio), "{ratio}");
}

/// Connections act on displacements along fixed axes; bodies with linearized kinematics are not turned.
#[test]
fn input_frames_that_do_not_fit_are_refused() {
    let small = Body::linearized("small", [0.0; 3], [true; 6], 1.0, [1.0; 3]);
    let mut large = Body::free("large", 1.0, [1.0; 3], [0.0; 6]);
    large.frame.orientation[2] = 0.1;
    let mut model = Model::new(vec![small.clone(), large], [0.0; 3]);
    let law = Law::Springs(vec![(0, SpringDamper::spring(Curve::linear(1.0)))]);
    let (name, point) = ("link".to_owned(), [0.0; 3]);
    model.connections.push(Connection {
        account: String::new(),
        name,
        a: 0,
        b: 1,
        point,
        markers: None,
        law,
    });
    let error = System::new(model).unwrap_err();
    assert!(
        error.to_string().contains("connection 0 (link) joins large")
            && error.to_string().contains("must not be turned"),
        "{error}"
    );
    let mut turned = small;
    turned.frame.orientation[2] = 0.1;
    let error = System::new(Model::new(vec![turned], [0.0; 3])).unwrap_err();
    assert!(matches!(error, ModelError::Layout { .. }), "{error}");
}

/// An element whose marker A is on a prescribed, moving body gives the free body the same accelerations as
/// the same element on a free body that is so heavy that it keeps this motion; and the loads that it reports
/// on the body with marker A are the opposite of those on the free body.
#[test]
fn analytic_either_body_of_an_element_may_be_prescribed() {
    let mut random = Random(11);
    let frame = moving(&mut random);
    let carried = free("carried", &mut random, Frame::fixed([0.1, 0.0, 0.2], [0.0; 3]));
    let [a, b] = [0, 1].map(|_| Marker::new(random.vector(0.3), random.vector(0.4)));
    let build = |driver: Body, torsion: f64| {
        let mut model = Model::new(vec![driver, carried.clone()], [0.0; 3]);
        model.add(Bushing { torsion, ..BUSHING }, (0, a), (1, b));
        model.add(Strut(coil()), (0, a), (1, b));
        System::new(model).unwrap()
    };
    let mut heavy = Body::free("driver", 1e12, [1e12; 3], [0.0; 6]);
    heavy.frame = frame.clone();
    let driver = Body::prescribed("driver", frame);
    let mut prescribed = build(driver.clone(), BUSHING.torsion);
    let mut heavy = build(heavy, BUSHING.torsion);
    let (time, x) = (0.3, state(&prescribed, &mut random));
    let n = prescribed.layout().speeds;
    let mut both = heavy.initial_state();
    both[6..6 + n].copy_from_slice(&x[..n]);
    both[18..18 + n].copy_from_slice(&x[n..2 * n]);
    prescribed.next_time_discontinuity(0.0);
    heavy.next_time_discontinuity(0.0);
    let (mut dx, mut d_both) = (vec![0.0; x.len()], vec![0.0; both.len()]);
    prescribed.derivative(time, &x, &mut dx);
    heavy.derivative(time, &both, &mut d_both);
    for (found, expected) in dx[n..2 * n].iter().zip(&d_both[18..]) {
        assert!(
            (found - expected).abs() < 1e-9 * (1.0 + expected.abs()),
            "{found} {expected}"
        );
    }
    let (found, expected) = (prescribed.observe(time, &x), heavy.observe(time, &both));
    for (found, expected) in found.elements.iter().zip(&expected.elements) {
        for k in 0..3 {
            assert!((found.force.0[k] - expected.force.0[k]).abs() < 1e-6);
            assert!((found.moment.0[k] - expected.moment.0[k]).abs() < 1e-6);
        }
        assert!((found.energy - expected.energy).abs() < 1e-9 * expected.energy);
        assert!(found.force.0.iter().any(|f| f.abs() > 1.0));
    }
    // The ledger closes, with the work of the driver. (The bushing's torsion keeps no energy at large
    // angles.)
    let mut prescribed = build(driver, 0.0);
    let start = prescribed.observe(0.0, &x).energies.total();
    let mut integrator = Integrator::new(prescribed.clone(), Options::default(), 0.0, &x).unwrap();
    while integrator.time() < 0.5 {
        integrator.step_to(0.5).unwrap();
    }
    let end = prescribed.observe(0.5, integrator.x());
    assert!(
        end.work.abs() > 0.05 && end.losses > 1.0,
        "{} {}",
        end.work,
        end.losses
    );
    assert!(
        end.residual(start).abs() < 1e-7 * (start + end.losses),
        "{}",
        end.residual(start)
    );
}

/// A thrust of 1 N along x of the ground, which does work.
#[derive(Clone, Debug)]
struct Thrust;

impl Element for Thrust {
    fn name(&self) -> &str {
        "thrust"
    }
    fn does_work(&self) -> bool {
        true
    }
    fn evaluate<S: Real>(&self, motion: &RelativeMotion<S>) -> Wrench<S> {
        let force = Vector([S::from(1.0), S::zero(), S::zero()]);
        Wrench {
            force,
            moment: Vector::zero(),
            powers: [S::zero(), force.dot(motion.velocity)],
        }
    }
    fn energy(&self, _: &RelativeMotion<f64>) -> f64 {
        0.0
    }
}

/// Under a factor a sin ωt a mass moves by `a/(m ω²) (ωt - sin ωt)`; the thrust's work is its kinetic
/// energy. A factor set from outside holds until the next one.
#[test]
fn analytic_a_factor_over_time_moves_a_mass() {
    let (mass, amplitude, omega) = (7.0, 50.0, 3.0);
    let ground = Body::prescribed("ground", Frame::fixed([0.0; 3], [0.0; 3]));
    let own = Body::free("mass", mass, [1.0; 3], [0.0; 6]);
    let mut model = Model::new(vec![ground, own], [0.0; 3]);
    let at = Marker::new([0.0; 3], [0.0; 3]);
    let placed = Placement::new(Thrust, (1, at), (0, at));
    model.elements.push(placed.over_time(Motion::Sine {
        amplitude,
        angular_frequency: omega,
        phase: 0.0,
    }));
    let mut system = System::new(model).unwrap();
    let state = system.initial_state();
    for method in [Method::Rodas5P, Method::Esdirk3] {
        let options = Options {
            relative_tolerance: 1e-9,
            ..Options::of(method)
        };
        let mut integrator = Integrator::new(system.clone(), options, 0.0, &state).unwrap();
        while integrator.time() < 2.0 {
            integrator.step_to(2.0).unwrap();
        }
        let phase: f64 = 2.0 * omega;
        let exact = amplitude / (mass * omega * omega) * (phase - phase.sin());
        let seen = system.observe(2.0, integrator.x());
        let found = seen.bodies[1].origin.0[0];
        assert!(
            (found / exact - 1.0).abs() < 1e-7,
            "{method:?}: {found} m, {exact} m"
        );
        let residual = seen.residual(0.0);
        let most = 0.5 * mass * (2.0 * amplitude / (mass * omega)).powi(2);
        assert!(residual.abs() < 1e-8 * most, "{residual} J of {most} J");
    }
    system.set_factor(0, -14.0).unwrap();
    let mut rates = vec![0.0; state.len()];
    system.derivative(0.5, &state, &mut rates);
    let place = system.layout().speeds + system.position_of(1, 0).unwrap();
    assert!((rates[place] + 2.0).abs() < 1e-12, "{}", rates[place]);
    let error = system.set_factor(3, 1.0).unwrap_err();
    assert!(error.to_string().contains("element with a factor 3"), "{error}");
}
