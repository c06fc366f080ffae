//! Figures of a wheelset's run, over the distance: the track under it, where it is, forces of its wheels.

use ::study::wheelset::WheelsetCase;
use ::study::wheelset::run::WheelsetResult;
use quantity::{Kind, System as Units};

use super::{Exhibit, axis};
use crate::csv::converted;
use crate::track_files::degree;
use drawing::{Colour, Figure, Line, Panel, PlotCurve};

const BLUE: (Colour, Line) = (Colour::Blue, Line::Solid);
const RED: (Colour, Line) = (Colour::Vermillion, Line::Dashed);

/// Distances (m) as figures have them: in feet or meters.
fn distance(si: f64, units: Units) -> f64 {
    match units {
        Units::Us => si / 0.3048,
        Units::Si => si,
    }
}

/// Returns the label of the axis of distances.
fn along(units: Units) -> String {
    match units {
        Units::Us => "distance (ft)".to_owned(),
        Units::Si => "distance (m)".to_owned(),
    }
}

/// Curves of columns (with their labels) over the distance, in output units.
fn curves(result: &WheelsetResult, columns: &[(&str, &str)], kind: Kind) -> Vec<PlotCurve> {
    let units = result.summary.units;
    let distances = result.column("distance").unwrap_or_default();
    let own = columns.iter().zip([BLUE, RED]);
    own.map(|((name, label), (colour, line))| {
        let values = result.column(name).unwrap_or_default();
        let point = |(at, value): (&f64, &f64)| (distance(*at, units), converted(*value, kind, units));
        PlotCurve::new(*label, (colour, line), distances.iter().zip(values).map(point))
    })
    .collect()
}

fn panel(result: &WheelsetResult, title: &str, label: &str, kind: Kind, columns: &[(&str, &str)]) -> Panel {
    let units = result.summary.units;
    Panel::new(
        title,
        along(units),
        axis(label, kind, units),
        curves(result, columns, kind),
    )
}

/// Returns the figures.
#[must_use]
pub fn exhibits(case: &WheelsetCase, result: &WheelsetResult) -> Vec<Exhibit> {
    let name = case.wheelset.name.as_str();
    let exhibit = |what: &str, figure: Figure| Exhibit::new(format!("{name}_{what}"), figure);
    let both = |title: &str, label: &str, kind: Kind, what: &str| {
        let names = ["left", "right"].map(|side| format!("{side}_{what}"));
        panel(
            result,
            title,
            label,
            kind,
            &[(&names[0], "left"), (&names[1], "right")],
        )
    };
    let units = result.summary.units;
    let line = case.setup.lines.center_line();
    let curvature = result.column("distance").unwrap_or_default().iter();
    let curvature = curvature.map(|at| (distance(*at, units), degree(line.at(*at).curvature[0])));
    let track = Panel::new(
        "(a) curvature",
        along(units),
        "degree of curve",
        [PlotCurve::new("", (BLUE.0, BLUE.1), curvature)],
    );
    let motion = Figure::new(
        format!("{name}: where the wheelset is"),
        "Over the distance: curvature (to the left) and irregularities under the wheels (lateral \
                  to the left, vertical up); lateral place of the wheelset's center (to the left), its yaw \
                  to the track (the angle of attack), its roll (left side up).",
        [
            track,
            both("(b) alignment", "rail, lateral", Kind::Length, "rail_lateral"),
            both("(c) profile", "rail, vertical", Kind::Length, "rail_vertical"),
            panel(
                result,
                "(d) lateral",
                "to the left",
                Kind::Length,
                &[("lateral", "")],
            ),
            panel(result, "(e) yaw", "yaw", Kind::Angle, &[("yaw", "")]),
            panel(result, "(f) roll", "roll", Kind::Angle, &[("roll", "")]),
        ],
    )
    .in_columns(3);
    let forces = Figure::new(
        format!("{name}: forces of the wheels"),
        "Over the distance: forces of the wheels on the rails, vertical ones square to the track, \
                  lateral ones positive where they spread the gauge, their quotient; longitudinal forces on \
                  the wheels, forward; the wear number (energy that creep takes by distance); contact \
                  patches a wheel.",
        [
            both("(a) vertical", "force", Kind::Force, "vertical_force"),
            both("(b) lateral", "force", Kind::Force, "lateral_force"),
            both(
                "(c) lateral over vertical",
                "L/V",
                Kind::Dimensionless,
                "lateral_over_vertical",
            ),
            both("(d) longitudinal", "force", Kind::Force, "longitudinal_force"),
            both("(e) wear number", "wear number", Kind::Force, "wear_number"),
            both("(f) patches", "patches", Kind::Count, "patches"),
        ],
    )
    .in_columns(3);
    vec![exhibit("motion", motion), exhibit("forces", forces)]
}
