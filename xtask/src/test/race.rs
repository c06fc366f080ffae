//! The race's driver in C compiles, and agrees with our own integrator. What is missing (SUNDIALS) is installed.

use super::Outcome;
use crate::race::tools;
use crate::shell::{self, PORTABLE, Workspace};

/// Compiles the driver and runs the tests that need it.
pub fn check(workspace: &Workspace) -> Outcome {
    // Of the whole workspace: so the features of dependencies are those that `test` has built with.
    shell::run(&mut workspace.cargo(["build", "--release", "--workspace", "--lib"]))?;
    let driver = tools::cvode(workspace)?;
    // For Valgrind, which does not know all instructions of newer processors.
    let portable = workspace.target.join("portable");
    let mut build = workspace.cargo([
        "build",
        "--release",
        "-p",
        "race",
        "--lib",
        "--no-default-features",
    ]);
    shell::run(build.args(PORTABLE).env("CARGO_TARGET_DIR", &portable))?;
    let mut tests = workspace.cargo(["test", "--release", "--workspace", "--test", "drivers"]);
    tests
        .args(["--", "--ignored"])
        .env("RACE_CVODE", driver)
        .env("RACE_PORTABLE", portable.join("release"));
    shell::run(&mut tests)?;
    Ok(None)
}
