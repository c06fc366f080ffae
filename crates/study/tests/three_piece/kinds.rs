//! Spatial and split wedges, as cases.
#![allow(clippy::unwrap_used)]

use std::collections::HashSet;

use study::run::{Run, RunState};
use study::truck::run::TruckCounts;
use study::truck::warp::WarpCurve;

use super::common::{KIP_INCH, POUND_FORCE, case, column, read_back, run};

const RIGS: [&str; 4] = [
    "truck_vertical_spatial",
    "truck_warp_nest_spatial",
    "truck_vertical_split",
    "truck_warp_nest_split",
];

/// A printed case reads back to the same case, also where one wedge alone is of another kind.
#[test]
fn input_kinds_are_printed_and_read_back() {
    let alone = [
        "wedge.leading_left.kind=split",
        "wedge.leading_left.split.angle=12 deg",
        "wedge.trailing_right.slope_across=-5 deg",
    ];
    let cases = RIGS.map(|name| case(name, &[]));
    let single = case("truck_vertical_variable", &alone);
    for case in cases.iter().chain([&single]) {
        assert_eq!(read_back(case).parameters, case.parameters, "{}", case.to_toml());
    }
    let [wedge, ..] = &single.parameters.wedges;
    assert!((wedge.split.angle.to_degrees() - 12.0).abs() < 1e-12);
    assert!((wedge.split.coil_distance - 0.25 * wedge.width).abs() < 1e-15);
}

/// Forces of the halves add up to those of the wedge, and its losses are those of its three faces.
#[test]
fn analytic_halves_add_up() {
    let set = [
        "split.angle=10 deg",
        "wedge.slope_across=-6 deg",
        "simulation.duration=3 s",
    ];
    let result = run("truck_vertical_split", &set);
    let mut rubbed = 0.0;
    for wedge in study::truck::WEDGE_NAMES {
        for face in ["column", "slope"] {
            let [whole, outboard, inboard] = ["", "_outboard", "_inboard"]
                .map(|half| column(&result, &format!("{wedge}{half}_{face}_normal")));
            let halves = outboard.iter().zip(inboard);
            for (whole, (outboard, inboard)) in whole.iter().zip(halves) {
                assert!((whole - outboard - inboard).abs() < 1e-9 * 1e4 * POUND_FORCE);
            }
        }
        let between = column(&result, &format!("{wedge}_split_normal"));
        let most = between.iter().fold(0.0, |most: f64, force| most.max(*force));
        assert!(most > 100.0 * POUND_FORCE, "{wedge}: {most}");
        rubbed += ["column", "slope", "split"]
            .map(|face| {
                column(&result, &format!("{wedge}_{face}_friction_loss"))
                    .last()
                    .unwrap()
            })
            .iter()
            .copied()
            .sum::<f64>();
    }
    let all = column(&result, "friction_loss").last().unwrap();
    // The rest is that of the adapters.
    assert!(rubbed > 0.9 * all && rubbed <= *all, "{rubbed} {all}");
    assert!(result.summary.ledger.largest_relative_residual < 1e-5);
    assert!(result.summary.cycles.loss_of_wedges(&["leading_left"]).is_none());
}

/// Corners have names of their own, those between the halves too.
#[test]
fn analytic_every_corner_of_a_half_has_its_name() {
    let case = case("truck_vertical_split", &["simulation.duration=0.05 s"]);
    let (result, contacts) = Run::with_contacts(&case)
        .unwrap()
        .finish_with_contacts(|_| std::ops::ControlFlow::Continue(()));
    assert!(result.summary.complete);
    let contacts = contacts.unwrap();
    let names: HashSet<&str> = contacts
        .columns
        .iter()
        .map(|column| column.name.as_str())
        .collect();
    assert_eq!(names.len(), contacts.columns.len());
    // Four wedges of two halves with two faces of four corners, and three corners between them.
    assert_eq!(names.len(), 4 * (2 * 2 * 4 + 3) * 6);
    assert!(names.contains("leading_left_outboard_column_lower_right_gap"));
    assert!(names.contains("leading_left_split_lower_toe_state"));
}

/// Warp against a wedge in one piece (the numbers of `docs/truck.md`): an angle across is stiffer at first,
/// as no clearance is; halves turn with their columns, and lock later.
#[test]
fn reproduction_halves_lock_later_in_warp_than_a_wedge_in_one_piece() {
    let stiffness = |name: &str| {
        let set = ["simulation.duration=4.6 s"];
        let curve = WarpCurve::of(&case(name, &set), &run(name, &set)).unwrap();
        let at = |angle: f64| curve.stiffness.iter().find(|(own, _)| *own == angle).unwrap().1;
        [0.001, 0.020].map(|angle| at(angle) / (KIP_INCH / 1e-3))
    };
    for (name, expected) in [
        ("truck_warp_nest_variable_rising", [143.8, 41.5]),
        ("truck_warp_nest_spatial", [156.5, 36.2]),
        ("truck_warp_nest_split", [129.1, 27.6]),
    ] {
        for (found, expected) in stiffness(name).into_iter().zip(expected) {
            assert!((found - expected).abs() < 0.1, "{name}: {found} {expected}");
        }
    }
}

#[test]
fn reproducible_split_wedges_save_and_continue() {
    let set = ["simulation.duration=1.5 s"];
    let straight = run("truck_vertical_split", &set);
    let case = case("truck_vertical_split", &set);
    let mut first = Run::new(&case).unwrap();
    while first.time() < 0.8 {
        first.advance().unwrap();
    }
    let text = serde_json::to_string(&first.state()).unwrap();
    let head = first.result(None);
    let state: RunState<TruckCounts> = serde_json::from_str(&text).unwrap();
    let tail = Run::resume(&case, state).unwrap().finish(|_| ());
    for ((straight, head), tail) in straight.values.iter().zip(&head.values).zip(&tail.values) {
        let both = head.iter().chain(tail);
        assert!(straight.iter().map(|v| v.to_bits()).eq(both.map(|v| v.to_bits())));
    }
}
