//! The native part of the Python package `wedgelab`: what its Python part calls.
//!
//! Python code in `python/wedgelab` gives it names, types and tables; the work is done by lower layers. One
//! module a thing: `model_case`, `outcome` (results), `run` and `many` (running), `step` (users' own loops),
//! `study`, `figures`, `nucars` and `half_truck`, `truck`, `quasi_static`, `wheelrail`, `quantity`, and
//! `values` and `errors` for the way between the languages.
//!
//! Nothing panics through: what calls into lower layers runs in `errors::guarded`.

use pyo3::prelude::*;

mod assessment;
mod errand;
mod errors;
mod figures;
mod half_truck;
mod many;
mod model_case;
mod nucars;
mod outcome;
mod probability;
mod quantity;
mod quasi_static;
mod rise;
mod run;
mod step;
mod study;
mod values;
mod wheelrail;

/// The native part of `wedgelab`.
#[pymodule]
mod _wedgelab {
    use pyo3::prelude::*;

    #[pymodule_export]
    use crate::assessment::NativeAssessment;
    #[pymodule_export]
    use crate::errand::run_errand;
    #[pymodule_export]
    use crate::errors::fail_inside;
    #[pymodule_export]
    use crate::figures::{report_figures, run_figures};
    #[pymodule_export]
    use crate::half_truck::{NativeHalfTruckCase, built_in_half_trucks};
    #[pymodule_export]
    use crate::many::run_many;
    #[pymodule_export]
    use crate::model_case::{
        NativeCarCase, NativeCase, NativeTruckCase, NativeVehicleCase, built_in_groups, wedge_assumptions,
    };
    #[pymodule_export]
    use crate::nucars::{NativeFile, check_files, read_file};
    #[pymodule_export]
    use crate::outcome::NativeResult;
    #[pymodule_export]
    use crate::probability::{NativePlan, NativePlanRuns};
    #[pymodule_export]
    use crate::quantity::{Quantity, to_si};
    #[pymodule_export]
    use crate::quasi_static::slide;
    #[pymodule_export]
    use crate::rise::{NativeRise, NativeRiseRuns};
    #[pymodule_export]
    use crate::step::NativeWedge;
    #[pymodule_export]
    use crate::study::{NativeStudy, NativeStudyFolder};
    #[pymodule_export]
    use crate::wheelrail::{NativeProfile, NativeTrack, NativeWheelset, creep_forces};

    #[pymodule_init]
    fn init(module: &Bound<'_, PyModule>) -> PyResult<()> {
        module.add("__version__", env!("CARGO_PKG_VERSION"))
    }
}
