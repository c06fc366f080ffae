//! Builds for the checks, so that nothing is compiled twice.
//!
//! Cargo compiles a dependency anew for every set of its features, and the set depends on the crates that are
//! selected, tests among them. The crates of [`SHARED`] ask for the same features as a user's `cargo build`:
//! one build of every dependency serves users, tests, doc tests and broken inputs. The check `features` holds
//! them to it. Other crates bring dependencies with features of their own: the race diffsol, the benchmarks
//! Criterion. The Python package asks for the same through the crate `features`.

use std::env::consts::{DLL_PREFIX, DLL_SUFFIX, EXE_SUFFIX};
use std::path::PathBuf;
use std::process::Command;
use std::sync::OnceLock;

use crate::shell::{self, PORTABLE, Workspace};

/// Selects the crates that share every dependency with the programs that users build.
pub const SHARED: [&str; 7] = [
    "--workspace",
    "--exclude",
    "benchmarks",
    "--exclude",
    "race",
    "--exclude",
    "wedgelab-py",
];

/// Selects the benchmarks and the race without its figures, which draw as reports do: reports are not
/// compiled once more.
pub const APART: [&str; 7] = [
    "--package",
    "benchmarks",
    "--package",
    "race",
    "--no-default-features",
    "--features",
    "race/solvers",
];

/// Builds programs of [`SHARED`] in the release profile and returns their folder.
///
/// # Errors
/// They do not compile.
pub fn programs(workspace: &Workspace, targets: &[&str]) -> Result<PathBuf, String> {
    let mut build = workspace.cargo(["build", "--release"]);
    shell::run(build.args(SHARED).args(targets))?;
    Ok(workspace.target.join("release"))
}

/// Builds the command `wedgelab` and returns its path.
///
/// # Errors
/// It does not compile.
pub fn wedgelab(workspace: &Workspace) -> Result<PathBuf, String> {
    let folder = programs(workspace, &["--bin", "wedgelab"])?;
    Ok(folder.join(format!("wedgelab{EXE_SUFFIX}")))
}

/// Builds the command `wedgelab` and makes a report with it, once for all checks; returns the program and the
/// report's folder.
///
/// # Errors
/// It does not compile, or makes no report.
pub fn report(workspace: &Workspace) -> Result<(PathBuf, PathBuf), String> {
    static MADE: OnceLock<Result<(PathBuf, PathBuf), String>> = OnceLock::new();
    MADE.get_or_init(|| {
        let program = wedgelab(workspace)?;
        let folder = workspace.target.join("report");
        let arguments = ["reproduce", "--force", "--quiet", "--out"];
        shell::run(Command::new(&program).args(arguments).arg(&folder))?;
        Ok((program, folder))
    })
    .clone()
}

/// Builds the library of a package, which other programs load, for all processors and returns its folder.
/// Valgrind does not know all instructions of newer processors, and the library is to compute the same bits
/// without them, and with less optimization, which takes half of the time to compile.
///
/// # Errors
/// It does not compile.
pub fn portable_library(workspace: &Workspace, package: &str) -> Result<PathBuf, String> {
    let less = [
        "--config",
        "profile.release.opt-level=1",
        "--config",
        "profile.release.codegen-units=16",
    ];
    let library = ["--package", package, "--lib", "--no-default-features"];
    portable(workspace, &[&library[..], &less].concat())
}

/// Builds with these arguments of `cargo build --release` for all processors, apart from all else, and
/// returns the folder of what was built.
///
/// # Errors
/// It does not compile.
pub fn portable(workspace: &Workspace, arguments: &[&str]) -> Result<PathBuf, String> {
    let target = workspace.target.join("portable");
    let mut build = workspace.cargo(["build", "--release"]);
    let build = build.args(arguments).args(PORTABLE);
    shell::run(build.env("CARGO_TARGET_DIR", &target))?;
    Ok(target.join("release"))
}

/// Returns the file name of a shared library of the crate with this name in code.
#[must_use]
pub fn library(name: &str) -> String {
    format!("{DLL_PREFIX}{name}{DLL_SUFFIX}")
}
