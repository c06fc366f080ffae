//! When a wheel has left its rail.

use wheelrail::profile::SlicedProfile;
use wheelrail::track::Track;

use crate::loads::Loads;

/// A wheelset this far from the middle of the rails has a wheel with its flange on top of the rail or beyond,
/// m: the flange's clearance of 3/8 in, and from its face to its tip 7/8 in; 1 1/4 in with nominal profiles.
const ON_TOP: f64 = 1.25 * 0.0254;
/// A wheelset this far below its height on the rails has fallen between them, m.
const FALLEN: f64 = 1.5 * 0.0254;

/// The place at which a wheel has left its rail.
#[derive(Clone, Debug, PartialEq)]
pub struct Derailment {
    /// Axle from the front, from 0.
    pub axle: usize,
    /// 0 left, 1 right.
    pub side: usize,
    /// Along the track, m.
    pub distance: f64,
    /// A description of the derailment.
    pub what: String,
}

impl Derailment {
    /// Returns it in words; `at` is the place along the track with its unit.
    #[must_use]
    pub fn words(&self, at: &str) -> String {
        let (side, axle) = (["left", "right"][self.side], self.axle + 1);
        format!(
            "the {side} wheel of axle {axle} left its rail at {at}: {}",
            self.what
        )
    }

    /// Returns the first wheel from the front that has left its rail; `heights` are those of the axles at the
    /// start, m, and `over` rails whose sections change along the track.
    #[must_use]
    pub fn of(
        loads: &Loads,
        track: &Track,
        over: [Option<&SlicedProfile>; 2],
        heights: [f64; 4],
    ) -> Option<Self> {
        loads.axles.iter().enumerate().find_map(|(axle, own)| {
            let sunk = heights[axle] - own.height;
            // Most axles are nowhere near: where the rails lie takes a sum over the waves of their spectra.
            if own.lateral.abs() < 0.8 * ON_TOP && sunk < 0.8 * FALLEN {
                return None;
            }
            let [left, right] = track.rails(own.distance);
            let (to_left, to_right) = (own.lateral - left.lateral[0], right.lateral[0] - own.lateral);
            let rise = over.map(|rail| rail.map_or(0.0, |rail| rail.top_at(own.distance)));
            let sunk = sunk + 0.5 * (left.vertical[0] + rise[0] + right.vertical[0] + rise[1]);
            let (side, beyond) = if to_left > to_right {
                (0, to_left)
            } else {
                (1, to_right)
            };
            let what = if beyond > ON_TOP {
                format!(
                    "the axle is {:.2} in from the middle of that rail's track, so that the flange is on top \
                     of the rail",
                    beyond / 0.0254
                )
            } else if sunk > FALLEN {
                format!("the axle has fallen by {:.2} in", sunk / 0.0254)
            } else {
                return None;
            };
            Some(Self {
                axle,
                side,
                distance: own.distance,
                what,
            })
        })
    }
}
