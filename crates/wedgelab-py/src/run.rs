//! Running a case without the interpreter lock, but so that Ctrl-C is heard.

use std::ops::ControlFlow;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::time::{Duration, Instant};

use pyo3::prelude::*;
use study::models::{AnyCase, AnySummary};
use study::result::RunResult;

use crate::errors::{internal, panic_text, simple};
use crate::outcome::NativeResult;

/// The interval of asking Python for signals and of reporting progress.
const INTERVAL: Duration = Duration::from_millis(50);
/// Number of steps between readings of the clock.
const STEPS: u32 = 64;

/// Progress and signals between a run and Python.
pub struct Progress {
    call: Option<Py<PyAny>>,
    /// Signals reach the main thread only; elsewhere there is nobody to ask.
    interruptible: bool,
    steps: u32,
    asked: Instant,
    /// The reason for ending the run.
    error: Option<PyErr>,
}

impl Progress {
    /// With a function that is called with the time reached (s).
    pub fn new(call: Option<Py<PyAny>>, interruptible: bool) -> Self {
        Self {
            call,
            interruptible,
            steps: 0,
            asked: Instant::now(),
            error: None,
        }
    }

    /// Tells the time reached (s); whether to go on.
    pub fn report(&mut self, time: f64) -> ControlFlow<()> {
        self.steps += 1;
        if self.steps < STEPS || (self.call.is_none() && !self.interruptible) {
            return ControlFlow::Continue(());
        }
        self.steps = 0;
        if self.asked.elapsed() < INTERVAL {
            return ControlFlow::Continue(());
        }
        let said = Python::attach(|py| {
            py.check_signals()?;
            if let Some(call) = &self.call {
                call.call1(py, (time,))?;
            }
            PyResult::Ok(())
        });
        self.asked = Instant::now();
        match said {
            Ok(()) => ControlFlow::Continue(()),
            Err(error) => {
                self.error = Some(error);
                ControlFlow::Break(())
            }
        }
    }

    /// Returns the reason why the run had to end.
    pub fn into_error(self) -> Option<PyErr> {
        self.error
    }
}

/// Reasons why there is no result.
#[derive(Debug)]
pub enum Failure {
    /// The run cannot begin.
    Begin(String),
    /// A mistake of ours.
    Panic(String),
}

impl Failure {
    /// Returns it as an exception.
    pub fn error(&self, py: Python<'_>, name: &str) -> PyErr {
        match self {
            Self::Begin(reason) => simple(
                py,
                "RunError",
                &format!("the run {name} cannot begin: {reason}"),
                "look for values that are out of proportion; the built-in cases run",
            ),
            Self::Panic(text) => internal(py, text),
        }
    }
}

/// The reason in the summary of a run that the caller stopped.
pub const STOPPED: &str = "it was stopped from outside";

/// Runs a case until its end, or until it is told to stop; panics become failures. Keeps these columns only,
/// by their names without unit.
pub fn table(
    case: &AnyCase,
    columns: Option<&[String]>,
    mut progress: impl FnMut(f64) -> ControlFlow<()>,
) -> Result<RunResult<AnySummary>, Failure> {
    let run = || case.run_while(|time| progress(time).map_break(|()| STOPPED.to_owned()));
    let mut result = match catch_unwind(AssertUnwindSafe(run)) {
        Ok(Ok(result)) => result,
        Ok(Err(error)) => return Err(Failure::Begin(error.to_string())),
        Err(panic) => return Err(Failure::Panic(panic_text(panic.as_ref()))),
    };
    if let Some(wanted) = columns {
        result.keep_columns(|name| wanted.iter().any(|own| own == name));
    }
    Ok(result)
}

/// Runs a case for Python.
pub fn run_one(
    py: Python<'_>,
    case: AnyCase,
    columns: Option<&[String]>,
    mut progress: Progress,
) -> PyResult<NativeResult> {
    let done = py.detach(|| table(&case, columns, |time| progress.report(time)));
    if let Some(error) = progress.into_error() {
        return Err(error);
    }
    let result = done.map_err(|failure| failure.error(py, case.name()))?;
    Ok(NativeResult::new(case, result))
}
