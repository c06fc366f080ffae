//! Grids of weighted points over a face.
//!
//! A grid of n × m points covers a face from edge to edge, n up the face and m across. The weights are those
//! of the trapezoidal rule in both directions: a point stands for the part of the face that is nearest to it.
//! So four corners of a quarter each are the 2 × 2 grid, the edges of the face are points of every grid, and
//! sums over the points converge to integrals over the face with the square of the spacing. (A face of 2 × 2
//! points resists tilting three times as much as an evenly bedded one, 5 × 5 points 1.13 times as much.)
//!
//! The four corners come first, as in [`crate::outputs::CORNERS`]; the others follow row by row from the
//! lowest one, each from right to left.

use serde::{Deserialize, Serialize};

use crate::outputs::CORNERS;

/// The largest number of points in one direction of a grid.
pub const LARGEST_GRID: usize = 100;

/// Number of points of a face in both directions.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Grid {
    /// Points up the face, from its lower to its upper edge: at least 2.
    pub up: usize,
    /// Points across the face, from its right to its left edge: at least 2.
    pub across: usize,
}

impl Default for Grid {
    fn default() -> Self {
        Self { up: 2, across: 2 }
    }
}

/// A point of a grid.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GridPoint {
    /// Its row, counted from 0 at the lower edge.
    pub row: usize,
    /// Its place in the row, counted from 0 at the right edge (-y).
    pub column: usize,
    /// Its place up the face, from 0 at the lower to 1 at the upper edge.
    pub up: f64,
    /// Its place across, from -1 at the right to 1 at the left edge.
    pub across: f64,
    /// Its share of the face; the shares of a grid sum to 1.
    pub weight: f64,
}

impl Grid {
    /// Returns the number of its points.
    #[must_use]
    pub fn count(self) -> usize {
        self.up * self.across
    }

    /// Returns its points: the corners first.
    #[must_use]
    pub fn points(self) -> Vec<GridPoint> {
        let (top, left) = (self.up - 1, self.across - 1);
        let is_corner =
            |row: usize, column: usize| (row == 0 || row == top) && (column == 0 || column == left);
        let corners = [(0, 0), (0, left), (top, 0), (top, left)];
        let all = (0..self.up).flat_map(|row| (0..self.across).map(move |column| (row, column)));
        let others = all.filter(|(row, column)| !is_corner(*row, *column));
        corners
            .into_iter()
            .chain(others)
            .map(|(row, column)| self.point(row, column))
            .collect()
    }

    fn point(self, row: usize, column: usize) -> GridPoint {
        let share = |place: usize, count: usize| {
            let end = place == 0 || place == count - 1;
            let own = if end { 0.5 } else { 1.0 };
            own / (count - 1) as f64
        };
        let part = |place: usize, count: usize| place as f64 / (count - 1) as f64;
        GridPoint {
            row,
            column,
            up: part(row, self.up),
            across: 2.0 * part(column, self.across) - 1.0,
            weight: share(row, self.up) * share(column, self.across),
        }
    }

    /// Returns the names of its points in results: those of the corners, `point_R_C` for the others, with row
    /// R counted from 1 at the lower edge and place C counted from 1 at the right edge.
    #[must_use]
    pub fn names(self) -> Vec<String> {
        let points = self.points();
        points
            .iter()
            .enumerate()
            .map(|(index, point)| match CORNERS.get(index) {
                Some(corner) => (*corner).to_owned(),
                None => point.number(),
            })
            .collect()
    }
}

impl GridPoint {
    /// Returns its name by row and place, both counted from 1: `point_3_2`.
    #[must_use]
    pub fn number(&self) -> String {
        format!("point_{}_{}", self.row + 1, self.column + 1)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn analytic_weights_are_those_of_the_trapezoidal_rule() {
        let corners = Grid::default().points();
        assert_eq!(corners.len(), 4);
        assert!(corners.iter().all(|point| point.weight == 0.25));
        let places: Vec<[f64; 2]> = corners.iter().map(|point| [point.up, point.across]).collect();
        assert_eq!(places, [[0.0, -1.0], [0.0, 1.0], [1.0, -1.0], [1.0, 1.0]]);
        for (up, across) in [(2, 3), (5, 5), (9, 2), (41, 4)] {
            let grid = Grid { up, across };
            let points = grid.points();
            assert_eq!(points.len(), grid.count());
            let sum = |f: &dyn Fn(&GridPoint) -> f64| points.iter().map(|p| p.weight * f(p)).sum::<f64>();
            assert!((sum(&|_| 1.0) - 1.0).abs() < 1e-14);
            assert!((sum(&|p| p.up) - 0.5).abs() < 1e-14);
            assert!(sum(&|p| p.across).abs() < 1e-14);
            // The mean of s² over -1..1 is 1/3; the rule is off by the square of the spacing over 6.
            let h = 2.0 / (across - 1) as f64;
            let square = sum(&|p| p.across * p.across);
            assert!((square - 1.0 / 3.0 - h * h / 6.0).abs() < 1e-13);
        }
    }

    #[test]
    fn limits_names_of_points_are_unique_and_corners_come_first() {
        let grid = Grid { up: 4, across: 3 };
        let names = grid.names();
        assert_eq!(
            names[..5],
            [
                "lower_right",
                "lower_left",
                "upper_right",
                "upper_left",
                "point_1_2"
            ]
        );
        let unique: std::collections::BTreeSet<&String> = names.iter().collect();
        assert_eq!(unique.len(), 12);
        let numbers: std::collections::BTreeSet<String> =
            grid.points().iter().map(GridPoint::number).collect();
        assert_eq!(numbers.len(), 12);
    }
}
