//! The folder in which tables that a case names are searched, and the files that may be read for them.

use std::fs;
use std::io::ErrorKind;
use std::path::{Component, Path, PathBuf};

/// The folder in which tables are looked for, and which files may be read.
///
/// A path alone stands for [`Tables::anywhere`], which is right for a case that its own user wrote. A program
/// that takes values from others reads [`Tables::below`] the folder, or [`Tables::nowhere`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Tables<'a> {
    folder: &'a Path,
    access: Access,
}

/// The files that may be read.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Access {
    Anywhere,
    BelowFolder,
    Nowhere,
}

/// The reason why a table's file is not read.
#[derive(Debug)]
pub(crate) struct Refused {
    /// The mistake, after the name of the file.
    pub reason: String,
    /// The advice.
    pub help: &'static str,
}

/// A file that a case names.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct NamedFile {
    /// The key that names it: `wheels.profile`, `rails.profile`, or `table` of a track.
    pub key: &'static str,
    /// Its name as typed.
    pub typed: String,
    /// The place where it was read.
    pub path: PathBuf,
    /// The files that it names itself, as a list of sections does: their names in it, and their places.
    pub listed: Vec<(String, PathBuf)>,
}

impl<'a> Tables<'a> {
    /// Every file that the program's user may read; names are taken from `folder`.
    #[must_use]
    pub fn anywhere(folder: &'a Path) -> Self {
        Self {
            folder,
            access: Access::Anywhere,
        }
    }

    /// Regular files that, with links resolved, lie in `folder` or below it. Messages do not tell what is in
    /// them.
    #[must_use]
    pub fn below(folder: &'a Path) -> Self {
        Self {
            folder,
            access: Access::BelowFolder,
        }
    }

    /// No file at all: tables stand in the case itself.
    #[must_use]
    pub fn nowhere() -> Self {
        Self {
            folder: Path::new(""),
            access: Access::Nowhere,
        }
    }

    /// Returns the same access, to files beside another one: what a file names is looked for from its own
    /// folder.
    pub(crate) fn beside(self, folder: &Path) -> Tables<'_> {
        Tables {
            folder,
            access: self.access,
        }
    }

    /// Returns whether messages may tell what is in a table's file.
    pub(crate) fn may_quote(self) -> bool {
        self.access == Access::Anywhere
    }

    /// Returns the name of a file in messages: with its folder, or, if files are restricted, as typed.
    pub(crate) fn shown(self, file: &str) -> String {
        match self.access {
            Access::Anywhere => self.folder.join(file).display().to_string(),
            Access::BelowFolder | Access::Nowhere => file.to_owned(),
        }
    }

    /// Returns the path to read a file at.
    pub(crate) fn locate(self, file: &str) -> Result<PathBuf, Refused> {
        match self.access {
            Access::Anywhere => Ok(self.folder.join(file)),
            Access::BelowFolder => self.locate_below(file),
            Access::Nowhere => Err(Refused {
                reason: "is not read: tables in files are not read here".to_owned(),
                help: "write the points themselves, or begin with a case file in the folder of the table",
            }),
        }
    }

    fn locate_below(self, file: &str) -> Result<PathBuf, Refused> {
        const HELP: &str =
            "copy the table into the folder of the case file and name it by its path from there";
        let outside = || Refused {
            reason: "is not read: it does not lie in the folder of the case file".to_owned(),
            help: HELP,
        };
        let unreadable = |error: std::io::Error| match error.kind() {
            ErrorKind::NotFound => Refused {
                reason: "does not exist".to_owned(),
                help: "files are looked for from the folder of the case file; check the name",
            },
            _ => Refused {
                reason: format!("cannot be read: {error}"),
                help: "name a CSV text file in the folder of the case file",
            },
        };
        let folder = match self.folder {
            folder if folder == Path::new("") => Path::new("."),
            folder => folder,
        };
        let folder = fs::canonicalize(folder).map_err(unreadable)?;
        // Nothing outside is read: messages do not say either whether a file exists there.
        let name = Path::new(file);
        let name = name.strip_prefix(&folder).unwrap_or(name);
        if !stays_inside(name) {
            return Err(outside());
        }
        let full = fs::canonicalize(folder.join(name)).map_err(unreadable)?;
        if !full.starts_with(&folder) {
            return Err(outside());
        }
        if !fs::metadata(&full).map_err(unreadable)?.is_file() {
            return Err(Refused {
                reason: "is not a regular file".to_owned(),
                help: "name a CSV text file in the folder of the case file",
            });
        }
        Ok(full)
    }
}

/// Returns whether a path is relative and never climbs above where it begins.
fn stays_inside(path: &Path) -> bool {
    let mut depth = 0_usize;
    path.components().all(|component| match component {
        Component::Normal(_) => {
            depth += 1;
            true
        }
        Component::CurDir => true,
        Component::ParentDir => {
            let inside = depth > 0;
            depth = depth.saturating_sub(1);
            inside
        }
        Component::RootDir | Component::Prefix(_) => false,
    })
}

impl<'a> From<&'a Path> for Tables<'a> {
    fn from(folder: &'a Path) -> Self {
        Self::anywhere(folder)
    }
}

impl<'a> From<&'a PathBuf> for Tables<'a> {
    fn from(folder: &'a PathBuf) -> Self {
        Self::anywhere(folder)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn paths_that_leave_their_folder_are_recognized() {
        for inside in ["a.csv", "./a.csv", "b/../a.csv", "b/c/../../a.csv", ""] {
            assert!(stays_inside(Path::new(inside)), "{inside}");
        }
        for outside in ["..", "../a.csv", "b/../../a.csv", "/etc/passwd", "./../b/a.csv"] {
            assert!(!stays_inside(Path::new(outside)), "{outside}");
        }
    }
}
