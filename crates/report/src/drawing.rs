//! The drawing layer: what figures are made of, and how they become SVG.
//!
//! Figures are described without reference to a drawing library: panels, axes, curves. Only this module knows the
//! library that draws them, so that it can be changed, and other formats added, in one place.

use std::sync::Arc;

use kuva::plot::LinePlot;
use kuva::plot::line::LineStyle;
use kuva::prelude::{Layout, Plot, SvgBackend, TickFormat};
use kuva::render::annotations::ReferenceLine;
use kuva::render::figure::Figure as Sheet;
use kuva::render::render::{Primitive, Scene, TextAnchor};

use crate::thin::thin;

/// Width of a panel's cell and of a figure, pixels.
const PANEL_WIDTH: f64 = 470.0;
const PANEL_HEIGHT: f64 = 400.0;
/// Curves are thinned to this many columns a panel.
const COLUMNS: u32 = 2 * PANEL_WIDTH as u32;
const TICKS: f64 = 6.0;
const TITLE_SIZE: u32 = 17;
const TEXT_SIZE: u32 = 13;
const STROKE: f64 = 1.4;
const LEGEND_HEIGHT: f64 = 34.0;
/// Length of a line in the legend, long enough to show its dashes.
const LEGEND_LINE: f64 = 40.0;
const FONT: &str = "Helvetica, Arial, 'Liberation Sans', 'DejaVu Sans', sans-serif";

/// Colours that people with any kind of colour vision can tell apart (Okabe and Ito, 2008).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Colour {
    /// Black.
    Black,
    /// Blue.
    Blue,
    /// Vermillion.
    Vermillion,
    /// Bluish green.
    Green,
    /// Orange.
    Orange,
    /// Sky blue.
    Sky,
    /// Reddish purple.
    Purple,
}

impl Colour {
    /// As SVG writes it.
    #[must_use]
    pub fn hex(self) -> &'static str {
        match self {
            Self::Black => "#000000",
            Self::Blue => "#0072B2",
            Self::Vermillion => "#D55E00",
            Self::Green => "#009E73",
            Self::Orange => "#E69F00",
            Self::Sky => "#56B4E9",
            Self::Purple => "#CC79A7",
        }
    }
}

/// Styles of lines, so that figures can be read without colour too.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Line {
    /// Solid.
    Solid,
    /// Dashed.
    Dashed,
    /// Dashes and dots.
    DashDot,
    /// Dotted.
    Dotted,
}

impl Line {
    fn dashes(self) -> Option<&'static str> {
        match self {
            Self::Solid => None,
            Self::Dashed => Some("9 4"),
            Self::DashDot => Some("10 3 2 3"),
            Self::Dotted => Some("2 3"),
        }
    }
}

/// A curve.
#[derive(Clone, Debug, PartialEq)]
pub struct Curve {
    /// Its name in the legend; curves of the same name in several panels share one entry.
    pub label: String,
    /// Its colour.
    pub colour: Colour,
    /// Its line.
    pub line: Line,
    /// Its points, in the units of the axes.
    pub points: Vec<(f64, f64)>,
}

/// Axes with curves.
#[derive(Clone, Debug, PartialEq)]
pub struct Panel {
    /// Its title.
    pub title: String,
    /// Name and unit of the abscissa.
    pub x_label: String,
    /// Name and unit of the ordinate.
    pub y_label: String,
    /// Its curves, the first one lowest.
    pub curves: Vec<Curve>,
}

/// Panels beside each other, with common axis ranges and a common legend.
#[derive(Clone, Debug, PartialEq)]
pub struct Figure {
    /// Its title.
    pub title: String,
    /// What it shows, in full sentences; it goes into the file as its description.
    pub caption: String,
    /// Its panels, from left to right.
    pub panels: Vec<Panel>,
}

impl Figure {
    /// The figure as an SVG document.
    #[must_use]
    pub fn to_svg(&self) -> String {
        let mut scene = self.sheet().render();
        self.add_legend(&mut scene);
        let svg = SvgBackend::new().render_scene(&scene);
        describe(&svg, &self.title, &self.caption)
    }

    fn sheet(&self) -> Sheet {
        let [x, y] = [|p: &(f64, f64)| p.0, |p: &(f64, f64)| p.1].map(|of| {
            let points = self
                .panels
                .iter()
                .flat_map(|panel| &panel.curves)
                .flat_map(|curve| &curve.points);
            Scale::around(points.map(of))
        });
        let plots = self.panels.iter().map(Panel::plots).collect();
        let layouts = self.panels.iter().map(|panel| panel.layout(x, y)).collect();
        Sheet::new(1, self.panels.len().max(1))
            .with_plots(plots)
            .with_layouts(layouts)
            .with_title(self.title.as_str())
            .with_title_size(TITLE_SIZE)
            .with_cell_size(PANEL_WIDTH, PANEL_HEIGHT)
    }

    /// One row of lines and names below the panels, where no data are.
    fn add_legend(&self, scene: &mut Scene) {
        let mut entries: Vec<&Curve> = Vec::new();
        for curve in self.panels.iter().flat_map(|panel| &panel.curves) {
            if entries.iter().all(|entry| entry.label != curve.label) {
                entries.push(curve);
            }
        }
        let letters = |curve: &Curve| 0.55 * f64::from(TEXT_SIZE) * curve.label.chars().count() as f64;
        let (gap, between) = (8.0, 36.0);
        let width: f64 = entries
            .iter()
            .map(|curve| LEGEND_LINE + gap + letters(curve))
            .sum();
        let mut x = 0.5 * (scene.width - width - between * entries.len().saturating_sub(1) as f64);
        let y = scene.height + 0.3 * LEGEND_HEIGHT;
        scene.height += LEGEND_HEIGHT;
        for curve in entries {
            scene.elements.push(Primitive::Line {
                x1: x,
                y1: y,
                x2: x + LEGEND_LINE,
                y2: y,
                stroke: curve.colour.hex().into(),
                stroke_width: 1.5 * STROKE,
                stroke_dasharray: curve.line.dashes().map(str::to_owned),
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
            x += LEGEND_LINE + gap + letters(curve) + between;
        }
    }
}

impl Panel {
    fn plots(&self) -> Vec<Plot> {
        self.curves
            .iter()
            .map(|curve| {
                let mut line = LinePlot::new()
                    .with_data(thin(&curve.points, COLUMNS))
                    .with_color(curve.colour.hex())
                    .with_stroke_width(STROKE);
                if let Some(dashes) = curve.line.dashes() {
                    line.line_style = LineStyle::Custom(dashes.to_owned());
                }
                line.into()
            })
            .collect()
    }

    fn layout(&self, x: Scale, y: Scale) -> Layout {
        let mut layout = Layout::new((x.low, x.high), (y.low, y.high))
            .with_x_axis_min(x.low)
            .with_x_axis_max(x.high)
            .with_x_tick_step(x.step)
            .with_y_axis_min(y.low)
            .with_y_axis_max(y.high)
            .with_y_tick_step(y.step)
            .with_x_tick_format(x.format())
            .with_y_tick_format(y.format())
            .with_title(self.title.as_str())
            .with_title_size(TEXT_SIZE + 1)
            .with_x_label(self.x_label.as_str())
            .with_y_label(self.y_label.as_str())
            .with_font_family(FONT)
            .with_box_axes();
        layout.theme.grid_color = "#e4e4e4".to_owned();
        if y.low < 0.0 && y.high > 0.0 {
            let zero = ReferenceLine::horizontal(0.0)
                .with_color("#8c8c8c")
                .with_stroke_width(0.8);
            layout = layout.with_reference_line(zero);
        }
        layout
    }
}

/// The range of an axis and the distance of its ticks, which stand at round numbers.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Scale {
    low: f64,
    high: f64,
    step: f64,
}

impl Scale {
    /// The range that holds these values with a little air.
    fn around(values: impl Iterator<Item = f64>) -> Self {
        let (low, high) = values
            .filter(|value| value.is_finite())
            .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), value| {
                (low.min(value), high.max(value))
            });
        let (mut low, mut high) = if low <= high { (low, high) } else { (0.0, 1.0) };
        if low == high {
            let half = if low == 0.0 { 1.0 } else { 0.5 * low.abs() };
            (low, high) = (low - half, high + half);
        }
        let air = 0.05 * (high - low);
        Self {
            low: low - air,
            high: high + air,
            step: round_step((high - low) / TICKS),
        }
    }

    /// As many decimals as the step needs, with a true minus sign.
    fn format(&self) -> TickFormat {
        let most = self.low.abs().max(self.high.abs());
        if !(1e-3..1e6).contains(&most) {
            return TickFormat::Sci;
        }
        let mut decimals = 0;
        let mut step = self.step;
        while (step - step.round()).abs() > 1e-6 * step && decimals < 9 {
            step *= 10.0;
            decimals += 1;
        }
        TickFormat::Custom(Arc::new(move |value| {
            format!("{value:.decimals$}").replace('-', "\u{2212}")
        }))
    }
}

/// The smallest of 1, 2, 2.5, 5 times a power of ten that is not below `least`.
fn round_step(least: f64) -> f64 {
    let power = 10f64.powf(least.log10().floor());
    [1.0, 2.0, 2.5, 5.0, 10.0]
        .into_iter()
        .map(|factor| factor * power)
        .find(|step| *step >= least * (1.0 - 1e-9))
        .unwrap_or(10.0 * power)
}

/// Puts title and description, which readers of screens tell, behind the first tag.
fn describe(svg: &str, title: &str, caption: &str) -> String {
    let escape = |text: &str| {
        text.replace('&', "&amp;")
            .replace('<', "&lt;")
            .replace('>', "&gt;")
    };
    match svg.find('>') {
        Some(end) => {
            let (tag, rest) = svg.split_at(end + 1);
            format!(
                "{tag}\n<title>{}</title>\n<desc>{}</desc>\n{rest}\n",
                escape(title),
                escape(caption)
            )
        }
        None => svg.to_owned(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ticks_are_round() {
        let scale = Scale::around([-1.0, 1.0].into_iter());
        assert_eq!((scale.low, scale.high, scale.step), (-1.1, 1.1, 0.5));
        assert_eq!(scale.format().format(-0.5), "\u{2212}0.5");
        let scale = Scale::around([-1743.0, 2310.0].into_iter());
        assert_eq!(scale.step, 1000.0);
        assert_eq!(scale.format().format(1000.0), "1000");
        for odd in [vec![], vec![0.0], vec![7.0, 7.0], vec![f64::NAN, 1.0]] {
            let scale = Scale::around(odd.into_iter());
            assert!(scale.low < scale.high && scale.step > 0.0);
        }
        assert_eq!(round_step(0.3), 0.5);
        assert_eq!(round_step(2.1), 2.5);
        assert_eq!(round_step(100.0), 100.0);
    }

    #[test]
    fn a_figure_holds_its_texts_and_curves() {
        let curve = Curve {
            label: "a < b".to_owned(),
            colour: Colour::Blue,
            line: Line::Dashed,
            points: vec![(0.0, 1.0), (1.0, 2.0)],
        };
        let panel = Panel {
            title: "left & right".to_owned(),
            x_label: "time (s)".to_owned(),
            y_label: "force (lbf)".to_owned(),
            curves: vec![curve],
        };
        let figure = Figure {
            title: "title".to_owned(),
            caption: "what is seen".to_owned(),
            panels: vec![panel.clone(), panel],
        };
        let svg = figure.to_svg();
        for text in [
            "left &amp; right",
            "time (s)",
            "force (lbf)",
            "<desc>what is seen</desc>",
            "#0072b2",
            "9 4",
        ] {
            assert!(svg.contains(text), "{text}");
        }
        assert_eq!(svg.matches(">a &lt; b<").count(), 1);
    }
}
