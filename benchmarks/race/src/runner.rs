//! Runs the contest: each run in a process of its own, with a limit, one after the other.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Child, Stdio};
use std::time::{Duration, Instant};

use serde::{Deserialize, Serialize};

use crate::contest::{Program, SOLVERS, Solver, Tools, solver};
use crate::outcome::Outcome;
use crate::problem::{Judged, RaceProblem, with_start};

/// The tolerances of the race.
pub const TOLERANCES: [&str; 12] = [
    "1e-3", "3e-4", "1e-4", "3e-5", "1e-5", "3e-6", "1e-6", "3e-7", "1e-7", "3e-8", "1e-8", "1e-9",
];
/// The solver of the reference, which is not ours, and its tolerance; the next one tells how good the
/// reference is.
pub const REFERENCE: (&str, &str, &str) = ("CVODE BDF", "1e-11", "1e-10");
/// CPU time that a reference may take, s.
const REFERENCE_LIMIT: f64 = 600.0;

/// One run of the race.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct RaceEntry {
    /// The problem.
    pub case: String,
    /// The solver.
    pub solver: String,
    /// The tolerance, as typed.
    pub tolerance: String,
    /// Rows asked for, the start included.
    pub rows: usize,
    /// The solver's report.
    pub outcome: Outcome,
}

/// The runs to make.
#[derive(Clone, Debug)]
pub struct RacePlan {
    /// Problems.
    pub cases: Vec<String>,
    /// Names of solvers.
    pub solvers: Vec<String>,
    /// Tolerances.
    pub tolerances: Vec<String>,
    /// CPU time of a run, s.
    pub limit: f64,
    /// The folder of stored runs; these are not run again.
    pub folder: PathBuf,
    /// Simulated time of the solvers that do not get the whole of it, s; none: what each of them is given.
    pub short: Option<f64>,
    /// From how many starts a case runs of which only means are compared.
    pub starts: u32,
    /// True if nothing is run: the stored results are judged.
    pub kept_only: bool,
}

impl RacePlan {
    /// Runs everything that is not there yet.
    ///
    /// # Errors
    /// Files cannot be written, or a program cannot be started.
    pub fn run(&self, tools: &Tools) -> Result<Vec<RaceEntry>, String> {
        let folder = |name: &str| {
            let folder = self.folder.join(name);
            fs::create_dir_all(&folder)
                .map_err(|error| format!("cannot make {}: {error}", folder.display()))?;
            Ok::<_, String>(folder)
        };
        folder("states")?;
        folder("runs")?;
        let mut entries = Vec::new();
        for case in &self.cases {
            let problem = RaceProblem::named(case).map_err(|error| error.to_string())?;
            let all = problem.rows();
            // One run of what is chaotic in detail is a matter of luck.
            let starts = match problem.judged {
                Judged::Means => self.starts,
                Judged::Series | Judged::Position => 1,
            };
            let reference = solver(REFERENCE.0).ok_or("the reference's solver is not in the race")?;
            for tolerance in [REFERENCE.1, REFERENCE.2] {
                for start in 0..starts {
                    let case = with_start(case, start);
                    entries.extend(self.one(tools, &case, reference, tolerance, all, REFERENCE_LIMIT)?);
                }
            }
            let wanted = |solver: &&Solver| {
                self.solvers.iter().any(|name| name == solver.name) && solver.takes_part(tools, case)
            };
            let mut spans = Vec::new();
            for one in SOLVERS.iter().filter(wanted) {
                let span = match self.short {
                    Some(short) if one.span < problem.duration => short,
                    _ => one.span,
                };
                let rows = all.min((span / problem.interval).round() as usize + 1);
                if rows < all && !spans.contains(&rows) {
                    spans.push(rows);
                }
                let starts = if rows < all { 1 } else { starts };
                entries.extend(self.tolerances(tools, case, one, rows, starts)?);
            }
            // Who has less time is compared with us over the same time.
            for rows in spans {
                for one in SOLVERS.iter().filter(|solver| solver.ours) {
                    entries.extend(self.tolerances(tools, case, one, rows, 1)?);
                }
            }
        }
        Ok(entries)
    }

    /// Returns the runs of a solver from so many starts.
    fn tolerances(
        &self,
        tools: &Tools,
        case: &str,
        one: &Solver,
        rows: usize,
        starts: u32,
    ) -> Result<Vec<RaceEntry>, String> {
        let mut entries = Vec::new();
        let mut late = None;
        // Halves of decades only where a run takes seconds at most: a front of seven points makes one of them
        // a matter of luck.
        let compiled = matches!(one.program, Program::Own | Program::Cvode);
        for tolerance in self.tolerances.iter().filter(|t| compiled || !t.starts_with('3')) {
            // Smaller tolerances only take longer there. (Multistep methods are slowest at loose ones.)
            let slow = one.method == "radau" || one.program == Program::Exudyn;
            if let (Some(at), true) = (&late, slow) {
                let outcome = Outcome {
                    failure: format!("not tried: out of time at {at} already"),
                    ..Outcome::default()
                };
                entries.push(entry(case, one, tolerance, rows, outcome));
                continue;
            }
            for start in 0..starts {
                let case = with_start(case, start);
                let Some(found) = self.one(tools, &case, one, tolerance, rows, self.limit)? else {
                    continue;
                };
                if found.outcome.failure.contains("out of time") {
                    late = Some(tolerance.clone());
                }
                let failed = !found.outcome.failure.is_empty();
                entries.push(found);
                // What fails from one start has failed.
                if failed {
                    break;
                }
            }
        }
        Ok(entries)
    }

    /// Makes one run, or returns its stored outcome.
    fn one(
        &self,
        tools: &Tools,
        case: &str,
        one: &Solver,
        tolerance: &str,
        rows: usize,
        limit: f64,
    ) -> Result<Option<RaceEntry>, String> {
        let kept = self
            .folder
            .join("runs")
            .join(format!("{}.json", name(case, one.name, tolerance, rows)));
        if let Ok(text) = fs::read_to_string(&kept) {
            return Ok(serde_json::from_str(&text).ok());
        }
        if self.kept_only {
            return Ok(None);
        }
        let file = states_file(&self.folder, case, one.name, tolerance, rows);
        let Some(mut command) = one.command(tools, case, tolerance, limit, &file, rows) else {
            return Ok(None);
        };
        let child = command
            .stdout(Stdio::piped())
            .stderr(Stdio::piped())
            .spawn()
            .map_err(|error| format!("{} cannot be started: {error}", one.name))?;
        let outcome = wait(child, Duration::from_secs_f64(30.0 + 8.0 * limit));
        let found = entry(case, one, tolerance, rows, outcome);
        println!(
            "{case:28} {:18} {tolerance:>6} {:>10.2} ms {:>9} steps  {}",
            one.name,
            1e3 * found.outcome.cpu,
            found.outcome.steps,
            found.outcome.failure
        );
        let text = serde_json::to_string(&found).map_err(|error| error.to_string())?;
        fs::write(&kept, text).map_err(|error| format!("cannot write {}: {error}", kept.display()))?;
        Ok(Some(found))
    }
}

fn entry(case: &str, solver: &Solver, tolerance: &str, rows: usize, outcome: Outcome) -> RaceEntry {
    RaceEntry {
        case: case.to_owned(),
        solver: solver.name.to_owned(),
        tolerance: tolerance.to_owned(),
        rows,
        outcome,
    }
}

fn name(case: &str, solver: &str, tolerance: &str, rows: usize) -> String {
    format!("{case}__{}__{tolerance}__{rows}", solver.replace(' ', "_"))
}

/// Returns the path of the states of a run.
#[must_use]
pub fn states_file(folder: &Path, case: &str, solver: &str, tolerance: &str, rows: usize) -> PathBuf {
    let name = name(case, solver, tolerance, rows);
    folder.join("states").join(format!("{name}.f64"))
}

/// Waits for a driver's line, but no longer than this.
fn wait(mut child: Child, longest: Duration) -> Outcome {
    let failed = |failure: String| Outcome {
        failure,
        ..Outcome::default()
    };
    let started = Instant::now();
    loop {
        match child.try_wait() {
            Ok(Some(_)) => break,
            Ok(None) if started.elapsed() > longest => {
                let _ = child.kill();
                let _ = child.wait();
                return failed(format!(
                    "out of time: stopped after {:.0} s",
                    longest.as_secs_f64()
                ));
            }
            Ok(None) => std::thread::sleep(Duration::from_millis(5)),
            Err(error) => return failed(error.to_string()),
        }
    }
    let output = match child.wait_with_output() {
        Ok(output) => output,
        Err(error) => return failed(error.to_string()),
    };
    let text = String::from_utf8_lossy(&output.stdout);
    let line = text.lines().rev().find(|line| line.starts_with('{'));
    match line.map(serde_json::from_str::<Outcome>) {
        Some(Ok(outcome)) => outcome,
        _ => {
            let complaint = String::from_utf8_lossy(&output.stderr);
            let last = complaint.lines().rev().find(|line| !line.trim().is_empty());
            failed(format!("{}: {}", output.status, last.unwrap_or("no word")))
        }
    }
}
