//! Work-precision figures: time over error, one panel a case, one curve a solver.

use drawing::{Colour, Figure, Line, Panel, PlotCurve};

use crate::contest::{IN_OCTAVE, RECORDED, SOLVERS};
use crate::problem::is_yawed;
use crate::standings::Standing;

/// Colour and line of a solver: ours black, families share a colour.
fn look(name: &str) -> (Colour, Line) {
    match name {
        "wedgelab Rodas5P" => (Colour::Black, Line::Solid),
        "wedgelab TR-BDF2" => (Colour::Black, Line::Dotted),
        "wedgelab ESDIRK3" => (Colour::Black, Line::DashDot),
        "CVODE BDF" => (Colour::Vermillion, Line::Solid),
        "diffsol BDF" => (Colour::Blue, Line::Solid),
        "diffsol TR-BDF2" => (Colour::Blue, Line::Dashed),
        "diffsol ESDIRK34" => (Colour::Blue, Line::Dotted),
        "SciPy LSODA" => (Colour::Green, Line::Solid),
        "SciPy BDF" => (Colour::Green, Line::Dashed),
        "SciPy Radau" => (Colour::Green, Line::Dotted),
        "Octave ode15s" => (Colour::Purple, Line::Solid),
        IN_OCTAVE => (Colour::Purple, Line::Dashed),
        _ => (Colour::Orange, Line::DashDot),
    }
}

fn panel(one: &Standing) -> Panel {
    // With modes recorded it would run beside its own curve.
    let drawn = SOLVERS.iter().filter(|solver| solver.name != RECORDED);
    let curves = drawn.filter_map(|solver| {
        // In the order of the tolerances.
        let points: Vec<(f64, f64)> = one
            .runs
            .iter()
            .filter(|run| run.entry.solver == solver.name && run.finished())
            .filter_map(|run| {
                let error = run.error?.max(one.floor);
                (error > 0.0 && error < 1.0).then(|| (error.log10(), run.entry.outcome.cpu.log10()))
            })
            .collect();
        let (colour, line) = look(solver.name);
        (!points.is_empty()).then(|| PlotCurve {
            label: solver.name.to_owned(),
            colour,
            line,
            points,
        })
    });
    Panel {
        title: one.case.clone(),
        x_label: "error, power of ten".to_owned(),
        y_label: "CPU time, power of ten of a second".to_owned(),
        curves: curves.collect(),
        ..Panel::default()
    }
}

/// Returns the figures by name: yawed and unyawed thesis cases, the others, and the short spans.
#[must_use]
pub fn figures(standings: &[Standing]) -> Vec<(&'static str, Figure)> {
    let full = standings.iter().map(|one| one.span).fold(0.0, f64::max);
    let thesis = |one: &Standing| one.case.contains("psi");
    let yawed = |one: &Standing| is_yawed(&one.case);
    type Group<'g> = (&'static str, &'static str, &'g dyn Fn(&Standing) -> bool);
    let groups: [Group<'_>; 4] = [
        (
            "race_yawed",
            "Yawed cases: error of the forces' time series",
            &|one| one.span == full && yawed(one),
        ),
        (
            "race_ringing",
            "Cases without yaw: error of branch means and energy per cycle",
            &|one| one.span == full && thesis(one) && !yawed(one),
        ),
        ("race_others", "Planar wedge and stick test", &|one| {
            one.span == full && !thesis(one)
        }),
        ("race_short", "The first second, with Octave's ode15s", &|one| {
            one.span < full
        }),
    ];
    let mut figures = Vec::new();
    for (name, title, takes) in groups {
        // Where there is no force at all, there is no error to draw.
        let drawn = |panel: &Panel| !panel.curves.is_empty();
        let panels = standings.iter().filter(|one| takes(one)).map(panel);
        let panels: Vec<Panel> = panels.filter(drawn).collect();
        if panels.is_empty() {
            continue;
        }
        let figure = Figure {
            title: title.to_owned(),
            caption: format!(
                "{title}. CPU time over error, both as powers of ten; lower and further left is better. A \
                 curve ends on the left where its solver becomes no more exact, or where the reference is \
                 not known better."
            ),
            columns: panels.len().min(3),
            panels,
            ..Figure::default()
        };
        figures.push((name, figure));
    }
    figures
}
