//! The report page's interactive part and the explorer: types, lints, unit tests; and the pages in a real
//! browser. If missing, packages of the lock file are installed with npm, Chromium with `apt-get`.

use std::env;
use std::process::Command;

use super::Outcome;
use crate::builds;
use crate::debian;
use crate::shell::{self, Workspace};
use crate::viewer::{compare, install, node};

/// Programs that Chromium is called.
const NAMES: [&str; 3] = ["chromium", "chromium-browser", "google-chrome"];

/// Checks the viewer, and its bundle in the repository.
pub fn check(workspace: &Workspace) -> Outcome {
    install(workspace)?;
    for arguments in [
        ["node_modules/typescript/bin/tsc", "--noEmit"].as_slice(),
        &["node_modules/eslint/bin/eslint.js", "."],
        &["scripts/unit.mjs"],
    ] {
        shell::run(&mut node(workspace, arguments.iter().copied()))?;
    }
    compare(workspace)?;
    Ok(None)
}

/// Makes a report, and tries its pages and the explorer in a browser.
pub fn browser(workspace: &Workspace) -> Outcome {
    install(workspace)?;
    let chromium = chromium()?;
    let (program, report) = builds::report(workspace)?;
    // One after the other: their pages fill two cores.
    let mut tests = node(
        workspace,
        [
            "--test",
            "--test-concurrency=1",
            "test/browser/page.test.mjs",
            "test/browser/car.test.mjs",
            "test/browser/pages.test.mjs",
            "test/browser/explorer.test.mjs",
        ],
    );
    tests
        .env("WEDGELAB", &program)
        .env("WEDGELAB_REPORT", &report)
        .env("WEDGELAB_CHROMIUM", &chromium);
    shell::run(&mut tests)?;
    Ok(shell::output(Command::new(&chromium).arg("--version")))
}

/// Returns the path of a Chromium, which is installed if there is none.
fn chromium() -> Result<String, String> {
    if let Ok(named) = env::var("WEDGELAB_CHROMIUM") {
        return Ok(named);
    }
    if let Some(path) = found() {
        return Ok(path);
    }
    shell::say("Chromium is missing and is installed now, once (90 MB to fetch).");
    debian::install(&["chromium"]).map_err(|error| format!("{}\n{error}", advice()))?;
    found().ok_or_else(advice)
}

/// Returns the first Chromium on the path that starts.
fn found() -> Option<String> {
    let folders = env::var_os("PATH")?;
    let mut paths = env::split_paths(&folders).flat_map(|folder| NAMES.map(|name| folder.join(name)));
    let path =
        paths.find(|path| path.is_file() && shell::output(Command::new(path).arg("--version")).is_some())?;
    path.into_os_string().into_string().ok()
}

fn advice() -> String {
    "Chromium is missing and could not be installed. On Debian an administrator installs it with `apt-get \
     install chromium`; elsewhere install Chromium or Chrome and name the program in WEDGELAB_CHROMIUM. \
     `cargo xtask test --only` runs other checks without it."
        .to_owned()
}
