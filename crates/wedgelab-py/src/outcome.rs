//! The result of a run: columns, summary, and files.

use std::path::PathBuf;

use ::quantity::System as Units;
use mechanics::output::Column;
use numpy::{PyArray1, PyArray2, PyReadonlyArray2, PyUntypedArrayMethods};
use pyo3::exceptions::{PyIndexError, PyValueError};
use pyo3::prelude::*;
use pyo3::types::{PyBytes, PyList};
use report::run_files::RunFiles;
use serde::{Deserialize, Serialize};
use staging::{FileError, Folder};
use study::case::Case;
use study::each_case;
use study::half_truck::HalfTruckResult;
use study::models::{AnyCase, AnySummary, ModelSummary};
use study::result::RunResult;
use study::summary::RunSummary;

use crate::errors::{guarded, simple};
use crate::model_case::{NativeCarCase, NativeCase, NativeTruckCase, NativeVehicleCase};
use crate::values;

/// The parts of a result besides its values.
#[derive(Serialize, Deserialize)]
struct Header {
    version: u32,
    columns: Vec<Column>,
    summary: AnySummary,
}

const HEADER_VERSION: u32 = 2;

/// More bytes than these are neither a saved case nor the head of a saved result, and are not read.
const MOST_SAVED_BYTES: usize = 64 << 20;

/// Reads what was saved as MessagePack. What the bytes claim to hold takes no memory before it is there.
///
/// # Errors
/// There are too many bytes, or they are none of this kind.
pub fn from_saved<T: serde::de::DeserializeOwned>(bytes: &[u8]) -> Result<T, String> {
    if bytes.len() > MOST_SAVED_BYTES {
        return Err(format!(
            "it has {} bytes, more than the {MOST_SAVED_BYTES} that are read",
            bytes.len()
        ));
    }
    rmp_serde::from_slice(bytes).map_err(|error| error.to_string())
}

/// A result.
#[pyclass(frozen, module = "wedgelab._wedgelab", name = "NativeResult")]
pub struct NativeResult {
    /// The case that it came from; `None` of a half-truck's result that was read back.
    case: Option<AnyCase>,
    /// The outcome.
    result: RunResult<AnySummary>,
}

impl NativeResult {
    /// Makes it of a case and its outcome.
    pub fn new(case: AnyCase, result: RunResult<AnySummary>) -> Self {
        Self {
            case: Some(case),
            result,
        }
    }

    /// Returns the part of its summary that all models have.
    fn shared(&self) -> &dyn RunSummary {
        self.result.summary.shared()
    }

    /// Case and result as lower layers have them; `None` for others than wedges.
    pub fn outcome(&self) -> Option<(Case, RunResult)> {
        let case = self.case.as_ref()?.wedge()?;
        Some((Case::clone(case), self.with()?))
    }

    /// Returns the half-truck's result as lower layers have it; `None` for others.
    pub fn half_truck(&self) -> Option<HalfTruckResult> {
        self.with()
    }

    /// Returns the table with its summary, if that is of this model.
    fn with<S: ModelSummary>(&self) -> Option<RunResult<S>> {
        let summary = S::of(&self.result.summary)?.clone();
        Some(RunResult {
            columns: self.result.columns.clone(),
            values: self.result.values.clone(),
            summary,
        })
    }

    /// Returns the reverse of [`NativeResult::parts`].
    pub fn of_parts(
        py: Python<'_>,
        case: Option<AnyCase>,
        header: &[u8],
        values: &PyReadonlyArray2<'_, f64>,
    ) -> PyResult<Self> {
        let wrong = |text: String| {
            let help = "it is damaged, or was saved by another version of wedgelab; run the case again";
            simple(
                py,
                "WedgelabError",
                &format!("this saved result cannot be read: {text}"),
                help,
            )
        };
        let header: Header = guarded(py, || from_saved(header).map_err(&wrong))?;
        if header.version != HEADER_VERSION {
            return Err(wrong(format!(
                "it has version {}, not {HEADER_VERSION}",
                header.version
            )));
        }
        if values.shape()[0] != header.columns.len() {
            return Err(wrong("columns and values differ in number".to_owned()));
        }
        let rows = values.as_array();
        let values = rows.rows().into_iter().map(|row| row.to_vec()).collect();
        Ok(Self {
            case,
            result: RunResult {
                columns: header.columns,
                values,
                summary: header.summary,
            },
        })
    }
}

#[pymethods]
impl NativeResult {
    /// Columns: name, kind, frame, reference, text, (unit, suffix, factor) for US and for SI.
    fn columns<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyList>> {
        let columns = self.result.columns.iter().map(|column| {
            let kind = serde_json::to_value(column.kind).unwrap_or_default();
            let of = |units| {
                let factor = column.kind.from_si(units);
                (column.kind.label(units), column.kind.suffix(units), factor)
            };
            (
                column.name.as_str(),
                kind.as_str().unwrap_or_default().to_owned(),
                column.frame.as_ref(),
                column.reference.as_ref(),
                column.text.as_str(),
                of(Units::Us),
                of(Units::Si),
            )
        });
        PyList::new(py, columns.collect::<Vec<_>>())
    }

    /// Returns the values of a column, times a factor.
    fn values<'py>(
        &self,
        py: Python<'py>,
        column: usize,
        factor: f64,
    ) -> PyResult<Bound<'py, PyArray1<f64>>> {
        let Some(values) = self.result.values.get(column) else {
            return Err(PyIndexError::new_err("there is no such column"));
        };
        if factor == 1.0 {
            return Ok(PyArray1::from_slice(py, values));
        }
        Ok(PyArray1::from_iter(py, values.iter().map(|value| value * factor)))
    }

    #[getter]
    fn rows(&self) -> usize {
        self.result.values.first().map_or(0, Vec::len)
    }

    #[getter]
    fn units(&self) -> &'static str {
        self.shared().units().name()
    }

    /// Returns the case of a wedge's run.
    #[getter]
    fn case(&self) -> Option<NativeCase> {
        self.case.as_ref()?.wedge().cloned().map(NativeCase::new)
    }

    /// Returns the case of a truck's run.
    #[getter]
    fn truck_case(&self) -> Option<NativeTruckCase> {
        self.case.as_ref()?.truck().cloned().map(NativeTruckCase::new)
    }

    /// Returns the case of a car's run.
    #[getter]
    fn car_case(&self) -> Option<NativeCarCase> {
        self.case.as_ref()?.car().cloned().map(NativeCarCase::new)
    }

    /// Returns the case of a vehicle's run.
    #[getter]
    fn vehicle_case(&self) -> Option<NativeVehicleCase> {
        self.case.as_ref()?.vehicle().cloned().map(NativeVehicleCase::new)
    }

    /// Returns the model that was run: `wedge`, `half_truck`, `truck`, `car` or `vehicle`.
    #[getter]
    fn model(&self) -> &'static str {
        match self.case.as_ref().map(AnyCase::model) {
            None | Some("half-truck") => "half_truck",
            Some(name) => name,
        }
    }

    /// Returns how it ended in one word: `complete`, `derailed`, `stopped` or `failed`.
    #[getter]
    #[pyo3(name = "outcome")]
    fn outcome_word(&self) -> &'static str {
        self.shared().outcome().word()
    }

    /// Returns the predicate of a sentence on it, with the reason; `None` of a complete run.
    #[getter]
    fn told(&self) -> Option<String> {
        self.shared().outcome().told()
    }

    /// Returns the time and the reason why a wheel left its rail, if one did.
    #[getter]
    fn derailed(&self) -> Option<(f64, String)> {
        let derailed = self.shared().derailed();
        derailed.map(|end| (end.time, end.reason))
    }

    /// Returns the reason and time of its stop, if it could not go on.
    #[getter]
    fn stopped(&self) -> Option<(f64, String)> {
        let stopped = self.shared().stopped();
        stopped.map(|stopped| (stopped.time, stopped.reason.clone()))
    }

    /// Returns the reason why it has failed although it came to its end: its energy ledger does not close.
    #[getter]
    fn failed(&self) -> Option<String> {
        self.shared().failed().map(str::to_owned)
    }

    /// Returns the warnings about its energy ledger.
    #[getter]
    fn energy_warnings(&self) -> Vec<String> {
        let warnings = self.shared().warnings();
        study::energy::among(warnings).map(str::to_owned).collect()
    }

    /// Returns the warnings about what is implausible in it.
    #[getter]
    fn implausible(&self) -> Vec<String> {
        let warnings = self.shared().warnings();
        study::plausibility::among(warnings).map(str::to_owned).collect()
    }

    /// Returns the summary as nested dicts, as in `summary.json`.
    fn summary<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        let value = self
            .result
            .summary
            .serialize_content(serde_json::value::Serializer);
        let value = value.map_err(|error| PyValueError::new_err(error.to_string()))?;
        values::from_json(py, &value)
    }

    /// Everything but the case, as bytes and one array (columns by rows).
    fn parts<'py>(&self, py: Python<'py>) -> PyResult<(Bound<'py, PyBytes>, Bound<'py, PyArray2<f64>>)> {
        let header = Header {
            version: HEADER_VERSION,
            columns: self.result.columns.clone(),
            summary: self.result.summary.clone(),
        };
        let header =
            rmp_serde::to_vec_named(&header).map_err(|error| PyValueError::new_err(error.to_string()))?;
        let values = if self.result.values.is_empty() {
            PyArray2::zeros(py, [0, 0], false)
        } else {
            PyArray2::from_vec2(py, &self.result.values)?
        };
        Ok((PyBytes::new(py, &header), values))
    }

    /// Returns the half-truck's result that was taken apart.
    #[staticmethod]
    fn half_truck_of_parts(
        py: Python<'_>,
        header: &[u8],
        values: PyReadonlyArray2<'_, f64>,
    ) -> PyResult<Self> {
        Self::of_parts(py, None, header, &values)
    }

    /// Writes the files that `wedgelab run` writes.
    fn write(&self, py: Python<'_>, folder: PathBuf, force: bool) -> PyResult<Vec<&'static str>> {
        guarded(py, || {
            let failed = |error: FileError| {
                let text = crate::errors::shown(&error);
                crate::errors::raise(py, "FileError", (error.to_string(), text))
            };
            let refused = || {
                let message = "results of half-trucks cannot be written";
                simple(py, "WedgelabError", message, "use to_pandas().to_csv(...)")
            };
            let case = self.case.as_ref().filter(|case| case.half_truck().is_none());
            let Some(case) = case else {
                return Err(refused());
            };
            each_case!(case, case => {
                let result = self.with().ok_or_else(refused)?;
                write_run(&**case, folder, &result, force).map_err(failed)
            })
        })
    }
}

/// Writes the files of a run; returns their names.
fn write_run<C: RunFiles>(
    case: &C,
    folder: PathBuf,
    result: &C::Output,
    force: bool,
) -> Result<Vec<&'static str>, FileError> {
    let names = case.names(&case.output_files());
    case.write(&Folder::check(folder, &names, force)?, result)?;
    Ok(names)
}
