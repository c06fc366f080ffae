//! Figures of a vehicle's run: what its bodies do, what its elements carry, over time; its wheels on a track
//! over the distance.

use ::study::vehicle::run::VehicleResult;
use mechanics::output::Column;
use quantity::Kind;

use super::{Exhibit, axis, curve};
use crate::overlay::moves;
use drawing::{Figure, Panel, PlotCurve, distinct};

/// The most curves of a panel.
const CURVES: usize = 6;

/// Returns the figures.
#[must_use]
pub fn exhibits(result: &VehicleResult) -> Vec<Exhibit> {
    let coordinates = [
        ("_x", Kind::Length, "forward"),
        ("_y", Kind::Length, "to the left"),
        ("_z", Kind::Length, "up"),
        ("_roll", Kind::Angle, "roll"),
        ("_pitch", Kind::Angle, "pitch"),
        ("_yaw", Kind::Angle, "yaw"),
    ];
    let forces = [
        ("_force", Kind::Force, "force of springs, dampers, stops"),
        ("_force_x", Kind::Force, "force along x"),
        ("_force_y", Kind::Force, "force along y"),
        ("_force_z", Kind::Force, "force along z"),
        ("_normal_force", Kind::Force, "normal force"),
        ("_friction_force", Kind::Force, "friction force"),
    ];
    let wheels = [
        ("_left_vertical_force", Kind::Force, "vertical force, left wheels"),
        (
            "_right_vertical_force",
            Kind::Force,
            "vertical force, right wheels",
        ),
        ("_left_l_over_v", Kind::Dimensionless, "L/V, left wheels"),
        ("_right_l_over_v", Kind::Dimensionless, "L/V, right wheels"),
        ("_roll", Kind::Angle, "roll"),
    ];
    let unit = Kind::Distance.label(result.summary.units);
    let over = result.columns.iter().find(|own| own.kind == Kind::Distance);
    let over_distance = over.and_then(|own| {
        figure(
            (result, &own.name, &format!("distance ({unit})")),
            "wheel_loads",
            "wheels along the track",
            "Forces of the wheels on their rails, L/V and roll over the distance.",
            &wheels,
        )
    });
    let result = (result, "time", "time (s)");
    [
        over_distance,
        figure(
            result,
            "motion",
            "motion of the bodies",
            "Displacements of centers of gravity and rotations from the nominal layout, over time.",
            &coordinates,
        ),
        figure(
            result,
            "forces",
            "forces of the elements",
            "Forces over time: of springs, dampers and stops positive in compression, of others along the \
             axes of their end b.",
            &forces,
        ),
    ]
    .into_iter()
    .flatten()
    .collect()
}

/// Returns the figure of the columns with these endings over one of a run, with the text of its axis; none
/// where nothing moves.
fn figure(
    (result, x, x_axis): (&VehicleResult, &str, &str),
    name: &str,
    title: &str,
    caption: &str,
    wanted: &[(&str, Kind, &str)],
) -> Option<Exhibit> {
    let units = result.summary.units;
    let mut left_out = 0;
    let mut panels = Vec::new();
    for (ending, kind, label) in wanted {
        let own = result.columns.iter().zip(&result.values);
        let own: Vec<&Column> = own
            .filter(|(column, values)| {
                column.kind == *kind && column.name.ends_with(ending) && moves(*kind, values)
            })
            .map(|(column, _)| column)
            .filter(|column| owner(column).len() + ending.len() == column.name.len())
            .collect();
        left_out += own.len().saturating_sub(CURVES);
        let curves: Vec<PlotCurve> = own
            .iter()
            .take(CURVES)
            .enumerate()
            .map(|(number, column)| {
                let (colour, line) = distinct(number);
                let label = owner(column).replace('_', " ");
                curve(result, x, &column.name, (&label, colour, line))
            })
            .collect();
        if !curves.is_empty() {
            let letter = char::from(b'a' + u8::try_from(panels.len()).unwrap_or(0));
            panels.push(Panel::new(
                format!("({letter}) {label}"),
                x_axis.to_owned(),
                axis("", *kind, units).trim().to_owned(),
                curves,
            ));
        }
    }
    if panels.is_empty() {
        return None;
    }
    let more = match left_out {
        0 => String::new(),
        left_out => format!(" Of each the first {CURVES}; {left_out} more are in the table."),
    };
    let columns = panels.len().min(3);
    Some(Exhibit::new(
        format!("{}_{name}", result.summary.name),
        Figure::new(
            format!("{}: {title}", result.summary.name),
            format!("{caption}{more}"),
            panels,
        )
        .in_columns(columns),
    ))
}

/// Returns the name of the body or element that a column is of.
fn owner(column: &Column) -> &str {
    column.text.split_once(':').map_or("", |(owner, _)| owner)
}
