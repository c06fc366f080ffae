//! `wedgelab nucars check`: what is wrong or doubtful with files.

use std::io::{self, Write};
use std::path::PathBuf;
use std::process::ExitCode;

use clap::Args;
use nucars::Severity;
use nucars::file_sets::{Files, find};
use nucars::read::FileKind;

use super::files::Instead;
use super::load::tell;
use crate::failure::{Failure, INPUT};

/// Say what is wrong or doubtful with files, with line and column
///
/// A run file (.RUN) is checked together with the system, data and input file it names, in its folder;
/// capitals do not matter. Other files are checked alone, or against the files of --system and --input, or
/// against the only one of that kind among the files. Errors, warnings and notes go to the standard error, a
/// line for each file to the standard output.
#[derive(Debug, Args)]
#[command(after_long_help = "\
Examples:
  wedgelab nucars check half_truck.sys
  wedgelab nucars check yaw.run --data results.dat
  wedgelab nucars check results.dat --system half_truck.sys

Exit codes: 0 no errors, perhaps warnings; 2 errors.")]
pub struct Arguments {
    /// Files (.SYS, .INP, .DAT, .RUN)
    #[arg(required = true, value_name = "FILE")]
    files: Vec<PathBuf>,
    #[command(flatten)]
    instead: Instead,
    /// Leave out notes
    #[arg(long)]
    no_notes: bool,
}

/// Does it.
pub fn execute(arguments: &Arguments) -> Result<ExitCode, Failure> {
    let instead = arguments.instead.files();
    let mut files = Files::default();
    for file in &arguments.files {
        files.add(&find(file)?, None)?;
    }
    for kind in [FileKind::System, FileKind::Data, FileKind::Input] {
        if let (_, Some(path)) = instead.of(kind) {
            files.add(&find(path)?, Some(kind))?;
        }
    }
    let sets = files.sets(&instead)?;
    files.check(&sets);
    report(&files, arguments.no_notes)
}

/// Tells all, a line for each file at the end.
fn report(files: &Files, no_notes: bool) -> Result<ExitCode, Failure> {
    let all = files.all();
    for (_, _, findings) in &all {
        tell(findings, |finding| {
            !no_notes || finding.severity() > Severity::Note
        });
    }
    let mut out = io::stdout().lock();
    for (kind, path, findings) in &all {
        let count = |severity| match findings.count(severity) {
            1 => format!("1 {severity}"),
            count => format!("{count} {severity}s"),
        };
        let counts = [Severity::Error, Severity::Warning, Severity::Note]
            .map(count)
            .join(", ");
        writeln!(out, "{}: {kind}, {counts}", path.display())?;
    }
    let wrong = all.iter().any(|(_, _, findings)| findings.has_errors());
    Ok(ExitCode::from(if wrong { INPUT } else { 0 }))
}
