//! `cargo xtask viewer`: the report page's interactive part, bundled into `viewer/dist`, where `report` takes
//! it from.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, ExitCode};

use crate::shell::{self, Workspace};

const HELP: &str = "\
Usage: cargo xtask viewer

Bundles the interactive part of the report's page (TypeScript in `viewer`) into `viewer/dist`; what is built \
with cargo after
that holds it. Needs Node.js 20.19 or later with npm; fetches the packages of its lock file once.";

const LOCK: &str = "package-lock.json";

/// The message where Node.js is missing.
const NODE: &str = "The viewer needs Node.js 20.19 or later with npm, and network the first time \
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
    match install(workspace).and_then(|()| bundle(workspace)) {
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
    println!("The viewer's packages are installed into viewer/node_modules now, once (25 MB to fetch).");
    let mut npm = Command::new("npm");
    npm.args(["ci", "--ignore-scripts", "--no-audit", "--no-fund"])
        .current_dir(&folder);
    shell::run(&mut npm).map_err(|error| format!("{NODE}\n{error}"))?;
    let copied = fs::copy(folder.join(LOCK), &stamp);
    copied.map_err(|error| format!("cannot write {}: {error}", stamp.display()))?;
    Ok(())
}

/// Bundles the viewer.
pub fn bundle(workspace: &Workspace) -> Result<(), String> {
    shell::run(&mut node(workspace, ["scripts/bundle.mjs"]))
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
