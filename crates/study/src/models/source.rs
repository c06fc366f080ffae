//! Where a case comes from: what a study varies.

use std::path::{Path, PathBuf};

use nucars::Severity;
use nucars::file_sets::{Instead, LoadError, RunFiles, Texts, find};
use serde::{Deserialize, Serialize};

use super::AnyCase;
use crate::case::{CaseError, Problem};
use crate::half_truck::catalog;
use crate::half_truck::files::{FilesError, Settings, case_of_run};

/// The source of a case: all that is needed to make it, or a variant of it, again on another machine.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub enum CaseSource {
    /// The text of a case file: of a wedge, of a truck or of a car.
    #[serde(alias = "Wedge")]
    File {
        /// The case file's name.
        name: String,
        /// Its text.
        text: String,
        /// The folder of the files that it names.
        folder: PathBuf,
    },
    /// The name of a built-in half-truck.
    BuiltInHalfTruck(String),
    /// The texts of a half-truck's files.
    HalfTruck {
        /// The run file.
        path: PathBuf,
        /// The contents of it and of the files that it names.
        texts: Box<Texts>,
    },
}

impl CaseSource {
    /// Returns the half-truck that a user names: a built-in one, or a run file (ending `.run`), looked for in
    /// `folder`; `None` if neither is meant.
    ///
    /// # Errors
    /// The run file or those that it names cannot be read.
    pub fn half_truck(folder: &Path, named: &Path) -> Result<Option<Self>, LoadError> {
        let path = folder.join(named);
        let built_in = named.to_str().filter(|name| catalog::entry(name).is_some());
        if let Some(name) = built_in.filter(|_| !path.is_file()) {
            return Ok(Some(Self::BuiltInHalfTruck(name.to_owned())));
        }
        if !path
            .extension()
            .is_some_and(|own| own.eq_ignore_ascii_case("run"))
        {
            return Ok(None);
        }
        let path = find(&path)?;
        let texts = Box::new(RunFiles::read(&path, &Instead::default())?.texts());
        Ok(Some(Self::HalfTruck { path, texts }))
    }

    /// Returns the case with these values over it, as `--set` takes them.
    ///
    /// # Errors
    /// Something in it is wrong, or a value does not fit.
    pub fn case(&self, overrides: &[String]) -> Result<AnyCase, CaseError> {
        let settings = Settings {
            set: overrides.to_vec(),
            ..Settings::default()
        };
        let case = match self {
            Self::File { name, text, folder } => return AnyCase::parse(name, text, &**folder, overrides),
            Self::BuiltInHalfTruck(name) => {
                let entry = catalog::entry(name)
                    .ok_or_else(|| Problem::new(format!("there is no built-in half-truck {name}")))?;
                entry.case_with(&settings)
            }
            Self::HalfTruck { path, texts } => {
                let files = RunFiles::of_texts(texts).map_err(|error| Problem::new(error.to_string()))?;
                let shown = path.display();
                let errors = files.count(Severity::Error);
                if errors > 0 {
                    let message = format!("{shown} cannot be run: {errors} errors in its files");
                    let help = format!("`wedgelab nucars check {shown}` tells them with their places");
                    return Err(Problem::new(message).help(help).into());
                }
                case_of_run(path, &files, &settings)
            }
        };
        let case = case.map_err(|error| problem(&error))?;
        Ok(case.into())
    }

    /// Returns the text that identifies the case.
    pub(crate) fn description(&self, base: &AnyCase) -> String {
        let files = || serde_json::to_string(self).unwrap_or_default();
        base.to_toml().unwrap_or_else(files)
    }
}

/// Returns the mistake, shown in the value that was set if it is about one.
fn problem(error: &FilesError) -> Problem {
    let problem = Problem::new(error.to_string());
    let problem = match error {
        FilesError::Set { typed, error } => problem.in_override(typed, error.is_about_value()),
        _ => problem,
    };
    problem.help("`wedgelab nucars show` prints what can be set in the files, with its numbers")
}
