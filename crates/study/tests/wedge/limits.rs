//! Cases at their limits: what a warped wedge can bear, and runs that hardly progress.

use crate::runs::{LBF, LBF_IN, column};
use mechanics::quasi_static::{QuasiStaticWedge, SlidingDirection, SlopeFriction};
use mechanics::system::System;
use nucars::truck::Choices;
use quantity::SixDigits;
use study::case::builtin;
use study::half_truck::catalog::entry;
use study::measures::{Unmeasured, measure};
use study::progress::state_name;
use study::result::RunResult;
use study::run::Run;
use study::stepping::{SteppedWedge, SteppingError};
use wedge::Wedge;

fn run(name: &str) -> RunResult {
    let result = Run::new(&builtin::case(name).unwrap()).unwrap().finish(|_| {});
    assert!(result.summary.complete);
    result
}

/// Returns the moment about the column's middle over the edge-loading limit N_c h3/2 of the same instant.
fn shares(result: &RunResult) -> Vec<f64> {
    let moment = column(result, "net_moment_on_side_frame_z", LBF_IN);
    let normal = column(result, "longitudinal_wedge_force", LBF);
    moment
        .iter()
        .zip(&normal)
        .map(|(moment, normal)| moment.abs() / (0.5 * 10.5 * normal))
        .collect()
}

#[test]
fn the_warp_moment_reaches_the_edge_loading_limit_and_stays_below() {
    for (name, least) in [("warp_friction_0.2", 0.99), ("warp_friction_0.4", 0.97)] {
        let most = shares(&run(name)).into_iter().fold(0.0, f64::max);
        assert!(most > least && most < 1.005, "{name}: {most}");
    }
}

#[test]
fn a_wedge_that_may_roll_stays_well_below_the_limit() {
    let most = shares(&run("warp_friction_0.2_rolling"))
        .into_iter()
        .fold(0.0, f64::max);
    assert!(most > 0.6 && most < 0.9, "{most}");
}

/// Squeezed down between both faces, with both frictions up (a = b = +1), the wedge of friction 0.2 slides
/// under the quasi-static force; the wedge of friction 0.4 has none: it jams, and its force is many times
/// that of the coil.
#[test]
fn squeezed_down_it_slides_or_jams() {
    // At 25 s the yaw turns, at 24 s it still grows; rows are 0.02 s apart.
    let row = 1200;
    for (name, friction) in [("warp_friction_0.2", 0.2), ("warp_friction_0.4", 0.4)] {
        let result = run(name);
        let normal = column(&result, "longitudinal_wedge_force", LBF)[row];
        let coil = column(&result, "coil_force", LBF)[row] - 50.0;
        let angle = 37.5_f64.to_radians();
        let wedge = QuasiStaticWedge {
            angle,
            toe: 0.0,
            column_friction: friction,
            slope_friction: friction,
        };
        match wedge.slide(SlidingDirection::Down, SlopeFriction::UpSlope, coil) {
            Some(slide) => {
                // Sliding across takes a part of the friction, the twisted wedge some of its angle.
                assert!(
                    (normal / slide.column_normal - 1.0).abs() < 0.04,
                    "{normal} {slide:?}"
                );
                assert!(friction < wedge.critical_friction());
            }
            None => {
                assert!(friction > wedge.critical_friction());
                assert!(normal > 5.0 * coil, "{normal} {coil}");
            }
        }
    }
}

/// Two loops: the second repeats the first, and a loop loses energy.
#[test]
fn the_warp_loop_closes() {
    let result = run("warp_friction_0.2");
    let moment = column(&result, "net_moment_on_side_frame_z", LBF_IN);
    let yaw = column(&result, "bolster_yaw", 1.0);
    let most = moment.iter().fold(0.0_f64, |most, moment| most.max(moment.abs()));
    // Rows of one period, 20 s.
    for row in 500..1500 {
        assert!((moment[row + 1000] - moment[row]).abs() < 0.01 * most, "{row}");
    }
    let work: f64 = (500..1500)
        .map(|row| 0.5 * (moment[row] + moment[row + 1]) * (yaw[row + 1] - yaw[row]))
        .sum();
    // On the side frame the moment follows the bolster's yaw: it takes work from the bolster.
    assert!(work > 0.2 * most * 0.04, "{work} lbf in");
    assert!(work < most * 0.04 * 2.0, "{work} lbf in");
}

/// Contacts a million times as stiff as usual, and a tolerance to match: a million steps in a millisecond.
const STALLS: [&str; 3] = [
    "contact.stiffness=5e12 lbf/in",
    "simulation.relative_tolerance=1e-12",
    "simulation.start=touching",
];

/// One rule for all runs, and a message that says when and where it hangs; what was computed is kept. A run
/// that was saved and continued stops at the same step.
#[test]
fn limits_a_run_that_hardly_progresses_stops_by_the_rule_and_says_where() {
    let case = builtin::case_with("cdrun_toe_in_0.2_psi_0.012", &STALLS.map(str::to_owned)).unwrap();
    let result = Run::new(&case).unwrap().finish(|_| {});
    let stopped = result.summary.stopped.unwrap();
    assert!(!result.summary.complete && result.summary.rows == 1);
    for part in [
        "hardly progresses",
        &format!("at {} s", SixDigits(stopped.time)),
        "150000 are admissible for 0.1 s",
        "the largest error is that of the speed in",
        "of the wedge",
        "contacts: column_lower_left slip",
    ] {
        assert!(stopped.reason.contains(part), "{} without {part}", stopped.reason);
    }
    let mut run = Run::new(&case).unwrap();
    for _ in 0..90_000 {
        run.advance().unwrap();
    }
    let continued = Run::resume(&case, run.state()).unwrap().finish(|_| {});
    assert_eq!(continued.summary.stopped.unwrap(), stopped);
    let Err(Unmeasured::Stopped(reason)) = measure(&case) else {
        panic!("a study goes on")
    };
    assert!(
        reason.contains("hardly progresses") && reason.contains("try a softer contact.stiffness"),
        "{reason}"
    );
}

/// The same rule for neighbours that a caller drives: the way is the communication step.
#[test]
fn limits_a_communication_step_that_hardly_progresses_stops_by_the_same_rule() {
    let case = builtin::case_with("cdrun_toe_in_0.2_psi_0.012", &STALLS.map(str::to_owned)).unwrap();
    let mut wedge = SteppedWedge::new(&case).unwrap();
    let place = *wedge.neighbours();
    let error = wedge.step(&place, 0.01).unwrap_err();
    let (text, attempts) = (
        error.to_string(),
        wedge.statistics().steps + wedge.statistics().rejected(),
    );
    assert!(matches!(error, SteppingError::TooLong { .. }), "{text}");
    assert!(text.contains("the step of 0.01 s from time 0 s"), "{text}");
    assert!(
        text.contains("the largest error is that of the speed in"),
        "{text}"
    );
    assert!((105_000..106_000).contains(&attempts), "{attempts} attempts");
}

#[test]
fn limits_states_have_names() {
    let bristle = ["friction.law=bristle".to_owned()];
    let case = builtin::case_with("cdrun_toe_0_psi_0", &bristle).unwrap();
    let wedge = Wedge::new(case.parameters).unwrap();
    let names: Vec<String> = (0..wedge.initial_state.len())
        .map(|state| state_name(&wedge.system, [&[], &[]], state))
        .collect();
    for name in [
        "the position in x of the wedge",
        "the speed in yaw of the wedge",
        "the bristles at point 1 of the column",
        "the bristles at point 4 of the slope",
        "the work of the motions",
    ] {
        assert!(names.iter().any(|own| own == name), "{name} in {names:?}");
    }
    assert!(names.iter().all(|name| !name.starts_with("state ")), "{names:?}");
    let case = entry("nucars_69_constant_toe_out").unwrap();
    let case = case.case(&Choices::default(), 1.0).unwrap();
    let system = System::new(case.truck.model.clone()).unwrap();
    let numbers = [&*case.truck.bodies, &*case.truck.connections];
    let names: Vec<String> = (0..system.layout().len())
        .map(|state| state_name(&system, numbers, state))
        .collect();
    assert!(names.iter().all(|name| !name.starts_with("state ")), "{names:?}");
    let accumulators = |name: &String| name.starts_with("the force accumulators of connection 127 (");
    assert!(names.iter().any(accumulators), "{names:?}");
}
