//! The report's figures.
//!
//! - [`run`]: what the thesis lacks, run by run; `pressure`: over faces with grids of points.
//! - [`power_flow`]: where the energy of a cycle goes, of any run.
//! - [`truck`]: a run of a three-piece truck; [`car`]: of a car on track, over the distance.
//! - [`vehicle`]: of a vehicle of bodies and elements, over time.
//! - [`assessment`]: of a car in regimes, over the speed.
//! - [`side_by_side`]: runs over each other, read back from their folders.
//! - [`study`]: main effects and contours of studies; [`jam`]: their jam map.

pub mod assessment;
pub mod car;
pub mod jam;
pub mod power_flow;
mod pressure;
pub mod rise;
pub mod run;
pub mod side_by_side;
pub mod study;
pub mod truck;
pub mod vehicle;
pub mod wheelset;

use ::study::case::Case;
use ::study::result::RunResult;
use ::study::summary::RunSummary;
use mechanics::motion::Motion;
pub use pressure::figure as pressure_figure;
pub(crate) use pressure::over_face;
use quantity::{Kind, System as Units};

use crate::csv::converted;
use drawing::{Colour, Figure, Line, PlotCurve};

/// A case and what came out of it.
pub type CaseOutcome = (Case, RunResult);

/// A figure of the report.
#[derive(Clone, Debug, PartialEq)]
pub struct Exhibit {
    /// Its name, as in file names and links.
    pub name: String,
    /// Its name in the thesis, such as `figure 5-3`; empty if the thesis does not have it.
    pub thesis: String,
    /// The figure.
    pub figure: Figure,
}

impl Exhibit {
    /// Returns a figure that the thesis does not have.
    #[must_use]
    pub fn new(name: impl Into<String>, figure: Figure) -> Self {
        Self {
            name: name.into(),
            thesis: String::new(),
            figure,
        }
    }
}

/// Returns the bolster's constant yaw, rad; 0 if it moves.
#[must_use]
pub fn yaw(case: &Case) -> f64 {
    match &case.parameters.bolster.coordinates[5] {
        Motion::Constant(yaw) => *yaw,
        _ => 0.0,
    }
}

/// Returns the style of curves of this toe angle (rad, positive out), the same in all figures.
#[must_use]
pub fn toe_style(toe: f64) -> (String, Colour, Line) {
    let degrees = (toe.to_degrees().abs() * 1e6).round() / 1e6;
    if toe > 0.0 {
        (format!("toe out {degrees}°"), Colour::Blue, Line::Solid)
    } else if toe < 0.0 {
        (format!("toe in {degrees}°"), Colour::Vermillion, Line::DashDot)
    } else {
        ("no toe".to_owned(), Colour::Black, Line::Dashed)
    }
}

/// Returns the points of one column over another, in the result's units.
#[must_use]
pub fn points<S: RunSummary>(result: &RunResult<S>, x: &str, y: &str) -> Vec<(f64, f64)> {
    let (Some((x, x_kind)), Some((y, y_kind))) = (column(result, x), column(result, y)) else {
        return Vec::new();
    };
    let units = result.summary.units();
    x.iter()
        .zip(y)
        .map(|(x, y)| (converted(*x, x_kind, units), converted(*y, y_kind, units)))
        .collect()
}

/// Returns a column's values (SI) and kind.
fn column<'r, S>(result: &'r RunResult<S>, name: &str) -> Option<(&'r [f64], Kind)> {
    let index = result.columns.iter().position(|column| column.name == name)?;
    Some((&result.values[index], result.columns[index].kind))
}

/// Returns a curve of one column over another; none if a column is missing.
#[must_use]
pub fn curve<S: RunSummary>(
    result: &RunResult<S>,
    x: &str,
    y: &str,
    (label, colour, line): (&str, Colour, Line),
) -> PlotCurve {
    PlotCurve::new(label, (colour, line), points(result, x, y))
}

/// Returns a name with its unit, as axes have it.
#[must_use]
pub fn axis(name: &str, kind: Kind, units: Units) -> String {
    match kind.label(units) {
        "" => name.to_owned(),
        unit => format!("{name} ({unit})"),
    }
}

/// Returns a title after a name.
pub(crate) fn lowered(title: &str) -> String {
    let mut letters = title.chars();
    letters.next().map_or(String::new(), |first| {
        first.to_lowercase().chain(letters).collect()
    })
}

/// Returns a word with its first letter made large.
#[must_use]
pub fn capital(text: &str) -> String {
    let mut letters = text.chars();
    match letters.next() {
        Some(first) => first.to_uppercase().chain(letters).collect(),
        None => String::new(),
    }
}

/// Returns a number for a caption: three or four significant digits, a true minus sign.
#[must_use]
pub fn digits(value: f64) -> String {
    let size = value.abs();
    let decimals = match size {
        _ if size >= 100.0 || size == 0.0 => 0,
        _ if size >= 10.0 => 1,
        _ if size >= 0.1 => 2,
        _ if size >= 1e-4 => 5,
        _ => return format!("{value:.2e}").replace('-', "\u{2212}"),
    };
    let text = format!("{value:.decimals$}");
    let text = if decimals > 2 {
        text.trim_end_matches('0')
    } else {
        &text
    };
    text.replace('-', "\u{2212}")
}

#[cfg(test)]
mod tests {
    use super::digits;

    #[test]
    fn captions_have_short_numbers() {
        let texts = [12345.6, -17.25, 0.123, 0.001, 0.0].map(digits);
        assert_eq!(texts, ["12346", "\u{2212}17.2", "0.12", "0.001", "0"]);
    }
}
