//! A map of depths over a face: how far it recedes at each place, as by wear.
//!
//! The map is given at the nodes of a rectangular grid, whose spacings may differ, and is bilinear between
//! them: exact at the nodes, no deeper and no shallower between them than at the nodes around, and its volume
//! is that of the trapezoidal rule. Beyond its edges it goes on as at the edge. Units: m.
//!
//! On the wedge it moves the contact points of a face and needs no slope. A counterface, over which points
//! slide, needs continuous curvature: it is the spline surface through the nodes ([`DepthMap::surface`]).

use mechanics::depth_surface::DepthSurface;
use mechanics::spline::SplineError;
use serde::{Deserialize, Serialize};
use thiserror::Error;

/// Depths over a face.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(try_from = "Vec<[f64; 3]>", into = "Vec<[f64; 3]>")]
pub struct DepthMap {
    /// Places from the middle of the face up, increasing.
    up: Vec<f64>,
    /// Places from the middle to the left, increasing.
    across: Vec<f64>,
    /// Depths row by row from the lowest one, each from right to left.
    depths: Vec<f64>,
}

/// Reasons why points make no map.
#[derive(Clone, Debug, PartialEq, Error)]
pub enum DepthMapError {
    /// A value is infinite or not a number.
    #[error("point {point} (counted from 1) is not finite")]
    NotFinite {
        /// The point.
        point: usize,
    },
    /// All points lie on one line.
    #[error("{up} places up the face and {across} across it; at least two of each are expected")]
    TooFew {
        /// Different places up.
        up: usize,
        /// Different places across.
        across: usize,
    },
    /// The points do not fill a rectangle.
    #[error(
        "{points} points make no rectangle of {up} places up the face by {across} across it: every place up \
         must have a depth at every place across"
    )]
    NotRectangle {
        /// Number of points.
        points: usize,
        /// Different places up.
        up: usize,
        /// Different places across.
        across: usize,
    },
    /// A place stands there twice.
    #[error("point {point} (counted from 1) has the place of another one")]
    Twice {
        /// The later one.
        point: usize,
    },
}

impl DepthMap {
    /// Returns the map through points of place up, place across (both from the middle of the face) and depth,
    /// in any order.
    ///
    /// # Errors
    /// They are not finite, do not fill a rectangle, or one place has two depths.
    pub fn new(points: &[[f64; 3]]) -> Result<Self, DepthMapError> {
        if let Some(point) = points
            .iter()
            .position(|point| !point.iter().all(|v| v.is_finite()))
        {
            return Err(DepthMapError::NotFinite { point: point + 1 });
        }
        let places = |axis: usize| {
            let mut places: Vec<f64> = points.iter().map(|point| point[axis]).collect();
            places.sort_by(f64::total_cmp);
            places.dedup();
            places
        };
        let (up, across) = (places(0), places(1));
        if up.len() < 2 || across.len() < 2 {
            let (up, across) = (up.len(), across.len());
            return Err(DepthMapError::TooFew { up, across });
        }
        let not_rectangle = DepthMapError::NotRectangle {
            points: points.len(),
            up: up.len(),
            across: across.len(),
        };
        if points.len() < up.len() * across.len() {
            return Err(not_rectangle);
        }
        let mut depths = vec![None; up.len() * across.len()];
        for (point, [u, a, depth]) in points.iter().enumerate() {
            let row = up.partition_point(|place| place < u);
            let column = across.partition_point(|place| place < a);
            if depths[row * across.len() + column].replace(*depth).is_some() {
                return Err(DepthMapError::Twice { point: point + 1 });
            }
        }
        let depths: Option<Vec<f64>> = depths.into_iter().collect();
        let depths = depths.ok_or(not_rectangle)?;
        Ok(Self { up, across, depths })
    }

    /// Returns the points of the map: place up, place across, depth; row by row from the lowest one, each
    /// from right to left.
    pub fn points(&self) -> impl Iterator<Item = [f64; 3]> + '_ {
        let places = self
            .up
            .iter()
            .flat_map(|up| self.across.iter().map(move |across| (*up, *across)));
        places
            .zip(&self.depths)
            .map(|((up, across), depth)| [up, across, *depth])
    }

    /// Returns its places up the face and across it, both from the middle, increasing.
    #[must_use]
    pub fn places(&self) -> [&[f64]; 2] {
        [&self.up, &self.across]
    }

    /// Returns the depth at a place, both coordinates from the middle of the face.
    #[must_use]
    pub fn depth(&self, up: f64, across: f64) -> f64 {
        let ((row, u), (column, a)) = (between(&self.up, up), between(&self.across, across));
        let width = self.across.len();
        let along = |row: usize| {
            let own = &self.depths[row * width + column..];
            own[0] + (own[1] - own[0]) * a
        };
        let (below, above) = (along(row), along(row + 1));
        below + (above - below) * u
    }

    /// Returns the smooth surface through the nodes, as a counterface needs it; `reversed` says whether the
    /// axes z and y of its marker point down and to the right.
    ///
    /// # Errors
    /// Fewer than four places up or across, or places so close to each other that curvatures overflow.
    pub fn surface(&self, reversed: [bool; 2]) -> Result<DepthSurface, SplineError> {
        let places = |places: &[f64], reversed: bool| -> Vec<f64> {
            match reversed {
                true => places.iter().rev().map(|place| -place).collect(),
                false => places.to_vec(),
            }
        };
        let (rows, width) = (self.up.len(), self.across.len());
        let turned = |place: usize, count: usize, reversed: bool| match reversed {
            true => count - 1 - place,
            false => place,
        };
        let mut depths = Vec::with_capacity(self.depths.len());
        for row in 0..rows {
            let own = &self.depths[turned(row, rows, reversed[0]) * width..][..width];
            depths.extend((0..width).map(|column| own[turned(column, width, reversed[1])]));
        }
        let (z, y) = (places(&self.up, reversed[0]), places(&self.across, reversed[1]));
        DepthSurface::new(y, z, &depths)
    }

    /// Returns whether the map reaches from edge to edge of a face of this length and width, to rounding.
    pub(super) fn covers(&self, length: f64, width: f64) -> bool {
        let reaches = |places: &[f64], extent: f64| {
            let half = 0.5 * extent * (1.0 - ROUNDING);
            places[0] <= -half && places[places.len() - 1] >= half
        };
        reaches(&self.up, length) && reaches(&self.across, width)
    }
}

/// Edges of a face in other units are those of the map within this part of them.
const ROUNDING: f64 = 1e-9;

/// Returns the interval of a place among increasing ones, and its share of that: 0 and 1 beyond the ends.
fn between(places: &[f64], place: f64) -> (usize, f64) {
    let low = places.partition_point(|other| *other <= place).saturating_sub(1);
    let low = low.min(places.len() - 2);
    let (from, to) = (places[low], places[low + 1]);
    (low, ((place - from) / (to - from)).clamp(0.0, 1.0))
}

impl TryFrom<Vec<[f64; 3]>> for DepthMap {
    type Error = DepthMapError;

    fn try_from(points: Vec<[f64; 3]>) -> Result<Self, DepthMapError> {
        Self::new(&points)
    }
}

impl From<DepthMap> for Vec<[f64; 3]> {
    fn from(map: DepthMap) -> Self {
        map.points().collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn analytic_a_map_is_exact_at_its_nodes_and_bilinear_between() {
        let plane = |u: f64, a: f64| 1.0 + 2.0 * u - 3.0 * a + 0.5 * u * a;
        let mut points = Vec::new();
        for a in [2.0, -1.0, 0.5] {
            for u in [-2.0, 0.0, 3.0, 1.0] {
                points.push([u, a, plane(u, a)]);
            }
        }
        let map = DepthMap::new(&points).unwrap();
        for [u, a, depth] in map.points() {
            assert_eq!(map.depth(u, a), depth);
        }
        assert!((map.depth(-0.7, 0.3) - plane(-0.7, 0.3)).abs() < 1e-14);
        assert_eq!(map.depth(9.0, -9.0), plane(3.0, -1.0));
        assert!(map.covers(4.0, 2.0) && !map.covers(4.1, 2.0) && !map.covers(4.0, 2.1));
    }

    #[test]
    fn input_points_that_make_no_map_are_refused() {
        let square = [[0.0, 0.0, 0.0], [0.0, 1.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0]];
        assert!(DepthMap::new(&square).is_ok());
        let error = |points: &[[f64; 3]]| DepthMap::new(points).unwrap_err().to_string();
        assert!(error(&square[..3]).contains("no rectangle"));
        assert!(error(&square[..2]).contains("1 places up"));
        let mut twice = square.to_vec();
        twice.push([0.0, 1.0, 2.0]);
        assert!(error(&twice).contains("point 5"));
        let mut other = square;
        other[2] = [f64::NAN, 0.0, 0.0];
        assert!(error(&other).contains("not finite"));
        // As many points as places, but one twice and one missing.
        let mut skew = square;
        skew[3] = [1.0, 0.0, 0.0];
        assert!(DepthMap::new(&skew).is_err());
    }
}
