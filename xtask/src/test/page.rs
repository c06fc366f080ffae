//! The report's pages against an HTML validator, which npm installs into `target/tools` from a lock file.

use std::fs;
use std::process::Command;

use super::Outcome;
use crate::builds;
use crate::shell::{self, Workspace};

const TOOL: &str = "xtask/page";
const FILES: [&str; 3] = ["package.json", "package-lock.json", ".htmlvalidate.json"];

/// Makes a report and validates its pages.
pub fn check(workspace: &Workspace) -> Outcome {
    let tool = workspace.target.join("tools").join("page");
    let failed = |error: std::io::Error| format!("cannot prepare {}: {error}", tool.display());
    fs::create_dir_all(&tool).map_err(failed)?;
    let mut fresh = tool.join("node_modules").is_dir();
    for name in FILES {
        let own = fs::read(workspace.root.join(TOOL).join(name)).map_err(failed)?;
        fresh &= fs::read(tool.join(name)).is_ok_and(|there| there == own);
        fs::write(tool.join(name), own).map_err(failed)?;
    }
    if !fresh {
        shell::say("The HTML validator is installed into target/tools now, once.");
        let mut npm = Command::new("npm");
        npm.args(["ci", "--ignore-scripts", "--no-audit", "--no-fund"])
            .current_dir(&tool);
        shell::run(&mut npm)
            .map_err(|error| format!("html-validate needs Node.js with npm, and network.\n{error}"))?;
    }
    let (_, report) = builds::report(workspace)?;
    let mut validate = Command::new("node");
    validate
        .arg("node_modules/html-validate/bin/html-validate.mjs")
        .args(["index.html", "truck.html"].map(|name| report.join(name)))
        .current_dir(&tool);
    shell::run(&mut validate)?;
    Ok(None)
}
