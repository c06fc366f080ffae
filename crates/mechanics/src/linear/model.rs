//! The linear model of a system about a state.

use nalgebra::Complex;

use super::{Equivalent, SecondOrder, Slider};

/// Where a slider is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SliderPlace {
    /// At a point of a face, both by their numbers in [`System::faces`](crate::system::System::faces).
    Point {
        /// The face.
        face: usize,
        /// The point.
        point: usize,
    },
    /// In a connection, by its number.
    Connection(usize),
}

/// A number with its place among the coordinates.
pub(crate) type Entry = (usize, f64);

/// A slider in the two directions of a surface.
#[derive(Clone, Debug)]
pub struct SlidingPair {
    /// Where it is.
    pub place: SliderPlace,
    /// Its properties; the limit is that of the normal force in the state.
    pub slider: Slider,
    /// Slip in both directions by the coordinates.
    pub(crate) slip: [Vec<Entry>; 2],
    /// Generalized force on the coordinates of a unit of friction that goes with positive slip.
    pub(crate) force: [Vec<Entry>; 2],
}

impl SlidingPair {
    /// Returns the larger semi-axis of the ellipse that the slip describes in a harmonic motion of this
    /// shape, m.
    #[must_use]
    pub fn amplitude(&self, shape: &[Complex<f64>]) -> f64 {
        let [a, b] = self.slip.each_ref().map(|row| {
            let terms = row.iter().map(|(place, by)| shape[*place] * *by);
            terms.sum::<Complex<f64>>()
        });
        let squares = a * a + b * b;
        (0.5 * (a.norm_sqr() + b.norm_sqr() + squares.norm())).sqrt()
    }
}

/// The matrices of the motion about a state; see the head of [`crate::linear`].
#[derive(Clone, Debug)]
pub struct LinearModel {
    /// Mass matrix, stiffness and damping without friction.
    pub without_friction: SecondOrder,
    /// The sliders of all closed contacts with bristles. Friction without them (tanh) is a damper of
    /// [`LinearModel::without_friction`] at any amplitude.
    pub sliders: Vec<SlidingPair>,
}

/// Angular frequency of what is held, 1/s: far above all that is looked for.
const HELD: f64 = 1e5;

impl LinearModel {
    /// Holds coordinates: nothing moves them, and their motion moves nothing. They keep their places, each
    /// with a vibration of its own, 1e5 rad/s, that is no part of the system.
    pub fn hold(&mut self, places: &[usize]) {
        let own = &mut self.without_friction;
        for &place in places {
            for matrix in [&mut own.mass, &mut own.stiffness, &mut own.damping] {
                matrix.row_mut(place).fill(0.0);
                matrix.column_mut(place).fill(0.0);
            }
            own.mass[(place, place)] = 1.0;
            own.stiffness[(place, place)] = -HELD * HELD;
        }
        for pair in &mut self.sliders {
            for row in pair.slip.iter_mut().chain(&mut pair.force) {
                row.retain(|(place, _)| !places.contains(place));
            }
        }
    }

    /// Returns the matrices with these stiffnesses and dampings of the sliders, in their order.
    #[must_use]
    pub fn with(&self, sliders: impl IntoIterator<Item = Equivalent>) -> SecondOrder {
        let mut own = self.without_friction.clone();
        for (pair, equivalent) in self.sliders.iter().zip(sliders) {
            if equivalent == Equivalent::NONE {
                continue;
            }
            for (force, slip) in pair.force.iter().zip(&pair.slip) {
                for (row, f) in force {
                    for (column, g) in slip {
                        let at = (*row, *column);
                        own.stiffness[at] += f * g * equivalent.stiffness;
                        own.damping[at] += f * g * equivalent.damping;
                    }
                }
            }
        }
        own
    }
}
