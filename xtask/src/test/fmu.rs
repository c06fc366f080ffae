//! The tests of functional mock-up units with the tools that people load them into, FMPy and libcosimpy, and
//! with a program in C that calls every function, under Valgrind too.

use std::process::Command;

use super::Outcome;
use crate::debian;
use crate::shell::{self, Workspace};
use crate::venv;

/// Where the tests in Python and their requirements lie.
const TESTS: &str = "crates/wedgelab-fmu/tests/python";

/// Builds program and library, installs `gcc` and `valgrind` if they are missing, makes the environment if it
/// is missing, and runs the tests.
pub fn check(workspace: &Workspace) -> Outcome {
    debian::need(&["gcc", "valgrind"])?;
    // All of it: so the features of dependencies are those that `test` has built with.
    shell::run(&mut workspace.cargo(["build", "--release", "--workspace"]))?;
    let tests = workspace.root.join(TESTS);
    // Compiled for all processors the library is to compute the same bits; and Valgrind does not know all
    // instructions of the newer ones.
    let portable = workspace.build_portable(&["-p", "wedgelab-fmu"])?;
    let library = portable.join(format!(
        "{}wedgelab_fmu{}",
        std::env::consts::DLL_PREFIX,
        std::env::consts::DLL_SUFFIX
    ));
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
        .env("PORTABLE_LIBRARY", library)
        .env("PYTHONDONTWRITEBYTECODE", "1");
    shell::run(&mut pytest)?;
    Ok(None)
}
