//! `wedgelab nucars show`: a system as tables.

use std::io::{self, Write};
use std::path::PathBuf;
use std::process::ExitCode;

use clap::Args;
use nucars::Severity;
use nucars::file_sets::{find, kind, load};
use nucars::read::{FileKind, read_system};
use nucars::show;

use super::load::print_findings;
use crate::failure::{Failure, INPUT, Message};
use report::terminal::TerminalTable;

/// Print bodies, connections, characteristics and functions of a system file as tables
///
/// Values are in the file's units. If the file has errors, they are printed with the readable parts.
#[derive(Debug, Args)]
#[command(after_long_help = "\
Examples:
  wedgelab nucars show half_truck.sys")]
pub struct Arguments {
    /// A system file (.SYS)
    file: PathBuf,
}

/// Executes the command.
pub fn execute(arguments: &Arguments) -> Result<ExitCode, Failure> {
    let source = load(&find(&arguments.file)?)?;
    let found = kind(&source)?;
    if found != FileKind::System {
        return Err(Message::new(
            format!("{} is not a system file, but a {found}", source.name()),
            "name the .SYS file; `wedgelab nucars check` reads all kinds",
        )
        .into());
    }
    let read = read_system(&source);
    let mut out = io::stdout().lock();
    writeln!(out, "{}", read.tree.title.text.value)?;
    for table in show::system(&read.tree) {
        writeln!(out, "\n{}", table.title)?;
        let mut shown = TerminalTable::new(table.words, &table.columns);
        for row in table.rows {
            shown.row(row);
        }
        shown.write(&mut out)?;
    }
    out.flush()?;
    print_findings(&read.findings, |finding| finding.severity() == Severity::Error);
    Ok(ExitCode::from(if read.findings.has_errors() { INPUT } else { 0 }))
}
