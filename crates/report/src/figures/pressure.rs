//! The pressure over the faces of a wedge whose contact points are a grid.

use quantity::{Kind, System as Units};
use study::case::Case;
use study::result::RunResult;
use wedge::face::{FaceProperties, Rectangle};
use wedge::outputs::FACES;

use super::study::contour_curves;
use super::{CaseOutcome, Exhibit, capital, digits};
use crate::csv::converted;
use drawing::contour::{HeightGrid, round_levels};
use drawing::{Colour, Figure, Line, Panel, PlotCurve};

/// Lines of equal pressure in a map.
const LEVELS: usize = 6;

/// Returns the map of each face with a grid; `None` if there is none.
pub(super) fn exhibit((case, result): &CaseOutcome) -> Option<Exhibit> {
    Some(Exhibit::new(
        format!("{}_pressure", case.name),
        figure(case, result)?,
    ))
}

/// Returns the same as a figure.
#[must_use]
pub fn figure(case: &Case, result: &RunResult) -> Option<Figure> {
    let parameters = &case.parameters;
    let own = [&parameters.column_face, &parameters.slope_face];
    let faces = own.into_iter().zip(parameters.rectangles()).zip(FACES);
    let maps: Vec<[Panel; 2]> = faces
        .filter_map(|((face, rectangle), name)| map(result, face, &rectangle, name))
        .collect();
    if maps.is_empty() {
        return None;
    }
    Some(
        Figure::new(
            format!("{}: pressure over the faces", case.name),
            "Lines of equal pressure over the faces of the wedge, seen from the counterface: on \
                      the left at the time of the greatest pressure after the first tenth of the run, on \
                      the right on average over the same time. The pressure of a point of the grid is its \
                      normal force over the part of the face that it stands for; lines are straight between \
                      points. Left (+y) is the wedge's left side.",
            maps.into_iter().flatten(),
        )
        .in_columns(2),
    )
}

/// Returns the pressures of a face: at the time of the greatest one, and on average.
fn map(result: &RunResult, face: &FaceProperties, rectangle: &Rectangle, name: &str) -> Option<[Panel; 2]> {
    let units = result.summary.units;
    let times = result.column("time")?;
    let mut points = face.grid.points();
    points.sort_by_key(|point| (point.column, point.row));
    let columns: Option<Vec<&[f64]>> = points
        .iter()
        .map(|point| result.column(&format!("{name}_{}_pressure", point.number())))
        .collect();
    let columns = columns?;
    // The release from the start is none of the motion's.
    let first = times.partition_point(|time| *time < 0.1 * times.last().copied().unwrap_or_default());
    let most = |row: usize| columns.iter().map(|column| column[row]).fold(0.0, f64::max);
    let worst = (first..times.len()).max_by(|a, b| most(*a).total_cmp(&most(*b)))?;
    let rows = (times.len() - first) as f64;
    let at_worst: Vec<f64> = columns.iter().map(|column| column[worst]).collect();
    let mean: Vec<f64> = columns
        .iter()
        .map(|column| column[first..].iter().sum::<f64>() / rows)
        .collect();
    let panel = |title: String, pressures: Vec<f64>| {
        let heights: Vec<f64> = pressures
            .iter()
            .map(|value| converted(*value, Kind::Pressure, units))
            .collect();
        over_face(title, face, rectangle, &heights, units)
    };
    let greatest = format!(
        "{} at {} s, greatest {} {}",
        capital(name),
        digits(times[worst]),
        digits(converted(most(worst), Kind::Pressure, units)),
        Kind::Pressure.label(units)
    );
    Some([
        panel(greatest, at_worst),
        panel(
            format!("{}: mean ({})", capital(name), Kind::Pressure.label(units)),
            mean,
        ),
    ])
}

/// Lines of equal height over a face: heights at the points of its grid in shown units, from right to left
/// and in each place from the lower edge up.
pub(crate) fn over_face(
    title: String,
    face: &FaceProperties,
    rectangle: &Rectangle,
    heights: &[f64],
    units: Units,
) -> Panel {
    let length = |value: f64| converted(value, Kind::Length, units);
    let part = |place: usize, count: usize| place as f64 / (count - 1) as f64;
    let x: Vec<f64> = (0..face.grid.across)
        .map(|place| length(rectangle.width * (part(place, face.grid.across) - 0.5)))
        .collect();
    let y: Vec<f64> = (0..face.grid.up)
        .map(|place| length(rectangle.length() * part(place, face.grid.up)))
        .collect();
    let unit = Kind::Length.label(units);
    let grid = HeightGrid {
        x: &x,
        y: &y,
        heights,
    };
    let (right, left, top) = (x[0], x[x.len() - 1], y[y.len() - 1]);
    let edge = PlotCurve {
        colour: Colour::Grey,
        points: vec![
            (right, y[0]),
            (left, y[0]),
            (left, top),
            (right, top),
            (right, y[0]),
        ],
        ..PlotCurve::default()
    };
    let (mut curves, mut marks) = (vec![edge], Vec::new());
    for (mut curve, mark) in contour_curves(&grid, &round_levels(heights, LEVELS)) {
        (curve.colour, curve.line) = (Colour::Black, Line::Solid);
        curve.label = String::new();
        curves.push(curve);
        marks.push(mark);
    }
    Panel {
        x_window: Some((x[0], x[x.len() - 1])),
        marks,
        ..Panel::new(
            title,
            format!("across, left is positive ({unit})"),
            format!("up the face ({unit})"),
            curves,
        )
    }
}
