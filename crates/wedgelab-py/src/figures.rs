//! The report's figures as data.

use ::quantity::System as Units;
use drawing::{Figure, Line, Panel, PlotCurve};
use numpy::PyArray1;
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyList};
use report::figures::{CaseOutcome, Exhibit};
use reproduction::agreement::TruckOutcome;
use reproduction::sections::{self, Section};
use study::case::builtin;
use study::half_truck::catalog;

use crate::errors::{guarded, simple};
use crate::outcome::NativeResult;

fn curve<'py>(py: Python<'py>, curve: &PlotCurve) -> PyResult<Bound<'py, PyDict>> {
    let dict = PyDict::new(py);
    dict.set_item("label", &curve.label)?;
    dict.set_item("color", curve.colour.hex())?;
    let line = match curve.line {
        Line::Solid => "solid",
        Line::Dashed => "dashed",
        Line::DashDot => "dashdot",
        Line::Dotted => "dotted",
        Line::Bar => "bar",
    };
    dict.set_item("line", line)?;
    let (x, y): (Vec<f64>, Vec<f64>) = curve.points.iter().copied().unzip();
    dict.set_item("x", PyArray1::from_vec(py, x))?;
    dict.set_item("y", PyArray1::from_vec(py, y))?;
    Ok(dict)
}

fn panel<'py>(py: Python<'py>, panel: &Panel, cell: (usize, usize, usize)) -> PyResult<Bound<'py, PyDict>> {
    let dict = PyDict::new(py);
    dict.set_item("title", &panel.title)?;
    dict.set_item("x_label", &panel.x_label)?;
    dict.set_item("y_label", &panel.y_label)?;
    let curves = panel.curves.iter().map(|one| curve(py, one));
    dict.set_item("curves", PyList::new(py, curves.collect::<PyResult<Vec<_>>>()?)?)?;
    dict.set_item("x_window", panel.x_window)?;
    dict.set_item("y_names", &panel.y_names)?;
    let marks: Vec<_> = panel
        .marks
        .iter()
        .map(|mark| (mark.at.0, mark.at.1, &mark.text))
        .collect();
    dict.set_item("marks", marks)?;
    dict.set_item("cell", cell)?;
    Ok(dict)
}

fn figure<'py>(py: Python<'py>, name: &str, thesis: &str, figure: &Figure) -> PyResult<Bound<'py, PyDict>> {
    let dict = PyDict::new(py);
    let (cells, rows, columns) = figure.grid();
    dict.set_item("name", name)?;
    dict.set_item("thesis", thesis)?;
    dict.set_item("title", &figure.title)?;
    dict.set_item("caption", &figure.caption)?;
    let panels = figure
        .panels
        .iter()
        .zip(cells)
        .map(|(one, cell)| panel(py, one, cell));
    dict.set_item("panels", PyList::new(py, panels.collect::<PyResult<Vec<_>>>()?)?)?;
    dict.set_item("grid", (rows, columns))?;
    dict.set_item("common_axes", figure.common_axes)?;
    Ok(dict)
}

fn exhibits<'py>(py: Python<'py>, exhibits: &[Exhibit]) -> PyResult<Bound<'py, PyList>> {
    let dicts = exhibits
        .iter()
        .filter(|one| one.figure.flow.is_none())
        .map(|one| figure(py, &one.name, &one.thesis, &one.figure));
    PyList::new(py, dicts.collect::<PyResult<Vec<_>>>()?)
}

/// Returns the report's figures of one run.
#[pyfunction]
pub fn run_figures<'py>(py: Python<'py>, result: PyRef<'py, NativeResult>) -> PyResult<Bound<'py, PyList>> {
    guarded(py, || {
        let Some(outcome) = result.outcome() else {
            return Ok(PyList::empty(py));
        };
        exhibits(py, &report::figures::run::exhibits(&outcome))
    })
}

/// Returns all figures that the report has of these results together.
#[pyfunction]
pub fn report_figures<'py>(
    py: Python<'py>,
    results: Vec<PyRef<'py, NativeResult>>,
) -> PyResult<Bound<'py, PyList>> {
    guarded(py, || {
        let outcomes: Vec<CaseOutcome> = results.iter().filter_map(|result| result.outcome()).collect();
        let trucks: Vec<TruckOutcome> = results
            .iter()
            .filter_map(|result| result.half_truck())
            .filter_map(|result| Some((catalog::entry(&result.summary.name)?, result)))
            .collect();
        let mut units = outcomes.iter().map(|(_, result)| result.summary.units);
        let first: Option<Units> = units.next();
        if units.any(|other| Some(other) != first) {
            return Err(simple(
                py,
                "WedgelabError",
                "the results have different units, so that they cannot share figures",
                "run all of them with the same simulation.output_units",
            ));
        }
        // As in the report: groups beyond the thesis by their names, everything else as the thesis's runs.
        let is_beyond =
            |name: &str| builtin::thesis_names().all(|own| own != name) && builtin::group_of(name).is_some();
        let (beyond, thesis): (Vec<CaseOutcome>, Vec<CaseOutcome>) =
            outcomes.into_iter().partition(|(case, _)| is_beyond(&case.name));
        let mut plans: Vec<Section> = Vec::new();
        if !thesis.is_empty() {
            plans.extend(
                sections::thesis(&thesis)
                    .into_iter()
                    .filter(|plan| plan.run.is_none()),
            );
        }
        plans.extend(sections::beyond(&beyond));
        plans.extend(sections::comparison(&thesis, &trucks));
        let all: Vec<Exhibit> = plans.into_iter().flat_map(|plan| plan.exhibits).collect();
        exhibits(py, &all)
    })
}
