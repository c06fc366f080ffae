//! The tests of the race and of the benchmarks; the race's driver in C compiles, and agrees with our own
//! integrator; its equations in Octave agree with the compiled ones. SUNDIALS and Octave are installed if
//! they are missing.

use super::{Outcome, octave};
use crate::builds::{self, APART};
use crate::race::tools;
use crate::shell::{self, Workspace};

/// Runs the tests, compiles the driver and runs the tests that need it.
pub fn check(workspace: &Workspace) -> Outcome {
    let mut tests = workspace.cargo(["test", "--release", "--no-fail-fast"]);
    shell::run(tests.args(APART))?;
    let driver = tools::cvode(workspace, &builds::portable_library(workspace, "race")?)?;
    let mut tests = workspace.cargo(["test", "--release"]);
    tests
        .args(APART)
        .args(["--test", "drivers", "--", "--ignored"])
        .env("RACE_CVODE", driver);
    shell::run(&mut tests)?;
    octave::tests(workspace, &APART)
}
