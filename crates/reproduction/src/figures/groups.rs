//! Figures of the built-in cases beyond the thesis: one a group, from all runs of the group.
//!
//! Reference lines are those of the quasi-static wedge ([`study::closed_form`]), dashed or dotted, and are
//! not drawn where it has none.

use drawing::{Colour, Figure, Line, Panel, PlotCurve};
use mechanics::quasi_static::{SlidingDirection, SlopeFriction};
use quantity::{Kind, System as Units};
use report::csv::converted;
use report::figures::{CaseOutcome, axis};
use study::case::{Case, builtin};
use study::closed_form;
use study::metrics::Cycle;
use study::result::RunResult;
use study::summary::Averages;
use wedge::parameters::{Damping, Parameters};

/// Colour and line of the curves of a panel, in their order.
const STYLES: [(Colour, Line); 4] = [
    (Colour::Blue, Line::Solid),
    (Colour::Vermillion, Line::DashDot),
    (Colour::Green, Line::Dashed),
    (Colour::Purple, Line::Dotted),
];
const DAMPINGS: [Damping; 2] = [Damping::Constant, Damping::Variable];

/// The names of the groups that have a figure.
pub const GROUPS: [&str; 9] = [
    "warp",
    "rig",
    "sweep",
    "twist_and_roll",
    "yaw_and_sway",
    "load",
    "wear",
    "lock_up",
    "overturned_toe",
];

/// Returns whether a figure of a group may need this column: the others need not be kept.
#[must_use]
pub fn needs(column: &str) -> bool {
    const ALSO: [&str; 4] = [
        "time",
        "vertical_wedge_force",
        "longitudinal_wedge_force",
        "coil_force",
    ];
    let begins = ["net_", "bolster_", "wedge_"]
        .iter()
        .any(|start| column.starts_with(start));
    ALSO.contains(&column) || begins && !column.ends_with("_rate")
}

/// Returns the figure of a group from its runs (those that there are); `None` for a group without a figure,
/// or without runs. All runs should have the same output units: those of the first are used.
#[must_use]
pub fn figure(group: &str, runs: &[CaseOutcome]) -> Option<Figure> {
    let units = runs.first()?.1.summary.units;
    let panels = match group {
        "warp" => warp(runs, units),
        "rig" => rig(runs, units),
        "sweep" => sweep(runs, units),
        "twist_and_roll" => histories(
            runs,
            units,
            [
                ("net_force_on_bolster_z", "vertical force on the bolster"),
                ("net_moment_on_bolster_x", "roll moment on the bolster"),
            ],
        ),
        "yaw_and_sway" => histories(
            runs,
            units,
            [
                ("net_force_on_side_frame_y", "lateral force on the side frame"),
                ("net_moment_on_side_frame_z", "yaw moment on the side frame"),
            ],
        ),
        "load" => load(runs, units),
        "wear" => wear(runs, units),
        "lock_up" => lock_up(runs, units),
        "overturned_toe" => histories(
            runs,
            units,
            [
                ("wedge_z", "height of the wedge"),
                ("coil_force", "force of the coil"),
            ],
        ),
        _ => return None,
    };
    let about = builtin::group(group)?;
    Some(sheet(about.title, about.look_at, panels))
}

/// Moment about the column's middle over the pocket's yaw, the last two periods; the limit N_c h3/2 of the
/// last one.
fn warp(runs: &[CaseOutcome], units: Units) -> Vec<Panel> {
    let of = |(case, result): &CaseOutcome| -> Option<Panel> {
        let times = result.column("time")?;
        let yaw = result.column("bolster_yaw")?;
        let moment = result.column("net_moment_on_side_frame_z")?;
        let normal = result.column("longitudinal_wedge_force")?;
        let end = *times.last()?;
        let period = motion_period(case).unwrap_or(end);
        let since = |time: f64| times.iter().position(|t| *t >= time - 1e-9 * end).unwrap_or(0);
        let moment_at = |row: usize| (yaw[row], converted(moment[row], Kind::Moment, units));
        let mut curves = vec![curve(
            "moment",
            STYLES[0],
            (since(end - 2.0 * period)..times.len()).map(moment_at),
        )];
        for side in [1.0, -1.0] {
            let rows = (since(end - period)..times.len()).filter(|row| side * moment[*row] > 0.0);
            let limit = |row: usize| {
                let limit = side * closed_form::edge_loading_limit(&case.parameters, normal[row]);
                (yaw[row], converted(limit, Kind::Moment, units))
            };
            curves.push(curve(
                "limit N_c h3/2",
                (Colour::Black, Line::Dashed),
                rows.map(limit),
            ));
        }
        Some(panel(
            case.title.rsplit("; ").next().unwrap_or(&case.title),
            ("yaw of the pocket", Kind::Angle),
            ("yaw moment on the side frame", Kind::Moment),
            units,
            curves,
        ))
    };
    runs.iter().filter_map(of).collect()
}

/// Vertical wedge force over displacement, with the quasi-static wedge's two branches.
fn rig(runs: &[CaseOutcome], units: Units) -> Vec<Panel> {
    let of = |(case, result): &CaseOutcome| -> Option<Panel> {
        let mut curves = vec![curve(
            "dynamic wedge",
            STYLES[0],
            cycles(case, result, "vertical_wedge_force", units)?,
        )];
        curves.extend(branches(&case.parameters, units));
        Some(force_panel(case.parameters.damping, units, curves))
    };
    runs.iter().filter_map(of).collect()
}

/// Equivalent damping and stiffness over frequency, a curve an amplitude, with the quasi-static ones.
fn sweep(runs: &[CaseOutcome], units: Units) -> Vec<Panel> {
    type Value = (
        &'static str,
        Kind,
        fn(&Averages) -> Option<f64>,
        fn(&Parameters) -> Option<f64>,
    );
    let values: [Value; 2] = [
        (
            "equivalent damping on the bolster",
            Kind::Damping,
            |averages| Some(averages.equivalent_damping_on_bolster.as_ref()?.value),
            |parameters| Some(closed_form::first_harmonic(parameters)?.damping),
        ),
        (
            "equivalent stiffness on the bolster",
            Kind::Stiffness,
            |averages| Some(averages.equivalent_stiffness.as_ref()?.value),
            |parameters| Some(closed_form::first_harmonic(parameters)?.stiffness),
        ),
    ];
    let mut panels = Vec::new();
    for (title, kind, found, expected) in values {
        for damping in DAMPINGS {
            let mut lines: Vec<(f64, Vec<&CaseOutcome>)> = Vec::new();
            for run in runs.iter().filter(|(case, _)| case.parameters.damping == damping) {
                let Some(cycle) = Cycle::of(&run.0.parameters) else {
                    continue;
                };
                match lines
                    .iter_mut()
                    .find(|(amplitude, _)| *amplitude == cycle.amplitude)
                {
                    Some((_, line)) => line.push(run),
                    None => lines.push((cycle.amplitude, vec![run])),
                }
            }
            let mut curves = Vec::new();
            for (index, (amplitude, line)) in lines.iter().enumerate() {
                let (colour, style) = STYLES[index % STYLES.len()];
                let name = amplitude_name(*amplitude, units);
                let points = line
                    .iter()
                    .filter_map(|(case, result)| Some((hertz(case)?, found(&result.summary.averages)?)));
                curves.push(curve(&name, (colour, style), points));
                let reference = line.iter().filter_map(|(case, _)| {
                    Some((hertz(case)?, converted(expected(&case.parameters)?, kind, units)))
                });
                curves.push(curve(
                    &format!("{name}, quasi-static"),
                    (colour, Line::Dotted),
                    reference,
                ));
            }
            if !curves.is_empty() {
                panels.push(Panel {
                    x_label: "frequency (Hz)".to_owned(),
                    ..panel(
                        &format!("{} damping", damping.name()),
                        ("", Kind::Dimensionless),
                        (title, kind),
                        units,
                        curves,
                    )
                });
            }
        }
    }
    panels
}

/// Returns two columns over time, a panel each, a curve a damping.
fn histories(runs: &[CaseOutcome], units: Units, columns: [(&str, &str); 2]) -> Vec<Panel> {
    let of = |(name, label): (&str, &str)| -> Option<Panel> {
        let mut kind = None;
        let mut curves = Vec::new();
        for ((case, result), style) in runs.iter().zip(STYLES) {
            let column = result.columns.iter().find(|column| column.name == name)?;
            let values = result.column(name)?;
            kind = Some(column.kind);
            let points = result
                .column("time")?
                .iter()
                .zip(values)
                .map(|(time, value)| (*time, converted(*value, column.kind, units)));
            let damping = case.parameters.damping.name();
            curves.push(curve(&format!("{damping} damping"), style, points));
        }
        Some(panel(label, ("time", Kind::Time), (label, kind?), units, curves))
    };
    columns.into_iter().filter_map(of).collect()
}

/// Loops about the bolster's heights, a panel a damping.
fn load(runs: &[CaseOutcome], units: Units) -> Vec<Panel> {
    let of = |damping: Damping| -> Option<Panel> {
        let mut curves = Vec::new();
        let runs = runs.iter().filter(|(case, _)| case.parameters.damping == damping);
        for ((case, result), style) in runs.zip(STYLES) {
            let middle = converted(Cycle::of(&case.parameters)?.middle, Kind::Length, units);
            let points = cycles(case, result, "vertical_wedge_force", units)?;
            let points = points.into_iter().map(|(z, force)| (z - middle, force));
            let name = case.name.rsplit('_').next().unwrap_or(&case.name);
            curves.push(curve(name, style, points));
        }
        (!curves.is_empty()).then(|| Panel {
            x_label: format!(
                "bolster's displacement from its mean height ({})",
                Kind::Length.label(units)
            ),
            ..force_panel(damping, units, curves)
        })
    };
    DAMPINGS.into_iter().filter_map(of).collect()
}

/// Wedge rise at the start, and energy a cycle, over the depth of wear.
fn wear(runs: &[CaseOutcome], units: Units) -> Vec<Panel> {
    let (mut rises, mut energies) = (Vec::new(), Vec::new());
    for (damping, style) in DAMPINGS.into_iter().zip(STYLES) {
        let runs: Vec<&CaseOutcome> = runs
            .iter()
            .filter(|(case, _)| case.parameters.damping == damping)
            .collect();
        let height = |run: &CaseOutcome| run.1.column("wedge_z").and_then(|z| z.first().copied());
        let unworn = runs
            .iter()
            .find(|(case, _)| case.parameters.wedge_rise() == 0.0)
            .and_then(|run| height(run));
        let length = |value: f64| converted(value, Kind::Length, units);
        let depth = |run: &CaseOutcome| length(run.0.parameters.wear.column);
        let name = format!("{} damping", damping.name());
        let closed = format!("{name}, closed form");
        let reference = (style.0, Line::Dotted);
        if let Some(unworn) = unworn {
            let points = runs
                .iter()
                .filter_map(|run| Some((depth(run), length(height(run)? - unworn))));
            rises.push(curve(&name, style, points));
        }
        let points = runs
            .iter()
            .map(|run| (depth(run), length(run.0.parameters.wedge_rise())));
        rises.push(curve(&closed, reference, points));
        let points = runs.iter().filter_map(|run| {
            let energy = run.1.summary.averages.energy_per_cycle.get("side_frame")?;
            Some((depth(run), energy.value))
        });
        energies.push(curve(&name, style, points));
        let points = runs.iter().filter_map(|run| {
            let energy = closed_form::energy_per_cycle(&run.0.parameters)?;
            Some((depth(run), converted(energy, Kind::Energy, units)))
        });
        energies.push(curve(&closed, reference, points));
    }
    let depth = ("depth of wear of each face", Kind::Length);
    vec![
        panel("wedge rise", depth, ("wedge rise", Kind::Length), units, rises),
        panel(
            "damping that is left",
            depth,
            ("energy lost per cycle", Kind::Energy),
            units,
            energies,
        ),
    ]
}

/// Force of the column and vertical force on the bolster over time, with the quasi-static wedge that the
/// faces close on, and with what the friction of the column can hold.
fn lock_up(runs: &[CaseOutcome], units: Units) -> Vec<Panel> {
    let (mut normals, mut verticals) = (Vec::new(), Vec::new());
    for ((case, result), style) in runs.iter().zip(STYLES) {
        let (Some(times), Some(normal), Some(vertical), Some(coil)) = (
            result.column("time"),
            result.column("longitudinal_wedge_force"),
            result.column("net_force_on_bolster_z"),
            result.column("coil_force"),
        ) else {
            continue;
        };
        let over_time = |values: &mut dyn Iterator<Item = f64>| -> Vec<(f64, f64)> {
            let converted = values.map(|value| converted(value, Kind::Force, units));
            times.iter().copied().zip(converted).collect()
        };
        let friction = case.parameters.column_friction.coefficient;
        let name = format!("friction {friction}");
        normals.push(curve(&name, style, over_time(&mut normal.iter().copied())));
        let weight = case.parameters.wedge.mass * case.parameters.gravity;
        let wedge = closed_form::wedge(&case.parameters);
        let sliding = |coil: &f64| {
            let slide = wedge.slide(SlidingDirection::Down, SlopeFriction::UpSlope, coil - weight);
            slide.map_or(f64::NAN, |slide| slide.column_normal)
        };
        if wedge.lock_up_margin(0.0) > 0.0 {
            let reference = (style.0, Line::Dotted);
            let points = over_time(&mut coil.iter().map(sliding));
            normals.push(curve(
                &format!("{name}, quasi-static, pressed"),
                reference,
                points,
            ));
        }
        verticals.push(curve(&name, style, over_time(&mut vertical.iter().copied())));
        let holds = over_time(&mut normal.iter().map(|normal| friction * normal - weight));
        verticals.push(curve(
            "μ N_c less the weight",
            (Colour::Black, Line::Dotted),
            holds,
        ));
    }
    let time = ("time", Kind::Time);
    vec![
        panel(
            "pressed",
            time,
            ("column normal force", Kind::Force),
            units,
            normals,
        ),
        panel(
            "forced down and up",
            time,
            ("vertical force on the bolster", Kind::Force),
            units,
            verticals,
        ),
    ]
}

/// Returns a column over the bolster's vertical displacement, without the first half period.
fn cycles(case: &Case, result: &RunResult, name: &str, units: Units) -> Option<Vec<(f64, f64)>> {
    let start = 0.5 * Cycle::of(&case.parameters)?.period();
    let kind = result.columns.iter().find(|column| column.name == name)?.kind;
    let displacement = result.column("bolster_vertical")?;
    let rows = result
        .column("time")?
        .iter()
        .zip(displacement.iter().zip(result.column(name)?));
    let point =
        |(z, value): (&f64, &f64)| (converted(*z, Kind::Length, units), converted(*value, kind, units));
    Some(
        rows.filter(|(time, _)| **time >= start)
            .map(|(_, pair)| point(pair))
            .collect(),
    )
}

/// Returns the quasi-static wedge's forces over the bolster's stroke: straight lines.
fn branches(parameters: &Parameters, units: Units) -> Vec<PlotCurve> {
    let Some(cycle) = Cycle::of(parameters) else {
        return Vec::new();
    };
    let ends = [cycle.middle - cycle.amplitude, cycle.middle + cycle.amplitude];
    let line = |direction| {
        let points = ends.iter().filter_map(|z| {
            let force = closed_form::vertical_wedge_force(parameters, *z, direction)?;
            Some((
                converted(*z, Kind::Length, units),
                converted(force, Kind::Force, units),
            ))
        });
        curve("quasi-static wedge", (Colour::Black, Line::Dashed), points)
    };
    [SlidingDirection::Up, SlidingDirection::Down].map(line).into()
}

fn force_panel(damping: Damping, units: Units, curves: Vec<PlotCurve>) -> Panel {
    panel(
        &format!("{} damping", damping.name()),
        ("bolster's vertical displacement", Kind::Length),
        ("vertical wedge force", Kind::Force),
        units,
        curves,
    )
}

/// Returns the period of the bolster's yaw, s.
fn motion_period(case: &Case) -> Option<f64> {
    match &case.parameters.bolster.coordinates[5] {
        mechanics::motion::Motion::Sine {
            angular_frequency, ..
        } => Some(2.0 * std::f64::consts::PI / angular_frequency.abs()),
        _ => None,
    }
}

fn hertz(case: &Case) -> Option<f64> {
    Some(1.0 / Cycle::of(&case.parameters)?.period())
}

fn amplitude_name(amplitude: f64, units: Units) -> String {
    let value = (converted(amplitude, Kind::Length, units) * 1e6).round() / 1e6;
    format!("{value} {}", Kind::Length.label(units))
}

// All data for the drawing layer pass through these three.

fn curve(
    label: &str,
    (colour, line): (Colour, Line),
    points: impl IntoIterator<Item = (f64, f64)>,
) -> PlotCurve {
    PlotCurve {
        label: label.to_owned(),
        colour,
        line,
        points: points.into_iter().collect(),
    }
}

fn panel(
    title: &str,
    (x, x_kind): (&str, Kind),
    (y, y_kind): (&str, Kind),
    units: Units,
    curves: Vec<PlotCurve>,
) -> Panel {
    Panel {
        title: title.to_owned(),
        x_label: axis(x, x_kind, units),
        y_label: axis(y, y_kind, units),
        curves,
        ..Panel::default()
    }
}

fn sheet(title: &str, caption: &str, panels: Vec<Panel>) -> Figure {
    Figure {
        title: title.to_owned(),
        caption: caption.to_owned(),
        columns: if panels.len() > 3 { 2 } else { 0 },
        panels,
        ..Figure::default()
    }
}
