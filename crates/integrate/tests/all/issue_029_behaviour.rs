//! Issue 29: saved states edited by hand are refused with the member's name, or go on soundly.

#[path = "../common/damage.rs"]
mod damage;

use crate::common;
use common::problems::shaken_with_bound;
use integrate::{FunctionProblem, Integrator, MAXIMUM_COUNT, Method, Options, Reason, State};
use serde_json::{Value, json};

fn options(method: Method) -> Options {
    Options {
        method,
        relative_tolerance: 1e-6,
        ..Options::default()
    }
}

fn resume(method: Method, state: Value) -> Result<Integrator<FunctionProblem<'static>>, String> {
    let state: State = serde_json::from_value(state).map_err(|error| error.to_string())?;
    Integrator::resume(shaken_with_bound(), options(method), state).map_err(|error| error.to_string())
}

/// States of a run that between them hold every member that a state can hold.
fn states(method: Method) -> Vec<Value> {
    let mut integrator = Integrator::new(shaken_with_bound(), options(method), 0.0, &[0.0, 0.0]).unwrap();
    let wanted: &[fn(&Value) -> bool] = &[
        |state| state["time"].as_f64().is_some_and(|time| time > 0.3),
        |state| state["prediction"]["zone_step"].is_number(),
        |state| state["linearization_point"].is_object(),
    ];
    let mut found: Vec<Option<Value>> = vec![None; wanted.len()];
    while integrator.time() < 2.0 {
        integrator.step_to(2.0).unwrap();
        let state = serde_json::to_value(integrator.state()).unwrap();
        for (found, wanted) in found.iter_mut().zip(wanted) {
            if found.is_none() && wanted(&state) {
                *found = Some(state.clone());
            }
        }
    }
    found.into_iter().flatten().collect()
}

#[test]
fn issue_029_every_member_edited_by_hand_is_refused_or_goes_on() {
    for (method, kinds) in [(Method::Rodas5P, 2), (Method::TrBdf2, 2)] {
        let states = states(method);
        assert!(
            states.len() >= kinds,
            "{method}: {} kinds of states",
            states.len()
        );
        let (mut refused, mut stopped, mut continued) = (0, 0, 0);
        for (what, state) in states.iter().flat_map(damage::damaged) {
            let mut integrator = match resume(method, state) {
                Ok(integrator) => integrator,
                Err(reason) => {
                    assert!(reason.len() > 10, "{what}: {reason}");
                    refused += 1;
                    continue;
                }
            };
            let limit = integrator.time() + 0.1;
            let before = integrator.statistics().clone();
            let all = (0..5).all(|_| integrator.time() >= limit || integrator.step_to(limit).is_ok());
            let after = integrator.statistics();
            let attempts = after.steps + after.rejected() - before.steps - before.rejected();
            assert!(attempts < 2000, "{what}: {attempts} attempts");
            *(if all { &mut continued } else { &mut stopped }) += 1;
        }
        println!("{method}: {refused} refused, {stopped} stopped, {continued} continued");
        assert!(refused > 400 && continued > 20, "{refused} {continued}");
    }
}

#[test]
fn issue_029_counters_at_their_end_are_refused_by_name() {
    let good = &states(Method::Rodas5P)[0];
    for counter in [
        "steps",
        "rejected_error",
        "derivatives",
        "events_unresolved",
        "restarts",
    ] {
        let mut state = good.clone();
        state["statistics"][counter] = json!(MAXIMUM_COUNT);
        resume(Method::Rodas5P, state.clone())
            .unwrap()
            .step_to(5.0)
            .unwrap();
        for found in [MAXIMUM_COUNT + 1, u64::MAX] {
            state["statistics"][counter] = json!(found);
            let reason = resume(Method::Rodas5P, state.clone()).unwrap_err();
            assert!(
                reason.contains(&format!("`statistics.{counter}` is {found}")),
                "{reason}"
            );
            assert!(
                reason.contains("continue from the state as it was saved"),
                "{reason}"
            );
        }
    }
    let mut state = good.clone();
    state["controller"]["rejections"] = json!(u32::MAX);
    let reason = resume(Method::Rodas5P, state).unwrap_err();
    assert!(
        reason.contains("`controller.rejections` is 4294967295"),
        "{reason}"
    );
}

#[test]
fn issue_029_a_zone_without_a_step_is_refused() {
    let states = states(Method::Rodas5P);
    let with_zone = |state: &&Value| state["prediction"]["zone_step"].is_number();
    let state = states.iter().find(with_zone).unwrap();
    for step in [0.0, -1.0] {
        let mut state = state.clone();
        state["prediction"]["zone_step"] = json!(step);
        let reason = resume(Method::Rodas5P, state).unwrap_err();
        assert!(reason.contains("`prediction.zone_step`"), "{reason}");
    }
}

/// Steps that leave the time where it is were accepted one after the other, without end.
#[test]
fn issue_029_a_step_that_does_not_advance_the_time_is_an_error() {
    let mut state = states(Method::Rodas5P)[0].clone();
    state["proposed_step"] = json!(1e-300);
    let mut integrator = resume(Method::Rodas5P, state).unwrap();
    let error = integrator.step_to(5.0).unwrap_err();
    assert_eq!(error.reason, Reason::StepUnderflow);
    assert!(error.to_string().contains("lost against the time"), "{error}");
}

#[test]
fn issue_029_states_with_which_nothing_can_be_computed_are_refused() {
    let state = states(Method::Rodas5P).remove(0);
    for (value, admissible) in [(1e99, true), (-1e308, false), (1.1e100, false)] {
        let mut changed = state.clone();
        changed["x"][1] = json!(value);
        let resumed = resume(Method::Rodas5P, changed).map(|_| ());
        match resumed {
            Ok(()) => assert!(admissible, "{value}"),
            Err(reason) => assert!(!admissible && reason.contains("state 1"), "{value}: {reason}"),
        }
    }
}
