//! Track: its center line, and what inspectors measure of irregularities.
//!
//! Distance s along the track is measured in plan, from its start. Curvature is positive in curves to the
//! left, superelevation is positive where the right rail is raised (the outer rail of a curve to the left).
//! Axes: x and y in plan, z up; at the start the track leads along x at the origin.

pub mod center_line;
pub mod chord;
pub mod class;
pub mod class_limits;
mod columns;
pub mod gaps;
pub mod layout;
pub mod measured;
mod measured_error;
mod near_itself;
pub mod rails;
pub mod rational;
mod recording;
pub mod samples;
mod segments;
pub mod shape;
pub mod spectrum;
pub mod spiral;
pub mod stations;

pub use center_line::{CenterLine, Station};
pub use class::{ClassValue, TrackClass};
pub use columns::{ColumnKind, NamedColumn};
pub use gaps::{Gap, LONGEST_GAP};
pub use layout::{Direction, Irregularity, Placed, RailPlace, Rails, Track};
pub use measured::{Form, MeasuredTable};
pub use measured_error::MeasuredError;
pub use near_itself::CLEARANCE;
pub use rails::{Foot, Line, RailLines, TrackSection};
pub use recording::Reading;
pub use samples::Samples;
pub use segments::{CurveElements, Segment, TrackError};
pub use spiral::SpiralForm;
pub use stations::{Running, StationEquation};
