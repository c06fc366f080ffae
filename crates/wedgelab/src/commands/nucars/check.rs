//! `wedgelab nucars check`: mistakes and doubtful data in files.

use std::io::{self, Write};
use std::path::PathBuf;
use std::process::ExitCode;

use clap::Args;
use nucars::file_sets::{ReadFiles, find};
use nucars::read::FileKind;
use nucars::{Finding, Severity};
use serde_json::{Value, json};

use super::files::Instead;
use super::load::print_findings;
use crate::failure::{Failure, INPUT};
use crate::json;

/// Check files for errors and doubtful entries, with line and column
///
/// A run file (.RUN) is checked together with the system, data and input file it names, in its folder; case
/// of letters does not matter. Other files are checked alone, or against the files of --system and --input,
/// or against the only one of that kind among the files. Errors, warnings and notes go to the standard error,
/// a line for each file to the standard output.
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
    #[arg(long, help = json::HELP)]
    json: bool,
}

/// Executes the command.
pub fn execute(arguments: &Arguments) -> Result<ExitCode, Failure> {
    let instead = arguments.instead.files();
    let mut files = ReadFiles::default();
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
    report(&files, arguments)
}

/// Tells all, a line for each file at the end.
fn report(files: &ReadFiles, arguments: &Arguments) -> Result<ExitCode, Failure> {
    let all = files.all();
    let wrong = all.iter().any(|(_, _, findings)| findings.has_errors());
    let code = ExitCode::from(if wrong { INPUT } else { 0 });
    let shown = |finding: &&Finding| !arguments.no_notes || finding.severity() > Severity::Note;
    if arguments.json {
        let files = all.iter().map(|(kind, path, findings)| {
            let list = findings.list().iter().filter(shown);
            json!({
                "file": path,
                "kind": kind.to_string(),
                "errors": findings.count(Severity::Error),
                "warnings": findings.count(Severity::Warning),
                "notes": findings.count(Severity::Note),
                "findings": list.map(document).collect::<Vec<_>>(),
            })
        });
        json::print(&files.collect::<Vec<_>>())?;
        return Ok(code);
    }
    for (_, _, findings) in &all {
        print_findings(findings, shown);
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
    Ok(code)
}

/// Returns a finding as JSON; line and column count from one.
fn document(finding: &Finding) -> Value {
    let (line, column) = finding.place().line_and_column();
    json!({
        "severity": finding.severity().to_string(),
        "code": finding.code_name(),
        "line": line,
        "column": column,
        "message": finding.message(),
        "help": finding.advice(),
    })
}
