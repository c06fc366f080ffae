//! Runs with a curved slope, from which a sentence of section 7.2 is decided: toe out without yaw, the slope
//! face crowned by a radius of 60 in along it and across it, on grids that are fine enough for that.

use study::case::{Case, builtin};
use study::result::RunResult;
use study::run::Run;

/// The runs that they are compared with.
const FLAT: [&str; 2] = ["vdrun_toe_out_0.2_psi_0", "cdrun_toe_out_0.2_psi_0"];
/// Directions of the crown and grids: with 81 points the loss of a cycle is the same to 0.2 %.
const CROWNS: [[&str; 2]; 2] = [["up", "[41, 2]"], ["across", "[2, 41]"]];

/// Makes the runs with a curved slope, one for each crown and each run with a flat slope that was made; those
/// that cannot begin are left out.
#[must_use]
pub fn curved_slope_runs(made: &[(Case, RunResult)]) -> Vec<(Case, RunResult)> {
    let flat = FLAT
        .iter()
        .filter(|name| made.iter().any(|(case, _)| case.name == **name));
    let runs = flat.flat_map(|name| {
        CROWNS.iter().filter_map(move |[direction, grid]| {
            let set = [
                format!(
                    "slope_face.wedge_surface={{ shape = \"crown\", radius = \"60 in\", \
                     direction = \"{direction}\" }}"
                ),
                format!("slope_face.grid={grid}"),
            ];
            let case = builtin::case_with(name, &set).ok()?;
            let result = Run::new(&case).ok()?.finish(|_| ());
            Some((case, result))
        })
    });
    runs.collect()
}
