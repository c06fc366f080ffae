//! Certificates of cars.

use std::path::PathBuf;

use ::study::certificate::{Certificate, Request};
use pyo3::prelude::*;
use quantity::{Kind, Quantity};
use report::certificate_work;

use crate::errors::{case_error, guarded, simple};
use crate::study::{NativeStudy, NativeStudyFolder, heard};

/// A car in regimes, at speeds and in conditions.
#[pyclass(frozen, module = "wedgelab._wedgelab", name = "NativeCertificate")]
pub struct NativeCertificate {
    certificate: Certificate,
}

#[pymethods]
impl NativeCertificate {
    #[new]
    fn new(
        py: Python<'_>,
        car: PathBuf,
        set: Vec<String>,
        regimes: Vec<String>,
        speeds: Vec<String>,
        conditions: Vec<String>,
        limits: String,
    ) -> PyResult<Self> {
        guarded(py, || {
            let speeds = speeds.iter().map(|text| {
                let speed = Quantity::parse_as(text, Kind::TravelSpeed);
                speed.map_err(|error| {
                    let message = format!("the speed \"{text}\": {error}");
                    simple(py, "CaseError", &message, "write for example \"30 mph\"")
                })
            });
            let speeds: Vec<Quantity> = speeds.collect::<PyResult<_>>()?;
            let request = Request {
                car,
                set,
                regimes,
                refine: speeds.is_empty(),
                speeds,
                conditions,
                limits,
            };
            let certificate = Certificate::new(&request).map_err(|error| case_error(py, &error))?;
            Ok(Self { certificate })
        })
    }

    /// Returns the car's name.
    #[getter]
    fn car(&self) -> &str {
        &self.certificate.car
    }

    /// Returns its runs.
    fn study(&self) -> NativeStudy {
        NativeStudy::new(self.certificate.study.clone())
    }

    /// Makes tables and page of all runs, which are kept in the folder.
    fn finish(&self, py: Python<'_>, folder: &NativeStudyFolder, jobs: usize) -> PyResult<()> {
        let held = folder.held(py)?;
        heard(py, None, |stop, done| {
            certificate_work::finish(&self.certificate, &held, jobs, None, stop, done)
        })?;
        Ok(())
    }
}
