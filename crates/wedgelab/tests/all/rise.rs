//! `wedgelab rise`, as a user calls it.

use crate::assess::{SHORT, limits};
use crate::common;
use std::fs;

use common::{done, wedgelab};
use serde_json::Value;

/// The same bytes for any number of jobs; a greater number of runs keeps those that are there; all files are
/// there and the page says what was found.
#[test]
fn limits_a_survey_goes_on_and_does_not_depend_on_jobs() {
    let folder = tempfile::tempdir().unwrap();
    let at = folder.path();
    fs::write(at.join("short.toml"), SHORT).unwrap();
    fs::write(at.join("limits.toml"), limits("5 %")).unwrap();
    let call = |out: &str, runs: &str, jobs: &str| {
        let own = format!(
            "rise car_tangent_loaded --regimes short.toml --limits limits.toml --factors mu_0.25 --set \
             start.kind=\"equilibrium\" --quiet --out {out} --runs {runs} --jobs {jobs} --to"
        );
        let own: Vec<&str> = own.split(' ').chain(["0.25 in"]).collect();
        done(at, &own)
    };
    call("one", "20", "1");
    let first = call("two", "3", "2");
    assert!(first.contains("No runs were left for"), "{first}");
    let kept = at.join("two/runs/as_given_short_30_rise_0_16.json");
    let written = fs::metadata(&kept).unwrap().modified().unwrap();
    let printed = call("two", "20", "2");
    assert!(printed.contains("not reached up to 1/4 in"), "{printed}");
    assert_eq!(written, fs::metadata(&kept).unwrap().modified().unwrap());
    for file in [
        "rise.csv",
        "rise.json",
        "runs.csv",
        "rise.txt",
        "rise.svg",
        "index.html",
        "method.html",
    ] {
        let [a, b] = ["one", "two"].map(|folder| fs::read(at.join(folder).join(file)).unwrap());
        assert!(a == b, "{file}");
    }
    let summary: Value = serde_json::from_slice(&fs::read(at.join("one/rise.json")).unwrap()).unwrap();
    assert_eq!(summary["left_to_look_at"], Value::Array(Vec::new()));
    let rig = summary["rigs"].as_array().unwrap();
    assert!(
        rig.len() == 4 && rig.iter().all(|own| own["value"].as_f64().unwrap() > 0.0),
        "{rig:?}"
    );
    let page = fs::read_to_string(at.join("one/index.html")).unwrap();
    assert!(
        page.contains("What wedge rise costs") && page.contains("6.35"),
        "the table in millimeters"
    );
}

#[test]
fn input_surveys_say_what_is_wrong() {
    let folder = tempfile::tempdir().unwrap();
    for (arguments, part) in [
        (["--to", "2 in"], "more than the pockets hold"),
        (["--to", "2 kg"], "2 kg"),
        (["--factors", "no_such"], "there is no condition"),
        (["--runs", "0"], "0"),
    ] {
        let own = [&["rise", "car_tangent_loaded"][..], &arguments].concat();
        let output = wedgelab(folder.path(), &own);
        assert_eq!(output.code, Some(2), "{}", output.err);
        assert!(output.err.contains(part), "{}", output.err);
    }
    let cost = done(folder.path(), &["rise", "car_tangent_loaded", "--cost", "--full"]);
    assert!(
        cost.contains("the whole grid of the car itself has 180 runs"),
        "{cost}"
    );
    assert!(
        fs::read_dir(folder.path()).unwrap().next().is_none(),
        "nothing is written"
    );
}
