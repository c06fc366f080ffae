//! `wedgelab probability`, as a user calls it.

use crate::common;
use std::fs;

use common::{done, wedgelab};

/// Twelve short runs of a wedge and six of indices.
const PLAN: &str = r#"case = "cdrun_toe_out_0.2_psi_0.012"
measure = "lift_off_time_column"
at_most = "0.1 s"
method = "latin_hypercube"
runs = 12
indices = 2
[set]
simulation.duration = "0.1 s"
simulation.relative_tolerance = 1e-4
[uncertain.friction.column]
distribution = "triangular"
from = 0.3
mode = 0.4
to = 0.55
also = ["friction.slope"]
mark = "guess"
"#;

const NAMES: [&str; 5] = [
    "probability.json",
    "probability.csv",
    "probability.svg",
    "probability.png",
    "probability.txt",
];

/// A plan that goes on where it was killed writes the same files, with any number of jobs, and runs only what
/// is missing; what is counted takes another limit without a run.
#[test]
fn limits_a_probability_goes_on_with_the_same_bytes() {
    let folder = tempfile::tempdir().unwrap();
    let at = folder.path();
    let subset = PLAN
        .replace(
            "\"latin_hypercube\"\nruns = 12",
            "\"subset\"\nsamples = 20\nrepeats = 4\nmost_runs = 200",
        )
        .replace("lift_off_time_column", "peak_side_frame_pitch_moment")
        .replace("\"0.1 s\"\nmethod", "\"4000 lbf in\"\nmethod");
    for (name, plan) in [("count", PLAN), ("subset", &subset)] {
        fs::write(at.join(format!("{name}.toml")), plan).unwrap();
        let file = format!("{name}.toml");
        let run = |jobs: &str, out: &str| {
            done(
                at,
                &["probability", &file, "--quiet", "--jobs", jobs, "--out", out],
            )
        };
        let read = |out: &str| NAMES.map(|own| fs::read(at.join(out).join(own)).unwrap());
        run("2", "first");
        let first = read("first");
        run("1", "second");
        assert_eq!(first, read("second"), "{name}");
        // Of a record that was cut off nothing is left but its run's number.
        let part = at.join("second/parts/part-000000");
        let bytes = fs::read(&part).unwrap();
        fs::write(&part, &bytes[..bytes.len() - 40]).unwrap();
        fs::remove_file(at.join("second/probability.csv")).unwrap();
        run("1", "second");
        assert_eq!(first, read("second"), "{name}");
        // What was left of that record, and that record alone.
        let added = fs::read(&part).unwrap().len() - bytes.len();
        assert!((1..400).contains(&added), "{name}: {added}");
        for out in ["first", "second"] {
            fs::remove_dir_all(at.join(out)).unwrap();
        }
    }
}

#[test]
fn limits_a_count_takes_another_limit_without_a_run() {
    let folder = tempfile::tempdir().unwrap();
    let at = folder.path();
    fs::write(at.join("plan.toml"), PLAN).unwrap();
    let stdout = done(at, &["probability", "plan.toml", "--quiet"]);
    assert!(
        stdout.contains("12 runs can tell no probability less than"),
        "{stdout}"
    );
    assert!(
        stdout.contains("friction.column, friction.slope triangular from 0.3 to 0.55"),
        "{stdout}"
    );
    let part = at.join("plan_probability/parts/part-000000");
    let before = fs::read(&part).unwrap();
    fs::write(
        at.join("plan.toml"),
        PLAN.replace("at_most = \"0.1 s\"", "at_least = \"1 s\""),
    )
    .unwrap();
    let stdout = done(at, &["probability", "plan.toml", "--quiet"]);
    assert!(stdout.contains("12 beyond the limit"), "{stdout}");
    assert_eq!(before, fs::read(&part).unwrap());
    fs::write(at.join("plan.toml"), PLAN.replace("0.55", "0.5")).unwrap();
    let output = wedgelab(at, &["probability", "plan.toml"]);
    assert!(
        output.err.contains("the uncertain parameters or their"),
        "{}",
        output.err
    );
}

/// A measure that no run has says nothing, and says so.
#[test]
fn limits_runs_without_a_value_are_told() {
    let folder = tempfile::tempdir().unwrap();
    let at = folder.path();
    let plan = PLAN.replace("lift_off_time_column", "energy_per_cycle_side_frame");
    fs::write(
        at.join("plan.toml"),
        plan.replace("\"0.1 s\"\nmethod", "\"9000 lbf in\"\nmethod"),
    )
    .unwrap();
    let stdout = done(at, &["probability", "plan.toml", "--quiet"]);
    for words in [
        "not told: it may be anything from 0 to 1",
        "12 of which it is not known",
        "have no value: the run has no energy_per_cycle_side_frame",
    ] {
        assert!(stdout.contains(words), "{words}: {stdout}");
    }
}
