//! The wear of a counterface: the work of all points, laid down where each of them is at the time.
//!
//! A point of the wedge stands for the part of the face that is nearest to it (a cell, cut at the face's
//! edges). What it does in an instant is spread evenly over this cell where it is on the counterface then,
//! and collected at the nodes of an even lattice by hat functions, which sum to one everywhere: nothing is
//! lost, and the center of what is laid down stays. The lattice is at least twice as fine as the grid.
//!
//! At last the nodes become a map over what has been touched, from edge to edge, where end nodes have half a
//! cell as those of the trapezoidal rule: its volume is the volume that was laid down, and a counterface over
//! which nothing moves is worn as the wedge's face is.

use std::collections::BTreeMap;

use wedge::face::{DepthMap, FaceProperties, GridPoint, Rectangle};
use wedge::outputs::FACES;

use super::CounterfaceWear;
use super::cycle::PointWork;
use crate::case::Case;

/// Fewest intervals of the lattice over a face.
const FEWEST: usize = 8;

/// The lattice under a face, and the face's points with their cells: up and across, from the middle, m.
#[derive(Clone, Debug, PartialEq)]
pub struct Lattice {
    spacing: [f64; 2],
    half: [f64; 2],
    places: Vec<[f64; 2]>,
    cells: Vec<[[f64; 2]; 2]>,
}

/// Something by the nodes of a lattice, and how far up and across it reaches (m).
#[derive(Clone, Debug, PartialEq)]
pub struct Laid<T> {
    nodes: BTreeMap<[i32; 2], T>,
    reach: [[f64; 2]; 2],
}

impl Lattice {
    /// Returns the lattice of a face.
    #[must_use]
    pub fn new(face: &FaceProperties, rectangle: &Rectangle) -> Self {
        let extent = [rectangle.length(), rectangle.width];
        let count = [face.grid.up, face.grid.across];
        let interval = [0, 1].map(|axis| extent[axis] / (count[axis] - 1) as f64);
        let place = |point: &GridPoint| {
            let (up, across) = rectangle.distances(point);
            [up, across]
        };
        let places: Vec<[f64; 2]> = face.grid.points().iter().map(place).collect();
        let cell = |place: &[f64; 2]| {
            [0, 1].map(|axis| {
                let half = 0.5 * extent[axis];
                [-0.5, 0.5].map(|way| (place[axis] + way * interval[axis]).clamp(-half, half))
            })
        };
        Self {
            spacing: [0, 1].map(|axis| extent[axis] / (2 * (count[axis] - 1)).max(FEWEST) as f64),
            half: extent.map(|extent| 0.5 * extent),
            cells: places.iter().map(cell).collect(),
            places,
        }
    }

    /// Returns an empty lattice.
    #[must_use]
    pub fn empty<T>(&self) -> Laid<T> {
        Laid {
            nodes: BTreeMap::new(),
            reach: self.half.map(|half| [-half, half]),
        }
    }

    /// Returns the places of the face's points on the wedge: up and across, m.
    pub(super) fn places(&self) -> &[[f64; 2]] {
        &self.places
    }

    /// Lays down what a point does while it is moved up and across (m) from its place on the wedge: `add`
    /// gets nodes with their shares.
    pub(super) fn lay<T: Default>(
        &self,
        laid: &mut Laid<T>,
        point: usize,
        moved: [f64; 2],
        mut add: impl FnMut(&mut T, f64),
    ) {
        let shares = [0, 1].map(|axis| {
            let cell = self.cells[point][axis].map(|edge| edge + moved[axis]);
            let [low, high] = &mut laid.reach[axis];
            (*low, *high) = (low.min(cell[0]), high.max(cell[1]));
            self.shares(axis, cell)
        });
        let [up, across] = shares;
        for (row, by_row) in &up {
            for (column, by_column) in &across {
                add(laid.nodes.entry([*row, *column]).or_default(), by_row * by_column);
            }
        }
    }

    /// Returns the area over which something is laid, m².
    pub(super) fn area<T>(&self, laid: &Laid<T>) -> f64 {
        laid.reach.iter().map(|[low, high]| high - low).product()
    }

    /// Returns the shares of a cell (m) by node.
    fn shares(&self, axis: usize, [from, to]: [f64; 2]) -> Vec<(i32, f64)> {
        let (spacing, half) = (self.spacing[axis], self.half[axis]);
        let number = |place: f64| (place + half) / spacing;
        let (first, last) = (number(from).floor() as i32, number(to).ceil() as i32);
        // The integral of a hat from its left foot on, both in spacings.
        let below = |x: f64| match x.clamp(-1.0, 1.0) {
            x if x < 0.0 => 0.5 * (x + 1.0) * (x + 1.0),
            x => 1.0 - 0.5 * (1.0 - x) * (1.0 - x),
        };
        let width = number(to) - number(from);
        (first..=last)
            .map(|node| {
                let at = f64::from(node);
                (node, (below(number(to) - at) - below(number(from) - at)) / width)
            })
            .collect()
    }

    /// Returns the map of depths (m) of volumes (m³) that have been laid down, over those of a map before;
    /// none if there are neither.
    pub(super) fn map(&self, volumes: &Laid<f64>, before: Option<&DepthMap>) -> Option<DepthMap> {
        if volumes.nodes.is_empty() {
            return before.cloned();
        }
        let places = [0, 1].map(|axis| self.ticks(axis, volumes.reach[axis]));
        let [up, across] = &places;
        let mut depths = vec![0.0; up.len() * across.len()];
        for (node, volume) in &volumes.nodes {
            let [rows, columns] = [0, 1].map(|axis| {
                let place = f64::from(node[axis]) * self.spacing[axis] - self.half[axis];
                between(&places[axis], place)
            });
            for (row, by_row) in rows {
                for (column, by_column) in columns {
                    let area = cell(up, row) * cell(across, column);
                    depths[row * across.len() + column] += volume * by_row * by_column / area;
                }
            }
        }
        let mut points = Vec::with_capacity(depths.len());
        for (row, up) in up.iter().enumerate() {
            for (column, side) in across.iter().enumerate() {
                let own = depths[row * across.len() + column];
                points.push([*up, *side, own + before.map_or(0.0, |map| map.depth(*up, *side))]);
            }
        }
        DepthMap::new(&points).ok()
    }

    /// Returns the places of the map along an axis: both ends, and the nodes between that are half a spacing
    /// away from them.
    fn ticks(&self, axis: usize, [low, high]: [f64; 2]) -> Vec<f64> {
        let (spacing, half) = (self.spacing[axis], self.half[axis]);
        let (first, last) = (
            ((low + half) / spacing).floor() as i32,
            ((high + half) / spacing).ceil() as i32,
        );
        let inside = (first..=last)
            .map(|node| f64::from(node) * spacing - half)
            .filter(|place| place - low > 0.5 * spacing && high - place > 0.5 * spacing);
        [low].into_iter().chain(inside).chain([high]).collect()
    }
}

impl Laid<f64> {
    /// Adds volumes of another.
    pub(super) fn add<T>(&mut self, work: &Laid<T>, volume: impl Fn(&T) -> f64) {
        for (node, own) in &work.nodes {
            *self.nodes.entry(*node).or_default() += volume(own);
        }
        for (reach, other) in self.reach.iter_mut().zip(&work.reach) {
            *reach = [reach[0].min(other[0]), reach[1].max(other[1])];
        }
    }

    /// Returns the sum of all volumes, m³.
    pub(super) fn total(&self) -> f64 {
        self.nodes.values().fold(0.0, |sum, volume| sum + volume)
    }
}

/// Both counterfaces of a wedge, with what has been worn off.
#[derive(Clone, Debug)]
pub(super) struct Counterfaces<'l> {
    lattices: &'l [Lattice; FACES.len()],
    volumes: [Laid<f64>; FACES.len()],
}

impl<'l> Counterfaces<'l> {
    /// Returns them at the start.
    pub fn new(lattices: &'l [Lattice; FACES.len()]) -> Self {
        Self {
            lattices,
            volumes: lattices.each_ref().map(Lattice::empty),
        }
    }

    /// Adds the volumes of work.
    pub fn add(&mut self, work: &[Laid<PointWork>; FACES.len()], volume: impl Fn(&PointWork) -> f64) {
        for (own, work) in self.volumes.iter_mut().zip(work) {
            own.add(work, &volume);
        }
    }

    /// Returns the wear beyond the maps that a case has from the start.
    pub fn wear(&self, case: &Case) -> [CounterfaceWear; FACES.len()] {
        let faces = super::faces(case);
        [0, 1].map(|face| CounterfaceWear {
            map: self.lattices[face].map(&self.volumes[face], faces[face].counterface_wear.as_ref()),
            volume: self.volumes[face].total(),
        })
    }
}

/// Returns the length that a place stands for, by the trapezoidal rule.
fn cell(places: &[f64], place: usize) -> f64 {
    let last = places.len() - 1;
    0.5 * (places[(place + 1).min(last)] - places[place.saturating_sub(1)])
}

/// Returns the two places around one with their shares; beyond the ends all is at the end.
fn between(places: &[f64], place: f64) -> [(usize, f64); 2] {
    let low = places.partition_point(|other| *other <= place).saturating_sub(1);
    let low = low.min(places.len() - 2);
    let share = ((place - places[low]) / (places[low + 1] - places[low])).clamp(0.0, 1.0);
    [(low, 1.0 - share), (low + 1, share)]
}
