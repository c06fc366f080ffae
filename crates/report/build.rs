//! Embeds the page's interactive part, if it has been built: `viewer/dist`, by `cargo xtask viewer`. Without
//! it the crate compiles all the same, and pages are static.

use std::env;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

/// The files in `viewer/dist`.
const FILES: [&str; 4] = ["viewer.js", "viewer.css", "explorer.js", "explorer.css"];

fn main() -> ExitCode {
    match embed() {
        Ok(()) => ExitCode::SUCCESS,
        Err(message) => {
            eprintln!("{message}");
            ExitCode::FAILURE
        }
    }
}

fn embed() -> Result<(), String> {
    let variable = |name: &str| {
        let value = env::var_os(name).ok_or_else(|| format!("cargo did not set {name}"))?;
        Ok::<PathBuf, String>(PathBuf::from(value))
    };
    let out = variable("OUT_DIR")?;
    let built = variable("CARGO_MANIFEST_DIR")?.join("../../viewer/dist");
    println!("cargo::rerun-if-changed=build.rs");
    println!("cargo::rerun-if-changed={}", built.display());
    // All or none.
    let complete = FILES.iter().all(|name| built.join(name).is_file());
    for name in FILES {
        let text = if complete {
            read(&built.join(name))?
        } else {
            String::new()
        };
        let place = out.join(name);
        fs::write(&place, text).map_err(|error| format!("cannot write {}: {error}", place.display()))?;
    }
    Ok(())
}

fn read(path: &Path) -> Result<String, String> {
    fs::read_to_string(path).map_err(|error| format!("cannot read {}: {error}", path.display()))
}
