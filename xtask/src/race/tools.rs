//! The tools of the race: its programs are built, and the solvers that they call are installed.

use std::ffi::OsString;
use std::path::{Path, PathBuf};
use std::process::Command;

use crate::debian;
use crate::shell::{self, Workspace};
use crate::venv;

/// Debian's SUNDIALS; 6.4 in Debian 12.
const SUNDIALS: [&str; 1] = ["libsundials-dev"];
/// Octave with what compiles functions for it.
const OCTAVE: [&str; 2] = ["octave", "octave-dev"];
/// The libraries that CVODE's driver is linked with.
const LIBRARIES: [&str; 4] = [
    "-lsundials_cvode",
    "-lsundials_nvecserial",
    "-lsundials_sunmatrixdense",
    "-lsundials_sunlinsoldense",
];

/// The race's programs.
pub struct Tools {
    /// The race itself.
    pub race: PathBuf,
    library: PathBuf,
    drivers: PathBuf,
    cvode: PathBuf,
    python: PathBuf,
    octave: Option<PathBuf>,
}

impl Tools {
    /// Returns the arguments as the race takes them.
    pub fn arguments(&self) -> Vec<OsString> {
        let mut list = Vec::new();
        let mut add = |name: &str, path: &Path| {
            list.push(OsString::from(name));
            list.push(path.as_os_str().to_owned());
        };
        add("--library", &self.library);
        add("--drivers", &self.drivers);
        add("--cvode", &self.cvode);
        add("--python", &self.python);
        add("--exudyn", &self.python);
        if let Some(folder) = &self.octave {
            add("--octave", Path::new("octave-cli"));
            add("--mex", folder);
        }
        list
    }
}

/// Builds the race and the drivers, and installs what is missing.
pub fn prepare(workspace: &Workspace, octave: bool) -> Result<Tools, String> {
    shell::run(&mut workspace.cargo(["build", "--release", "--package", "race"]))?;
    let built = workspace.target.join("release");
    let made = folder(workspace)?;
    let cvode = cvode(workspace, &built)?;
    let octave = if octave {
        mex(workspace, &built, &made)?;
        Some(made)
    } else {
        None
    };
    Ok(Tools {
        race: built.join("race"),
        library: built.join("librace.so"),
        drivers: drivers(workspace),
        cvode,
        python: venv::environment(
            &workspace.target,
            "race",
            &drivers(workspace).join("requirements.txt"),
        )?,
        octave,
    })
}

/// Compiles the driver of CVODE alone; the race's library lies in `built`.
pub fn cvode(workspace: &Workspace, built: &Path) -> Result<PathBuf, String> {
    let driver = folder(workspace)?.join("cvode");
    compile_cvode(workspace, built, &driver)?;
    Ok(driver)
}

fn drivers(workspace: &Workspace) -> PathBuf {
    workspace.root.join("benchmarks").join("race").join("drivers")
}

/// Returns the folder of compiled drivers.
fn folder(workspace: &Workspace) -> Result<PathBuf, String> {
    let folder = workspace.target.join("race-drivers");
    match std::fs::create_dir_all(&folder) {
        Ok(()) => Ok(folder),
        Err(error) => Err(format!("cannot make {}: {error}", folder.display())),
    }
}

/// Compiles the driver of CVODE.
fn compile_cvode(workspace: &Workspace, built: &Path, driver: &Path) -> Result<(), String> {
    let header = Path::new("/usr/include/cvode/cvode.h");
    if !header.is_file() {
        shell::say("SUNDIALS is missing and is installed now, once.");
        debian::install(&SUNDIALS)?;
    }
    let mut compile = Command::new("cc");
    compile
        .args(["-O3", "-Wall", "-Wextra", "-Werror", "-o"])
        .arg(driver)
        .arg(drivers(workspace).join("cvode.c"))
        .arg("-I")
        .arg(drivers(workspace))
        .arg("-L")
        .arg(built)
        .arg("-lrace")
        .arg(format!("-Wl,-rpath,{}", built.display()))
        .args(LIBRARIES)
        .arg("-lm");
    shell::run(&mut compile)
}

/// Compiles the functions for Octave.
fn mex(workspace: &Workspace, built: &Path, made: &Path) -> Result<(), String> {
    if shell::output(Command::new("mkoctfile").arg("--version")).is_none() {
        shell::say("Octave, or what compiles functions for it, is missing and is installed now, once.");
        debian::install(&OCTAVE)?;
    }
    let mut compile = Command::new("mkoctfile");
    compile
        .arg("--mex")
        .arg(drivers(workspace).join("race_mex.c"))
        .arg(format!("-I{}", drivers(workspace).display()))
        .arg(format!("-L{}", built.display()))
        .arg("-lrace")
        .arg(format!("-Wl,-rpath,{}", built.display()))
        .arg("-o")
        .arg(made.join("race_mex.mex"))
        .current_dir(made);
    shell::run(&mut compile)
}
