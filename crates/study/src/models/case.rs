//! A case of any model.

use std::ops::ControlFlow;
use std::path::Path;

use quantity::System as Units;

use super::{AnyCase, AnySummary, MODELS, ModelCase, ModelEntry, StudyCase, built_in};
use crate::case::model::model;
use crate::case::problem::Problems;
use crate::case::{Case, CaseError, FieldSection, Tables, text_of, tree_with_overrides};
use crate::measures::{Definitions, Judged, Unmeasured};
use crate::metrics::Cycle;
use crate::result::RunResult;
use crate::run::{Run, RunCase, RunError};

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
        let named = model(&tree, &mut Problems::new());
        let mut files = MODELS.iter().filter_map(|model| model.case_files.as_ref());
        match files.find(|files| Some(files.model) == named) {
            Some(files) => (files.read)(tree, source, tables.into(), problems),
            // Says that there is no such model.
            None => Ok(Case::of_tree(tree, source, tables.into(), problems)?.into()),
        }
    }

    /// Returns the built-in case of this name, of a wedge, a truck or a car; `None` if there is none.
    ///
    /// # Errors
    /// An override is wrong.
    pub fn built_in(name: &str, overrides: &[String]) -> Result<Option<Self>, CaseError> {
        let Some(own) = built_in(name) else {
            return Ok(None);
        };
        Self::parse(
            &format!("{}.toml", own.name),
            own.text(),
            Path::new(""),
            overrides,
        )
        .map(Some)
    }

    /// Returns its name.
    #[must_use]
    pub fn name(&self) -> &str {
        each_case!(self, case => &case.name)
    }

    /// Returns the units of its results.
    #[must_use]
    pub fn units(&self) -> Units {
        each_case!(self, case => RunCase::units(&**case))
    }

    /// Returns the end of its run and the time between two rows, s.
    #[must_use]
    pub fn duration_and_interval(&self) -> [f64; 2] {
        each_case!(self, case => case.duration_and_interval())
    }

    /// Runs it to its end.
    ///
    /// # Errors
    /// The run cannot begin.
    pub fn run(&self) -> Result<RunResult<AnySummary>, RunError> {
        self.run_while(|_| ControlFlow::Continue(()))
    }

    /// Runs it as [`Run::finish_while`].
    ///
    /// # Errors
    /// The run cannot begin.
    pub fn run_while(
        &self,
        progress: impl FnMut(f64) -> ControlFlow<String>,
    ) -> Result<RunResult<AnySummary>, RunError> {
        each_case!(self, case => Ok(Run::new(&**case)?.finish_while(progress).with_summary(Into::into)))
    }

    /// Returns the row of its model.
    #[must_use]
    pub fn entry(&self) -> Option<&'static ModelEntry> {
        MODELS.iter().find(|model| model.name == self.model())
    }

    /// Returns it under another name.
    #[must_use]
    pub fn named(&self, name: &str) -> Self {
        each_case!(self, case => case.named(name).into())
    }

    /// Returns the cycle of its vertical motion, if that is one sine or triangle.
    #[must_use]
    pub fn cycle(&self) -> Option<Cycle> {
        each_case!(self, case => case.cycle())
    }

    /// Returns its fields as its case file has them; none of a model without case files.
    #[must_use]
    pub fn fields(&self) -> Vec<FieldSection> {
        each_case!(self, case => ModelCase::fields(&**case).to_vec())
    }

    /// Returns the whole case as a commented case file, with the points of tables from other files in it;
    /// `None` of a model without case files.
    #[must_use]
    pub fn to_toml(&self) -> Option<String> {
        each_case!(self, case => case.case_file().map(str::to_owned))
    }

    /// Returns the measures that a study keeps of its runs.
    #[must_use]
    pub fn definitions(&self) -> Definitions {
        each_case!(self, case => case.definitions())
    }

    /// Runs it, measures it, and judges whether the measures mean something.
    ///
    /// # Errors
    /// The run cannot begin or does not come to its end.
    pub fn judge(&self) -> Result<Judged, Unmeasured> {
        each_case!(self, case => case.judge())
    }
}
