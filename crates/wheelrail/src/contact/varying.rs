//! A rail whose section changes along the track, prepared for the search.
//!
//! Slices stand at places along the track; between two of them the section is linear: points at equal shares
//! of the visible lengths of both curves are joined by straight lines. The visible part of a rail ends where
//! it is steeper than 82° on either side, so that corners of the head belong to corners. Before the first and
//! behind the last slice the section stays as it is there.
//!
//! A slope along the track that changed at once at a slice would be a blow at every slice of a measured rail.
//! A wheel touches its rail over some 10 mm, and bridges the kink: within 5 mm on both sides of a slice the
//! section follows the parabola that joins the two lines ([`ROUNDED`], a choice).
//!
//! Where the section rises along the track by m, the plane of contact is tilted by it, and the wheel touches
//! r m ahead of the plane of its axle ([`ContactPatch::climb`](super::ContactPatch::climb)).
//!
//! **Limits.** The section is that of the axle's plane, not of the contact, r m ahead: the wheel stands lower
//! by r m²/2 than it should (0.9 μm at 1:500, 23 μm at 1:100), and meets a change late by r m (0.9 mm at
//! 1:500). Points of a curve are tied by their share of the length alone.

use std::sync::Arc;

use numerics::scalar::Real;

use super::section::{self, RailSection};
use crate::profile::{Profile, ProfileError, ProfileKind, SlicedProfile};

/// Distance on both sides of a slice over which the slope along the track changes, m: half of a contact.
const ROUNDED: f64 = 5e-3;

/// A rail whose section changes along the track.
#[derive(Clone, Debug)]
pub struct VaryingRail {
    /// Places of the slices, m, rising.
    places: Vec<f64>,
    slices: Vec<Arc<Slice>>,
}

/// A slice: its section, and its visible curve at equal shares of its length.
#[derive(Debug)]
struct Slice {
    section: RailSection,
    /// y, z (m), and their derivatives by the share.
    nodes: Vec<[f64; 4]>,
}

/// The rail at a place.
#[derive(Clone, Debug)]
pub(super) enum Stretch<'r> {
    /// A section that does not change there.
    Constant(&'r RailSection),
    /// One between slices.
    Between(Blend<'r>),
}

/// A section between slices.
#[derive(Clone, Debug)]
pub(super) struct Blend<'r> {
    /// The nodes of the slices that count.
    nodes: [&'r [[f64; 4]]; 3],
    /// Their number, 2 or 3.
    count: usize,
    /// Weights of the slices, their first and second derivatives by the place.
    weights: [[f64; 3]; 3],
}

/// A cell of a blend that covers a place y.
struct Cell {
    /// y from the cell's beginning, m.
    t: f64,
    length: f64,
    ends: [End; 2],
}

/// A node of a blend: place, slope, and how they change along the track.
#[derive(Clone, Copy)]
struct End {
    y: f64,
    z: f64,
    slope: f64,
    /// Derivative of the slope of this node along the track, 1/m.
    turning: f64,
    /// Rise of the surface along the track at the node's y; its derivative along the track, 1/m.
    climb: f64,
    bend: f64,
    /// Derivative of y along the track.
    aside: f64,
}

impl VaryingRail {
    /// Returns a rail with the profiles of slices at their places.
    ///
    /// # Errors
    /// A profile is no rail with its datum.
    pub fn new(rail: &SlicedProfile) -> Result<Self, ProfileError> {
        let mut ranges = Vec::with_capacity(rail.profiles().len());
        let mut count = 0;
        for profile in rail.profiles() {
            let range = section::prepared(profile, ProfileKind::Rail)?;
            count = count.max(section::cells(range));
            ranges.push(range);
        }
        let mut slices: Vec<Arc<Slice>> = Vec::with_capacity(ranges.len());
        for (i, profile) in rail.profiles().iter().enumerate() {
            let mut before = rail.profiles()[..i].iter();
            slices.push(match before.position(|other| Arc::ptr_eq(profile, other)) {
                Some(known) => slices[known].clone(),
                None => Arc::new(Slice::new(profile, ranges[i], count)?),
            });
        }
        Ok(Self {
            places: rail.places().to_vec(),
            slices,
        })
    }

    /// Returns the section at a place along the track, m.
    pub(super) fn at(&self, place: f64) -> Stretch<'_> {
        let next = self.places.partition_point(|own| *own <= place);
        let last = self.places.len() - 1;
        let near = [next.checked_sub(1), (next <= last).then_some(next)];
        let near = near
            .into_iter()
            .flatten()
            .find(|k| (place - self.places[*k]).abs() < self.rounded(*k));
        match near {
            Some(k) => self.around(k, place),
            None if next == 0 => Stretch::Constant(&self.slices[0].section),
            None if next > last => Stretch::Constant(&self.slices[last].section),
            None => {
                let length = self.places[next] - self.places[next - 1];
                let share = (place - self.places[next - 1]) / length;
                let rate = 1.0 / length;
                let weights = [[1.0 - share, share, 0.0], [-rate, rate, 0.0], [0.0; 3]];
                self.blend([next - 1, next, next], weights)
            }
        }
    }

    /// Returns the distance to a slice within which the slope along the track changes, m.
    fn rounded(&self, k: usize) -> f64 {
        let [before, after] = self.lengths(k);
        ROUNDED.min(0.5 * before).min(0.5 * after)
    }

    /// Returns the distances of a slice to its neighbors, m; infinite where there is none.
    fn lengths(&self, k: usize) -> [f64; 2] {
        let before = k.checked_sub(1).map(|i| self.places[k] - self.places[i]);
        let after = self.places.get(k + 1).map(|next| next - self.places[k]);
        [before, after].map(|length| length.unwrap_or(f64::INFINITY))
    }

    /// Returns the section near a slice.
    fn around(&self, k: usize, place: f64) -> Stretch<'_> {
        let rounded = self.rounded(k);
        let [before, after] = self.lengths(k).map(f64::recip);
        let t = place - self.places[k];
        let [behind, ahead] = [t - rounded, t + rounded];
        let per = 1.0 / (4.0 * rounded);
        let first = [behind * behind, 2.0 * behind, 2.0].map(|own| own * per * before);
        let last = [ahead * ahead, 2.0 * ahead, 2.0].map(|own| own * per * after);
        let weights = [0, 1, 2].map(|order| {
            let whole = if order == 0 { 1.0 } else { 0.0 };
            let (a, c) = (first[order], last[order]);
            [a, whole - a - c, c]
        });
        let places = [k.saturating_sub(1), k, (k + 1).min(self.places.len() - 1)];
        self.blend(places, weights)
    }

    fn blend(&self, places: [usize; 3], weights: [[f64; 3]; 3]) -> Stretch<'_> {
        let slices = places.map(|k| &self.slices[k]);
        if Arc::ptr_eq(slices[0], slices[1]) && Arc::ptr_eq(slices[1], slices[2]) {
            return Stretch::Constant(&slices[0].section);
        }
        Stretch::Between(Blend {
            nodes: slices.map(|slice| slice.nodes.as_slice()),
            count: if places[1] == places[2] { 2 } else { 3 },
            weights,
        })
    }
}

impl Slice {
    fn new(profile: &Profile, range: [f64; 2], count: usize) -> Result<Self, ProfileError> {
        let [start, end] = range;
        let nodes = (0..=count).map(|i| {
            let share = i as f64 / count as f64;
            let point = profile.curve().at(start + (end - start) * share);
            let [y, z] = point.position;
            let [dy, dz] = point.tangent.map(|own| own * (end - start));
            [y, z, dy, dz]
        });
        Ok(Self {
            section: RailSection::new(profile)?,
            nodes: nodes.collect(),
        })
    }
}

impl Stretch<'_> {
    /// Returns beginning and end of the section, m.
    pub fn range(&self) -> [f64; 2] {
        match self {
            Self::Constant(section) => section.range(),
            Self::Between(blend) => blend.range(),
        }
    }

    /// Returns height (m) and slope at y (m); `along` is the place along the track.
    #[inline(always)]
    pub fn at<S: Real>(&self, y: S, along: S) -> [S; 2] {
        match self {
            Self::Constant(section) => section.at(y),
            Self::Between(blend) => blend.lifted(y, along),
        }
    }

    /// Returns the height (m) at y (m) by straight lines between points some 0.1 mm apart.
    #[inline(always)]
    pub fn coarse(&self, y: f64) -> f64 {
        match self {
            Self::Constant(section) => section.coarse(y),
            Self::Between(blend) => blend.coarse(y),
        }
    }

    /// Returns the rise of the surface along the track at y (m); none of a section that does not change.
    #[inline(always)]
    pub fn climb<S: Real>(&self, y: S, along: S) -> Option<S> {
        match self {
            Self::Constant(_) => None,
            Self::Between(blend) => {
                let [climb, across, bend] = blend.climb(y.value());
                Some(y.chain(climb, across) + along.chain(0.0, bend))
            }
        }
    }
}

impl Blend<'_> {
    /// Returns the weighted sum of the slices at a node, by weights or one of their derivatives.
    fn sum(&self, order: usize, node: usize) -> [f64; 4] {
        let mut sum = [0.0; 4];
        for (nodes, weight) in self.nodes.iter().zip(&self.weights[order]).take(self.count) {
            for (sum, own) in sum.iter_mut().zip(&nodes[node]) {
                *sum += weight * own;
            }
        }
        sum
    }

    /// Returns y of a node, m.
    fn y(&self, node: usize) -> f64 {
        let own = self.nodes.iter().zip(&self.weights[0]).take(self.count);
        own.map(|(nodes, weight)| weight * nodes[node][0]).sum()
    }

    fn last(&self) -> usize {
        self.nodes[0].len() - 1
    }

    fn range(&self) -> [f64; 2] {
        [self.y(0), self.y(self.last())]
    }

    fn end(&self, node: usize) -> End {
        let [y, z, dy, dz] = self.sum(0, node);
        let [y_rate, z_rate, dy_rate, dz_rate] = self.sum(1, node);
        let [y_bend, z_bend, _, _] = self.sum(2, node);
        let slope = dz / dy;
        let turning = (dz_rate - slope * dy_rate) / dy;
        End {
            y,
            z,
            slope,
            turning,
            climb: z_rate - slope * y_rate,
            bend: z_bend - turning * y_rate - slope * y_bend,
            aside: y_rate,
        }
    }

    /// Returns the nodes beside y (m); beyond the ends twice that of the end.
    fn beside(&self, y: f64) -> [usize; 2] {
        let (mut low, mut high) = (0, self.last());
        if y <= self.y(low) {
            return [low; 2];
        }
        if y >= self.y(high) {
            return [high; 2];
        }
        while high - low > 1 {
            let middle = low.midpoint(high);
            if self.y(middle) <= y {
                low = middle;
            } else {
                high = middle;
            }
        }
        [low, high]
    }

    #[inline(never)]
    fn coarse(&self, y: f64) -> f64 {
        let [low, high] = self.beside(y);
        let [from, height, dy, dz] = self.sum(0, low);
        if low == high {
            return height + (y - from) * dz / dy;
        }
        let [to, next, ..] = self.sum(0, high);
        height + (y - from) * (next - height) / (to - from)
    }

    /// Returns the cell that covers y (m); beyond the ends an empty one at the end.
    fn cell(&self, y: f64) -> Cell {
        let [low, high] = self.beside(y);
        if low == high {
            let end = self.end(low);
            return Cell {
                t: y - end.y,
                length: 0.0,
                ends: [end; 2],
            };
        }
        let ends = [self.end(low), self.end(high)];
        Cell {
            t: y - ends[0].y,
            length: ends[1].y - ends[0].y,
            ends,
        }
    }

    /// Returns height (m) and slope at y (m): each with its derivatives by y and along the track.
    #[inline(never)]
    fn at(&self, y: f64) -> [[f64; 3]; 2] {
        let Cell {
            t,
            length,
            ends: [a, b],
        } = self.cell(y);
        if length == 0.0 {
            // The section goes on with its end slope.
            return [
                [a.z + a.slope * t, a.slope, a.climb + a.turning * t],
                [a.slope, 0.0, a.turning],
            ];
        }
        let cubic = section::hermite(length, [a.z, b.z], [a.slope, b.slope]);
        let share = t / length;
        let climb = a.climb + share * (b.climb - a.climb);
        let slope = section::slope(&cubic, t);
        [
            [section::value(&cubic, t), slope, climb],
            [slope, section::second(&cubic, t), (b.climb - a.climb) / length],
        ]
    }

    /// The same with derivatives.
    fn lifted<S: Real>(&self, y: S, along: S) -> [S; 2] {
        self.at(y.value())
            .map(|[value, by_y, by_place]| y.chain(value, by_y) + along.chain(0.0, by_place))
    }

    /// Returns the rise of the surface along the track at y (m), with its derivatives by y and along the
    /// track, 1/m.
    #[inline(never)]
    fn climb(&self, y: f64) -> [f64; 3] {
        let Cell {
            t,
            length,
            ends: [a, b],
        } = self.cell(y);
        if length == 0.0 {
            return [a.climb + a.turning * t, a.turning, a.bend - a.turning * a.aside];
        }
        let share = t / length;
        let across = (b.climb - a.climb) / length;
        // The share of a fixed y changes as the cell's ends move.
        let moving = -(a.aside + share * (b.aside - a.aside)) / length;
        let bend = a.bend + share * (b.bend - a.bend) + moving * (b.climb - a.climb);
        [a.climb + share * (b.climb - a.climb), across, bend]
    }
}
