//! Issue 36: a corner without normal force is open, in every place that tells contact states.

use study::case::{Case, builtin};
use study::result::RunResult;
use study::run::Run;

/// Returns a run, cut short.
fn run(name: &str, duration: &str) -> RunResult {
    let case: Case = builtin::case_with(name, &[format!("simulation.duration={duration:?}")]).unwrap();
    Run::new(&case).unwrap().finish(|_| ())
}

/// Returns the columns of normal force and contact state of each corner.
fn corners(result: &RunResult) -> Vec<(String, Vec<f64>, Vec<f64>)> {
    let columns = result.columns.iter().map(|column| column.name.as_str());
    let named = |name: String| result.column(&name).unwrap().to_vec();
    columns
        .filter_map(|name| name.strip_suffix("_state"))
        .map(|corner| {
            let [force, state] = ["normal_force", "state"].map(|what| named(format!("{corner}_{what}")));
            (corner.to_owned(), force, state)
        })
        .collect()
}

#[test]
fn issue_036_a_corner_without_normal_force_is_open() {
    // The column touches without force until the wedge comes down; the faces of the others ring.
    for (name, duration) in [
        ("vdrun_toe_0_psi_0", "1.7 s"),
        ("cdrun_toe_0_psi_0", "1.7 s"),
        ("vdrun_toe_out_0.2_psi_0", "1.7 s"),
        ("lock_up_friction_0.4", "1 s"),
    ] {
        let result = run(name, duration);
        let corners = corners(&result);
        assert!(corners.len() >= 8, "{name}: {} corners", corners.len());
        for (corner, force, state) in corners {
            let rows = force.iter().zip(&state);
            let wrong = rows
                .clone()
                .filter(|(force, state)| **force == 0.0 && **state != 0.0);
            assert_eq!(
                wrong.count(),
                0,
                "{name}: {corner} sticks or slips without normal force"
            );
            // What is called open carries no more than what 1e-11 in, at which it closes, makes.
            let most = rows
                .filter(|(_, state)| **state == 0.0)
                .map(|(force, _)| force.abs());
            let most = most.fold(0.0, f64::max);
            assert!(most <= 1e-3, "{name}: {corner} is open with {most} N");
        }
    }
}

#[test]
fn issue_036_a_column_that_touches_without_force_does_not_stick() {
    let result = run("vdrun_toe_0_psi_0", "1.57 s");
    let first = result.summary.events.listed.first();
    assert!(first.is_none(), "nothing touches before 1.57 s: {first:?}");
    assert_eq!(result.summary.events.counts["column"]["closes"], 0);
}
