//! Energy ledgers: every built-in case beyond the thesis closes its own without warnings; and how runs are
//! judged that do not.

use mechanics::energy_balance::Verdict;
use nucars::truck::Choices;
use study::case::{Case, builtin};
use study::half_truck::catalog::entry;
use study::result::RunResult;
use study::run::Run;
use study::summary::{RunSummary, SummaryValue};
use study::{energy, half_truck};

use crate::runs::LBF_IN;

#[test]
fn all_cases_beyond_the_thesis_close_their_ledgers() {
    let thesis: Vec<&str> = builtin::thesis_names().collect();
    let cases: Vec<Case> = builtin::names()
        .filter(|name| !thesis.contains(name))
        .map(|name| builtin::case(name).unwrap())
        .collect();
    assert!(cases.len() > 30, "{}", cases.len());
    for (case, result) in cases.iter().zip(&crate::runs::run_all(&cases, 2)) {
        let (summary, name) = (&result.summary, &case.name);
        assert!(summary.complete, "{name}: {:?}", summary.stopped);
        // A wedge that is pushed out is warned of.
        let warned = name == "overturned_toe";
        assert!(
            summary.warnings.is_empty() != warned,
            "{name}: {:?}",
            summary.warnings
        );
        let residual = summary.ledger.largest_relative_residual;
        assert!(residual < 5e-6, "{name}: {residual:e}");
        // None is a matter of more than a moment.
        let attempts = summary.solver.statistics.steps + summary.solver.statistics.rejected();
        assert!(attempts < 6000, "{name}: {attempts} attempted steps");
        for (column, values) in result.columns.iter().zip(&result.values) {
            assert!(
                values.iter().all(|value| value.is_finite()),
                "{name}: {}",
                column.name
            );
        }
    }
}

/// Returns the relative residual from the columns of a table (SI) alone: the entries of its ledger by their
/// names.
fn by_hand(
    column: impl Fn(&str) -> Vec<f64>,
    work: &str,
    losses: &[&str],
    stored: &[&str],
    admissible: &Option<SummaryValue>,
) -> f64 {
    let last = |name: &str| column(name).last().copied().unwrap();
    let most = |values: Vec<f64>| values.iter().fold(0.0, |most: f64, value| most.max(value.abs()));
    let rows = column(work).len();
    let energy: Vec<f64> = (0..rows)
        .map(|row| stored.iter().map(|name| column(name)[row]).sum())
        .collect();
    let changes = energy.iter().map(|now| now - energy[0]).collect();
    let losses: f64 = losses.iter().map(|name| last(name)).sum();
    // A thousand times what one step may leave.
    let admissible = admissible.as_ref().unwrap();
    let unit = if admissible.unit == "J" { 1.0 } else { LBF_IN };
    let scale = last(work).abs().max(losses).max(most(changes));
    let scale = scale.max(1e3 * unit * admissible.value);
    most(column("ledger_residual")) / scale
}

fn of_wedge(result: &RunResult) -> f64 {
    by_hand(
        |name| result.column(name).unwrap().to_vec(),
        "motion_work",
        &[
            "side_frame_friction_loss",
            "bolster_friction_loss",
            "contact_damping_loss",
            "coil_damping_loss",
        ],
        &["stored_energy_change"],
        &result.summary.ledger.admissible_residual,
    )
}

fn run(name: &str, set: &[&str]) -> RunResult {
    let set: Vec<String> = set.iter().map(|text| (*text).to_owned()).collect();
    let case = builtin::case_with(name, &set).unwrap();
    Run::new(&case).unwrap().finish(|_| {})
}

/// The same function judges runs of wedges and of half-trucks: both are what a hand computes from the
/// columns.
#[test]
fn energy_the_measure_is_what_a_hand_computes_from_the_columns() {
    let close = |a: f64, b: f64, name: &str| assert!((a - b).abs() <= 1e-12 * b, "{name}: {a} {b}");
    for (name, set) in [
        ("cdrun_toe_out_0.2_psi_0.012", &["simulation.duration=2 s"][..]),
        ("vdrun_toe_0_psi_0", &["bolster.vertical=0 in"]),
        (
            "vdrun_toe_in_0.2_psi_0.012",
            &["simulation.method=tr-bdf2", "simulation.relative_tolerance=1e-3"],
        ),
    ] {
        let result = run(name, set);
        let found = result.summary.ledger.largest_relative_residual;
        assert!(found > 0.0, "{name}");
        close(found, of_wedge(&result), name);
    }
    for name in ["nucars_68_variable_toe_out", "nucars_69_constant_toe_in_yaw"] {
        let case = entry(name).unwrap().case(&Choices::default(), 2.0).unwrap();
        let result = half_truck::run::run(&case, |_| ()).unwrap();
        let losses: Vec<&str> = result
            .columns
            .iter()
            .map(|column| &*column.name)
            .filter(|name| name.ends_with("_loss"))
            .collect();
        let expected = by_hand(
            |name| result.column(name).unwrap().to_vec(),
            "input_work",
            &losses,
            &[
                "kinetic_energy",
                "gravity_energy",
                "spring_energy",
                "coil_energy",
                "accumulator_energy",
            ],
            &result.summary.admissible_residual,
        );
        close(result.summary.largest_relative_residual, expected, name);
    }
}

/// Above 1e-3 a warning with what, how much, where and what to do; above 1e-2 the run has failed, and has all
/// its rows.
#[test]
fn energy_loose_tolerances_warn_and_fail_with_all_rows() {
    let loose = |tolerance: &str| {
        let tolerance = format!("simulation.relative_tolerance={tolerance}");
        run(
            "vdrun_toe_0_psi_0.012",
            &["simulation.method=tr-bdf2", &tolerance],
        )
    };
    for (tolerance, verdict) in [
        ("1e-6", Verdict::Closed),
        ("1e-3", Verdict::Doubtful),
        ("1e-2", Verdict::Failed),
    ] {
        let result = loose(tolerance);
        let summary = &result.summary;
        let residual = summary.ledger.largest_relative_residual;
        assert_eq!(Verdict::of(residual), verdict, "{tolerance}: {residual}");
        let warnings: Vec<&str> = energy::among(&summary.warnings).collect();
        assert_eq!(warnings.is_empty(), verdict == Verdict::Closed, "{warnings:?}");
        assert_eq!(summary.failed.is_some(), verdict == Verdict::Failed);
        assert_eq!(summary.complete, verdict != Verdict::Failed);
        assert!(summary.rows == 1001 && result.rows() == 1001);
        for text in warnings {
            for part in [
                &*format!("{residual:.2e}"),
                " s;",
                "lower simulation.relative_tolerance",
            ] {
                assert!(text.contains(part), "{text} without {part}");
            }
        }
    }
}

#[test]
fn energy_half_trucks_warn_and_fail_by_the_same_limits() {
    for (name, verdict) in [
        ("nucars_69_constant_toe_none", Verdict::Doubtful),
        ("nucars_69_constant_toe_out", Verdict::Failed),
    ] {
        let mut case = entry(name).unwrap().case(&Choices::default(), 20.0).unwrap();
        case.relative_tolerance = 0.9;
        let summary = half_truck::run::run(&case, |_| ()).unwrap().summary;
        let residual = summary.largest_relative_residual;
        assert_eq!(Verdict::of(residual), verdict, "{name}: {residual}");
        assert_eq!(energy::among(&summary.warnings).count(), 1);
        assert_eq!(summary.failed.is_some(), verdict == Verdict::Failed);
        assert_eq!(summary.complete, verdict != Verdict::Failed);
        let word = if summary.complete { "complete" } else { "failed" };
        assert_eq!((summary.outcome().word(), summary.rows), (word, 2001));
    }
}

/// Runs in which nothing moves, a wedge falls free, or it is at rest from the first row to the last.
#[test]
fn limits_runs_without_motion_have_sensible_residuals() {
    let still = "bolster.vertical=0 in";
    let aside = "bolster.longitudinal=3 in";
    for (name, set) in [
        ("vdrun_toe_0_psi_0", &[still][..]),
        ("cdrun_toe_0_psi_0", &[still, "simulation.start=touching"]),
        ("vdrun_toe_0_psi_0", &[still, aside, "simulation.duration=0.3 s"]),
    ] {
        let summary = run(name, set).summary;
        let residual = summary.ledger.largest_relative_residual;
        assert_eq!(summary.ledger.entries["motion_work"].value, 0.0);
        assert!(residual > 0.0 && residual < 1e-3, "{name} {set:?}: {residual}");
        let of_ledger: Vec<&str> = energy::among(&summary.warnings).collect();
        assert!(summary.complete && of_ledger.is_empty(), "{of_ledger:?}");
    }
    let held = run(
        "vdrun_toe_0_psi_0",
        &[still, "wedge.free_coordinates=[\"x\"]", "simulation.duration=1 s"],
    );
    assert_eq!(held.summary.ledger.largest_relative_residual, 0.0);
    assert!(held.summary.warnings.is_empty());
}
