//! Answers for programs: `--json`, columns by other names, spans of time, completions, manual pages.

use crate::common;
use std::fs;
use std::path::Path;

use serde_json::Value;

use common::{done, wedgelab};

const SHORT: [&str; 2] = ["--set", "simulation.duration='0.5 s'"];
const CASE: &str = "cdrun_toe_out_0.2_psi_0.012";

#[track_caller]
fn json(folder: &Path, arguments: &[&str]) -> Value {
    serde_json::from_str(&done(folder, arguments)).unwrap()
}

fn run(folder: &Path, out: &str) -> Value {
    json(
        folder,
        &["run", CASE, SHORT[0], SHORT[1], "--out", out, "--quiet", "--json"],
    )
}

#[test]
fn a_run_answers_with_its_summary() {
    let folder = tempfile::tempdir().unwrap();
    let answer = run(folder.path(), "one");
    let written = fs::read_to_string(folder.path().join("one/summary.json")).unwrap();
    assert_eq!(
        answer["summary"],
        serde_json::from_str::<Value>(&written).unwrap()
    );
    let files = answer["files"].as_array().unwrap();
    assert!(
        files
            .iter()
            .all(|file| folder.path().join("one").join(file.as_str().unwrap()).exists())
    );
}

#[test]
fn comparisons_answer_with_their_differences() {
    let folder = tempfile::tempdir().unwrap();
    run(folder.path(), "one");
    // Another program's file: a column of another name, and one more pound everywhere.
    let text = fs::read_to_string(folder.path().join("one/result.csv")).unwrap();
    let mut lines = text.lines();
    let names: Vec<&str> = lines.next().unwrap().split(',').collect();
    let place = |name: &str| names.iter().position(|other| *other == name).unwrap();
    let (time, force) = (place("time_s"), place("vertical_wedge_force_lbf"));
    let rows = lines.map(|line| {
        let cells: Vec<f64> = line.split(',').map(|cell| cell.parse().unwrap()).collect();
        format!("{},{}", cells[time], cells[force] + 1.0)
    });
    let other = format!("time_s,Fz_lbf\n{}\n", rows.collect::<Vec<_>>().join("\n"));
    fs::write(folder.path().join("other.csv"), other).unwrap();
    let arguments = [
        "compare",
        "one",
        "other.csv",
        "--columns",
        "vertical_wedge_force",
        "--map",
        "vertical_wedge_force=Fz",
        "--from",
        "0.1",
        "--to",
        "0.3",
        "--json",
    ];
    let answer = json(folder.path(), &arguments);
    let one = &answer["differences"][0];
    assert_eq!((&answer["from_s"], &answer["to_s"]), (&0.1.into(), &0.3.into()));
    for key in ["largest", "root_mean_square"] {
        assert!((one[key].as_f64().unwrap() - 1.0).abs() < 1e-6, "{one}");
    }
    let wrong = |pair: &str, text: &str| {
        let output = wedgelab(
            folder.path(),
            &["compare", "one", "other.csv", "--map", pair, "--force"],
        );
        assert_eq!(output.code, Some(2));
        assert!(output.err.contains(text), "{text:?} is not in: {}", output.err);
    };
    wrong("vertical_wedge_force", "two names");
    wrong("vertical_wedge_force=Fx", "did you mean Fz");
    wrong("wedge_z=vertical_wedge_force", "has both columns");
    let late = wedgelab(
        folder.path(),
        &["plot", "one", "--x", "time", "--y", "wedge_z", "--from", "0.7"],
    );
    assert_eq!(late.code, Some(2));
    assert!(late.err.contains("it goes from 0 s to 0.5 s"), "{}", late.err);
}

#[test]
fn the_massless_wedge_answers_with_its_branches() {
    let folder = tempfile::tempdir().unwrap();
    let answer = json(folder.path(), &["quasi-static", "--mu-column", "0", "--json"]);
    // Without friction at the column and with the slope's down the slope (bolster down, toe zero):
    // N_c = F cos(θ + ψ) / sin(θ + ψ).
    let margin = 32.0_f64.to_radians() + 0.4_f64.atan();
    let first = &answer["branches"][0];
    assert_eq!(first["bolster_goes"], "down");
    let force = first["column_normal"].as_f64().unwrap();
    assert!((force - 3000.0 / margin.tan()).abs() < 1e-6 * force);
    let jams = json(
        folder.path(),
        &[
            "quasi-static",
            "--mu-column",
            "0.9",
            "--mu-slope",
            "0.9",
            "--json",
        ],
    );
    assert!(jams["branches"][1]["column_normal"].is_null());
}

#[test]
fn studies_and_checks_answer() {
    let folder = tempfile::tempdir().unwrap();
    let study = format!(
        "case = \"{CASE}\"\nsampling = \"full_factorial\"\n[set]\nsimulation.duration = \"0.2 s\"\n\
         [vary]\nfriction.column = [0.2, 0.3]\n"
    );
    fs::write(folder.path().join("two.toml"), study).unwrap();
    let answer = json(folder.path(), &["study", "two.toml", "--quiet", "--json"]);
    assert_eq!((&answer["runs"], &answer["failed"]), (&2.into(), &0.into()));
    let system = nucars::builtin::text("bolst_wedge_sf_69_const.sys").unwrap();
    fs::write(
        folder.path().join("a.sys"),
        system.replace("\\BODY DATA", "\\BODY DATTA"),
    )
    .unwrap();
    let output = wedgelab(folder.path(), &["nucars", "check", "a.sys", "--json"]);
    assert_eq!(output.code, Some(2), "{}", output.err);
    let answer: Value = serde_json::from_str(&output.out).unwrap();
    assert!(answer[0]["errors"].as_u64().unwrap() >= 1);
    let finding = &answer[0]["findings"][0];
    assert!(finding["line"].as_u64().unwrap() >= 1 && finding["message"].is_string());
}

#[test]
fn a_built_in_case_is_written_into_a_folder() {
    let folder = tempfile::tempdir().unwrap();
    let name = "truck_vertical_variable";
    done(folder.path(), &["case", name, "--out", "cases"]);
    let written = fs::read_to_string(folder.path().join(format!("cases/{name}.toml"))).unwrap();
    assert_eq!(written, done(folder.path(), &["case", name]));
    let again = wedgelab(folder.path(), &["case", name, "--out", "cases"]);
    assert_eq!(again.code, Some(2), "{}", again.err);
}

#[test]
fn completions_and_manual_pages_know_all_commands() {
    let folder = tempfile::tempdir().unwrap();
    for shell in ["bash", "zsh", "fish", "powershell", "elvish"] {
        let text = done(folder.path(), &["completions", shell]);
        assert!(
            text.contains("wheelrail") && text.contains("quasi-static"),
            "{shell}"
        );
    }
    done(folder.path(), &["man", "--out", "man1"]);
    let page = |name: &str| fs::read_to_string(folder.path().join("man1").join(name)).unwrap();
    assert!(page("wedgelab.1").contains("wedgelab\\-run(1)"));
    assert!(page("wedgelab-nucars-check.1").contains("\\-\\-no\\-notes"));
}
