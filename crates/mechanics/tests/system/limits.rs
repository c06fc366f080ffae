//! Limits of models: a mass that friction stops, creep, rest in equilibrium, momentum, the same bits again.

use crate::common::{
    ALL, Random, UP, add, body, coil, cross, difference, face, ground, integrate, model, momenta, norm,
    options, rates,
};
use integrate::{Integrator, Method, Options, Problem, State};
use mechanics::body::Body;
use mechanics::frame::Frame;
use mechanics::friction::FrictionLaw;
use mechanics::link::Marker;
use mechanics::motion::{Motion, RampProfile};
use mechanics::system::{ContactState, EnergyTermKind, Model, StaticFriction, System};
use mechanics::vector::Vector;

// Mass on a spring with Coulomb friction

const MASS: f64 = 10.0;
const STIFFNESS: f64 = 4000.0;
const LIMIT: f64 = 29.43;
const RELEASED: f64 = 0.2;

/// Returns a mass (x and z free) that lies on a plane by its weight, on a coil along x that is without force
/// at x = 0.
fn sliding_mass(law: FrictionLaw) -> System {
    let (gravity, normal) = (9.81, 1e6);
    let sunk = -MASS * gravity / normal;
    let free = [true, false, true, false, false, false];
    let one = body(
        "mass",
        MASS,
        [1.0; 3],
        [0.0; 3],
        free,
        [RELEASED, 0.0, sunk, 0.0, 0.0, 0.0],
    );
    let mut model = model(vec![one, ground()], [0.0, 0.0, -gravity]);
    let floor = face("floor", &[[0.0; 3]], normal, 0.0, 0.3, law);
    model.faces.push((0, 1, Marker::new([0.0; 3], UP), floor));
    // The seat lies at the height at which the mass rests.
    let spring = coil([0.0; 3], [0.0; 3], STIFFNESS, 1.0);
    model
        .coils
        .push((0, 1, Marker::new([-1.0, 0.0, sunk], [0.0; 3]), spring));
    System::new(model).unwrap()
}

#[test]
fn friction_stops_a_mass_on_a_spring_for_ever() {
    let bristle = 1e9;
    let system = sliding_mass(FrictionLaw::Bristle {
        stiffness: bristle,
        damping: 1e5,
    });
    let x = system.initial_state();
    // With a rigid slider every half cycle takes 2 F/k off the amplitude A. A bristle has to be turned over
    // first, within 2F/K of way, during which friction loses less than F·2F/K too little: k/2 (A0² - A1²) ≥ F
    // (A0 + A1) - 2F²/K.
    let loss = 2.0 * LIMIT / STIFFNESS;
    let mut bound = 0.0;
    let mut amplitude = RELEASED;
    let mut expected = Vec::new();
    while amplitude > LIMIT / STIFFNESS {
        let next = (amplitude - loss).abs();
        bound += 4.0 * LIMIT * LIMIT / (bristle * STIFFNESS * (amplitude + next));
        let sign = if expected.len() % 2 == 0 { -1.0 } else { 1.0 };
        expected.push((sign * (amplitude - loss), bound));
        amplitude -= loss;
    }
    assert_eq!(expected.len(), 14);
    // Where it stops it still springs back on its bristle, by less than from +F/K to -F/K.
    bound += 2.0 * LIMIT / bristle;
    assert!(bound < 2e-6, "the bound {bound} must tell something");
    let mut turns = Vec::new();
    let mut settled = f64::NAN;
    let end = integrate(system, options(Method::Rodas5P, 1e-7), &x, 20.0, |integrator| {
        let [before, after] = [integrator.previous_x()[2], integrator.x()[2]];
        if before * after < 0.0 && integrator.time() < 2.3 {
            // Where the velocity passes zero.
            let (mut low, mut high) = (integrator.previous_time(), integrator.time());
            let mut at = vec![0.0; integrator.x().len()];
            for _ in 0..60 {
                let middle = 0.5 * (low + high);
                integrator.interpolate(middle, &mut at);
                if at[2] * before > 0.0 {
                    low = middle;
                } else {
                    high = middle;
                }
            }
            turns.push((low, at[0]));
        }
        if integrator.time() >= 3.0 && settled.is_nan() {
            settled = integrator.x()[0];
        }
    });
    let half_cycle = std::f64::consts::PI * (MASS / STIFFNESS).sqrt();
    for (n, (place, bound)) in expected.iter().enumerate() {
        let (time, found) = turns[n];
        assert!(
            (found - place).abs() <= *bound + 2e-8,
            "turn {n}: {found} instead of {place}, bound {bound}"
        );
        assert!(
            (time - half_cycle * (n + 1) as f64).abs() < 2e-3,
            "turn {n} at {time}"
        );
    }
    let (x, u) = (end.x()[0], end.x()[2]);
    assert!((x + 0.00601).abs() <= bound, "stopped at {x}, bound {bound}");
    assert!((x - settled).abs() <= 1e-12, "drifted from {settled} to {x}");
    assert!(u.abs() <= 1e-12, "still moves by {u}");
    assert_eq!(end.discrete_states(), [ContactState::Stick as u8]);
    // It holds by elastic deflection: K e = k x.
    // (The face's second tangent is -x.)
    let held = -end.x()[5] * bristle;
    assert!((held + STIFFNESS * x).abs() < 1e-6 * LIMIT, "holds {held}");
}

#[test]
fn tanh_creeps_where_the_bristle_holds() {
    let v0 = 1e-4;
    let law = FrictionLaw::Tanh { reference_speed: v0 };
    let system = sliding_mass(law);
    let mut x = system.initial_state();
    x[0] = -0.006;
    let mut speeds = Vec::new();
    // A short step at most, so that there is something to look at: creep is slow. The speeds are asked for to
    // a hundredth of what inertia does to them, 1e-10 m/s: the tolerance is 1e-11 m/s.
    let options = Options {
        maximum_step: 0.25,
        ..options(Method::Rodas5P, 1e-12)
    };
    integrate(system, options, &x, 20.0, |integrator| {
        if integrator.time() > 0.5 {
            speeds.push((integrator.x()[0], integrator.x()[2]));
        }
    });
    assert!(speeds.len() > 20);
    for (x, u) in &speeds {
        let load = -STIFFNESS * x / LIMIT;
        let predicted = v0 * load.atanh();
        assert!((law.creep_speed(load) - predicted).abs() < 1e-15);
        // Inertia: m u˙ = m (du/dx) u, which is less than 1e-4 N here, of a load of up to 24 N.
        let slope = v0 * STIFFNESS / LIMIT / (1.0 - load * load);
        let inertia = MASS * slope * predicted / LIMIT;
        let bound = v0 / (1.0 - load * load) * inertia * 1.1 + 1e-6 * v0;
        assert!(inertia < 1e-5);
        assert!(
            (u - predicted).abs() <= bound,
            "at {x}: {u} instead of {predicted} (within {bound})"
        );
    }
    // In 20 s the held load is gone by a large part.
    assert!(speeds.last().unwrap().0 > -0.006 * 0.9);
}

#[test]
fn creep_speeds_of_a_system() {
    for law in [
        FrictionLaw::Tanh { reference_speed: 0.1 },
        FrictionLaw::Bristle {
            stiffness: 1e6,
            damping: 1e3,
        },
    ] {
        let mut system = sliding_mass(law);
        let mut x = system.initial_state();
        let mut speeds = [f64::NAN];
        x[2] = 0.01;
        system.creep_speeds(0.0, &x, &mut speeds);
        let bristle = law.states_per_point() > 0;
        // A bristle that takes part in the whole motion does not slide: T = 1e3 · 0.01 N is below the limit.
        assert!((speeds[0] - if bristle { 0.0 } else { 0.01 }).abs() < 1e-15);
        if bristle {
            // T = 40 + 10 N: slips, e˙ = (29.43 - 40)/C. (The face's second tangent is -x.)
            x[5] = -40e-6;
            system.creep_speeds(0.0, &x, &mut speeds);
            assert!((speeds[0] - (0.01 + (40.0 - LIMIT) / 1e3)).abs() < 1e-12);
        }
        x[1] = 1e-6;
        system.creep_speeds(0.0, &x, &mut speeds);
        assert_eq!(speeds[0], 0.0);
    }
}

// Equilibrium

#[test]
fn equilibrium_on_springs() {
    // A body on a face of four points, its center of gravity not in their middle.
    let one = body(
        "b",
        20.0,
        [0.3, 0.5, 0.7],
        [0.05, -0.02, 0.1],
        ALL,
        [0.0, 0.0, 0.01, 0.0, 0.0, 0.0],
    );
    let mut model = model(vec![one, ground()], [0.0, 0.0, -9.81]);
    let corners = [
        [0.2, 0.1, 0.0],
        [0.2, -0.1, 0.0],
        [-0.2, 0.1, 0.0],
        [-0.2, -0.1, 0.0],
    ];
    let stiffness = 1e6;
    let law = FrictionLaw::Tanh {
        reference_speed: 1e-3,
    };
    model.faces.push((
        0,
        1,
        Marker::new([0.0; 3], UP),
        face("floor", &corners, stiffness, 0.0, 0.4, law),
    ));
    let mut system = System::new(model).unwrap();
    let mut x = system.initial_state();
    x[2] = -1e-5;
    let rest = system.equilibrium(0.0, &x, StaticFriction::Without).unwrap();
    let weight = 20.0 * 9.81;
    let observation = system.observe(0.0, &rest);
    let normals: Vec<f64> = observation.faces[0]
        .points
        .iter()
        .map(|point| point.normal)
        .collect();
    // Share of each corner of a rigid rectangle on equal springs: W/4 (1 + x_c x_i/a² + y_c y_i/b²).
    for (normal, corner) in normals.iter().zip(corners) {
        let expected = 0.25 * weight * (1.0 + 0.05 * corner[0] / 0.04 - 0.02 * corner[1] / 0.01);
        // The tilt (about 1e-4) moves the center of gravity by its height times the tilt.
        assert!(
            (normal - expected).abs() < 5e-4 * weight,
            "{normal} instead of {expected}"
        );
    }
    assert!((normals.iter().sum::<f64>() - weight).abs() < 1e-6 * weight);
    let dx = rates(&mut system, 0.0, &rest);
    assert!(dx[6..12].iter().all(|a| a.abs() < 1e-7));
}

#[test]
fn no_equilibrium_in_free_fall() {
    let mut system = System::new(model(
        vec![body("stone", 1.0, [1.0; 3], [0.0; 3], ALL, [0.0; 6])],
        [0.0, 0.0, -9.81],
    ))
    .unwrap();
    let x = system.initial_state();
    let error = system.equilibrium(0.0, &x, StaticFriction::Without).unwrap_err();
    assert_eq!((error.body.as_str(), error.coordinate), ("stone", "z"));
    assert!((error.acceleration + 9.81).abs() < 1e-12);
}

// Momentum

/// Returns two bodies that float, without gravity, with faces, friction, contact damping and coils between
/// them.
fn floating(law: FrictionLaw, damping: f64) -> Model {
    let a = body("a", 2.0, [0.03, 0.05, 0.07], [-0.02, 0.01, 0.03], ALL, [0.0; 6]);
    let mut b = body("b", 3.0, [0.04, 0.03, 0.06], [0.03, 0.02, -0.01], ALL, [0.0; 6]);
    b.frame = Frame::fixed([0.4, -0.3, 0.2], [0.3, 0.7, -0.5]);
    b.initial = [-0.4, 0.2, -0.3, 0.1, 0.05, -0.1];
    let mut model = model(vec![a, b], [0.0; 3]);
    let corners = [
        [0.1, 0.1, -0.1],
        [0.1, -0.1, -0.1],
        [-0.1, 0.1, -0.1],
        [-0.1, -0.1, -0.1],
    ];
    // Which pair meets where is a matter of the marker: the plane is placed so that three corners are closed
    // at the start.
    for (body, on, marker) in [
        (0, 1, Marker::new([0.0, 0.05, -0.2], UP)),
        (1, 0, Marker::new([0.05, 0.0, -0.3], UP)),
    ] {
        let one = face("face", &corners, 2e4, damping, 0.4, law);
        model.faces.push((body, on, marker, one));
    }
    let mut through_end = coil([0.05, 0.0, 0.1], [0.05, 0.0, 0.1], 800.0, 0.4);
    (through_end.damping, through_end.rotational_damping) = (3.0, 0.05);
    let mut through_center = coil([0.0, 0.05, -0.1], [-0.02, 0.01, 0.03], 600.0, 0.5);
    through_center.damping = 2.0;
    model
        .coils
        .push((0, 1, Marker::new([0.1, -0.1, 0.2], [0.3, 0.2, 0.1]), through_end));
    model.coils.push((
        0,
        1,
        Marker::new([-0.1, 0.1, -0.1], [0.1, -0.2, 0.1]),
        through_center,
    ));
    model
}

const LAWS: [FrictionLaw; 2] = [
    FrictionLaw::Tanh {
        reference_speed: 0.01,
    },
    FrictionLaw::Bristle {
        stiffness: 1e4,
        damping: 20.0,
    },
];

/// The forces of elements leave momentum and angular momentum unchanged: at random states, to rounding.
#[test]
fn action_and_reaction_at_random_states() {
    let mut random = Random(1);
    let mut contacts = 0;
    for law in LAWS {
        let mut system = System::new(floating(law, 20.0)).unwrap();
        let start = system.initial_state();
        let layout = system.layout();
        for _ in 0..40 {
            let mut x = start.clone();
            for i in 0..layout.speeds {
                x[i] += random.between(-0.15, 0.15);
                x[layout.speeds + i] = random.between(-2.0, 2.0);
            }
            for value in &mut x[2 * layout.speeds..2 * layout.speeds + layout.internals] {
                *value = random.between(-1e-3, 1e-3);
            }
            let observation = system.observe(0.0, &x);
            contacts += observation
                .faces
                .iter()
                .flat_map(|f| &f.points)
                .filter(|p| p.normal > 0.0)
                .count();
            let dx = rates(&mut system, 0.0, &x);
            let change = difference(1e-3 / norm(&dx).max(1.0), |h| {
                let y: Vec<f64> = x.iter().zip(&dx).map(|(x, d)| x + h * d).collect();
                momenta(&mut system, 0.0, &y)
            });
            let size = norm(&dx);
            assert!(size > 100.0);
            for value in change {
                assert!(value.abs() < 1e-9 * size, "{value} of {size}");
            }
            // The wrenches as observed: what carries the points, and the reaction on the other body, about
            // any point.
            let about: [f64; 3] = random.vector(1.0);
            for (mounted, state) in system.faces().iter().zip(&observation.faces) {
                let from = observation.bodies[mounted.body].origin.0;
                let (mut force, mut moment, mut own) = ([0.0; 3], [0.0; 3], [0.0; 3]);
                for (i, place) in state.point_positions.iter().enumerate() {
                    let f = add(state.normal_forces[i].0, state.friction_forces[i].0);
                    force = add(force, f);
                    moment = add(moment, cross(add(place.0, about.map(|v| -v)), f));
                    own = add(own, cross(add(place.0, from.map(|v| -v)), f));
                }
                let (reaction, reaction_moment) =
                    System::reaction_about(Vector(force), Vector(own), Vector(from), Vector(about));
                let size = 1.0 + norm(&force);
                for k in 0..3 {
                    assert!((reaction.0[k] + force[k]).abs() < 1e-12 * size);
                    assert!((reaction_moment.0[k] + moment[k]).abs() < 1e-12 * size);
                }
            }
        }
    }
    assert!(contacts > 50, "{contacts} contacts");
}

#[test]
fn floating_bodies_keep_their_momentum() {
    for (law, damping) in [(LAWS[0], 0.0), (LAWS[1], 0.0), (LAWS[0], 20.0), (LAWS[1], 20.0)] {
        let system = System::new(floating(law, damping)).unwrap();
        let mut x = system.initial_state();
        for (i, value) in Random(2).vector::<12>(1.0).into_iter().enumerate() {
            x[12 + i] = value;
        }
        let mut twin = system.clone();
        let before = momenta(&mut twin, 0.0, &x);
        let start = crate::common::Ledger::at(&mut twin, 0.0, &x);
        let mut contacts = 0;
        let end = integrate(system, options(Method::Rodas5P, 1e-9), &x, 1.0, |integrator| {
            contacts += integrator
                .discrete_states()
                .iter()
                .filter(|contact_state| **contact_state != ContactState::Open as u8)
                .count();
        });
        let after = momenta(&mut twin, 1.0, end.x());
        let size = norm(&before);
        for k in 0..6 {
            let change = (after[k] - before[k]).abs();
            assert!(change < 1e-7 * size, "{change} of {size}");
        }
        let ledger = crate::common::Ledger::at(&mut twin, 1.0, end.x());
        for kind in [EnergyTermKind::FrictionLoss, EnergyTermKind::CoilDampingLoss] {
            let lost: f64 = ledger
                .losses
                .iter()
                .filter(|(k, _)| *k == kind)
                .map(|(_, v)| v)
                .sum();
            assert!(lost > 1e-3 * start.stored, "{kind:?} must take part: {lost}");
        }
        assert!(contacts > 10);
        // The ledger with contact damping is a matter of its own, see the tests of the energy.
        if damping == 0.0 {
            let residual = ledger.residual(&start, |_| true);
            assert!(
                residual.abs() < 1e-7 * start.stored,
                "{residual} of {}",
                start.stored
            );
        }
    }
}

// The same bits

/// Returns a body with bristles on a base whose motions have breaks.
fn shaken() -> System {
    let mut frame = Frame::fixed([0.0; 3], [0.0; 3]);
    frame.motions[0] = Motion::Triangle {
        amplitude: 0.02,
        angular_frequency: 9.0,
    };
    frame.motions[5] = Motion::Ramp {
        amplitude: 0.1,
        start: 0.3,
        duration: 0.4,
        profile: RampProfile::Linear,
    };
    let base = Body::prescribed("base", frame);
    let one = body(
        "b",
        5.0,
        [0.03, 0.05, 0.07],
        [0.0, 0.0, 0.1],
        ALL,
        [0.0, 0.0, 0.001, 0.0, 0.0, 0.0],
    );
    let mut model = model(vec![one, base], [0.0, 0.0, -9.81]);
    let corners = [
        [0.1, 0.1, 0.0],
        [0.1, -0.1, 0.0],
        [-0.1, 0.1, 0.0],
        [-0.1, -0.1, 0.0],
    ];
    let law = FrictionLaw::Bristle {
        stiffness: 1e6,
        damping: 1e3,
    };
    model.faces.push((
        0,
        1,
        Marker::new([0.0; 3], UP),
        face("floor", &corners, 1e5, 100.0, 0.3, law),
    ));
    System::new(model).unwrap()
}

/// Times, states, events and statistics of all steps up to `end`, in which outputs are `limits`.
fn record(integrator: &mut Integrator<System>, limits: &[f64]) -> (Vec<u64>, State) {
    let mut bits = Vec::new();
    for limit in limits {
        while integrator.time() < *limit {
            integrator.step_to(*limit).unwrap();
            bits.push(integrator.time().to_bits());
            bits.extend(integrator.x().iter().map(|x| x.to_bits()));
            for event in integrator.events() {
                bits.extend([event.time.to_bits(), event.index as u64, u64::from(event.to)]);
            }
        }
    }
    (bits, integrator.state())
}

#[test]
fn the_same_bits_again_and_after_saving() {
    for method in Method::ALL {
        let options: Options = options(method, 1e-6);
        let start = || {
            let system = shaken();
            let x = system.initial_state();
            Integrator::new(system, options.clone(), 0.0, &x).unwrap()
        };
        let corner = 0.5 * std::f64::consts::PI / 9.0;
        // Inside a piece, exactly on a corner of the triangle and on the ramp's start, and after all breaks.
        let limits = [0.05, corner, 0.3, 0.5, 1.2];
        let (mut one, mut two) = (start(), start());
        let whole = record(&mut one, &limits);
        assert_eq!(whole, record(&mut two, &limits));
        assert!(whole.1.statistics.restarts >= 4 && whole.1.statistics.events > 4);
        for cut in 1..limits.len() {
            let mut first = start();
            let (mut bits, state) = record(&mut first, &limits[..cut]);
            let text = serde_json::to_string(&state).unwrap();
            let back: State = serde_json::from_str(&text).unwrap();
            assert_eq!(back, state);
            let mut second = Integrator::resume(shaken(), options.clone(), back).unwrap();
            let (rest, end) = record(&mut second, &limits[cut..]);
            bits.extend(rest);
            assert_eq!(bits, whole.0, "saved at {}", limits[cut - 1]);
            // But for the evaluation of the right-hand side at the new beginning, all counts are the same.
            assert_eq!(end.x, whole.1.x);
            assert_eq!(end.discrete_states, whole.1.discrete_states);
            assert_eq!(end.statistics.steps, whole.1.statistics.steps);
        }
    }
}

/// Functions of a problem are pure: what was evaluated before leaves no trace.
#[test]
fn evaluation_leaves_no_trace() {
    let mut system = shaken();
    system.next_time_discontinuity(0.2);
    let mut x = system.initial_state();
    x[2] = -1e-4;
    x[7] = 0.1;
    let fresh = rates(&mut system.clone(), 0.31, &x);
    let mut other = x.clone();
    other.iter_mut().for_each(|value| *value += 0.01);
    let mut df_dt = vec![0.0; x.len()];
    let dx = rates(&mut system, 0.37, &other);
    system.linearize(0.37, &other, &dx, &mut df_dt);
    let _ = system.observe(0.9, &other);
    let mut contact_states = vec![0; system.structure().discrete_states()];
    system.initial_discrete_states(0.1, &other, &mut contact_states);
    assert_eq!(rates(&mut system, 0.31, &x), fresh);
}
