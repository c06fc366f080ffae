//! The result of a run: columns, summary, and files.

use std::path::PathBuf;
use std::sync::Arc;

use ::quantity::System as Units;
use mechanics::output::Column;
use numpy::{PyArray1, PyArray2, PyReadonlyArray2, PyUntypedArrayMethods};
use pyo3::exceptions::{PyIndexError, PyValueError};
use pyo3::prelude::*;
use pyo3::types::{PyBytes, PyList};
use report::files::{FileError, Folder};
use report::run_files::RunFiles;
use serde::{Deserialize, Serialize};
use study::car::CarCase;
use study::car::summary::CarSummary;
use study::case::Case;
use study::half_truck::{HalfTruckResult, HalfTruckSummary};
use study::result::RunResult;
use study::summary::{RunSummary, Summary};
use study::truck::TruckCase;
use study::truck::summary::TruckSummary;

use crate::errors::{guarded, simple};
use crate::model_case::NativeCarCase;
use crate::model_case::NativeCase;
use crate::model_case::NativeTruckCase;
use crate::values;

/// A summary of either kind.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub enum AnySummary {
    /// Of the wedge.
    Wedge(Box<Summary>),
    /// Of a half-truck.
    HalfTruck(Box<HalfTruckSummary>),
    /// Of a truck.
    Truck(Box<TruckSummary>),
    /// Of a car.
    Car(Box<CarSummary>),
}

impl AnySummary {
    fn get(&self) -> &dyn RunSummary {
        match self {
            Self::Wedge(summary) => &**summary,
            Self::HalfTruck(summary) => &**summary,
            Self::Truck(summary) => &**summary,
            Self::Car(summary) => &**summary,
        }
    }
}

impl From<Summary> for AnySummary {
    fn from(summary: Summary) -> Self {
        Self::Wedge(Box::new(summary))
    }
}

impl From<HalfTruckSummary> for AnySummary {
    fn from(summary: HalfTruckSummary) -> Self {
        Self::HalfTruck(Box::new(summary))
    }
}

impl From<TruckSummary> for AnySummary {
    fn from(summary: TruckSummary) -> Self {
        Self::Truck(Box::new(summary))
    }
}

impl From<CarSummary> for AnySummary {
    fn from(summary: CarSummary) -> Self {
        Self::Car(Box::new(summary))
    }
}

/// The case that a result came from.
#[derive(Clone)]
pub enum Origin {
    /// A wedge's.
    Wedge(Arc<Case>),
    /// A half-truck's, which is not kept.
    HalfTruck,
    /// A truck's.
    Truck(Arc<TruckCase>),
    /// A car's.
    Car(Arc<CarCase>),
}

/// The table of a run and its summary.
#[derive(Clone, Debug)]
pub struct Table {
    /// The columns.
    pub columns: Vec<Column>,
    /// The values (SI), one vector a column.
    pub values: Vec<Vec<f64>>,
    /// The summary.
    pub summary: AnySummary,
}

impl Table {
    /// Makes it of a run.
    pub fn of_run<S: Into<AnySummary>>(result: RunResult<S>) -> Self {
        Self {
            columns: result.columns,
            values: result.values,
            summary: result.summary.into(),
        }
    }

    /// Forgets all columns but these, by their names without unit.
    pub fn keep(&mut self, columns: Option<&[String]>) {
        let Some(wanted) = columns else { return };
        let all = std::mem::take(&mut self.columns)
            .into_iter()
            .zip(std::mem::take(&mut self.values));
        (self.columns, self.values) = all.filter(|(column, _)| wanted.contains(&column.name)).unzip();
    }
}

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
    /// The case that it came from.
    pub origin: Origin,
    /// The outcome.
    pub table: Table,
}

impl NativeResult {
    /// Makes it of a case and its outcome.
    pub fn new(origin: Origin, table: Table) -> Self {
        Self { origin, table }
    }

    /// Units of its summary.
    fn units_of(&self) -> Units {
        self.table.summary.get().units()
    }

    /// Case and result as lower layers have them; `None` for half-trucks.
    pub fn outcome(&self) -> Option<(Case, RunResult)> {
        let (Origin::Wedge(case), AnySummary::Wedge(summary)) = (&self.origin, &self.table.summary) else {
            return None;
        };
        Some(((**case).clone(), self.result(&**summary)))
    }

    /// Returns the half-truck's result as lower layers have it; `None` for others.
    pub fn half_truck(&self) -> Option<HalfTruckResult> {
        let AnySummary::HalfTruck(summary) = &self.table.summary else {
            return None;
        };
        Some(self.result(&**summary))
    }

    /// Returns the table with its summary.
    fn result<S: Clone>(&self, summary: &S) -> RunResult<S> {
        RunResult {
            columns: self.table.columns.clone(),
            values: self.table.values.clone(),
            summary: summary.clone(),
        }
    }

    /// Returns the reverse of [`NativeResult::parts`].
    pub fn of_parts(
        py: Python<'_>,
        origin: Origin,
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
        Ok(Self::new(
            origin,
            Table {
                columns: header.columns,
                values,
                summary: header.summary,
            },
        ))
    }
}

#[pymethods]
impl NativeResult {
    /// Columns: name, kind, frame, reference, text, (unit, suffix, factor) for US and for SI.
    fn columns<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyList>> {
        let columns = self.table.columns.iter().map(|column| {
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
        let Some(values) = self.table.values.get(column) else {
            return Err(PyIndexError::new_err("there is no such column"));
        };
        if factor == 1.0 {
            return Ok(PyArray1::from_slice(py, values));
        }
        Ok(PyArray1::from_iter(py, values.iter().map(|value| value * factor)))
    }

    #[getter]
    fn rows(&self) -> usize {
        self.table.values.first().map_or(0, Vec::len)
    }

    #[getter]
    fn units(&self) -> &'static str {
        self.units_of().name()
    }

    /// Returns the case of a wedge's run.
    #[getter]
    fn case(&self) -> Option<NativeCase> {
        let Origin::Wedge(case) = &self.origin else {
            return None;
        };
        let case = Arc::clone(case);
        Some(NativeCase { case })
    }

    /// Returns the case of a truck's run.
    #[getter]
    fn truck_case(&self) -> Option<NativeTruckCase> {
        let Origin::Truck(case) = &self.origin else {
            return None;
        };
        let case = Arc::clone(case);
        Some(NativeTruckCase { case })
    }

    /// Returns the case of a car's run.
    #[getter]
    fn car_case(&self) -> Option<NativeCarCase> {
        let Origin::Car(case) = &self.origin else {
            return None;
        };
        let case = Arc::clone(case);
        Some(NativeCarCase { case })
    }

    /// Returns the model that was run: `wedge`, `half_truck`, `truck` or `car`.
    #[getter]
    fn model(&self) -> &'static str {
        match self.origin {
            Origin::Wedge(_) => "wedge",
            Origin::HalfTruck => "half_truck",
            Origin::Truck(_) => "truck",
            Origin::Car(_) => "car",
        }
    }

    /// Returns how it ended in one word: `complete`, `derailed`, `stopped` or `failed`.
    #[getter]
    #[pyo3(name = "outcome")]
    fn outcome_word(&self) -> &'static str {
        self.table.summary.get().outcome().word()
    }

    /// Returns the predicate of a sentence on it, with the reason; `None` of a complete run.
    #[getter]
    fn told(&self) -> Option<String> {
        self.table.summary.get().outcome().told()
    }

    /// Returns the time and the reason why a wheel left its rail, if one did.
    #[getter]
    fn derailed(&self) -> Option<(f64, String)> {
        let derailed = self.table.summary.get().derailed();
        derailed.map(|end| (end.time, end.reason))
    }

    /// Returns the reason and time of its stop, if it could not go on.
    #[getter]
    fn stopped(&self) -> Option<(f64, String)> {
        let stopped = self.table.summary.get().stopped();
        stopped.map(|stopped| (stopped.time, stopped.reason.clone()))
    }

    /// Returns the reason why it has failed although it came to its end: its energy ledger does not close.
    #[getter]
    fn failed(&self) -> Option<String> {
        self.table.summary.get().failed().map(str::to_owned)
    }

    /// Returns the warnings about its energy ledger.
    #[getter]
    fn energy_warnings(&self) -> Vec<String> {
        let warnings = self.table.summary.get().warnings();
        study::energy::among(warnings).map(str::to_owned).collect()
    }

    /// Returns the warnings about what is implausible in it.
    #[getter]
    fn implausible(&self) -> Vec<String> {
        let warnings = self.table.summary.get().warnings();
        study::plausibility::among(warnings).map(str::to_owned).collect()
    }

    /// Returns the summary as nested dicts, as in `summary.json`.
    fn summary<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        let value = match &self.table.summary {
            AnySummary::Wedge(summary) => serde_json::to_value(summary),
            AnySummary::HalfTruck(summary) => serde_json::to_value(summary),
            AnySummary::Truck(summary) => serde_json::to_value(summary),
            AnySummary::Car(summary) => serde_json::to_value(summary),
        };
        let value = value.map_err(|error| PyValueError::new_err(error.to_string()))?;
        values::from_json(py, &value)
    }

    /// Everything but the case, as bytes and one array (columns by rows).
    fn parts<'py>(&self, py: Python<'py>) -> PyResult<(Bound<'py, PyBytes>, Bound<'py, PyArray2<f64>>)> {
        let header = Header {
            version: HEADER_VERSION,
            columns: self.table.columns.clone(),
            summary: self.table.summary.clone(),
        };
        let header =
            rmp_serde::to_vec_named(&header).map_err(|error| PyValueError::new_err(error.to_string()))?;
        let values = if self.table.values.is_empty() {
            PyArray2::zeros(py, [0, 0], false)
        } else {
            PyArray2::from_vec2(py, &self.table.values)?
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
        Self::of_parts(py, Origin::HalfTruck, header, &values)
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
            match (&self.origin, &self.table.summary) {
                (Origin::Wedge(case), AnySummary::Wedge(summary)) => {
                    write_run(&**case, folder, &self.result(&**summary), force).map_err(failed)
                }
                (Origin::Truck(case), AnySummary::Truck(summary)) => {
                    write_run(&**case, folder, &self.result(&**summary), force).map_err(failed)
                }
                (Origin::Car(case), AnySummary::Car(summary)) => {
                    write_run(&**case, folder, &self.result(&**summary), force).map_err(failed)
                }
                _ => Err(refused()),
            }
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
