//! Runs for workers elsewhere: all that a run is made of goes out, its record comes back.

use ::study::design::{Study, StudySource};
use ::study::records;
use ::study::remote_run::RemoteRun;
use pyo3::prelude::*;
use pyo3::types::PyBytes;
use serde::{Deserialize, Serialize};

use crate::errors::{case_error, guarded, internal, simple};
use crate::outcome::from_saved;

/// A run for a worker elsewhere.
#[derive(Deserialize, Serialize)]
pub(crate) enum Errand {
    /// The only run of a study.
    Study(StudySource),
    /// A run of its own.
    Run(RemoteRun),
}

impl Errand {
    /// Returns it as bytes.
    pub(crate) fn saved<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyBytes>> {
        let bytes = rmp_serde::to_vec_named(self).map_err(|error| internal(py, &error.to_string()))?;
        Ok(PyBytes::new(py, &bytes))
    }
}

/// Computes a run that another process sent; gives its record as bytes.
#[pyfunction]
pub fn run_errand<'py>(py: Python<'py>, saved: &[u8]) -> PyResult<Bound<'py, PyBytes>> {
    let bytes = guarded(py, || {
        let errand: Errand = from_saved(saved).map_err(|error| {
            let message = format!("this run cannot be read: {error}");
            let help = "all workers need the same version of wedgelab as the process that sends runs";
            simple(py, "StudyError", &message, help)
        })?;
        match errand {
            Errand::Run(run) => Ok(py.detach(|| run.record())),
            Errand::Study(source) => {
                let study = Study::of_source(source).map_err(|error| case_error(py, &error))?;
                Ok(py.detach(|| records::run_all(&study, [0])))
            }
        }
    })?;
    Ok(PyBytes::new(py, &bytes))
}
