//! The grid of a table: values along its directions, and multilinear interpolation between its nodes.
//!
//! At a point `x` the value is the sum of those of the corners of the cell that holds it, each times the
//! product over the directions of `1 - s` or `s`, with `s = (x - a) / (b - a)` between the values a and b
//! around x. At a node one weight is 1 and the others are left out: the node's own value comes back to the
//! last bit. A direction of one value is a constant: it has that value everywhere.

use quantity::Kind;
use serde::{Deserialize, Serialize};

/// A direction of the grid.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Direction {
    /// What the coils of a nest carry at zero stroke, N.
    Load,
    /// Rise of all wedges in their pockets, m.
    Rise,
    /// Coefficient of friction of all wedges on column and slope.
    Friction,
    /// Angular frequency of the imposed motion, a sine, rad/s.
    Rate,
}

impl Direction {
    /// All of them, in the order of a [`Point`].
    pub const ALL: [Self; 4] = [Self::Load, Self::Rise, Self::Friction, Self::Rate];

    /// Returns its name, which is that of its option.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Load => "load",
            Self::Rise => "rise",
            Self::Friction => "friction",
            Self::Rate => "rate",
        }
    }

    /// Returns the kind of its values.
    #[must_use]
    pub fn kind(self) -> Kind {
        match self {
            Self::Load => Kind::Force,
            Self::Rise => Kind::Length,
            Self::Friction => Kind::Dimensionless,
            Self::Rate => Kind::Frequency,
        }
    }
}

/// Values of load, rise, friction and rate, SI.
pub type Point = [f64; 4];

/// The grid.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Grid {
    /// Strictly increasing values along each direction, SI; at least one each.
    pub values: [Vec<f64>; 4],
}

/// A point outside the grid.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[error(
    "the {} {value} (SI) lies outside the table, which goes from {} to {}",
    .direction.name(), .ends[0], .ends[1]
)]
pub struct OutsideGrid {
    /// The direction.
    pub direction: Direction,
    /// The value, SI.
    pub value: f64,
    /// The ends of the table, SI.
    pub ends: [f64; 2],
}

/// A node of the grid by its number, with its weight.
pub type Weight = (usize, f64);

impl Grid {
    /// Returns the number of its nodes.
    #[must_use]
    pub fn count(&self) -> usize {
        self.values.iter().map(Vec::len).product()
    }

    /// Returns a node by its places along the directions.
    fn number(&self, places: [usize; 4]) -> usize {
        let steps = places.iter().zip(&self.values);
        steps.fold(0, |number, (place, values)| number * values.len() + place)
    }

    /// Returns the node of a number; the last direction changes fastest.
    #[must_use]
    pub fn node(&self, number: usize) -> Point {
        let mut rest = number;
        let mut point = [0.0; 4];
        for (value, values) in point.iter_mut().zip(&self.values).rev() {
            *value = values[rest % values.len()];
            rest /= values.len();
        }
        point
    }

    /// Returns the nodes.
    pub fn nodes(&self) -> impl Iterator<Item = Point> {
        (0..self.count()).map(|number| self.node(number))
    }

    /// Returns the directions of more than one value: the others are constants.
    pub fn varied(&self) -> impl Iterator<Item = Direction> {
        let all = Direction::ALL.into_iter().zip(&self.values);
        all.filter(|(_, values)| values.len() > 1)
            .map(|(direction, _)| direction)
    }

    /// Returns the nearest point within the grid; a constant direction takes its own value.
    #[must_use]
    pub fn clamped(&self, at: Point) -> Point {
        let mut within = at;
        for (value, values) in within.iter_mut().zip(&self.values) {
            *value = value.clamp(values[0], values[values.len() - 1]);
        }
        within
    }

    /// Returns the nodes around a point with their weights, which sum to one; nodes without weight are left
    /// out.
    ///
    /// # Errors
    /// The point lies outside the grid, or off the value of a constant direction.
    pub fn weights(&self, at: Point) -> Result<Vec<Weight>, OutsideGrid> {
        let mut corners = vec![([0; 4], 1.0)];
        for (k, (values, value)) in self.values.iter().zip(at).enumerate() {
            let ends = [values[0], values[values.len() - 1]];
            if !(ends[0]..=ends[1]).contains(&value) {
                let direction = Direction::ALL[k];
                return Err(OutsideGrid {
                    direction,
                    value,
                    ends,
                });
            }
            let above = values.partition_point(|own| *own < value);
            let mut next = Vec::with_capacity(2 * corners.len());
            for (places, weight) in corners {
                let mut add = |place: usize, share: f64| {
                    let mut places: [usize; 4] = places;
                    places[k] = place;
                    next.push((places, weight * share));
                };
                if values[above] == value {
                    add(above, 1.0);
                } else {
                    let share = (value - values[above - 1]) / (values[above] - values[above - 1]);
                    add(above - 1, 1.0 - share);
                    add(above, share);
                }
            }
            corners = next;
        }
        let numbered = corners.into_iter();
        Ok(numbered
            .map(|(places, weight)| (self.number(places), weight))
            .collect())
    }

    /// Returns the node in the middle of the lists; of two it is the upper one.
    #[must_use]
    pub fn middle(&self) -> Point {
        let middle = |values: &Vec<f64>| values[values.len() / 2];
        self.values.each_ref().map(middle)
    }
}
