//! `wedgelab tables`, as a user calls it.

use crate::common;
use std::fs;

use common::{done, wedgelab};
use serde_json::Value;

const FILES: [&str; 5] = ["tables.json", "nest.csv", "nest.pwl", "warp.csv", "warp.pwl"];

/// The same bytes for any number of jobs; constants are said; each table has its errors.
#[test]
fn limits_tables_do_not_depend_on_jobs() {
    let folder = tempfile::tempdir().unwrap();
    let at = folder.path();
    let call = |out: &str, jobs: &str| {
        done(
            at,
            &[
                "tables",
                "--load",
                "50 kip",
                "--rise",
                "0.25 in",
                "--friction",
                "0.3",
                "0.5",
                "--rate",
                "4 Hz",
                "--set",
                "simulation.relative_tolerance=1e-4",
                "--quiet",
                "--jobs",
                jobs,
                "--out",
                out,
            ],
        )
    };
    let printed = call("one", "1");
    assert_eq!(
        printed.replace("Written into one", "Written into two"),
        call("two", "2")
    );
    for part in [
        "friction between two nodes",
        "half the amplitude, at a node",
        "2 nodes, 8 runs",
        "The load has one value and is a constant: 50000 lbf.",
        "Written into one: tables.json, nest.csv, nest.pwl, warp.csv, warp.pwl.",
    ] {
        assert!(printed.contains(part), "{printed}");
    }
    for file in FILES {
        let [a, b] = ["one", "two"].map(|folder| fs::read(at.join(folder).join(file)).unwrap());
        assert!(a == b, "{file}");
    }
    let summary: Value = serde_json::from_slice(&fs::read(at.join("one/tables.json")).unwrap()).unwrap();
    for table in summary["tables"].as_array().unwrap() {
        let errors = table["error"].as_array().unwrap();
        assert_eq!(errors.len(), 2);
        for own in errors {
            // Between nodes a few per cent; at the turning points of smaller loops a jump between branches.
            let per_cent = own["largest_per_cent"].as_f64().unwrap();
            let most = if own["between"].is_null() { 200.0 } else { 10.0 };
            assert!(per_cent > 0.0 && per_cent < most, "{own}");
        }
    }
}

#[test]
fn input_tables_say_what_is_wrong() {
    let folder = tempfile::tempdir().unwrap();
    for (arguments, part) in [
        (&["car_tangent_loaded"][..], "a truck's is expected"),
        (&["--rise", "0 in", "2 in"], "the pockets hold 1.5 in"),
        (&["--load", "10"], "value 1 of --load, `10`"),
        (&["--rate", "1 Hz", "1 Hz"], "does not exceed `1 Hz`"),
        (&["--stroke", "20 mrad"], "value 1 of --stroke, `20 mrad`"),
        (&["--angle", "1 rad"], "up to 0.05 rad"),
    ] {
        let output = wedgelab(folder.path(), &[&["tables"], arguments].concat());
        assert_eq!(output.code, Some(2), "{}", output.err);
        let said: Vec<&str> = output.err.split_whitespace().collect();
        assert!(said.join(" ").contains(part), "{}", output.err);
    }
    let cost = done(folder.path(), &["tables", "--cost", "--jobs", "2"]);
    assert!(cost.contains("36 nodes, 88 runs"), "{cost}");
    assert!(
        fs::read_dir(folder.path()).unwrap().next().is_none(),
        "nothing is written"
    );
}
