//! A run from files: what the run file says, and what is asked for besides.

use std::borrow::Cow;
use std::path::Path;

use input::limits;
use nucars::Severity;
use nucars::file_sets::RunFiles;
use nucars::tree::{DataFile, InputFile, RunFile, SystemFile};
use nucars::truck::{BuildError, Choices, Truck, Wedges, Yaw};
use quantity::System as Units;
use serde::{Deserialize, Serialize};
use thiserror::Error;

use super::set::{self, SetError};
use super::wedge_bodies::{self, Replaced, WedgeBodyError};
use super::{HalfTruckCase, HalfTruckStart, requests, yaw};

/// The trees of the files of a run.
#[derive(Clone, Copy, Debug)]
pub struct FileTrees<'t> {
    /// The system file.
    pub system: &'t SystemFile,
    /// The input file; without it input bodies rest.
    pub input: Option<&'t InputFile>,
    /// The data file; without it only the columns that are always there are written.
    pub data: Option<&'t DataFile>,
    /// The run file.
    pub run: Option<&'t RunFile>,
}

/// The settings besides the files.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Settings {
    /// The choices that the files leave open.
    pub choices: Choices,
    /// The start of the run.
    pub start: HalfTruckStart,
    /// True if sections of the data file that are switched off are written too.
    pub all_outputs: bool,
    /// Duration of the run, s; otherwise as the run file says.
    pub duration: Option<f64>,
    /// Time between two rows, s.
    pub interval: f64,
    /// Relative tolerance of the integrator.
    pub relative_tolerance: f64,
    /// Units of the results.
    pub units: Units,
    /// Values laid over the files and over these settings, as `PATH=VALUE` ([`super::set`]).
    #[serde(default)]
    pub set: Vec<String>,
}

impl Default for Settings {
    fn default() -> Self {
        Self {
            choices: Choices::default(),
            start: HalfTruckStart::Drawn,
            all_outputs: false,
            duration: None,
            interval: 0.01,
            relative_tolerance: 1e-5,
            units: Units::Us,
            set: Vec::new(),
        }
    }
}

/// Reasons why files and settings make no run.
#[derive(Clone, Debug, PartialEq, Error)]
pub enum FilesError {
    /// The files make no model.
    #[error(transparent)]
    Build(#[from] BuildError),
    /// There is no system file, or it has mistakes.
    #[error("there is no system file that can be read")]
    NoSystem,
    /// Nothing says how long the run is.
    #[error("nothing says how long the run is: the run file has no \\STEPPING CONSTANTS")]
    NoDuration,
    /// Duration and interval give no rows, or too many.
    #[error(
        "{duration} s with a row each {interval} s: both must be positive, and give at least one row and at \
         most {}",
        limits::OUTPUT_ROWS
    )]
    Rows {
        /// The duration, s.
        duration: f64,
        /// The interval, s.
        interval: f64,
    },
    /// A value cannot be set.
    #[error("{error}")]
    Set {
        /// As typed.
        typed: String,
        /// The reason.
        error: SetError,
    },
    /// A wedge makes no body.
    #[error(transparent)]
    WedgeBody(#[from] WedgeBodyError),
    /// The intended yaw of files that command none.
    #[error("the yaw as intended was asked for, but no input body that drives a body yaws")]
    NoYaw,
}

/// Returns the run of these files.
///
/// # Errors
/// Those that [`FilesError`] names.
pub fn case(
    name: &str,
    title: &str,
    files: FileTrees<'_>,
    settings: &Settings,
) -> Result<HalfTruckCase, FilesError> {
    let (mut settings, mut system, mut input) = (
        settings.clone(),
        Cow::Borrowed(files.system),
        files.input.map(Cow::Borrowed),
    );
    for typed in &settings.set.clone() {
        set::apply(typed, &mut settings, &mut system, input.as_mut()).map_err(|error| FilesError::Set {
            typed: typed.clone(),
            error,
        })?;
    }
    let stepping = files.run.and_then(|run| run.stepping.as_ref());
    let duration = settings
        .duration
        .or(stepping.map(|stepping| *stepping.end))
        .ok_or(FilesError::NoDuration)?;
    let interval = settings.interval;
    let rows = duration / interval * (1.0 + 1e-12);
    if !(duration > 0.0 && interval > 0.0 && (1.0..limits::OUTPUT_ROWS as f64).contains(&rows)) {
        return Err(FilesError::Rows { duration, interval });
    }
    let choices = &settings.choices;
    let mut truck = Truck::new(&system, input.as_deref(), choices)?;
    if choices.yaw != Yaw::AsPrinted && yaw::drive(&truck.model).is_none() {
        return Err(FilesError::NoYaw);
    }
    let mut assumptions = choices.describe();
    let replaced = match choices.wedges {
        Wedges::Massless => Replaced::default(),
        Wedges::Bodies => wedge_bodies::replace(&mut truck, choices, settings.units)?,
    };
    if !replaced.wedges.is_empty() && truck.wedges().next().is_none() {
        // What is said of the law of massless wedges.
        assumptions.retain(|text| !text.starts_with("wedge") && !text.starts_with("viscous wedges"));
    }
    assumptions.extend(replaced.assumptions.iter().cloned());
    assumptions.push(
        match settings.start {
            HalfTruckStart::Drawn => "start: at rest in the drawn layout, springs and wedges without history",
            HalfTruckStart::Equilibrium => {
                "start: at rest in static equilibrium without friction, input bodies where they are at time \
                 zero"
            }
        }
        .to_owned(),
    );
    if let Some(stepping) = stepping {
        assumptions.push(format!(
            "the run file's stepping constants {} {} {} s: the second is the end of the run; the third, the \
             interval of its results, is that of the thesis's arrays, while the table has a row each \
             {interval} s; the first, presumably its largest step, is not used, because steps are chosen by \
             their error",
            *stepping.step, *stepping.end, *stepping.output
        ));
    }
    if let Some(control) = files.run.and_then(|run| run.control.as_ref()) {
        assumptions.push(format!(
            "the run file's control constants {} {} {} are not used: their meaning is not published",
            *control.analysis,
            *control.option,
            if *control.flag { ".T." } else { ".F." }
        ));
    }
    if !settings.set.is_empty() {
        assumptions.push(format!("set over the files: {}", settings.set.join(", ")));
    }
    let requests = match files.data {
        Some(data) => {
            let (requests, notes) = requests::of(data, &truck, settings.all_outputs);
            assumptions.extend(notes);
            requests
        }
        None => Vec::new(),
    };
    Ok(HalfTruckCase {
        name: name.to_owned(),
        title: title.to_owned(),
        truck,
        wedge_bodies: replaced.wedges,
        wedge_notes: replaced.assumptions,
        assumptions,
        requests,
        start: settings.start,
        duration,
        interval,
        script_interval: stepping.map_or(0.0, |stepping| *stepping.output),
        relative_tolerance: settings.relative_tolerance,
        units: settings.units,
    })
}

/// Returns the run of a run file, read from `path`, and what belongs to it. Errors in the files are for the
/// caller to refuse.
///
/// # Errors
/// Those that [`FilesError`] names.
pub fn case_of_run(path: &Path, files: &RunFiles, settings: &Settings) -> Result<HalfTruckCase, FilesError> {
    let mut name = path
        .file_stem()
        .map_or_else(|| "nucars".to_owned(), |stem| stem.to_string_lossy().into_owned());
    if settings.choices.yaw != Yaw::AsPrinted {
        name.push_str("_yaw_as_intended");
    }
    let trees = FileTrees {
        system: files.system().ok_or(FilesError::NoSystem)?,
        input: files.input(),
        data: files.data(),
        run: files.run(),
    };
    let title = files.run().map_or("", |run| run.title.text.trim());
    let mut case = case(&name, title, trees, settings)?;
    let warnings = files.count(Severity::Warning);
    if warnings > 0 {
        case.assumptions.push(format!(
            "{warnings} warnings of `wedgelab nucars check` about the files were passed over"
        ));
    }
    if settings.choices.yaw == Yaw::AsPrinted && yaw::is_commanded(&case.truck) {
        case.assumptions.push(
            "the yaw input is taken as printed; --yaw drop or --yaw drive reach what it commands".to_owned(),
        );
    }
    if !case.truck.left_out.is_empty() {
        let numbers: Vec<String> = case.truck.left_out.iter().map(u32::to_string).collect();
        case.assumptions.push(format!(
            "connections left out for the intended yaw: {}",
            numbers.join(", ")
        ));
    }
    Ok(case)
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]

    use super::*;
    use nucars::builtin;
    use nucars::read::read_system;

    #[test]
    fn durations_and_intervals_are_checked() {
        let source = builtin::source("Bolst_wedge_sf_68_constant.sys").unwrap();
        let system = read_system(&source).strict().unwrap();
        let files = FileTrees {
            system: &system,
            input: None,
            data: None,
            run: None,
        };
        let error = |settings: Settings| case("a", "b", files, &settings).unwrap_err();
        assert_eq!(error(Settings::default()), FilesError::NoDuration);
        for (duration, interval) in [
            (0.0, 0.01),
            (1.0, 0.0),
            (1.0, -1.0),
            (0.1, 0.2),
            (f64::NAN, 0.01),
            (2e4, 0.01),
        ] {
            let settings = Settings {
                duration: Some(duration),
                interval,
                ..Settings::default()
            };
            assert!(matches!(error(settings), FilesError::Rows { .. }));
        }
        let intended = Settings {
            duration: Some(1.0),
            choices: Choices {
                yaw: Yaw::Driven,
                ..Choices::default()
            },
            ..Settings::default()
        };
        assert_eq!(error(intended), FilesError::NoYaw);
    }
}
