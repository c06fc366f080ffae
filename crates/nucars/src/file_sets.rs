//! Files that belong together: a run with its system, data and input file.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use input::file::{self, Expected};
use input::{FileType, bounded, limits};
use miette::Diagnostic;
use serde::{Deserialize, Serialize};
use thiserror::Error;

use crate::files::locate;
use crate::read::{FileKind, Read, read_data, read_input, read_run, read_system};
use crate::source::{SourceError, SourceText};
use crate::tree::{DataFile, InputFile, RunFile, SystemFile};
use crate::{Findings, Severity, check};

/// A file that cannot be read at all.
#[derive(Clone, Debug, Error, PartialEq, Eq)]
#[error("{message}")]
pub struct LoadError {
    /// The mistake.
    pub message: String,
    /// The advice; may be empty.
    pub advice: String,
}

impl LoadError {
    fn new(message: impl Into<String>, advice: impl Into<String>) -> Self {
        Self {
            message: bounded(message.into()),
            advice: bounded(advice.into()),
        }
    }
}

impl Diagnostic for LoadError {
    fn help<'a>(&'a self) -> Option<Box<dyn std::fmt::Display + 'a>> {
        (!self.advice.is_empty()).then(|| Box::new(&self.advice) as Box<dyn std::fmt::Display>)
    }
}

/// Returns the file a user named: as spelt, or with other capitals.
///
/// # Errors
/// There is none.
pub fn find(path: &Path) -> Result<PathBuf, LoadError> {
    if path.is_dir() {
        return Err(LoadError::new(
            format!("{} is a folder", path.display()),
            "name a file, such as half_truck.sys",
        ));
    }
    let text = path.to_string_lossy();
    locate(Path::new(""), &text).map_err(|missing| {
        let help = match &missing.nearest {
            Some(near) => format!("did you mean {}?", path.with_file_name(near).display()),
            None => "the name of a .SYS, .INP, .DAT or .RUN file is expected".to_owned(),
        };
        LoadError::new(format!("there is no file {}", path.display()), help)
    })
}

/// The expected file of NUCARS.
const NUCARS_FILE: Expected = Expected {
    what: "file of NUCARS",
    types: &[FileType::Nucars],
    most: limits::TEXT_FILE,
};

/// Returns the text of a file that is there.
///
/// # Errors
/// It cannot be read, is something else, or too large.
pub fn load(path: &Path) -> Result<Arc<SourceText>, LoadError> {
    let bytes = file::read(path, &NUCARS_FILE)
        .map_err(|error| LoadError::new(error.to_string(), error.help().unwrap_or_default()))?;
    SourceText::from_bytes(path.display().to_string(), bytes).map_err(|error| too_long(&error))
}

fn too_long(error: &SourceError) -> LoadError {
    LoadError::new(error.to_string(), "cut it into several files")
}

/// Returns the kind of a file, by its ending or its keywords.
///
/// # Errors
/// It is none of ours.
pub fn kind(source: &SourceText) -> Result<FileKind, LoadError> {
    FileKind::of(source).ok_or_else(|| {
        LoadError::new(
            format!("{} is no file of NUCARS", source.name()),
            "names end with .SYS, .INP, .DAT or .RUN; or the file holds a keyword such as `\\BODY DATA` at \
             the beginning of a line",
        )
    })
}

/// Files instead of those that runs name.
#[derive(Clone, Debug, Default)]
pub struct Instead {
    /// This system file; data files are checked against it.
    pub system: Option<PathBuf>,
    /// This data file.
    pub data: Option<PathBuf>,
    /// This input file; system files are checked with it.
    pub input: Option<PathBuf>,
}

impl Instead {
    /// Option and file of a kind.
    #[must_use]
    pub fn of(&self, kind: FileKind) -> (&'static str, Option<&Path>) {
        let (name, path) = match kind {
            FileKind::System => ("--system", &self.system),
            FileKind::Data => ("--data", &self.data),
            FileKind::Input => ("--input", &self.input),
            FileKind::Run => ("", &None),
        };
        (name, path.as_deref())
    }

    /// Returns the options that are given, as typed.
    #[must_use]
    pub fn given(&self) -> Vec<String> {
        let kinds = [FileKind::System, FileKind::Data, FileKind::Input].map(|kind| self.of(kind));
        kinds
            .into_iter()
            .filter_map(|(name, path)| path.map(|path| format!("{name} {}", path.display())))
            .collect()
    }
}

/// A file that was read.
pub struct FileEntry<T> {
    /// The path of the file.
    pub path: PathBuf,
    /// Its contents, with problems.
    pub read: Read<T>,
}

/// Files that belong together, by their places in the lists.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct FileSet {
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
pub struct ReadFiles {
    /// System files.
    pub systems: Vec<FileEntry<SystemFile>>,
    /// Data files.
    pub data: Vec<FileEntry<DataFile>>,
    /// Input files.
    pub inputs: Vec<FileEntry<InputFile>>,
    /// Run files.
    pub runs: Vec<FileEntry<RunFile>>,
}

/// Adds to a list what is not yet in it, and gives its place.
fn place<T>(
    list: &mut Vec<FileEntry<T>>,
    path: &Path,
    read: impl FnOnce() -> Result<Read<T>, LoadError>,
) -> Result<usize, LoadError> {
    let same = |entry: &FileEntry<T>| {
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
    list.push(FileEntry {
        path: path.to_owned(),
        read: read()?,
    });
    Ok(list.len() - 1)
}

impl ReadFiles {
    /// Reads a file, unless it was read before, as the kind it must be or seems to be; its place in its list.
    ///
    /// # Errors
    /// It cannot be read.
    pub fn add(&mut self, path: &Path, must_be: Option<FileKind>) -> Result<usize, LoadError> {
        let source = load(path)?;
        let kind = must_be.map_or_else(|| kind(&source), Ok)?;
        match kind {
            FileKind::System => place(&mut self.systems, path, || Ok(read_system(&source))),
            FileKind::Data => place(&mut self.data, path, || Ok(read_data(&source))),
            FileKind::Input => place(&mut self.inputs, path, || Ok(read_input(&source))),
            FileKind::Run => place(&mut self.runs, path, || Ok(read_run(&source))),
        }
    }

    /// Returns the sets of files that belong together: those of each run, and otherwise the only ones of
    /// their kinds.
    ///
    /// # Errors
    /// A file that is given instead cannot be read.
    pub fn sets(&mut self, instead: &Instead) -> Result<Vec<FileSet>, LoadError> {
        let mut sets = Vec::new();
        let only = |count: usize| (count == 1).then_some(0);
        let system = only(self.systems.len());
        let input = only(self.inputs.len());
        for data in 0..self.data.len() {
            sets.push(FileSet {
                data: Some(data),
                system,
                ..FileSet::default()
            });
        }
        for system in 0..self.systems.len() {
            sets.push(FileSet {
                system: Some(system),
                input,
                ..FileSet::default()
            });
        }
        for run in 0..self.runs.len() {
            let set = FileSet {
                run: Some(run),
                system: self.of_run(run, FileKind::System, instead)?,
                data: self.of_run(run, FileKind::Data, instead)?,
                input: self.of_run(run, FileKind::Input, instead)?,
            };
            sets.push(set);
        }
        Ok(sets)
    }

    /// Returns the file of this kind that a run names, or an option instead.
    fn of_run(&mut self, run: usize, kind: FileKind, instead: &Instead) -> Result<Option<usize>, LoadError> {
        let (option, path) = instead.of(kind);
        if let Some(path) = path {
            return self.add(&find(path)?, Some(kind)).map(Some);
        }
        let FileEntry { path, read } = &mut self.runs[run];
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
    pub fn check(&mut self, sets: &[FileSet]) {
        for FileEntry { read, .. } in &mut self.systems {
            read.add(check::system(read));
        }
        for FileEntry { read, .. } in &mut self.data {
            read.add(check::data(read));
        }
        for FileEntry { read, .. } in &mut self.inputs {
            read.add(check::input(read));
        }
        for FileEntry { read, .. } in &mut self.runs {
            read.add(check::run(read));
        }
        for set in sets {
            let input = set.input.map(|index| &self.inputs[index].read.tree);
            if let (Some(index), Some(input)) = (set.system, input) {
                let read = &mut self.systems[index].read;
                read.add(check::system_with_input(read, input));
            }
            if let (Some(index), Some(input)) = (set.run, input) {
                let read = &mut self.runs[index].read;
                read.add(check::run_with_input(read, input));
            }
            if let (Some(data), Some(system)) = (set.data, set.system) {
                let read = &mut self.data[data].read;
                read.add(check::data_of_system(read, &self.systems[system].read.tree));
            }
        }
    }

    /// Returns all files with what was found in them.
    #[must_use]
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
    files: ReadFiles,
    set: FileSet,
}

impl RunFiles {
    /// Reads a run file and what belongs to it.
    ///
    /// # Errors
    /// It cannot be read, or a file that is given instead cannot.
    pub fn read(path: &Path, instead: &Instead) -> Result<Self, LoadError> {
        let mut files = ReadFiles::default();
        let run = files.add(path, Some(FileKind::Run))?;
        let mut set = FileSet {
            run: Some(run),
            ..FileSet::default()
        };
        set.system = files.of_run(run, FileKind::System, instead)?;
        set.data = files.of_run(run, FileKind::Data, instead)?;
        set.input = files.of_run(run, FileKind::Input, instead)?;
        files.check(&[set]);
        Ok(Self { files, set })
    }

    /// Returns the run file.
    #[must_use]
    pub fn run(&self) -> Option<&RunFile> {
        Some(&self.files.runs[self.set.run?].read.tree)
    }

    /// Returns its system file.
    #[must_use]
    pub fn system(&self) -> Option<&SystemFile> {
        Some(&self.files.systems[self.set.system?].read.tree)
    }

    /// Returns its data file.
    #[must_use]
    pub fn data(&self) -> Option<&DataFile> {
        Some(&self.files.data[self.set.data?].read.tree)
    }

    /// Returns its input file.
    #[must_use]
    pub fn input(&self) -> Option<&InputFile> {
        Some(&self.files.inputs[self.set.input?].read.tree)
    }

    /// Returns the findings in each file.
    pub fn findings(&self) -> impl Iterator<Item = &Findings> {
        self.files.all().into_iter().map(|(_, _, findings)| findings)
    }

    /// Returns whether the run cannot be made: a file has errors, or there is no system.
    #[must_use]
    pub fn has_errors(&self) -> bool {
        self.findings().any(Findings::has_errors) || self.run().is_none() || self.system().is_none()
    }

    /// Returns the number of findings of this severity.
    #[must_use]
    pub fn count(&self, severity: Severity) -> usize {
        self.findings().map(|findings| findings.count(severity)).sum()
    }

    /// Returns the texts of all of them.
    #[must_use]
    pub fn texts(&self) -> Texts {
        fn text<T>(list: &[FileEntry<T>], index: Option<usize>) -> Option<Text> {
            let source = &list.get(index?)?.read.source;
            Some(Text {
                name: source.name().to_owned(),
                text: source.text().to_owned(),
            })
        }
        Texts {
            run: text(&self.files.runs, self.set.run),
            system: text(&self.files.systems, self.set.system),
            data: text(&self.files.data, self.set.data),
            input: text(&self.files.inputs, self.set.input),
        }
    }

    /// Returns the files of these texts, which may lie nowhere.
    ///
    /// # Errors
    /// A text is too long.
    pub fn of_texts(texts: &Texts) -> Result<Self, LoadError> {
        fn add<T>(
            list: &mut Vec<FileEntry<T>>,
            text: Option<&Text>,
            read: impl FnOnce(&Arc<SourceText>) -> Read<T>,
        ) -> Result<Option<usize>, LoadError> {
            let Some(text) = text else { return Ok(None) };
            let source = SourceText::from_text(&*text.name, &*text.text).map_err(|error| too_long(&error))?;
            list.push(FileEntry {
                path: PathBuf::from(&text.name),
                read: read(&source),
            });
            Ok(Some(list.len() - 1))
        }
        let mut files = ReadFiles::default();
        let set = FileSet {
            run: add(&mut files.runs, texts.run.as_ref(), read_run)?,
            system: add(&mut files.systems, texts.system.as_ref(), read_system)?,
            data: add(&mut files.data, texts.data.as_ref(), read_data)?,
            input: add(&mut files.inputs, texts.input.as_ref(), read_input)?,
        };
        files.check(&[set]);
        Ok(Self { files, set })
    }
}

/// A file's name and text.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Text {
    /// Its name, perhaps with its folder.
    pub name: String,
    /// Its text.
    pub text: String,
}

/// The texts of a run's files.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Texts {
    /// The run file.
    pub run: Option<Text>,
    /// Its system file.
    pub system: Option<Text>,
    /// Its data file.
    pub data: Option<Text>,
    /// Its input file.
    pub input: Option<Text>,
}
