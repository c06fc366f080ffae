//! A case of any model, and where it comes from: what a study varies.

use std::path::{Path, PathBuf};

use nucars::Severity;
use nucars::together::{Instead, LoadError, RunFiles, Texts, find};
use quantity::System as Units;
use serde::{Deserialize, Serialize};

use crate::case::{Case, CaseError, Problem};
use crate::half_truck::files::{FilesError, Settings, case_of_run};
use crate::half_truck::{HalfTruckCase, HalfTruckResult, catalog};
use crate::measures::{self, Definitions, Judged, Unmeasured, half_truck};
use crate::metrics::Cycle;
use crate::result::RunResult;
use crate::run::{Run, RunError};
use crate::summary::Stopped;

/// A case of any model.
#[derive(Clone, Debug)]
pub enum AnyCase {
    /// A wedge's.
    Wedge(Box<Case>),
    /// A half-truck's.
    HalfTruck(Box<HalfTruckCase>),
}

impl AnyCase {
    /// Returns its name.
    #[must_use]
    pub fn name(&self) -> &str {
        match self {
            Self::Wedge(case) => &case.name,
            Self::HalfTruck(case) => &case.name,
        }
    }

    /// Returns the units of its results.
    #[must_use]
    pub fn units(&self) -> Units {
        match self {
            Self::Wedge(case) => case.simulation.output_units,
            Self::HalfTruck(case) => case.units,
        }
    }

    /// Runs it to its end.
    ///
    /// # Errors
    /// The run cannot begin.
    pub fn run(&self) -> Result<AnyResult, RunError> {
        Ok(match self {
            Self::Wedge(case) => AnyResult::Wedge(Box::new(Run::new(&**case)?.finish(|_| ()))),
            Self::HalfTruck(case) => AnyResult::HalfTruck(Box::new(Run::new(&**case)?.finish(|_| ()))),
        })
    }

    /// Returns the cycle of its vertical motion, if that is one sine or triangle.
    #[must_use]
    pub fn cycle(&self) -> Option<Cycle> {
        match self {
            Self::Wedge(case) => Cycle::of(&case.parameters),
            Self::HalfTruck(case) => crate::half_truck::run::cycle(case),
        }
    }

    /// Returns the wedge's case, if it is one.
    #[must_use]
    pub fn wedge(&self) -> Option<&Case> {
        match self {
            Self::Wedge(case) => Some(case),
            Self::HalfTruck(_) => None,
        }
    }

    /// Returns the measures that a study keeps of its runs.
    #[must_use]
    pub fn definitions(&self) -> Definitions {
        match self {
            Self::Wedge(_) => measures::of_wedges().clone(),
            Self::HalfTruck(case) => half_truck::definitions(case),
        }
    }

    /// Runs it, measures it, and judges whether the measures mean something.
    ///
    /// # Errors
    /// The run cannot begin or does not come to its end.
    pub fn judge(&self) -> Result<Judged, Unmeasured> {
        match self {
            Self::Wedge(case) => measures::judge(case),
            Self::HalfTruck(case) => half_truck::judge(case),
        }
    }
}

/// What came out of a run of any model.
#[derive(Clone, Debug)]
pub enum AnyResult {
    /// Of a wedge.
    Wedge(Box<RunResult>),
    /// Of a half-truck.
    HalfTruck(Box<HalfTruckResult>),
}

impl AnyResult {
    /// Returns the values (SI) of the column with this name (without unit).
    #[must_use]
    pub fn column(&self, name: &str) -> Option<&[f64]> {
        match self {
            Self::Wedge(result) => result.column(name),
            Self::HalfTruck(result) => result.column(name),
        }
    }

    /// Returns why and when the run stopped, if it did not come to its end.
    #[must_use]
    pub fn stopped(&self) -> Option<&Stopped> {
        match self {
            Self::Wedge(result) => result.summary.stopped.as_ref(),
            Self::HalfTruck(result) => result.summary.stopped.as_ref(),
        }
    }

    /// Returns what makes the numbers doubtful.
    #[must_use]
    pub fn warnings(&self) -> &[String] {
        match self {
            Self::Wedge(result) => &result.summary.warnings,
            Self::HalfTruck(result) => &result.summary.warnings,
        }
    }

    /// Returns why the numbers are not to be used, if so.
    #[must_use]
    pub fn failed(&self) -> Option<&str> {
        match self {
            Self::Wedge(result) => result.summary.failed.as_deref(),
            Self::HalfTruck(result) => result.summary.failed.as_deref(),
        }
    }

    /// Returns the relative residual of the energy ledger.
    #[must_use]
    pub fn largest_relative_residual(&self) -> f64 {
        match self {
            Self::Wedge(result) => result.summary.ledger.largest_relative_residual,
            Self::HalfTruck(result) => result.summary.largest_relative_residual,
        }
    }
}

/// Where a case comes from: all that is needed to make it, or a variant of it, again on another machine.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub enum CaseSource {
    /// The text of a wedge's case.
    Wedge {
        /// The case file's name.
        name: String,
        /// Its text.
        text: String,
        /// Where the files that it names are looked for.
        folder: PathBuf,
    },
    /// The name of a built-in half-truck.
    BuiltInHalfTruck(String),
    /// The texts of a half-truck's files.
    HalfTruck {
        /// The run file.
        path: PathBuf,
        /// What it and the files that it names hold.
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
            Self::Wedge { name, text, folder } => {
                let case = Case::parse(name, text, &**folder, overrides)?;
                return Ok(AnyCase::Wedge(Box::new(case)));
            }
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
        Ok(AnyCase::HalfTruck(Box::new(case)))
    }

    /// Returns what decides which case it is, as text.
    pub(crate) fn description(&self, base: &AnyCase) -> String {
        match base {
            AnyCase::Wedge(case) => case.document.clone().with_tables_embedded().to_toml(),
            AnyCase::HalfTruck(_) => serde_json::to_string(self).unwrap_or_default(),
        }
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
