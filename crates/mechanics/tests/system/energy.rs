//! Energy: kept where nothing is lost, and accounted for where something is.

use crate::common::{ALL, Ledger, UP, body, coil, face, ground, integrate, model, momenta, norm, options};
use integrate::{Method, Options, Problem};
use mechanics::body::Body;
use mechanics::frame::Frame;
use mechanics::friction::FrictionLaw;
use mechanics::link::Marker;
use mechanics::motion::{Motion, RampProfile};
use mechanics::system::{EnergyTermKind, Model, System};

/// Energy at start and end.
fn energies(system: System, options: Options, x: &[f64], end: f64) -> [f64; 2] {
    let mut twin = system.clone();
    let before = twin.observe(0.0, x).energies.total();
    let done = integrate(system, options, x, end, |_| {});
    [before, twin.observe(end, done.x()).energies.total()]
}

#[test]
fn a_pendulum() {
    // Pitch about y; center of gravity below the axis: its least energy is hanging.
    let (mass, length, inertia) = (2.0, 0.5, 0.1);
    let free = [false, false, false, false, true, false];
    let mut one = body(
        "b",
        mass,
        [1.0, inertia, 1.0],
        [0.0, 0.0, -length],
        free,
        [0.0; 6],
    );
    let amplitude = 2.5;
    one.initial[4] = amplitude;
    let system = System::new(model(vec![one], [0.0, 0.0, -9.81])).unwrap();
    let x = system.initial_state();
    let [before, after] = energies(system.clone(), options(Method::Rodas5P, 1e-10), &x, 10.0);
    let height = mass * 9.81 * length;
    assert!((before + height * amplitude.cos()).abs() < 1e-12);
    // 1e-10 of a scale of 0.1 rad and 10 rad/s a step, some 1e3 steps.
    assert!((after - before).abs() < 1e-6 * height, "{before} -> {after}");
    // Its period, by the arithmetic-geometric mean: T = T0 / agm(1, cos(A/2)).
    let (mut a, mut g) = (1.0, (0.5 * amplitude).cos());
    for _ in 0..8 {
        (a, g) = (0.5 * (a + g), f64::sqrt(a * g));
    }
    let small = 2.0 * std::f64::consts::PI * ((inertia + mass * length * length) / height).sqrt();
    let period = small / a;
    let mut crossings = Vec::new();
    integrate(system, options(Method::Rodas5P, 1e-10), &x, 10.0, |integrator| {
        if integrator.previous_x()[0] * integrator.x()[0] < 0.0 {
            let (mut low, mut high) = (integrator.previous_time(), integrator.time());
            for _ in 0..60 {
                let middle = 0.5 * (low + high);
                let mut at = vec![0.0; integrator.x().len()];
                integrator.interpolate(middle, &mut at);
                if at[0] * integrator.previous_x()[0] > 0.0 {
                    low = middle;
                } else {
                    high = middle;
                }
            }
            crossings.push(low);
        }
    });
    assert!(crossings.len() > 4);
    for (n, time) in crossings.iter().enumerate() {
        let expected = period * (0.25 + 0.5 * n as f64);
        assert!(
            (time - expected).abs() < 1e-6,
            "crossing {n} at {time} instead of {expected}"
        );
    }
}

#[test]
fn a_thrown_body() {
    let one = body("b", 2.0, [0.3, 0.5, 0.7], [0.1, -0.2, 0.05], ALL, [0.0; 6]);
    let gravity = [0.0, 0.0, -9.81];
    let system = System::new(model(vec![one], gravity)).unwrap();
    let mut x = system.initial_state();
    x[6..12].copy_from_slice(&[1.0, -2.0, 4.0, 2.0, 1.0, 0.7]);
    let mut twin = system.clone();
    let before = momenta(&mut twin, 0.0, &x);
    let [first, last] = energies(system.clone(), options(Method::Rodas5P, 1e-10), &x, 0.8);
    let kinetic = twin.observe(0.0, &x).energies.kinetic;
    assert!((last - first).abs() < 1e-7 * kinetic, "{first} -> {last}");
    let cg = |twin: &mut System, time: f64, x: &[f64]| twin.observe(time, x).bodies[0].center_of_gravity.0;
    let (start, done) = (
        cg(&mut twin, 0.0, &x),
        integrate(system, options(Method::Rodas5P, 1e-10), &x, 0.8, |_| {}),
    );
    let after = momenta(&mut twin, 0.8, done.x());
    let position = cg(&mut twin, 0.8, done.x());
    for k in 0..3 {
        // The center of gravity flies on a parabola, the spin about it stays.
        let flown = start[k] + before[k] / 2.0 * 0.8 + 0.5 * gravity[k] * 0.64;
        assert!((position[k] - flown).abs() < 1e-8, "{position:?} {k} {flown}");
    }
    let spin = |r: [f64; 3], m: &[f64]| {
        let orbital = crate::common::cross(r, [m[0], m[1], m[2]]);
        [0, 1, 2].map(|k| m[3 + k] - orbital[k])
    };
    let (a, b) = (spin(start, &before), spin(position, &after));
    for k in 0..3 {
        assert!((a[k] - b[k]).abs() < 1e-7 * norm(&a), "{a:?} -> {b:?}");
    }
}

/// Energy that the method gains or loses falls with the tolerance.
#[test]
fn energy_converges_with_the_tolerance() {
    let one = body("b", 2.0, [0.3, 0.5, 0.7], [0.1, -0.2, 0.05], ALL, [0.0; 6]);
    let mut parts = model(vec![one, ground()], [0.0, 0.0, -9.81]);
    let spring = coil([0.1, 0.0, 0.0], [0.1, 0.0, 0.0], 300.0, 0.8);
    parts
        .coils
        .push((0, 1, Marker::new([0.0, 0.0, 1.0], [0.0; 3]), spring));
    let system = System::new(parts).unwrap();
    let mut x = system.initial_state();
    x[6..12].copy_from_slice(&[0.5, -0.3, 0.2, 1.0, 2.0, -0.7]);
    let error = |tolerance: f64| {
        let [a, b] = energies(system.clone(), options(Method::Rodas5P, tolerance), &x, 2.0);
        (b - a).abs() / a.abs()
    };
    let errors = [1e-5, 1e-7, 1e-9].map(error);
    assert!(
        errors[1] < 0.1 * errors[0] && errors[2] < 0.1 * errors[1],
        "{errors:?}"
    );
    assert!(errors[2] < 1e-7, "{errors:?}");
}

const TANH: FrictionLaw = FrictionLaw::Tanh {
    reference_speed: 0.01,
};
const BRISTLE: FrictionLaw = FrictionLaw::Bristle {
    stiffness: 1e5,
    damping: 300.0,
};

/// Returns a body that falls on a face (damped or not), moves on it, and hangs on a damped coil with a
/// guiding couple.
fn dropped(law: FrictionLaw, damping: f64, frame: Frame) -> Model {
    let one = body(
        "b",
        5.0,
        [0.03, 0.05, 0.07],
        [0.01, 0.02, 0.1],
        ALL,
        [0.0, 0.0, 0.02, 0.0, 0.0, 0.0],
    );
    let base = Body::prescribed("base", frame);
    let mut model = model(vec![one, base, ground()], [0.0, 0.0, -9.81]);
    let corners = [
        [0.1, 0.1, 0.0],
        [0.1, -0.1, 0.0],
        [-0.1, 0.1, 0.0],
        [-0.1, -0.1, 0.0],
    ];
    let floor = face("floor", &corners, 5e4, damping, 0.3, law);
    model.faces.push((0, 1, Marker::new([0.0; 3], UP), floor));
    let mut one = coil([0.0, 0.0, 0.2], [0.01, 0.02, 0.1], 300.0, 0.3);
    (one.damping, one.rotational_damping) = (10.0, 0.1);
    model
        .coils
        .push((0, 1, Marker::new([0.3, 0.0, 0.3], [0.2, 0.1, 0.3]), one));
    model
}

fn shaking(rotating: bool) -> Frame {
    let mut frame = Frame::fixed([0.0; 3], [0.0; 3]);
    let sine = |amplitude: f64, angular_frequency: f64| Motion::Sine {
        amplitude,
        angular_frequency,
        phase: 0.0,
    };
    frame.motions[0] = sine(0.02, 12.0);
    frame.motions[1] = Motion::Triangle {
        amplitude: 0.01,
        angular_frequency: 7.0,
    };
    frame.motions[2] = sine(0.005, 8.0);
    if rotating {
        frame.motions[4] = sine(0.03, 9.0);
        frame.motions[5] = Motion::Ramp {
            amplitude: 0.3,
            start: 0.1,
            duration: 0.4,
            profile: RampProfile::Smooth,
        };
    }
    frame
}

/// Ledgers at start and end of a run, and the model's work and energy as a size.
fn ledgers(model: &Model, tolerance: f64) -> (Ledger, Ledger, f64) {
    let system = System::new(model.clone()).unwrap();
    let mut x = system.initial_state();
    x[6] = 0.5;
    x[10] = 0.3;
    let mut twin = system.clone();
    twin.next_time_discontinuity(0.0);
    let start = Ledger::at(&mut twin, 0.0, &x);
    let done = integrate(system, options(Method::Rodas5P, tolerance), &x, 0.6, |_| {});
    twin.segment_like(done.problem());
    let end = Ledger::at(&mut twin, 0.6, done.x());
    let size = start.stored.abs() + end.losses.iter().map(|(_, v)| v).sum::<f64>();
    (start, end, size)
}

/// Returns both laws on a base at rest, one that moves, one that also turns; whether it moves.
fn cases(damping: f64) -> Vec<(Model, bool)> {
    let mut out = Vec::new();
    for law in [TANH, BRISTLE] {
        out.push((dropped(law, damping, Frame::fixed([0.0; 3], [0.0; 3])), false));
        out.push((dropped(law, damping, shaking(false)), true));
        out.push((dropped(law, damping, shaking(true)), true));
    }
    out
}

/// The residual is below 1e-5, 1e-7 and 1e-9 of the energies, at a five hundredth of that as the tolerance.
fn closes(damping: f64) {
    for (i, (model, prescribed)) in cases(damping).into_iter().enumerate() {
        for most in [1e-5, 1e-7, 1e-9] {
            // Contacts ring: the errors of some thousand steps add up.
            let (start, end, size) = ledgers(&model, 2e-3 * most);
            let residual = end.residual(&start, |_| true).abs();
            assert!(
                residual < most * size,
                "case {i}: {residual:e} of {size}, at most {most:e}"
            );
            assert_eq!(end.work != 0.0, prescribed);
            assert!(end.guide.abs() > 1e-4 * size);
            assert!(end.losses.iter().all(|(_, lost)| *lost > 0.0));
        }
    }
}

#[test]
fn the_ledger_closes() {
    closes(0.0);
}

/// Damping must not pull: from where the force has come to zero until the point opens, the spring's energy is
/// still being lost, while no force acts by which the integrator could notice the end of it.
#[test]
fn the_ledger_closes_with_contact_damping() {
    closes(100.0);
}

/// A ledger from which any one entry is left out does not close: so the ones above say something.
#[test]
fn a_ledger_without_one_entry_fails() {
    for (model, prescribed) in cases(100.0) {
        let (start, end, size) = ledgers(&model, 1e-8);
        for kind in [
            EnergyTermKind::FrictionLoss,
            EnergyTermKind::ContactDampingLoss,
            EnergyTermKind::CoilDampingLoss,
        ] {
            let residual = end.residual(&start, |counted| counted != kind);
            assert!(
                residual.abs() > 1e-3 * size,
                "without {kind:?}: {residual} of {size}"
            );
        }
        let mut without = end.clone();
        without.guide = 0.0;
        assert!(without.residual(&start, |_| true).abs() > 1e-4 * size);
        if prescribed {
            let mut without = end.clone();
            without.work = 0.0;
            assert!(without.residual(&start, |_| true).abs() > 1e-3 * size);
        }
    }
}

/// A bouncing body loses in each bounce what a damped spring loses: closed form of the rebound.
#[test]
fn rebound_from_a_damped_contact() {
    // Without gravity a body strikes with speed v: m g¨ + c g˙ + k g = 0 until k g + c g˙ = 0.
    let (mass, k, c, v) = (2.0, 8e4, 120.0, 1.5);
    let free = [false, false, true, false, false, false];
    let one = body(
        "ball",
        mass,
        [1.0; 3],
        [0.0; 3],
        free,
        [0.0, 0.0, 0.01, 0.0, 0.0, 0.0],
    );
    let mut parts = model(vec![one, ground()], [0.0; 3]);
    parts.faces.push((
        0,
        1,
        Marker::new([0.0; 3], UP),
        face("floor", &[[0.0; 3]], k, c, 0.0, TANH),
    ));
    let system = System::new(parts).unwrap();
    let mut x = system.initial_state();
    x[1] = -v;
    let w0 = f64::sqrt(k / mass);
    let zeta = c / (2.0 * mass * w0);
    // g = -(v/w) exp(-ζ w0 t) sin(w t), w = w0 sqrt(1-ζ²); the force ends where k g + c g˙ = 0: tan(w t) = -2
    // ζ sqrt(1-ζ²)/(1-2ζ²)
    let phase =
        std::f64::consts::PI - (2.0 * zeta * (1.0 - zeta * zeta).sqrt()).atan2(1.0 - 2.0 * zeta * zeta);
    let rebound = v * (-zeta * phase / (1.0 - zeta * zeta).sqrt()).exp();
    let done = integrate(system, options(Method::Rodas5P, 1e-10), &x, 0.1, |_| {});
    assert!(done.x()[0] > 0.0);
    assert!(
        (done.x()[1] - rebound).abs() < 1e-6 * v,
        "{} instead of {rebound}",
        done.x()[1]
    );
    // What is missing is what the damper took, and the spring still holds at the end of the force.
    let problem = done.problem();
    let lost = problem
        .energy_terms()
        .iter()
        .position(|energy_term| energy_term.kind == EnergyTermKind::ContactDampingLoss)
        .unwrap();
    let lost = done.x()[problem.layout().len() - problem.layout().quadratures + lost];
    let expected = 0.5 * mass * (v * v - rebound * rebound);
    assert!(
        (lost - expected).abs() < 1e-6 * expected,
        "{lost} instead of {expected}"
    );
}
