//! Programs of the system that checks need; on Debian those that are missing are installed.

use std::process::Command;
use std::sync::{Mutex, PoisonError};

use crate::shell;

/// Sees to it that programs are there: each is looked for with `--version`, and the packages of the same
/// names are installed with `apt-get` if one is missing.
///
/// # Errors
/// A program is missing and cannot be installed; the text says what to do.
pub fn need(programs: &[&str]) -> Result<(), String> {
    let missing: Vec<&str> = programs.iter().copied().filter(|name| !is_there(name)).collect();
    if missing.is_empty() {
        return Ok(());
    }
    shell::say(format!("{} is missing and is installed now.", missing.join(", ")));
    install(&missing).map_err(|error| format!("{}\n{error}", advice(&missing)))?;
    if missing.iter().all(|name| is_there(name)) {
        Ok(())
    } else {
        Err(advice(&missing))
    }
}

/// Installs Debian's packages.
///
/// # Errors
/// They cannot be installed; what an administrator would type is said.
pub fn install(packages: &[&str]) -> Result<(), String> {
    // Checks run at the same time, but only one `apt-get` may.
    static ONE_AT_A_TIME: Mutex<()> = Mutex::new(());
    let _guard = ONE_AT_A_TIME.lock().unwrap_or_else(PoisonError::into_inner);
    // Lists of packages may be missing or old; if they cannot be fetched, those that are there may do.
    if let Err(error) = apt(&["update"]) {
        shell::say(error);
    }
    let mut arguments = vec!["install", "-y", "--no-install-recommends"];
    arguments.extend(packages);
    apt(&arguments).map_err(|error| {
        let list = packages.join(" ");
        format!("{error}\nOn Debian and Ubuntu an administrator installs it with `apt-get install {list}`.")
    })
}

fn is_there(program: &str) -> bool {
    shell::output(Command::new(program).arg("--version")).is_some()
}

fn apt(arguments: &[&str]) -> Result<(), String> {
    let mut command = Command::new("apt-get");
    command.args(arguments).env("DEBIAN_FRONTEND", "noninteractive");
    shell::run(&mut command)
}

fn advice(missing: &[&str]) -> String {
    format!(
        "Missing, and could not be installed: {}. On Debian an administrator installs it with `apt-get \
         install {}`; `cargo xtask test --only` runs other checks without it.",
        missing.join(", "),
        missing.join(" ")
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_program_that_is_there_is_found_and_another_is_not() {
        assert!(is_there("cargo"));
        assert!(!is_there("no-such-program-of-this-name"));
        assert_eq!(need(&["cargo"]), Ok(()));
    }
}
