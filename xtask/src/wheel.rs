//! `cargo xtask wheel`: a wheel of the Python package for this platform.

use std::process::{Command, ExitCode};

use crate::shell::{self, PORTABLE, Workspace};
use crate::test::path_with;
use crate::venv;

const HELP: &str = "\
Usage: cargo xtask wheel [arguments of `maturin build`]

Builds a wheel of the Python package for this platform into target/wheels; one wheel serves Python 3.10 and \
later, on all processors:
compiled without AVX2 it takes a quarter more time for the same numbers (RUSTFLAGS in the environment \
decides otherwise). Arguments are
passed on, such as `--zig --compatibility manylinux2014`, or `--target aarch64-apple-darwin`; docs/python.md \
has recipes.";

/// Runs the command.
pub fn run(workspace: &Workspace, arguments: &[String]) -> ExitCode {
    if matches!(arguments, [only] if only == "--help" || only == "-h") {
        println!("{HELP}");
        return ExitCode::SUCCESS;
    }
    match build(workspace, arguments) {
        Ok(()) => ExitCode::SUCCESS,
        Err(message) => {
            eprintln!("{message}");
            ExitCode::FAILURE
        }
    }
}

fn build(workspace: &Workspace, arguments: &[String]) -> Result<(), String> {
    let package = workspace.root.join("crates").join("wedgelab-py");
    let requirements = package.join("requirements").join("wheel.txt");
    let python = venv::environment(&workspace.target, "wheel", &requirements)?;
    let mut command = Command::new(&python);
    command
        .args(["-m", "maturin", "build", "--release"])
        .args(PORTABLE)
        .args(arguments)
        .current_dir(&workspace.root)
        .env("CARGO_TARGET_DIR", &workspace.target)
        .env("PATH", path_with(&python)?);
    shell::run(&mut command)
}
