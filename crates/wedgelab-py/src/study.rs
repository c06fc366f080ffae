//! Studies: in this process, or a part of one for a program elsewhere.

use std::path::PathBuf;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::sync::{Arc, Mutex, PoisonError};
use std::thread;
use std::time::Duration;

use ::study::design::{MANY, Study, StudySource};
use ::study::records;
use miette::Diagnostic;
use pyo3::prelude::*;
use pyo3::types::{PyBytes, PyType};
use report::output_table::Content;
use report::study_folder::{StudyFolder, StudyFolderError, table};
use report::study_work;

use crate::errors::{case_error, guarded, internal, panic_text, raise, shown, simple};
use crate::half_truck;
use crate::model_case::to_python;
use crate::outcome::from_saved;

/// The interval of asking Python for signals and of reporting progress.
const INTERVAL: Duration = Duration::from_millis(50);

/// `wedgelab.StudyError`.
pub(crate) fn study_error(py: Python<'_>, error: &StudyFolderError) -> PyErr {
    let diagnostic: &dyn Diagnostic = error;
    raise(py, "StudyError", (error.to_string(), shown(diagnostic)))
}

/// A study.
#[pyclass(frozen, module = "wedgelab._wedgelab", name = "NativeStudy")]
pub struct NativeStudy {
    study: Arc<Study>,
}

impl NativeStudy {
    pub(crate) fn new(study: Study) -> Self {
        Self {
            study: Arc::new(study),
        }
    }
}

/// Name, unit, text and kind of a column.
type NamedColumn = (String, String, String, &'static str);

#[pymethods]
impl NativeStudy {
    /// Makes it of a study file.
    #[classmethod]
    fn read(class: &Bound<'_, PyType>, path: PathBuf) -> PyResult<Self> {
        let py = class.py();
        guarded(py, || {
            let study = Study::read(&path).map_err(|error| case_error(py, &error))?;
            Ok(Self::new(study))
        })
    }

    /// Returns the reverse of `saved`.
    #[staticmethod]
    fn load(py: Python<'_>, bytes: &[u8]) -> PyResult<Self> {
        guarded(py, || {
            let source: StudySource = from_saved(bytes).map_err(|error| {
                let message = format!("this saved study cannot be read: {error}");
                let help =
                    "it is damaged, or was saved by another version of wedgelab; read the study file again";
                simple(py, "StudyError", &message, help)
            })?;
            let study = Study::of_source(source).map_err(|error| case_error(py, &error))?;
            Ok(Self::new(study))
        })
    }

    /// Returns all that is needed to make the study again, the texts of its case included.
    fn saved<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyBytes>> {
        let bytes = rmp_serde::to_vec_named(self.study.source());
        let bytes = bytes.map_err(|error| internal(py, &error.to_string()))?;
        Ok(PyBytes::new(py, &bytes))
    }

    #[getter]
    fn name(&self) -> &str {
        &self.study.name
    }

    #[getter]
    fn title(&self) -> &str {
        &self.study.title
    }

    #[getter]
    fn count(&self) -> u64 {
        self.study.count()
    }

    /// Returns whether it has so many runs that the user must say that they are meant.
    #[getter]
    fn is_large(&self) -> bool {
        self.study.count() > MANY
    }

    /// Returns the table's columns.
    fn columns(&self, py: Python<'_>) -> PyResult<Vec<NamedColumn>> {
        guarded(py, || {
            let table = table(&self.study);
            let columns = table.descriptions().iter().cloned();
            Ok(columns
                .map(|column| {
                    let kind = match column.content {
                        Content::Integer => "integer",
                        Content::Number => "number",
                        Content::Text => "text",
                    };
                    (column.name, column.unit, column.text, kind)
                })
                .collect())
        })
    }

    /// Returns the paths that are varied.
    fn parameters(&self) -> Vec<Vec<String>> {
        self.study
            .factors
            .iter()
            .map(|factor| factor.paths.clone())
            .collect()
    }

    /// Returns the values of the variant of this number, below `count`, as a case file shows them.
    fn values(&self, py: Python<'_>, number: u64) -> PyResult<Vec<(String, String)>> {
        guarded(py, || {
            let pairs = self.study.factors.iter().zip(self.study.values(number));
            Ok(pairs
                .filter_map(|(factor, value)| Some((factor.name().to_owned(), value?.shown().into_owned())))
                .collect())
        })
    }

    /// Returns the case of the variant of this number, below `count`: a wedge's, or a half-truck's.
    fn case(&self, py: Python<'_>, number: u64) -> PyResult<Py<PyAny>> {
        guarded(py, || {
            let case = self.study.case(number).map_err(|error| case_error(py, &error))?;
            if let Some(case) = to_python(py, &case)? {
                return Ok(case);
            }
            let set = self.study.overrides(number);
            let case = half_truck::of_source(py, &self.study.source().case, set)?;
            Ok(Py::new(py, case)?.into_any())
        })
    }

    /// Computes these variants without the interpreter lock: their records as bytes.
    fn records<'py>(&self, py: Python<'py>, numbers: Vec<u64>) -> PyResult<Bound<'py, PyBytes>> {
        let study = &self.study;
        let bytes = guarded(py, || Ok(py.detach(|| records::run_all(study, numbers))))?;
        Ok(PyBytes::new(py, &bytes))
    }
}

/// The folder of a study, held by this process until it is closed.
#[pyclass(frozen, module = "wedgelab._wedgelab", name = "NativeStudyFolder")]
pub struct NativeStudyFolder {
    study: Arc<Study>,
    folder: Mutex<Option<Arc<StudyFolder>>>,
}

impl NativeStudyFolder {
    pub(crate) fn held(&self, py: Python<'_>) -> PyResult<Arc<StudyFolder>> {
        let held = self.folder.lock().unwrap_or_else(PoisonError::into_inner);
        let held = held.as_ref().map(Arc::clone);
        held.ok_or_else(|| internal(py, "the folder of the study was closed"))
    }

    /// Calls a function with the folder without the interpreter lock.
    fn with<T: Send>(
        &self,
        py: Python<'_>,
        work: impl FnOnce(&StudyFolder) -> Result<T, StudyFolderError> + Send,
    ) -> PyResult<T> {
        let folder = self.held(py)?;
        guarded(py, || {
            let done = py.detach(|| work(&folder));
            done.map_err(|error| study_error(py, &error))
        })
    }
}

/// The outcome: runs complete, refused, stopped, failed, derailed; the first reasons; a warning about energy
/// ledgers.
type Ended = ([u64; 5], Vec<(u64, String)>, Option<String>);

#[pymethods]
impl NativeStudyFolder {
    /// Begins a study in a folder, or goes on with it.
    #[new]
    fn new(py: Python<'_>, study: &NativeStudy, path: PathBuf) -> PyResult<Self> {
        guarded(py, || {
            let folder = StudyFolder::open(&path, &study.study).map_err(|error| study_error(py, &error))?;
            Ok(Self {
                study: Arc::clone(&study.study),
                folder: Mutex::new(Some(Arc::new(folder))),
            })
        })
    }

    /// Number of parts, into which runs are sorted by their numbers.
    #[getter]
    fn parts(&self, py: Python<'_>) -> PyResult<u64> {
        Ok(self.held(py)?.parts())
    }

    /// Returns the number of runs kept, and of bytes that were cut off or damaged.
    fn begun(&self, py: Python<'_>) -> PyResult<(u64, usize)> {
        let kept = self.with(py, study_work::kept)?;
        Ok((kept.runs, kept.lost))
    }

    /// Returns the numbers of the runs of a part that are not there yet.
    fn missing(&self, py: Python<'_>, part: u64) -> PyResult<Vec<u64>> {
        self.with(py, |folder| folder.missing(part))
    }

    /// Keeps records that a worker computed; gives their number.
    fn keep(&self, py: Python<'_>, records: &[u8]) -> PyResult<u64> {
        self.with(py, |folder| folder.keep_all(records))
    }

    /// Keeps those of the records of a part that are not there yet; gives their number.
    fn keep_new(&self, py: Python<'_>, part: u64, records: &[u8]) -> PyResult<u64> {
        self.with(py, |folder| folder.keep_new(part, records))
    }

    /// Refuses another study whose description was found in a place.
    fn compare(&self, py: Python<'_>, place: PathBuf, description: &str) -> PyResult<()> {
        self.with(py, |folder| folder.compare(&place, description))
    }

    /// Returns the rows of a part that has all its records as a Parquet file of its own.
    fn part_table<'py>(&self, py: Python<'py>, part: u64) -> PyResult<Bound<'py, PyBytes>> {
        let study = &self.study;
        let bytes = self.with(py, |folder| folder.part_table(study, part))?;
        Ok(PyBytes::new(py, &bytes))
    }

    /// Computes what is missing on threads of this process; `progress` is called with how many are done now.
    #[pyo3(signature = (jobs, progress))]
    fn compute(&self, py: Python<'_>, jobs: usize, progress: Option<Py<PyAny>>) -> PyResult<u64> {
        let folder = self.held(py)?;
        let study = &self.study;
        let work = |stop: &AtomicBool, done: &(dyn Fn() + Sync)| {
            study_work::compute(study, &folder, jobs, stop, done)
        };
        let ((), count) = heard(py, progress.as_ref(), work)?;
        Ok(count)
    }

    /// Makes the table and the page of all runs.
    fn finish(&self, py: Python<'_>) -> PyResult<Ended> {
        let study = &self.study;
        let digest = self.with(py, |folder| study_work::finish(study, folder))?;
        let warning = digest.warning();
        Ok((digest.ended, digest.reasons, warning))
    }

    /// Lets other programs work in the folder.
    fn close(&self) {
        *self.folder.lock().unwrap_or_else(PoisonError::into_inner) = None;
    }
}

/// Has something worked on without the interpreter lock: gives what came out, and how many were done.
pub(crate) fn heard<T: Send>(
    py: Python<'_>,
    progress: Option<&Py<PyAny>>,
    work: impl FnOnce(&AtomicBool, &(dyn Fn() + Sync)) -> Result<T, StudyFolderError> + Send,
) -> PyResult<(T, u64)> {
    let (stop, count) = (AtomicBool::new(false), AtomicU64::new(0));
    let done = || {
        count.fetch_add(1, Ordering::Relaxed);
    };
    let (worked, said) = py.detach(|| {
        thread::scope(|scope| {
            let worker = scope.spawn(|| work(&stop, &done));
            let said = listen(&worker, &count, progress);
            stop.store(said.is_err(), Ordering::Relaxed);
            (worker.join(), said)
        })
    });
    // Ctrl-C before what it led to.
    said?;
    match worked {
        Ok(worked) => Ok((
            worked.map_err(|error| study_error(py, &error))?,
            count.into_inner(),
        )),
        Err(panic) => Err(internal(py, &panic_text(panic.as_ref()))),
    }
}

/// Until the worker has ended: passes on how many runs are done, and hears signals.
fn listen<T>(
    worker: &thread::ScopedJoinHandle<'_, T>,
    count: &AtomicU64,
    progress: Option<&Py<PyAny>>,
) -> PyResult<()> {
    let mut reported = 0;
    // Short at first, for short studies.
    let mut pause = Duration::from_millis(1);
    loop {
        let ended = worker.is_finished();
        if !ended {
            thread::sleep(pause);
            pause = (2 * pause).min(INTERVAL);
        }
        let now = count.load(Ordering::Relaxed);
        Python::attach(|py| {
            py.check_signals()?;
            if let Some(progress) = progress.filter(|_| now > reported) {
                reported = now;
                progress.call1(py, (now,))?;
            }
            PyResult::Ok(())
        })?;
        if ended {
            return Ok(());
        }
    }
}
