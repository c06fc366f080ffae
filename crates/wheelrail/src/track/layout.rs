//! A track: its center line, and where each rail lies beside its nominal place.

use super::center_line::CenterLine;
use super::samples::Samples;
use super::shape::Shape;
use super::spectrum::Realization;

/// The rails that have an irregularity.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Rails {
    /// The left rail.
    Left,
    /// The right rail.
    Right,
    /// Both alike.
    Both,
    /// Both with half of it, the right one with the other sign: cross level, gauge.
    Against,
}

/// The direction of an irregularity.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Direction {
    /// To the left.
    Lateral,
    /// Up.
    Vertical,
}

/// An irregularity over the distance.
#[derive(Clone, Debug, PartialEq)]
pub enum Irregularity {
    /// A shape.
    Shape(Shape),
    /// A realization of a spectrum.
    Spectrum(Realization),
    /// Values at distances, such as measured ones.
    Samples(Samples),
}

/// An irregularity of a track.
#[derive(Clone, Debug, PartialEq)]
pub struct Placed {
    /// On which rails.
    pub rails: Rails,
    /// In which direction.
    pub direction: Direction,
    /// The irregularity.
    pub irregularity: Irregularity,
}

/// A track.
#[derive(Clone, Debug, PartialEq)]
pub struct Track {
    /// Its center line.
    pub center_line: CenterLine,
    /// Its irregularities, which are added up.
    pub irregularities: Vec<Placed>,
}

/// Deviation of a rail from its nominal position: value (m), slope and second derivative (1/m) by distance.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct RailPlace {
    /// To the left.
    pub lateral: [f64; 3],
    /// Up.
    pub vertical: [f64; 3],
}

impl Track {
    /// Returns the displacements of the left and the right rail at a distance (m).
    #[must_use]
    pub fn rails(&self, distance: f64) -> [RailPlace; 2] {
        let mut rails = [RailPlace::default(); 2];
        for placed in &self.irregularities {
            let value = match &placed.irregularity {
                Irregularity::Shape(shape) => shape.at(distance),
                Irregularity::Spectrum(realization) => realization.at(distance),
                Irregularity::Samples(samples) => samples.at(distance),
            };
            let factors = match placed.rails {
                Rails::Left => [1.0, 0.0],
                Rails::Right => [0.0, 1.0],
                Rails::Both => [1.0, 1.0],
                Rails::Against => [0.5, -0.5],
            };
            for (rail, factor) in rails.iter_mut().zip(factors) {
                let own = match placed.direction {
                    Direction::Lateral => &mut rail.lateral,
                    Direction::Vertical => &mut rail.vertical,
                };
                for (sum, value) in own.iter_mut().zip(value) {
                    *sum += factor * value;
                }
            }
        }
        rails
    }
}
