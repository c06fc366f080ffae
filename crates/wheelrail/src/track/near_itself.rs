//! Check that a track does not come back near itself, where places do not determine distances.

use super::center_line::CenterLine;
use super::rails::{CLOSE, STRIDE};

/// Least distance in plan between parts of a track, m: a foot is looked for from places within 5 m, and
/// wheels that run on the track lie within 1 m of its center line.
pub const CLEARANCE: f64 = CLOSE + 1.0;

impl CenterLine {
    /// Returns two distances (m, in steps of 2 m) whose places lie within [`CLEARANCE`] of each other though
    /// the center line has left these surroundings between them: a crossing, a loop, a closed lap. `None`
    /// where there are none: then every place on the track has one foot, which
    /// [`RailLines`](super::RailLines) finds.
    ///
    /// Parts beyond start and end are not considered.
    #[must_use]
    pub fn near_itself(&self) -> Option<[f64; 2]> {
        let count = (self.length() / STRIDE).ceil() as usize + 1;
        let distance = |number: usize| (number as f64 * STRIDE).min(self.length());
        let places: Vec<[f64; 2]> = (0..count)
            .map(|number| {
                let [x, y, _] = self.at(distance(number)).position;
                [x, y]
            })
            .collect();
        for (number, place) in places.iter().enumerate() {
            let away = |other: usize| {
                let [x, y] = places[other];
                libm::hypot(x - place[0], y - place[1])
            };
            let mut other = number;
            let mut left = false;
            while other < count {
                let gap = away(other);
                if left && gap <= CLEARANCE {
                    return Some([number, other].map(distance));
                }
                left |= gap > CLEARANCE;
                // As far as the gap lets nothing be missed.
                other += (((gap - CLEARANCE) / STRIDE) as usize).max(1);
            }
        }
        None
    }
}
