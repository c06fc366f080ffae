//! The springs of a carriage that runs along the track over a wheelset: lateral and yaw springs to the
//! track's direction, a load, and a drive that holds the speed. A rig for single wheelsets and small models;
//! a car has bodies instead.
//!
//! Marker A is the wheelset's center with axes forward, along the axle, up; marker B is the origin of the
//! track's fixed axes. The carriage stays over the foot of the center on the center line and turns with the
//! track. What it puts in (its drive, the work of its load, of its turning) is the element's work.

use std::sync::Arc;

use mechanics::element::{Element, Wrench};
use mechanics::link::RelativeMotion;
use mechanics::vector::Vector;
use numerics::scalar::Real;
use wheelrail::track::{Line, RailLines, TrackSection};

use crate::ahead::ahead;

/// Springs, load and drive of a carriage.
#[derive(Clone, Debug)]
pub struct Carriage {
    /// Its name.
    pub name: String,
    /// The track.
    pub lines: Arc<RailLines>,
    /// Lateral stiffness, N/m, and yaw stiffness, N·m/rad.
    pub stiffness: [f64; 2],
    /// Lateral damping, N·s/m, and yaw damping, N·m·s/rad.
    pub damping: [f64; 2],
    /// Load on the wheelset, square to the track, N.
    pub load: f64,
    /// Speed, m/s.
    pub speed: f64,
    /// Force of the drive by the speed's error, N·s/m.
    pub drive: f64,
}

/// The wheelset in the axes of the section.
struct Seen<S> {
    section: TrackSection<S>,
    /// To the left of the center line, m.
    lateral: S,
    /// The axle.
    axle: [S; 3],
}

impl Carriage {
    #[inline(always)]
    fn seen<S: Real>(&self, center: [S; 3], axle: [S; 3]) -> Seen<S> {
        let section = self.lines.section(Line::Center, center);
        let [_, lateral, _] = section.of([0, 1, 2].map(|i| center[i] - section.origin[i]));
        let axle = section.of(axle);
        Seen {
            section,
            lateral,
            axle,
        }
    }

    #[inline(always)]
    fn stored<S: Real>(&self, seen: &Seen<S>) -> S {
        let [lateral, yaw] = self.stiffness;
        let forward = seen.axle[0];
        (seen.lateral * seen.lateral * lateral + forward * forward * yaw) * 0.5
    }
}

impl Element for Carriage {
    fn name(&self) -> &str {
        &self.name
    }

    fn does_work(&self) -> bool {
        true
    }

    #[inline(always)]
    fn evaluate<S: Real>(&self, motion: &RelativeMotion<S>) -> Wrench<S> {
        let axle = motion.rotation.column(1);
        let seen = self.seen(motion.position.0, axle.0);
        let section = &seen.section;
        let velocity = section.of(motion.velocity.0);
        let angular_velocity = section.of(motion.angular_velocity.0);
        // The yaw is minus the axle's forward part; its rate relative to the track, without that of the
        // heading.
        let [forward, left, _] = seen.axle;
        let turning = velocity[0] * -section.curvature + angular_velocity[2];
        let [lateral, yaw] = self.stiffness;
        let [lateral_damping, yaw_damping] = self.damping;
        let force = [
            (velocity[0] - self.speed) * -self.drive,
            -(seen.lateral * lateral) - velocity[1] * lateral_damping,
            S::from(-self.load),
        ];
        let couple = forward * left * yaw - turning * yaw_damping;
        let moment = [S::zero(), S::zero(), couple];
        let wrench_force = Vector(section.fixed(force));
        let wrench_moment = Vector(section.fixed(moment));
        let loss = velocity[1] * velocity[1] * lateral_damping + turning * turning * yaw_damping;
        let power: S =
            wrench_force.dot::<S, S>(motion.velocity) + wrench_moment.dot::<S, S>(motion.angular_velocity);
        // The rate of what is stored, along the motion.
        let [place, direction] = ahead(motion);
        let moving = self.seen(place, direction);
        Wrench {
            force: wrench_force,
            moment: wrench_moment,
            powers: [loss, power + loss + self.stored(&moving).derivative[0]],
        }
    }

    fn energy(&self, motion: &RelativeMotion<f64>) -> f64 {
        self.stored(&self.seen(motion.position.0, motion.rotation.column(1).0))
    }
}
