//! `wedgelab regime` and `wedgelab assess`, as a user calls them.

use crate::common;
use std::fs;
use std::path::Path;
use std::process::{Command, Stdio};
use std::time::Duration;

use common::{done, wedgelab};
use serde_json::Value;

/// A short track with a dip of one rail.
pub const SHORT: &str = r#"
title = "a dip of the left rail"
source = "made up for a test"
speeds = ["30 mph", "40 mph"]
range = ["20 mph", "50 mph"]
reason = "the dip is short"
distance = "60 ft"
settle = "5 ft"
[track]
segments = [{ tangent = "400 ft" }]
[[track.irregularities]]
shape = "dip"
rails = "left"
direction = "vertical"
depth = "0.3 in"
length = "20 ft"
start = "55 ft"
"#;

/// A file of limits: the least wheel load on the short track.
pub fn limits(load: &str) -> String {
    format!(
        "title = \"ours\"\nsource = \"made up\"\n[[limits]]\nname = \"load\"\nquantity = \"least wheel \
         load\"\n\
         measure = \"least_load_time\"\nregimes = [\"short\"]\nat_least = \"{load}\"\n"
    )
}

fn folder() -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("short.toml"), SHORT).unwrap();
    fs::write(folder.path().join("low.toml"), limits("5 %")).unwrap();
    fs::write(folder.path().join("high.toml"), limits("99 %")).unwrap();
    folder
}

const FILES: [&str; 5] = [
    "assessment.csv",
    "assessment.parquet",
    "assessment.json",
    "table.parquet",
    "index.html",
];

fn assess<'a>(out: &'a str, limits: &'a str, more: &[&'a str]) -> Vec<&'a str> {
    let mut arguments = vec![
        "assess",
        "car_tangent_loaded",
        "--regimes",
        "short.toml",
        "--conditions",
        "new",
        "mu_0.25",
        "--limits",
        limits,
        "--set",
        "start.kind=\"equilibrium\"",
        "--out",
        out,
        "--quiet",
    ];
    arguments.extend(more);
    arguments
}

#[track_caller]
fn same(at: &Path, first: &str, second: &str) {
    for file in FILES {
        let [a, b] = [first, second].map(|folder| fs::read(at.join(folder).join(file)).unwrap());
        assert!(a == b, "{file} of {first} and {second}");
    }
}

/// The same bytes for any number of jobs and after kills; a limit raised by hand turns its rows; a second
/// assessment beside the first.
#[test]
fn limits_a_assessment_goes_on_after_kills_and_does_not_depend_on_jobs() {
    let folder = folder();
    let at = folder.path();
    let printed = done(at, &assess("one", "low.toml", &["--jobs", "1"]));
    assert!(
        printed.contains("4 runs. Limits: 2 kept, 0 exceeded, 0 unknown"),
        "{printed}"
    );
    let mut killed = 0;
    for milliseconds in [150, 400, 900, 1500] {
        let mut child = Command::new(env!("CARGO_BIN_EXE_wedgelab"))
            .current_dir(at)
            .args(assess("two", "low.toml", &["--jobs", "2"]))
            .stdout(Stdio::null())
            .stderr(Stdio::null())
            .spawn()
            .unwrap();
        std::thread::sleep(Duration::from_millis(milliseconds));
        killed += u32::from(child.try_wait().unwrap().is_none());
        child.kill().unwrap();
        child.wait().unwrap();
    }
    assert!(killed > 0);
    done(at, &assess("two", "low.toml", &["--jobs", "2"]));
    same(at, "one", "two");

    // Other limits over the same runs: nothing is computed again but the worst run and speeds about it.
    let table = fs::read(at.join("two/table.parquet")).unwrap();
    let compared = done(at, &assess("two", "high.toml", &["--json", "--against", "one"]));
    let compared: Value = serde_json::from_str(&compared).unwrap();
    assert_eq!(
        (&compared["before"], &compared["exceeded"]),
        (&Value::from(4), &Value::from(2))
    );
    assert_eq!(fs::read(at.join("two/table.parquet")).unwrap(), table);
    let csv = fs::read_to_string(at.join("two/assessment.csv")).unwrap();
    let rows: Vec<&str> = csv.lines().collect();
    let refined = |word: &str| {
        rows[1..]
            .iter()
            .filter(|row| row.contains(&format!(",exceeded,{word},")))
            .count()
    };
    assert_eq!(refined("0"), 4, "{csv}");
    assert!((1..=12).contains(&refined("1")), "{csv}");
    assert!(
        rows[0]
            .starts_with("run,regime,condition,speed_mph,status,limit,value,bound,limit_value,unit,margin")
    );
    assert_eq!(rows.len(), 5 + refined("1"), "{csv}");
    // The page has the other assessment's values, the worst run and its files.
    let page = fs::read_to_string(at.join("two/index.html")).unwrap();
    assert!(page.contains("car_tangent_loaded (one)") && page.contains("its margin"));
    assert!(page.contains("href=\"worst/short/index.html\""));
    assert!(at.join("two/worst/short/result.csv").is_file());
    // What the page says of the worst run is what that run's own summary says.
    let document: Value = serde_json::from_slice(&fs::read(at.join("two/assessment.json")).unwrap()).unwrap();
    let summary: Value =
        serde_json::from_slice(&fs::read(at.join("two/worst/short/summary.json")).unwrap()).unwrap();
    let verdicts = document["verdicts"].as_array().unwrap().iter();
    let least = verdicts
        .map(|own| own["worst"]["value"].as_f64().unwrap())
        .fold(f64::INFINITY, f64::min);
    let statistics = summary["statistics"].as_object().unwrap().iter();
    let own = statistics
        .filter(|(name, _)| name.ends_with("_least_load_time"))
        .map(|(_, own)| own["filtered"]["value"].as_f64().unwrap())
        .fold(f64::INFINITY, f64::min);
    assert!((least - own).abs() < 1e-9, "{least} {own}");
    assert!(own > 20.0 && own < 99.0, "{own}");
}

#[test]
fn input_mistakes_are_explained() {
    let folder = folder();
    let at = folder.path();
    fs::write(
        at.join("wrong.toml"),
        limits("5 %").replace("at_least", "at_lest"),
    )
    .unwrap();
    let car = "car_tangent_loaded";
    for (arguments, said) in [
        (
            vec!["regime", "twist_and_rol", car],
            "did you mean twist_and_roll?",
        ),
        (vec!["regime", "twist_and_roll"], "which car"),
        (vec!["regime", "twist_and_roll", "vdrun_toe_0_psi_0"], "car"),
        (
            vec!["regime", "twist_and_roll", car, "--speeds", "90 mph"],
            "not for 90 mph",
        ),
        (
            vec!["regime", "twist_and_roll", car, "--speeds", "20..30 mph"],
            "unit",
        ),
        (
            vec!["regime", "twist_and_roll", car, "--limits", "wrong.toml"],
            "at_lest",
        ),
        (
            vec!["regime", "twist_and_roll", car, "--limits", "aar"],
            "no limits \"aar\"",
        ),
        (
            vec!["regime", "twist_and_roll", car, "--conditions", "rise_0-5"],
            "did you mean rise_0.5?",
        ),
        (
            vec!["regime", "--show", "aar_chapter"],
            "did you mean aar_chapter_xi?",
        ),
        (
            vec!["regime", "short.toml", car, "--against", "."],
            "no assessment to compare with",
        ),
        (vec!["assess", "nowhere.toml"], "nowhere.toml"),
        (vec!["assess", car, "--set", "truck.friction.colum=0.3"], "column"),
    ] {
        let output = wedgelab(at, &arguments);
        assert_eq!(output.code, Some(2), "{arguments:?}: {}", output.err);
        assert!(output.err.contains(said), "{arguments:?}: {}", output.err);
        assert!(output.out.is_empty(), "{}", output.out);
    }
}

/// Printed files can be used: a regime, limits and conditions.
#[test]
fn input_what_is_built_in_is_listed_and_shown() {
    let folder = folder();
    let at = folder.path();
    let listed = done(at, &["regime"]);
    for name in [
        "twist_and_roll",
        "broken_control_coil",
        "fra_213_333",
        "fra_class_5",
    ] {
        assert!(listed.contains(name), "{listed}");
    }
    for (name, option) in [("aar_chapter_xi", "--limits"), ("conditions", "--conditions")] {
        let file = format!("my_{name}.toml");
        fs::write(at.join(&file), done(at, &["regime", "--show", name])).unwrap();
        // Read, and then refused for the speed.
        let output = wedgelab(
            at,
            &[
                "regime",
                "short.toml",
                "car_tangent_loaded",
                option,
                &file,
                "--speeds",
                "90 mph",
            ],
        );
        assert!(output.err.contains("not for 90 mph"), "{}", output.err);
    }
    fs::write(at.join("mine.toml"), done(at, &["regime", "--show", "hunting"])).unwrap();
    let output = wedgelab(
        at,
        &["regime", "mine.toml", "car_tangent_loaded", "--speeds", "200 mph"],
    );
    assert!(output.err.contains("not for 200 mph"), "{}", output.err);
}

/// The older name is taken, and said; what is no Unicode is refused like any other name that is not there.
#[cfg(unix)]
#[test]
fn input_the_older_name_and_names_that_are_no_unicode() {
    use std::ffi::OsStr;
    use std::os::unix::ffi::OsStrExt;
    use std::process::Command;

    for (name, said) in [("certify", true), ("assess", false)] {
        let done = Command::new(env!("CARGO_BIN_EXE_wedgelab"))
            .args([OsStr::new(name), OsStr::from_bytes(b"my_\xff_car.toml")])
            .output()
            .unwrap();
        let told = String::from_utf8_lossy(&done.stderr);
        assert!(
            done.status.code().is_some_and(|own| own != 0 && own != 101),
            "{told}"
        );
        assert!(!told.contains("panicked"), "{told}");
        assert_eq!(told.contains("is called `wedgelab assess` now"), said, "{told}");
    }
}
