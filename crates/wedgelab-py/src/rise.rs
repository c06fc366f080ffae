//! Surveys of wedge rise.

use std::path::PathBuf;
use std::sync::{Arc, Mutex, PoisonError};

use ::study::rise::{RiseRequest, Survey};
use pyo3::prelude::*;
use pyo3::types::PyBytes;
use quantity::{Kind, Quantity};
use report::rise_files;
use report::rise_work::{RiseRuns, RiseTask};
use report::study_folder::StudyFolderError;

use crate::errand::Errand;
use crate::errors::{case_error, guarded, internal, simple};
use crate::study::{heard, study_error};

/// A survey of a car over wedge rise.
#[pyclass(frozen, module = "wedgelab._wedgelab", name = "NativeRise")]
pub struct NativeRise {
    survey: Arc<Survey>,
}

#[pymethods]
impl NativeRise {
    #[new]
    fn new(
        py: Python<'_>,
        car: PathBuf,
        set: Vec<String>,
        regimes: Vec<String>,
        limits: String,
        to: Option<String>,
        factors: Option<Vec<String>>,
        runs: usize,
        full: bool,
    ) -> PyResult<Self> {
        guarded(py, || {
            let to = to.map(|text| {
                Quantity::parse_as(&text, Kind::Length).map_err(|error| {
                    let message = format!("the highest rise \"{text}\": {error}");
                    simple(py, "CaseError", &message, "write for example \"1 in\"")
                })
            });
            let request = RiseRequest {
                car,
                set,
                regimes,
                limits,
                to: to.transpose()?,
                factors,
                most: runs,
                full,
            };
            let survey = Survey::new(request).map_err(|error| case_error(py, &error))?;
            Ok(Self {
                survey: Arc::new(survey),
            })
        })
    }

    /// Returns the car's name.
    #[getter]
    fn car(&self) -> &str {
        &self.survey.name
    }

    /// Returns the greatest number of runs, rigs too.
    #[getter]
    fn most(&self) -> usize {
        self.survey.request.most + self.survey.rigs().len()
    }

    /// Returns the mean duration of a run, s.
    #[getter]
    fn run_time(&self) -> f64 {
        self.survey.run_time()
    }
}

/// The runs of a survey in its folder, and what comes next.
struct Work {
    runs: RiseRuns,
    tasks: Vec<RiseTask>,
}

/// The runs of a survey in its folder.
#[pyclass(frozen, module = "wedgelab._wedgelab", name = "NativeRiseRuns")]
pub struct NativeRiseRuns {
    survey: Arc<Survey>,
    path: PathBuf,
    work: Mutex<Work>,
}

impl NativeRiseRuns {
    /// Calls a function with the runs without the interpreter lock.
    fn with<T: Send>(&self, py: Python<'_>, work: impl FnOnce(&mut Work) -> T + Send) -> PyResult<T> {
        let locked = || self.work.lock().unwrap_or_else(PoisonError::into_inner);
        guarded(py, || Ok(py.detach(|| work(&mut locked()))))
    }
}

#[pymethods]
impl NativeRiseRuns {
    #[new]
    fn new(rise: &NativeRise, path: PathBuf) -> Self {
        let runs = RiseRuns::new(Arc::clone(&rise.survey), &path);
        let tasks = Vec::new();
        Self {
            survey: Arc::clone(&rise.survey),
            path,
            work: Mutex::new(Work { runs, tasks }),
        }
    }

    /// Looks for what comes next; gives how many runs that are, none at the end.
    fn more(&self, py: Python<'_>) -> PyResult<usize> {
        self.with(py, |work| {
            work.tasks = work.runs.next_tasks().map_or_else(Vec::new, |own| own.tasks);
            work.tasks.len()
        })
    }

    /// Returns one of them for a worker elsewhere; none if it is computed here.
    fn errand<'py>(&self, py: Python<'py>, number: usize) -> PyResult<Option<Bound<'py, PyBytes>>> {
        let of = |work: &mut Work| Some(work.tasks.get(number)?.elsewhere()?.clone());
        let source = self.with(py, of)?;
        source.map(|source| Errand::Study(source).saved(py)).transpose()
    }

    /// Computes what comes next on threads of this process; gives how many were computed.
    #[pyo3(signature = (jobs, progress))]
    fn compute(&self, py: Python<'_>, jobs: usize, progress: Option<Py<PyAny>>) -> PyResult<u64> {
        let ((), count) = heard(py, progress.as_ref(), |stop, done| {
            let mut work = self.work.lock().unwrap_or_else(PoisonError::into_inner);
            let tasks = std::mem::take(&mut work.tasks);
            let computed = work.runs.compute(tasks, jobs, stop, done);
            computed.map(|_| ()).map_err(StudyFolderError::from)
        })?;
        Ok(count)
    }

    /// Keeps the record of one of them that a worker elsewhere computed.
    fn keep(&self, py: Python<'_>, number: usize, records: &[u8]) -> PyResult<()> {
        let kept = self.with(py, |work| {
            let Work { runs, tasks } = work;
            tasks.get(number).map(|task| runs.keep(task, records))
        })?;
        kept.ok_or_else(|| internal(py, "there is no such run"))?
            .map_err(|error| study_error(py, &error))
    }

    /// Writes the answers; gives the number of runs and rigs that the folder had before.
    fn finish(&self, py: Python<'_>) -> PyResult<usize> {
        let written = self.with(py, |work| {
            let findings = work.runs.findings();
            let written = rise_files::write(&self.survey, findings, &self.path);
            written.map(|()| findings.before)
        })?;
        written.map_err(|error| study_error(py, &error.into()))
    }
}
