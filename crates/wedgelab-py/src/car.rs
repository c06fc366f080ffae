//! Freight cars on track: cases and their runs.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use numpy::PyReadonlyArray2;
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyType};
use study::car::{CarCase, builtin};
use study::case::{CaseError, Tables, text_of};
use toml::Table;

use crate::errors::{case_error, case_message, guarded};
use crate::outcome::{NativeResult, Origin};
use crate::run::{Progress, run_one};
use crate::values;

/// A car's case, completed and checked.
#[pyclass(frozen, module = "wedgelab._wedgelab", name = "NativeCarCase")]
pub struct NativeCarCase {
    /// The case.
    pub case: Arc<CarCase>,
}

impl NativeCarCase {
    /// Of a case of lower floors.
    pub fn new(case: CarCase) -> Self {
        Self { case: Arc::new(case) }
    }
}

/// A case from values over a text.
fn over(
    py: Python<'_>,
    given: &Bound<'_, PyDict>,
    make: impl FnOnce(Option<&str>) -> Result<CarCase, CaseError> + Send,
) -> PyResult<NativeCarCase> {
    let table: Table = values::table(given, "")?;
    let text = table.to_string();
    let values = (!table.is_empty()).then_some(text.as_str());
    guarded(py, || {
        make(values)
            .map(NativeCarCase::new)
            .map_err(|error| case_error(py, &error))
    })
}

#[pymethods]
impl NativeCarCase {
    /// Over a built-in car.
    #[classmethod]
    fn built_in(class: &Bound<'_, PyType>, name: &str, given: &Bound<'_, PyDict>) -> PyResult<Self> {
        over(class.py(), given, |values| {
            let text = builtin::text(name)?;
            CarCase::of_values(&format!("{name}.toml"), text, values, Tables::nowhere())
        })
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
        let folder = path.parent().unwrap_or(Path::new("")).to_owned();
        over(py, given, |values| {
            let text = text_of(&path)?;
            CarCase::of_values(&path.display().to_string(), &text, values, folder.as_path())
        })
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
        over(class.py(), given, |values| {
            CarCase::of_values(source, text, values, folder.as_path())
        })
    }

    /// The whole case as a commented case file, tables embedded.
    fn to_toml(&self) -> &str {
        self.case.to_toml_embedded()
    }

    /// The whole case as nested dicts.
    fn document<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        let table: Table = self
            .case
            .to_toml_embedded()
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
        let origin = Origin::Car(Arc::clone(&self.case));
        run_one(py, &*self.case, origin, columns.as_deref(), progress)
    }

    /// The result that was taken apart by `NativeResult.parts`.
    fn result_of_parts(
        &self,
        py: Python<'_>,
        header: &[u8],
        values: PyReadonlyArray2<'_, f64>,
    ) -> PyResult<NativeResult> {
        NativeResult::of_parts(py, Origin::Car(Arc::clone(&self.case)), header, &values)
    }
}
