//! `cargo deny`: licences, duplicates and sources of dependencies; known vulnerabilities on request.

use std::path::PathBuf;
use std::process::Command;
use std::{env, fs};

use super::Outcome;
use crate::shell::{self, Workspace};

/// The version fetched, and the only one used: another may judge otherwise.
const VERSION: &str = "0.20.2";

/// Licences, bans and sources, which need no network once the crates are there.
pub fn check(workspace: &Workspace) -> Outcome {
    deny(workspace, &["licenses", "bans", "sources"])?;
    Ok(Some(
        "advisories not checked: `cargo xtask test --only advisories` does, with access to GitHub".into(),
    ))
}

/// Known vulnerabilities. Fetches their database from GitHub, which many machines cannot reach.
pub fn advisories(workspace: &Workspace) -> Outcome {
    deny(workspace, &["advisories"])?;
    Ok(None)
}

fn deny(workspace: &Workspace, what: &[&str]) -> Result<(), String> {
    let mut command = Command::new(program(workspace)?);
    command
        .args(["--workspace", "--all-features", "check", "--hide-inclusion-graph"])
        .args(what)
        .current_dir(&workspace.root);
    shell::run(&mut command)
}

/// `cargo-deny` of our version: the one installed, or the one in `target/tools`, built if missing.
fn program(workspace: &Workspace) -> Result<PathBuf, String> {
    let name = format!("cargo-deny{}", env::consts::EXE_SUFFIX);
    let tools = workspace.target.join("tools");
    let own = tools.join("bin").join(&name);
    if let Some(found) = [PathBuf::from(&name), own.clone()].into_iter().find(is_ours) {
        return Ok(found);
    }
    shell::say(format!(
        "cargo-deny {VERSION} is missing and is built now, once; this takes minutes."
    ));
    let build = tools.join("build");
    let mut install = workspace.cargo([
        "install",
        "cargo-deny",
        // It is compiled more often than it is run.
        "--debug",
        "--locked",
        "--force",
        "--version",
        VERSION,
    ]);
    // Nobody looks into it with a debugger.
    install.env("CARGO_PROFILE_DEV_DEBUG", "0");
    shell::run(install.arg("--root").arg(&tools).arg("--target-dir").arg(&build))?;
    // Hundreds of megabytes that nobody needs any more. That they stay behind is no failure.
    let _ = fs::remove_dir_all(&build);
    Ok(own)
}

fn is_ours(program: &PathBuf) -> bool {
    shell::output(Command::new(program).arg("--version")).is_some_and(|text| is_version(&text))
}

/// Returns whether this is what our version answers to `--version`.
fn is_version(answer: &str) -> bool {
    answer.split_whitespace().nth(1) == Some(VERSION)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_our_version_is_used() {
        assert!(is_version(&format!("cargo-deny {VERSION}")));
        assert!(!is_version("cargo-deny 0.1.0"));
        assert!(!is_version(""));
    }
}
