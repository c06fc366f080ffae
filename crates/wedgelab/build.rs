//! Says where cargo puts the library of FMUs, so that the program carries it: `wedgelab fmu export` needs
//! nothing beside it, and its FMUs compute what it computes.

use std::error::Error;
use std::fs::OpenOptions;
use std::io::ErrorKind;
use std::path::PathBuf;
use std::{env, io};

fn main() -> Result<(), Box<dyn Error>> {
    println!("cargo::rerun-if-changed=build.rs");
    // The folder is `build/<package>/out` in that of the profile; libraries lie in its `deps`.
    let out = PathBuf::from(env::var("OUT_DIR")?);
    let profile = out
        .ancestors()
        .nth(3)
        .ok_or("OUT_DIR has no folder of a profile above it")?;
    let system = env::var("CARGO_CFG_TARGET_OS").unwrap_or_default();
    let name = match system.as_str() {
        "windows" => "wedgelab_fmu.dll",
        "macos" => "libwedgelab_fmu.dylib",
        _ => "libwedgelab_fmu.so",
    };
    let library = profile.join("deps").join(name);
    stand_in(&library)?;
    println!("cargo::rustc-env=WEDGELAB_FMU_LIBRARY={}", library.display());
    Ok(())
}

/// Makes an empty file where there is none: `cargo check` and `cargo clippy` make no library. Where it is
/// made, that is before the program is compiled, of which it is a dependency, and it takes the place of this
/// file.
fn stand_in(library: &PathBuf) -> io::Result<()> {
    match OpenOptions::new().write(true).create_new(true).open(library) {
        Err(error) if error.kind() != ErrorKind::AlreadyExists => Err(error),
        _ => Ok(()),
    }
}
