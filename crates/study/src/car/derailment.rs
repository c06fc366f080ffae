//! Static wheel loads, and when a wheel has left its rail.

use car::{Loads, Parameters, Wheels};
use wheelrail::track::Track;

use super::statistics::SIDES;

/// A wheelset this far from the middle of the rails has a wheel with its flange on top of the rail or beyond,
/// m: the flange's clearance of 3/8 in, and from its face to its tip 7/8 in; 1 1/4 in with nominal profiles.
const ON_TOP: f64 = 1.25 * 0.0254;
/// A wheelset this far below its height on the rails has fallen between them, m.
const FALLEN: f64 = 1.5 * 0.0254;

/// The place at which a wheel has left its rail.
pub(super) struct Left {
    /// Axle from the front, from 0.
    pub axle: usize,
    /// 0 left, 1 right.
    pub side: usize,
    /// Along the track, m.
    pub distance: f64,
    /// A description of the derailment.
    pub what: String,
}

impl Left {
    /// Returns it in words; `at` is the place along the track with its unit.
    pub fn words(&self, at: &str) -> String {
        let (side, axle) = (SIDES[self.side], self.axle + 1);
        format!(
            "the {side} wheel of axle {axle} left its rail at {at}: {}",
            self.what
        )
    }
}

/// Returns the first wheel from the front that has left its rail; `heights` are those of the axles at the
/// start, m.
pub(super) fn of(loads: &Loads, track: &Track, heights: [f64; 4]) -> Option<Left> {
    loads.axles.iter().enumerate().find_map(|(axle, own)| {
        let sunk = heights[axle] - own.height;
        // Most axles are nowhere near: where the rails lie takes a sum over the waves of their spectra.
        if own.lateral.abs() < 0.8 * ON_TOP && sunk < 0.8 * FALLEN {
            return None;
        }
        let [left, right] = track.rails(own.distance);
        let (to_left, to_right) = (own.lateral - left.lateral[0], right.lateral[0] - own.lateral);
        let sunk = sunk + 0.5 * (left.vertical[0] + right.vertical[0]);
        let (side, beyond) = if to_left > to_right {
            (0, to_left)
        } else {
            (1, to_right)
        };
        let what = if beyond > ON_TOP {
            format!(
                "the axle is {:.2} in from the middle of that rail's track, so that the flange is on top of \
                 the rail",
                beyond / 0.0254
            )
        } else if sunk > FALLEN {
            format!("the axle has fallen by {:.2} in", sunk / 0.0254)
        } else {
            return None;
        };
        Some(Left {
            axle,
            side,
            distance: own.distance,
            what,
        })
    })
}

/// Returns the static loads of the wheels on level track by axle from the front, left and right, N: each axle
/// carries half of its truck, and the body by the place of its center of gravity.
pub(super) fn static_loads(parameters: &Parameters) -> [[f64; 2]; 4] {
    let [forward, left, _] = parameters.center_of_gravity();
    let half = match &parameters.wheels {
        Wheels::OnRails(own) => 0.5 * own.tape_distance,
        Wheels::Linear { wheelset, .. } => wheelset.geometry.half_distance,
    };
    let gravity = parameters.gravity;
    [0, 1, 2, 3].map(|axle| {
        let truck = axle / 2;
        let own = &parameters.trucks[truck];
        let frames: f64 = own.side_frames.iter().map(|frame| frame.body.mass).sum();
        let share = 0.5 + [forward, -forward][truck] / parameters.truck_distance;
        let carried = 0.5 * share * parameters.carried_mass() * gravity;
        let rest =
            (0.5 * (own.bolster.body.mass + own.wedge_mass() + frames) + parameters.wheelset.mass) * gravity;
        [1.0, -1.0].map(|side| 0.5 * (carried * (1.0 + side * left / half) + rest))
    })
}
