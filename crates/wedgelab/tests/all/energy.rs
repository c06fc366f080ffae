//! Messages about energy ledgers that do not close: a warning above 1e-3, a failure above 1e-2 that keeps
//! the files.

use crate::common;
use std::fs;
use std::path::Path;

use common::wedgelab;

/// Returns a run of ten seconds with a method that damps, at a tolerance that is too loose for its ledger.
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
    assert_eq!(summary["complete"], false);
    assert_eq!(summary["rows"], 1001);
    let told = done
        .out
        .find("has failed: the energy ledger does not close")
        .unwrap();
    assert!(told < done.out.find("ledger residual").unwrap(), "{}", done.out);
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

/// `wedgelab energy` tells the balance and every division, and writes what it has told; without a cycle it
/// says why.
#[test]
fn energy_of_a_cycle_is_reported_and_written() {
    let folder = tempfile::tempdir().unwrap();
    let set = "bolster.vertical={ shape = \"sine\", amplitude = \"0.5 in\", frequency = \"2 Hz\" }";
    let short = "simulation.duration=1.3 s";
    let case = ["energy", "vdrun_toe_in_0.2_psi_0.012", "--quiet", "--set", short];
    let done = wedgelab(
        folder.path(),
        &[&case[..], &["--set", set, "--out", "told"]].concat(),
    );
    assert_eq!(done.code, Some(0), "{}", done.err);
    for part in [
        "mean of 2 whole cycles, 0.250 s to 1.250 s",
        "work of motions and loads",
        "column friction",
        "column lower left",
        "Equivalent damping of all that is lost",
        "energy.json, power_flow.svg, power_flow.png",
    ] {
        assert!(done.out.contains(part), "{} without {part}", done.out);
    }
    let written = folder.path().join("told");
    let energy: serde_json::Value =
        serde_json::from_str(&fs::read_to_string(written.join("energy.json")).unwrap()).unwrap();
    let value = |of: &serde_json::Value| of["value"].as_f64().unwrap();
    let column = &energy["losses"]["column_friction_loss"];
    let points: f64 = column["by_point"].as_object().unwrap().values().map(value).sum();
    let total = value(&column["total"]);
    assert!(total > 0.0 && (points - total).abs() < 1e-12 * total);
    let svg = fs::read_to_string(written.join("power_flow.svg")).unwrap();
    assert!(
        svg.contains(">column friction<") && svg.contains("lbf·in, 100.0 %"),
        "{svg}"
    );
    assert!(
        fs::read(written.join("power_flow.png"))
            .unwrap()
            .starts_with(b"\x89PNG")
    );
    // The same of a run's folder, whose summary has the same numbers, and in short on the terminal.
    let run = [
        "run",
        "vdrun_toe_in_0.2_psi_0.012",
        "--quiet",
        "--set",
        short,
        "--set",
        set,
        "--out",
        "ran",
    ];
    let ran = wedgelab(folder.path(), &run);
    assert!(ran.out.contains("Energy of a cycle (mean of 2)"), "{}", ran.out);
    assert_eq!(summary(&folder.path().join("ran"))["energy"], energy);
    let again = wedgelab(folder.path(), &["energy", "ran", "--quiet"]);
    assert!(done.out.starts_with(&again.out), "{}", again.out);
    for (arguments, what) in [
        (
            &[
                "energy",
                "vdrun_toe_0_psi_0",
                "--quiet",
                "--set",
                "bolster.vertical=0 in",
            ][..],
            "nothing cycles",
        ),
        (
            &[
                "energy",
                "vdrun_toe_0_psi_0",
                "--quiet",
                "--set",
                "simulation.duration=1 s",
            ],
            "no whole cycle",
        ),
    ] {
        let done = wedgelab(folder.path(), arguments);
        assert_eq!(done.code, Some(2), "{}", done.err);
        assert!(
            done.err.contains(what) && done.err.contains("help"),
            "{}",
            done.err
        );
    }
}
