//! The files of `wedgelab lock-up`: a table of margins and of what rigs found, as CSV, and a figure.

use std::io::{self, Write};

use mechanics::quasi_static::{SlidingDirection, SlopeFriction};
use quantity::{Kind, System as Units};
use study::case::Case;
use study::lock_up::{LockUpMap, MapAxis, RigOutcome};

use crate::figures::study::contour_curves;
use crate::output_table::OutputTable;
use drawing::contour::{self, HeightGrid};
use drawing::{Colour, Figure, Line, Mark, Panel, PlotCurve};

/// The table.
pub const TABLE: &str = "lock_up.csv";
/// The figure.
pub const FIGURE: &str = "lock_up.svg";
/// The same as a picture.
pub const PICTURE: &str = "lock_up.png";
/// All of them.
pub const NAMES: [&str; 3] = [TABLE, FIGURE, PICTURE];

/// Column forces over the load, as in the jam maps of studies.
const RATIOS: [f64; 8] = [0.5, 1.0, 1.5, 2.0, 3.0, 5.0, 10.0, 30.0];
/// Points of the closed form along each axis.
const POINTS: usize = 121;
/// About so many lines of equal margin.
const LEVELS: usize = 12;
/// Half the size of a sign, of the frame's.
const SIGN: f64 = 0.008;

/// Returns the heading of an axis's column: its name with its unit.
fn heading(axis: MapAxis, units: Units) -> String {
    match axis.unit(units).0 {
        "" => axis.name().to_owned(),
        unit if axis == MapAxis::Toe => format!("toe_out_{unit}"),
        unit => format!("{}_{unit}", axis.name()),
    }
}

/// Writes a row a point: values, margins, what the rig found.
///
/// # Errors
/// The writer's.
pub fn write_table(map: &LockUpMap, units: Units, out: &mut dyn Write) -> io::Result<()> {
    let points = map.values[1].len();
    let places = |(place, cell)| ([place / points, place % points], cell);
    let mut table = OutputTable::new(map.cells.iter().enumerate().map(places), units);
    for axis in [0, 1] {
        let own = map.spans[axis].axis;
        let factor = own.unit(units).1;
        table.rounded(&heading(own, units), Kind::Count, move |(places, _)| {
            map.values[axis][places[axis]] * factor
        });
    }
    table.rounded("closing_angle_deg", Kind::Count, |(_, cell)| {
        cell.closing_angle.to_degrees()
    });
    table.rounded("lock_up_margin_deg", Kind::Count, |(_, cell)| {
        cell.margin.to_degrees()
    });
    table.text("found", |(_, cell)| cell.found.name());
    table.number("holding_column", Kind::Count, |(_, cell)| cell.holding[0]);
    table.number("holding_slope", Kind::Count, |(_, cell)| cell.holding[1]);
    table.number("column_force_ratio", Kind::Count, |(_, cell)| cell.ratio);
    table.number("quasi_static_column_force_ratio", Kind::Count, |(_, cell)| {
        cell.expected_ratio.unwrap_or(f64::NAN)
    });
    table.text("reason", |(_, cell)| match &cell.found {
        RigOutcome::Unknown(reason) => reason,
        _ => "",
    });
    table.write_csv(out)
}

/// Returns the figure: the margin with what the rigs found, and the column's force over the load.
#[must_use]
pub fn figure(case: &Case, map: &LockUpMap, units: Units) -> Figure {
    let axes = map.spans.map(|span| span.axis);
    let shown = |axis: usize, value: f64| value * axes[axis].unit(units).1;
    let values = [0, 1].map(|axis| -> Vec<f64> {
        let values = map.values[axis].iter();
        values.map(|value| shown(axis, *value)).collect()
    });
    let fine = map.spans.map(|span| span.values(POINTS));
    let fine_shown =
        [0, 1].map(|axis| -> Vec<f64> { fine[axis].iter().map(|value| shown(axis, *value)).collect() });
    let over = |of: &dyn Fn([f64; 2]) -> f64| -> Vec<f64> {
        let rows = fine[0].iter();
        rows.flat_map(|x| fine[1].iter().map(move |y| of([*x, *y])))
            .collect()
    };
    let margins = over(&|at| {
        let (wedge, yaw) = map.massless(case, at);
        wedge.lock_up_margin(yaw).to_degrees()
    });
    let closing = over(&|at| {
        let (wedge, yaw) = map.massless(case, at);
        wedge.closing_angle(yaw)
    });
    let expected = over(&|at| {
        let (wedge, _) = map.massless(case, at);
        let slide = wedge.slide(SlidingDirection::Down, SlopeFriction::UpSlope, 1.0);
        slide.map_or(f64::NAN, |slide| slide.column_normal * libm::cos(wedge.toe))
    });
    let grid = |heights| HeightGrid {
        x: &fine_shown[0],
        y: &fine_shown[1],
        heights,
    };
    let boundary = |heights, label: &str, colour| {
        PlotCurve::new(
            label,
            (colour, Line::Solid),
            broken(contour::lines(&grid(heights), 0.0)),
        )
    };
    let boundaries = [
        boundary(&margins, "margin zero: locks up beyond", Colour::Vermillion),
        boundary(&closing, "faces no longer close upwards", Colour::Purple),
    ];
    let boundaries = boundaries.into_iter().filter(|curve| !curve.points.is_empty());
    let boundaries: Vec<PlotCurve> = boundaries.collect();

    let levels: Vec<f64> = contour::round_levels(&margins, LEVELS)
        .into_iter()
        .filter(|level| *level != 0.0)
        .collect();
    let (mut curves, marks) = lines(
        &grid(&margins),
        &levels,
        "lock-up margin (deg)",
        Colour::Grey,
        Line::Solid,
    );
    curves.extend(boundaries.iter().cloned());
    curves.extend(signs(map, &values));
    let margin = panel(
        axes,
        units,
        "(a) lock-up margin, and what the rigs found",
        &values[0],
    );
    let margin = Panel {
        curves,
        marks,
        ..margin
    };

    let computed: Vec<f64> = map.cells.iter().map(|cell| cell.ratio).collect();
    let coarse = HeightGrid {
        x: &values[0],
        y: &values[1],
        heights: &computed,
    };
    let (found, found_marks) = lines(&coarse, &RATIOS, "rigs", Colour::Orange, Line::Solid);
    let (massless, _) = lines(
        &grid(&expected),
        &RATIOS,
        "massless wedge",
        Colour::Blue,
        Line::Dashed,
    );
    curves = boundaries;
    curves.extend(found);
    curves.extend(massless);
    let marks = found_marks;
    let force = panel(axes, units, "(b) column's force over the load", &values[0]);
    let force = Panel {
        curves,
        marks,
        ..force
    };
    Figure {
        title: format!(
            "{}: lock-up over {} and {}",
            case.name,
            axes[0].name(),
            axes[1].name()
        ),
        caption: format!(
            "A bolster presses the wedge by 0.3 in against the column at 0.2 in/s. (a) Lines: closing angle \
             of the faces less the friction angles of both; it locks up where this margin is not positive. \
             Signs: what {} rigs found. (b) The column's normal force along the track at the end over the \
             coil's force less the weight, of the rigs (marked with the ratio) and, dashed, of the massless \
             wedge for the same ratios, which has none where it locks up: there the rigs' forces grow with \
             the press against the stiffness of the contacts.",
            map.cells.len()
        ),
        columns: 2,
        common_axes: true,
        panels: vec![margin, force],
        flow: None,
    }
}

fn panel(axes: [MapAxis; 2], units: Units, title: &str, x: &[f64]) -> Panel {
    let label = |axis: MapAxis| match axis.unit(units).0 {
        "" => axis.words().to_owned(),
        unit => format!("{} ({unit})", axis.words()),
    };
    Panel {
        title: title.to_owned(),
        x_label: label(axes[0]),
        y_label: label(axes[1]),
        x_window: x.first().copied().zip(x.last().copied()),
        span: 1,
        ..Panel::default()
    }
}

/// Lines of equal height in one style, with their marks.
fn lines(
    grid: &HeightGrid<'_>,
    levels: &[f64],
    label: &str,
    colour: Colour,
    line: Line,
) -> (Vec<PlotCurve>, Vec<Mark>) {
    let named = |(curve, mark)| {
        let own = PlotCurve {
            label: label.to_owned(),
            colour,
            line,
            ..curve
        };
        (own, mark)
    };
    contour_curves(grid, levels).into_iter().map(named).unzip()
}

/// Lines as the points of one curve.
fn broken(lines: Vec<Vec<(f64, f64)>>) -> Vec<(f64, f64)> {
    let mut points = Vec::new();
    for line in lines {
        points.extend(line);
        points.push((f64::NAN, f64::NAN));
    }
    points
}

/// Returns a cross where a rig locked, a bar where it slid, a small stroke upwards where it is not known.
fn signs(map: &LockUpMap, values: &[Vec<f64>; 2]) -> Vec<PlotCurve> {
    let size = values.each_ref().map(|values| {
        let ends = values.first().zip(values.last());
        ends.map_or(0.0, |(first, last)| SIGN * (last - first).abs())
    });
    let points = values[1].len();
    let kinds = [
        (
            RigOutcome::Locks.name(),
            "cross: rig locks up",
            Colour::Black,
            &[[-1.0, -1.0, 1.0, 1.0], [-1.0, 1.0, 1.0, -1.0]][..],
        ),
        (
            RigOutcome::Slides.name(),
            "bar: rig slides",
            Colour::Green,
            &[[-1.0, 0.0, 1.0, 0.0]],
        ),
        (
            "unknown",
            "stroke: rig does not tell",
            Colour::Orange,
            &[[0.0, -1.0, 0.0, 1.0]],
        ),
    ];
    let curves = kinds.map(|(name, label, colour, strokes)| {
        let mut curve = PlotCurve::new(label, (colour, Line::Solid), []);
        let places = map
            .cells
            .iter()
            .enumerate()
            .filter(|(_, cell)| cell.found.name() == name);
        for (place, _) in places {
            let (x, y) = (values[0][place / points], values[1][place % points]);
            for [a, b, c, d] in strokes {
                curve.points.extend([
                    (x + a * size[0], y + b * size[1]),
                    (x + c * size[0], y + d * size[1]),
                    (f64::NAN, f64::NAN),
                ]);
            }
        }
        curve
    });
    curves
        .into_iter()
        .filter(|curve| !curve.points.is_empty())
        .collect()
}
