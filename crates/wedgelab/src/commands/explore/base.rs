//! The case that changes are laid over: a file as it was when the program started, or a built-in case.
//!
//! Changes come from a page, so tables in files are read below the folder of the case file only, and none at
//! all for a built-in case.

use std::path::{Path, PathBuf};

use study::case::{CaseError, Tables, builtin, text_of};
use study::models::{AnyCase, built_in};

use super::super::run;
use super::limits;
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
        /// Its contents.
        text: String,
        /// The folder of its tables.
        folder: PathBuf,
    },
}

impl Base {
    /// Returns the case of `wedgelab run PATH`, checked.
    pub fn open(path: &Path) -> Result<Self, Failure> {
        run::read_any(path, &[])?;
        let base = if run::is_built_in(path) {
            Self::BuiltIn(path.display().to_string())
        } else {
            Self::File {
                name: path.display().to_string(),
                text: text_of(path)?,
                folder: path.parent().unwrap_or(Path::new("")).to_owned(),
            }
        };
        let case = base.with(&[])?;
        limits::check(&case).map_err(|refused| Message::new(refused.message, refused.help))?;
        Ok(base)
    }

    /// Returns the case with changes, each as `--set` takes it.
    ///
    /// # Errors
    /// A change is wrong, or the built-in case does not exist.
    pub fn with(&self, overrides: &[String]) -> Result<AnyCase, CaseError> {
        match self {
            Self::BuiltIn(name) => {
                let text = match built_in(name) {
                    Some(own) => own.text(),
                    None => builtin::text(name)?,
                };
                AnyCase::parse(&format!("{name}.toml"), text, Tables::nowhere(), overrides)
            }
            Self::File { name, text, folder } => AnyCase::parse(name, text, Tables::below(folder), overrides),
        }
    }

    /// Returns the built-in case's name.
    pub fn preset(&self) -> Option<&str> {
        match self {
            Self::BuiltIn(name) => Some(name),
            Self::File { .. } => None,
        }
    }
}
