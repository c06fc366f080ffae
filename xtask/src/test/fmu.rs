//! The tests of functional mock-up units with the tools that people load them into: FMPy and libcosimpy.

use std::process::Command;

use super::Outcome;
use crate::shell::{self, Workspace};
use crate::venv;

/// Where the tests in Python and their requirements lie.
const TESTS: &str = "crates/wedgelab-fmu/tests/python";

/// Builds program and library, makes the environment if it is missing, and runs the tests.
pub fn check(workspace: &Workspace) -> Outcome {
    let packages = ["--package", "wedgelab", "--package", "wedgelab-fmu"];
    shell::run(workspace.cargo(["build", "--release"]).args(packages))?;
    let tests = workspace.root.join(TESTS);
    let python = venv::environment(&workspace.target, "fmu", &tests.join("requirements.txt"))?;
    let program = workspace
        .target
        .join("release")
        .join(format!("wedgelab{}", std::env::consts::EXE_SUFFIX));
    let mut pytest = Command::new(&python);
    pytest
        .args(["-m", "pytest", "--quiet", "-p", "no:cacheprovider"])
        .arg(&tests)
        .env("WEDGELAB", program)
        .env("PYTHONDONTWRITEBYTECODE", "1");
    shell::run(&mut pytest)?;
    Ok(None)
}
