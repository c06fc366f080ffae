//! Elements of several runs, one run a lane.

use std::ops::Range;

use integrate::lanes::{LANES, Runs};
use integrate::scalar::{Mask, Number};

use super::super::Mounted;
use super::FrameRuns;
use crate::body::Kinematics;
use crate::coil::{Coil, CoilLaw, Seating, taut};
use crate::contact::{ContactFace, Grade, Grip, View};
use crate::friction::FrictionLaw;
use crate::link::{Effect, Sight, Translation};
use crate::surface::Plane;
use crate::vector::{Matrix, Vector};

/// Where an element sits.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Place {
    pub(super) body: usize,
    pub(super) on: usize,
    pub(super) channels: [Option<usize>; 2],
    pub(super) driven: bool,
    pub(super) translates: bool,
}

/// How an element sees the body that it carries.
#[derive(Clone, Debug)]
pub(super) struct SightRuns {
    pub(super) place: Place,
    pub(super) sight: Sight<Runs>,
    pub(super) translation: Translation<Runs>,
}

#[derive(Clone, Debug)]
pub(super) struct FaceRuns {
    pub(super) at: SightRuns,
    pub(super) grip: Grip<Runs>,
    pub(super) points: Vec<(Vector<Runs>, Grade<Runs>)>,
    /// Where its points stand among all points.
    pub(super) own: Range<usize>,
}

#[derive(Clone, Debug)]
pub(super) struct CoilRuns {
    pub(super) at: SightRuns,
    pub(super) seating: Seating<Runs>,
    pub(super) stiffness: Runs,
    pub(super) free_length: Runs,
    pub(super) pulls: bool,
}

impl Place {
    pub(super) fn of<E>(mounted: &Mounted<E>) -> Self {
        Self {
            body: mounted.body,
            on: mounted.on,
            channels: mounted.channels,
            driven: mounted.driven,
            translates: mounted.translation.is_some(),
        }
    }
}

/// Puts a vector into a lane.
pub(super) fn put_vector(lanes: &mut Vector<Runs>, lane: usize, value: &Vector<f64>) {
    for (lanes, value) in lanes.0.iter_mut().zip(value.0) {
        lanes.put(lane, value);
    }
}

/// Puts a matrix into a lane.
pub(super) fn put_matrix(lanes: &mut Matrix<Runs>, lane: usize, value: &Matrix<f64>) {
    for (lanes, value) in lanes.0.as_flattened_mut().iter_mut().zip(value.0.as_flattened()) {
        lanes.put(lane, *value);
    }
}

impl SightRuns {
    pub(super) fn put<E>(&mut self, lane: usize, mounted: &Mounted<E>) {
        let (sight, own) = (&mut self.sight, &mounted.sight);
        put_matrix(&mut sight.rotation, lane, &own.rotation);
        for (lanes, value) in [
            (&mut sight.position, &own.position),
            (&mut sight.velocity, &own.velocity),
            (&mut sight.angular_velocity, &own.angular_velocity),
            (&mut sight.mount_velocity, &own.mount_velocity),
            (&mut sight.mount_angular_velocity, &own.mount_angular_velocity),
        ] {
            put_vector(lanes, lane, value);
        }
        if let Some(translation) = &mounted.translation {
            put_vector(&mut self.translation.rest, lane, &translation.rest);
            for (lanes, way) in self.translation.ways.iter_mut().zip(&translation.ways) {
                put_vector(lanes, lane, way);
            }
        }
    }

    /// Brings it to the present place of the frames.
    #[inline(always)]
    pub(super) fn update(&mut self, frames: &[FrameRuns]) {
        if self.place.translates {
            let jets = frames[self.place.on].moves.iter().map(|(_, jet)| *jet);
            self.translation.update(&mut self.sight, jets);
        }
    }
}

impl FaceRuns {
    pub(super) fn put(&mut self, lane: usize, mounted: &Mounted<ContactFace<Plane>>) {
        self.at.put(lane, mounted);
        let grip = mounted.element.grip();
        self.grip.coefficient.put(lane, grip.coefficient);
        if let (
            FrictionLaw::Tanh {
                reference_speed: lanes,
            },
            FrictionLaw::Tanh { reference_speed },
        ) = (&mut self.grip.law, grip.law)
        {
            lanes.put(lane, reference_speed);
        }
        for ((position, grade), point) in self.points.iter_mut().zip(&mounted.element.points) {
            put_vector(position, lane, &point.position);
            let own = point.grade();
            grade.stiffness.put(lane, own.stiffness);
            grade.damping.put(lane, own.damping);
            grade.share.put(lane, own.share);
        }
    }

    /// What its points do, and where they are seen: [`ContactFace::effect`] with runs in lanes instead of points.
    #[inline(always)]
    pub(super) fn effect(&self, body: &Kinematics<Runs>, seen: &mut [[Runs; 3]]) -> Effect<Runs> {
        let view = View::of(&self.at.sight, body);
        let zero = Runs::zero();
        let mut sums = [[zero; 8]; LANES];
        for (points, seen) in self.points.chunks(LANES).zip(seen.chunks_mut(LANES)) {
            for ((sums, (position, grade)), seen) in sums.iter_mut().zip(points).zip(seen) {
                let at = view.meet::<Runs>(*position, grade.damped);
                *seen = [at.gap, at.slip[0], at.slip[1]];
                let closed = at.gap.below(zero);
                if closed.none() {
                    continue;
                }
                let touch = self.grip.touch(grade, closed, &at, [zero; 2]);
                for (sum, term) in sums.iter_mut().zip(view.push(*position, &touch)) {
                    *sum += term;
                }
            }
        }
        let [a, b, c, d] = &sums;
        let sum = |k: usize| (a[k] + b[k]) + (c[k] + d[k]);
        Effect {
            force: Vector([sum(0), sum(1), sum(2)]),
            moment: Vector([sum(3), sum(4), sum(5)]),
            powers: [sum(6), sum(7)],
        }
    }
}

impl CoilRuns {
    pub(super) fn put(&mut self, lane: usize, mounted: &Mounted<Coil>) {
        self.at.put(lane, mounted);
        let (seating, own) = (&mut self.seating, mounted.element.seating());
        put_vector(&mut seating.end, lane, &own.end);
        put_vector(&mut seating.acts_at, lane, &own.acts_at);
        seating.damping.put(lane, own.damping);
        seating.rotational_damping.put(lane, own.rotational_damping);
        if let CoilLaw::Linear { stiffness } = mounted.element.law {
            self.stiffness.put(lane, stiffness);
        }
        self.free_length.put(lane, mounted.element.free_length);
    }

    #[inline(always)]
    pub(super) fn effect(&self, body: &Kinematics<Runs>) -> Effect<Runs> {
        self.seating.effect(&self.at.sight, body, |length| {
            let compression = -length + self.free_length;
            taut(compression * self.stiffness, self.pulls)
        })
    }
}
