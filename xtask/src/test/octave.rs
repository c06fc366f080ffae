//! The tests that need Octave and SciPy. If missing, Octave is installed with `apt-get`, SciPy
//! into `target/tools`.

use std::env;
use std::process::Command;

use super::Outcome;
use crate::builds::SHARED;
use crate::debian;
use crate::shell::{self, Workspace};
use crate::venv;

/// The packages that Octave needs to draw, though nobody sees it: a toolkit, and a font to measure texts
/// with. About 280 MB.
const PACKAGES: [&str; 3] = ["octave", "gnuplot-nox", "fonts-freefont-otf"];

/// Draws an unseen curve.
const DRAW: &str = "set (0, 'defaultfigurevisible', 'off'); plot (1:2); close all";

/// The requirements of Python.
const REQUIREMENTS: &str = "crates/wedgelab/tests/octave/requirements.txt";

/// Runs the tests of the results.
pub fn check(workspace: &Workspace) -> Outcome {
    tests(workspace, &SHARED)
}

/// Installs what is missing and runs the tests of these crates.
pub fn tests(workspace: &Workspace, crates: &[&str]) -> Outcome {
    let octave = octave()?;
    let python = venv::environment(&workspace.target, "scipy", &workspace.root.join(REQUIREMENTS))?;
    let mut command = workspace.cargo(["test", "--release"]);
    command
        .args(crates)
        .args(["--test", "octave", "--", "--ignored"])
        .env("WEDGELAB_OCTAVE", &octave)
        .env("WEDGELAB_PYTHON", &python);
    shell::run(&mut command)?;
    Ok(version(&octave))
}

/// Returns an Octave that can draw.
fn octave() -> Result<String, String> {
    let program = env::var("WEDGELAB_OCTAVE").unwrap_or_else(|_| "octave-cli".to_owned());
    if draws(&program) {
        return Ok(program);
    }
    shell::say("An Octave that can draw is missing and is installed now, once (90 MB to fetch).");
    debian::install(&PACKAGES).map_err(|error| format!("{}\n{error}", advice()))?;
    if draws(&program) {
        Ok(program)
    } else {
        Err(advice())
    }
}

fn draws(program: &str) -> bool {
    let mut command = Command::new(program);
    command.args(["--no-init-file", "--quiet", "--eval", DRAW]);
    shell::output(&mut command).is_some()
}

fn advice() -> String {
    format!(
        "Octave is missing or cannot draw, and it could not be installed. On Debian and Ubuntu an \
         administrator installs it with `apt-get install {}`; elsewhere install Octave and gnuplot, and \
         name the program in WEDGELAB_OCTAVE if it is not called octave-cli. `cargo xtask test --only` runs \
         other checks without it.",
        PACKAGES.join(" ")
    )
}

/// Returns the version, as the first line of `--version` has it.
fn version(octave: &str) -> Option<String> {
    let text = shell::output(Command::new(octave).arg("--version"))?;
    text.lines().next().map(str::to_owned)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_program_that_is_not_there_cannot_draw() {
        assert!(!draws("there-is-no-such-octave"));
    }

    #[test]
    fn the_advice_names_every_package() {
        let advice = advice();
        assert!(PACKAGES.iter().all(|package| advice.contains(package)));
    }
}
