//! Evaluations of parts of a system, and of parts of the outputs, agree with those of the whole.

use crate::common::{ALL, Random, UP, body, coil, face, ground, model};
use crate::margins::margins;
use integrate::Problem;
use mechanics::body::Body;
use mechanics::frame::Frame;
use mechanics::friction::FrictionLaw;
use mechanics::link::Marker;
use mechanics::motion::Motion;
use mechanics::system::{Model, System, SystemLoads};
use mechanics::vector::Vector;

const TANH: FrictionLaw = FrictionLaw::Tanh {
    reference_speed: 0.01,
};
const BRISTLE: FrictionLaw = FrictionLaw::Bristle {
    stiffness: 1e4,
    damping: 20.0,
};

const CORNERS: [[f64; 3]; 5] = [
    [0.1, 0.1, 0.0],
    [0.1, -0.1, 0.0],
    [-0.1, 0.1, 0.0],
    [-0.1, -0.1, 0.0],
    [0.0, 0.0, 0.0],
];

/// Returns two free bodies one upon the other on a base that moves, and turns if it is to.
fn tower(turns: bool, law: FrictionLaw) -> Model {
    let sine = |amplitude, angular_frequency| Motion::Sine {
        amplitude,
        angular_frequency,
        phase: 0.4,
    };
    let mut frame = Frame::fixed([0.1, 0.0, -0.1], [0.2, -0.1, 0.3]);
    frame.motions[0] = sine(0.01, 11.0);
    frame.motions[2] = sine(0.002, 7.0);
    if turns {
        frame.motions[4] = sine(0.01, 5.0);
    }
    let lower = body("lower", 5.0, [0.03, 0.05, 0.07], [0.01, 0.0, 0.1], ALL, [0.0; 6]);
    let upper = body(
        "upper",
        2.0,
        [0.03, 0.04, 0.02],
        [0.0, -0.02, 0.1],
        ALL,
        [0.0, 0.0, 0.2, 0.0, 0.0, 0.0],
    );
    let mut model = model(
        vec![lower, upper, Body::prescribed("base", frame)],
        [0.0, 0.0, -9.81],
    );
    for (carried, on, height, damping) in [(0, 2, 0.1, 100.0), (1, 0, 0.2, 0.0), (1, 2, 0.15, 0.0)] {
        let one = face("face", &CORNERS, 1e5, damping, 0.3, law);
        model
            .faces
            .push((carried, on, Marker::new([0.0, 0.0, height], UP), one));
        let mut spring = coil([0.0, 0.05, 0.1], [0.0, 0.05, 0.1], 600.0, 0.5);
        (spring.damping, spring.rotational_damping) = (3.0, 0.05);
        model.coils.push((
            carried,
            on,
            Marker::new([0.0, 0.1, -0.4], [0.2, 0.1, -0.1]),
            spring,
        ));
    }
    model
}

/// Returns a body on a base that moves without turning: all that is known of such an element is used.
fn plain(law: FrictionLaw) -> Model {
    let mut model = tower(false, law);
    model.bodies[1].free = [false; 6];
    model.bodies[0].frame.orientation = [0.1, 0.2, -0.1];
    model.faces.retain(|(carried, on, ..)| (*carried, *on) == (0, 2));
    model.coils.retain(|(carried, on, ..)| (*carried, *on) == (0, 2));
    model
}

fn models() -> Vec<System> {
    [TANH, BRISTLE]
        .into_iter()
        .flat_map(|law| [tower(false, law), tower(true, law), plain(law)])
        .map(|model| System::new(model).unwrap())
        .collect()
}

/// Returns a state near the start: some points closed, some open.
fn state(system: &System, random: &mut Random) -> Vec<f64> {
    let mut x = system.initial_state();
    let layout = system.layout();
    for i in 0..layout.speeds {
        x[i] += random.between(-0.05, 0.05);
        x[layout.speeds + i] = random.between(-0.05, 0.05);
    }
    for value in &mut x[2 * layout.speeds..2 * layout.speeds + layout.internals] {
        *value = random.between(-1e-3, 1e-3);
    }
    x
}

#[test]
fn limits_signs_of_a_face_depend_on_the_states_of_its_group_alone() {
    let mut random = Random(5);
    let mut closed = [0, 0];
    for mut system in models() {
        let groups = system.structure().event_groups;
        let count = system.structure().discrete_states();
        assert!(
            groups
                .iter()
                .flat_map(|group| group.discrete_states.clone())
                .eq(0..count)
        );
        for _ in 0..60 {
            let (x, time) = (state(&system, &mut random), random.between(0.0, 1.0));
            let mut expected = vec![0.0; system.structure().event_variables()];
            system.clone().event_variables(None, time, &x, &mut expected);
            for (number, group) in groups.iter().enumerate() {
                // What it does not depend on is not even a number.
                let mut own = vec![f64::NAN; x.len()];
                for part in &group.states {
                    own[part.clone()].copy_from_slice(&x[part.clone()]);
                }
                let mut found = vec![7.0; group.variables.len()];
                system.event_variables(Some(number), time, &own, &mut found);
                let expected = &expected[group.variables.clone()];
                for (found, expected) in found.iter().zip(expected) {
                    assert_eq!(found.to_bits(), expected.to_bits(), "group {number}");
                }
            }
            // What follows does not see what was asked before, not even at another time and place.
            let mut again = vec![0.0; system.structure().event_variables()];
            for _ in 0..2 {
                system.event_variables(None, time, &x, &mut again);
                assert!(
                    again
                        .iter()
                        .zip(&expected)
                        .all(|(a, b)| a.to_bits() == b.to_bits())
                );
                let elsewhere = state(&system, &mut random);
                let own = groups[0].variables.clone();
                system.event_variables(Some(0), time + 0.1, &elsewhere, &mut again[own]);
            }
            for gap in margins(&mut system, time, &x, &vec![0; count]).0 {
                closed[usize::from(gap < 0.0)] += 1;
            }
        }
    }
    assert!(
        closed.iter().all(|count| *count > 300),
        "{closed:?} points open and closed"
    );
}

#[test]
fn limits_loads_are_the_sums_over_the_points() {
    let mut random = Random(6);
    let mut loads = SystemLoads::default();
    let mut pressed = 0;
    for mut system in models() {
        for _ in 0..60 {
            let (x, time) = (state(&system, &mut random), random.between(0.0, 1.0));
            let observation = system.clone().observe(time, &x);
            assert_eq!(system.clone().energies(time, &x), observation.energies);
            system.loads(time, &x, &mut loads);
            assert_eq!(system.energies(time, &x), observation.energies);
            assert_eq!(
                (loads.faces.len(), loads.coils.len()),
                (observation.faces.len(), observation.coils.len())
            );
            let close = |a: Vector<f64>, b: Vector<f64>, size: f64| {
                let apart = (a - b).0.iter().fold(0.0_f64, |most, part| most.max(part.abs()));
                assert!(apart <= 1e-11 * size, "{a:?} instead of {b:?}");
            };
            for (number, face) in loads.faces.iter().enumerate() {
                let body = &observation.bodies[system.faces()[number].body];
                let expected = observation.faces[number].load(body.center_of_gravity);
                let size = 1.0 + expected.normal.dot::<f64, f64>(expected.normal).sqrt();
                close(face.normal, expected.normal, size);
                close(face.friction, expected.friction, size);
                close(face.moment, expected.moment, size);
                close(face.origin, expected.origin, 1.0);
                pressed += u32::from(size > 2.0);
            }
            for (coil, observation) in loads.coils.iter().zip(&observation.coils) {
                let (expected, size) = (observation.load(), 1e3);
                close(coil.spring, expected.spring, size);
                close(coil.force, expected.force, size);
                close(coil.moment, expected.moment, size);
            }
            for (body, observation) in loads.bodies.iter().zip(&observation.bodies) {
                close(body.travel, observation.travel, 1.0);
                close(body.velocity, observation.velocity, 1.0);
            }
        }
    }
    assert!(pressed > 300, "{pressed} faces under load");
}

#[test]
fn input_what_presses_on_a_contact_is_held_to_a_bound() {
    let bounds = |free: [bool; 6], orientation: [f64; 3], law: FrictionLaw| {
        let mut one = body("one", 1.0, [1.0; 3], [0.0; 3], free, [0.0; 6]);
        one.frame = Frame::fixed([0.0; 3], orientation);
        let mut model = model(vec![one, ground()], [0.0; 3]);
        let floor = face("floor", &CORNERS, 1e5, 0.0, 0.3, law);
        model.faces.push((0, 1, Marker::new([0.0; 3], UP), floor));
        let system = System::new(model).unwrap();
        let structure = system.structure();
        let are_held = |bounds: &[f64]| {
            bounds
                .iter()
                .map(|bound| bound.is_finite())
                .collect::<Vec<bool>>()
        };
        (
            are_held(&structure.error_bounds),
            are_held(&structure.zone_error_bounds),
        )
    };
    let (along, up) = (
        [true, false, false, false, false, false],
        [true, false, true, false, false, false],
    );
    let rotating = [true, false, false, false, true, false];
    // Along the floor alone: positions are not held, speeds to the reference speed of tanh.
    assert_eq!(bounds(along, [0.0; 3], TANH), (vec![false; 2], vec![false, true]));
    assert_eq!(bounds(along, [0.0; 3], BRISTLE).0, [false; 2]);
    // Up and down as well: the height is; with bristles its speed, too.
    assert_eq!(bounds(up, [0.0; 3], TANH).0, [false, true, false, false]);
    assert_eq!(bounds(up, [0.0; 3], BRISTLE).0, [false, true, false, true]);
    // Where the body's axes stand across, or turn, all are.
    assert_eq!(bounds(up, [0.0, 0.3, 0.0], TANH).0, [true, true, false, false]);
    assert_eq!(bounds(rotating, [0.0; 3], TANH).0, [true, true, false, false]);
    assert_eq!(bounds(rotating, [0.0; 3], BRISTLE).0, [true; 4]);
}

#[test]
fn limits_a_mode_is_left_where_its_margin_is_used_up() {
    let mut random = Random(11);
    let mut left = [[0; 2]; 3];
    for mut system in models() {
        let count = system.structure().discrete_states();
        for _ in 0..200 {
            let (x, time) = (state(&system, &mut random), random.between(0.0, 1.0));
            // All in one contact state, and mixed.
            let one = random.between(0.0, 3.0) as u8;
            let mixed = random.between(0.0, 1.0) < 0.5;
            let contact_states: Vec<u8> = (0..count)
                .map(|_| {
                    if mixed {
                        random.between(0.0, 3.0) as u8
                    } else {
                        one
                    }
                })
                .collect();
            let (margins, next) = margins(&mut system, time, &x, &contact_states);
            for (i, (&margin, &contact_state)) in margins.iter().zip(&contact_states).enumerate() {
                // An open point is not asked before its margin is used up.
                if contact_state == 0 && margin > 0.0 {
                    left[0][0] += 1;
                    continue;
                }
                let leaves = next[i] != contact_state;
                assert_eq!(
                    margin <= 0.0,
                    leaves,
                    "switch {i}: {margin} in mode {contact_state}"
                );
                left[usize::from(contact_state)][usize::from(leaves)] += 1;
            }
        }
    }
    assert!(left.iter().flatten().all(|count| *count > 100), "{left:?}");
}

#[test]
fn limits_a_face_is_placed_anew_when_a_motion_changes() {
    let mut random = Random(3);
    let system = System::new(tower(true, TANH)).unwrap();
    let (x, time) = (state(&system, &mut random), 0.3);
    let (group, own) = (2, system.structure().event_groups[2].variables.clone()); // upper body on the base
    let variables = |system: &mut System| {
        let mut variables = vec![0.0; own.len()];
        system.event_variables(Some(group), time, &x, &mut variables);
        variables
    };
    let mut motions = system.bodies()[2].frame.motions.clone();
    motions[0] = Motion::Constant(0.3);
    motions[4] = Motion::Sine {
        amplitude: 0.05,
        angular_frequency: 20.0,
        phase: 0.0,
    };
    let mut asked_before = system.clone();
    let before = variables(&mut asked_before);
    assert_eq!(variables(&mut asked_before), before);
    asked_before.set_motions(2, motions.clone()).unwrap();
    let mut fresh = system.clone();
    fresh.set_motions(2, motions).unwrap();
    let expected = variables(&mut fresh);
    assert_ne!(before, expected);
    assert_eq!(variables(&mut asked_before), expected);
    // Nor does it keep what it saw when all else has moved on.
    let mut signs_elsewhere = vec![0.0; system.structure().event_variables()];
    let elsewhere = state(&system, &mut random);
    asked_before.event_variables(None, time, &elsewhere, &mut signs_elsewhere);
    assert_eq!(variables(&mut asked_before), expected);
}
