//! A case of any model, and where it comes from: what a study varies.

use std::path::{Path, PathBuf};

use mechanics::output::Column;
use nucars::Severity;
use nucars::file_sets::{Instead, LoadError, RunFiles, Texts, find};
use quantity::System as Units;
use serde::{Deserialize, Serialize};

use crate::car::{self, CarCase};
use crate::case::model::{Model, model};
use crate::case::problem::Problems;
use crate::case::{Case, CaseError, FieldSection, Problem, Tables, builtin, text_of, tree_with_overrides};
use crate::half_truck::files::{FilesError, Settings, case_of_run};
use crate::half_truck::{HalfTruckCase, catalog};
use crate::measures::{self, Definitions, Judged, Unmeasured, half_truck};
use crate::metrics::Cycle;
use crate::outcome::Outcome;
use crate::result::RunResult;
use crate::run::{Run, RunCase, RunError};
use crate::summary::RunSummary;
use crate::truck::{self, TruckCase};

/// A case of any model.
#[derive(Clone, Debug)]
pub enum AnyCase {
    /// A wedge's.
    Wedge(Box<Case>),
    /// A half-truck's.
    HalfTruck(Box<HalfTruckCase>),
    /// A truck's.
    Truck(Box<TruckCase>),
    /// A car's.
    Car(Box<CarCase>),
}

/// Does the same with the case of whatever model.
macro_rules! each {
    ($any:expr, $case:ident => $do:expr) => {
        match $any {
            AnyCase::Wedge($case) => $do,
            AnyCase::HalfTruck($case) => $do,
            AnyCase::Truck($case) => $do,
            AnyCase::Car($case) => $do,
        }
    };
}

impl AnyCase {
    /// Reads a case file of a wedge, of a truck (`model = "truck"`) or of a car (`model = "car"`) and lays
    /// `--set` overrides (`path.key=value`) over it.
    ///
    /// # Errors
    /// As [`Case::read`].
    pub fn read(path: &Path, overrides: &[String]) -> Result<Self, CaseError> {
        let text = text_of(path)?;
        let folder = path.parent().unwrap_or(Path::new(""));
        Self::parse(&path.display().to_string(), &text, folder, overrides)
    }

    /// As [`AnyCase::read`], from a text, as [`Case::parse`].
    ///
    /// # Errors
    /// As [`Case::parse`].
    pub fn parse<'t>(
        source: &str,
        text: &str,
        tables: impl Into<Tables<'t>>,
        overrides: &[String],
    ) -> Result<Self, CaseError> {
        let (tree, problems) = tree_with_overrides(source, text, overrides)?;
        let tables = tables.into();
        Ok(match model(&tree, &mut Problems::new()) {
            Some(Model::Truck) => Self::Truck(Box::new(TruckCase::of_tree(tree, source, tables, problems)?)),
            Some(Model::Car) => Self::Car(Box::new(CarCase::of_tree(tree, source, tables, problems)?)),
            _ => Self::Wedge(Box::new(Case::of_tree(tree, source, tables, problems)?)),
        })
    }

    /// Returns the built-in case of this name, of a wedge, a truck or a car; `None` if there is none.
    ///
    /// # Errors
    /// An override is wrong.
    pub fn built_in(name: &str, overrides: &[String]) -> Result<Option<Self>, CaseError> {
        let name = &*builtin::own_name(name);
        if builtin::names().any(|own| own == name) {
            let case = builtin::case_with(name, overrides)?;
            return Ok(Some(Self::Wedge(Box::new(case))));
        }
        if truck::builtin::names().any(|own| own == name) {
            let case = truck::builtin::case_with(name, overrides)?;
            return Ok(Some(Self::Truck(Box::new(case))));
        }
        if car::builtin::names().any(|own| own == name) {
            let case = car::builtin::case_with(name, overrides)?;
            return Ok(Some(Self::Car(Box::new(case))));
        }
        Ok(None)
    }

    /// Returns its name.
    #[must_use]
    pub fn name(&self) -> &str {
        each!(self, case => &case.name)
    }

    /// Returns the units of its results.
    #[must_use]
    pub fn units(&self) -> Units {
        each!(self, case => RunCase::units(&**case))
    }

    /// Runs it to its end.
    ///
    /// # Errors
    /// The run cannot begin.
    pub fn run(&self) -> Result<AnyResult, RunError> {
        each!(self, case => Ok(AnyResult::of(Run::new(&**case)?.finish(|_| ()))))
    }

    /// Returns the cycle of its vertical motion, if that is one sine or triangle.
    #[must_use]
    pub fn cycle(&self) -> Option<Cycle> {
        match self {
            Self::Wedge(case) => Cycle::of(&case.parameters),
            Self::HalfTruck(case) => crate::half_truck::run::cycle(case),
            Self::Truck(case) => Cycle::of_motion(&case.parameters.bolster.motion.coordinates[2]),
            Self::Car(_) => None,
        }
    }

    /// Returns the wedge's case, if it is one.
    #[must_use]
    pub fn wedge(&self) -> Option<&Case> {
        match self {
            Self::Wedge(case) => Some(case),
            _ => None,
        }
    }

    /// Returns its fields as its case file has them; none of a half-truck, which is made of other files.
    #[must_use]
    pub fn fields(&self) -> Vec<FieldSection> {
        match self {
            Self::Wedge(case) => case.fields().to_vec(),
            Self::HalfTruck(_) => Vec::new(),
            Self::Truck(case) => case.fields().to_vec(),
            Self::Car(case) => case.fields().to_vec(),
        }
    }

    /// Returns the whole case as a commented case file, with the points of tables from other files in it;
    /// `None` of a half-truck, which is made of other files.
    #[must_use]
    pub fn to_toml(&self) -> Option<String> {
        match self {
            Self::Wedge(case) => Some(case.to_toml_embedded().to_owned()),
            Self::HalfTruck(_) => None,
            Self::Truck(case) => Some(case.to_toml_embedded().to_owned()),
            Self::Car(case) => Some(case.to_toml_embedded().to_owned()),
        }
    }

    /// Returns the measures that a study keeps of its runs.
    #[must_use]
    pub fn definitions(&self) -> Definitions {
        match self {
            Self::Wedge(_) => measures::of_wedges().clone(),
            Self::HalfTruck(case) => half_truck::definitions(case),
            Self::Truck(_) => measures::truck::definitions(),
            Self::Car(_) => measures::car::definitions(),
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
            Self::Truck(case) => measures::truck::judge(case),
            Self::Car(case) => measures::car::judge(case),
        }
    }
}

/// The result of a run of any model.
#[derive(Clone, Debug)]
pub struct AnyResult {
    columns: Vec<Column>,
    values: Vec<Vec<f64>>,
    outcome: Outcome,
    warnings: Vec<String>,
    failed: Option<String>,
    largest_relative_residual: f64,
}

impl AnyResult {
    fn of<S: RunSummary>(result: RunResult<S>) -> Self {
        Self {
            columns: result.columns,
            values: result.values,
            outcome: result.summary.outcome(),
            warnings: result.summary.warnings().to_vec(),
            failed: result.summary.failed().map(str::to_owned),
            largest_relative_residual: result.summary.largest_relative_residual(),
        }
    }

    /// Returns the values (SI) of the column with this name (without unit).
    #[must_use]
    pub fn column(&self, name: &str) -> Option<&[f64]> {
        let index = self.columns.iter().position(|column| column.name == name)?;
        Some(&self.values[index])
    }

    /// Returns how the run ended.
    #[must_use]
    pub fn outcome(&self) -> &Outcome {
        &self.outcome
    }

    /// Returns the warnings about the numbers.
    #[must_use]
    pub fn warnings(&self) -> &[String] {
        &self.warnings
    }

    /// Returns the reason why the numbers are not to be used, if so.
    #[must_use]
    pub fn failed(&self) -> Option<&str> {
        self.failed.as_deref()
    }

    /// Returns the relative residual of the energy ledger.
    #[must_use]
    pub fn largest_relative_residual(&self) -> f64 {
        self.largest_relative_residual
    }
}

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
        Ok(AnyCase::HalfTruck(Box::new(case)))
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
