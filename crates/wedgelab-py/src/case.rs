//! Cases.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use numpy::PyReadonlyArray2;
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyType};
use study::case::{Case, builtin, text_of};
use toml::Table;
use wedge::Wedge;

use crate::errors::{case_error, case_message, guarded};
use crate::outcome::{NativeResult, Origin};
use crate::run::{Progress, run_one};
use crate::values;

/// The name of values given from Python, in messages.
const VALUES: &str = "values";

/// A case, completed and checked.
#[pyclass(frozen, module = "wedgelab._wedgelab", name = "NativeCase")]
pub struct NativeCase {
    /// The case.
    pub case: Arc<Case>,
}

impl NativeCase {
    /// Makes it of a case of lower layers.
    pub fn new(case: Case) -> Self {
        Self { case: Arc::new(case) }
    }
}

/// Lays values over a text, if there are any.
fn over(
    py: Python<'_>,
    base: Option<(&str, &str)>,
    folder: &Path,
    given: &Bound<'_, PyDict>,
) -> PyResult<NativeCase> {
    let table: Table = values::table(given, "")?;
    let text = table.to_string();
    guarded(py, || {
        let case = match (base, table.is_empty()) {
            (Some((name, text)), true) => Case::parse(name, text, folder, &[]),
            (base, _) => Case::of_values(base, VALUES, &text, folder),
        };
        case.map(NativeCase::new).map_err(|error| case_error(py, &error))
    })
}

#[pymethods]
impl NativeCase {
    /// Over the thesis's values.
    #[classmethod]
    fn thesis(class: &Bound<'_, PyType>, given: &Bound<'_, PyDict>, folder: PathBuf) -> PyResult<Self> {
        over(class.py(), None, &folder, given)
    }

    /// Over a built-in case.
    #[classmethod]
    fn built_in(class: &Bound<'_, PyType>, name: &str, given: &Bound<'_, PyDict>) -> PyResult<Self> {
        let py = class.py();
        let text = builtin::text(name).map_err(|error| case_error(py, &error))?;
        over(py, Some((&format!("{name}.toml"), text)), Path::new(""), given)
    }

    /// Over a case file.
    #[classmethod]
    fn read(class: &Bound<'_, PyType>, path: PathBuf, given: &Bound<'_, PyDict>) -> PyResult<Self> {
        let py = class.py();
        if path.is_dir() {
            let message = format!("{} is a folder, not a case file", path.display());
            return Err(case_message(
                py,
                &message,
                "name a case file, perhaps its case.toml",
            ));
        }
        let text = text_of(&path).map_err(|error| case_error(py, &error))?;
        let folder = path.parent().unwrap_or(Path::new(""));
        over(py, Some((&path.display().to_string(), &text)), folder, given)
    }

    /// Over the text of a case file.
    #[classmethod]
    fn parse(
        class: &Bound<'_, PyType>,
        text: &str,
        source: &str,
        folder: PathBuf,
        given: &Bound<'_, PyDict>,
    ) -> PyResult<Self> {
        over(class.py(), Some((source, text)), &folder, given)
    }

    /// Over this case, completed.
    fn replace(&self, py: Python<'_>, given: &Bound<'_, PyDict>) -> PyResult<Self> {
        let text = self.to_toml(py)?;
        over(py, Some(("case.toml", &text)), Path::new(""), given)
    }

    /// Returns the whole case as a commented case file, tables embedded.
    fn to_toml(&self, py: Python<'_>) -> PyResult<String> {
        guarded(py, || {
            Ok(self.case.document.clone().with_tables_embedded().to_toml())
        })
    }

    /// Returns the whole case as nested dicts.
    fn document<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        let text = self.to_toml(py)?;
        let table: Table = text
            .parse()
            .map_err(|error| case_message(py, &format!("{error}"), ""))?;
        values::from_toml(py, &toml::Value::Table(table))
    }

    #[getter]
    fn name(&self) -> &str {
        &self.case.name
    }

    #[getter]
    fn title(&self) -> &str {
        &self.case.title
    }

    /// Units of results: `us` or `si`.
    #[getter]
    fn units(&self) -> &'static str {
        self.case.simulation.output_units.name()
    }

    /// End of the run, s.
    #[getter]
    fn duration(&self) -> f64 {
        self.case.simulation.duration
    }

    /// Returns the assumptions of a run.
    fn assumptions(&self, py: Python<'_>) -> PyResult<Vec<String>> {
        guarded(py, || {
            let wedge = Wedge::new(self.case.parameters.clone());
            let wedge = wedge.map_err(|error| case_message(py, &error.to_string(), ""))?;
            Ok(study::assumptions::of(&wedge))
        })
    }

    /// Runs it to its end without the interpreter lock.
    #[pyo3(signature = (columns, progress, interruptible))]
    fn run(
        &self,
        py: Python<'_>,
        columns: Option<Vec<String>>,
        progress: Option<Py<PyAny>>,
        interruptible: bool,
    ) -> PyResult<NativeResult> {
        let progress = Progress::new(progress, interruptible);
        let origin = Origin::Wedge(Arc::clone(&self.case));
        run_one(py, &*self.case, origin, columns.as_deref(), progress)
    }

    /// Returns the result that was taken apart by `NativeResult.parts`.
    fn result_of_parts(
        &self,
        py: Python<'_>,
        header: &[u8],
        values: PyReadonlyArray2<'_, f64>,
    ) -> PyResult<NativeResult> {
        NativeResult::of_parts(py, Origin::Wedge(Arc::clone(&self.case)), header, &values)
    }
}

/// A name and a title.
type Named = (&'static str, &'static str);
/// A group of built-in cases: name, title, what to look at, its cases.
type GroupOfCases = (&'static str, &'static str, &'static str, Vec<Named>);

/// Returns the groups of built-in cases: name, title, what to look at, and the names and titles of its cases.
#[pyfunction]
pub fn built_in_groups() -> Vec<GroupOfCases> {
    let cases = |group: &'static builtin::CaseGroup| {
        let cases = group.cases.iter();
        cases
            .map(|case| (case.name.as_str(), case.title.as_str()))
            .collect()
    };
    builtin::groups()
        .iter()
        .map(|group| (group.name, group.title, group.look_at, cases(group)))
        .collect()
}
