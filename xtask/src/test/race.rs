//! The race's driver in C compiles, and agrees with our own integrator. What is missing (SUNDIALS) is
//! installed.

use super::Outcome;
use crate::race::tools;
use crate::shell::{self, Workspace};

/// Compiles the driver and runs the tests that need it.
pub fn check(workspace: &Workspace) -> Outcome {
    // Of the whole workspace: so the features of dependencies are those that `test` has built with.
    shell::run(&mut workspace.cargo(["build", "--release", "--workspace", "--lib"]))?;
    let driver = tools::cvode(workspace)?;
    // For Valgrind, which does not know all instructions of newer processors.
    let portable = workspace.build_portable(&["-p", "race", "--lib", "--no-default-features"])?;
    let mut tests = workspace.cargo(["test", "--release", "--workspace", "--test", "drivers"]);
    tests
        .args(["--", "--ignored"])
        .env("RACE_CVODE", driver)
        .env("RACE_PORTABLE", portable);
    shell::run(&mut tests)?;
    Ok(None)
}
