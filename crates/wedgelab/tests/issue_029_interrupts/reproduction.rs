//! `reproduce`.

use std::fs;
use std::path::Path;

use tempfile::tempdir;

use crate::common::{SIGNALS, contains, done, hidden, names, start, start_by_shell, whole_run};

/// Checks that the runs that are there are whole, and that nothing else is there; returns their names.
fn whole_runs(folder: &Path) -> Vec<String> {
    assert!(hidden(folder).is_empty());
    assert_eq!(names(folder), ["runs"], "there is no report");
    let runs = names(&folder.join("runs"));
    for name in &runs {
        assert_eq!(
            whole_run(&folder.join("runs").join(name))["complete"],
            true,
            "{name}"
        );
    }
    runs
}

#[test]
fn issue_029_an_interrupted_reproduction_keeps_whole_runs_and_tells_the_missing_ones() {
    for (signal, code) in SIGNALS {
        let folder = tempdir().unwrap();
        let path = folder.path();
        let mut running = start(
            path,
            &["reproduce", "--out", "my own", "--only", "vdrun*", "--jobs", "1"],
        );
        let runs = path.join("my own/runs");
        running.wait_until(|| names(&runs).iter().any(|name| name.starts_with("vdrun")));
        running.send(signal);
        let ended = running.ended();
        assert_eq!(ended.code, Some(code), "{}", ended.err);
        let kept = whole_runs(&path.join("my own"));
        let message = format!("interrupted: {} of 6 runs are whole, in my own/runs", kept.len());
        contains(&ended.err, &[&message, "the report is not written"]);
        contains(
            &ended.err,
            &["wedgelab reproduce --out 'my own' --force --only 'vdrun*'"],
        );
        // The command for the missing ones, as it was told.
        let mut lines = ended.err.lines();
        assert!(lines.any(|line| line.starts_with("The missing runs of the wedge alone")));
        let line = lines.next().unwrap().trim().strip_prefix("wedgelab ").unwrap();
        let missing: Vec<&str> = line.split("--only ").nth(1).unwrap().split(' ').collect();
        assert_eq!(kept.len() + missing.len(), 6);
        assert!(missing.iter().all(|name| !kept.iter().any(|kept| kept == name)));
        let rest = start_by_shell(path, &format!("exec \"$0\" {line}")).ended();
        assert_eq!(rest.code, Some(0), "{}", rest.err);
        assert_eq!(names(&runs).len(), 6);
    }
}

/// With the half-truck's runs.
#[test]
fn issue_029_an_interrupted_reproduction_tells_the_missing_half_trucks() {
    let folder = tempdir().unwrap();
    let path = folder.path();
    let mut running = start(path, &["reproduce", "--quiet"]);
    let runs = path.join("reproduction/runs");
    running.wait_until(|| names(&runs).iter().any(|name| name.starts_with("nucars")));
    running.send("TERM");
    let ended = running.ended();
    assert_eq!(ended.code, Some(143), "{}", ended.err);
    let kept = whole_runs(&path.join("reproduction"));
    let lines: Vec<&str> = ended.err.lines().collect();
    let after = |text: &str| {
        let place = lines.iter().position(|line| line.starts_with(text)).unwrap();
        lines[place + 1]
    };
    let wedges = after("The missing runs of the wedge alone")
        .split("--only ")
        .nth(1)
        .unwrap();
    let trucks = after("The missing runs of trucks").trim();
    let missing: Vec<&str> = wedges.split(' ').chain(trucks.split(' ')).collect();
    let message = format!("{} of {} runs are whole", kept.len(), kept.len() + missing.len());
    contains(&ended.err, &[&message, "wedgelab reproduce --force"]);
    assert!(missing.iter().all(|name| !kept.iter().any(|kept| kept == name)));
}

/// Points of the space of what the thesis leaves open are kept; the same command goes on from there, and what
/// comes out depends neither on that nor on the number of jobs.
#[test]
fn limits_an_interrupted_sensitivity_goes_on_with_the_same_bytes() {
    let folder = tempdir().unwrap();
    let path = folder.path();
    let of = |jobs: &'static str, out: &'static str| {
        let only = ["--only", "cdrun_toe_0_psi_0", "--jobs", jobs, "--out", out];
        [&["reproduce", "--sensitivity", "1"], only.as_slice()].concat()
    };
    let points =
        |out: &str| fs::read_to_string(path.join(out).join("sensitivity/points.jsonl")).unwrap_or_default();
    let mut running = start(path, &of("1", "one"));
    running.wait_until(|| points("one").lines().count() > 2);
    running.send("INT");
    let ended = running.ended();
    assert_eq!(ended.code, Some(130), "{}", ended.err);
    let before = points("one");
    let kept = before.lines().count();
    let message = format!("interrupted: {kept} of 17 points are kept in one/sensitivity");
    contains(&ended.err, &[&message, "the same command goes on from there"]);
    assert_eq!(names(&path.join("one")), ["sensitivity"]);
    let ended = done(path, &of("1", "one"));
    contains(&ended.err, &[&format!("going on: {kept} of 17 points are there")]);
    contains(
        &ended.out,
        &["Over 1 points of what the thesis leaves open", "sensitivity.json"],
    );
    let whole = points("one");
    assert!(whole.starts_with(&before) && whole.lines().count() == 17);

    // Another number of jobs, in another order, with a line that was cut off.
    let lines: Vec<&str> = whole.lines().rev().collect();
    let cut = lines[..16].join("\n");
    fs::create_dir_all(path.join("two/sensitivity")).unwrap();
    fs::copy(
        path.join("one/sensitivity/space.json"),
        path.join("two/sensitivity/space.json"),
    )
    .unwrap();
    fs::write(path.join("two/sensitivity/points.jsonl"), &cut[..cut.len() - 20]).unwrap();
    done(path, &of("2", "two"));
    for file in ["sensitivity.json", "index.html"] {
        let read = |out: &str| fs::read(path.join(out).join(file)).unwrap();
        assert!(read("one") == read("two"), "{file}");
    }
}
