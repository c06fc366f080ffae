//! The program, as a user calls it.
#![allow(dead_code, clippy::unwrap_used)]

use std::path::Path;
use std::process::Command;

/// The output of a call.
pub struct Output {
    pub code: Option<i32>,
    pub out: String,
    pub err: String,
}

/// Calls the program in a folder.
pub fn wedgelab(folder: &Path, arguments: &[&str]) -> Output {
    let output = Command::new(env!("CARGO_BIN_EXE_wedgelab"))
        .current_dir(folder)
        .args(arguments)
        .env_remove("FORCE_COLOR")
        .output()
        .unwrap();
    Output {
        code: output.status.code(),
        out: String::from_utf8(output.stdout).unwrap(),
        err: String::from_utf8(output.stderr).unwrap(),
    }
}

/// Calls it, and returns what it printed; it must succeed.
#[track_caller]
pub fn done(folder: &Path, arguments: &[&str]) -> String {
    let output = wedgelab(folder, arguments);
    assert_eq!(output.code, Some(0), "{arguments:?}: {}", output.err);
    output.out
}
