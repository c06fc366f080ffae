//! `wedgelab nucars check`: what is wrong or doubtful with files.

use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::process::ExitCode;

use clap::Args;
use nucars::files::locate;
use nucars::read::{FileKind, Read, read_data, read_input, read_run, read_system};
use nucars::tree::{DataFile, InputFile, RunFile, SystemFile};
use nucars::{Findings, Severity, check};

use super::load::{find, kind, load, tell};
use crate::failure::{Failure, INPUT, Message};

/// Say what is wrong or doubtful with files, with line and column
///
/// A run file (.RUN) is checked together with the system, data and input file it names, in its folder; capitals do not
/// matter. Other files are checked alone, or against the files of --system and --input, or against the only one of that
/// kind among the files. Errors, warnings and notes go to the standard error, a line for each file to the standard output.
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
    /// This system file instead of the one that runs name; data files are checked against it
    #[arg(long, value_name = "FILE")]
    system: Option<PathBuf>,
    /// This data file instead of the one that runs name
    #[arg(long, value_name = "FILE")]
    data: Option<PathBuf>,
    /// This input file instead of the one that runs name; system files are checked with it
    #[arg(long, value_name = "FILE")]
    input: Option<PathBuf>,
    /// Leave out notes
    #[arg(long)]
    no_notes: bool,
}

impl Arguments {
    fn option(&self, kind: FileKind) -> (&'static str, Option<&Path>) {
        let (name, path) = match kind {
            FileKind::System => ("--system", &self.system),
            FileKind::Data => ("--data", &self.data),
            FileKind::Input => ("--input", &self.input),
            FileKind::Run => ("", &None),
        };
        (name, path.as_deref())
    }
}

/// Does it.
pub fn execute(arguments: &Arguments) -> Result<ExitCode, Failure> {
    let mut files = Files::default();
    for file in &arguments.files {
        files.add(&find(file)?, None)?;
    }
    for kind in [FileKind::System, FileKind::Data, FileKind::Input] {
        if let (_, Some(path)) = arguments.option(kind) {
            files.add(&find(path)?, Some(kind))?;
        }
    }
    let teams = files.teams(arguments)?;
    files.check(&teams);
    files.tell(arguments)
}

/// A file that was read.
struct Entry<T> {
    path: PathBuf,
    read: Read<T>,
}

/// Files that belong together, by their places in the lists.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
struct Team {
    run: Option<usize>,
    system: Option<usize>,
    data: Option<usize>,
    input: Option<usize>,
}

/// All files, each once.
#[derive(Default)]
struct Files {
    systems: Vec<Entry<SystemFile>>,
    data: Vec<Entry<DataFile>>,
    inputs: Vec<Entry<InputFile>>,
    runs: Vec<Entry<RunFile>>,
}

/// Adds to a list what is not yet in it, and gives its place.
fn place<T>(
    list: &mut Vec<Entry<T>>,
    path: &Path,
    read: impl FnOnce() -> Result<Read<T>, Message>,
) -> Result<usize, Message> {
    let same = |entry: &Entry<T>| {
        entry.path == path
            || entry
                .path
                .canonicalize()
                .ok()
                .is_some_and(|own| path.canonicalize().ok() == Some(own))
    };
    if let Some(index) = list.iter().position(same) {
        return Ok(index);
    }
    list.push(Entry {
        path: path.to_owned(),
        read: read()?,
    });
    Ok(list.len() - 1)
}

impl Files {
    /// Reads a file, unless it was read before, as the kind it must be or seems to be; its place in its list.
    fn add(&mut self, path: &Path, must_be: Option<FileKind>) -> Result<usize, Message> {
        let source = load(path)?;
        let kind = must_be.map_or_else(|| kind(&source), Ok)?;
        match kind {
            FileKind::System => place(&mut self.systems, path, || Ok(read_system(&source))),
            FileKind::Data => place(&mut self.data, path, || Ok(read_data(&source))),
            FileKind::Input => place(&mut self.inputs, path, || Ok(read_input(&source))),
            FileKind::Run => place(&mut self.runs, path, || Ok(read_run(&source))),
        }
    }

    /// Which files belong together: those of each run, and otherwise the only ones of their kinds.
    fn teams(&mut self, arguments: &Arguments) -> Result<Vec<Team>, Message> {
        let mut teams = Vec::new();
        let only = |count: usize| (count == 1).then_some(0);
        let system = only(self.systems.len());
        let input = only(self.inputs.len());
        for data in 0..self.data.len() {
            teams.push(Team {
                data: Some(data),
                system,
                ..Team::default()
            });
        }
        for system in 0..self.systems.len() {
            teams.push(Team {
                system: Some(system),
                input,
                ..Team::default()
            });
        }
        for run in 0..self.runs.len() {
            let team = Team {
                run: Some(run),
                system: self.of_run(run, FileKind::System, arguments)?,
                data: self.of_run(run, FileKind::Data, arguments)?,
                input: self.of_run(run, FileKind::Input, arguments)?,
            };
            teams.push(team);
        }
        Ok(teams)
    }

    /// The file of this kind that a run names, or an option instead.
    fn of_run(
        &mut self,
        run: usize,
        kind: FileKind,
        arguments: &Arguments,
    ) -> Result<Option<usize>, Message> {
        let (option, path) = arguments.option(kind);
        if let Some(path) = path {
            return self.add(&find(path)?, Some(kind)).map(Some);
        }
        let Entry { path, read } = &mut self.runs[run];
        let Some(name) = read.tree.names(kind) else {
            return Ok(None);
        };
        match locate(path.parent().unwrap_or(Path::new("")), name) {
            Ok(path) => self.add(&path, Some(kind)).map(Some),
            Err(missing) => {
                let findings = check::run_without_file(read, kind, &missing, option);
                read.add(findings);
                Ok(None)
            }
        }
    }

    /// Checks each file alone, and with those it belongs to.
    fn check(&mut self, teams: &[Team]) {
        for Entry { read, .. } in &mut self.systems {
            read.add(check::system(read));
        }
        for Entry { read, .. } in &mut self.data {
            read.add(check::data(read));
        }
        for Entry { read, .. } in &mut self.inputs {
            read.add(check::input(read));
        }
        for Entry { read, .. } in &mut self.runs {
            read.add(check::run(read));
        }
        for team in teams {
            let input = team.input.map(|index| &self.inputs[index].read.tree);
            if let (Some(index), Some(input)) = (team.system, input) {
                let read = &mut self.systems[index].read;
                read.add(check::system_with_input(read, input));
            }
            if let (Some(index), Some(input)) = (team.run, input) {
                let read = &mut self.runs[index].read;
                read.add(check::run_with_input(read, input));
            }
            if let (Some(data), Some(system)) = (team.data, team.system) {
                let read = &mut self.data[data].read;
                read.add(check::data_of_system(read, &self.systems[system].read.tree));
            }
        }
    }

    /// Tells all, a line for each file at the end.
    fn tell(&self, arguments: &Arguments) -> Result<ExitCode, Failure> {
        let all = self
            .runs
            .iter()
            .map(|entry| (FileKind::Run, &entry.path, &entry.read.findings));
        let all = all.chain(
            self.systems
                .iter()
                .map(|entry| (FileKind::System, &entry.path, &entry.read.findings)),
        );
        let all = all.chain(
            self.inputs
                .iter()
                .map(|entry| (FileKind::Input, &entry.path, &entry.read.findings)),
        );
        let all = all.chain(
            self.data
                .iter()
                .map(|entry| (FileKind::Data, &entry.path, &entry.read.findings)),
        );
        let all: Vec<(FileKind, &PathBuf, &Findings)> = all.collect();
        for (_, _, findings) in &all {
            tell(findings, |finding| {
                !arguments.no_notes || finding.severity() > Severity::Note
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
}
