//! Half-trucks: cases from files of NUCARS, and their runs.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use ::nucars::file_sets::{Instead, RunFiles, Texts, find};
use ::nucars::truck::Yaw;
use ::quantity::{System as Units, nearest};
use pyo3::prelude::*;
use pyo3::types::{PyBytes, PyType};
use serde::{Deserialize, Serialize};
use study::half_truck::catalog::{self, CatalogEntry, YawCase};
use study::half_truck::files::{Settings, case_of_run};
use study::half_truck::{HalfTruckCase, HalfTruckStart, options};
use study::models::{AnyCase, CaseSource};

use crate::errors::{findings, guarded, raise, simple};
use crate::nucars::load_error;
use crate::outcome::{NativeResult, from_saved};
use crate::run::{Progress, run_one};

/// The source of a case, with all that is needed to make it again elsewhere.
#[derive(Clone, Serialize, Deserialize)]
enum Source {
    BuiltIn {
        name: String,
        settings: Settings,
    },
    Files {
        path: PathBuf,
        texts: Box<Texts>,
        settings: Settings,
    },
}

/// A half-truck's case.
#[pyclass(frozen, module = "wedgelab._wedgelab", name = "NativeHalfTruckCase")]
pub struct NativeHalfTruckCase {
    /// The case.
    pub case: Arc<HalfTruckCase>,
    source: Source,
}

fn refused(py: Python<'_>, message: &str, help: &str) -> PyErr {
    simple(py, "NucarsError", message, help)
}

fn make(py: Python<'_>, source: Source) -> PyResult<NativeHalfTruckCase> {
    let case = match &source {
        Source::BuiltIn { name, settings } => {
            let entry = entry(py, name)?;
            let made = entry.case_with(settings);
            made.map_err(|error| {
                let help = "choose another interval, option or value";
                refused(py, &error.to_string(), help)
            })?
        }
        Source::Files {
            path,
            texts,
            settings,
        } => {
            let files = RunFiles::of_texts(texts).map_err(|error| load_error(py, &error))?;
            of_files(py, path, &files, settings)?
        }
    };
    Ok(NativeHalfTruckCase {
        case: Arc::new(case),
        source,
    })
}

/// Returns a study's half-truck with these values set over it.
pub fn of_source(py: Python<'_>, source: &CaseSource, set: Vec<String>) -> PyResult<NativeHalfTruckCase> {
    let settings = Settings {
        set,
        ..Settings::default()
    };
    match source.clone() {
        CaseSource::BuiltInHalfTruck(name) => make(py, Source::BuiltIn { name, settings }),
        CaseSource::HalfTruck { path, texts } => make(
            py,
            Source::Files {
                path,
                texts,
                settings,
            },
        ),
        CaseSource::File { name, .. } => Err(refused(py, &format!("{name} is no half-truck"), "")),
    }
}

fn entry(py: Python<'_>, name: &str) -> PyResult<CatalogEntry> {
    catalog::entry(name).ok_or_else(|| {
        let names: Vec<String> = catalog::entries().iter().map(CatalogEntry::name).collect();
        let help = match nearest(name, names.iter().map(String::as_str)) {
            Some(near) => format!("did you mean {near}? wedgelab.nucars.built_in() lists all"),
            None => "name a run file, or one of wedgelab.nucars.built_in()".to_owned(),
        };
        refused(
            py,
            &format!("there is neither a file nor a built-in run `{name}`"),
            &help,
        )
    })
}

fn of_files(py: Python<'_>, path: &Path, files: &RunFiles, settings: &Settings) -> PyResult<HalfTruckCase> {
    if files.has_errors() {
        let all = files.findings().flat_map(|findings| findings.list());
        let errors: Vec<_> = all
            .filter(|one| one.severity() == ::nucars::Severity::Error)
            .collect();
        let message = format!(
            "{} cannot be run: {} error(s) in its files",
            path.display(),
            errors.len()
        );
        let shown: Vec<String> = errors.iter().map(|one| crate::errors::shown(*one)).collect();
        let list = findings(py, errors.iter().copied())?;
        let text = format!("  × {message}\n\n{}", shown.join("\n\n"));
        return Err(raise(py, "NucarsError", (message, text, list)));
    }
    case_of_run(path, files, settings).map_err(|error| {
        let message = format!("{} cannot be run: {error}", path.display());
        refused(
            py,
            &message,
            "wedgelab.nucars.check tells what is doubtful about the files",
        )
    })
}

#[pymethods]
impl NativeHalfTruckCase {
    /// Reads a run file, or takes the built-in run of this name.
    #[classmethod]
    #[pyo3(signature = (
        path, system, data, input, yaw, options, duration, interval, start, all_outputs, units, tolerance, set
    ))]
    fn read(
        class: &Bound<'_, PyType>,
        path: PathBuf,
        system: Option<PathBuf>,
        data: Option<PathBuf>,
        input: Option<PathBuf>,
        yaw: Option<&str>,
        options: Vec<(String, String)>,
        duration: Option<f64>,
        interval: f64,
        start: &str,
        all_outputs: bool,
        units: &str,
        tolerance: f64,
        set: Vec<String>,
    ) -> PyResult<Self> {
        let py = class.py();
        let unknown = |what: &str, value: &str, choices: &str| {
            refused(
                py,
                &format!("{what} cannot be \"{value}\""),
                &format!("write one of {choices}"),
            )
        };
        if !(tolerance > 0.0 && tolerance < 1.0) {
            let message =
                format!("relative_tolerance is {tolerance}; it must be between 0 and 1, both excluded");
            return Err(refused(py, &message, "write for example 1e-5"));
        }
        let mut settings = Settings {
            start: match start {
                "drawn" => HalfTruckStart::Drawn,
                "equilibrium" => HalfTruckStart::Equilibrium,
                other => return Err(unknown("start", other, "\"drawn\", \"equilibrium\"")),
            },
            all_outputs,
            duration,
            interval,
            relative_tolerance: tolerance,
            set,
            units: match units {
                "us" => Units::Us,
                "si" => Units::Si,
                other => return Err(unknown("units", other, "\"us\", \"si\"")),
            },
            ..Settings::default()
        };
        settings.choices.yaw = match yaw {
            None | Some("printed") => Yaw::AsPrinted,
            Some("drop") => Yaw::Dropped,
            Some("drive") => Yaw::Driven,
            Some(other) => return Err(unknown("yaw", other, "\"printed\", \"drop\", \"drive\"")),
        };
        for (name, value) in options {
            let known = self::options::all().map(|(name, what)| format!("{name} ({what})"));
            options::set(&mut settings.choices, &format!("{name}={value}"))
                .map_err(|error| refused(py, &error.to_string(), &known.collect::<Vec<_>>().join("; ")))?;
        }
        guarded(py, || {
            let name = path.to_str().unwrap_or("");
            if !path.is_file() && (catalog::entry(name).is_some() || name.starts_with("nucars_")) {
                let entry = entry(py, name)?;
                let fits = match yaw {
                    None => true,
                    Some("printed") => entry.yaw != YawCase::Intended,
                    Some(_) => entry.yaw == YawCase::Intended,
                };
                if !fits {
                    return Err(refused(
                        py,
                        &format!("yaw does not fit the built-in run {name}"),
                        "built-in runs with yaw as intended end with _yaw, those as printed with \
                         _yaw_as_printed",
                    ));
                }
                if system.is_some() || data.is_some() || input.is_some() {
                    let message = format!("the built-in run {name} has its own files, and others are given");
                    return Err(refused(py, &message, "name a run file, or leave them out"));
                }
                let name = name.to_owned();
                return make(py, Source::BuiltIn { name, settings });
            }
            let path = find(&path).map_err(|error| load_error(py, &error))?;
            let instead = Instead { system, data, input };
            let files = RunFiles::read(&path, &instead).map_err(|error| load_error(py, &error))?;
            // Before they are written down: missing files are reported with their places.
            of_files(py, &path, &files, &settings)?;
            let texts = Box::new(files.texts());
            make(
                py,
                Source::Files {
                    path,
                    texts,
                    settings,
                },
            )
        })
    }

    /// Returns the reverse of `saved`.
    #[staticmethod]
    fn load(py: Python<'_>, bytes: &[u8]) -> PyResult<Self> {
        guarded(py, || {
            let source = from_saved(bytes).map_err(|error| {
                let help = "it is damaged, or was saved by another version of wedgelab; read the files again";
                refused(py, &format!("this saved case cannot be read: {error}"), help)
            })?;
            make(py, source)
        })
    }

    /// Returns all that is needed to make the case again, the texts of its files included.
    fn saved<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyBytes>> {
        let bytes = rmp_serde::to_vec_named(&self.source);
        let bytes = bytes.map_err(|error| refused(py, &error.to_string(), ""))?;
        Ok(PyBytes::new(py, &bytes))
    }

    #[getter]
    fn name(&self) -> &str {
        &self.case.name
    }

    #[getter]
    fn title(&self) -> &str {
        &self.case.title
    }

    #[getter]
    fn duration(&self) -> f64 {
        self.case.duration
    }

    #[getter]
    fn assumptions(&self) -> Vec<String> {
        self.case.assumptions.clone()
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
        run_one(
            py,
            AnyCase::HalfTruck(Arc::clone(&self.case)),
            columns.as_deref(),
            progress,
        )
    }
}

/// Names and titles of the built-in runs.
#[pyfunction]
pub fn built_in_half_trucks() -> Vec<(String, String)> {
    let entries = catalog::entries();
    entries
        .iter()
        .map(|entry| (entry.name(), entry.title()))
        .collect()
}
