//! Wrong input is explained.

use std::fs;
use std::process::Stdio;
use std::time::Duration;

use tempfile::tempdir;

use crate::common::{SMALL, command, done, kept, names, refused, table};

#[test]
fn input_what_is_wrong_is_shown_where_it_stands() {
    let folder = tempdir().unwrap();
    let path = folder.path();
    for (from, to, texts) in [
        (
            "friction.column",
            "friction.colum",
            ["no key `colum`", "did you mean `column`?"],
        ),
        (
            "from = 0.2, to = 0.6",
            "from = 0.6, to = 0.6",
            ["goes from 0.6 to the same", "[set]"],
        ),
        (
            "\"2500 lbf/in\"",
            "\"2500 lbf\"",
            ["do not measure the same", "a.toml:8"],
        ),
        (
            "full_factorial",
            "factorial",
            ["cannot be \"factorial\"", "full_factorial"],
        ),
    ] {
        fs::write(path.join("a.toml"), SMALL.replace(from, to)).unwrap();
        refused(path, &["study", "a.toml"], 2, &texts);
    }
    refused(
        path,
        &["study", "none.toml"],
        2,
        &["there is no study file", "docs/study.md"],
    );
    assert!(!path.join("a").exists());
}

#[test]
fn input_more_than_a_million_runs_need_a_yes() {
    let folder = tempdir().unwrap();
    let path = folder.path();
    let text = SMALL
        .replace("count = 12", "count = 2000")
        .replace("count = 10", "count = 1000");
    fs::write(path.join("a.toml"), text).unwrap();
    refused(path, &["study", "a.toml"], 2, &["2000000 runs", "--yes"]);
    assert!(!path.join("a").exists());
    // With it, it begins.
    let mut child = command(path, &["study", "a.toml", "--yes", "--quiet"])
        .stdout(Stdio::null())
        .stderr(Stdio::null())
        .spawn()
        .unwrap();
    let started = (0..3000).any(|_| {
        std::thread::sleep(Duration::from_millis(20));
        path.join("a/parts").exists() && kept(&path.join("a")) > 0
    });
    child.kill().unwrap();
    child.wait().unwrap();
    assert!(started);
}

#[test]
fn input_a_changed_study_is_refused_and_nothing_is_touched() {
    let folder = tempdir().unwrap();
    let path = folder.path();
    fs::write(path.join("a.toml"), SMALL).unwrap();
    done(path, &["study", "a.toml", "--quiet"]);
    let before = table(&path.join("a"));
    for (from, to, what) in [
        ("to = 0.6", "to = 0.5", "the parameters varied"),
        (
            "count = 12",
            "count = 13",
            "the number of runs was 120 there and is 130 now",
        ),
        ("0.12 s", "0.13 s", "what is set for all runs"),
        (
            "cdrun_toe_out_0.2_psi_0.012",
            "cdrun_toe_in_0.2_psi_0.012",
            "the case changed: `",
        ),
    ] {
        fs::write(path.join("a.toml"), SMALL.replace(from, to)).unwrap();
        refused(path, &["study", "a.toml"], 2, &["another study", what, "--out"]);
    }
    // Remarks and titles change nothing.
    fs::write(
        path.join("a.toml"),
        format!("# as before\n{}", SMALL.replace("Friction and", "More of")),
    )
    .unwrap();
    done(path, &["study", "a.toml", "--quiet"]);
    assert!(table(&path.join("a")) == before);
}

#[test]
fn input_series_of_runs_that_are_not_there() {
    let folder = tempdir().unwrap();
    let path = folder.path();
    fs::write(path.join("a.toml"), SMALL).unwrap();
    refused(
        path,
        &["study", "a.toml", "--series", "120"],
        2,
        &["no run 120", "0 to 119"],
    );
    // Those that are there may be asked for before the study.
    done(path, &["study", "a.toml", "--series", "119", "--quiet"]);
    done(path, &["study", "a.toml", "--quiet"]);
    assert_eq!(names(&path.join("a/series")), ["119"]);
}
