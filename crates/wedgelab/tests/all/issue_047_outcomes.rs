//! How a run ended, at every door: exit code, summary, terminal, page, studies, assessments.

use crate::common;
use std::fs;
use std::path::Path;

use common::{done, wedgelab};
use serde_json::Value;

/// An empty car on a track whose rails jump sideways by 5 in within 3 ft: a wheel leaves its rail.
const CAR: &str = r#"model = "car"
start.settle = "0 s"
lading.kind = "empty"
speed.value = "60 mph"
[[track.segments]]
tangent = "600 ft"
[[track.irregularities]]
shape = "jog"
rails = "both"
direction = "lateral"
offset = "5 in"
length = "3 ft"
start = "70 ft"
[simulation]
duration = "0.4 s"
"#;

/// The same track as a regime.
const REGIME: &str = r#"
title = "rails that jump"
source = "made up for a test"
speeds = ["60 mph"]
range = ["20 mph", "70 mph"]
reason = "a test"
distance = "40 ft"
settle = "1 ft"
[track]
segments = [{ tangent = "600 ft" }]
[[track.irregularities]]
shape = "jog"
rails = "both"
direction = "lateral"
offset = "5 in"
length = "3 ft"
start = "72 ft"
"#;

const LIMITS: &str = r#"title = "ours"
source = "made up"
[[limits]]
name = "roll"
quantity = "body roll"
measure = "body_roll_peak_to_peak"
regimes = ["jump"]
at_most = "60 deg"
"#;

fn folder() -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    for (name, text) in [("car.toml", CAR), ("jump.toml", REGIME), ("ours.toml", LIMITS)] {
        fs::write(folder.path().join(name), text).unwrap();
    }
    folder
}

fn json(path: &Path) -> Value {
    serde_json::from_str(&fs::read_to_string(path).unwrap()).unwrap()
}

/// Exit code 3, `complete: false`, and why above the table and on the page, with until where it holds.
#[test]
fn issue_047_a_derailed_car_is_told_by_run_and_report() {
    let folder = folder();
    let at = folder.path();
    let run = wedgelab(at, &["run", "car.toml", "--out", "out", "--quiet"]);
    assert_eq!(run.code, Some(3), "{}", run.err);
    let summary = json(&at.join("out/summary.json"));
    assert_eq!(summary["complete"], false);
    assert_eq!(summary["stopped"], Value::Null);
    let what = summary["derailed"]["what"].as_str().unwrap();
    assert!(what.contains("left its rail"), "{what}");
    let place = |text: &str, part: &str| text.find(part).unwrap_or_else(|| panic!("{part}: {text}"));
    let told = place(&run.out, "derailed at 0.");
    assert!(told < place(&run.out, what) && place(&run.out, what) < place(&run.out, "\nquantity"));
    assert!(
        place(&run.out, "statistics and margins are of the part until 0.") < place(&run.out, "\nquantity")
    );
    assert!(place(&run.out, "ft along the track)") < place(&run.out, "\nquantity"));
    assert!(run.err.contains("is incomplete") && run.err.contains("what was computed until then is in out"));
    let page = fs::read_to_string(at.join("out/index.html")).unwrap();
    let told = place(&page, "derailed at 0.");
    assert!(
        told < place(&page, ">Limits</h2>"),
        "the reason stands above the limits"
    );
    let limits = &page[place(&page, ">Limits</h2>")..place(&page, ">Statistics</h2>")];
    assert!(
        limits.contains("are of the part until 0."),
        "limits say until where they hold"
    );

    let report = wedgelab(at, &["report", "out", "--out", "page"]);
    assert_eq!(report.code, Some(0), "{}", report.err);
    assert!(
        report.err.contains("warning: out derailed at 0."),
        "{}",
        report.err
    );
    let page = fs::read_to_string(at.join("page/index.html")).unwrap();
    assert!(page.contains("out derailed at 0.") && page.contains("Those of out are of the part until 0."));

    // In parts: the state of a derailed run is none to go on from.
    let parts = [
        "run",
        "car.toml",
        "--out",
        "parts",
        "--save",
        "state.json",
        "--quiet",
    ];
    let parts = wedgelab(at, &parts);
    assert_eq!(parts.code, Some(3), "{}", parts.err);
    assert!(
        parts.err.contains("cannot go on; no state is saved"),
        "{}",
        parts.err
    );

    // Energies are of whole runs.
    let energy = wedgelab(at, &["energy", "car.toml", "--quiet"]);
    assert_eq!(
        (energy.code, energy.out.as_str()),
        (Some(3), ""),
        "{}",
        energy.err
    );

    let help = done(at, &["--help"]);
    assert!(help.contains("3 a wheel left its rail"), "{help}");
}

/// The row of a variant that derailed says so, and figures leave it out.
#[test]
fn issue_047_a_study_counts_what_derailed() {
    let folder = folder();
    let at = folder.path();
    let text = "case = \"car.toml\"\nsampling = \"list\"\n[[variants]]\nsimulation.duration = \"0.4 s\"\n\
                [[variants]]\nsimulation.duration = \"0.05 s\"\n";
    fs::write(at.join("two.toml"), text).unwrap();
    let told = done(at, &["study", "two.toml", "--quiet"]);
    assert!(told.contains("2 runs: 1 complete, 1 derailed"), "{told}");
    assert!(
        told.contains("run 0: at 0.") && told.contains("left its rail"),
        "{told}"
    );
    let answer: Value = serde_json::from_str(&done(at, &["study", "two.toml", "--quiet", "--json"])).unwrap();
    assert_eq!((&answer["complete"], &answer["derailed"]), (&1.into(), &1.into()));
    let table = fs::read_to_string(at.join("two/table.csv")).unwrap();
    let rows: Vec<&str> = table.lines().collect();
    assert!(
        rows[1].starts_with("0,derailed,") && rows[2].starts_with("1,complete,"),
        "{table}"
    );
    assert!(rows[1].contains("left its rail"), "{}", rows[1]);
    let page = fs::read_to_string(at.join("two/index.html")).unwrap();
    assert!(page.contains("1 derailed"), "the page counts it");
}

/// A regime whose run derailed is never kept, and what is measured is told to be of the part until then.
#[test]
fn issue_047_a_assessment_tells_what_derailed() {
    let folder = folder();
    let at = folder.path();
    let told = done(
        at,
        &[
            "regime",
            "jump.toml",
            "car.toml",
            "--limits",
            "ours.toml",
            "--out",
            "c",
            "--quiet",
        ],
    );
    for part in [
        "0 kept, 1 exceeded",
        "until it derailed",
        "Not complete: 1 derailed.",
    ] {
        assert!(told.contains(part), "{part}: {told}");
    }
    let assessment = json(&at.join("c/assessment.json"));
    let [run] = assessment["runs"].as_array().unwrap().as_slice() else {
        panic!("one run")
    };
    assert_eq!(run["status"], "derailed");
    let verdict = &assessment["verdicts"][0];
    assert_eq!(verdict["verdict"], "exceeded");
    // What the whole run would keep is kept only until it derailed.
    assert!(verdict["worst"]["margin"].as_f64().unwrap() > 0.5);
    assert_eq!(verdict["worst"]["until_derailed"], true);
    let csv = fs::read_to_string(at.join("c/assessment.csv")).unwrap();
    assert!(csv.lines().nth(1).unwrap().contains(",derailed,"), "{csv}");
    let page = fs::read_to_string(at.join("c/index.html")).unwrap();
    assert!(page.contains("until it derailed") && page.contains("The run derailed at"));
}

/// A wheelset that derails ends with the same code, and says it above its table.
#[test]
fn issue_047_a_derailed_wheelset_is_told() {
    let folder = tempfile::tempdir().unwrap();
    let at = folder.path();
    fs::write(
        at.join("straight.toml"),
        "[[segments]]\ntangent = \"200 m\"\n[support]\nkind = \"rigid\"\n",
    )
    .unwrap();
    let run = wedgelab(
        at,
        &[
            "wheelrail",
            "run",
            "aar_1b",
            "136re",
            "straight.toml",
            "--speed",
            "5 m/s",
            "--yaw",
            "80 mrad",
            "--load",
            "60 kN",
            "--friction",
            "0.6",
            "--lateral-stiffness",
            "0 N/m",
            "--yaw-stiffness",
            "0 N m/rad",
            "--lateral-damping",
            "0 N s/m",
            "--yaw-damping",
            "1e9 N m s/rad",
            "--out",
            "out",
            "--quiet",
        ],
    );
    assert_eq!(run.code, Some(3), "{}{}", run.out, run.err);
    let summary = json(&at.join("out/summary.json"));
    assert_eq!(summary["complete"], false);
    let told = run.out.find("derailed at").unwrap();
    assert!(told < run.out.find("wear number").unwrap(), "{}", run.out);
    let page = fs::read_to_string(at.join("out/index.html")).unwrap();
    assert!(page.contains("derailed at") && page.contains("along the track), not of the whole run"));
}
