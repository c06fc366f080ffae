//! `cargo xtask fuzz`: broken inputs for every reader, for as long as asked.

use std::process::{Command, ExitCode};

use crate::builds;
use crate::shell::{self, Workspace};

/// Runs the command. The program explains its arguments itself.
pub fn run(workspace: &Workspace, arguments: &[String]) -> ExitCode {
    let ended = program(workspace).and_then(|mut program| {
        let status = program.args(arguments).status();
        status.map_err(|error| format!("the program `fuzz` cannot be started: {error}"))
    });
    match ended {
        Ok(status) => ExitCode::from(status.code().and_then(|code| code.try_into().ok()).unwrap_or(1)),
        Err(message) => {
            eprintln!("{message}");
            ExitCode::FAILURE
        }
    }
}

/// Runs the check: `seconds` over all readers, the same inputs every time. In the release profile: what is
/// tested is what users run, and the tests have compiled it.
///
/// # Errors
/// Something was found.
pub fn check(workspace: &Workspace, seconds: u32) -> Result<(), String> {
    let folder = builds::programs(workspace, &["--bin", "fuzz"])?;
    shell::run(Command::new(folder.join("fuzz")).args(["--seconds", &seconds.to_string()]))
}

/// Builds the program, in the dev profile: overflows and what code claims about itself are checked there.
fn program(workspace: &Workspace) -> Result<Command, String> {
    shell::run(&mut workspace.cargo(["build", "--package", "fuzz"]))?;
    Ok(Command::new(workspace.target.join("debug").join("fuzz")))
}
