//! Virtual environments of Python for checks: made once, and anew when the list of their packages has
//! changed.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use crate::shell;

/// The file in an environment that says what was installed into it.
const STAMP: &str = "installed-requirements.txt";

/// Returns the Python of an environment that holds what a requirements file names: `<root>/tools/<name>`,
/// where `root` is the folder that cargo builds into ([`crate::shell::Workspace::target`]).
///
/// The environment is made (network, `python3` with `venv`) when it is not there or was made from another
/// text.
///
/// # Errors
/// The file cannot be read, or Python or pip fail; the text says what to do.
pub fn environment(root: &Path, name: &str, requirements: &Path) -> Result<PathBuf, String> {
    let wanted = fs::read_to_string(requirements)
        .map_err(|error| format!("{} cannot be read: {error}", requirements.display()))?;
    let folder = root.join("tools").join(name);
    let program = program(&folder);
    if is_made(&folder, &wanted) {
        return Ok(program);
    }
    shell::say(format!(
        "The Python environment `{name}` is made in {} now, once.",
        folder.display()
    ));
    make(&folder, &program, requirements).map_err(|error| {
        format!(
            "The Python environment `{name}` could not be made; it needs Python 3.10 or later with `venv` \
             (Debian: python3-venv) and network.\n{error}"
        )
    })?;
    // Last: an environment without it is not finished.
    fs::write(folder.join(STAMP), wanted)
        .map_err(|error| format!("{} cannot be written to: {error}", folder.display()))?;
    Ok(program)
}

fn make(folder: &Path, program: &Path, requirements: &Path) -> Result<(), String> {
    shell::run(
        Command::new("python3")
            .args(["-m", "venv", "--clear"])
            .arg(folder),
    )?;
    let pip = [
        "-m",
        "pip",
        "install",
        "--quiet",
        "--disable-pip-version-check",
        "--requirement",
    ];
    shell::run(Command::new(program).args(pip).arg(requirements))
}

/// Returns whether the environment is finished and holds what is wanted.
fn is_made(folder: &Path, wanted: &str) -> bool {
    let same = fs::read_to_string(folder.join(STAMP)).is_ok_and(|installed| installed == wanted);
    same && program(folder).is_file()
}

/// Returns the Python of an environment.
fn program(folder: &Path) -> PathBuf {
    if cfg!(windows) {
        folder.join("Scripts").join("python.exe")
    } else {
        folder.join("bin").join("python")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_environment_of_other_requirements_is_not_the_wanted_one() {
        let folder = tempfile::tempdir().unwrap();
        let python = program(folder.path());
        fs::create_dir_all(python.parent().unwrap()).unwrap();
        fs::write(&python, "").unwrap();
        assert!(!is_made(folder.path(), "a==1\n"), "not finished");
        fs::write(folder.path().join(STAMP), "a==1\n").unwrap();
        assert!(is_made(folder.path(), "a==1\n"));
        assert!(!is_made(folder.path(), "a==2\n"));
    }

    #[test]
    fn a_missing_requirements_file_is_named() {
        let folder = tempfile::tempdir().unwrap();
        let missing = folder.path().join("requirements.txt");
        let error = environment(folder.path(), "x", &missing).unwrap_err();
        assert!(error.contains("requirements.txt"), "{error}");
    }
}
