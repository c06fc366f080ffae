//! Errors in the folder of a run.

use std::path::{Path, PathBuf};

use input::file::ReadError;
use input::shortened;
use miette::Diagnostic;
use study::models::{AnyCase, MODELS};
use thiserror::Error;

use crate::table::{TableError, in_folder, is_of_run};
use crate::{study_folder, summary};

/// The file of the statements of a reproduction of the thesis, by which its folder is known.
pub const REPRODUCTION_FILE: &str = "claims.json";

/// Reasons why there is no run to read. Lines and columns count from one.
#[derive(Debug, Error, Diagnostic)]
pub enum RunFolderError {
    /// The table cannot be read.
    #[error(transparent)]
    #[diagnostic(transparent)]
    Table(#[from] TableError),
    /// The path is not the folder of a run.
    #[error("`{}` is {what}; the folder of a run is expected", .path.display())]
    #[diagnostic(help("{advice}"))]
    NoRun {
        /// The name given.
        path: PathBuf,
        /// The type that it seems to have.
        what: &'static str,
        /// The command that takes it, or the file to name instead.
        advice: String,
    },
    /// A table without a summary.
    #[error("there is no summary.json in `{}`", .folder.display())]
    #[diagnostic(help(
        "a report needs both files of a run; `wedgelab compare` and `wedgelab plot` take tables alone"
    ))]
    NoSummary {
        /// The folder.
        folder: PathBuf,
    },
    /// The summary is not read.
    #[error(transparent)]
    Unreadable(ReadError),
    /// The summary is of another version, or of something else.
    #[error("`{}` has the schema {found}; this version reads {expected}", .file.display())]
    #[diagnostic(help("{advice}"))]
    Schema {
        /// The file.
        file: PathBuf,
        /// Its schema.
        found: String,
        /// Those that are read.
        expected: String,
        /// The advice.
        advice: String,
    },
    /// The summary is not what its schema says.
    #[error("`{}`, line {line}, column {column}: {reason}", .file.display())]
    #[diagnostic(help("the file is damaged: copy it again, or run the case again with --force"))]
    Damaged {
        /// The file.
        file: PathBuf,
        /// The line.
        line: usize,
        /// The column.
        column: usize,
        /// The mistake there.
        reason: String,
    },
}

impl RunFolderError {
    /// Returns a summary that does not follow its schema.
    pub(super) fn damaged(file: &Path, error: &serde_json::Error) -> Self {
        let text = error.to_string();
        let reason = match error.is_eof() {
            true => "the file ends here: it was cut off",
            false => text
                .rsplit_once(" at line ")
                .map_or(text.as_str(), |(own, _)| own),
        };
        Self::Damaged {
            file: file.to_owned(),
            line: error.line(),
            column: error.column(),
            reason: shortened(reason),
        }
    }

    /// Returns a summary of another schema.
    pub(super) fn schema(file: &Path, found: &str) -> Self {
        let stem = |schema: &str| schema.split('/').next().unwrap_or_default().to_owned();
        let folder = file.parent().unwrap_or(Path::new(".")).display();
        let same = MODELS.iter().find(|model| stem(model.schema) == stem(found));
        Self::Schema {
            file: file.to_owned(),
            found: match found {
                "" => "of no name".to_owned(),
                found => format!("`{}`", shortened(found)),
            },
            expected: match same {
                Some(model) => format!("`{}`", model.schema),
                None => MODELS
                    .each_ref()
                    .map(|model| format!("`{}`", model.schema))
                    .join(", "),
            },
            advice: match same {
                Some(model) if model.command == "run" => format!(
                    "another version of the program wrote it: `wedgelab run {folder}/case.toml --out \
                     {folder} --force` runs the case again with this one"
                ),
                Some(model) => format!(
                    "another version of the program wrote it: run the case again with `wedgelab {}`",
                    model.command
                ),
                None => "name the folder of a run, which `wedgelab run` has written".to_owned(),
            },
        }
    }
}

/// Returns the folder of a run that is meant: itself, or that of its table or `summary.json`.
pub(super) fn folder_of(path: &Path) -> Result<PathBuf, RunFolderError> {
    let no_run = |what: &'static str, advice: String| RunFolderError::NoRun {
        path: path.to_owned(),
        what,
        advice,
    };
    if path.is_dir() {
        let holds = |name: &str| path.join(name).exists();
        let result = in_folder(path).is_some();
        if !result && holds(study_folder::STUDY_FILE) {
            let advice = format!(
                "its own page is {}; `wedgelab report` takes single runs",
                path.join(crate::page::FILE_NAME).display()
            );
            return Err(no_run("the folder of a study", advice));
        }
        if !result && holds(REPRODUCTION_FILE) {
            let advice = format!(
                "its own page is {}; its runs are the folders in {}",
                path.join(crate::page::FILE_NAME).display(),
                path.join("runs").display()
            );
            return Err(no_run("the folder of a whole reproduction", advice));
        }
        return Ok(path.to_owned());
    }
    let named = path
        .file_name()
        .and_then(|name| name.to_str())
        .unwrap_or_default();
    if (is_of_run(path) || named == summary::FILE_NAME) && path.is_file() {
        let parent = path.parent().filter(|parent| !parent.as_os_str().is_empty());
        return Ok(parent.unwrap_or(Path::new(".")).to_owned());
    }
    if path.is_file() {
        // Says what the file is, and which command takes it; a table is no run.
        crate::table::ResultTable::read(path)?;
        let advice = "a report needs the folder with the table and summary.json; `wedgelab compare` and \
                      `wedgelab plot` take tables alone";
        return Err(no_run("a table", advice.to_owned()));
    }
    let name = path.to_str().unwrap_or_default();
    if !path.exists() && matches!(AnyCase::built_in(name, &[]), Ok(Some(_))) {
        let advice = format!("`wedgelab run {name}` runs it, and writes the folder {name}");
        return Err(no_run("the name of a built-in case", advice));
    }
    Ok(path.to_owned())
}
