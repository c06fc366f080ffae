//! The seat of a wheel: on its rail, on the tip of its flange, on the edge of its rim, or beside the rail.
//!
//! By the patch that carries most: its place on the wheel's profile. A wheel without a patch is off its rail
//! if the point at which the rigid profiles are nearest lies beside the rail's section; else it is lifted,
//! and on its rail.

use mechanics::link::RelativeMotion;
use mechanics::system::Observation;
use wheelrail::contact::ContactPair;
use wheelrail::loaded::Seat;

use crate::rig::Rig;
use crate::wheel::{Search, WheelOnRail};

/// Distance to its outer edge within which a rim stands on its edge, m.
const EDGE: f64 = 1e-3;

impl Search {
    /// Returns the wheel and the rail.
    #[must_use]
    pub fn pair(&self) -> &ContactPair {
        match self {
            Self::Exact(pair) => pair,
            Self::Table(table) => table.pair(),
        }
    }
}

impl WheelOnRail {
    /// Returns the seat of the wheel, at internal states.
    #[must_use]
    pub fn seat(&self, motion: &RelativeMotion<f64>, states: [f64; 2]) -> Seat {
        let pair = self.search.pair();
        let mut most: Option<(f64, f64)> = None;
        self.patches(motion, states, |seen| {
            let normal = seen.forces.normal * seen.patch.share;
            if normal > most.map_or(0.0, |(force, _)| force) {
                most = Some((normal, seen.patch.profile));
            }
        });
        let Some((_, profile)) = most else {
            let pose = self.placed(motion, states).pose;
            let [low, high] = pair.rail_range(pose.along);
            let touch = pair.touch(&pose);
            return match touch {
                Some(touch) if (low..=high).contains(&touch.place[1]) => Seat::OnRail,
                _ => Seat::OffRail,
            };
        };
        let [_, rim] = pair.wheel_range();
        if pair.flange_crest().is_some_and(|crest| profile < crest) {
            Seat::FlangeTip
        } else if profile > rim - EDGE {
            Seat::RimEdge
        } else {
            Seat::OnRail
        }
    }
}

impl Rig {
    /// Returns the seats of the left and the right wheel; linear wheels stand on their rails always.
    #[must_use]
    pub fn seats(&self, seen: &Observation) -> [Seat; 2] {
        let Some(motions) = self.motions(seen) else {
            return [Seat::OnRail; 2];
        };
        motions.map(|(wheel, motion, states)| wheel.seat(&motion, states))
    }
}
