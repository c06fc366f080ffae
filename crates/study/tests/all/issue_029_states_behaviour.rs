//! Issue 29: saved runs and driven wedges edited by hand are refused with the member's name, or go on
//! soundly.

#[path = "../../../integrate/tests/common/damage.rs"]
mod damage;

use integrate::MAXIMUM_COUNT;
use serde_json::{Value, json};
use study::case::{Case, builtin};
use study::progress::most_attempts;
use study::run::{Counts, EVENT_CAP, Run, RunError, RunState};
use study::stepping::{CoilInput, MOST_STATE_BYTES, SteppedState, SteppedWedge, SteppingError};

const YAWED: &str = "cdrun_toe_out_0.2_psi_0.012";

fn case(overrides: &[&str]) -> Case {
    let overrides: Vec<String> = overrides.iter().map(|text| (*text).to_owned()).collect();
    builtin::case_with(YAWED, &overrides).unwrap()
}

fn resume(case: &Case, state: Value) -> Result<Run<Case>, String> {
    let state: RunState<Counts> = serde_json::from_value(state).map_err(|error| error.to_string())?;
    Run::resume(case, state).map_err(|error| error.to_string())
}

/// Runs a case up to a time; the saved states on the way that are wanted, the first of each kind.
fn states(case: &Case, end: f64, wanted: &[fn(&Value) -> bool]) -> Vec<Value> {
    let mut run = Run::new(case).unwrap();
    let mut found: Vec<Option<Value>> = vec![None; wanted.len()];
    while run.time() < end && found.iter().any(Option::is_none) {
        run.advance().unwrap();
        let state = serde_json::to_value(run.state()).unwrap();
        for (found, wanted) in found.iter_mut().zip(wanted) {
            if found.is_none() && wanted(&state) {
                *found = Some(state.clone());
            }
        }
    }
    found.into_iter().map(Option::unwrap).collect()
}

fn is_late(state: &Value) -> bool {
    state["integrator"]["time"].as_f64() > Some(0.05)
}

/// Goes on for some steps; whether all were made.
fn advance(run: &mut Run<Case>, what: &str) -> bool {
    let attempts = |run: &Run<Case>| {
        let statistics = run.state().integrator.statistics;
        statistics.steps + statistics.rejected()
    };
    let before = attempts(run);
    let all = (0..4).all(|_| run.is_finished() || run.advance().is_ok());
    let after = attempts(run);
    assert!(after - before < 5000, "{what}: {} attempts", after - before);
    all
}

/// Refused, stopped and gone on.
#[derive(Debug, Default)]
struct Tally {
    refused: u32,
    stopped: u32,
    went_on: u32,
}

impl Tally {
    fn refuse(&mut self, what: &str, reason: &str) {
        assert!((10..1000).contains(&reason.len()), "{what}: {reason}");
        self.refused += 1;
    }

    fn go_on(&mut self, all: bool) {
        *(if all { &mut self.went_on } else { &mut self.stopped }) += 1;
    }
}

#[test]
fn issue_029_every_member_of_a_run_edited_by_hand_is_refused_or_goes_on() {
    let tanh: &[fn(&Value) -> bool] = &[
        |state| is_late(state) && state["integrator"]["prediction"]["zone_step"].is_number(),
        |state| is_late(state) && state["integrator"]["prediction"]["zone_step"].is_null(),
    ];
    let damping: &[fn(&Value) -> bool] = &[|state| {
        let integrator = &state["integrator"];
        is_late(state) && integrator["linearization_point"].is_object()
    }];
    for (overrides, wanted) in [(&[][..], tanh), (&["simulation.method=\"tr-bdf2\""][..], damping)] {
        let case = case(overrides);
        let mut tally = Tally::default();
        for (what, state) in states(&case, 2.0, wanted).iter().flat_map(damage::damaged) {
            match resume(&case, state) {
                Ok(mut run) => tally.go_on(advance(&mut run, &what)),
                Err(reason) => tally.refuse(&what, &reason),
            }
        }
        println!("{overrides:?}: {tally:?}");
        assert!(tally.refused > 1000 && tally.went_on > 100, "{tally:?}");
    }
}

#[test]
fn issue_029_members_of_a_run_that_led_astray_are_refused_by_name() {
    let case = case(&[]);
    let good = &states(&case, 1.0, &[is_late])[0];
    assert!(advance(&mut resume(&case, good.clone()).unwrap(), "as it was"));
    let event =
        json!({ "time": 0.0, "face": "column", "corner": "lower_right", "from": "open", "to": "stick" });
    let mut corner = event.clone();
    corner["corner"] = json!("middle");
    for (place, value, member) in [
        ("/next_row", json!(u64::MAX), "next_row"),
        ("/next_row", json!(0), "next_row"),
        ("/next_row", json!(1), "next_row"),
        ("/counts/crept", json!([0.0]), "counts.crept"),
        ("/counts/creep_speeds", json!([0.0, 0.0]), "counts.creep_speeds"),
        ("/counts/crept/3", json!(-1.0), "counts.crept"),
        ("/counts/events", json!([[0, 0, 0, 0]]), "counts.events"),
        ("/counts/events/1/2", json!(MAXIMUM_COUNT + 1), "counts.events"),
        ("/counts/event_total", json!(u64::MAX), "counts.event_total"),
        ("/counts/probes", json!([[0.0, 0.0]]), "counts.probes"),
        (
            "/counts/listed",
            json!(vec![event; EVENT_CAP + 1]),
            "counts.listed",
        ),
        ("/counts/listed", json!([corner]), "counts.listed.corner"),
        (
            "/energy_balance/largest_residual",
            json!(-1.0),
            "energy_balance.largest_residual",
        ),
        ("/pace/time", json!(1e300), "pace.time"),
        ("/pace/attempts", json!(MAXIMUM_COUNT + 1), "pace.attempts"),
        (
            "/integrator/discrete_states/7",
            json!(3),
            "integrator.discrete_states",
        ),
        ("/integrator/time", json!(-1e-9), "integrator.time"),
        ("/integrator/time", json!(1e308), "integrator.time"),
        (
            "/integrator/interval_start",
            json!(-1.0),
            "integrator.interval_start",
        ),
        (
            "/integrator/statistics/steps",
            json!(u64::MAX),
            "statistics.steps",
        ),
        ("/integrator/proposed_step", json!(0.0), "proposed_step"),
    ] {
        let mut state = good.clone();
        *state.pointer_mut(place).unwrap() = value;
        let reason = resume(&case, state)
            .err()
            .unwrap_or_else(|| panic!("{place} was taken"));
        assert!(
            reason.contains("damaged") && reason.contains(member),
            "{place}: {reason}"
        );
        assert!(
            reason
                .to_lowercase()
                .contains("continue from the state as it was saved"),
            "{reason}"
        );
    }
    // Numbers that JSON cannot hold.
    let mut state: RunState<Counts> = serde_json::from_value(good.clone()).unwrap();
    state.start_energy = f64::NAN;
    let error = Run::resume(&case, state).err().unwrap();
    let RunError::Damaged { member, .. } = error else {
        panic!("{error}")
    };
    assert_eq!(member, "start_energy");
}

/// Returns a wedge on its way, its bolster rising.
fn driven(coil: CoilInput) -> SteppedWedge {
    let mut wedge = SteppedWedge::new(&case(&[])).unwrap();
    wedge.set_coil(coil).unwrap();
    rise(&mut wedge, 1e-3, 30).unwrap();
    wedge
}

fn rise(wedge: &mut SteppedWedge, duration: f64, steps: u32) -> Result<(), SteppingError> {
    for _ in 0..steps {
        let mut place = *wedge.neighbours();
        place.bolster.position[2] += 0.05 * duration;
        place.bolster.rate[2] = 0.05;
        wedge.step(&place, duration)?;
    }
    Ok(())
}

#[test]
fn issue_029_every_member_of_a_driven_wedge_edited_by_hand_is_refused_or_goes_on() {
    let mut wedge = driven(CoilInput::Force(9e3));
    let good = wedge.state();
    let saved: Value = serde_json::from_slice(&good.to_bytes().unwrap()).unwrap();
    let mut tally = Tally::default();
    for (what, state) in damage::damaged(&saved) {
        let bytes = serde_json::to_vec(&state).unwrap();
        let restored = SteppedState::from_bytes(&bytes).and_then(|state| wedge.restore(&state));
        match restored {
            Ok(()) => {
                let before = wedge.statistics().clone();
                tally.go_on(rise(&mut wedge, 1e-6, 1).is_ok() && wedge.reading().is_ok());
                let after = wedge.statistics();
                let attempts = after.steps + after.rejected() - before.steps - before.rejected();
                assert!(
                    attempts < most_attempts(1e-6) + 1000,
                    "{what}: {attempts} attempts"
                );
            }
            Err(error) => tally.refuse(&what, &error.to_string()),
        }
        wedge.restore(&good).unwrap();
    }
    println!("{tally:?}");
    assert!(tally.refused > 500 && tally.went_on > 100, "{tally:?}");
    // And then it goes on as if nothing had been.
    rise(&mut wedge, 1e-3, 5).unwrap();
    let mut straight = driven(CoilInput::Force(9e3));
    rise(&mut straight, 1e-3, 5).unwrap();
    assert_eq!(wedge.state(), straight.state());
}

#[test]
fn issue_029_members_of_a_driven_wedge_that_led_astray_are_refused_by_name() {
    let mut wedge = driven(CoilInput::Internal);
    let good = wedge.state();
    for (edit, what) in [
        (
            (|state| state.integrator.discrete_states[2] = 9) as fn(&mut SteppedState),
            "contact state of corner 2",
        ),
        (
            |state| state.integrator.time = -1.0,
            "time of the saved state is -1",
        ),
        (
            |state| state.integrator.interval_start = 1.0,
            "`interval_start` is 1",
        ),
        (|state| state.integrator.time = f64::INFINITY, "start time is inf"),
        (
            |state| state.integrator.statistics.solves = u64::MAX,
            "`statistics.solves`",
        ),
        (|state| state.coil = CoilInput::Stiffness(-1.0), "stiffness is -1"),
        (|state| state.friction[1] = f64::NAN, "friction.slope is NaN"),
        (
            |state| state.neighbours.bolster.rate[0] = f64::INFINITY,
            "rate of x of the bolster is inf",
        ),
    ] {
        let mut state = good.clone();
        edit(&mut state);
        let reason = wedge.restore(&state).unwrap_err().to_string();
        assert!(reason.contains(what), "{what}: {reason}");
        assert_eq!(wedge.state(), good, "{what}: nothing has changed");
    }
    // More bytes than any state has are not read.
    let reason = SteppedState::from_bytes(&vec![b' '; MOST_STATE_BYTES + 1])
        .unwrap_err()
        .to_string();
    assert!(
        reason.contains("more than the 67108864 that are read"),
        "{reason}"
    );
    // Nor is what is nested without end.
    let deep = format!(
        "{{\"version\":2,\"integrator\":{}{}}}",
        "[".repeat(200_000),
        "]".repeat(200_000)
    );
    let reason = SteppedState::from_bytes(deep.as_bytes()).unwrap_err().to_string();
    assert!(
        reason.contains("this is no saved state") && reason.len() < 500,
        "{reason}"
    );
}

/// Heads of records that each claim most of the bytes were summed over one after the other.
#[test]
fn issue_029_records_that_claim_too_much_are_passed_over() {
    let mut bytes = Vec::new();
    for _ in 0..100_000 {
        bytes.extend(b"WLR1");
        bytes.extend(1_000_000_u32.to_le_bytes());
        bytes.extend([0; 4]);
    }
    let found = study::records::read(0, &bytes);
    assert_eq!((found.records.len(), found.lost), (0, bytes.len()));
}
