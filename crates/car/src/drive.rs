//! The drive of a car: a force on the car body along the track, proportional to what lacks in speed.
//!
//! Marker A is on the car body at the height of the couplers, marker B the origin of the track's fixed
//! axes. With the velocity v of A along the track where A is, and the speed V that is wanted there, `F =
//! gain (V - v)` along the track; its work is the element's.
//!
//! An element knows no time. A speed history V(t) is turned into speeds over distance: a car that follows it
//! is at `s(t) = s0 + ∫ V dt`, and V² is linear in s where V is linear in t.

use std::sync::Arc;

use mechanics::element::{Element, Wrench};
use mechanics::link::RelativeMotion;
use mechanics::vector::Vector;
use numerics::scalar::Real;
use wheelrail::track::{Line, RailLines};

/// A controller of speed.
#[derive(Clone, Debug)]
pub struct SpeedControl {
    /// The rails.
    pub lines: Arc<RailLines>,
    /// Force by speed, N·s/m.
    pub gain: f64,
    /// Distances (m, rising) and speeds (m/s); at least one pair.
    pub speeds: Vec<[f64; 2]>,
    /// The quantity that is linear in the distance between two pairs.
    pub between: Between,
}

/// The quantity that is linear in the distance.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Between {
    /// The speed.
    Speed,
    /// Its square: the acceleration is constant.
    Square,
}

/// Returns a history, pairs of time (s, from zero on, rising) and positive speed (m/s), as pairs of distance
/// (m) and speed of a car that follows it from a distance (m) at time zero.
#[must_use]
pub fn over_distance(history: &[[f64; 2]], start: f64) -> Vec<[f64; 2]> {
    let mut distance = start;
    let mut before = history.first().map_or([0.0; 2], |[_, speed]| [0.0, *speed]);
    let pairs = history.iter().map(|&[time, speed]| {
        distance += 0.5 * (before[1] + speed) * (time - before[0]);
        before = [time, speed];
        [distance, speed]
    });
    pairs.collect()
}

impl SpeedControl {
    #[inline(always)]
    fn wanted<S: Real>(&self, distance: S) -> S {
        let at = self.speeds.partition_point(|[from, _]| *from <= distance.value());
        match (
            at.checked_sub(1).map(|before| self.speeds[before]),
            self.speeds.get(at),
        ) {
            (Some([from, slow]), Some([to, fast])) => match self.between {
                Between::Speed => (distance - from) * ((fast - slow) / (to - from)) + slow,
                Between::Square => {
                    let rise = (fast * fast - slow * slow) / (to - from);
                    ((distance - from) * rise + slow * slow).sqrt()
                }
            },
            (Some([_, speed]), None) | (None, Some(&[_, speed])) => S::from(speed),
            (None, None) => S::zero(),
        }
    }
}

impl Element for SpeedControl {
    fn name(&self) -> &str {
        "drive"
    }

    fn does_work(&self) -> bool {
        true
    }

    #[inline(always)]
    fn evaluate<S: Real>(&self, motion: &RelativeMotion<S>) -> Wrench<S> {
        let section = self.lines.section(Line::Center, motion.position.0);
        let [speed, ..] = section.of(motion.velocity.0);
        let force = (self.wanted(section.distance) - speed) * self.gain;
        Wrench {
            force: Vector(section.fixed([force, S::zero(), S::zero()])),
            moment: Vector::zero(),
            powers: [S::zero(), force * speed],
        }
    }

    fn energy(&self, _: &RelativeMotion<f64>) -> f64 {
        0.0
    }
}
