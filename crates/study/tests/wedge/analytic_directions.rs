//! Friction along one tangent a face, and toe about another point.

use crate::runs::{INCH, LBF, column};
use study::case::builtin;
use study::result::RunResult;
use study::run::Run;

fn run(name: &str, overrides: &[&str]) -> RunResult {
    let overrides: Vec<String> = overrides.iter().map(|text| (*text).to_owned()).collect();
    let case = builtin::case_with(name, &overrides).unwrap();
    let result = Run::new(&case).unwrap().finish(|_| {});
    assert!(result.summary.complete, "{name}");
    result
}

fn peak(result: &RunResult, name: &str) -> f64 {
    let rows = column(result, "time", 1.0).into_iter();
    let after = rows
        .zip(column(result, name, LBF))
        .filter(|(time, _)| *time > 1.6);
    after.fold(0.0, |most, (_, value)| most.max(value.abs()))
}

/// With the bolster yawed, friction against the slip has a lateral part; along one tangent it has none, and
/// what is left is the slope's normal force in the axes of the track.
#[test]
fn limits_one_tangent_leaves_no_lateral_force() {
    for damping in ["vdrun", "cdrun"] {
        for toe in ["toe_out_0.2", "toe_0", "toe_in_0.2"] {
            let name = format!("{damping}_{toe}_psi_0.012");
            let share = |directions: &str| {
                let result = run(&name, &[&format!("friction.directions={directions}")]);
                peak(&result, "net_force_on_bolster_y") / peak(&result, "net_force_on_bolster_x")
            };
            let [one, two] = ["one", "two"].map(share);
            assert!(one < 0.02 && two > 0.05, "{name}: {one} {two}");
        }
    }
}

/// Without yaw nothing slips across, and both give the same, as far as such runs tell: they are chaotic in
/// detail, so that branch means and losses are compared.
#[test]
fn limits_without_yaw_one_tangent_is_two() {
    let [one, two] = ["one", "two"].map(|directions| {
        let set = format!("friction.directions={directions}");
        let averages = run("cdrun_toe_out_0.2_psi_0", &[&set]).summary.averages;
        [
            averages.up["vertical_wedge_force"].value,
            averages.down["vertical_wedge_force"].value,
            averages.energy_per_cycle["side_frame"].value,
        ]
    });
    for (one, two) in one.iter().zip(two) {
        assert!((one / two - 1.0).abs() < 1e-3, "{one} {two}");
    }
}

/// A plane that turns by φ about a point p above its middle is one that turns about its middle and moves by
/// -p tan φ along x: with the coil in the bolster nothing else tells them apart.
#[test]
fn analytic_toe_about_another_point_is_a_shift_of_the_column() {
    for (toe, size) in [("0.2 deg in", -0.2_f64), ("0.2 deg out", 0.2)] {
        let toe = format!("side_frame.toe={toe}");
        let set = ["simulation.duration=4 s", &toe];
        let shift = 8.44 * size.to_radians().tan();
        let pivot = run(
            "cdrun_toe_0_psi_0",
            &[&set[..], &["side_frame.toe_pivot=-8.44 in"]].concat(),
        );
        let moved = format!("side_frame.longitudinal={shift:e} in");
        let moved = run("cdrun_toe_0_psi_0", &[&set[..], &[&moved]].concat());
        let [pivot, moved] = [pivot, moved].map(|own| column(&own, "wedge_z", INCH));
        let largest = pivot.iter().zip(&moved).map(|(a, b)| (a - b).abs());
        let largest = largest.fold(0.0, f64::max);
        assert!(largest < 1e-4, "{toe}: {largest} in");
        // The loop's place moves by the shift over the slope's tangent, 0.038 in.
        let still = run("cdrun_toe_0_psi_0", &set);
        let most = |values: &[f64]| values.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        let risen = most(&pivot) - most(&column(&still, "wedge_z", INCH));
        let expected = -shift / 37.5_f64.to_radians().tan();
        assert!(
            (risen / expected - 1.0).abs() < 0.2,
            "{toe}: {risen} of {expected} in"
        );
    }
}

/// The loss of a cycle with a crown of 60 in along the slope has converged over the points of its grid.
#[test]
fn convergence_of_the_loss_over_points_of_a_crown() {
    for name in ["vdrun_toe_out_0.2_psi_0", "cdrun_toe_out_0.2_psi_0"] {
        let loss = |points: u32| {
            let crown =
                "slope_face.wedge_surface={ shape = \"crown\", radius = \"60 in\", direction = \"up\" }";
            let grid = format!("slope_face.grid=[{points}, 2]");
            run(name, &[crown, &grid]).summary.averages.energy_per_cycle["side_frame"].value
        };
        let (coarse, fine) = (loss(41), loss(81));
        assert!((fine / coarse - 1.0).abs() < 3e-3, "{name}: {coarse} {fine}");
    }
}
