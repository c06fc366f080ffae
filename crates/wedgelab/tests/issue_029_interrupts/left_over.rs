//! The next start names and removes leftovers of killed runs; files of living runs are not touched.

use std::path::Path;

use tempfile::tempdir;

use crate::common::{Running, contains, done, hidden, names, start, whole_run};

/// A run of many rows: they are computed in a moment and written for longer.
const MANY_ROWS: [&str; 6] = [
    "run",
    "vdrun_toe_0_psi_0",
    "--set",
    "simulation.output_interval=0.0001 s",
    "--set",
    "simulation.duration=5 s",
];

/// Returns whether a result is being written in a folder.
fn is_writing(folder: &Path) -> bool {
    let hidden = hidden(folder);
    hidden.iter().any(|path| path.join("result/result.csv").exists())
}

/// Starts a run and comes back when it writes its result.
fn start_writing(folder: &Path, more: &[&str]) -> Running {
    let mut running = start(folder, &[&MANY_ROWS, more].concat());
    running.wait_until(|| is_writing(folder));
    running
}

const SHORT: [&str; 5] = [
    "run",
    "vdrun_toe_0_psi_0",
    "--set",
    "simulation.duration=0.05 s",
    "--out",
];

#[test]
fn issue_029_the_next_start_removes_what_a_killed_run_left() {
    let folder = tempdir().unwrap();
    let path = folder.path();
    // Beside the destination, which is new; the next run is another one.
    assert!(start_writing(path, &["--out", "a"]).kill());
    let left = names(path);
    assert!(left.len() == 1 && left[0].starts_with(".wedgelab-"), "{left:?}");
    let said = done(path, &[&SHORT[..], &["b"]].concat());
    let removed = format!("removed `{}`, left by a run that was killed\n", left[0]);
    contains(&said.err, &[&removed]);
    assert_eq!(names(path), ["b"]);
    // In the destination, which exists.
    assert!(start_writing(path, &["--out", "b", "--force"]).kill());
    let left = names(&path.join("b"));
    assert!(left.len() == 6 && left[0].starts_with(".wedgelab-"), "{left:?}");
    assert_eq!(whole_run(&path.join("b"))["rows"], 6);
    let said = done(path, &[&SHORT[..], &["b", "--force", "--quiet"]].concat());
    contains(
        &said.err,
        &[&format!(
            "removed `b/{}`, left by a run that was killed\n",
            left[0]
        )],
    );
    assert_eq!(names(&path.join("b")).len(), 5);
    let said = done(path, &[&SHORT[..], &["b", "--force"]].concat());
    assert!(!said.err.contains("removed"), "{}", said.err);
    // One that is refused removes nothing.
    assert!(start_writing(path, &["--out", "b", "--force"]).kill());
    let refused = start(path, &[&SHORT[..], &["b"]].concat()).ended();
    assert_eq!(refused.code, Some(2), "{}", refused.err);
    assert!(!refused.err.contains("removed") && hidden(path).len() == 1);
}

#[test]
fn issue_029_what_a_living_run_writes_is_not_touched() {
    let folder = tempdir().unwrap();
    let path = folder.path();
    let mut writing = start_writing(path, &["--out", "a"]);
    writing.send("STOP");
    let living = hidden(path);
    assert!(writing.is_working() && living.len() == 1, "{living:?}");
    for out in ["b", "a/b"] {
        let said = done(path, &[&SHORT[..], &[out]].concat());
        assert!(!said.err.contains("removed"), "{}", said.err);
        assert_eq!(hidden(path), living);
    }
    std::fs::remove_dir_all(path.join("a")).unwrap();
    writing.send("CONT");
    let ended = writing.ended();
    assert_eq!(ended.code, Some(0), "{}", ended.err);
    assert_eq!(whole_run(&path.join("a"))["rows"], 50_001);
    assert!(hidden(path).is_empty());
}

/// A first signal lets the result be written; a second one does not wait for that.
#[test]
fn issue_029_a_second_signal_while_writing_leaves_nothing() {
    let folder = tempdir().unwrap();
    let path = folder.path();
    let mut writing = start_writing(path, &["--out", "deep/er/a"]);
    writing.send("STOP");
    assert!(writing.is_working());
    // They come in the order of their numbers when it goes on.
    writing.send("INT");
    writing.send("TERM");
    writing.send("CONT");
    let ended = writing.ended();
    assert!([Some(130), Some(143)].contains(&ended.code), "{}", ended.err);
    contains(
        &ended.err,
        &[
            "stopping: what was computed is written",
            "interrupted: nothing was written",
        ],
    );
    assert!(names(path).is_empty(), "{:?}", names(path));
}
