//! The same bits across save and continue and from the printed case.
#![allow(clippy::unwrap_used)]

use study::run::{Run, RunState};
use study::truck::builtin;
use study::truck::run::TruckCounts;

use super::common::{case, read_back, run};

fn bits(values: &[Vec<f64>]) -> Vec<u64> {
    values.iter().flatten().map(|value| value.to_bits()).collect()
}

#[test]
fn reproducible_across_save_and_continue() {
    // Past one whole cycle, so that energies of cycles are counted.
    let set = ["simulation.duration=6.5 s"];
    for name in ["truck_vertical_variable", "truck_roll_constant"] {
        let straight = run(name, &set);
        let case = case(name, &set);
        let mut piece = Run::new(&case).unwrap();
        let mut values = vec![Vec::new(); straight.values.len()];
        let mut pieces = 0;
        loop {
            let stop = piece.time() + 1.3;
            while !piece.is_finished() && piece.time() < stop {
                piece.advance().unwrap();
            }
            let (finished, state) = (piece.is_finished(), piece.state());
            let text = serde_json::to_string(&state).unwrap();
            let result = piece.result(None);
            for (all, own) in values.iter_mut().zip(&result.values) {
                all.extend(own);
            }
            pieces += 1;
            if finished {
                assert_eq!(result.summary.cycles, straight.summary.cycles, "{name}");
                break;
            }
            let state: RunState<TruckCounts> = serde_json::from_str(&text).unwrap();
            piece = Run::resume(&case, state).unwrap();
        }
        assert!(pieces >= 4, "{pieces}");
        assert!(bits(&values) == bits(&straight.values), "{name}");
    }
}

#[test]
fn reproducible_the_printed_case_is_the_same_case() {
    for name in builtin::names() {
        let original = case(
            name,
            &[
                "wedge.trailing_right.friction.slope=0.3",
                "wedge.leading_left.toe=0.1 deg in",
            ],
        );
        let printed = read_back(&original);
        assert_eq!(printed, original, "{name}");
        assert_eq!(printed.parameters.wedges[3].slope_friction.coefficient, 0.3);
    }
}
