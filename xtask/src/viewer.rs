//! `cargo xtask viewer`: the interactive part of pages, bundled into `crates/report/viewer`. The bundle is in
//! the repository, so that building needs Rust alone; the check `viewer` compares it with its sources.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, ExitCode};

use crate::shell::{self, Workspace};

const HELP: &str = "\
Usage: cargo xtask viewer

Bundles the interactive part of pages (TypeScript in `viewer`) into `crates/report/viewer`, which is
committed. Only those who change `viewer` need it. Needs Node.js 20.19 or later with npm; fetches the
packages of its lock file once.";

/// The files of the bundle.
const FILES: [&str; 4] = ["viewer.js", "viewer.css", "explorer.js", "explorer.css"];

const LOCK: &str = "package-lock.json";

/// The message where Node.js is missing.
const NODE: &str = "Bundling the viewer needs Node.js 20.19 or later with npm, and network the first time \
                    (https://nodejs.org; Debian: apt-get install nodejs npm).";

/// Runs the command.
pub fn run(workspace: &Workspace, arguments: &[String]) -> ExitCode {
    match arguments {
        [] => {}
        [only] if only == "--help" || only == "-h" => {
            println!("{HELP}");
            return ExitCode::SUCCESS;
        }
        _ => {
            eprintln!("{HELP}");
            return ExitCode::from(2);
        }
    }
    match install(workspace).and_then(|()| bundle(workspace, &committed(workspace))) {
        Ok(()) => ExitCode::SUCCESS,
        Err(message) => {
            eprintln!("{message}");
            ExitCode::FAILURE
        }
    }
}

/// Returns the viewer's folder.
pub fn folder(workspace: &Workspace) -> PathBuf {
    workspace.root.join("viewer")
}

/// Node.js in the viewer's folder.
pub fn node<'a>(workspace: &Workspace, arguments: impl IntoIterator<Item = &'a str>) -> Command {
    let mut command = Command::new("node");
    command.args(arguments).current_dir(folder(workspace));
    command
}

/// Fetches the packages of the lock file, if they are not there.
pub fn install(workspace: &Workspace) -> Result<(), String> {
    let folder = folder(workspace);
    let stamp = folder.join("node_modules").join(".installed-lock");
    if same(&folder.join(LOCK), &stamp) {
        return Ok(());
    }
    shell::say("The viewer's packages are installed into viewer/node_modules now, once (25 MB to fetch).");
    let mut npm = Command::new("npm");
    npm.args(["ci", "--ignore-scripts", "--no-audit", "--no-fund"])
        .current_dir(&folder);
    shell::run(&mut npm).map_err(|error| format!("{NODE}\n{error}"))?;
    let copied = fs::copy(folder.join(LOCK), &stamp);
    copied.map_err(|error| format!("cannot write {}: {error}", stamp.display()))?;
    Ok(())
}

/// Returns the folder of the bundle that is in the repository.
fn committed(workspace: &Workspace) -> PathBuf {
    workspace.root.join("crates/report/viewer")
}

/// Bundles the viewer into a folder.
fn bundle(workspace: &Workspace, folder: &Path) -> Result<(), String> {
    shell::run(node(workspace, ["scripts/bundle.mjs"]).arg(folder))
}

/// Bundles the viewer anew and compares it with the bundle in the repository.
///
/// # Errors
/// A file differs.
pub fn compare(workspace: &Workspace) -> Result<(), String> {
    let fresh = workspace.target.join("viewer");
    bundle(workspace, &fresh)?;
    let committed = committed(workspace);
    let stale: Vec<&str> = FILES
        .into_iter()
        .filter(|name| !same(&fresh.join(name), &committed.join(name)))
        .collect();
    if stale.is_empty() {
        return Ok(());
    }
    Err(format!(
        "{} in {} differ from their sources in `viewer`: run `cargo xtask viewer` and commit its result.",
        stale.join(", "),
        committed.display()
    ))
}

/// Returns whether both files are there and hold the same.
fn same(a: &Path, b: &Path) -> bool {
    match (fs::read(a), fs::read(b)) {
        (Ok(a), Ok(b)) => a == b,
        _ => false,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_missing_is_not_the_same() {
        let folder = folder(&Workspace::find());
        assert!(same(&folder.join(LOCK), &folder.join(LOCK)));
        assert!(!same(&folder.join(LOCK), &folder.join("package.json")));
        assert!(!same(&folder.join("missing"), &folder.join("missing")));
    }
}
