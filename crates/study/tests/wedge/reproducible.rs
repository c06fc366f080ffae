//! The same bits: from run to run, for any number of threads, across save and continue.

use crate::runs::run_all;
use study::case::{Case, builtin};
use study::result::RunResult;
use study::run::{Counts, Run, RunState};

fn bits(result: &RunResult) -> Vec<Vec<u64>> {
    result
        .values
        .iter()
        .map(|column| column.iter().map(|v| v.to_bits()).collect())
        .collect()
}

fn assert_same(a: &RunResult, b: &RunResult, what: &str) {
    assert_eq!(a.columns, b.columns);
    assert!(bits(a) == bits(b), "{what}: the tables differ");
    // As text, so that every bit of every number counts.
    let text = |result: &RunResult| serde_json::to_string(&result.summary).unwrap();
    assert_eq!(text(a), text(b), "{what}");
}

fn cases() -> Vec<Case> {
    let mut cases: Vec<Case> = builtin::thesis_names()
        .map(|name| builtin::case(name).unwrap())
        .collect();
    for (i, case) in cases.iter_mut().enumerate() {
        // Different lengths, so that threads finish in another order.
        case.simulation.duration = if i % 3 == 0 { 3.3 } else { 1.7 };
    }
    let bristle = [r#"friction.law="bristle""#.to_owned()];
    let mut bristle = builtin::case_with("cdrun_toe_out_0.2_psi_0.012", &bristle).unwrap();
    bristle.simulation.duration = 2.0;
    cases.push(bristle);
    cases
}

#[test]
fn from_run_to_run_and_for_any_number_of_threads() {
    let cases = cases();
    let first = run_all(&cases, 1);
    for threads in [1, 2, 4] {
        for ((case, a), b) in cases.iter().zip(&first).zip(&run_all(&cases, threads)) {
            assert_same(a, b, &format!("{} in {threads} threads", case.name));
        }
    }
    // The runs are not all the same.
    assert!(bits(&first[0]) != bits(&first[1]));
}

#[test]
fn across_save_and_continue() {
    for case in cases().iter().step_by(2) {
        let straight = Run::new(case).unwrap().finish(|_| {});
        // In pieces, each saved as text and read again; rows written before are not repeated.
        let mut run = Run::new(case).unwrap();
        let mut values: Vec<Vec<f64>> = vec![Vec::new(); straight.columns.len()];
        let mut pieces = 0;
        let (last, tail) = loop {
            let stop = run.time() + 0.41;
            while !run.is_finished() && run.time() < stop {
                run.advance().unwrap();
            }
            if run.is_finished() {
                let end = run.state();
                break (end, run.result(None));
            }
            let text = serde_json::to_string(&run.state()).unwrap();
            let state: RunState<Counts> = serde_json::from_str(&text).unwrap();
            assert_eq!(state, run.state());
            let piece = run.result(None);
            assert!(!piece.summary.complete);
            for (column, piece) in values.iter_mut().zip(piece.values) {
                column.extend(piece);
            }
            run = Run::resume(case, state).unwrap();
            pieces += 1;
        };
        assert!(pieces >= 3, "{}: {pieces} pieces", case.name);
        for (column, piece) in values.iter_mut().zip(&tail.values) {
            column.extend(piece);
        }
        let straight_end = {
            let mut run = Run::new(case).unwrap();
            while !run.is_finished() {
                run.advance().unwrap();
            }
            run.state()
        };
        // The number of evaluations is looked at in a test of its own.
        let mut last = last;
        last.integrator.statistics.derivatives = straight_end.integrator.statistics.derivatives;
        assert_eq!(last, straight_end, "{}", case.name);
        let together = RunResult { values, ..tail };
        assert!(
            bits(&straight) == bits(&together),
            "{}: the tables differ",
            case.name
        );
        // What was counted along the way goes on counting; branch means need all rows, and so does the number
        // of rows.
        let (a, b) = (&straight.summary, &together.summary);
        assert_eq!(a.events, b.events, "{}", case.name);
        assert_eq!(a.ledger, b.ledger, "{}", case.name);
        assert_eq!(a.friction, b.friction, "{}", case.name);
        assert_eq!(
            a.averages.energy_per_cycle, b.averages.energy_per_cycle,
            "{}",
            case.name
        );
    }
}

/// The summary holds the solver's counts: those must not tell either that a run was saved and continued.
#[test]
fn the_cost_of_a_continued_run_is_that_of_a_straight_one() {
    let mut case = builtin::case("cdrun_toe_out_0.2_psi_0.012").unwrap();
    case.simulation.duration = 0.3;
    let straight = Run::new(&case).unwrap().finish(|_| {});
    let mut run = Run::new(&case).unwrap();
    while run.time() < 0.1 {
        run.advance().unwrap();
    }
    let continued = Run::resume(&case, run.state()).unwrap().finish(|_| {});
    assert_eq!(continued.summary.solver, straight.summary.solver);
}

#[test]
fn a_state_of_another_version_is_refused() {
    let case = builtin::case("cdrun_toe_0_psi_0").unwrap();
    let mut state = Run::new(&case).unwrap().state();
    state.version += 1;
    let Err(error) = Run::resume(&case, state) else {
        panic!("it was read")
    };
    assert!(error.to_string().contains("version"), "{error}");
}
