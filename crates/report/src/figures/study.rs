//! The figures of a study: main effects, contour maps, the jam map.

use mechanics::quasi_static::{Direction, QuasiStaticWedge};
use quantity::Quantity;
use study::closed_form;
use study::design::Study;
use study::measures::{self, ALL, Measure};

use super::{Exhibit, axis};
use crate::contour::{self, Grid};
use crate::drawing::{Colour, Curve, Figure, Line, Mark, Panel, distinct};
use crate::overlay::words;
use crate::study_digest::{Axis, Digest, Gathered, Pair};

/// Measures whose main effects are drawn.
const EFFECTS: [&str; 9] = [
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
/// Measures whose contours are drawn.
const CONTOURS: [&str; 4] = [
    "energy_per_cycle_side_frame",
    "mean_vertical_wedge_force_up",
    "mean_vertical_wedge_force_down",
    "peak_side_frame_pitch_moment",
];
/// Pairs of parameters that are drawn.
const MOST_PAIRS: usize = 6;
const LEVELS: usize = 7;
/// Column forces over the coil's load, as the jam map has them.
const RATIOS: [f64; 8] = [0.5, 1.0, 1.5, 2.0, 3.0, 5.0, 10.0, 30.0];
const ANGLE: &str = "wedge.angle";
const FRICTIONS: [&str; 2] = ["friction.column", "friction.slope"];
const BOUNDARY_POINTS: u32 = 200;

/// All figures that the study allows.
#[must_use]
pub fn exhibits(study: &Study, digest: &Digest) -> Vec<Exhibit> {
    let mut exhibits: Vec<Exhibit> = EFFECTS
        .iter()
        .filter_map(|name| main_effects(study, digest, name))
        .collect();
    exhibits.extend(jam_map(study, digest));
    let pairs = digest.pairs.iter().take(MOST_PAIRS);
    exhibits.extend(pairs.filter_map(|pair| contours(study, digest, pair)));
    exhibits
}

fn measure(name: &str) -> Option<(usize, &'static Measure)> {
    let place = ALL.iter().position(|measure| measure.name == name)?;
    Some((place, &measures::ALL[place]))
}

/// A factor's name with its unit.
fn factor_axis(study: &Study, number: usize) -> String {
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

/// How one measure depends on each parameter, the others being averaged.
#[must_use]
pub fn main_effects(study: &Study, digest: &Digest, name: &str) -> Option<Exhibit> {
    let (place, measure) = measure(name)?;
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
        let curve = |label: &str, colour, line, points| Curve {
            label: label.to_owned(),
            colour,
            line,
            points,
        };
        let curves = vec![
            curve("least", Colour::Sky, Line::Dotted, points(|cell| cell.least)),
            curve("greatest", Colour::Orange, Line::Dashed, points(|cell| cell.most)),
            curve("mean", Colour::Blue, Line::Solid, points(Gathered::mean)),
        ];
        let marks = match (own, &middles) {
            (Axis::Values { values, .. }, None) => {
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
            x_label: factor_axis(study, number),
            y_label: axis(&words(measure.name), measure.kind, units),
            curves,
            marks,
            span: 1,
            ..Panel::default()
        }
    });
    let panels: Vec<Panel> = panels.collect();
    Some(Exhibit {
        name: format!("effects_{name}"),
        thesis: String::new(),
        figure: Figure {
            title: format!("Main effects: {}", words(name)),
            caption: format!(
                "{}: mean, least and greatest value over the runs that share a value of one parameter (or lie in one part of its range), \
                 over that parameter. All other parameters vary within each point. All runs together: {} to {}, mean {}.",
                words(name),
                super::digits(all.least * factor),
                super::digits(all.most * factor),
                super::digits(all.mean() * factor),
            ),
            columns: panels.len().min(2),
            panels,
            ..Figure::default()
        },
    })
}

/// Means over the cells of a pair, in output units.
fn heights(pair: &Pair, place: usize, factor: f64) -> Vec<f64> {
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

/// Contour lines as curves, with their heights as marks.
fn contour_curves(
    grid: &Grid<'_>,
    levels: &[f64],
    label: Option<&str>,
    line: Option<Line>,
) -> (Vec<Curve>, Vec<Mark>) {
    let (mut curves, mut marks) = (Vec::new(), Vec::new());
    for (number, level) in levels.iter().enumerate() {
        let lines = contour::lines(grid, *level);
        let Some(longest) = lines.iter().max_by_key(|line| line.len()) else {
            continue;
        };
        // Marks of neighbouring lines stand at different places.
        let middle = longest[(longest.len() - 1) * (2 + number % 3) / 6];
        marks.push(Mark {
            at: middle,
            text: super::digits(*level),
        });
        let mut points = Vec::new();
        for line in &lines {
            points.extend(line);
            points.push((f64::NAN, f64::NAN));
        }
        let (colour, own_line) = distinct(number);
        curves.push(Curve {
            label: label.unwrap_or_default().to_owned(),
            colour: if line.is_some() { Colour::Black } else { colour },
            line: line.unwrap_or(own_line),
            points,
        });
    }
    (curves, marks)
}

/// Contour maps over a pair of parameters.
fn contours(study: &Study, digest: &Digest, pair: &Pair) -> Option<Exhibit> {
    let [first, second] = pair.factors;
    let (x, y) = (digest.axes[first].middles()?, digest.axes[second].middles()?);
    if x.len() < 3 || y.len() < 3 {
        return None;
    }
    let units = study.units();
    let panels: Vec<Panel> = CONTOURS
        .iter()
        .filter_map(|name| {
            let (place, measure) = measure(name)?;
            let heights = heights(pair, place, measure.kind.from_si(units));
            let grid = Grid {
                x: &x,
                y: &y,
                heights: &heights,
            };
            let (curves, marks) = contour_curves(&grid, &contour::round_levels(&heights, LEVELS), None, None);
            (!curves.is_empty()).then(|| Panel {
                title: axis(&words(measure.name), measure.kind, units),
                x_label: factor_axis(study, first),
                y_label: factor_axis(study, second),
                x_window: Some((x[0], x[x.len() - 1])),
                curves,
                marks,
                span: 1,
                ..Panel::default()
            })
        })
        .collect();
    let names = [first, second].map(|number| study.factors[number].name());
    (!panels.is_empty()).then(|| Exhibit {
        name: format!("contours_{}_{}", file_name(names[0]), file_name(names[1])),
        thesis: String::new(),
        figure: Figure {
            title: format!("Contours over {} and {}", names[0], names[1]),
            caption: "Lines of equal value of the means over all runs with these two values (or in these two parts of the ranges), \
                      marked with it. All other parameters vary within each point."
                .to_owned(),
            columns: 2,
            panels,
            ..Figure::default()
        },
    })
}

/// The factor that varies this path.
fn factor_of(study: &Study, path: &str) -> Option<usize> {
    let mut factors = study.factors.iter();
    factors.position(|factor| factor.paths.iter().any(|own| own == path))
}

/// The column's force over the coil's load, computed and of the massless wedge, and where the latter jams.
fn jam_map(study: &Study, digest: &Digest) -> Option<Exhibit> {
    let angle = factor_of(study, ANGLE)?;
    let friction = FRICTIONS.iter().find_map(|path| factor_of(study, path))?;
    let pair = digest.pairs.iter().find(|pair| {
        let [a, b] = pair.factors;
        (a, b) == (angle, friction) || (b, a) == (angle, friction)
    })?;
    let (x, y) = (digest.axes[angle].middles()?, digest.axes[friction].middles()?);
    if x.len() < 3 || y.len() < 3 {
        return None;
    }
    let turned = pair.factors[0] == friction;
    let heights = |name: &str| -> Option<Vec<f64>> {
        let (place, _) = measure(name)?;
        let own = heights(pair, place, 1.0);
        Some(if turned {
            (0..x.len() * y.len())
                .map(|cell| own[(cell % y.len()) * x.len() + cell / y.len()])
                .collect()
        } else {
            own
        })
    };
    let unit = Quantity::new(1.0, study.factors[angle].unit()?).ok()?.to_si();
    let sides = [
        ("down", Direction::Down, "(a) while the bolster falls"),
        ("up", Direction::Up, "(b) while the bolster rises"),
    ];
    let mut panels = Vec::new();
    for (name, direction, title) in sides {
        let computed = heights(&format!("column_force_ratio_{name}"))?;
        let closed = heights(&format!("quasi_static_column_force_ratio_{name}"))?;
        let grid = |heights| Grid {
            x: &x,
            y: &y,
            heights,
        };
        let (mut curves, marks) =
            contour_curves(&grid(&computed), &RATIOS, Some("computed"), Some(Line::Solid));
        let (mut lines, _) = contour_curves(
            &grid(&closed),
            &RATIOS,
            Some("massless wedge"),
            Some(Line::Dashed),
        );
        for line in &mut lines {
            line.colour = Colour::Vermillion;
        }
        curves.append(&mut lines);
        curves.push(Curve {
            label: "massless wedge jams left of this".to_owned(),
            colour: Colour::Purple,
            line: Line::Dotted,
            points: boundary(study, friction, direction, &y)
                .into_iter()
                .map(|(at, friction)| (at / unit, friction))
                .filter(|(at, _)| (x[0]..=x[x.len() - 1]).contains(at))
                .collect(),
        });
        panels.push(Panel {
            title: title.to_owned(),
            x_label: factor_axis(study, angle),
            y_label: factor_axis(study, friction),
            x_window: Some((x[0], x[x.len() - 1])),
            curves,
            marks,
            span: 1,
            ..Panel::default()
        });
    }
    Some(Exhibit {
        name: "jam_map".to_owned(),
        thesis: String::new(),
        figure: Figure {
            title: "Jam map: the column's normal force over the coil's load".to_owned(),
            caption: "Lines of equal normal force of the column (its part along the track, mean over the branch) over the coil's force \
                      less the wedge's weight: computed (marked with the ratio), and of the massless wedge in steady sliding (eq. 5-1 with its \
                      misprint put right), at the same ratios. The massless wedge's force grows without bound towards its jam line, θ + φ = b atan μ_s + a \
                      atan μ_c; parameters that this map does not show are those of the case on this line and vary in the others. The \
                      computed wedge has elastic contacts and need not slide: it passes the line with a finite force."
                .to_owned(),
            columns: 2,
            panels,
            ..Figure::default()
        },
    })
}

/// Angle (rad) and friction at which the massless wedge of the case begins to jam.
fn boundary(study: &Study, factor: usize, direction: Direction, frictions: &[f64]) -> Vec<(f64, f64)> {
    let base: QuasiStaticWedge = closed_form::wedge(&study.base.parameters);
    let (first, last) = (frictions[0], frictions[frictions.len() - 1]);
    (0..=BOUNDARY_POINTS)
        .map(|number| first + (last - first) * f64::from(number) / f64::from(BOUNDARY_POINTS))
        .map(|friction| {
            let mut wedge = base;
            for path in &study.factors[factor].paths {
                match path.as_str() {
                    "friction.column" => wedge.column_friction = friction,
                    "friction.slope" => wedge.slope_friction = friction,
                    _ => {}
                }
            }
            // The margin grows by the angle alone.
            let margin = wedge.jam_margin(direction, wedge.branch(direction));
            (wedge.angle - margin, friction)
        })
        .collect()
}
