//! Segments of a center line, and the reasons why they make no track.

use thiserror::Error;

use super::spiral::SpiralForm;

/// 100 ft, m: the chord of the degree of curve.
const DEGREE_CHORD: f64 = 30.48;

/// Curvature and superelevation of a curve.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct CurveElements {
    /// Curvature, 1/m: positive to the left.
    pub curvature: f64,
    /// Height of the right rail above the left one, m.
    pub superelevation: f64,
}

impl CurveElements {
    /// Returns a curve of a degree of curve (rad: the angle of a chord of 100 ft, positive to the left) and a
    /// superelevation (m).
    #[must_use]
    pub fn of_degree(degree: f64, superelevation: f64) -> Self {
        Self {
            curvature: 2.0 * libm::sin(0.5 * degree) / DEGREE_CHORD,
            superelevation,
        }
    }
}

/// A segment of a center line.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Segment {
    /// A straight piece of a length (m).
    Tangent(f64),
    /// From the curvature before it to that of the segment after it, within a length (m).
    Spiral(f64, SpiralForm),
    /// A curve of a length (m).
    Curve(f64, CurveElements),
}

/// Reasons why a track cannot be.
#[derive(Clone, Debug, PartialEq, Error)]
pub enum TrackError {
    /// There is no segment.
    #[error("a track needs at least one segment, such as a tangent")]
    Empty,
    /// A length is not positive.
    #[error("segment {segment} (from 1) is {length} m long; its length must be positive")]
    Length {
        /// The segment, from 1.
        segment: usize,
        /// Its length, m.
        length: f64,
    },
    /// Curvature or superelevation would jump.
    #[error(
        "curvature or superelevation jumps from {before:?} to {after:?} at the start of segment {segment} \
         (from 1): put a spiral between"
    )]
    Jump {
        /// The segment, from 1.
        segment: usize,
        /// Before it.
        before: CurveElements,
        /// In it.
        after: CurveElements,
    },
    /// A spiral has no segment beside it.
    #[error("segment {segment} (from 1) is a spiral {place}: it needs a tangent or a curve on both sides")]
    LooseSpiral {
        /// The segment, from 1.
        segment: usize,
        /// Its place among the segments, in words.
        place: &'static str,
    },
    /// A cubic parabola that there is not.
    #[error("segment {segment} (from 1) cannot be a cubic parabola: {reason}")]
    CubicParabola {
        /// The segment, from 1.
        segment: usize,
        /// The reason.
        reason: String,
    },
    /// Superelevation as large as the distance of the rails.
    #[error(
        "segment {segment} (from 1) has a superelevation of {superelevation} m, but its rails are \
         {distance} m apart"
    )]
    Superelevation {
        /// The segment, from 1.
        segment: usize,
        /// Its superelevation, m.
        superelevation: f64,
        /// The distance of the rails' centers, m.
        distance: f64,
    },
    /// A table of curvature and superelevation is none.
    #[error(
        "row {row} (from 1) of the center line's table is at {distance} m: rows begin at 0 m, rise, and \
         have curvatures of at most 1/m"
    )]
    Row {
        /// The row, from 1.
        row: usize,
        /// Its distance, m.
        distance: f64,
    },
    /// Places of grades do not rise, or a number is not finite.
    #[error("grade {number} (from 1) lies at {place} m, which is not beyond the one before it")]
    Grade {
        /// The grade, from 1.
        number: usize,
        /// Its place, m.
        place: f64,
    },
}
