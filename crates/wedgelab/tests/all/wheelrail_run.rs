//! input, limits: `wedgelab wheelrail run`, as its user meets it.

use std::path::Path;
use std::process::Command;

use serde_json::Value;

const CURVE: &str = "[[segments]]\ntangent = \"60 ft\"\n[[segments]]\nspiral = \"60 ft\"\n[[segments]]\n\
                     curve = \"100 ft\"\ndegree = \"6 deg\"\ndirection = \"right\"\n\
                     superelevation = \"3 in\"\n[[irregularities]]\nshape = \"joints\"\nrails = \"left\"\n\
                     direction = \"vertical\"\ndepth = \"0.5 in\"\nstart = \"40 ft\"\njoints = 3\n";

fn command(folder: &Path, arguments: &[&str]) -> (Option<i32>, String, String) {
    let output = Command::new(env!("CARGO_BIN_EXE_wedgelab"))
        .current_dir(folder)
        .args(["wheelrail", "run"])
        .args(arguments)
        .env_remove("FORCE_COLOR")
        .output()
        .unwrap();
    (
        output.status.code(),
        String::from_utf8(output.stdout).unwrap(),
        String::from_utf8(output.stderr).unwrap(),
    )
}

fn folder() -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("curve.toml"), CURVE).unwrap();
    folder
}

/// The default run goes to the end of the track; table, summary and page are there and agree.
#[test]
fn reproduction_a_run_writes_table_summary_and_page() {
    let folder = folder();
    let (code, out, err) = command(
        folder.path(),
        &["aar_1b", "136re", "curve.toml", "--speed", "30 mph", "-q"],
    );
    assert_eq!(code, Some(0), "{err}");
    for part in ["left", "right", "L/V, largest", "damping ratio", "index.html"] {
        assert!(out.contains(part), "{part}\n{out}");
    }
    let own = folder.path().join("wheelset_curve");
    let table = std::fs::read_to_string(own.join("result.csv")).unwrap();
    let head: Vec<&str> = table.lines().next().unwrap().split(',').collect();
    let place = |name: &str| {
        head.iter()
            .position(|own| *own == name)
            .unwrap_or_else(|| panic!("{name}"))
    };
    let last: Vec<f64> = table
        .lines()
        .last()
        .unwrap()
        .split(',')
        .map(|cell| cell.parse().unwrap())
        .collect();
    // To a meter before the end of 220 ft, less some inches by which the flange in the curve holds it back;
    // the outer (left) wheel leads in a curve to the right.
    let distance = last[place("distance_in")] / 12.0;
    assert!((216.0..216.8).contains(&distance), "{distance}");
    assert!(last[place("lateral_in")] > 0.05);
    let summary: Value =
        serde_json::from_str(&std::fs::read_to_string(own.join("summary.json")).unwrap()).unwrap();
    assert_eq!(summary["schema"], "wedgelab.wheelset/1");
    assert_eq!(summary["complete"], true);
    assert_eq!(summary["given"]["rails"], "sprung");
    let rows = table.lines().count() - 1;
    assert_eq!(summary["rows"], rows);
    let page = std::fs::read_to_string(own.join("index.html")).unwrap();
    assert!(page.contains("A wheelset on the track curve") && page.contains("forces of the wheels"));
    let page = report::view::kept::data_in(&page).unwrap();
    for part in [
        "\"patches\":[{",
        "\"track\":{",
        "\"follow\":\"wheelset\"",
        "\"revolved\":[",
    ] {
        assert!(page.contains(part), "{part}");
    }
    let again = command(
        folder.path(),
        &["aar_1b", "136re", "curve.toml", "--speed", "30 mph", "-q"],
    );
    assert_eq!(again.0, Some(2), "{}", again.2);
    assert!(again.2.contains("--force"), "{}", again.2);
}

#[test]
fn input_mistakes_name_what_to_write() {
    let folder = folder();
    for (arguments, parts) in [
        (&["aar_1b", "136re", "curve.toml"][..], &["--speed"][..]),
        (
            &["aar_1b", "136re", "curve.toml", "--speed", "30"],
            &["the unit is missing", "m/s"],
        ),
        (
            &["aar_1b", "136re", "none.toml", "--speed", "30 mph"],
            &["none.toml"],
        ),
        (
            &["aar_9z", "136re", "curve.toml", "--speed", "30 mph"],
            &["aar_9z", "aar_1b"],
        ),
        (
            &[
                "aar_1b",
                "136re",
                "curve.toml",
                "--speed",
                "30 mph",
                "--duration",
                "60 s",
            ],
            &["67.1 m long", "lengthen"],
        ),
        (
            &[
                "aar_1b",
                "136re",
                "curve.toml",
                "--speed",
                "30 mph",
                "--yaw-stiffness",
                "2 MN/m",
            ],
            &["no stiffness against yaw", "MN m/rad"],
        ),
        (
            &[
                "aar_1b",
                "136re",
                "curve.toml",
                "--speed",
                "30 mph",
                "--lateral",
                "10 in",
            ],
            &["do not carry", "lateral place"],
        ),
        (
            &[
                "aar_1b",
                "136re",
                "curve.toml",
                "--speed",
                "30 mph",
                "--gauge",
                "52 in",
            ],
            &["gauge"],
        ),
    ] {
        let (code, _, err) = command(folder.path(), arguments);
        assert_eq!(code, Some(2), "{arguments:?}: {err}");
        let words = err.split_whitespace().collect::<Vec<_>>().join(" ");
        for part in parts {
            assert!(words.contains(part), "{part}\n{err}");
        }
    }
}
