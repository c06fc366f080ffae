//! Cases of wedges, trucks and cars, and their runs: the same class for each; the built-in wedges.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use numpy::PyReadonlyArray2;
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyType};
use study::car::{CarCase, builtin as cars};
use study::case::{Case, CaseError, builtin as wedges, text_of};
use study::models::{AnyCase, no_built_in};
use study::truck::{TruckCase, builtin as trucks};
use study::vehicle::{VehicleCase, builtin as vehicles};
use toml::Table;
use wedge::Wedge;

use crate::errors::{case_error, case_message, guarded};
use crate::half_truck::NativeHalfTruckCase;
use crate::outcome::NativeResult;
use crate::run::{Progress, run_one};
use crate::values;

/// Returns a case, from values over a text.
fn over<C: Send>(
    py: Python<'_>,
    given: &Bound<'_, PyDict>,
    make: impl FnOnce(Option<&str>) -> Result<C, CaseError> + Send,
) -> PyResult<C> {
    let table: Table = values::table(given, "")?;
    let text = table.to_string();
    let values = (!table.is_empty()).then_some(text.as_str());
    guarded(py, || make(values).map_err(|error| case_error(py, &error)))
}

/// A class for the cases of a model: its name here and in Python, the case, its module of built-in ones.
/// (Classes for Python cannot be generic.)
macro_rules! model_case {
    ($native:ident, $name:literal, $case:ident, $builtin:ident, $about:literal) => {
        #[doc = $about]
        #[pyclass(frozen, module = "wedgelab._wedgelab", name = $name)]
        pub struct $native {
            /// The case.
            pub case: Arc<$case>,
        }

        impl $native {
            /// Makes it of a case of lower layers.
            pub fn new(case: impl Into<Arc<$case>>) -> Self {
                Self { case: case.into() }
            }
        }

        #[pymethods]
        impl $native {
            /// Over a built-in case.
            #[classmethod]
            fn built_in(class: &Bound<'_, PyType>, name: &str, given: &Bound<'_, PyDict>) -> PyResult<Self> {
                over(class.py(), given, |values| {
                    let text = $builtin::text(name).map_err(|error| no_built_in(name, error))?;
                    $case::of_values(&format!("{name}.toml"), text, values, Path::new(""))
                })
                .map(Self::new)
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
                    $case::of_values(&path.display().to_string(), &text, values, folder.as_path())
                })
                .map(Self::new)
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
                    $case::of_values(source, text, values, folder.as_path())
                })
                .map(Self::new)
            }

            /// Returns the whole case as a commented case file, tables embedded.
            fn to_toml(&self) -> &str {
                self.case.to_toml_embedded()
            }

            /// Returns the whole case as nested dicts.
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
                let case = AnyCase::from(Arc::clone(&self.case));
                run_one(py, case, columns.as_deref(), progress)
            }

            /// Returns the result that was taken apart by `NativeResult.parts`.
            fn result_of_parts(
                &self,
                py: Python<'_>,
                header: &[u8],
                values: PyReadonlyArray2<'_, f64>,
            ) -> PyResult<NativeResult> {
                let case = AnyCase::from(Arc::clone(&self.case));
                NativeResult::of_parts(py, Some(case), header, &values)
            }
        }
    };
}

model_case!(
    NativeCase,
    "NativeCase",
    Case,
    wedges,
    "A wedge's case, completed and checked."
);
model_case!(
    NativeTruckCase,
    "NativeTruckCase",
    TruckCase,
    trucks,
    "A truck's case, completed and checked."
);
model_case!(
    NativeCarCase,
    "NativeCarCase",
    CarCase,
    cars,
    "A car's case, completed and checked."
);
model_case!(
    NativeVehicleCase,
    "NativeVehicleCase",
    VehicleCase,
    vehicles,
    "A vehicle's case, completed and checked."
);

/// Between these classes and [`AnyCase`]: the model, its class.
macro_rules! classes {
    ($($own:ident: $native:ident),+) => {
        /// Returns the case of an object of one of the classes of cases.
        ///
        /// # Errors
        /// It is of another class.
        pub fn of_python(object: &Bound<'_, PyAny>) -> PyResult<AnyCase> {
            $(if let Ok(case) = object.cast::<$native>() {
                return Ok(Arc::clone(&case.get().case).into());
            })+
            Ok(Arc::clone(&object.cast::<NativeHalfTruckCase>()?.get().case).into())
        }

        /// Returns the object of a case; `None` of a half-truck, whose object has its files, too.
        ///
        /// # Errors
        /// Python's.
        pub fn to_python(py: Python<'_>, case: &AnyCase) -> PyResult<Option<Py<PyAny>>> {
            $(if let Some(case) = case.$own() {
                return Ok(Some(Py::new(py, $native::new(Arc::clone(case)))?.into_any()));
            })+
            Ok(None)
        }
    };
}

classes!(wedge: NativeCase, truck: NativeTruckCase, car: NativeCarCase, vehicle: NativeVehicleCase);

/// Returns the assumptions of a run of a wedge.
#[pyfunction]
pub fn wedge_assumptions(py: Python<'_>, case: &NativeCase) -> PyResult<Vec<String>> {
    guarded(py, || {
        let wedge = Wedge::new(case.case.parameters.clone());
        let wedge = wedge.map_err(|error| case_message(py, &error.to_string(), ""))?;
        Ok(study::assumptions::of(&wedge))
    })
}

/// A name and a title.
type Named = (&'static str, &'static str);
/// A group of built-in cases: name, title, what to look at, its cases.
type GroupOfCases = (&'static str, &'static str, &'static str, Vec<Named>);

/// Returns the groups of built-in cases: name, title, what to look at, and the names and titles of its cases.
#[pyfunction]
pub fn built_in_groups() -> Vec<GroupOfCases> {
    let cases = |group: &'static wedges::CaseGroup| {
        let cases = group.cases.iter();
        cases
            .map(|case| (case.name.as_str(), case.title.as_str()))
            .collect()
    };
    wedges::groups()
        .iter()
        .map(|group| (group.name, group.title, group.look_at, cases(group)))
        .collect()
}
