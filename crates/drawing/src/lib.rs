//! The drawing layer: what figures are made of, and how they become SVG and PNG.
//!
//! Figures are described without reference to a drawing library: panels, axes, curves. Only `paint` knows the
//! library that draws them, so that it can be changed, and other formats added, in one place. [`thin`] makes
//! curves small; [`contour`] finds lines of equal height; [`flow`] draws flow charts.
//!
//! ```
//! use drawing::{Figure, Panel, PlotCurve, distinct};
//!
//! let (colour, line) = distinct(0);
//! let points = vec![(-1.0, -900.0), (1.0, -900.0), (1.0, 1300.0), (-1.0, 1300.0)];
//! let curve = PlotCurve { label: "wedge".to_owned(), colour, line, points };
//! let panel = Panel { x_label: "stroke (in)".to_owned(), curves: vec![curve], ..Panel::default() };
//! let figure = Figure { title: "A loop".to_owned(), panels: vec![panel], ..Figure::default() };
//! assert!(figure.to_svg().contains("stroke (in)"));
//! assert!(figure.to_png()?.starts_with(b"\x89PNG"));
//! # Ok::<(), String>(())
//! ```

pub mod contour;
pub mod flow;
mod paint;
mod scale;
pub mod thin;

/// Colours that people with any kind of colour vision can tell apart (Okabe and Ito, 2008).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Colour {
    /// Black.
    #[default]
    Black,
    /// Grey.
    Grey,
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
    /// Returns the color as SVG writes it.
    #[must_use]
    pub fn hex(self) -> &'static str {
        match self {
            Self::Black => "#000000",
            Self::Grey => "#8c8c8c",
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
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Line {
    /// Solid.
    #[default]
    Solid,
    /// Dashed.
    Dashed,
    /// Dashes and dots.
    DashDot,
    /// Dotted.
    Dotted,
    /// Solid and as broad as a bar.
    Bar,
}

/// The styles by which [`distinct`] distinguishes up to eight curves.
const STYLES: [(Colour, Line); 8] = [
    (Colour::Blue, Line::Solid),
    (Colour::Black, Line::Dashed),
    (Colour::Vermillion, Line::DashDot),
    (Colour::Green, Line::Dotted),
    (Colour::Purple, Line::Solid),
    (Colour::Orange, Line::Dashed),
    (Colour::Sky, Line::DashDot),
    (Colour::Grey, Line::Dotted),
];

/// Returns a colour and a line for the curve of this number, unlike those of the seven others around it.
#[must_use]
pub fn distinct(number: usize) -> (Colour, Line) {
    STYLES[number % STYLES.len()]
}

/// A curve.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct PlotCurve {
    /// Its name in the legend; curves of the same name in several panels share one entry, and one without a
    /// name has none.
    pub label: String,
    /// Its colour.
    pub colour: Colour,
    /// Its line.
    pub line: Line,
    /// Its points, in the units of the axes; a point that is not finite interrupts it.
    pub points: Vec<(f64, f64)>,
}

impl PlotCurve {
    /// Returns a curve with its name in the legend and its style.
    pub fn new(
        label: impl Into<String>,
        (colour, line): (Colour, Line),
        points: impl IntoIterator<Item = (f64, f64)>,
    ) -> Self {
        Self {
            label: label.into(),
            colour,
            line,
            points: points.into_iter().collect(),
        }
    }
}

/// A short text at a point, such as the number of a phase.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Mark {
    /// The place, in the units of the axes.
    pub at: (f64, f64),
    /// The text.
    pub text: String,
}

/// Axes with curves.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Panel {
    /// Its title; may be empty.
    pub title: String,
    /// Name and unit of the abscissa.
    pub x_label: String,
    /// Name and unit of the ordinate.
    pub y_label: String,
    /// Its curves, the first one lowest.
    pub curves: Vec<PlotCurve>,
    /// The window that is shown of the abscissa; without one, everything.
    pub x_window: Option<(f64, f64)>,
    /// Names of the ordinates 0, 1, ..., from bottom to top, where the ordinate is not a number.
    pub y_names: Vec<String>,
    /// Texts at points.
    pub marks: Vec<Mark>,
    /// Its width in cells of the figure's grid; 0 counts as 1.
    pub span: usize,
}

impl Panel {
    /// Returns axes with a title, names, and curves.
    pub fn new(
        title: impl Into<String>,
        x_label: impl Into<String>,
        y_label: impl Into<String>,
        curves: impl IntoIterator<Item = PlotCurve>,
    ) -> Self {
        Self {
            title: title.into(),
            x_label: x_label.into(),
            y_label: y_label.into(),
            curves: curves.into_iter().collect(),
            ..Self::default()
        }
    }
}

/// Panels in rows, with a common legend below.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Figure {
    /// Its title.
    pub title: String,
    /// The description in full sentences; it goes into the file as its description.
    pub caption: String,
    /// Its panels, from left to right and from top to bottom.
    pub panels: Vec<Panel>,
    /// Cells in a row; 0: all panels in one row.
    pub columns: usize,
    /// True if all panels have the same ranges of axes.
    pub common_axes: bool,
    /// A flow chart in place of panels.
    pub flow: Option<flow::FlowChart>,
}

impl Figure {
    /// Returns a figure of panels, all in one row.
    pub fn new(
        title: impl Into<String>,
        caption: impl Into<String>,
        panels: impl IntoIterator<Item = Panel>,
    ) -> Self {
        Self {
            title: title.into(),
            caption: caption.into(),
            panels: panels.into_iter().collect(),
            ..Self::default()
        }
    }

    /// Returns the same figure with so many cells in a row.
    #[must_use]
    pub fn in_columns(self, columns: usize) -> Self {
        Self { columns, ..self }
    }

    /// Returns the figure as an SVG document.
    #[must_use]
    pub fn to_svg(&self) -> String {
        let svg = paint::svg(&paint::scene(self));
        describe(&svg, &self.title, &self.caption)
    }

    /// Returns the drawing with names that begin with `name`, so that several stand in one document.
    #[must_use]
    pub fn named(svg: &str, name: &str) -> String {
        svg.replace(
            &format!("id=\"{}", paint::CLIP),
            &format!("id=\"{name}-{}", paint::CLIP),
        )
        .replace(
            &format!("url(#{}", paint::CLIP),
            &format!("url(#{name}-{}", paint::CLIP),
        )
    }

    /// Returns the figure as a PNG picture.
    ///
    /// # Errors
    /// The message of the PNG encoder.
    pub fn to_png(&self) -> Result<Vec<u8>, String> {
        paint::png(paint::scene(self))
    }

    /// Returns the names in the legend with their styles, in the order in which they first appear.
    fn legend(&self) -> Vec<&PlotCurve> {
        let mut entries: Vec<&PlotCurve> = Vec::new();
        for curve in self.panels.iter().flat_map(|panel| &panel.curves) {
            if !curve.label.is_empty() && entries.iter().all(|entry| entry.label != curve.label) {
                entries.push(curve);
            }
        }
        entries
    }

    /// Returns the grid: for each panel its row, first cell, and number of cells; then the numbers of rows
    /// and columns.
    #[must_use]
    pub fn grid(&self) -> (Vec<(usize, usize, usize)>, usize, usize) {
        let span = |panel: &Panel| panel.span.max(1);
        let all: usize = self.panels.iter().map(span).sum();
        let columns = if self.columns == 0 { all } else { self.columns }.max(1);
        let (mut row, mut cell) = (0, 0);
        let mut places = Vec::new();
        for panel in &self.panels {
            let width = span(panel).min(columns);
            if cell + width > columns {
                (row, cell) = (row + 1, 0);
            }
            places.push((row, cell, width));
            cell += width;
        }
        (places, row + 1, columns)
    }
}

/// Puts title and description, which screen readers read, after the first tag.
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

    fn figure() -> Figure {
        let curve = PlotCurve {
            label: "a < b".to_owned(),
            colour: Colour::Blue,
            line: Line::Dashed,
            points: vec![(0.0, 1.0), (1.0, 2.0), (f64::NAN, 0.0), (1.5, 2.0), (2.0, 1.0)],
        };
        let panel = Panel {
            title: "left & right".to_owned(),
            x_label: "time (s)".to_owned(),
            y_label: "force (lbf)".to_owned(),
            curves: vec![curve],
            ..Panel::default()
        };
        Figure {
            title: "title".to_owned(),
            caption: "what is seen".to_owned(),
            panels: vec![panel.clone(), panel],
            ..Figure::default()
        }
    }

    #[test]
    fn a_figure_holds_its_texts_and_curves() {
        let svg = figure().to_svg();
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
        assert!(!svg.contains("NaN"));
        assert_eq!(figure().to_svg(), svg, "the same figure gives the same text");
        assert!(svg.contains("url(#clip-2)") && Figure::named(&svg, "left").contains("id=\"left-clip-2\""));
    }

    #[test]
    fn a_picture_has_the_size_of_the_drawing() {
        let png = figure().to_png().unwrap_or_default();
        assert_eq!(&png[..8], b"\x89PNG\r\n\x1a\n");
        let width = u32::from_be_bytes([png[16], png[17], png[18], png[19]]);
        assert!(width > 900, "{width}");
    }

    #[test]
    fn panels_fill_rows() {
        let mut figure = figure();
        figure.panels.push(figure.panels[0].clone());
        assert_eq!(figure.grid(), (vec![(0, 0, 1), (0, 1, 1), (0, 2, 1)], 1, 3));
        figure.columns = 2;
        figure.panels[0].span = 2;
        assert_eq!(figure.grid(), (vec![(0, 0, 2), (1, 0, 1), (1, 1, 1)], 2, 2));
    }
}
