//! The same bits across save and continue; damaged states are refused.
#![allow(clippy::unwrap_used, clippy::panic)]

use serde_json::Value;
use study::half_truck::run::{HalfTruckCounts, run};
use study::half_truck::{HalfTruckCase, HalfTruckResult};
use study::run::{Run, RunError, RunState};

use super::common::{bodies, case, result};

fn bits(values: &[Vec<f64>]) -> Vec<Vec<u64>> {
    let bits = |column: &Vec<f64>| column.iter().map(|value| value.to_bits()).collect();
    values.iter().map(bits).collect()
}

/// Runs it in pieces, each saved as text and read again.
fn in_pieces(case: &HalfTruckCase, length: f64) -> (HalfTruckResult, u32) {
    let mut run = Run::new(case).unwrap();
    let mut values: Option<Vec<Vec<f64>>> = None;
    let mut pieces = 1;
    loop {
        let stop = run.time() + length;
        while !run.is_finished() && run.time() < stop {
            run.advance().unwrap();
        }
        let finished = run.is_finished();
        let text = serde_json::to_string(&run.state()).unwrap();
        let mut piece = run.result(None);
        assert_eq!(piece.summary.complete, finished);
        let all = values.get_or_insert_with(|| vec![Vec::new(); piece.values.len()]);
        for (all, own) in all.iter_mut().zip(&piece.values) {
            all.extend(own);
        }
        if finished {
            piece.values = values.unwrap_or_default();
            return (piece, pieces);
        }
        let state: RunState<HalfTruckCounts> = serde_json::from_str(&text).unwrap();
        run = Run::resume(case, state).unwrap();
        pieces += 1;
    }
}

#[test]
fn reproducible_across_save_and_continue() {
    for name in ["nucars_68_variable_toe_out", "nucars_69_constant_toe_in_yaw"] {
        // Past the first half period and one whole cycle, so that works are counted.
        let duration = 4.9;
        let straight = result(name, duration);
        let (together, pieces) = in_pieces(&case(name, duration), 0.7);
        assert!(pieces >= 5, "{name}: {pieces} pieces");
        assert!(bits(&straight.values) == bits(&together.values), "{name}");
        let (a, b) = (&straight.summary, &together.summary);
        assert_eq!(a.ledger, b.ledger, "{name}");
        assert_eq!(a.largest_residual, b.largest_residual, "{name}");
        for (number, wedge) in &a.wedges {
            let energy = wedge.energy_per_cycle.as_ref().unwrap();
            assert!(energy.value != 0.0, "{name}");
            let other = b.wedges[number].energy_per_cycle.as_ref().unwrap();
            assert_eq!(energy.value.to_bits(), other.value.to_bits(), "{name}");
        }
    }
}

#[test]
fn reproducible_across_save_and_continue_with_wedge_bodies() {
    for name in ["nucars_69_variable_toe_out", "nucars_68_constant_toe_in_yaw"] {
        let case = bodies(name, 4.9, &[]);
        let straight = run(&case, |_| ()).unwrap();
        let (together, pieces) = in_pieces(&case, 0.7);
        assert!(pieces >= 5, "{name}: {pieces} pieces");
        assert!(bits(&straight.values) == bits(&together.values), "{name}");
        let (a, b) = (&straight.summary, &together.summary);
        assert_eq!(a.ledger, b.ledger, "{name}");
        let [energy, other] = [a, b].map(|own| own.wedges["127"].energy_per_cycle.as_ref().unwrap().value);
        assert!(energy > 1000.0, "{name}: {energy} lbf·in");
        assert_eq!(energy.to_bits(), other.to_bits(), "{name}");
    }
}

#[test]
fn input_damaged_states_are_refused_with_their_member() {
    let case = case("nucars_69_variable_toe_out", 1.0);
    let mut run = Run::new(&case).unwrap();
    while run.time() < 0.3 {
        run.advance().unwrap();
    }
    let good = serde_json::to_value(run.state()).unwrap();
    let resume = |state: &Value| {
        let state: RunState<HalfTruckCounts> = serde_json::from_value(state.clone()).unwrap();
        Run::resume(&case, state).map(|_| ())
    };
    assert!(resume(&good).is_ok());
    for (pointer, value, member) in [
        ("/counts/works", Value::from(vec![0.0]), "counts.works"),
        ("/counts/reached", Value::from(0.1), "counts.reached"),
        ("/next_row", Value::from(1), "next_row"),
        (
            "/energy_balance/largest_residual",
            Value::from(-1.0),
            "energy_balance.largest_residual",
        ),
    ] {
        let mut state = good.clone();
        *state.pointer_mut(pointer).unwrap() = value;
        match resume(&state) {
            Err(RunError::Damaged { member: found, .. }) => assert_eq!(found, member),
            other => panic!("{pointer}: {other:?}"),
        }
    }
}
