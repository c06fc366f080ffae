//! The case that changes are laid over: a file as it was when the program started, or a built-in case.

use std::fs;
use std::path::{Path, PathBuf};

use study::case::{Case, CaseError, builtin};

use super::super::run;
use crate::failure::{Failure, Message};

/// A case without changes.
#[derive(Clone, Debug)]
pub enum Base {
    /// A built-in case.
    BuiltIn(String),
    /// A file, read once; tables that it names are read at each run.
    File {
        /// Its name in messages.
        name: String,
        /// What was in it.
        text: String,
        /// Where its tables are.
        folder: PathBuf,
    },
}

impl Base {
    /// The case of `wedgelab run PATH`, checked.
    pub fn open(path: &Path) -> Result<Self, Failure> {
        run::read(path, &[])?;
        if run::is_built_in(path) {
            return Ok(Self::BuiltIn(path.display().to_string()));
        }
        let text = fs::read_to_string(path).map_err(|error| {
            Message::new(
                format!("the case file {} cannot be read: {error}", path.display()),
                "",
            )
        })?;
        Ok(Self::File {
            name: path.display().to_string(),
            text,
            folder: path.parent().unwrap_or(Path::new("")).to_owned(),
        })
    }

    /// The case with changes, each as `--set` takes it.
    ///
    /// # Errors
    /// A change is wrong, or the built-in case does not exist.
    pub fn with(&self, overrides: &[String]) -> Result<Case, CaseError> {
        match self {
            Self::BuiltIn(name) => builtin::case_with(name, overrides),
            Self::File { name, text, folder } => Case::parse(name, text, folder, overrides),
        }
    }

    /// The built-in case's name.
    pub fn preset(&self) -> Option<&str> {
        match self {
            Self::BuiltIn(name) => Some(name),
            Self::File { .. } => None,
        }
    }
}
