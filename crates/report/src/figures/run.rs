//! Figures that the thesis lacks, for each run: the energy ledger, contact states, corner forces, stick and
//! wear.

use quantity::Kind;
use study::cycles::{CycleShare, shares};
use study::metrics::Cycle;
use study::result::RunResult;
use wedge::outputs::{CORNERS, FACES};

use super::{CaseOutcome, Exhibit, axis, column, curve, digits, lowered, points, power_flow};
use crate::csv::converted;
use drawing::{Colour, Figure, Line, Panel, PlotCurve, distinct};

/// Returns the figures of one run.
#[must_use]
pub fn exhibits(outcome: &CaseOutcome) -> Vec<Exhibit> {
    let (case, result) = outcome;
    let name = case.name.as_str();
    let mut exhibits = vec![
        ledger(name, result),
        contact_states(name, result),
        corner_forces(name, result),
    ];
    if let Some(figure) = power_flow::figure(&result.summary.energy) {
        let title = format!("{name}: {}", lowered(&figure.title));
        exhibits.push(exhibit(name, "power_flow", Figure { title, ..figure }));
    }
    exhibits.extend(super::pressure::exhibit(outcome));
    if let Some(cycle) = Cycle::of(&case.parameters) {
        let shares = shares(result, &cycle);
        if !shares.is_empty() {
            exhibits.push(stick_and_wear(name, result, &shares));
        }
    }
    exhibits
}

fn exhibit(name: &str, what: &str, figure: Figure) -> Exhibit {
    Exhibit::new(format!("{name}_{what}"), figure)
}

fn ledger(name: &str, result: &RunResult) -> Exhibit {
    const ENTRIES: [(&str, &str); 7] = [
        ("motion_work", "work of the bolster's motion"),
        ("side_frame_friction_loss", "lost in friction at the side frame"),
        ("bolster_friction_loss", "lost in friction at the bolster"),
        ("stored_energy_change", "stored, less that at the start"),
        ("coil_damping_loss", "lost in the coil"),
        ("contact_damping_loss", "lost in contact damping"),
        ("coil_guide_work", "work of the coil's guiding couple"),
    ];
    let units = result.summary.units;
    let mut curves = Vec::new();
    for (number, (entry, label)) in ENTRIES.into_iter().enumerate() {
        let moves = column(result, entry).is_some_and(|(values, _)| values.iter().any(|value| *value != 0.0));
        if moves {
            let (colour, line) = distinct(number);
            curves.push(curve(result, "time", entry, (label, colour, line)));
        }
    }
    let residual = ("residual", Colour::Black, Line::Solid);
    exhibit(
        name,
        "energy_ledger",
        Figure::new(
            format!("{name}: the energy ledger"),
            "(a) Work done on the wedge since the start and where it went; every loss is \
                      integrated from its own force and velocity. (b) What does not add up: the work less \
                      stored energy and losses.",
            [
                Panel::new(
                    "(a) entries",
                    "time (s)",
                    axis("energy", Kind::Energy, units),
                    curves,
                ),
                Panel::new(
                    "(b) residual",
                    "time (s)",
                    axis("energy", Kind::Energy, units),
                    [curve(result, "time", "ledger_residual", residual)],
                ),
            ],
        ),
    )
}

/// Returns a strip of bars for each pair of corner and surface.
fn contact_states(name: &str, result: &RunResult) -> Exhibit {
    const STATES: [(&str, Colour); 3] = [
        ("open", Colour::Sky),
        ("stick", Colour::Black),
        ("slip", Colour::Orange),
    ];
    let mut names = Vec::new();
    let mut curves: Vec<PlotCurve> = STATES
        .into_iter()
        .map(|(label, colour)| PlotCurve::new(label, (colour, Line::Bar), []))
        .collect();
    for (face, corner) in FACES
        .iter()
        .rev()
        .flat_map(|face| CORNERS.iter().map(move |corner| (face, corner)))
    {
        let row = names.len() as f64;
        names.push(format!("{face}, {}", corner.replace('_', " ")));
        let strip = points(result, "time", &format!("{face}_{corner}_state"));
        for run in strip.chunk_by(|a, b| a.1 == b.1) {
            let (Some(first), Some(last)) = (run.first(), run.last()) else {
                continue;
            };
            let end = strip.iter().find(|point| point.0 > last.0).unwrap_or(last);
            let state = (first.1 as usize).min(STATES.len() - 1);
            curves[state]
                .points
                .extend([(first.0, row), (end.0, row), (f64::NAN, f64::NAN)]);
        }
    }
    curves.retain(|curve| !curve.points.is_empty());
    let end = points(result, "time", "time").last().map_or(1.0, |last| last.0);
    exhibit(
        name,
        "contact_states",
        Figure::new(
            format!("{name}: contact states"),
            "State of each corner of the wedge at the column and at the slope, at the output \
                      times: open, stick (with the tanh law: slower than its reference speed), slip. Left \
                      is the wedge's +y side.",
            [Panel {
                x_label: "time (s)".to_owned(),
                curves,
                y_names: names,
                x_window: Some((0.0, end)),
                ..Panel::default()
            }],
        ),
    )
}

fn corner_forces(name: &str, result: &RunResult) -> Exhibit {
    let units = result.summary.units;
    let mut panels = Vec::new();
    let start = release(result);
    let end = points(result, "time", "time").last().map_or(0.0, |last| last.0);
    let mut letter = 'a'..;
    for (what, title) in [("normal", "normal forces"), ("friction", "friction forces")] {
        for face in FACES {
            let curves = CORNERS.into_iter().enumerate().map(|(number, corner)| {
                let label = corner.replace('_', " ");
                let (colour, line) = distinct(number);
                let stem = format!("{face}_{corner}");
                if what == "normal" {
                    let column = format!("{stem}_normal_force");
                    return curve(result, "time", &column, (&label, colour, line));
                }
                PlotCurve::new(label, (colour, line), friction(result, &stem))
            });
            panels.push(Panel {
                x_window: (start > 0.0).then_some((start, end)),
                ..Panel::new(
                    format!("({}) {face}: {title}", letter.next().unwrap_or_default()),
                    "time (s)",
                    axis("force", Kind::Force, units),
                    curves,
                )
            });
        }
    }
    let mut caption = "Normal force and size of the friction force at each corner, at the column and at the \
                       slope. Left is the wedge's +y side."
        .to_owned();
    if start > 0.0 {
        caption += &format!(
            " The first {start} s are cut: there the wedge is released from its start, and the normal \
             forces reach {} {}.",
            digits(converted(
                largest_normal(result, |time| time < start),
                Kind::Force,
                units
            )),
            Kind::Force.label(units)
        );
    }
    exhibit(
        name,
        "corner_forces",
        Figure::new(format!("{name}: forces at the corners"), caption, panels).in_columns(2),
    )
}

/// Returns the time from which the corners' forces are shown, s: after the release from the start, if that is
/// larger than all that follows.
fn release(result: &RunResult) -> f64 {
    const RELEASE: f64 = 0.1;
    let before = largest_normal(result, |time| time < RELEASE);
    let after = largest_normal(result, |time| time >= RELEASE);
    if after > 0.0 && before > after {
        RELEASE
    } else {
        0.0
    }
}

/// Returns the largest normal force (N) of any corner in a part of the run.
fn largest_normal(result: &RunResult, part: impl Fn(f64) -> bool) -> f64 {
    let times = result.column("time").unwrap_or_default();
    let names = FACES.iter().flat_map(|face| {
        CORNERS
            .iter()
            .map(move |corner| format!("{face}_{corner}_normal_force"))
    });
    let mut largest: f64 = 0.0;
    for name in names {
        let values = result.column(&name).unwrap_or_default();
        for (time, value) in times.iter().zip(values) {
            if part(*time) {
                largest = largest.max(*value);
            }
        }
    }
    largest
}

/// Returns the size of a corner's friction force over time.
fn friction(result: &RunResult, stem: &str) -> Vec<(f64, f64)> {
    let parts = ["x", "y", "z"].map(|axis| points(result, "time", &format!("{stem}_friction_force_{axis}")));
    let [x, y, z] = &parts;
    x.iter()
        .zip(y.iter().zip(z))
        .map(|((time, x), ((_, y), (_, z)))| (*time, (x * x + y * y + z * z).sqrt()))
        .collect()
}

fn stick_and_wear(name: &str, result: &RunResult, cycles: &[CycleShare]) -> Exhibit {
    let units = result.summary.units;
    let steps = |value: &dyn Fn(&CycleShare) -> f64| -> Vec<(f64, f64)> {
        cycles
            .iter()
            .flat_map(|cycle| [(cycle.start, value(cycle)), (cycle.end, value(cycle))])
            .collect()
    };
    let faces = [(0, "column"), (1, "slope")];
    let stick = faces.map(|(face, label)| {
        PlotCurve::new(
            label,
            distinct(face),
            steps(&|cycle| 100.0 * cycle.stick[face].unwrap_or(f64::NAN)),
        )
    });
    let wear = faces.map(|(face, label)| {
        PlotCurve::new(
            label,
            distinct(face),
            steps(&|cycle| converted(cycle.wear_power[face], Kind::Power, units)),
        )
    });
    exhibit(
        name,
        "stick_and_wear",
        Figure::new(
            format!("{name}: stick and wear, cycle by cycle"),
            "(a) Share of stick: of the output times at which corners touch, counted corner by \
                      corner, the part at which they stick. (b) Wear power: energy lost in friction at each \
                      face in a cycle, over its length in time.",
            [
                Panel::new(
                    "(a) share of stick",
                    "time (s)",
                    "share of contact (%)",
                    stick.to_vec(),
                ),
                Panel::new(
                    "(b) wear power",
                    "time (s)",
                    axis("power", Kind::Power, units),
                    wear.to_vec(),
                ),
            ],
        ),
    )
}
