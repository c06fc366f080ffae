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
//! **Roll of the rail.** Where the rail rolls under the wheel ([`RailRoll`]), the roll θ is an internal state
//! of the element: outwards about an axis along the rail, which lies `base` to the field side of the
//! profile's origin and `height` below it. Marker B is then the base, the section is turned by θ about that
//! axis, velocities are those relative to the head, and
//!
//! ```text
//! J θ¨ = M - k θ - c θ˙,   M: moment of the wheel's forces on the rail about the axis.
//! ```
//!
//! States are `height θ` and `height θ˙` times 1 ms.
//!
//! **Energy.** Stored is `Σ 2/5 k d^2.5` at the pose. What the elastic normal forces take and the energy does
//! not hold is the element's work (`element_work` in the ledger): k changes with the place of a patch, shares
//! change where patches merge, and the normal of a section leaves out how the section turns along the track.
//! Losses are creep and damping; both have the sign of a loss for all creep laws whose forces oppose
//! creepages.

use std::sync::Arc;

use mechanics::element::{Element, Wrench};
use mechanics::link::{Marker, RelativeMotion};
use mechanics::system::{Model, Observation};
use mechanics::vector::{Matrix, Vector};
use numerics::scalar::{Dual, Number, Real};
use wheelrail::contact::{
    ContactLaw, ContactPair, ContactPatch, ContactTable, FindPatches, PatchForces, Side, StripLoads,
    WheelMotion, WheelPose, stored_energy,
};
use wheelrail::hertz::Material;
use wheelrail::track::{Line, RailLines, TrackSection};

use crate::ahead::{ahead, axis_ahead};
use crate::beam::RailRoll;

/// The time whose way stands for a rate among internal states, s.
const WAY: f64 = 1e-3;

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
    fn find<S: Real>(&self, pose: &WheelPose<S>, take: impl FnMut(ContactPatch<S>, Option<&StripLoads<S>>)) {
        match self {
            Self::Exact(pair) => pair.find(pose, take),
            Self::Table(table) => table.find(pose, take),
        }
    }

    #[inline(always)]
    fn find_both<S: Real, T: Real>(
        &self,
        pose: &WheelPose<S>,
        other: &WheelPose<T>,
        take: impl FnMut(ContactPatch<S>, Option<&StripLoads<S>>),
        also: impl FnMut(ContactPatch<T>),
    ) {
        match self {
            Self::Exact(pair) => pair.find_both(pose, other, take, also),
            Self::Table(table) => table.find_both(pose, other, take, also),
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
    /// How the rail rolls under it; none: not at all.
    pub roll: Option<RailRoll>,
}

/// A wheel among the elements of a system.
#[derive(Clone, Debug)]
pub struct WheelElement {
    /// The wheel.
    pub wheel: WheelOnRail,
    /// Its number among the elements.
    number: usize,
}

impl WheelElement {
    /// Adds a wheel between markers on a wheelset and on what the rail is.
    #[must_use]
    pub fn add(model: &mut Model, wheel: WheelOnRail, on: (usize, Marker), rail: (usize, Marker)) -> Self {
        let number = model.elements.len();
        model.add(wheel.clone(), on, rail);
        Self { wheel, number }
    }

    /// Returns its internal states at an observation of the system.
    #[must_use]
    pub fn states(&self, seen: &Observation) -> [f64; 2] {
        seen.elements[self.number].states
    }
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
    /// Greatest pressure, Pa: of Hertz's ellipse, or on the strips of a patch that is none.
    pub greatest_pressure: f64,
    /// What creep takes by the distance, N: creep forces times creepages, with the patch's share.
    pub wear_number: f64,
    /// The speed that creepages are relative to, m/s.
    pub speed: f64,
    /// Friction where it slides.
    pub friction: f64,
}

impl PatchState {
    /// Returns the power that creep takes, W.
    #[must_use]
    pub fn power(&self) -> f64 {
        self.wear_number * self.speed
    }
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

/// Returns a section that is rolled outwards, by the sine and the cosine of the angle.
#[inline(always)]
fn rolled<S: Real>(
    section: TrackSection<S>,
    side: Side,
    own: &RailRoll,
    (sine, cosine): (S, S),
) -> TrackSection<S> {
    let [along, left, up] = section.axes;
    let out = match side {
        Side::Left => left,
        Side::Right => left.map(|component| -component),
    };
    let turned_out = [0, 1, 2].map(|i| out[i] * cosine - up[i] * sine);
    let turned_up = [0, 1, 2].map(|i| out[i] * sine + up[i] * cosine);
    let moved = |i: usize| (out[i] - turned_out[i]) * own.base + (turned_up[i] - up[i]) * own.height;
    TrackSection {
        origin: [0, 1, 2].map(|i| section.origin[i] + moved(i)),
        axes: [
            along,
            match side {
                Side::Left => turned_out,
                Side::Right => turned_out.map(|component| -component),
            },
            turned_up,
        ],
        ..section
    }
}

/// The inputs of an evaluation.
pub(crate) struct Placed<S> {
    section: TrackSection<S>,
    /// The axes of the section of a rail that has not rolled.
    unrolled: [[S; 3]; 3],
    /// Marker A to the left and above the axis about which the rail rolls.
    arm: [S; 2],
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

    /// Returns the roll of the rail (rad, outwards) and its rate from internal states.
    #[must_use]
    pub fn rail_roll(&self, states: [f64; 2]) -> [f64; 2] {
        self.roll.map_or([0.0; 2], |own| {
            [states[0] / own.height, states[1] / (WAY * own.height)]
        })
    }

    #[inline(always)]
    pub(crate) fn placed<S: Real>(&self, motion: &RelativeMotion<S>, states: [S; 2]) -> Placed<S> {
        let (center, axle) = (motion.position, motion.rotation.column(1));
        let foot = self.lines.foot(self.line(), center.value().0);
        let [at, direction] = ahead(motion);
        let turns = self.search.pair().form().is_some();
        let forward = turns.then(|| motion.rotation.column(0).0);
        let forward_ahead = turns.then(|| axis_ahead(motion, 0));
        let (mut section, mut section_ahead) = (foot.section(center.0), foot.section(at));
        let (mut velocity, mut angular_velocity) = (motion.velocity.0, motion.angular_velocity.0);
        let (unrolled, mut arm) = (section.axes, [S::zero(); 2]);
        if let Some(own) = &self.roll {
            let [angle, rate] = [
                states[0] * (1.0 / own.height),
                states[1] * (1.0 / (WAY * own.height)),
            ];
            let sign = self.sign();
            let [_, left, up] = section.of([0, 1, 2].map(|i| center.0[i] - section.origin[i]));
            arm = [left + -sign * own.base, up + own.height];
            // The head turns about the axis: relative to it the wheel moves the other way.
            let [along, across, above] = unrolled;
            for i in 0..3 {
                velocity[i] -= (across[i] * arm[1] - above[i] * arm[0]) * (rate * sign);
                angular_velocity[i] += along[i] * (rate * sign);
            }
            section = rolled(section, self.side, own, angle.sin_cos());
            let moving = Dual {
                value: angle.value(),
                derivative: [rate.value()],
            };
            section_ahead = rolled(section_ahead, self.side, own, moving.sin_cos());
        }
        Placed {
            pose: pose_in(&section, self.side, center.0, axle.0, forward),
            motion: WheelMotion {
                velocity: section.of(velocity),
                angular_velocity: section.of(angular_velocity),
            },
            moving: pose_in(&section_ahead, self.side, at, direction, forward_ahead),
            section,
            unrolled,
            arm,
        }
    }

    /// Returns 1 on the left, -1 on the right.
    fn sign(&self) -> f64 {
        match self.side {
            Side::Left => 1.0,
            Side::Right => -1.0,
        }
    }

    /// Gives all patches with their forces to `see`, at internal states; returns the distance of the wheel
    /// along the track, m.
    pub fn patches(
        &self,
        motion: &RelativeMotion<f64>,
        states: [f64; 2],
        mut see: impl FnMut(PatchState),
    ) -> f64 {
        let placed = self.placed(motion, states);
        let section = &placed.section;
        self.law.on_wheel_by_strips(
            &self.search,
            self.side,
            &placed.pose,
            &placed.motion,
            |patch, forces, strips| {
                let [x, y, z] = self.side.mirrored(patch.place);
                let arm = section.fixed([x, y, z]);
                let (own, slip) = (&forces.creep, &forces.creepage);
                let lost = own.x * slip.longitudinal + own.y * slip.lateral + own.spin_moment * slip.spin;
                let [forward, ..] = placed.motion.velocity;
                let speed = libm::hypot(forward, self.law.slowest);
                let sliding = [slip.longitudinal * speed, slip.lateral * speed];
                see(PatchState {
                    greatest_pressure: forces.greatest_pressure(strips),
                    wear_number: -lost * patch.share,
                    speed,
                    friction: self.law.friction.at(patch.slope, placed.pose.along, sliding),
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
    pub fn lift(&self, motion: &RelativeMotion<f64>, states: [f64; 2]) -> Option<f64> {
        let pose = self.placed(motion, states).pose;
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

    fn has_states(&self) -> bool {
        self.roll.is_some()
    }

    #[inline(always)]
    fn evaluate<S: Real>(&self, motion: &RelativeMotion<S>) -> Wrench<S> {
        self.evaluate_with(motion, [S::zero(); 2]).0
    }

    #[inline(always)]
    fn evaluate_with<S: Real>(&self, motion: &RelativeMotion<S>, states: [S; 2]) -> (Wrench<S>, [S; 2]) {
        let placed = self.placed(motion, states);
        let (found, rate) = self.law.on_moving_wheel(
            &self.search,
            self.side,
            (&placed.pose, &placed.motion),
            &placed.moving,
        );
        let mut wrench = Wrench {
            force: Vector(placed.section.fixed(found.force)),
            moment: Vector(placed.section.fixed(found.moment)),
            powers: [
                found.creep_power + found.damping_power,
                (found.elastic_power - rate) * -1.0,
            ],
        };
        let Some(own) = &self.roll else {
            return (wrench, [S::zero(); 2]);
        };
        // What the wheel does to the rail about the axis, outwards: arms are square to the line.
        let [along, left, up] = placed.unrolled;
        let [across, above] = [left, up].map(|axis| Vector(axis).dot::<S, S>(wrench.force));
        let about = Vector(along).dot::<S, S>(wrench.moment);
        let outwards = (about + placed.arm[0] * above - placed.arm[1] * across) * self.sign();
        let [angle, turning] = [
            states[0] * (1.0 / own.height),
            states[1] * (1.0 / (WAY * own.height)),
        ];
        let acceleration = (outwards - angle * own.stiffness - turning * own.damping) * (1.0 / own.inertia);
        wrench.powers[0] += turning * turning * own.damping;
        let rates = [states[1] * (1.0 / WAY), acceleration * (WAY * own.height)];
        (wrench, rates)
    }

    fn energy(&self, motion: &RelativeMotion<f64>) -> f64 {
        self.energy_with(motion, [0.0; 2])
    }

    fn energy_with(&self, motion: &RelativeMotion<f64>, states: [f64; 2]) -> f64 {
        let stored = stored_energy(&self.search, &self.placed(motion, states).pose);
        let [angle, rate] = self.rail_roll(states);
        self.roll.map_or(stored, |own| {
            stored + 0.5 * (own.stiffness * angle * angle + own.inertia * rate * rate)
        })
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
