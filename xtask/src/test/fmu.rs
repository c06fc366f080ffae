//! The tests of functional mock-up units with the tools that people load them into, FMPy and libcosimpy, and
//! with a program in C that calls every function, under Valgrind too.

use std::process::Command;

use super::Outcome;
use crate::builds;
use crate::debian;
use crate::shell::{self, Workspace};
use crate::venv;

/// The folder of the tests in Python and their requirements.
const TESTS: &str = "crates/wedgelab-fmu/tests/python";

/// Builds program and library, installs `gcc` and `valgrind` if they are missing, makes the environment if it
/// is missing, and runs the tests.
pub fn check(workspace: &Workspace) -> Outcome {
    debian::need(&["gcc", "valgrind"])?;
    let program = builds::wedgelab(workspace)?;
    let library = builds::portable_library(workspace, "wedgelab-fmu")?.join(builds::library("wedgelab_fmu"));
    let tests = workspace.root.join(TESTS);
    let python = venv::environment(&workspace.target, "fmu", &tests.join("requirements.txt"))?;
    let mut pytest = Command::new(&python);
    pytest
        .args(["-m", "pytest", "--quiet", "-p", "no:cacheprovider"])
        // On all cores; two tests take more than half of the time, so whoever has nothing to do takes over.
        .args(["--numprocesses", "auto", "--dist", "worksteal"])
        .arg(&tests)
        .env("WEDGELAB", program)
        .env("PORTABLE_LIBRARY", library)
        .env("PYTHONDONTWRITEBYTECODE", "1");
    shell::run(&mut pytest)?;
    Ok(None)
}
