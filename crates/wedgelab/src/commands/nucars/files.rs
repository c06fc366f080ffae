//! Files that belong together: a run with its system, data and input file.

use std::path::{Path, PathBuf};

use clap::Args;
use nucars::files::locate;
use nucars::read::{FileKind, Read, read_data, read_input, read_run, read_system};
use nucars::tree::{DataFile, InputFile, RunFile, SystemFile};
use nucars::{Findings, check};

use super::load::{find, kind, load};
use crate::failure::Message;

/// Files instead of those that runs name.
#[derive(Debug, Default, Args)]
pub struct Instead {
    /// This system file instead of the one that runs name; data files are checked against it
    #[arg(long, value_name = "FILE")]
    pub system: Option<PathBuf>,
    /// This data file instead of the one that runs name
    #[arg(long, value_name = "FILE")]
    pub data: Option<PathBuf>,
    /// This input file instead of the one that runs name; system files are checked with it
    #[arg(long, value_name = "FILE")]
    pub input: Option<PathBuf>,
}

impl Instead {
    /// Option and file of a kind.
    pub fn of(&self, kind: FileKind) -> (&'static str, Option<&Path>) {
        let (name, path) = match kind {
            FileKind::System => ("--system", &self.system),
            FileKind::Data => ("--data", &self.data),
            FileKind::Input => ("--input", &self.input),
            FileKind::Run => ("", &None),
        };
        (name, path.as_deref())
    }

    /// The options that are given, as typed.
    pub fn given(&self) -> Vec<String> {
        let kinds = [FileKind::System, FileKind::Data, FileKind::Input].map(|kind| self.of(kind));
        kinds
            .into_iter()
            .filter_map(|(name, path)| path.map(|path| format!("{name} {}", path.display())))
            .collect()
    }
}

/// A file that was read.
pub struct Entry<T> {
    /// Where.
    pub path: PathBuf,
    /// What was read.
    pub read: Read<T>,
}

/// Files that belong together, by their places in the lists.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Team {
    /// The run file.
    pub run: Option<usize>,
    /// Its system file.
    pub system: Option<usize>,
    /// Its data file.
    pub data: Option<usize>,
    /// Its input file.
    pub input: Option<usize>,
}

/// All files, each once.
#[derive(Default)]
pub struct Files {
    /// System files.
    pub systems: Vec<Entry<SystemFile>>,
    /// Data files.
    pub data: Vec<Entry<DataFile>>,
    /// Input files.
    pub inputs: Vec<Entry<InputFile>>,
    /// Run files.
    pub runs: Vec<Entry<RunFile>>,
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
    pub fn add(&mut self, path: &Path, must_be: Option<FileKind>) -> Result<usize, Message> {
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
    pub fn teams(&mut self, instead: &Instead) -> Result<Vec<Team>, Message> {
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
                system: self.of_run(run, FileKind::System, instead)?,
                data: self.of_run(run, FileKind::Data, instead)?,
                input: self.of_run(run, FileKind::Input, instead)?,
            };
            teams.push(team);
        }
        Ok(teams)
    }

    /// The file of this kind that a run names, or an option instead.
    fn of_run(&mut self, run: usize, kind: FileKind, instead: &Instead) -> Result<Option<usize>, Message> {
        let (option, path) = instead.of(kind);
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
    pub fn check(&mut self, teams: &[Team]) {
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

    /// All files with what was found in them.
    pub fn all(&self) -> Vec<(FileKind, &PathBuf, &Findings)> {
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
        all.collect()
    }
}

/// A run file with its files, all read and checked.
pub struct RunFiles {
    files: Files,
    team: Team,
}

impl RunFiles {
    /// Reads a run file and what belongs to it.
    pub fn read(path: &Path, instead: &Instead) -> Result<Self, Message> {
        let mut files = Files::default();
        let run = files.add(path, Some(FileKind::Run))?;
        let mut team = Team {
            run: Some(run),
            ..Team::default()
        };
        team.system = files.of_run(run, FileKind::System, instead)?;
        team.data = files.of_run(run, FileKind::Data, instead)?;
        team.input = files.of_run(run, FileKind::Input, instead)?;
        files.check(&[team]);
        Ok(Self { files, team })
    }

    /// The run file.
    pub fn run(&self) -> Option<&RunFile> {
        Some(&self.files.runs[self.team.run?].read.tree)
    }

    /// Its system file.
    pub fn system(&self) -> Option<&SystemFile> {
        Some(&self.files.systems[self.team.system?].read.tree)
    }

    /// Its data file.
    pub fn data(&self) -> Option<&DataFile> {
        Some(&self.files.data[self.team.data?].read.tree)
    }

    /// Its input file.
    pub fn input(&self) -> Option<&InputFile> {
        Some(&self.files.inputs[self.team.input?].read.tree)
    }

    /// What was found in each of them.
    pub fn findings(&self) -> impl Iterator<Item = &Findings> {
        self.files.all().into_iter().map(|(_, _, findings)| findings)
    }
}
