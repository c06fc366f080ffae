//! The number of the thesis's statements that hold, over the contact stiffness.

use drawing::{Colour, Figure, Line, Panel, PlotCurve};
use report::figures::Exhibit;

use crate::sensitivity::{Alone, Mean, Sensitivity, StiffnessPart};

/// Returns the figure; nothing without the stiffnesses that are run alone.
#[must_use]
pub fn exhibits(found: &Sensitivity) -> Vec<Exhibit> {
    let stiffness = &found.stiffness;
    if stiffness.alone.is_empty() {
        return Vec::new();
    }
    let panel = |title: &str, alone: fn(&Alone) -> usize, mean: fn(&StiffnessPart) -> Mean| {
        let steps = |shift: f64| -> Vec<(f64, f64)> {
            let parts = stiffness.parts.iter();
            let ends = parts.flat_map(|part| {
                let Mean { mean, error } = mean(part);
                let height = mean + shift * error;
                let [from, to] = part.stiffness.map(libm::log10);
                [(from, height), (to, height), (to, f64::NAN)]
            });
            ends.collect()
        };
        let curve = |label: &str, colour: Colour, line: Line, points: Vec<(f64, f64)>| PlotCurve {
            label: label.to_owned(),
            colour,
            line,
            points,
        };
        let points = stiffness.alone.iter();
        let points = points.map(|one| (libm::log10(one.stiffness), alone(one) as f64));
        Panel {
            title: title.to_owned(),
            x_label: "log10 of the contact stiffness, lbf/in a corner".to_owned(),
            y_label: "hold".to_owned(),
            curves: vec![
                curve("all else as decided", Colour::Blue, Line::Solid, points.collect()),
                curve(
                    "over all else that is open, mean",
                    Colour::Black,
                    Line::Solid,
                    steps(0.0),
                ),
                curve(
                    "mean \u{b1} 2 standard errors",
                    Colour::Grey,
                    Line::Dashed,
                    steps(-2.0),
                ),
                curve("", Colour::Grey, Line::Dashed, steps(2.0)),
            ],
            span: 1,
            ..Panel::default()
        }
    };
    vec![Exhibit::new(
        "statements_over_stiffness",
        Figure {
            title: "How many of the thesis's statements hold over the contact stiffness".to_owned(),
            caption: format!(
                "Left: all statements that runs decide. Right: the {} required statements and axes. Blue: \
                 each stiffness with all else as decided (2.5e5 lbf/in, the default, is at 5.4). Black: \
                 means over the {} points of the space whose stiffness lies in that fifth of the range.",
                stiffness.of_required, found.points
            ),
            panels: vec![
                panel("(a) all", |one| one.holds, |part| part.holds),
                panel(
                    "(b) required statements and axes",
                    |one| one.required,
                    |part| part.required,
                ),
            ],
            ..Figure::default()
        },
    )]
}
