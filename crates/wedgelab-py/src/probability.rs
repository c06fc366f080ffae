//! Probabilities to lie beyond a limit.

use std::path::PathBuf;
use std::sync::{Arc, Mutex, PoisonError};

use ::study::probability::Plan;
use pyo3::prelude::*;
use pyo3::types::PyBytes;
use report::probability_files;
use report::probability_work::{ProbabilityNext, ProbabilityRuns, ProbabilityTask};

use crate::errand::Errand;
use crate::errors::{case_error, guarded, internal};
use crate::study::{heard, study_error};

/// A plan.
#[pyclass(frozen, module = "wedgelab._wedgelab", name = "NativePlan")]
pub struct NativePlan {
    plan: Arc<Plan>,
}

#[pymethods]
impl NativePlan {
    /// Reads a plan from a file.
    #[new]
    fn new(py: Python<'_>, path: PathBuf) -> PyResult<Self> {
        guarded(py, || {
            let plan = Plan::read(&path).map_err(|error| case_error(py, &error))?;
            Ok(Self { plan: Arc::new(plan) })
        })
    }

    #[getter]
    fn name(&self) -> &str {
        &self.plan.name
    }

    #[getter]
    fn title(&self) -> &str {
        &self.plan.title
    }

    /// Returns the greatest number of runs.
    #[getter]
    fn most(&self) -> u64 {
        self.plan.most_runs()
    }
}

/// The runs of a plan in its folder, and what comes next.
struct Work {
    runs: ProbabilityRuns,
    tasks: Vec<ProbabilityTask>,
}

/// The runs of a plan in its folder, held by this process until it is closed.
#[pyclass(frozen, module = "wedgelab._wedgelab", name = "NativePlanRuns")]
pub struct NativePlanRuns {
    path: PathBuf,
    work: Mutex<Option<Work>>,
}

impl NativePlanRuns {
    /// Calls a function with the runs without the interpreter lock.
    fn with<T: Send>(&self, py: Python<'_>, work: impl FnOnce(&mut Work) -> T + Send) -> PyResult<T> {
        let done = guarded(py, || {
            Ok(py.detach(|| {
                let mut held = self.work.lock().unwrap_or_else(PoisonError::into_inner);
                held.as_mut().map(work)
            }))
        })?;
        done.ok_or_else(|| internal(py, "the folder of the plan was closed"))
    }
}

#[pymethods]
impl NativePlanRuns {
    /// Begins a plan in a folder, or goes on with it.
    #[new]
    fn new(py: Python<'_>, plan: &NativePlan, path: PathBuf) -> PyResult<Self> {
        guarded(py, || {
            let runs = ProbabilityRuns::open(&path, Arc::clone(&plan.plan));
            let runs = runs.map_err(|error| study_error(py, &error))?;
            let tasks = Vec::new();
            Ok(Self {
                path,
                work: Mutex::new(Some(Work { runs, tasks })),
            })
        })
    }

    /// Returns the number of runs that the folder keeps.
    fn kept(&self, py: Python<'_>) -> PyResult<u64> {
        self.with(py, |work| work.runs.kept())
    }

    /// Looks for what comes next; gives how many runs that are, none at the end.
    fn more(&self, py: Python<'_>) -> PyResult<usize> {
        self.with(py, |work| {
            work.tasks = match work.runs.comes_next() {
                ProbabilityNext::Missing(tasks) => tasks,
                ProbabilityNext::Found(..) => Vec::new(),
            };
            work.tasks.len()
        })
    }

    /// Returns one of them for a worker elsewhere.
    fn errand<'py>(&self, py: Python<'py>, number: usize) -> PyResult<Option<Bound<'py, PyBytes>>> {
        let run = self.with(py, |work| {
            let task = work.tasks.get(number);
            task.map(|task| work.runs.elsewhere(task))
        })?;
        run.map(|run| Errand::Run(run).saved(py)).transpose()
    }

    /// Computes what comes next on threads of this process; gives how many were computed.
    #[pyo3(signature = (jobs, progress))]
    fn compute(&self, py: Python<'_>, jobs: usize, progress: Option<Py<PyAny>>) -> PyResult<u64> {
        let ((), count) = heard(py, progress.as_ref(), |stop, done| {
            let mut held = self.work.lock().unwrap_or_else(PoisonError::into_inner);
            let Some(work) = held.as_mut() else { return Ok(()) };
            let tasks = std::mem::take(&mut work.tasks);
            work.runs.compute(tasks, jobs, stop, done)
        })?;
        Ok(count)
    }

    /// Keeps the record of one of them that a worker elsewhere computed.
    fn keep(&self, py: Python<'_>, _number: usize, records: &[u8]) -> PyResult<()> {
        self.with(py, |work| work.runs.keep(records))?
            .map_err(|error| study_error(py, &error))
    }

    /// Writes the result.
    fn finish(&self, py: Python<'_>) -> PyResult<()> {
        let written = self.with(py, |work| match work.runs.comes_next() {
            ProbabilityNext::Missing(_) => None,
            ProbabilityNext::Found(summary, runs) => {
                let plan = work.runs.plan();
                Some(probability_files::write(plan, &summary, &runs, &self.path))
            }
        })?;
        written
            .ok_or_else(|| internal(py, "runs are missing"))?
            .map_err(|error| study_error(py, &error.into()))
    }

    /// Lets other programs work in the folder.
    fn close(&self) {
        *self.work.lock().unwrap_or_else(PoisonError::into_inner) = None;
    }
}
