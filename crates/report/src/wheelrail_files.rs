//! The files of `wedgelab wheelrail plot`: a rigid wheelset on rails over its lateral shift, as CSV and
//! figure.

use std::io::{self, Write};

use quantity::{Kind, System as Units};
use wheelrail::contact::Side;
use wheelrail::profile::Profile;
use wheelrail::wheelset::{RigidPosition, RigidWheelset};

use crate::output_table::OutputTable;
use drawing::{Colour, Figure, Line, Panel, PlotCurve};

/// The table.
pub const TABLE: &str = "wheelrail.csv";
/// The figure.
pub const FIGURE: &str = "wheelrail.svg";
/// The same as a picture.
pub const PICTURE: &str = "wheelrail.png";
/// All of them.
pub const NAMES: [&str; 3] = [TABLE, FIGURE, PICTURE];

const INCH: f64 = 0.0254;

/// Writes a row for each position: shift, rolling radius difference, contact angles, places on wheel and
/// rail.
///
/// # Errors
/// The writer's.
pub fn write(positions: &[RigidPosition], out: &mut dyn Write) -> io::Result<()> {
    let mut table = OutputTable::new(positions, Units::Us);
    table.rounded("shift_in", Kind::Count, |own| own.shift / INCH);
    table.number("rolling_radius_difference_in", Kind::Count, |own| {
        own.rolling_radius_difference() / INCH
    });
    for (side, name) in ["left", "right"].into_iter().enumerate() {
        let name = format!("{name}_contact_angle");
        table.number(&name, Kind::Angle, move |own| own.contact_angles()[side]);
    }
    table.number("roll", Kind::Angle, |own| own.roll);
    for (side, name) in ["left", "right"].into_iter().enumerate() {
        let name = format!("{name}_wheel_place_in");
        table.number(&name, Kind::Count, move |own| own.touches[side].profile / INCH);
    }
    for (side, name) in ["left", "right"].into_iter().enumerate() {
        let name = format!("{name}_rail_place_in");
        table.number(&name, Kind::Count, move |own| own.touches[side].place[1] / INCH);
    }
    table.write_csv(out)
}

/// Returns the figure, of wheels and rails (left, right): profiles, rolling radius difference, contact
/// angles, places, and equivalent conicity over the amplitude (m).
#[must_use]
pub fn figure(
    wheels: &[Profile; 2],
    rails: &[Profile; 2],
    wheelset: &RigidWheelset,
    positions: &[RigidPosition],
    conicity: &[(f64, f64)],
) -> Figure {
    let curve =
        |label: &str, colour, line, points: Vec<(f64, f64)>| PlotCurve::new(label, (colour, line), points);
    let over_shift = |value: &dyn Fn(&RigidPosition) -> f64| -> Vec<(f64, f64)> {
        positions
            .iter()
            .map(|position| (position.shift / INCH, value(position)))
            .collect()
    };
    let outline = |profile: &Profile| -> Vec<(f64, f64)> {
        let points = profile.curve().sample(2e-4).into_iter();
        points
            .map(|(_, point)| (point.position[0] / INCH, point.position[1] / INCH))
            .collect()
    };
    let shift = "lateral shift (in, left positive)";
    let panel = |title: &str, x_label: &str, y_label: &str, curves: Vec<PlotCurve>| {
        Panel::new(title, x_label, y_label, curves)
    };
    let (blue, red) = (Colour::Blue, Colour::Vermillion);
    let mut outlines = Vec::new();
    for (what, profiles, line) in [("wheel", wheels, Line::Solid), ("rail", rails, Line::Dashed)] {
        let [left, right] = profiles;
        let colour = if what == "wheel" { blue } else { red };
        if left == right {
            outlines.push(curve(what, colour, line, outline(left)));
        } else {
            outlines.push(curve(&format!("left {what}"), colour, line, outline(left)));
            let other = if what == "wheel" {
                Colour::Sky
            } else {
                Colour::Orange
            };
            outlines.push(curve(&format!("right {what}"), other, line, outline(right)));
        }
    }
    let names = |profiles: &[Profile; 2]| match profiles[0] == profiles[1] {
        true => profiles[0].name().to_owned(),
        false => format!("{} and {}", profiles[0].name(), profiles[1].name()),
    };
    let middle = positions
        .iter()
        .min_by(|a, b| a.shift.abs().total_cmp(&b.shift.abs()));
    let sides = if wheels[0] == wheels[1] && rails[0] == rails[1] {
        1
    } else {
        2
    };
    let placed: Vec<Panel> = middle.map_or_else(Vec::new, |position| {
        (0..sides)
            .map(|side| {
                let [wheel, rail] = placed(wheelset, [&wheels[side], &rails[side]], position, side);
                let title = format!(
                    "({}) {} wheel on its rail, {:.2} in from the middle",
                    ["f", "g"][side],
                    ["left", "right"][side],
                    position.shift.abs() / INCH
                );
                panel(
                    &title,
                    "from the middle of the track (in)",
                    "above the top of the rail (in)",
                    vec![
                        curve("wheel", blue, Line::Solid, wheel),
                        curve("rail", red, Line::Dashed, rail),
                    ],
                )
            })
            .collect()
    });
    let mut figure = Figure {
        columns: 3,
        ..Figure::new(
            format!("{} on {}", names(wheels), names(rails)),
            "A rigid wheelset on rigid rails: both wheels touch at each lateral shift. Profiles are \
                  shown in their own axes. Equivalent conicity after EN 15302.",
            [
                panel("(a) profiles", "y, field side positive (in)", "z (in)", outlines),
                panel(
                    "(b) rolling radius difference",
                    shift,
                    "left less right (in)",
                    vec![curve(
                        "",
                        blue,
                        Line::Solid,
                        over_shift(&|p| p.rolling_radius_difference() / INCH),
                    )],
                ),
                panel(
                    "(c) contact angles",
                    shift,
                    "contact angle (deg)",
                    vec![
                        curve(
                            "left",
                            blue,
                            Line::Solid,
                            over_shift(&|p| p.contact_angles()[0].to_degrees()),
                        ),
                        curve(
                            "right",
                            red,
                            Line::Dashed,
                            over_shift(&|p| p.contact_angles()[1].to_degrees()),
                        ),
                    ],
                ),
                panel(
                    "(d) contact on the wheels",
                    shift,
                    "y on the wheel (in)",
                    vec![
                        curve(
                            "left",
                            blue,
                            Line::Solid,
                            over_shift(&|p| p.touches[0].profile / INCH),
                        ),
                        curve(
                            "right",
                            red,
                            Line::Dashed,
                            over_shift(&|p| p.touches[1].profile / INCH),
                        ),
                    ],
                ),
                panel(
                    "(e) equivalent conicity",
                    "amplitude (in)",
                    "equivalent conicity",
                    vec![curve(
                        "",
                        blue,
                        Line::Solid,
                        conicity
                            .iter()
                            .map(|(amplitude, value)| (amplitude / INCH, *value))
                            .collect(),
                    )],
                ),
            ],
        )
    };
    figure.panels.extend(placed);
    figure
}

/// Returns the outlines of a wheel and its rail where they stand in a position: distance from the middle of
/// the track and height above the top of the rail, in.
fn placed(
    wheelset: &RigidWheelset,
    [wheel, rail]: [&Profile; 2],
    position: &RigidPosition,
    side: usize,
) -> [Vec<(f64, f64)>; 2] {
    let sides = [Side::Left, Side::Right];
    let pair = &wheelset.pairs()[side];
    let radius = pair.nominal_radius();
    // The center of the wheel's tape circle, from the origin of the rail's profile.
    let pose = wheelset.pose(
        sides[side],
        [position.center, position.height],
        0.0,
        position.roll,
    );
    let [y0, z0] = [pose.center[0], pose.center[1]];
    let origin = wheelset.rail_origins()[side];
    let turn = if side == 0 { position.roll } else { -position.roll };
    let (sine, cosine) = libm::sincos(turn);
    let top = rail.top()[1];
    let sample = |profile: &Profile| profile.curve().sample(2e-4);
    let wheel = sample(wheel).into_iter().map(|(_, point)| {
        let [y, z] = [point.position[0], point.position[1] - radius];
        let (y, z) = (y0 + y * cosine - z * sine, z0 + y * sine + z * cosine);
        ((origin + y) / INCH, z / INCH)
    });
    let rail = sample(rail).into_iter().map(|(_, point)| {
        (
            (origin + point.position[0]) / INCH,
            (point.position[1] - top) / INCH,
        )
    });
    [wheel.collect(), rail.collect()]
}
