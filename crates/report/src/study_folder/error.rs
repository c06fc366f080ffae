//! Errors in the folder of a study.

use std::io;
use std::path::{Path, PathBuf};

use input::bounded;
use miette::Diagnostic;
use serde_json::Value;
use thiserror::Error;

use staging::FileError;

/// Reasons why a study's folder cannot be used.
#[derive(Debug, Error, Diagnostic)]
pub enum StudyFolderError {
    /// It cannot be made or written to.
    #[error(transparent)]
    #[diagnostic(transparent)]
    File(#[from] FileError),
    /// There is something else in it.
    #[error("`{}` is not empty and holds no study: there is `{name}`", .folder.display())]
    #[diagnostic(help("choose another folder with --out"))]
    NotAStudy {
        /// The folder.
        folder: PathBuf,
        /// A file that is there.
        name: String,
    },
    /// Another program works in it.
    #[error("another program works in `{}`", .folder.display())]
    #[diagnostic(help("wait until it is done, or end it; the study can go on from there"))]
    Busy {
        /// The folder.
        folder: PathBuf,
    },
    /// It holds another study.
    #[error("`{}` holds runs of another study: {changed}", .folder.display())]
    #[diagnostic(help(
        "runs of two studies cannot stand in one table. Choose another folder with --out for the changed \
         study, or undo the change to go on with this one; nothing was touched"
    ))]
    Changed {
        /// The folder.
        folder: PathBuf,
        /// The difference in words.
        changed: String,
    },
    /// A file cannot be read or understood.
    #[error("cannot read `{}`: {reason}", .file.display())]
    #[diagnostic(help(
        "look for rights and for damage of the disk; nothing was touched. Without this file the study can \
         go on once it is moved away: its runs are computed again, all others are kept"
    ))]
    Unreadable {
        /// The file.
        file: PathBuf,
        /// The reason.
        reason: io::Error,
    },
    /// A part with records of another study.
    #[error("`{}` holds records of another study", .file.display())]
    #[diagnostic(help("move this file away: its runs are computed again, all others are kept"))]
    ForeignPart {
        /// The file.
        file: PathBuf,
    },
    /// Records sent by a worker that are none of this study.
    #[error("what a worker sent are no records of this study")]
    #[diagnostic(help("all workers need the same study file and the same version of the program"))]
    ForeignBytes,
    /// Two records of one variant.
    #[error("`{}` holds two different results of run {number}", .file.display())]
    #[diagnostic(help(
        "the same run gives the same bits; two versions of the program may have worked here. Move this file \
         away: its runs are computed again, all others are kept"
    ))]
    Contradiction {
        /// The variant.
        number: u64,
        /// The file.
        file: PathBuf,
    },
    /// A record could not be written.
    #[error("cannot write into `{}`: {reason}", .file.display())]
    #[diagnostic(help(
        "all runs that were written before are kept. Look for space and rights, then give the same command \
         again: the study goes on where it was"
    ))]
    Append {
        /// The file.
        file: PathBuf,
        /// The reason.
        reason: io::Error,
    },
    /// The table or the page could not be written.
    #[error("cannot write `{}`: {reason}", .file.display())]
    #[diagnostic(help(
        "every run is kept. Look for space and rights, then give the same command again: no run is computed \
         again, only this file is made"
    ))]
    Table {
        /// The file.
        file: PathBuf,
        /// The reason.
        reason: io::Error,
    },
    /// Not all variants are there.
    #[error("{missing} runs are missing")]
    #[diagnostic(help("give the command again to compute them"))]
    Incomplete {
        /// Their least number.
        missing: usize,
    },
}

impl StudyFolderError {
    /// Returns the error of making something from runs that are all kept.
    #[must_use]
    pub fn after_all_runs(error: FileError) -> Self {
        match error {
            FileError::Write { file, reason } => Self::Table { file, reason },
            other => Self::File(other),
        }
    }
}

/// Refuses a folder whose study is not this one; says what is different.
pub(super) fn compare(folder: &Path, file: &Path, found: &str, wanted: &str) -> Result<(), StudyFolderError> {
    if found == wanted {
        return Ok(());
    }
    let parse = |text: &str| {
        serde_json::from_str::<Value>(text).map_err(|error| StudyFolderError::Unreadable {
            file: file.to_owned(),
            reason: io::Error::other(error),
        })
    };
    let (found, wanted) = (parse(found)?, parse(wanted)?);
    let keys = [
        ("version", "the version of the study's computation"),
        ("program", "the version of the program"),
        ("runs", "the number of runs"),
        ("sampling", "how they are chosen"),
        ("accuracy", "the accuracy"),
        ("factors", "the parameters varied or their values"),
        ("list", "the list of variants"),
        ("method", "the method or its numbers"),
        ("uncertain", "the uncertain parameters or their distributions"),
        ("limit", "the limit"),
        ("indices", "the samples of indices"),
        ("set", "what is set for all runs"),
        ("case", "the case"),
    ];
    let changed: Vec<String> = keys
        .iter()
        .filter(|(key, _)| found.get(key) != wanted.get(key))
        .map(|(key, words)| {
            let short = |value: Option<&Value>| match value {
                Some(Value::Number(number)) => Some(number.to_string()),
                Some(Value::String(text)) if !text.contains('\n') => Some(text.clone()),
                _ => None,
            };
            match (short(found.get(key)), short(wanted.get(key))) {
                (Some(old), Some(new)) => format!("{words} was {old} there and is {new} now"),
                _ if *key == "case" => changed_lines(&found, &wanted),
                _ => format!("{words} changed"),
            }
        })
        .collect();
    if changed.is_empty() {
        // The same, written in another way.
        return Ok(());
    }
    Err(StudyFolderError::Changed {
        folder: folder.to_owned(),
        changed: bounded(changed.join("; ")),
    })
}

/// Returns the first lines of the case that differ.
fn changed_lines(found: &Value, wanted: &Value) -> String {
    let text = |value: &Value| {
        let text = value.get("case").and_then(Value::as_str);
        text.unwrap_or_default().to_owned()
    };
    let (found, wanted) = (text(found), text(wanted));
    let pair = found.lines().zip(wanted.lines()).find(|(old, new)| old != new);
    let plain = |line: &str| line.split(" #").next().unwrap_or_default().trim().to_owned();
    match pair {
        Some((old, new)) => format!("the case changed: `{}` is now `{}`", plain(old), plain(new)),
        None => "the case changed".to_owned(),
    }
}
