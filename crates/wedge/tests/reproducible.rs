//! A wedge's rates have the same bits, whoever is computed beside it.
#![allow(clippy::unwrap_used, clippy::expect_used)]

mod common;

use common::{INCH, LBF_PER_IN, Random, TOE, YAW, bristle, free, with_law};
use integrate::lanes::Runs;
use integrate::{Call, KinkSigns, Problem, Together};
use mechanics::characteristic::Characteristic;
use mechanics::coil::{CoilLaw, CoilLine};
use mechanics::motion::Motion;
use mechanics::system::{Abreast, System};
use wedge::parameters::{Damping, Parameters};
use wedge::{Wedge, thesis};

const PLACES: usize = Runs::COUNT;

/// The same wedge with other numbers in all that may differ from run to run.
fn varied(base: &Parameters, numbers: &mut Random) -> Parameters {
    let mut own = base.clone();
    let mut vary = |value: &mut f64| *value *= numbers.between(0.9, 1.1);
    for value in [
        &mut own.wedge.angle,
        &mut own.wedge.height,
        &mut own.wedge.width,
        &mut own.wedge.mass,
        &mut own.wedge.center_of_gravity[0],
        &mut own.coil.free_length,
        &mut own.coil.damping,
        &mut own.coil.rotational_damping,
        &mut own.contact.stiffness,
        &mut own.contact.damping,
        &mut own.column_friction.coefficient,
        &mut own.slope_friction.coefficient,
        &mut own.toe,
    ] {
        vary(value);
    }
    own.wedge.inertia.iter_mut().for_each(&mut vary);
    if let CoilLaw::Linear { stiffness } = &mut own.coil.law {
        vary(stiffness);
    }
    for neighbour in [&mut own.side_frame, &mut own.bolster] {
        for motion in &mut neighbour.coordinates {
            match motion {
                Motion::Sine {
                    amplitude,
                    angular_frequency,
                    ..
                } => {
                    vary(amplitude);
                    vary(angular_frequency);
                }
                Motion::Constant(value) => vary(value),
                _ => {}
            }
        }
    }
    own
}

fn system(parameters: &Parameters) -> System {
    let mut system = Wedge::new(parameters.clone()).unwrap().system;
    system.segment(0.0);
    system
}

/// Compares at random states, also such as a rejected step tries; gives how often a rate of speed was compared that contacts act on.
fn compare(base: &Parameters, numbers: &mut Random) -> usize {
    let mut alone: Vec<System> = (0..PLACES).map(|_| system(&varied(base, numbers))).collect();
    let mut beside = alone.clone();
    let mut abreast = Abreast::of(&alone[0]).expect("such wedges can sit side by side");
    for (place, system) in alone.iter().enumerate() {
        assert!(abreast.admits(system));
        abreast.put(place, system);
    }
    let speeds = alone[0].layout().speeds;
    let dimension = alone[0].dimension();
    let mut touched = 0;
    for round in 0..300 {
        // One in ten is far out; places may be empty.
        let wide = if round % 10 == 9 { 1e4 } else { 1.0 };
        let mut states = Vec::new();
        for system in &alone {
            let mut x = system.initial_state();
            for (i, value) in x.iter_mut().enumerate() {
                let size = if i < speeds { 3e-4 } else { 0.05 };
                *value += wide * numbers.between(-size, size) * numbers.unit();
            }
            states.push((numbers.between(0.0, 3.0), x, numbers.unit() < 0.9));
        }
        let mut found = vec![vec![f64::NAN; dimension]; PLACES];
        let places = beside.iter_mut().zip(&mut found).zip(&states);
        let mut calls: Vec<Option<Call<'_, System>>> = places
            .map(|((problem, dx), (time, x, there))| {
                let time = *time;
                there.then_some(Call { problem, time, x, dx })
            })
            .collect();
        abreast.derivatives(&mut calls);
        drop(calls);
        let both = alone.iter_mut().zip(&mut beside);
        for (((system, beside), found), (time, x, there)) in both.zip(&found).zip(&states) {
            if !there {
                assert!(found.iter().all(|value| value.is_nan()));
                continue;
            }
            let mut expected = vec![0.0; dimension];
            system.derivative(*time, x, &mut expected);
            for (i, (found, expected)) in found.iter().zip(&expected).enumerate() {
                // Equal as numbers: zero may have another sign.
                assert!(
                    equal(*found, *expected),
                    "rate {i} at {time} s, {x:?}: {found:e} instead of {expected:e}"
                );
                touched += usize::from(i >= speeds && i < 2 * speeds && expected.abs() > 100.0);
            }
            // Gaps and slips: told there, seen elsewhere.
            let mut elsewhere = x.clone();
            elsewhere[round % speeds] += 1e-6;
            for (time, x) in [(*time, x), (*time, &elsewhere), (time + 1e-3, x), (*time, x)] {
                let (seen, told) = (kinks(system, time, x), kinks(beside, time, x));
                assert!(
                    same(&seen, &told),
                    "kinks at {time} s, {x:?}: {told:?} instead of {seen:?}"
                );
            }
        }
    }
    touched
}

#[test]
fn rates_have_the_bits_of_a_wedge_alone() {
    let mut numbers = Random(7);
    for damping in [Damping::Variable, Damping::Constant] {
        let thesis = thesis::parameters(damping, TOE, YAW);
        let mut all_free = thesis.clone();
        all_free.wedge.free = [true; 6];
        all_free.contact.damping = 50.0 * LBF_PER_IN;
        all_free.coil.pulls = false;
        all_free.side_frame.coordinates[0] = Motion::Sine {
            amplitude: 0.1 * INCH,
            angular_frequency: 5.0,
            phase: 0.3,
        };
        all_free.bolster.coordinates[1] = Motion::Constant(0.02 * INCH);
        let mut planar = thesis.clone();
        planar.wedge.free = free(&["x", "z"]);
        planar.coil.acts_at = CoilLine::Seat;
        let mut central = thesis.clone();
        central.wedge.center_of_gravity = [0.0; 3];
        for parameters in [thesis, all_free, planar, central] {
            let touched = compare(&parameters, &mut numbers);
            assert!(touched > 300, "contacts act in {touched} rates only");
        }
    }
}

/// The rates of a system at several times and states at once are those that it finds one after the other, however many they are; also after its
/// parameters have been changed, and where it cannot sit beside itself.
#[test]
fn rates_at_several_places_have_the_bits_of_one_after_the_other() {
    let mut numbers = Random(11);
    let thesis = thesis::parameters(Damping::Variable, TOE, YAW);
    let mut turned = thesis.clone();
    turned.bolster.coordinates[4] = Motion::line(0.0, [0.0, 1e-3]);
    for parameters in [thesis.clone(), with_law(thesis, bristle()), turned] {
        let mut together = system(&parameters);
        let (n, stride) = (together.dimension(), together.dimension() + 3);
        for round in 0..60 {
            let count = 1 + round % 9;
            match round {
                20 => together.set_friction(0, 0.2).unwrap(),
                30 => {
                    let stiffness = 1e5;
                    together.set_coil_law(0, CoilLaw::Linear { stiffness }).unwrap();
                }
                40 => {
                    let table = Characteristic::new(vec![[0.0, 0.0], [0.1, 1e4]]).unwrap();
                    together.set_coil_law(0, CoilLaw::Table(table)).unwrap();
                }
                _ => {}
            }
            let mut alone = together.clone();
            let times: Vec<f64> = (0..count).map(|_| numbers.between(0.0, 3.0)).collect();
            let mut x = vec![f64::NAN; count * stride];
            for row in x.chunks_mut(stride) {
                for (value, start) in row.iter_mut().zip(together.initial_state()) {
                    *value = start + numbers.between(-3e-4, 3e-4);
                }
            }
            let mut found = vec![f64::INFINITY; count * stride];
            together.derivatives(&times, stride, &x, &mut found);
            let mut expected = vec![f64::INFINITY; count * stride];
            for (k, time) in times.iter().enumerate() {
                let own = k * stride..k * stride + n;
                alone.derivative(*time, &x[own.clone()], &mut expected[own]);
            }
            // What lies between the rows is left alone.
            assert!(same(&found, &expected), "{count} places, round {round}");
            assert!(expected.iter().any(|rate| rate.is_finite() && rate.abs() > 100.0));
        }
    }
}

#[test]
fn only_wedges_of_one_shape_sit_side_by_side() {
    let base = thesis::parameters(Damping::Variable, TOE, YAW);
    let abreast = Abreast::of(&system(&base)).unwrap();
    let other = |change: &dyn Fn(&mut Parameters)| {
        let mut own = base.clone();
        change(&mut own);
        system(&own)
    };
    assert!(abreast.admits(&other(&|own| own.toe = -TOE)));
    assert!(abreast.admits(&other(&|own| own.wedge.angle = 0.6)));
    // Another shape: they may sit beside their like.
    for another in [
        other(&|own| own.damping = Damping::Constant),
        other(&|own| own.wedge.free[3] = true),
        other(&|own| own.contact.damping = 1.0),
        other(&|own| own.coil.pulls = false),
        other(&|own| own.wedge.center_of_gravity = [0.0; 3]),
        other(&|own| own.gravity *= 0.5),
        other(&|own| own.bolster.coordinates[0] = Motion::line(0.0, [0.0, 1e-3])),
    ] {
        assert!(!abreast.admits(&another) && Abreast::of(&another).is_some());
    }
    // Alone: bristles, a neighbour that turns, a coil by a table.
    let table = Characteristic::new(vec![[0.0, 0.0], [0.1, 1e4]]).unwrap();
    for alone in [
        system(&with_law(base.clone(), bristle())),
        other(&|own| own.bolster.coordinates[4] = Motion::line(0.0, [0.0, 1e-3])),
        other(&|own| own.coil.law = CoilLaw::Table(table.clone())),
    ] {
        assert!(!abreast.admits(&alone) && Abreast::of(&alone).is_none());
    }
}

fn kinks(system: &mut System, time: f64, x: &[f64]) -> Vec<f64> {
    let (values, directions) = system.kink_counts();
    let mut signs = KinkSigns {
        values: vec![0.0; values],
        directions: vec![[0.0; 2]; directions],
    };
    system.kinks(time, x, &mut signs);
    [&signs.values[..], signs.directions.as_flattened()].concat()
}

/// As numbers: zero may have another sign, and what is not a number is as good as another.
fn equal(a: f64, b: f64) -> bool {
    a == b || a.is_nan() && b.is_nan()
}

fn same(a: &[f64], b: &[f64]) -> bool {
    a.len() == b.len() && a.iter().zip(b).all(|(a, b)| equal(*a, *b))
}

/// Margins of all switches, and the modes that follow, by the signs of all at once.
fn margins(system: &mut System, time: f64, x: &[f64], modes: &[u8]) -> (Vec<f64>, Vec<u8>) {
    let mut signs = vec![f64::NAN; system.sign_count()];
    system.signs(time, x, &mut signs);
    let (mut margins, mut next) = (vec![f64::NAN; modes.len()], modes.to_vec());
    for (number, group) in system.switch_groups().into_iter().enumerate() {
        let (own, signs) = (group.switches, &signs[group.signs]);
        system.group_margins(number, signs, &modes[own.clone()], &mut margins[own.clone()]);
        for (index, next) in next[own].iter_mut().enumerate() {
            *next = system.next_mode(number, signs, index, *next);
        }
    }
    (margins, next)
}

/// The signs of all groups, one after the other.
fn face_signs(system: &mut System, time: f64, x: &[f64]) -> Vec<f64> {
    let mut signs = vec![f64::NAN; system.sign_count()];
    for (number, group) in system.switch_groups().into_iter().enumerate() {
        system.group_signs(number, time, x, &mut signs[group.signs]);
    }
    signs
}

/// All that an integrator may ask for at a place, one question after the other.
fn ask(system: &mut System, question: usize, time: f64, x: &[f64], modes: &[u8]) -> Vec<f64> {
    let n = x.len();
    let mut dx = vec![0.0; n];
    match question {
        0 => {
            system.derivative(time, x, &mut dx);
            dx
        }
        1 => kinks(system, time, x),
        2 => margins(system, time, x, modes).0,
        3 => face_signs(system, time, x),
        4 => vec![system.stiffness(time, x)],
        _ => {
            system.derivative(time, x, &mut dx);
            let mut df_dt = vec![0.0; n];
            system.linearize(time, x, &dx, &mut df_dt);
            let mut solved: Vec<f64> = (0..n).map(|i| 1.0 + i as f64).collect();
            if system.factor(1e4).is_ok() {
                system.solve(&mut solved);
            }
            solved.extend(df_dt);
            solved
        }
    }
}

#[test]
fn what_was_asked_before_changes_nothing() {
    // Open faces are passed over where they were open before: all answers are those of a system that was never asked.
    let mut numbers = Random(11);
    let mut open = 0;
    for (damping, law) in [
        (Damping::Variable, None),
        (Damping::Constant, None),
        (Damping::Variable, Some(bristle())),
    ] {
        let mut parameters = thesis::parameters(damping, TOE, YAW);
        if let Some(law) = law {
            parameters = with_law(parameters, law);
        }
        let untouched = system(&parameters);
        let mut asked = untouched.clone();
        let speeds = asked.layout().speeds;
        let mut modes = vec![0u8; asked.switch_count()];
        let mut x = asked.initial_state();
        for _ in 0..3000 {
            // Now and then the same place is asked again.
            if numbers.unit() < 0.7 {
                x = asked.initial_state();
                for (i, value) in x.iter_mut().enumerate() {
                    let size = if i < speeds { 3e-4 } else { 0.05 };
                    *value += numbers.between(-size, size) * numbers.unit();
                }
            }
            for mode in &mut modes {
                *mode = numbers.between(0.0, 3.0) as u8;
            }
            let (question, time) = (numbers.between(0.0, 6.0) as usize, 0.25);
            let found = ask(&mut asked, question, time, &x, &modes);
            let expected = ask(&mut untouched.clone(), question, time, &x, &modes);
            assert_eq!(found.len(), expected.len());
            for (i, (found, expected)) in found.iter().zip(&expected).enumerate() {
                assert!(
                    equal(*found, *expected),
                    "question {question}, answer {i} at {x:?}: {found:e} instead of {expected:e}"
                );
            }
            if question == 1 {
                let faces = found[..modes.len()].chunks(4);
                open += faces.filter(|gaps| gaps.iter().all(|gap| *gap > 0.0)).count();
            }
        }
    }
    assert!(open > 100, "{open} open faces only");
}
