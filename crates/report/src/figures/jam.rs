//! The jam map of a study: the column's force over angle and friction, computed and of the massless wedge.

use mechanics::quasi_static::{QuasiStaticWedge, SlidingDirection};
use quantity::Quantity;
use study::closed_form;
use study::design::Study;

use super::study::{contour_curves, factor_axis};
use super::{Exhibit, digits};
use crate::study_digest::{Digest, Jam, JamCells};
use drawing::contour::HeightGrid;
use drawing::{Colour, Figure, Line, Mark, Panel, PlotCurve};

/// Column forces over the coil's load.
const RATIOS: [f64; 8] = [0.5, 1.0, 1.5, 2.0, 3.0, 5.0, 10.0, 30.0];
/// Points of the closed form along each axis.
const POINTS: usize = 161;

/// Returns a map for runs with toe in, and one for those with toe out or none, as far as there are any: the
/// toe decides which way the slope's friction acts, and with it whether the wedge can jam.
#[must_use]
pub fn maps(study: &Study, digest: &Digest) -> Vec<Exhibit> {
    let Some(jam) = &digest.jam else {
        return Vec::new();
    };
    let cells = jam.cells.iter().filter(|cells| cells.toe.count > 0);
    cells.filter_map(|cells| map(study, digest, jam, cells)).collect()
}

fn map(study: &Study, digest: &Digest, jam: &Jam, cells: &JamCells) -> Option<Exhibit> {
    let [angle, friction] = jam.factors;
    let (x, y) = (digest.axes[angle].middles()?, digest.axes[friction].middles()?);
    let unit = Quantity::new(1.0, study.factors[angle].unit()?).ok()?.to_si();
    let mut base = closed_form::wedge(&study.base.wedge()?.parameters);
    base.toe = cells.toe.mean();
    let with = |angle: f64, value: f64| {
        let mut wedge = base;
        wedge.angle = angle * unit;
        for path in &study.factors[friction].paths {
            match path.as_str() {
                "friction.column" => wedge.column_friction = value,
                "friction.slope" => wedge.slope_friction = value,
                _ => {}
            }
        }
        wedge
    };
    let sides = [
        (0, SlidingDirection::Down, "(a) while the bolster falls"),
        (1, SlidingDirection::Up, "(b) while the bolster rises"),
    ];
    let panels = sides.map(|(side, direction, title)| {
        let computed: Vec<f64> = cells.ratios.iter().map(|cell| cell[side].mean()).collect();
        let computed = contours(&x, &y, &computed);
        let (fine_x, fine_y) = (between(&x), between(&y));
        let heights: Vec<f64> = fine_x
            .iter()
            .flat_map(|angle| fine_y.iter().map(|value| ratio(&with(*angle, *value), direction)))
            .collect();
        let closed = contours(&fine_x, &fine_y, &heights);
        let (mut curves, mut marks) = (Vec::new(), Vec::new());
        for (curve, mark) in computed {
            curves.push(PlotCurve {
                label: "computed".to_owned(),
                colour: Colour::Black,
                line: Line::Solid,
                ..curve
            });
            marks.push(mark);
        }
        for (curve, mark) in closed {
            curves.push(PlotCurve {
                label: "massless wedge".to_owned(),
                colour: Colour::Vermillion,
                line: Line::Dashed,
                ..curve
            });
            marks.push(Mark {
                text: format!("({})", mark.text),
                ..mark
            });
        }
        let boundary: Vec<(f64, f64)> = fine_y
            .iter()
            .map(|value| {
                let wedge = with(0.0, *value);
                // The margin grows by the angle alone.
                let margin = wedge.jam_margin(direction, wedge.branch(direction));
                (-margin / unit, *value)
            })
            .filter(|(at, _)| (x[0]..=x[x.len() - 1]).contains(at))
            .collect();
        if !boundary.is_empty() {
            curves.push(PlotCurve::new(
                "massless wedge jams left of this",
                (Colour::Purple, Line::Dotted),
                boundary,
            ));
        }
        Panel {
            x_window: Some((x[0], x[x.len() - 1])),
            marks,
            span: 1,
            ..Panel::new(
                title,
                factor_axis(study, angle),
                factor_axis(study, friction),
                curves,
            )
        }
    });
    let (name, toe) = match cells.toe_in {
        true => ("in", -base.toe.to_degrees()),
        false => ("out", base.toe.to_degrees()),
    };
    let among = match cells.toe.most - cells.toe.least > 1e-12 {
        true => ", on average",
        false => "",
    };
    Some(Exhibit::new(
        format!("jam_map_toe_{name}"),
        Figure::new(
            format!("Jam map, toe {name}: the column's normal force over the coil's load"),
            format!(
                "{} runs with toe {name} ({} deg{among}). Lines of equal normal force of the column (its \
                 part along the track, mean over the branch) over the coil's force less the wedge's weight: \
                 computed (marked with the ratio), and of the massless wedge in steady sliding (eq. 5-1 \
                 with its misprint put right; ratios in brackets). Parameters that this map does not show \
                 vary in the computed lines and are the case's in the massless wedge's. {}",
                cells.toe.count,
                digits(toe),
                match cells.toe_in {
                    true =>
                        "The massless wedge's force grows without bound towards its jam line, θ + φ = b \
                         atan μ_s + a atan μ_c. The computed wedge has elastic contacts and need not slide: \
                         it passes the line with a finite force.",
                    false =>
                        "With toe out the frictions of the two faces act against each other, \
                         θ + φ = b atan μ_s + a atan μ_c with b = -a, so that a wedge jams only at \
                         small angles or with very different frictions.",
                }
            ),
            panels,
        )
        .in_columns(2),
    ))
}

fn contours(x: &[f64], y: &[f64], heights: &[f64]) -> Vec<(PlotCurve, Mark)> {
    contour_curves(&HeightGrid { x, y, heights }, &RATIOS)
}

/// Points evenly from the first to the last.
fn between(values: &[f64]) -> Vec<f64> {
    let (first, last) = (values[0], values[values.len() - 1]);
    let share = |number: usize| number as f64 / (POINTS - 1) as f64;
    (0..POINTS)
        .map(|number| first + (last - first) * share(number))
        .collect()
}

/// Returns the column's normal force along the track over the load; `NaN` where the wedge jams.
fn ratio(wedge: &QuasiStaticWedge, direction: SlidingDirection) -> f64 {
    let slide = wedge.slide(direction, wedge.branch(direction), 1.0);
    slide.map_or(f64::NAN, |slide| slide.column_normal * libm::cos(wedge.toe))
}
