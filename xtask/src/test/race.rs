//! The tests of the race and of the benchmarks; the race's driver in C compiles, and agrees with our own
//! integrator. SUNDIALS is installed if it is missing.

use super::Outcome;
use crate::builds::{self, APART};
use crate::race::tools;
use crate::shell::{self, Workspace};

/// Runs the tests, compiles the driver and runs the tests that need it.
pub fn check(workspace: &Workspace) -> Outcome {
    let mut tests = workspace.cargo(["test", "--release", "--no-fail-fast"]);
    shell::run(tests.args(APART))?;
    let driver = tools::cvode(workspace, &builds::portable_libraries(workspace)?)?;
    let mut tests = workspace.cargo(["test", "--release"]);
    tests
        .args(APART)
        .args(["--test", "drivers", "--", "--ignored"])
        .env("RACE_CVODE", driver);
    shell::run(&mut tests)?;
    Ok(None)
}
