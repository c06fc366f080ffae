//! Jamming of wedges, and the symmetry of all four.
#![allow(clippy::unwrap_used)]

use mechanics::motion::Motion;
use study::half_truck::run::run;
use study::plausibility;

use crate::common::{POUND, case, result, run_all};

#[test]
fn toe_in_jams_on_the_way_down_and_is_held_by_the_limit() {
    for name in [
        "nucars_68_variable_toe_in",
        "nucars_68_constant_toe_in",
        "nucars_69_variable_toe_in",
        "nucars_69_constant_toe_in",
    ] {
        let result = result(name, 9.0);
        for (number, wedge) in &result.summary.wedges {
            let column = |what: &str| result.column(&format!("wedge_{number}_{what}")).unwrap();
            let (jammed, normal, rate) = (
                column("jammed"),
                column("column_normal_force"),
                column("stroke_rate"),
            );
            let most = wedge.largest_normal_force.as_ref().unwrap();
            println!(
                "{name} {number}: {:.3} {most:?} up {:?} down {:?}",
                wedge.jammed, wedge.up, wedge.down
            );
            assert!(wedge.jammed > 0.1, "{name} {number}: {}", wedge.jammed);
            assert!(most.value <= 1e5 * (1.0 + 1e-9), "{name}: {most:?}");
            assert!(most.value > 0.999e5, "{name}: {most:?}");
            // A jammed wedge that slides goes down.
            let sliding = |row: &usize| {
                jammed[*row] == 1.0 && normal[*row] > 0.999e5 * POUND && rate[*row].abs() > 0.01
            };
            let rows: Vec<usize> = (0..rate.len()).filter(sliding).collect();
            assert!(rows.iter().all(|row| rate[*row] < 0.0), "{name} {number}");
            assert!(!rows.is_empty(), "{name}");
        }
        assert!(
            result
                .summary
                .warnings
                .iter()
                .any(|text| text.contains("jammed wedges"))
        );
    }
}

#[test]
fn without_yaw_all_four_wedges_do_the_same() {
    for name in ["nucars_68_constant_toe_out", "nucars_69_variable_toe_out"] {
        let result = result(name, 7.0);
        let friction = |number: u32| result.column(&format!("wedge_{number}_column_friction")).unwrap();
        let size = friction(127)
            .iter()
            .fold(0.0, |most: f64, own| most.max(own.abs()));
        for number in [128, 129, 130] {
            let differ = friction(number).iter().zip(friction(127));
            let most = differ.fold(0.0, |most: f64, (a, b)| most.max((a - b).abs()));
            println!("{name} {number}: {:e} of {size}", most / size);
            assert!(most < 1e-2 * size, "{name} {number}: {most} of {size}");
        }
    }
}

#[test]
fn none_of_the_thesiss_runs_is_implausible() {
    let all = run_all(10.0, |_| true);
    assert!(all.len() >= 24, "{}", all.len());
    let mut feeding = Vec::new();
    for (entry, result) in &all {
        let (slopes, found): (Vec<&str>, Vec<&str>) = plausibility::among(&result.summary.warnings)
            .partition(|text| text.contains("`wedge_slope_loss` is a loss below zero"));
        assert!(found.is_empty(), "{}: {found:?}", entry.name());
        if let [warning] = slopes.as_slice() {
            assert!(warning.contains("--option wedges=bodies"), "{warning}");
            let losses = result.column("wedge_slope_loss").unwrap();
            assert!(losses.iter().any(|own| *own < 0.0), "{}", entry.name());
            feeding.push(entry.name());
        }
    }
    // The slope's friction has no direction of its own: it feeds energy where the bolster swings along.
    println!("{feeding:?}");
    assert!(!feeding.is_empty() && feeding.iter().all(|name| name.contains("_yaw")));
}

/// Input ten times as large lifts the bolster by more than the element's small displacements mean.
#[test]
fn a_body_that_leaves_its_surroundings_is_called_by_its_number() {
    let mut case = case("nucars_68_constant_toe_out", 2.0);
    for body in &mut case.truck.model.bodies {
        for motion in &mut body.frame.motions {
            if let Motion::Sine { amplitude, .. } = motion {
                *amplitude *= 1e3;
            }
        }
    }
    let result = run(&case, |_| ()).unwrap();
    let found: Vec<&str> = plausibility::among(&result.summary.warnings).collect();
    let left = found
        .iter()
        .any(|text| text.contains("implausible: body ") && text.contains("has left its surroundings"));
    assert!(left, "{found:?}");
}
