//! The figures of a study: main effects and contour maps; [`super::jam`] has the jam map.

use study::design::Study;
use study::measures::Measure;

use super::{Exhibit, axis, jam};
use crate::overlay::words;
use crate::study_digest::{Digest, Gathered, ParameterAxis, ParameterPair};
use drawing::contour::{self, HeightGrid};
use drawing::{Colour, Figure, Line, Mark, Panel, PlotCurve, distinct};

/// Measures of wedges whose main effects are drawn; of other models the first ones are.
const EFFECTS: [&str; MOST_EFFECTS] = [
    "energy_per_cycle_side_frame",
    "equivalent_damping_on_bolster",
    "equivalent_stiffness",
    "mean_vertical_wedge_force_up",
    "mean_vertical_wedge_force_down",
    "peak_side_frame_pitch_moment",
    "lift_off_time_slope",
    "stick_share_column",
    "wear_power_column",
];
/// Measures of wedges whose contours are drawn; of other models the first ones are.
const CONTOURS: [&str; MOST_CONTOURS] = [
    "energy_per_cycle_side_frame",
    "mean_vertical_wedge_force_up",
    "mean_vertical_wedge_force_down",
    "peak_side_frame_pitch_moment",
];
/// Measures that are drawn.
const MOST_EFFECTS: usize = 9;
/// Measures of other models that are drawn: the sum over all wedges, and those of the first one.
const MOST_OTHERS: usize = 9;
/// Panels of contours.
const MOST_CONTOURS: usize = 4;
/// Pairs of parameters that are drawn.
const MOST_PAIRS: usize = 6;
const LEVELS: usize = 7;
/// Marks are kept this part of the frame away from it.
const NEAR_FRAME: f64 = 0.06;

/// Returns all figures that the study allows.
#[must_use]
pub fn exhibits(study: &Study, digest: &Digest) -> Vec<Exhibit> {
    let mut exhibits: Vec<Exhibit> = drawn(study, &EFFECTS)
        .into_iter()
        .filter_map(|name| main_effects(study, digest, name))
        .collect();
    exhibits.extend(jam::maps(study, digest));
    let pairs = digest.pairs.iter().take(MOST_PAIRS);
    exhibits.extend(pairs.filter_map(|pair| contours(study, digest, pair)));
    exhibits
}

/// Returns the names of the measures to be drawn: those of wedges, or as many of the study's first ones.
fn drawn<'s>(study: &'s Study, of_wedges: &[&'static str]) -> Vec<&'s str> {
    if study.base.wedge().is_some() {
        return of_wedges.to_vec();
    }
    let names = study.measures().iter().map(|measure| &*measure.name);
    names.take(of_wedges.len().min(MOST_OTHERS)).collect()
}

fn measure<'s>(study: &'s Study, name: &str) -> Option<(usize, &'s Measure)> {
    let place = study.measures().place(name)?;
    Some((place, &study.measures()[place]))
}

/// Returns a factor's name with its unit.
pub(super) fn factor_axis(study: &Study, number: usize) -> String {
    let factor = &study.factors[number];
    let name = factor.paths.join(", ");
    match factor.unit() {
        Some(unit) if !unit.is_empty() => format!("{name} ({unit})"),
        _ => name,
    }
}

fn file_name(text: &str) -> String {
    text.replace(['.', ' '], "_")
}

/// Returns the dependence of one metric on each parameter, the others being averaged.
#[must_use]
pub fn main_effects(study: &Study, digest: &Digest, name: &str) -> Option<Exhibit> {
    let (place, measure) = measure(study, name)?;
    let all = &digest.all[place];
    if all.count == 0 {
        return None;
    }
    let units = study.units();
    let factor = measure.kind.from_si(units);
    let panels = digest.axes.iter().enumerate().map(|(number, own)| {
        let cells = &digest.effects[number];
        let middles = own.middles();
        let abscissae: Vec<f64> = middles
            .clone()
            .unwrap_or((0..own.len()).map(|n| n as f64).collect());
        let points = |of: fn(&Gathered) -> f64| -> Vec<(f64, f64)> {
            let pairs = abscissae.iter().zip(cells);
            pairs
                .filter(|(_, cell)| cell[place].count > 0)
                .map(|(x, cell)| (*x, of(&cell[place]) * factor))
                .collect()
        };
        let curve = |label: &str, colour, line, points| PlotCurve::new(label, (colour, line), points);
        let curves = vec![
            curve("least", Colour::Sky, Line::Dotted, points(|cell| cell.least)),
            curve("greatest", Colour::Orange, Line::Dashed, points(|cell| cell.most)),
            curve("mean", Colour::Blue, Line::Solid, points(Gathered::mean)),
        ];
        let marks = match (own, &middles) {
            (ParameterAxis::Values { values, .. }, None) => {
                let low = all.least * factor;
                let names = values.iter().enumerate();
                names
                    .map(|(x, value)| Mark {
                        at: (x as f64, low),
                        text: value.shown().into_owned(),
                    })
                    .collect()
            }
            _ => Vec::new(),
        };
        Panel {
            marks,
            span: 1,
            ..Panel::new(
                "",
                factor_axis(study, number),
                axis(&words(&measure.name), measure.kind, units),
                curves,
            )
        }
    });
    let panels: Vec<Panel> = panels.collect();
    let columns = panels.len().min(2);
    Some(Exhibit::new(
        format!("effects_{name}"),
        Figure::new(
            format!("Main effects: {}", words(name)),
            format!(
                "{}: mean, least and greatest value over the runs that share a value of one \
                 parameter (or lie in one part of its range), over that parameter. All other parameters \
                 vary within each point. All runs together: {} to {}, mean {}.",
                words(name),
                super::digits(all.least * factor),
                super::digits(all.most * factor),
                super::digits(all.mean() * factor),
            ),
            panels,
        )
        .in_columns(columns),
    ))
}

/// Means over the cells of a pair, in output units.
fn heights(pair: &ParameterPair, place: usize, factor: f64) -> Vec<f64> {
    pair.cells
        .iter()
        .map(|cell| {
            if cell[place].count > 0 {
                cell[place].mean() * factor
            } else {
                f64::NAN
            }
        })
        .collect()
}

/// Contour lines as curves with their heights as marks, in the order of the levels.
pub(crate) fn contour_curves(grid: &HeightGrid<'_>, levels: &[f64]) -> Vec<(PlotCurve, Mark)> {
    let ends = |values: &[f64]| (values[0], values[values.len() - 1]);
    let (x, y) = (ends(grid.x), ends(grid.y));
    // How far a point lies from the frame, of the frame's size.
    let inside = |at: &(f64, f64)| {
        let share = |value: f64, (first, last): (f64, f64)| (value - first) / (last - first);
        let (a, b) = (share(at.0, x), share(at.1, y));
        a.min(1.0 - a).min(b).min(1.0 - b)
    };
    let mut curves = Vec::new();
    for (number, level) in levels.iter().enumerate() {
        let lines = contour::lines(grid, *level);
        let Some(longest) = lines.iter().max_by_key(|line| line.len()) else {
            continue;
        };
        // Marks of neighbouring lines stand at different places, and none on the frame.
        let mut at = longest[(longest.len() - 1) * (2 + number % 3) / 6];
        if inside(&at) < NEAR_FRAME {
            let best = longest.iter().max_by(|a, b| inside(a).total_cmp(&inside(b)));
            at = *best.unwrap_or(&at);
        }
        let margin = NEAR_FRAME * (x.1 - x.0);
        at.0 = at.0.clamp(x.0 + margin, x.1 - margin);
        let mut points = Vec::new();
        for line in &lines {
            points.extend(line);
            points.push((f64::NAN, f64::NAN));
        }
        let curve = PlotCurve::new("", distinct(number), points);
        let text = super::digits(*level);
        curves.push((curve, Mark { at, text }));
    }
    curves
}

/// Contour maps over a pair of parameters.
fn contours(study: &Study, digest: &Digest, pair: &ParameterPair) -> Option<Exhibit> {
    let [first, second] = pair.factors;
    let (x, y) = (digest.axes[first].middles()?, digest.axes[second].middles()?);
    if x.len() < 3 || y.len() < 3 {
        return None;
    }
    let units = study.units();
    let panels: Vec<Panel> = drawn(study, &CONTOURS)
        .into_iter()
        .filter_map(|name| {
            let (place, measure) = measure(study, name)?;
            let heights = heights(pair, place, measure.kind.from_si(units));
            let grid = HeightGrid {
                x: &x,
                y: &y,
                heights: &heights,
            };
            let levels = contour::round_levels(&heights, LEVELS);
            let (curves, marks): (Vec<_>, Vec<_>) = contour_curves(&grid, &levels).into_iter().unzip();
            (!curves.is_empty()).then(|| Panel {
                x_window: Some((x[0], x[x.len() - 1])),
                marks,
                span: 1,
                ..Panel::new(
                    axis(&words(&measure.name), measure.kind, units),
                    factor_axis(study, first),
                    factor_axis(study, second),
                    curves,
                )
            })
        })
        .collect();
    let names = [first, second].map(|number| study.factors[number].name());
    (!panels.is_empty()).then(|| {
        Exhibit::new(
            format!("contours_{}_{}", file_name(names[0]), file_name(names[1])),
            Figure::new(
                format!("Contours over {} and {}", names[0], names[1]),
                "Lines of equal value of the means over all runs with these two values (or in these \
                      two parts of the ranges), marked with it. All other parameters vary within each point.",
                panels,
            )
            .in_columns(2),
        )
    })
}
