//! Figures of columns: the one place where columns of tables become curves of the drawing layer.

use quantity::{Kind, System as Units};

use crate::figures;
use crate::table::TableColumn;
use drawing::{Colour, Figure, Line, Panel, PlotCurve};

/// Axes with curves, each a name with its points.
pub(crate) struct Axes {
    pub x_label: String,
    pub y_label: String,
    pub curves: Vec<(String, Vec<(f64, f64)>)>,
}

/// Returns the name of a column with its unit, as an axis shows it: `wedge x (in)`.
pub(crate) fn axis(column: &TableColumn, units: Units) -> String {
    figures::axis(&words(&column.name), column.kind, units)
}

/// Returns whether a column (SI) changes by more than rounding: what stands still has no loop.
pub(crate) fn moves(kind: Kind, values: &[f64]) -> bool {
    let least = match kind {
        // A micrometre or a microradian; a hundredth of a newton or newton metre.
        Kind::Length | Kind::Angle => 1e-6,
        _ => 1e-2,
    };
    let first = values.first().copied().unwrap_or_default();
    values.iter().any(|value| (value - first).abs() > least)
}

/// Returns a column's name in words.
pub(crate) fn words(name: &str) -> String {
    name.replace('_', " ")
}

/// Returns a figure of these axes; curves of the same name look the same everywhere.
pub(crate) fn figure(title: String, caption: String, axes: Vec<Axes>) -> Figure {
    let mut names: Vec<String> = Vec::new();
    for (name, _) in axes.iter().flat_map(|axes| &axes.curves) {
        if !names.contains(name) {
            names.push(name.clone());
        }
    }
    let panel = |axes: Axes| {
        let curve = |(label, points): (String, Vec<(f64, f64)>)| {
            let place = names.iter().position(|name| *name == label).unwrap_or_default();
            PlotCurve::new(label, look(place), points)
        };
        Panel::new("", axes.x_label, axes.y_label, axes.curves.into_iter().map(curve))
    };
    Figure::new(title, caption, axes.into_iter().map(panel))
}

/// Colour and line of the curve at this place; 28 differ.
fn look(place: usize) -> (Colour, Line) {
    const COLOURS: [Colour; 7] = [
        Colour::Black,
        Colour::Vermillion,
        Colour::Blue,
        Colour::Green,
        Colour::Purple,
        Colour::Orange,
        Colour::Sky,
    ];
    const LINES: [Line; 4] = [Line::Solid, Line::Dashed, Line::DashDot, Line::Dotted];
    (COLOURS[place % COLOURS.len()], LINES[place % LINES.len()])
}
