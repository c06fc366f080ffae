//! `reproduce`.

use std::path::Path;

use tempfile::tempdir;

use crate::common::{SIGNALS, contains, hidden, names, start, start_by_shell, whole_run};

/// The runs that are there are whole, and nothing else is; returns their names.
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
        let told = format!("interrupted: {} of 6 runs are whole, in my own/runs", kept.len());
        contains(&ended.err, &[&told, "the report is not written"]);
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
    let told = format!("{} of {} runs are whole", kept.len(), kept.len() + missing.len());
    contains(&ended.err, &[&told, "wedgelab reproduce --force"]);
    assert!(missing.iter().all(|name| !kept.iter().any(|kept| kept == name)));
}
