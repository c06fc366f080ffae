//! A compiler turned right source into a wrong Jacobian (docs/decisions/0008): results stayed right, but runs
//! took twenty times as many steps. The number of steps is what shows it.

use study::case::builtin;
use study::run::Run;

#[test]
fn a_yawed_run_takes_the_steps_of_a_right_jacobian() {
    for (name, most) in [
        ("vdrun_toe_out_0.2_psi_0.012", 45_000),
        ("cdrun_toe_out_0.2_psi_0.012", 12_000),
    ] {
        let summary = Run::new(&builtin::case(name).unwrap())
            .unwrap()
            .finish(|_| ())
            .summary;
        let statistics = &summary.solver.statistics;
        let attempts = statistics.steps + statistics.rejected();
        assert!(
            summary.complete && summary.warnings.is_empty(),
            "{name}: {:?}",
            summary.warnings
        );
        assert!(attempts < most, "{name}: {attempts} attempted steps");
    }
}
