//! The test programs: cargo links them, and then two run at a time, so that one that waits leaves no core
//! idle; those that judge times run alone. The output of each is shown whole.

use std::io::{BufRead, BufReader};
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Mutex, PoisonError};
use std::thread;
use std::time::Instant;

use serde_json::Value;

use super::Outcome;
use crate::builds::SHARED;
use crate::shell::{self, Workspace};

/// Programs at a time. Each has as many threads as there are cores.
const BESIDE: usize = 2;
/// Programs whose tests interrupt others at some time, or call them too slow.
const ALONE: [&str; 3] = [
    "fuzz/tests/program.rs",
    "wedgelab/tests/issue_029_interrupts/main.rs",
    "wedgelab/tests/study/main.rs",
];

/// A test program.
#[derive(Debug, PartialEq)]
struct Program {
    /// Its file.
    file: PathBuf,
    /// The folder of its package, in which it runs.
    package: PathBuf,
    /// Its target's source, from that folder.
    source: String,
}

/// Builds and runs the tests of libraries and programs, in the release profile: what is tested is what
/// users run (docs/decisions/0008), and it is several times faster. The tests of what is built apart run
/// in the check `race`; benchmarks are left to `cargo xtask bench`, examples to the checks `clippy` and
/// `doctest`.
pub fn run(workspace: &Workspace) -> Outcome {
    let mut cargo = workspace.cargo(["test", "--release", "--no-run"]);
    // Targets that have tests: a library without any says `test = false`.
    cargo.args(SHARED).arg("--tests");
    shell::say("$ cargo test --release --no-run, and the programs");
    cargo
        .arg("--message-format=json-render-diagnostics")
        .stdout(Stdio::piped());
    let mut child = cargo
        .spawn()
        .map_err(|error| format!("cargo cannot be started: {error}"))?;
    let messages = child.stdout.take().ok_or("cargo says nothing")?;
    let messages = BufReader::new(messages).lines().map_while(Result::ok);
    let programs: Vec<Program> = messages.filter_map(|line| program(&line)).collect();
    let status = child.wait().map_err(|error| format!("cargo: {error}"))?;
    if !status.success() {
        return Err(format!("cargo test --no-run: {status}"));
    }
    let count = programs.len();
    let (alone, beside): (Vec<Program>, Vec<Program>) = programs.into_iter().partition(Program::judges_times);
    let mut failed = failures(&beside, BESIDE);
    failed.extend(failures(&alone, 1));
    match failed.is_empty() {
        true => Ok(Some(format!("{count} programs"))),
        false => Err(format!(
            "{} of {count} programs failed: {}",
            failed.len(),
            failed.join(", ")
        )),
    }
}

/// Runs programs, some at a time; returns the names of those that fail.
fn failures(programs: &[Program], at_a_time: usize) -> Vec<String> {
    let (next, failed) = (AtomicUsize::new(0), Mutex::new(Vec::new()));
    let work = || {
        while let Some(own) = programs.get(next.fetch_add(1, Ordering::Relaxed)) {
            if !passes(own) {
                failed
                    .lock()
                    .unwrap_or_else(PoisonError::into_inner)
                    .push(own.name());
            }
        }
    };
    thread::scope(|scope| {
        for _ in 0..at_a_time {
            scope.spawn(work);
        }
    });
    failed.into_inner().unwrap_or_else(PoisonError::into_inner)
}

/// Returns the test program that a message of cargo is about; none of other messages.
fn program(message: &str) -> Option<Program> {
    let message: Value = serde_json::from_str(message).ok()?;
    let is_test = message["reason"] == "compiler-artifact" && message["profile"]["test"] == true;
    let file = message["executable"].as_str().filter(|_| is_test)?;
    let package = Path::new(message["manifest_path"].as_str()?).parent()?;
    let source = Path::new(message["target"]["src_path"].as_str()?);
    let source = source.strip_prefix(package).unwrap_or(source);
    Some(Program {
        file: file.into(),
        package: package.to_owned(),
        source: source.display().to_string(),
    })
}

impl Program {
    fn judges_times(&self) -> bool {
        ALONE.contains(&self.name().as_str())
    }

    fn name(&self) -> String {
        let package = self.package.file_name().unwrap_or_default().to_string_lossy();
        format!("{package}/{}", self.source)
    }
}

/// Runs a program as cargo does, shows what it says, and returns whether all its tests pass.
fn passes(program: &Program) -> bool {
    let start = Instant::now();
    let output = Command::new(&program.file)
        .current_dir(&program.package)
        .env("CARGO_MANIFEST_DIR", &program.package)
        .output();
    let took = start.elapsed().as_secs_f64();
    match output {
        Err(error) => {
            shell::say(format!("{} cannot be started: {error}", program.name()));
            false
        }
        Ok(output) => {
            let texts = [&output.stdout, &output.stderr].map(|own| String::from_utf8_lossy(own));
            // One call: lines of two programs do not mix.
            shell::say(format!(
                "--- {}, {took:.1} s{}{}",
                program.name(),
                texts[0],
                texts[1]
            ));
            output.status.success()
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn test_programs_are_found_among_the_messages_of_cargo() {
        let message = |reason: &str, test: bool, executable: &str| {
            let target = "\"target\":{\"src_path\":\"/w/crates/car/tests/all/main.rs\"}";
            let package = "\"manifest_path\":\"/w/crates/car/Cargo.toml\"";
            format!(
                "{{\"reason\":\"{reason}\",{package},{target},\"profile\":{{\"test\":{test}}},\
                 \"executable\":{executable}}}"
            )
        };
        let own = program(&message("compiler-artifact", true, "\"/w/target/all-1\"")).unwrap();
        assert_eq!(own.name(), "car/tests/all/main.rs");
        assert_eq!(own.file, Path::new("/w/target/all-1"));
        for other in [
            message("compiler-artifact", false, "\"/w/target/wedgelab\""),
            message("compiler-artifact", true, "null"),
            message("build-finished", true, "\"x\""),
            "no json".to_owned(),
        ] {
            assert_eq!(program(&other), None, "{other}");
        }
    }

    #[test]
    fn a_program_that_fails_is_told() {
        let folder = tempfile::tempdir().unwrap();
        let run = |file: &str| {
            passes(&Program {
                file: file.into(),
                package: folder.path().to_owned(),
                source: "x".to_owned(),
            })
        };
        assert!(run("true") && !run("false") && !run("no_such_program_is_there"));
    }
}
