//! From errors of lower layers to Python's exceptions, which are classes of `wedgelab.errors`.

use input::{bounded, limits};
use std::panic::{AssertUnwindSafe, catch_unwind};

use ::nucars::Finding;
use ::quantity::UnitError;
use miette::{Diagnostic, GraphicalReportHandler, GraphicalTheme};
use pyo3::prelude::*;
use pyo3::types::PyList;
use study::case::{CaseError, Problem};

/// Returns an exception of `wedgelab.errors` with these arguments of its class.
pub fn raise<'py>(py: Python<'py>, class: &str, arguments: impl pyo3::call::PyCallArgs<'py>) -> PyErr {
    let made = py
        .import("wedgelab.errors")
        .and_then(|module| module.getattr(class))
        .and_then(|class| class.call1(arguments));
    match made {
        Ok(exception) => PyErr::from_value(exception),
        Err(error) => error,
    }
}

/// Returns the text that the command line shows of an error: message, marked text, help. Without colours.
pub fn shown(diagnostic: &dyn Diagnostic) -> String {
    let handler = GraphicalReportHandler::new_themed(GraphicalTheme::unicode_nocolor())
        .with_context_lines(1)
        .without_syntax_highlighting()
        .with_wrap_lines(false)
        .with_links(false);
    let mut text = String::new();
    match handler.render_report(&mut text, diagnostic) {
        Ok(()) => in_python(text.trim_end()),
        Err(_) => in_python(&diagnostic.to_string()),
    }
}

/// The advice of the command line, and that for Python instead.
const ADVICE: [(&str, &str); 9] = [
    (
        "`wedgelab case NAME` prints a built-in case",
        "Case(NAME).to_toml() is a built-in case",
    ),
    ("`wedgelab case` lists all", "wedgelab.built_in() lists all"),
    (
        "see `wedgelab case` for a case that is valid",
        "see Case().to_toml() for a case that is valid",
    ),
    (" with --out", ""),
    ("give the same command again", "run the study again"),
    ("give the command again", "run the study again"),
    ("--force", "force=True"),
    ("`wedgelab nucars check`", "wedgelab.nucars.check"),
    ("--yaw drop or --yaw drive", "yaw=\"drop\" or yaw=\"drive\""),
];

/// Returns a text with advice for Python.
pub fn in_python(text: &str) -> String {
    let mut text = text.to_owned();
    for (typed, called) in ADVICE {
        text = text.replace(typed, called);
    }
    text
}

/// Returns the label of a diagnostic's first place.
fn label(diagnostic: &dyn Diagnostic) -> Option<String> {
    diagnostic.labels()?.next()?.label().map(str::to_owned)
}

/// Returns a problem as `wedgelab.errors.Problem`.
fn problem<'py>(py: Python<'py>, problem: &Problem) -> PyResult<Bound<'py, PyAny>> {
    let class = py.import("wedgelab.errors")?.getattr("Problem")?;
    let (line, column) = problem.line_and_column().unzip();
    class.call1((
        problem.message(),
        problem.marked_text().and_then(|_| label(problem)),
        problem.advice().map(in_python),
        problem.source_name(),
        line,
        column,
        problem.marked_text(),
    ))
}

/// Returns a finding as `wedgelab.errors.Finding`.
pub fn finding<'py>(py: Python<'py>, finding: &Finding) -> PyResult<Bound<'py, PyAny>> {
    let class = py.import("wedgelab.errors")?.getattr("Finding")?;
    let place = finding.place();
    let (line, column) = place.line_and_column();
    class.call1((
        finding.severity().to_string(),
        finding.code_name(),
        finding.message(),
        label(finding),
        finding.advice(),
        place.source.name(),
        line,
        column,
        place.text(),
        shown(finding),
    ))
}

/// Returns a list of findings.
pub fn findings<'py, 'f>(
    py: Python<'py>,
    list: impl IntoIterator<Item = &'f Finding>,
) -> PyResult<Bound<'py, PyList>> {
    let list = list.into_iter().map(|one| finding(py, one));
    PyList::new(py, list.collect::<PyResult<Vec<_>>>()?)
}

/// `wedgelab.CaseError`.
pub fn case_error(py: Python<'_>, error: &CaseError) -> PyErr {
    let problems = error.problems().iter().map(|one| problem(py, one));
    match problems.collect::<PyResult<Vec<_>>>() {
        Ok(problems) => raise(py, "CaseError", (error.to_string(), shown(error), problems)),
        Err(error) => error,
    }
}

/// `wedgelab.CaseError` without a place in a text.
pub fn case_message(py: Python<'_>, message: &str, help: &str) -> PyErr {
    simple(py, "CaseError", message, help)
}

/// Returns an exception of this class with a message and a help.
pub fn simple(py: Python<'_>, class: &str, message: &str, help: &str) -> PyErr {
    let note = match help {
        "" => String::new(),
        help => format!("\n  help: {help}"),
    };
    raise(py, class, (message, format!("  × {message}{note}")))
}

/// `wedgelab.UnitError` about a text.
pub fn unit_error(py: Python<'_>, text: &str, error: &UnitError) -> PyErr {
    // A longer text is not shown: the message has its beginning.
    let marked = if text.len() > limits::QUANTITY {
        String::new()
    } else {
        let span = error.span();
        let before = text.get(..span.start).unwrap_or("").chars().count();
        let marked = text.get(span).unwrap_or("").chars().count().max(1);
        let text = bounded(text.to_owned());
        format!("    {text}\n    {}{}\n", " ".repeat(before), "^".repeat(marked))
    };
    let shown = format!("  × {error}\n{marked}  help: {}", error.help());
    raise(py, "UnitError", (error.to_string(), shown))
}

/// Calls a function of lower layers; a panic there, which is a mistake of ours, becomes
/// `wedgelab.InternalError`.
pub fn guarded<T>(py: Python<'_>, work: impl FnOnce() -> PyResult<T>) -> PyResult<T> {
    match catch_unwind(AssertUnwindSafe(work)) {
        Ok(done) => done,
        Err(panic) => Err(internal(py, &panic_text(panic.as_ref()))),
    }
}

/// Returns the message of a panic.
pub fn panic_text(panic: &(dyn std::any::Any + Send)) -> String {
    let text = panic.downcast_ref::<&str>().map(|text| (*text).to_owned());
    text.or_else(|| panic.downcast_ref::<String>().cloned())
        .unwrap_or_else(|| "no message".to_owned())
}

/// `wedgelab.InternalError`.
pub fn internal(py: Python<'_>, text: &str) -> PyErr {
    simple(
        py,
        "InternalError",
        &format!("a mistake of Wedgelab itself: {text}"),
        "please report it with the case that led to it",
    )
}

/// Panics inside, so that a test can see what becomes of it.
#[pyfunction]
#[pyo3(name = "_fail_inside")]
pub fn fail_inside(py: Python<'_>) -> PyResult<()> {
    guarded(py, || {
        let none: Option<()> = None;
        none.map_or_else(panic_on_purpose, Ok)
    })
}

#[allow(clippy::panic)]
fn panic_on_purpose() -> PyResult<()> {
    panic!("on purpose")
}
