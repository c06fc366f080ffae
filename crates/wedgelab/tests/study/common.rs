//! Small studies, and their folders.

use std::fs;
use std::path::Path;
use std::process::{Command, Stdio};

use study::design::Study;
use study::records;

/// A study of 120 short runs, a few milliseconds each.
pub const SMALL: &str = "\
title = \"Friction and stiffness\"
case = \"cdrun_toe_out_0.2_psi_0.012\"
sampling = \"full_factorial\"
[set]
simulation.duration = \"0.12 s\"
[vary]
friction.column = { from = 0.2, to = 0.6, count = 12 }
control_coil.stiffness = { from = \"1500 lbf/in\", to = \"2500 lbf/in\", count = 10 }
";

/// Files in the folder of a study that is done.
pub const WHOLE: [&str; 6] = [
    ".lock",
    "index.html",
    "parts",
    "study.json",
    "table.csv",
    "table.parquet",
];

pub struct Output {
    pub code: Option<i32>,
    pub out: String,
    pub err: String,
}

pub fn command(folder: &Path, arguments: &[&str]) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_wedgelab"));
    command
        .current_dir(folder)
        .args(arguments)
        .env_remove("FORCE_COLOR")
        .stdin(Stdio::null());
    command
}

pub fn wedgelab(folder: &Path, arguments: &[&str]) -> Output {
    output(&mut command(folder, arguments))
}

pub fn output(command: &mut Command) -> Output {
    let output = command.output().unwrap();
    Output {
        code: output.status.code(),
        out: String::from_utf8(output.stdout).unwrap(),
        err: String::from_utf8(output.stderr).unwrap(),
    }
}

/// It ends well.
#[track_caller]
pub fn done(folder: &Path, arguments: &[&str]) -> Output {
    let output = wedgelab(folder, arguments);
    assert_eq!(output.code, Some(0), "{arguments:?}: {}", output.err);
    output
}

/// It is refused with this code and these texts.
#[track_caller]
pub fn refused(folder: &Path, arguments: &[&str], code: i32, texts: &[&str]) {
    let output = wedgelab(folder, arguments);
    assert_eq!(
        output.code,
        Some(code),
        "{arguments:?}: {}{}",
        output.out,
        output.err
    );
    for text in texts {
        assert!(output.err.contains(text), "{text:?} is not in: {}", output.err);
    }
    assert!(!output.err.contains("panicked"), "{}", output.err);
}

/// Returns the bytes of both tables.
pub fn table(folder: &Path) -> Vec<u8> {
    ["table.parquet", "table.csv"]
        .map(|name| fs::read(folder.join(name)).unwrap())
        .concat()
}

/// Returns the names in a folder, sorted.
pub fn names(folder: &Path) -> Vec<String> {
    let mut names: Vec<String> = fs::read_dir(folder)
        .unwrap()
        .map(|entry| entry.unwrap().file_name().into_string().unwrap())
        .collect();
    names.sort();
    names
}

/// Bytes of records that are there.
pub fn kept(folder: &Path) -> u64 {
    let parts = folder.join("parts");
    names(&parts)
        .iter()
        .map(|name| fs::metadata(parts.join(name)).unwrap().len())
        .sum()
}

/// Returns the numbers of all records in the parts, sorted; a run that was done twice stands twice.
pub fn recorded(folder: &Path, study: &str, out: &str) -> Vec<u64> {
    let fingerprint = Study::read(&folder.join(study)).unwrap().fingerprint();
    let parts = folder.join(out).join("parts");
    let mut numbers: Vec<u64> = names(&parts)
        .iter()
        .flat_map(|name| records::read(fingerprint, &fs::read(parts.join(name)).unwrap()).records)
        .map(|record| record.number)
        .collect();
    numbers.sort_unstable();
    numbers
}
