//! Assessments of cars.

use std::path::PathBuf;

use ::study::assessment::{Assessment, Request};
use pyo3::prelude::*;
use quantity::{Kind, Quantity};
use report::assessment_work;

use crate::errors::{case_error, guarded, simple};
use crate::study::{NativeStudy, NativeStudyFolder, heard};

/// A car in regimes, at speeds and in conditions.
#[pyclass(frozen, module = "wedgelab._wedgelab", name = "NativeAssessment")]
pub struct NativeAssessment {
    assessment: Assessment,
}

#[pymethods]
impl NativeAssessment {
    #[new]
    fn new(
        py: Python<'_>,
        car: PathBuf,
        set: Vec<String>,
        regimes: Vec<String>,
        speeds: Vec<String>,
        conditions: Vec<String>,
        limits: String,
        frictions: Vec<f64>,
    ) -> PyResult<Self> {
        guarded(py, || {
            if let Some(wrong) = frictions.iter().find(|own| !(**own > 0.0 && **own <= 2.0)) {
                let message = format!("the friction {wrong} is not above 0 and at most 2");
                return Err(simple(
                    py,
                    "CaseError",
                    &message,
                    "write for example frictions=[0.3, 0.5]",
                ));
            }
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
                frictions,
            };
            let assessment = Assessment::new(&request).map_err(|error| case_error(py, &error))?;
            Ok(Self { assessment })
        })
    }

    /// Returns the car's name.
    #[getter]
    fn car(&self) -> &str {
        &self.assessment.car
    }

    /// Returns its runs.
    fn study(&self) -> NativeStudy {
        NativeStudy::new(self.assessment.study.clone())
    }

    /// Makes tables and page of all runs, which are kept in the folder.
    fn finish(&self, py: Python<'_>, folder: &NativeStudyFolder, jobs: usize) -> PyResult<()> {
        let held = folder.held(py)?;
        heard(py, None, |stop, done| {
            assessment_work::finish(&self.assessment, &held, jobs, None, stop, done)
        })?;
        Ok(())
    }
}
