//! A figure as axes and curves, for a program that draws it anew.

use quantity::{Kind, System as Units};
use serde::Serialize;

use super::data::{Data, Precision};
use super::kind_name;
use drawing::thin::thin;
use drawing::{Figure, Panel, PlotCurve};

/// Curves keep what can be seen over this many columns: four times the widest screen in use.
const COLUMNS: u32 = 8000;

/// A figure.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Chart {
    /// Its title.
    pub title: String,
    /// Cells in a row; 0: all panels in one row.
    pub columns: usize,
    /// True if all panels have the same ranges of axes.
    pub common_axes: bool,
    /// Its panels, row by row.
    pub panels: Vec<ChartPanel>,
}

/// An axis's name, and what it measures if that has a unit that can be switched.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct ChartAxis {
    /// The name, without the unit if there is a quantity.
    pub name: String,
    /// The kind of quantity, a key of `quantities`.
    pub quantity: Option<String>,
}

/// Axes with curves.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ChartPanel {
    /// Its title; may be empty.
    pub title: String,
    /// Abscissa.
    pub x: ChartAxis,
    /// Ordinate.
    pub y: ChartAxis,
    /// The window that is shown of the abscissa first, SI.
    pub x_window: Option<(f64, f64)>,
    /// Names of the ordinates 0, 1, ..., from bottom to top, where the ordinate is not a number.
    pub y_names: Vec<String>,
    /// Texts at points, SI.
    pub marks: Vec<(f64, f64, String)>,
    /// Its width in cells.
    pub span: usize,
    /// Its curves, the first one lowest.
    pub curves: Vec<ChartCurve>,
}

/// A curve.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ChartCurve {
    /// Its name in the legend; may be empty.
    pub label: String,
    /// Its colour, as CSS writes it.
    pub colour: &'static str,
    /// Its width in pixels.
    pub width: f64,
    /// Lengths of dashes and gaps; empty for a solid line.
    pub dashes: Vec<f64>,
    /// The abscissae: a place in `data`.
    pub x: usize,
    /// The ordinates: a place in `data`.
    pub y: usize,
}

impl Chart {
    /// Returns the figure, whose numbers are in `units`.
    #[must_use]
    pub fn new(figure: &Figure, units: Units, precision: Precision, data: &mut Data) -> Self {
        let panels = figure.panels.iter();
        let panels = panels.map(|panel| self::panel(panel, units, precision, data));
        Self {
            title: figure.title.clone(),
            columns: figure.columns,
            common_axes: figure.common_axes,
            panels: panels.collect(),
        }
    }
}

fn panel(panel: &Panel, units: Units, precision: Precision, data: &mut Data) -> ChartPanel {
    let (x, to_x) = axis(&panel.x_label, units);
    let (y, to_y) = axis(&panel.y_label, units);
    let curves = panel
        .curves
        .iter()
        .filter(|curve| !curve.points.is_empty())
        .map(|curve| self::curve(curve, (to_x, to_y), precision, data))
        .collect();
    ChartPanel {
        title: panel.title.clone(),
        x,
        y,
        x_window: panel.x_window.map(|(from, to)| (from * to_x, to * to_x)),
        y_names: panel.y_names.clone(),
        marks: panel
            .marks
            .iter()
            .map(|mark| (mark.at.0 * to_x, mark.at.1 * to_y, mark.text.clone()))
            .collect(),
        span: panel.span.max(1),
        curves,
    }
}

fn curve(curve: &PlotCurve, (to_x, to_y): (f64, f64), precision: Precision, data: &mut Data) -> ChartCurve {
    let points = thin(&curve.points, COLUMNS);
    let list = |axis: usize| -> Vec<f64> {
        let value = |point: &(f64, f64)| [point.0 * to_x, point.1 * to_y][axis];
        points.iter().map(value).collect()
    };
    let dashes = curve.line.dashes().unwrap_or_default();
    ChartCurve {
        label: curve.label.clone(),
        colour: curve.colour.hex(),
        width: curve.line.width(),
        dashes: dashes
            .split([' ', ','])
            .filter_map(|length| length.parse().ok())
            .collect(),
        x: data.keep(&list(0), precision),
        y: data.keep(&list(1), precision),
    }
}

/// Splits a label such as `force (lbf)` into its name and kind; gives the factor that makes SI of its numbers
/// too. A unit that is none of ours, such as `%`, stays in the name.
fn axis(label: &str, units: Units) -> (ChartAxis, f64) {
    let split = label.strip_suffix(')').and_then(|rest| rest.rsplit_once(" ("));
    let found = split.and_then(|(name, unit)| {
        // An energy has the label of a moment in US customary units: the name tells them apart.
        let is =
            |kind: &&Kind| kind.label(units) == unit && (**kind != Kind::Moment || !name.contains("energy"));
        let kind = Kind::ALL.iter().find(is)?;
        Some((name, *kind))
    });
    match found {
        Some((name, kind)) => {
            let axis = ChartAxis {
                name: name.to_owned(),
                quantity: Some(kind_name(kind)),
            };
            (axis, 1.0 / kind.from_si(units))
        }
        None => {
            let axis = ChartAxis {
                name: label.to_owned(),
                quantity: None,
            };
            (axis, 1.0)
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn labels_name_their_quantities() {
        let quantity = |label: &str| axis(label, Units::Us).0.quantity;
        assert_eq!(quantity("force (lbf)").as_deref(), Some("force"));
        assert_eq!(quantity("energy (lbf·in)").as_deref(), Some("energy"));
        assert_eq!(quantity("pitch moment (lbf·in)").as_deref(), Some("moment"));
        assert_eq!(quantity("slip speed (in/s)").as_deref(), Some("speed"));
        assert_eq!(quantity("share of contact (%)"), None);
        assert_eq!(axis("share (%)", Units::Us).0.name, "share (%)");
        assert_eq!(axis("time (s)", Units::Us).1, 1.0);
        assert!((axis("travel (in)", Units::Us).1 - 0.0254).abs() < 1e-15);
        assert_eq!(axis("travel (m)", Units::Si).1, 1.0);
    }
}
