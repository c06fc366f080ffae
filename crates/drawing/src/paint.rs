//! Figures drawn with the library kuva.

use std::sync::Arc;

use kuva::backend::raster::RasterBackend;
use kuva::plot::LinePlot;
use kuva::plot::line::LineStyle;
use kuva::prelude::{Layout, Plot, SvgBackend, TickFormat};
use kuva::render::annotations::{ReferenceLine, TextAnnotation};
use kuva::render::figure::Figure as Sheet;
use kuva::render::render::{Primitive, Scene, TextAnchor};

use super::scale::Scale;
use super::{Figure, Line, Panel, PlotCurve};
use crate::thin::{thin, window};

/// Width of a figure of one row, and of a single panel, pixels.
pub(super) const SHEET_WIDTH: f64 = 960.0;
const PANEL_WIDTH: f64 = 720.0;
const PANEL_HEIGHT: f64 = 380.0;
/// Height of a row with names as ordinates.
const NAME_HEIGHT: f64 = 24.0;
pub(super) const TITLE_SIZE: u32 = 17;
pub(super) const TEXT_SIZE: u32 = 13;
const STROKE: f64 = 1.4;
const BAR: f64 = 9.0;
const LEGEND_HEIGHT: f64 = 24.0;
/// Length of a line in the legend, long enough to show its dashes.
const LEGEND_LINE: f64 = 40.0;
/// Pixels of a picture for each unit of the drawing.
const PICTURE_SCALE: f32 = 1.5;
/// The prefix of the names of clip paths.
pub(super) const CLIP: &str = "clip-";
pub(super) const FONT: &str = "Helvetica, Arial, 'Liberation Sans', 'DejaVu Sans', sans-serif";

impl Line {
    /// Lengths of dashes and gaps by turns, as SVG writes them; none for a solid line.
    #[must_use]
    pub fn dashes(self) -> Option<&'static str> {
        match self {
            Self::Solid | Self::Bar => None,
            Self::Dashed => Some("9 4"),
            Self::DashDot => Some("10 3 2 3"),
            Self::Dotted => Some("2 3"),
        }
    }

    /// Returns its width in pixels.
    #[must_use]
    pub fn width(self) -> f64 {
        if self == Self::Bar { BAR } else { STROKE }
    }
}

/// Returns a drawing as an SVG document.
pub(super) fn svg(scene: &Scene) -> String {
    renumbered(&SvgBackend::new().render_scene(scene))
}

/// Renumbers clip paths. The library counts them through all drawings of a program; here they are counted in
/// each drawing, so that the same figure gives the same text.
fn renumbered(svg: &str) -> String {
    const THEIRS: &str = "kuva-clip-";
    let mut numbers: Vec<&str> = Vec::new();
    let mut out = String::with_capacity(svg.len());
    let mut pieces = svg.split(THEIRS);
    out.push_str(pieces.next().unwrap_or_default());
    for piece in pieces {
        let length = piece.bytes().take_while(u8::is_ascii_digit).count();
        let (number, rest) = piece.split_at(length);
        let place = numbers.iter().position(|own| *own == number).unwrap_or_else(|| {
            numbers.push(number);
            numbers.len() - 1
        });
        out.push_str(&format!("{CLIP}{}{rest}", place + 1));
    }
    out
}

/// Returns a drawing as a PNG picture.
pub(super) fn png(mut scene: Scene) -> Result<Vec<u8>, String> {
    // The picture's painter begins a new dash at each point of a curve, which makes dashed curves solid.
    let elements = std::mem::take(&mut scene.elements);
    for element in elements {
        match element {
            Primitive::PolyLine {
                points,
                stroke,
                stroke_width,
                stroke_dasharray: Some(pattern),
            } => {
                let lengths: Vec<f64> = pattern.split(' ').filter_map(|text| text.parse().ok()).collect();
                let pieces = dashed(&points, &lengths);
                scene
                    .elements
                    .extend(pieces.into_iter().map(|points| Primitive::PolyLine {
                        points,
                        stroke: stroke.clone(),
                        stroke_width,
                        stroke_dasharray: None,
                    }));
            }
            // Its broad lines have round ends, which bars must not have.
            Primitive::PolyLine {
                points,
                stroke,
                stroke_width,
                ..
            } if stroke_width == BAR => {
                for pair in points.windows(2) {
                    scene.elements.push(Primitive::Rect {
                        x: pair[0].0.min(pair[1].0),
                        y: pair[0].1.min(pair[1].1) - 0.5 * BAR,
                        width: (pair[1].0 - pair[0].0).abs(),
                        height: (pair[1].1 - pair[0].1).abs() + BAR,
                        fill: stroke.clone(),
                        stroke: None,
                        stroke_width: None,
                        opacity: None,
                    });
                }
            }
            other => scene.elements.push(other),
        }
    }
    RasterBackend::new()
        .with_scale(PICTURE_SCALE)
        .render_scene(&scene)
}

/// Returns the drawn pieces of a dashed line: `pattern` holds the lengths of dashes and gaps by turns.
fn dashed(points: &[(f64, f64)], pattern: &[f64]) -> Vec<Vec<(f64, f64)>> {
    if pattern.is_empty() || pattern.iter().any(|length| *length <= 0.0) {
        return vec![points.to_vec()];
    }
    let mut pieces = Vec::new();
    let mut piece: Vec<(f64, f64)> = points.first().copied().into_iter().collect();
    let (mut number, mut left) = (0, pattern[0]);
    for pair in points.windows(2) {
        let ((x0, y0), (x1, y1)) = (pair[0], pair[1]);
        let length = ((x1 - x0).powi(2) + (y1 - y0).powi(2)).sqrt();
        let mut done = 0.0;
        while length - done > left {
            done += left;
            let share = done / length;
            let at = (x0 + share * (x1 - x0), y0 + share * (y1 - y0));
            if number % 2 == 0 {
                piece.push(at);
                pieces.push(std::mem::take(&mut piece));
            } else {
                piece = vec![at];
            }
            number = (number + 1) % (2 * pattern.len());
            left = pattern[number % pattern.len()];
        }
        left -= length - done;
        if number % 2 == 0 {
            piece.push((x1, y1));
        }
    }
    if piece.len() > 1 {
        pieces.push(piece);
    }
    pieces
}

/// Returns the whole drawing.
pub(super) fn scene(figure: &Figure) -> Scene {
    if let Some(flow) = &figure.flow {
        return flow.scene(&figure.title);
    }
    let (places, rows, columns) = figure.grid();
    let cell_width = if columns == 1 {
        PANEL_WIDTH
    } else {
        (SHEET_WIDTH / columns as f64).max(430.0)
    };
    let common = figure.common_axes.then(|| {
        (
            x_scale(&figure.panels.iter().collect::<Vec<_>>()),
            y_scale(&figure.panels.iter().collect::<Vec<_>>()),
        )
    });
    let mut plots = Vec::new();
    let mut layouts = Vec::new();
    for (panel, (_, _, span)) in figure.panels.iter().zip(&places) {
        let (x, y) = common.unwrap_or_else(|| (x_scale(&[panel]), y_scale(&[panel])));
        let pixels = (2.0 * cell_width * *span as f64) as u32;
        plots.push(panel_plots(panel, (x.low, x.high), pixels));
        layouts.push(panel_layout(panel, x, y));
    }
    let structure = places
        .iter()
        .map(|(row, cell, span)| (*cell..cell + span).map(|cell| row * columns + cell).collect())
        .collect();
    let mut sheet = Sheet::new(rows, columns)
        .with_structure(structure)
        .with_plots(plots)
        .with_layouts(layouts)
        .with_title(figure.title.as_str())
        .with_title_size(title_size(&figure.title, cell_width * columns as f64))
        .with_cell_size(cell_width, PANEL_HEIGHT);
    for (panel, (row, _, _)) in figure.panels.iter().zip(&places) {
        if !panel.y_names.is_empty() {
            sheet = sheet.with_row_height(*row, 110.0 + NAME_HEIGHT * panel.y_names.len() as f64);
        }
    }
    let mut scene = sheet.render();
    for element in &mut scene.elements {
        if let Primitive::PolyLine { points, .. } = element {
            straighten(points);
        }
    }
    add_legend(&mut scene, &figure.legend());
    scene
}

/// Returns the size at which a title fits into a width, pixels.
pub(super) fn title_size(title: &str, width: f64) -> u32 {
    let letters = title.chars().count().max(1) as f64;
    ((width / (0.56 * letters)) as u32).clamp(11, TITLE_SIZE)
}

/// Rounds a drawn line to a tenth of a pixel and leaves out what then lies on a straight line between its
/// neighbours.
fn straighten(points: &mut Vec<(f64, f64)>) {
    let round = |value: f64| (10.0 * value).round() as i64;
    let mut kept: Vec<(i64, i64)> = Vec::with_capacity(points.len());
    for point in points.iter() {
        let next = (round(point.0), round(point.1));
        if kept.last() == Some(&next) {
            continue;
        }
        if let [.., a, b] = kept.as_slice() {
            let (u, v) = ((b.0 - a.0, b.1 - a.1), (next.0 - b.0, next.1 - b.1));
            if u.0 * v.1 == u.1 * v.0 && u.0 * v.0 + u.1 * v.1 > 0 {
                kept.pop();
            }
        }
        kept.push(next);
    }
    *points = kept
        .into_iter()
        .map(|(x, y)| (x as f64 / 10.0, y as f64 / 10.0))
        .collect();
}

fn x_scale(panels: &[&Panel]) -> Scale {
    if let Some(window) = panels.iter().find_map(|panel| panel.x_window) {
        return Scale::exactly(window);
    }
    let curves = panels.iter().flat_map(|panel| &panel.curves);
    Scale::around(curves.flat_map(|curve| &curve.points).map(|point| point.0))
}

fn y_scale(panels: &[&Panel]) -> Scale {
    let names = panels.iter().map(|panel| panel.y_names.len()).max();
    if let Some(count) = names.filter(|count| *count > 0) {
        return Scale::of_names(count);
    }
    let visible = panels.iter().flat_map(|panel| {
        let (left, right) = panel.x_window.unwrap_or((f64::NEG_INFINITY, f64::INFINITY));
        let points = panel.curves.iter().flat_map(|curve| &curve.points);
        points
            .filter(move |point| point.0 >= left && point.0 <= right)
            .map(|point| point.1)
    });
    Scale::around(visible)
}

/// Returns the panel's curves, cut to its window, thinned, and split where they are interrupted.
fn panel_plots(panel: &Panel, range: (f64, f64), columns: u32) -> Vec<Plot> {
    let mut plots = Vec::new();
    for curve in &panel.curves {
        let points = match panel.x_window {
            Some(_) => thin(&window(&curve.points, range), columns),
            None => thin(&curve.points, columns),
        };
        for piece in points.split(|(x, y)| !x.is_finite() || !y.is_finite()) {
            if piece.len() < 2 {
                continue;
            }
            let mut line = LinePlot::new()
                .with_data(piece.to_vec())
                .with_color(curve.colour.hex())
                .with_stroke_width(curve.line.width());
            if let Some(dashes) = curve.line.dashes() {
                line.line_style = LineStyle::Custom(dashes.to_owned());
            }
            plots.push(line.into());
        }
    }
    plots
}

fn panel_layout(panel: &Panel, x: Scale, y: Scale) -> Layout {
    let y_format = if panel.y_names.is_empty() {
        y.format()
    } else {
        let names = panel.y_names.clone();
        TickFormat::Custom(Arc::new(move |value| {
            let whole = value.round();
            let name = (whole >= 0.0 && (value - whole).abs() < 1e-6)
                .then(|| names.get(whole as usize))
                .flatten();
            name.cloned().unwrap_or_default()
        }))
    };
    let mut layout = Layout::new((x.low, x.high), (y.low, y.high))
        .with_x_axis_min(x.low)
        .with_x_axis_max(x.high)
        .with_x_tick_step(x.step)
        .with_y_axis_min(y.low)
        .with_y_axis_max(y.high)
        .with_y_tick_step(y.step)
        .with_x_tick_format(x.format())
        .with_y_tick_format(y_format)
        .with_title_size(TEXT_SIZE + 1)
        .with_x_label(panel.x_label.as_str())
        .with_y_label(panel.y_label.as_str())
        .with_font_family(FONT)
        .with_box_axes();
    if !panel.title.is_empty() {
        layout = layout.with_title(panel.title.as_str());
    }
    layout.theme.grid_color = "#e4e4e4".to_owned();
    if panel.y_names.is_empty() && y.low < 0.0 && y.high > 0.0 {
        let zero = ReferenceLine::horizontal(0.0)
            .with_color("#8c8c8c")
            .with_stroke_width(0.8);
        layout = layout.with_reference_line(zero);
    }
    for mark in &panel.marks {
        let text = TextAnnotation::new(mark.text.as_str(), mark.at.0, mark.at.1).with_font_size(TEXT_SIZE);
        layout = layout.with_annotation(text);
    }
    layout
}

/// Rows of lines and names below the panels, where no data are.
fn add_legend(scene: &mut Scene, entries: &[&PlotCurve]) {
    let (gap, between) = (8.0, 36.0);
    let width = |curve: &PlotCurve| {
        let letters = 0.55 * f64::from(TEXT_SIZE) * curve.label.chars().count() as f64;
        LEGEND_LINE + gap + letters
    };
    let mut rows: Vec<(Vec<&PlotCurve>, f64)> = Vec::new();
    for entry in entries {
        let own = width(entry) + between;
        match rows.last_mut() {
            Some((row, total)) if *total + own <= scene.width => {
                row.push(entry);
                *total += own;
            }
            _ => rows.push((vec![entry], own)),
        }
    }
    for (row, total) in rows {
        let mut x = 0.5 * (scene.width - total + between);
        let y = scene.height + 0.3 * LEGEND_HEIGHT;
        scene.height += LEGEND_HEIGHT;
        for curve in row {
            scene.elements.push(if curve.line == Line::Bar {
                Primitive::Rect {
                    x,
                    y: y - 0.5 * BAR,
                    width: LEGEND_LINE,
                    height: BAR,
                    fill: curve.colour.hex().into(),
                    stroke: None,
                    stroke_width: None,
                    opacity: None,
                }
            } else {
                Primitive::Line {
                    x1: x,
                    y1: y,
                    x2: x + LEGEND_LINE,
                    y2: y,
                    stroke: curve.colour.hex().into(),
                    stroke_width: 1.2 * curve.line.width(),
                    stroke_dasharray: curve.line.dashes().map(str::to_owned),
                }
            });
            scene.elements.push(Primitive::Text {
                x: x + LEGEND_LINE + gap,
                y: y + 0.35 * f64::from(TEXT_SIZE),
                content: curve.label.clone(),
                size: TEXT_SIZE,
                anchor: TextAnchor::Start,
                rotate: None,
                bold: false,
                color: None,
            });
            x += width(curve) + between;
        }
    }
    scene.height += 0.4 * LEGEND_HEIGHT;
}

#[cfg(test)]
mod tests {
    use super::{dashed, straighten};

    #[test]
    fn straight_pieces_need_two_points() {
        let mut line: Vec<(f64, f64)> = (0..100).map(|i| (f64::from(i), 2.0)).collect();
        line.extend([(99.0, 2.04), (99.0, 7.0), (99.0, 1.0)]);
        straighten(&mut line);
        assert_eq!(line, [(0.0, 2.0), (99.0, 2.0), (99.0, 7.0), (99.0, 1.0)]);
    }

    #[test]
    fn dashes_go_on_across_points() {
        let pieces = dashed(&[(0.0, 0.0), (1.0, 0.0), (2.0, 0.0), (10.0, 0.0)], &[3.0, 2.0]);
        let ends: Vec<(f64, f64)> = pieces
            .iter()
            .map(|piece| (piece[0].0, piece[piece.len() - 1].0))
            .collect();
        assert_eq!(ends, [(0.0, 3.0), (5.0, 8.0)]);
        assert_eq!(dashed(&[(0.0, 0.0), (1.0, 0.0)], &[]).len(), 1);
    }
}
