//! The running of checks: those that compile one after the other, then the others beside each other, as many
//! at a time as there are cores; and the table of the results.

use std::fs;
use std::num::NonZero;
use std::sync::Mutex;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::thread;
use std::time::{Duration, Instant};

use super::{Check, Outcome};
use crate::shell::{self, Workspace};

/// A check and, if it ran, how long it took and what came out.
pub struct Line {
    name: &'static str,
    result: Option<(Duration, Outcome)>,
}

/// Runs the checks; after a failure only those that are under way if `fail_fast`. Lines come in the order of
/// the checks.
pub fn run_checks(checks: &[&Check], fail_fast: bool, workspace: &Workspace) -> Vec<Line> {
    let stopped = AtomicBool::new(false);
    let run = |check: &Check, kept: bool| {
        if stopped.load(Ordering::Relaxed) {
            return None;
        }
        let result = match kept {
            true => run_kept(check, workspace),
            false => run_shown(check, workspace),
        };
        if fail_fast && result.1.is_err() {
            stopped.store(true, Ordering::Relaxed);
        }
        Some(result)
    };
    let mut results: Vec<_> = checks
        .iter()
        .map(|check| if check.beside { None } else { run(check, false) })
        .collect();
    let beside: Vec<usize> = (0..checks.len()).filter(|own| checks[*own].beside).collect();
    let cores = thread::available_parallelism().map_or(1, NonZero::get);
    let next = AtomicUsize::new(0);
    let ended = Mutex::new(&mut results);
    let work = || {
        while let Some(own) = beside.get(next.fetch_add(1, Ordering::Relaxed)) {
            let result = run(checks[*own], beside.len() > 1);
            if let Ok(mut ended) = ended.lock() {
                ended[*own] = result;
            }
        }
    };
    thread::scope(|scope| {
        for _ in 0..cores.min(beside.len()) {
            scope.spawn(work);
        }
    });
    let names = checks.iter().map(|check| check.name);
    names
        .zip(results)
        .map(|(name, result)| Line { name, result })
        .collect()
}

/// Runs a check whose output is shown as it comes.
fn run_shown(check: &Check, workspace: &Workspace) -> (Duration, Outcome) {
    println!("{}", heading(check));
    let start = Instant::now();
    let outcome = (check.run)(workspace);
    let took = start.elapsed();
    println!("{}", ending(check, took, &outcome));
    (took, outcome)
}

/// Runs a check whose output goes into `checks/<name>.txt` in the folder that cargo builds into, and is shown
/// whole when the check has ended.
fn run_kept(check: &Check, workspace: &Workspace) -> (Duration, Outcome) {
    let folder = workspace.target.join("checks");
    let file = folder.join(format!("{}.txt", check.name));
    let start = Instant::now();
    let outcome = fs::create_dir_all(&folder)
        .and_then(|()| fs::File::create(&file))
        .map_err(|error| format!("{} cannot be written: {error}", file.display()))
        .and_then(|out| shell::into_file(out, || (check.run)(workspace)));
    let took = start.elapsed();
    let output = fs::read(&file).unwrap_or_default();
    let output = String::from_utf8_lossy(&output);
    // One call: lines of two checks do not mix.
    println!("{}\n{output}{}", heading(check), ending(check, took, &outcome));
    (took, outcome)
}

fn heading(check: &Check) -> String {
    format!("\n=== {}: {}", check.name, check.about)
}

fn ending(check: &Check, took: Duration, outcome: &Outcome) -> String {
    let (name, took) = (check.name, duration(took));
    match outcome {
        Ok(Some(note)) => format!("=== {name}: ok, {took} ({note})"),
        Ok(None) => format!("=== {name}: ok, {took}"),
        Err(message) => format!("{message}\n=== {name}: FAILED, {took}"),
    }
}

/// Returns whether nothing failed and nothing was left out.
pub fn passed(results: &[Line]) -> bool {
    results.iter().all(|line| matches!(line.result, Some((_, Ok(_)))))
}

fn duration(took: Duration) -> String {
    let seconds = took.as_secs_f64();
    if seconds < 60.0 {
        return format!("{seconds:.1} s");
    }
    let seconds = seconds.round() as u64;
    format!("{} min {:02} s", seconds / 60, seconds % 60)
}

/// Returns the table of the results, with the time of each check and the time of all.
pub fn table(results: &[Line], whole: Duration) -> String {
    let row = |name: &str, result: &str, time: &str, note: &str| {
        format!("{name:<12}{result:<9}{time:>13}  {note}")
            .trim_end()
            .to_owned()
    };
    let mut rows = vec![row("check", "result", "time", "")];
    for line in results {
        rows.push(match &line.result {
            None => row(line.name, "not run", "", ""),
            Some((took, Ok(note))) => row(line.name, "ok", &duration(*took), note.as_deref().unwrap_or("")),
            Some((took, Err(_))) => row(line.name, "FAILED", &duration(*took), ""),
        });
    }
    let result = if passed(results) { "ok" } else { "FAILED" };
    rows.push(row("total", result, &duration(whole), ""));
    rows.join("\n")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_failure_does_not_hide_the_others() {
        let checks = [
            Check::new("a", "", |_| Ok(Some("a note".to_owned()))),
            Check::new("b", "", |_| Err("broken".to_owned())),
            Check::new("c", "", |_| Ok(None)),
        ];
        let checks: Vec<&Check> = checks.iter().collect();
        let workspace = Workspace::find();

        let all = run_checks(&checks, false, &workspace);
        assert!(all.iter().all(|line| line.result.is_some()) && !passed(&all));
        let text = table(&all, Duration::ZERO);
        assert!(text.contains("a note") && text.contains("FAILED"), "{text}");

        let fast = run_checks(&checks, true, &workspace);
        assert!(fast[2].result.is_none() && !passed(&fast));
        assert!(table(&fast, Duration::ZERO).contains("c           not run"));

        assert!(passed(&run_checks(&checks[..1], true, &workspace)));
    }

    #[test]
    fn durations_read_well() {
        assert_eq!(duration(Duration::from_millis(440)), "0.4 s");
        assert_eq!(duration(Duration::from_secs(123)), "2 min 03 s");
    }

    #[test]
    fn checks_beside_others_keep_their_output_their_place_and_their_failures() {
        let folder = tempfile::tempdir().unwrap();
        let mut workspace = Workspace::find();
        workspace.target = folder.path().to_path_buf();
        let checks = [
            Check::new("a", "", |_| {
                shell::say("said by a");
                shell::run(std::process::Command::new("cargo").arg("--version"))?;
                Ok(Some("note of a".to_owned()))
            })
            .beside(),
            Check::new("b", "", |_| Ok(None)),
            Check::new("c", "", |_| Err("broken".to_owned())).beside(),
        ];
        let checks: Vec<&Check> = checks.iter().collect();
        let all = run_checks(&checks, false, &workspace);
        let results: Vec<bool> = all
            .iter()
            .map(|line| matches!(line.result, Some((_, Ok(_)))))
            .collect();
        assert_eq!(results, [true, true, false]);
        assert!(table(&all, Duration::ZERO).contains("note of a"));
        let output = fs::read_to_string(folder.path().join("checks/a.txt")).unwrap();
        assert!(
            output.starts_with("said by a\n$ cargo --version\ncargo 1"),
            "{output}"
        );
    }
}
