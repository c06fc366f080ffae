//! A wheel on a rail.
//!
//! Marker A is the wheel's center (where the axle meets the plane of the tape circle) with axes forward,
//! along the axle, up; marker B is the origin of the track's fixed axes, on the ground or on a sprung rail.
//! At a motion of A relative to B:
//!
//! 1. The foot of the center on the actual rail, irregularities included ([`RailLines::foot`]): the center
//!    lies in the section there, so the contact's longitudinal place is that of the silhouette alone.
//! 2. The wheel's pose and velocities in the axes of the section, which lead along the rail, tilted with it.
//!    The rail is at rest: no velocity of irregularities is added anywhere; the rate of the approach is the
//!    velocity of the wheel's material along the normal.
//! 3. Patches, normal forces with damping and creep forces ([`ContactLaw::on_wheel`]), and their wrench about
//!    A.
//!
//! Where the rail's section changes along the track, that at the distance of the foot counts, in plan along
//! the center line.
//!
//! The spin of a round wheel enters by its rate only; of one that is not round the angle that is down is
//! read from the axes of marker A, which spin with the wheel.
//!
//! **Energy.** Stored is `Σ 2/5 k d^2.5` at the pose. What the elastic normal forces take and the energy does
//! not hold is the element's work (`element_work` in the ledger): k changes with the place of a patch, shares
//! change where patches merge, and the normal of a section leaves out how the section turns along the track.
//! Losses are creep and damping; both have the sign of a loss for all creep laws whose forces oppose
//! creepages.

use std::sync::Arc;

use mechanics::element::{Element, Wrench};
use mechanics::link::RelativeMotion;
use mechanics::vector::{Matrix, Vector};
use numerics::scalar::{Dual, Real};
use wheelrail::contact::{
    ContactLaw, ContactPair, ContactPatch, ContactTable, FindPatches, PatchForces, Side, WheelMotion,
    WheelPose, stored_energy,
};
use wheelrail::hertz::Material;
use wheelrail::track::{Line, RailLines, TrackSection};

use crate::ahead::{ahead, axis_ahead};

/// The search for patches.
#[derive(Clone, Debug)]
pub enum Search {
    /// By the search.
    Exact(Arc<ContactPair>),
    /// By tables.
    Table(Arc<ContactTable>),
}

impl FindPatches for Search {
    #[inline(always)]
    fn search<S: Real>(&self, pose: &WheelPose<S>, take: impl FnMut(ContactPatch<S>)) {
        match self {
            Self::Exact(pair) => pair.search(pose, take),
            Self::Table(table) => table.search(pose, take),
        }
    }

    #[inline(always)]
    fn search_both<S: Real, T: Real>(
        &self,
        pose: &WheelPose<S>,
        other: &WheelPose<T>,
        take: impl FnMut(ContactPatch<S>),
        also: impl FnMut(ContactPatch<T>),
    ) {
        match self {
            Self::Exact(pair) => pair.search_both(pose, other, take, also),
            Self::Table(table) => table.search_both(pose, other, take, also),
        }
    }

    fn material(&self) -> Material {
        match self {
            Self::Exact(pair) => pair.material(),
            Self::Table(table) => table.material(),
        }
    }
}

/// A wheel on a rail.
#[derive(Clone, Debug)]
pub struct WheelOnRail {
    /// Its name.
    pub name: String,
    /// The rails.
    pub lines: Arc<RailLines>,
    /// The side.
    pub side: Side,
    /// Wheel and rail.
    pub search: Search,
    /// The laws of the contact.
    pub law: ContactLaw,
}

/// A patch with its forces.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PatchState {
    /// The patch, in the axes of the contact.
    pub patch: ContactPatch<f64>,
    /// Its forces, in these axes, before its share.
    pub forces: PatchForces<f64>,
    /// Its place, axes of marker B, m.
    pub place: Vector<f64>,
    /// The unit normal from the rail into the wheel, axes of marker B.
    pub normal: Vector<f64>,
}

/// Returns a pose in a section: the wheel's center, its axle (to the left) and, of one that is not round, the
/// direction that is forward at zero spin, in the fixed axes of the track.
#[inline(always)]
fn pose_in<S: Real>(
    section: &TrackSection<S>,
    side: Side,
    center: [S; 3],
    axle: [S; 3],
    forward: Option<[S; 3]>,
) -> WheelPose<S> {
    let arm = [0, 1, 2].map(|i| center[i] - section.origin[i]);
    let [_, y, z] = side.mirrored(section.of(arm));
    let left = section.of(axle);
    let axle = match side {
        Side::Left => left,
        Side::Right => left.map(|component| -component),
    };
    WheelPose {
        center: [y, z],
        axle: side.mirrored(axle),
        along: section.distance,
        angle: forward.map_or(S::zero(), |forward| angle_down(left, section.of(forward))),
    }
}

/// Returns the angle in the wheel that is down, rad, from its axle to the left and the direction that is
/// forward at zero spin, in the axes of the section.
#[inline(always)]
fn angle_down<S: Real>([x, y, z]: [S; 3], forward: [S; 3]) -> S {
    let level = ((x * x - 1.0) * -1.0).sqrt();
    let across = (y * y + z * z).sqrt();
    let sine = (forward[1] * z - forward[2] * y) / across;
    let cosine = (forward[0] * (level * level) - forward[1] * (x * y) - forward[2] * (x * z)) / level;
    let angle = libm::atan2(sine.value(), cosine.value());
    sine.chain(angle, cosine.value()) + cosine.chain(0.0, -sine.value())
}

/// The inputs of an evaluation.
pub(crate) struct Placed<S> {
    section: TrackSection<S>,
    pub(crate) pose: WheelPose<S>,
    motion: WheelMotion<S>,
    /// The pose with its change in time.
    moving: WheelPose<Dual<1>>,
}

impl WheelOnRail {
    fn line(&self) -> Line {
        match self.side {
            Side::Left => Line::Left,
            Side::Right => Line::Right,
        }
    }

    #[inline(always)]
    pub(crate) fn placed<S: Real>(&self, motion: &RelativeMotion<S>) -> Placed<S> {
        let (center, axle) = (motion.position, motion.rotation.column(1));
        let foot = self.lines.foot(self.line(), center.value().0);
        let section = foot.section(center.0);
        let [at, direction] = ahead(motion);
        let turns = self.search.pair().form().is_some();
        let forward = turns.then(|| motion.rotation.column(0).0);
        let forward_ahead = turns.then(|| axis_ahead(motion, 0));
        Placed {
            pose: pose_in(&section, self.side, center.0, axle.0, forward),
            motion: WheelMotion {
                velocity: section.of(motion.velocity.0),
                angular_velocity: section.of(motion.angular_velocity.0),
            },
            moving: pose_in(&foot.section(at), self.side, at, direction, forward_ahead),
            section,
        }
    }

    /// Gives all patches with their forces to `see`; returns the distance of the wheel along the track, m.
    pub fn patches(&self, motion: &RelativeMotion<f64>, mut see: impl FnMut(PatchState)) -> f64 {
        let placed = self.placed(motion);
        let section = &placed.section;
        self.law.on_wheel(
            &self.search,
            self.side,
            &placed.pose,
            &placed.motion,
            |patch, forces| {
                let [x, y, z] = self.side.mirrored(patch.place);
                let arm = section.fixed([x, y, z]);
                see(PatchState {
                    patch: *patch,
                    forces: *forces,
                    place: Vector([0, 1, 2].map(|i| section.origin[i] + arm[i])),
                    normal: Vector(section.fixed(self.side.mirrored(patch.normal()))),
                });
            },
        );
        section.distance
    }

    /// Returns how far (m) the wheel must be lowered until it bears on its rail: zero while it does, none
    /// where it is not over it. What a contact in the plane of the axle says: with yaw or on a rail that
    /// changes along the track it is that of the silhouette there.
    #[must_use]
    pub fn lift(&self, motion: &RelativeMotion<f64>) -> Option<f64> {
        let pose = self.placed(motion).pose;
        match &self.search {
            Search::Exact(pair) => pair.lift(&pose),
            Search::Table(table) => table.pair().lift(&pose),
        }
    }
}

impl Element for WheelOnRail {
    fn name(&self) -> &str {
        &self.name
    }

    fn does_work(&self) -> bool {
        true
    }

    #[inline(always)]
    fn evaluate<S: Real>(&self, motion: &RelativeMotion<S>) -> Wrench<S> {
        let placed = self.placed(motion);
        let (found, rate) = self.law.on_moving_wheel(
            &self.search,
            self.side,
            (&placed.pose, &placed.motion),
            &placed.moving,
        );
        Wrench {
            force: Vector(placed.section.fixed(found.force)),
            moment: Vector(placed.section.fixed(found.moment)),
            powers: [
                found.creep_power + found.damping_power,
                (found.elastic_power - rate) * -1.0,
            ],
        }
    }

    fn energy(&self, motion: &RelativeMotion<f64>) -> f64 {
        stored_energy(&self.search, &self.placed(motion).pose)
    }
}

/// Returns the motion of a wheel relative to the origin of the track's axes, from a wheelset's and a rail's
/// states: position and velocity of the origin, orientation and angular velocity of the wheelset, in fixed
/// axes; `left` (m) is the wheel's place along the axle; `axes` turns the track's axes into fixed ones.
#[must_use]
pub fn motion_of(
    wheelset: &mechanics::system::BodyState,
    left: f64,
    rail: &mechanics::system::BodyState,
    axes: Matrix<f64>,
) -> RelativeMotion<f64> {
    let marker = crate::wheelset::marker(left);
    let arm: Vector<f64> = wheelset.rotation.apply(marker.origin);
    let rotation: Matrix<f64> = wheelset.rotation.times(marker.rotation);
    let turned: Vector<f64> = wheelset.angular_velocity.cross(arm);
    RelativeMotion {
        position: axes.apply_transposed::<f64, f64>(wheelset.origin + arm - rail.origin),
        rotation: axes.transpose().times(rotation),
        velocity: axes.apply_transposed::<f64, f64>(wheelset.velocity + turned - rail.velocity),
        angular_velocity: axes.apply_transposed::<f64, f64>(wheelset.angular_velocity),
    }
}
