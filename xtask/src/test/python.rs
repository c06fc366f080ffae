//! The Python package: built and installed with pip into an environment made for it, its tests, types and
//! notebooks.

use std::path::{Path, PathBuf};
use std::process::Command;

use super::Outcome;
use crate::shell::{self, Workspace};
use crate::venv;

/// Installs the package and runs its checks.
pub fn check(workspace: &Workspace) -> Outcome {
    let package = workspace.root.join("crates").join("wedgelab-py");
    let requirements = package.join("requirements").join("test.txt");
    let python = venv::environment(&workspace.target, "python", &requirements)?;
    install(workspace, &python)?;
    let run = |arguments: &[&str]| {
        let mut command = Command::new(&python);
        command.args(arguments).current_dir(&workspace.root);
        shell::run(&mut command)
    };
    run(&["-m", "mypy"])?;
    // Stubs against the native part itself; what nobody may make or inherit from needs no more than its
    // methods.
    run(&[
        "-m",
        "mypy.stubtest",
        "wedgelab._wedgelab",
        "--mypy-config-file",
        "pyproject.toml",
    ])?;
    run(&["-m", "pytest", "--quiet"])?;
    Ok(shell::output(Command::new(&python).arg("--version")))
}

/// `pip install .`, from the release build that the tests before it have made in the same folder.
fn install(workspace: &Workspace, python: &Path) -> Result<(), String> {
    let pip = [
        "-m",
        "pip",
        "install",
        "--quiet",
        "--disable-pip-version-check",
        "--force-reinstall",
        "--no-deps",
        // maturin is one of the requirements: nothing is fetched, and cargo's work is not thrown away.
        "--no-build-isolation",
        ".",
    ];
    let mut command = Command::new(python);
    command
        .args(pip)
        .current_dir(&workspace.root)
        .env("CARGO_TARGET_DIR", &workspace.target)
        .env("PATH", path_with(python)?);
    shell::run(&mut command)
}

/// Returns the search path with the programs of the environment in front.
pub fn path_with(python: &Path) -> Result<std::ffi::OsString, String> {
    let own = python.parent().map(Path::to_path_buf).into_iter();
    let all = std::env::var_os("PATH").unwrap_or_default();
    let all: Vec<PathBuf> = own.chain(std::env::split_paths(&all)).collect();
    std::env::join_paths(all).map_err(|error| format!("the search path cannot be set: {error}"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn programs_of_the_environment_come_first() {
        let folder = Path::new("somewhere").join("bin");
        let path = path_with(&folder.join("python")).unwrap();
        assert_eq!(std::env::split_paths(&path).next(), Some(folder));
    }
}
