//! `wedgelab run`: one case.

use std::io;
use std::io::Write;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

use clap::Args;
use quantity::nearest;
use report::run_files;
use study::case::{Case, builtin};

use crate::execute::{TABLE_NOTE, compute, table, unsound, write};
use crate::failure::{Failure, Message};
use crate::folders;
use crate::interrupt;
use crate::progress::Progress;

/// Run one case
///
/// Runs a case file and writes result.csv (the time histories), result.mat (the same under the thesis's
/// names), case.toml (the case, completed) and summary.json (averages, extremes, events, energy ledger,
/// solver statistics, assumptions) into a folder named as the case.
#[derive(Debug, Args)]
#[command(after_long_help = "\
Examples:
  wedgelab run my.toml
  wedgelab run my.toml --set friction.column=0.3 --out softer
  wedgelab run vdrun_toe_0_psi_0 --set 'wedge.angle=\"35 deg\"' --set 'simulation.duration=\"20 s\"'")]
pub struct Arguments {
    /// Case file, or, if there is no such file, the name of a built-in case
    case: PathBuf,
    /// Set one value over those of the case; VALUE is TOML (quotes around text may be left out)
    #[arg(long, value_name = "PATH.KEY=VALUE")]
    set: Vec<String>,
    /// Folder to write into [default: the case's name]
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// Overwrite existing results
    #[arg(long)]
    force: bool,
    /// No progress
    #[arg(long, short)]
    quiet: bool,
}

/// Does it.
pub fn execute(arguments: &Arguments) -> Result<ExitCode, Failure> {
    interrupt::listen();
    let case = read(&arguments.case, &arguments.set)?;
    let path = arguments.out.clone().unwrap_or_else(|| PathBuf::from(&case.name));
    let folder = folders::check(path, &run_files::NAMES, arguments.force)?;
    let progress = Progress::new(1, arguments.quiet);
    interrupt::stops_run();
    let done =
        compute(&case, &progress).and_then(|done| write(&done, &case, &folder, &progress).map(|()| done));
    progress.finish();
    let done = done?;
    let summary = &done.result.summary;
    let mut out = io::stdout().lock();
    table([(summary, done.wall)]).write(&mut out)?;
    writeln!(
        out,
        "\n{TABLE_NOTE}\n\nWritten into {}: {}.",
        folder.path().display(),
        run_files::NAMES.join(", ")
    )?;
    match unsound(summary, folder.path()) {
        Some(failure) => Err(failure),
        None => Ok(ExitCode::SUCCESS),
    }
}

/// Whether a built-in case is meant. A folder may well have its name: that of its results.
pub fn is_built_in(path: &Path) -> bool {
    let name = path.to_str().unwrap_or("");
    (!path.exists() || path.is_dir()) && builtin::names().any(|builtin| builtin == name)
}

/// The case that a user names, with `--set` overrides.
pub fn read(path: &Path, set: &[String]) -> Result<Case, Failure> {
    let name = path.to_str().unwrap_or("");
    if is_built_in(path) {
        return Ok(builtin::case_with(name, set)?);
    }
    if path.is_dir() {
        let advice = format!("name a case file, perhaps {}", path.join("case.toml").display());
        return Err(Message::new(format!("`{name}` is a folder, not a case file"), advice).into());
    }
    if !path.exists() && !name.ends_with(".toml") && path.components().count() == 1 {
        let advice = match nearest(name, builtin::names()) {
            Some(near) => format!("did you mean the built-in case {near}? `wedgelab case` lists all"),
            None => "name a TOML file, or one of the cases that `wedgelab case` lists".to_owned(),
        };
        let message = format!("there is neither a case file nor a built-in case `{name}`");
        return Err(Message::new(message, advice).into());
    }
    Ok(Case::read(path, set)?)
}
