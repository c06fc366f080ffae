//! The files of an identification: `fit.json`, and figures of the loop and of what is left over.

use std::io::{self, Write};

use quantity::{Kind, System as Units};
use serde_json::{Value, json};
use study::fit::{Fit, Measured};

use crate::csv::converted;
use crate::figures::axis;
use crate::overlay::words;
use drawing::{Colour, Figure, Line, Panel, PlotCurve};

/// The numbers.
pub const FILE_NAME: &str = "fit.json";
/// The figure.
pub const FIGURE: &str = "residuals.svg";
/// The same as a picture.
pub const PICTURE: &str = "residuals.png";
/// The version of the numbers' layout.
pub const SCHEMA: &str = "wedgelab.fit/1";

/// The data that the figure shows beside the fit.
#[derive(Clone, Copy, Debug)]
pub struct FitFigure<'s> {
    /// The measured data.
    pub measured: &'s Measured,
    /// The kind of quantity that it measures.
    pub kind: Kind,
    /// The displacement at the measured times, SI, if it was measured.
    pub displacement: Option<&'s [f64]>,
    /// Units of the figure.
    pub units: Units,
    /// Probability of the intervals.
    pub confidence: f64,
}

/// Writes the numbers.
///
/// # Errors
/// They cannot be written.
pub fn write(fit: &Fit, shown: &FitFigure<'_>, mut out: impl Write) -> io::Result<()> {
    let parameters: Vec<Value> = fit
        .parameters
        .iter()
        .map(|found| {
            json!({
                "path": found.free.path,
                "unit": found.free.unit,
                "value": found.value,
                "interval": found.half_interval.map(|half| [found.value - half, found.value + half]),
                "at_bound": found.at_bound,
                "bounds": [found.free.low, found.free.high],
            })
        })
        .collect();
    let all = json!({
        "schema": SCHEMA,
        "program": format!("wedgelab {}", env!("CARGO_PKG_VERSION")),
        "column": shown.measured.column,
        "values": shown.measured.values.len(),
        "confidence": shown.confidence,
        "parameters": parameters,
        "correlations": fit.correlations,
        "standard_error": {
            "value": converted(fit.standard_error, shown.kind, shown.units),
            "unit": shown.kind.label(shown.units),
        },
        "durbin_watson": fit.durbin_watson,
        "rounds": fit.rounds,
        "settled": fit.settled,
        "largest_relative_residual": fit.largest_relative_residual,
        "warnings": fit.warnings,
        "failed": fit.failed,
    });
    serde_json::to_writer_pretty(&mut out, &all)?;
    out.write_all(b"\n")
}

/// Returns the loop measured and fitted, and the differences over time.
#[must_use]
pub fn figure(fit: &Fit, shown: &FitFigure<'_>) -> Figure {
    let (kind, units) = (shown.kind, shown.units);
    let name = words(&shown.measured.column);
    let to = |values: &[f64], kind| -> Vec<f64> {
        values
            .iter()
            .map(|value| converted(*value, kind, units))
            .collect()
    };
    let times = &shown.measured.times;
    let (measured, fitted) = (to(&shown.measured.values, kind), to(&fit.values, kind));
    let (x, x_label) = match shown.displacement {
        Some(values) => (
            to(values, Kind::Length),
            axis("bolster vertical", Kind::Length, units),
        ),
        None => (times.clone(), axis("time", Kind::Time, units)),
    };
    let curve = |label: &str, colour, line, x: &[f64], y: &[f64]| {
        PlotCurve::new(label, (colour, line), x.iter().copied().zip(y.iter().copied()))
    };
    let residuals: Vec<f64> = measured.iter().zip(&fitted).map(|(a, b)| a - b).collect();
    let size = converted(fit.standard_error, kind, units);
    let ends = [
        times.first().copied().unwrap_or(0.0),
        times.last().copied().unwrap_or(0.0),
    ];
    let level = |label: &str, value: f64| curve(label, Colour::Black, Line::Dashed, &ends, &[value, value]);
    Figure::new(
        format!("{name}: measured and fitted"),
        format!(
            "(a) The measured values and the run with the parameters found. (b) Measured less fitted over \
             time, with the standard error of one value ({} {}), up and down. What is left over should look \
             like noise: a pattern says that the model lacks something.",
            crate::figures::digits(size),
            kind.label(units)
        ),
        [
            Panel::new(
                "(a) measured and fitted",
                x_label,
                axis(&name, kind, units),
                [
                    curve("measured", Colour::Orange, Line::Solid, &x, &measured),
                    curve("fitted", Colour::Blue, Line::Dashed, &x, &fitted),
                ],
            ),
            Panel::new(
                "(b) what is left over",
                axis("time", Kind::Time, units),
                axis("measured less fitted", kind, units),
                [
                    curve("residual", Colour::Vermillion, Line::Solid, times, &residuals),
                    level("standard error", size),
                    level("standard error", -size),
                ],
            ),
        ],
    )
}
