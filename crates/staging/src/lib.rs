//! Files that appear whole or not at all.
//!
//! Files of one result are written and synchronised in a hidden folder beside their destination. If the
//! destination is new, this folder is renamed to it in one step. If it exists, its files are renamed into it
//! one by one, each in one step; between two of them a crash of the machine may leave files of two results
//! side by side, but never half a file.
//!
//! A program that is told to end calls [`abandon`]; [`remove_left_over`] finds what a killed one left.
//!
//! ```
//! use std::fs;
//! use staging::Folder;
//!
//! let base = tempfile::tempdir()?;
//! let folder = Folder::check(base.path().join("run"), &["summary.txt"], false)?;
//! folder.write(|files| files.add("summary.txt", |out| out.write_all(b"loss: 12 J\n")))?;
//! assert_eq!(fs::read_to_string(base.path().join("run/summary.txt"))?, "loss: 12 J\n");
//! // Results are not overwritten unless that is asked for.
//! assert!(Folder::check(base.path().join("run"), &["summary.txt"], false).is_err());
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

use std::fs::{self, File};
use std::io::{self, BufWriter, Write};
use std::path::{Path, PathBuf};

use miette::Diagnostic;
use thiserror::Error;

mod hidden;
mod lock;

pub use hidden::PREFIX as HIDDEN;
use hidden::Staging;
pub use hidden::{Abandoned, abandon, remove_left_over};
pub use lock::Locked;

/// Reasons why files cannot be written.
#[derive(Debug, Error, Diagnostic)]
pub enum FileError {
    /// There are results already.
    #[error("there are results already: {}", shown(.files))]
    #[diagnostic(help("choose another folder with --out, or overwrite them with --force"))]
    Exists {
        /// The files that are in the way.
        files: Vec<PathBuf>,
    },
    /// Something else is in the place of a folder.
    #[error("`{}` is not a folder, so `{}` cannot be written", .path.display(), .folder.display())]
    #[diagnostic(help("choose another folder with --out"))]
    NotAFolder {
        /// The obstacle.
        path: PathBuf,
        /// The folder that was wanted.
        folder: PathBuf,
    },
    /// A folder is in the place of a file.
    #[error("`{}` is a folder; a file is to be written there", .path.display())]
    #[diagnostic(help("move it away, or choose another folder with --out"))]
    NotAFile {
        /// The folder that is in the way.
        path: PathBuf,
    },
    /// The folder cannot be made or written to.
    #[error("cannot write into `{}`: {reason}", .folder.display())]
    #[diagnostic(help("choose a folder that you may write to with --out"))]
    Unwritable {
        /// The folder.
        folder: PathBuf,
        /// The reason.
        reason: io::Error,
    },
    /// A file cannot be written.
    #[error("cannot write `{}`: {reason}", .file.display())]
    #[diagnostic(help(
        "nothing of this result was left there; look for space and rights, or choose another folder with \
         --out"
    ))]
    Write {
        /// The file.
        file: PathBuf,
        /// The reason.
        reason: io::Error,
    },
}

fn shown(files: &[PathBuf]) -> String {
    const MOST: usize = 3;
    let names: Vec<String> = files
        .iter()
        .take(MOST)
        .map(|file| format!("`{}`", file.display()))
        .collect();
    let names = names.join(", ");
    match files.len().saturating_sub(MOST) {
        0 => names,
        more => format!("{names}, and {more} more"),
    }
}

/// A folder that will hold results, found fit for it.
#[derive(Clone, Debug)]
pub struct Folder {
    path: PathBuf,
    force: bool,
    /// The nearest folder above (or itself) that existed before.
    existing: PathBuf,
}

impl Folder {
    /// Checks that the files `names` can be written into the folder `path`, which is made when they are.
    ///
    /// # Errors
    /// The folder cannot be made or written to, or, unless `force`, one of the files exists.
    pub fn check(path: impl Into<PathBuf>, names: &[&str], force: bool) -> Result<Self, FileError> {
        let path = path.into();
        let existing = nearest_existing(&path)?;
        drop(Staging::new(&existing, None)?);
        let folder = Self {
            path,
            force,
            existing,
        };
        folder.refuse(names.iter().copied())?;
        Ok(folder)
    }

    /// Returns the folder.
    #[must_use]
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// Writes files, all of them or none.
    ///
    /// # Errors
    /// A file cannot be written, or has appeared since the folder was checked.
    pub fn write(
        &self,
        write: impl FnOnce(&mut Files<'_>) -> Result<(), FileError>,
    ) -> Result<(), FileError> {
        let done = self.try_write(write);
        if done.is_err() {
            self.remove_empty();
        }
        done
    }

    fn try_write(
        &self,
        write: impl FnOnce(&mut Files<'_>) -> Result<(), FileError>,
    ) -> Result<(), FileError> {
        let exists = self.path.is_dir();
        let beside = if exists {
            self.path.as_path()
        } else {
            parent(&self.path)
        };
        fs::create_dir_all(beside).map_err(|reason| FileError::Unwritable {
            folder: beside.to_owned(),
            reason,
        })?;
        let hidden = Staging::new(beside, Some(self))?;
        let stage = hidden.result().map_err(|reason| FileError::Unwritable {
            folder: beside.to_owned(),
            reason,
        })?;
        let mut files = Files {
            folder: self,
            stage: &stage,
            names: Vec::new(),
            superseded: Vec::new(),
        };
        write(&mut files)?;
        let Files {
            names, superseded, ..
        } = files;
        Staging::place(&self.path, || {
            if !exists && fs::rename(&stage, &self.path).is_ok() {
                return Ok(());
            }
            // The folder exists, perhaps since a moment ago.
            self.refuse(names.iter().chain(&superseded).map(String::as_str))?;
            for name in &superseded {
                let file = self.path.join(name);
                match fs::remove_file(&file) {
                    Err(reason) if reason.kind() != io::ErrorKind::NotFound => {
                        return Err(FileError::Write { file, reason });
                    }
                    _ => {}
                }
            }
            for name in &names {
                let file = self.path.join(name);
                fs::rename(stage.join(name), &file).map_err(|reason| FileError::Write { file, reason })?;
            }
            Ok(())
        })
    }

    fn refuse<'n>(&self, names: impl Iterator<Item = &'n str>) -> Result<(), FileError> {
        let mut files: Vec<PathBuf> = names.map(|name| self.path.join(name)).collect();
        files.retain(|file| fs::symlink_metadata(file).is_ok());
        if let Some(path) = files.iter().find(|file| file.is_dir()) {
            return Err(FileError::NotAFile { path: path.clone() });
        }
        if files.is_empty() || self.force {
            return Ok(());
        }
        Err(FileError::Exists { files })
    }

    /// Removes the folders that were made, as far as they are empty.
    fn remove_empty(&self) {
        for folder in self.path.ancestors() {
            if folder == self.existing || folder.as_os_str().is_empty() {
                return;
            }
            match fs::remove_dir(folder) {
                Ok(()) => {}
                // It was not made yet; those above may have been.
                Err(error) if error.kind() == io::ErrorKind::NotFound => {}
                Err(_) => return,
            }
        }
    }
}

/// Checks several folders and reports all existing files at once.
///
/// # Errors
/// As [`Folder::check`].
pub fn check_all<'n>(
    folders: impl IntoIterator<Item = (PathBuf, &'n [&'n str])>,
    force: bool,
) -> Result<Vec<Folder>, FileError> {
    let mut fit = Vec::new();
    let mut existing = Vec::new();
    for (path, names) in folders {
        match Folder::check(path, names, force) {
            Ok(folder) => fit.push(folder),
            Err(FileError::Exists { mut files }) => existing.append(&mut files),
            Err(error) => return Err(error),
        }
    }
    if existing.is_empty() {
        Ok(fit)
    } else {
        Err(FileError::Exists { files: existing })
    }
}

/// Files being written, not yet at their place.
#[derive(Debug)]
pub struct Files<'f> {
    folder: &'f Folder,
    stage: &'f Path,
    names: Vec<String>,
    superseded: Vec<String>,
}

impl Files<'_> {
    /// Has a file of an earlier result, which this one is not to lie beside, removed when the files come to
    /// their place.
    pub fn supersede(&mut self, name: &str) {
        self.superseded.push(name.to_owned());
    }

    /// Adds a file.
    ///
    /// # Errors
    /// It cannot be written.
    pub fn add(
        &mut self,
        name: &str,
        write: impl FnOnce(&mut (dyn Write + Send)) -> io::Result<()>,
    ) -> Result<(), FileError> {
        let written = File::create_new(self.stage.join(name)).and_then(|file| {
            let mut out = BufWriter::with_capacity(1 << 16, file);
            write(&mut out)?;
            out.into_inner()
                .map_err(io::IntoInnerError::into_error)?
                .sync_all()
        });
        written.map_err(|reason| FileError::Write {
            file: self.folder.path.join(name),
            reason,
        })?;
        self.names.push(name.to_owned());
        Ok(())
    }
}

fn parent(path: &Path) -> &Path {
    match path.parent() {
        Some(parent) if !parent.as_os_str().is_empty() => parent,
        _ => Path::new("."),
    }
}

fn nearest_existing(path: &Path) -> Result<PathBuf, FileError> {
    for ancestor in path.ancestors() {
        let ancestor = if ancestor.as_os_str().is_empty() {
            Path::new(".")
        } else {
            ancestor
        };
        match fs::metadata(ancestor) {
            Ok(found) if found.is_dir() => return Ok(ancestor.to_owned()),
            Ok(_) => {
                return Err(FileError::NotAFolder {
                    path: ancestor.to_owned(),
                    folder: path.to_owned(),
                });
            }
            Err(error)
                if matches!(
                    error.kind(),
                    io::ErrorKind::NotFound | io::ErrorKind::NotADirectory
                ) => {}
            Err(reason) => {
                return Err(FileError::Unwritable {
                    folder: ancestor.to_owned(),
                    reason,
                });
            }
        }
    }
    Ok(PathBuf::from("."))
}
