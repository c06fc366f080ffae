//! Flow charts (Sankey diagrams): nodes in columns, joined by bands whose widths are proportional to what
//! flows. One scale holds for the whole chart, so widths can be compared across columns.

use kuva::render::render::{PathData, Primitive, Scene, TextAnchor};

use super::Colour;
use super::paint::{FONT, SHEET_WIDTH, TEXT_SIZE, TITLE_SIZE, title_size};

/// A node: a bar as high as what flows through it.
#[derive(Clone, Debug, PartialEq)]
pub struct FlowNode {
    /// Its column, from the left.
    pub column: usize,
    /// Its text, number and unit included; may be empty, or have several lines.
    pub label: String,
    /// The flow through it.
    pub value: f64,
    /// Its colour.
    pub colour: Colour,
}

/// A band from one node to another in the next column.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Band {
    /// The number of the node that it comes from.
    pub from: usize,
    /// The number of the node that it goes to.
    pub to: usize,
    /// The flow.
    pub value: f64,
}

/// A flow chart. Nodes of a column stand from top to bottom in their order, bands at a node too.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct FlowChart {
    /// Its nodes.
    pub nodes: Vec<FlowNode>,
    /// Its bands.
    pub bands: Vec<Band>,
}

const NODE_WIDTH: f64 = 14.0;
/// Between two nodes, so that their texts do not touch.
const GAP: f64 = 32.0;
/// Height of the column in which most flows, without gaps.
const HEIGHT: f64 = 300.0;
const TOP: f64 = 56.0;
const MARGIN: f64 = 24.0;
/// Between a node and its text.
const TEXT_GAP: f64 = 6.0;
/// Width of a letter over the size of the text.
const LETTER: f64 = 0.55;
const BAND_OPACITY: f64 = 0.4;
/// From line to line of a text.
const LINE: f64 = 16.0;
/// Pieces that a curved edge is drawn with: pictures know straight lines only.
const PIECES: u32 = 24;

/// The place of a node: left and upper edge, and height, pixels.
#[derive(Clone, Copy, Debug, Default)]
struct Place {
    x: f64,
    y: f64,
    height: f64,
}

impl FlowChart {
    fn columns(&self) -> usize {
        self.nodes.iter().map(|node| node.column + 1).max().unwrap_or(0)
    }

    fn of_column(&self, column: usize) -> impl Iterator<Item = (usize, &FlowNode)> {
        let nodes = self.nodes.iter().enumerate();
        nodes.filter(move |(_, node)| node.column == column)
    }

    /// Returns pixels for a unit of what flows.
    fn scale(&self) -> f64 {
        let total = |column| self.of_column(column).map(|(_, node)| node.value).sum::<f64>();
        HEIGHT / (0..self.columns()).map(total).fold(f64::MIN_POSITIVE, f64::max)
    }

    /// Returns the places of all nodes, and the height of the drawing.
    fn places(&self) -> (Vec<Place>, f64) {
        let (scale, columns) = (self.scale(), self.columns());
        let heights: Vec<f64> = (0..columns)
            .map(|column| {
                let nodes: Vec<f64> = self
                    .of_column(column)
                    .map(|(_, node)| node.value * scale)
                    .collect();
                nodes.iter().sum::<f64>() + GAP * nodes.len().saturating_sub(1) as f64
            })
            .collect();
        let tallest = heights.iter().copied().fold(0.0, f64::max);
        let width = |column: usize| {
            let lines = self.of_column(column).flat_map(|(_, node)| node.label.lines());
            let letters = lines.map(|line| line.chars().count());
            letters.max().unwrap_or(0) as f64 * LETTER * f64::from(TEXT_SIZE) + 2.0 * TEXT_GAP
        };
        // Texts stand to the left of the first column and to the right of all others; what is left of the
        // width is shared by the bands.
        let texts: f64 = (0..columns).map(width).sum();
        let nodes = NODE_WIDTH * columns as f64;
        let rest = (SHEET_WIDTH - 2.0 * MARGIN - texts - nodes) / columns.saturating_sub(1).max(1) as f64;
        let mut lefts = vec![MARGIN + width(0)];
        for column in 1..columns {
            let text = if column == 1 { 0.0 } else { width(column - 1) };
            lefts.push(lefts[column - 1] + NODE_WIDTH + text + rest);
        }
        let mut places = vec![Place::default(); self.nodes.len()];
        for (column, height) in heights.iter().enumerate() {
            let mut y = TOP + 0.5 * (tallest - height);
            for (number, node) in self.of_column(column) {
                let height = node.value * scale;
                let x = lefts[column];
                places[number] = Place { x, y, height };
                y += height + GAP;
            }
        }
        (places, TOP + tallest + MARGIN)
    }

    /// Returns the drawing.
    pub(super) fn scene(&self, title: &str) -> Scene {
        let (places, height) = self.places();
        let scale = self.scale();
        let mut scene = Scene::new(SHEET_WIDTH, height);
        scene.font_family = Some(FONT.to_owned());
        let text = |x: f64, y: f64, size: u32, anchor, content: &str| Primitive::Text {
            x,
            y,
            content: content.to_owned(),
            size,
            anchor,
            rotate: None,
            bold: false,
            color: None,
        };
        let size = title_size(title, SHEET_WIDTH);
        scene.elements.push(text(
            0.5 * SHEET_WIDTH,
            10.0 + f64::from(TITLE_SIZE),
            size,
            TextAnchor::Middle,
            title,
        ));
        let mut used = vec![[0.0; 2]; self.nodes.len()];
        for band in &self.bands {
            let (from, to) = (places[band.from], places[band.to]);
            let thickness = band.value * scale;
            let (left, right) = (from.x + NODE_WIDTH, to.x);
            let (a, b) = (from.y + used[band.from][1], to.y + used[band.to][0]);
            used[band.from][1] += thickness;
            used[band.to][0] += thickness;
            // Along the upper edge and back along the lower one.
            let edge = |piece: u32| {
                let share = f64::from(piece) / f64::from(PIECES);
                let rise = share * share * (3.0 - 2.0 * share);
                (left + share * (right - left), a + rise * (b - a))
            };
            let upper = (0..=PIECES).map(edge);
            let lower = (0..=PIECES).rev().map(edge).map(|(x, y)| (x, y + thickness));
            let points: Vec<String> = upper
                .chain(lower)
                .map(|(x, y)| format!("{x:.1} {y:.2}"))
                .collect();
            scene.elements.push(Primitive::Path(Box::new(PathData {
                d: format!("M {} Z", points.join(" L ")),
                fill: Some(self.nodes[band.to].colour.hex().into()),
                stroke: "none".into(),
                stroke_width: 0.0,
                opacity: Some(BAND_OPACITY),
                stroke_dasharray: None,
            })));
        }
        for (node, place) in self.nodes.iter().zip(&places) {
            scene.elements.push(Primitive::Rect {
                x: place.x,
                y: place.y,
                width: NODE_WIDTH,
                height: place.height.max(1.0),
                fill: node.colour.hex().into(),
                stroke: None,
                stroke_width: None,
                opacity: None,
            });
            let (x, anchor) = if node.column == 0 {
                (place.x - TEXT_GAP, TextAnchor::End)
            } else {
                (place.x + NODE_WIDTH + TEXT_GAP, TextAnchor::Start)
            };
            let lines = node.label.lines().count().saturating_sub(1) as f64;
            let middle = place.y + 0.5 * place.height + 0.35 * f64::from(TEXT_SIZE);
            for (number, line) in node.label.lines().enumerate() {
                let y = middle + (number as f64 - 0.5 * lines) * LINE;
                scene.elements.push(text(x, y, TEXT_SIZE, anchor, line));
            }
        }
        scene
    }
}

#[cfg(test)]
mod tests {
    use super::{Band, Colour, FlowChart, FlowNode};

    /// Widths are proportional, with one scale for all columns, and nodes do not overlap.
    #[test]
    fn analytic_bands_are_as_wide_as_what_flows() {
        let node = |column, value| FlowNode {
            column,
            label: format!("{value} J"),
            value,
            colour: Colour::Blue,
        };
        let chart = FlowChart {
            nodes: vec![node(0, 10.0), node(1, 7.0), node(1, 3.0), node(2, 1.0)],
            bands: [(0, 1, 7.0), (0, 2, 3.0), (1, 3, 1.0)]
                .map(|(from, to, value)| Band { from, to, value })
                .to_vec(),
        };
        let (places, height) = chart.places();
        for (place, node) in places.iter().zip(&chart.nodes) {
            assert!((place.height - 30.0 * node.value).abs() < 1e-9);
            assert!(place.y >= 0.0 && place.y + place.height < height);
        }
        assert!(places[2].y > places[1].y + places[1].height);
        assert!(places[0].x < places[1].x && places[1].x < places[3].x);
        let scene = chart.scene("title");
        assert_eq!(scene.elements.len(), 1 + 3 + 2 * 4);
    }
}
