//! A wedge's rates have the same bits, whatever was computed before.

#[path = "../../../mechanics/tests/common/margins.rs"]
mod margins;

use crate::common;
use common::{Random, TOE, YAW, bristle, with_law};
use integrate::{DiscontinuityFunctions, Problem};
use margins::margins;
use mechanics::system::System;
use wedge::parameters::{Damping, Parameters};
use wedge::{Wedge, thesis};

fn system(parameters: &Parameters) -> System {
    let mut system = Wedge::new(parameters.clone()).unwrap().system;
    system.next_time_discontinuity(0.0);
    system
}

fn discontinuities(system: &mut System, time: f64, x: &[f64]) -> Vec<f64> {
    let structure = system.structure();
    let mut functions = DiscontinuityFunctions {
        values: vec![0.0; structure.discontinuity_values],
        slips: vec![[0.0; 2]; structure.slips],
    };
    system.discontinuities(time, x, &mut functions);
    [&functions.values[..], functions.slips.as_flattened()].concat()
}

/// Returns the bits as numbers: zero may have another sign, and what is not a number is as good as another.
fn equal(a: f64, b: f64) -> bool {
    a == b || a.is_nan() && b.is_nan()
}

/// Returns the signs of all groups, one after the other.
fn face_signs(system: &mut System, time: f64, x: &[f64]) -> Vec<f64> {
    let mut variables = vec![f64::NAN; system.structure().event_variables()];
    for (number, group) in system.structure().event_groups.into_iter().enumerate() {
        system.event_variables(Some(number), time, x, &mut variables[group.variables]);
    }
    variables
}

/// Returns all that an integrator may ask for at a place, one question after the other.
fn ask(system: &mut System, question: usize, time: f64, x: &[f64], contact_states: &[u8]) -> Vec<f64> {
    let n = x.len();
    let mut dx = vec![0.0; n];
    match question {
        0 => {
            system.derivative(time, x, &mut dx);
            dx
        }
        1 => discontinuities(system, time, x),
        2 => margins(system, time, x, contact_states).0,
        3 => face_signs(system, time, x),
        4 => vec![system.spectral_radius_bound(time, x)],
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
    // Open faces are passed over where they were open before: all answers are those of a system that was
    // never asked.
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
        let mut contact_states = vec![0u8; asked.structure().discrete_states()];
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
            for contact_state in &mut contact_states {
                *contact_state = numbers.between(0.0, 3.0) as u8;
            }
            let (question, time) = (numbers.between(0.0, 6.0) as usize, 0.25);
            let found = ask(&mut asked, question, time, &x, &contact_states);
            let expected = ask(&mut untouched.clone(), question, time, &x, &contact_states);
            assert_eq!(found.len(), expected.len());
            for (i, (found, expected)) in found.iter().zip(&expected).enumerate() {
                assert!(
                    equal(*found, *expected),
                    "question {question}, answer {i} at {x:?}: {found:e} instead of {expected:e}"
                );
            }
            if question == 1 {
                let faces = found[..contact_states.len()].chunks(4);
                open += faces.filter(|gaps| gaps.iter().all(|gap| *gap > 0.0)).count();
            }
        }
    }
    assert!(open > 100, "{open} open faces only");
}
