//! What a user is told of energy ledgers that do not close: a warning above 1e-3, a failure above 1e-2 that
//! keeps the files.

#![allow(clippy::unwrap_used)]

mod common;

use std::fs;
use std::path::Path;

use common::wedgelab;

/// A run of ten seconds with a method that damps, at a tolerance that is too loose for its ledger.
fn loose<'a>(tolerance: &'a str, out: &'a str) -> [&'a str; 9] {
    let [method, name] = ["simulation.method=tr-bdf2", "vdrun_toe_0_psi_0.012"];
    [
        "run", name, "--quiet", "--out", out, "--set", method, "--set", tolerance,
    ]
}

fn summary(folder: &Path) -> serde_json::Value {
    serde_json::from_str(&fs::read_to_string(folder.join("summary.json")).unwrap()).unwrap()
}

#[test]
fn energy_a_ledger_that_closes_badly_is_a_warning_everywhere() {
    let folder = tempfile::tempdir().unwrap();
    let done = wedgelab(folder.path(), &loose("simulation.relative_tolerance=1e-3", "out"));
    assert_eq!(done.code, Some(0), "{}", done.err);
    let summary = summary(&folder.path().join("out"));
    assert_eq!(summary["schema"], "wedgelab.summary/2");
    let residual = summary["ledger"]["largest_relative_residual"].as_f64().unwrap();
    assert!((1e-3..1e-2).contains(&residual), "{residual}");
    let warnings = summary["warnings"].as_array().unwrap();
    let warnings: Vec<&str> = warnings.iter().map(|warning| warning.as_str().unwrap()).collect();
    let warning = warnings
        .iter()
        .find(|text| text.starts_with("the energy ledger does not close"))
        .unwrap();
    assert!(
        warning.contains(&format!("{residual:.2e} (above 1e-3)")),
        "{warning}"
    );
    assert!(done.err.contains(warning), "{}", done.err);
    assert!(done.out.contains(&format!("{residual:.1e}")), "{}", done.out);
    assert_eq!(summary["failed"], serde_json::Value::Null);
}

#[test]
fn energy_a_ledger_that_does_not_close_is_a_failure_that_keeps_the_files() {
    let folder = tempfile::tempdir().unwrap();
    let done = wedgelab(folder.path(), &loose("simulation.relative_tolerance=1e-2", "out"));
    assert_eq!(done.code, Some(1), "{}", done.err);
    for part in [
        "the run vdrun_toe_0_psi_0.012 has failed: the energy ledger does not close",
        "(above 1e-2)",
        "its files are in out, marked as failed",
    ] {
        assert!(done.err.contains(part), "{} without {part}", done.err);
    }
    let out = folder.path().join("out");
    let summary = summary(&out);
    assert!(summary["failed"].as_str().unwrap().contains("(above 1e-2)"));
    assert_eq!(summary["complete"], true);
    assert_eq!(summary["rows"], 1001);
    let table = fs::read_to_string(out.join("result.csv")).unwrap();
    assert_eq!(table.lines().count(), 1002);
    assert!(out.join("case.toml").is_file() && out.join("result.mat").is_file());
}

#[test]
fn energy_rows_of_a_study_are_marked_and_keep_their_values() {
    let folder = tempfile::tempdir().unwrap();
    let study = "case = \"vdrun_toe_0_psi_0.012\"\nsampling = \"full_factorial\"\n\
                 accuracy = \"engineering\"\n[vary]\nsimulation.relative_tolerance = [1e-6, 1e-3, 1e-2]\n";
    fs::write(folder.path().join("some.toml"), study).unwrap();
    let done = wedgelab(folder.path(), &["study", "some.toml", "--quiet", "--jobs", "1"]);
    assert_eq!(done.code, Some(0), "{}", done.err);
    for part in [
        "3 runs: 2 complete, 1 failed",
        "run 2: the energy ledger does not close",
    ] {
        assert!(done.out.contains(part), "{} without {part}", done.out);
    }
    let warning = "warning: the energy ledger of 1 runs does not close";
    assert!(
        done.err.contains(warning) && done.err.contains("in run 1;"),
        "{}",
        done.err
    );
    let page = fs::read_to_string(folder.path().join("some/index.html")).unwrap();
    assert!(page.contains("1 failed.") && page.contains("the energy ledger of 1 runs does not close"));
}
