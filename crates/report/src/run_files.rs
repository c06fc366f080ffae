//! The files of a run: the table, the same under the thesis's names, the completed case, the summary.

use study::case::Case;
use study::result::RunResult;

use crate::files::{FileError, Folder};
use crate::{csv, mat, summary};

/// The name of the case's file.
pub const CASE_FILE_NAME: &str = "case.toml";
/// The files of a run.
pub const NAMES: [&str; 4] = [csv::FILE_NAME, mat::FILE_NAME, CASE_FILE_NAME, summary::FILE_NAME];

/// Writes the files of a run, all of them or none.
///
/// The case is written completed, with the tables that it took from other files inside, so that it runs
/// anywhere.
///
/// # Errors
/// A file cannot be written.
pub fn write(folder: &Folder, case: &Case, result: &RunResult) -> Result<(), FileError> {
    folder.write(|files| {
        files.add(csv::FILE_NAME, |out| csv::write(result, out))?;
        files.add(mat::FILE_NAME, |out| mat::write(case, result, out))?;
        files.add(CASE_FILE_NAME, |out| {
            let document = case.document.clone().with_tables_embedded();
            out.write_all(document.to_toml().as_bytes())
        })?;
        files.add(summary::FILE_NAME, |out| summary::write(&result.summary, out))
    })
}
