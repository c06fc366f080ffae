//! Systems of one shape side by side: the right-hand sides of several runs at once, one run a lane.
//!
//! The lines are those of [`System`]'s own right-hand side ([`super::forces`], [`crate::body`], [`crate::contact`], [`crate::coil`]), with several
//! runs ([`Runs`]) in the place of one number; sums are taken in the same order. So each run has the bits that it has alone, whoever is beside it.
//!
//! Limits: all elements are plain (their neighbours are prescribed and do not turn), friction is by tanh, coils are linear.

use std::ops::Range;

use integrate::lanes::{LANES, Runs};
use integrate::scalar::{Mask, Number};
use integrate::{Call, Together};

use super::forces::{WORK, accelerate, add_effect};
use super::{Mounted, System};
use crate::body::{Kinematics, Rigid};
use crate::coil::{Coil, CoilLaw, Seating, taut};
use crate::contact::{ContactFace, Grade, Grip, View};
use crate::frame::FrameMotion;
use crate::friction::FrictionLaw;
use crate::link::{Effect, Sight, Translation};
use crate::surface::Plane;
use crate::vector::{Matrix, Vector};

/// Systems of one shape, one a lane.
#[derive(Clone, Debug)]
pub struct Abreast {
    shape: Shape,
    frames: Vec<FrameRuns>,
    bodies: Vec<BodyRuns>,
    faces: Vec<FaceRuns>,
    coils: Vec<CoilRuns>,
    /// States that are read, and rates.
    x: Vec<Runs>,
    dx: Vec<Runs>,
    /// Gap and slip of all points where forces were asked for last.
    seen: Vec<[Runs; 3]>,
    /// The time to which the frames of each system were brought, and which smooth piece of the motions it was on.
    travelled: [[f64; 2]; Runs::COUNT],
}

/// What systems must have in common to sit side by side.
#[derive(Clone, Debug, PartialEq)]
struct Shape {
    gravity: Vector<f64>,
    states: usize,
    speeds: usize,
    quadratures: usize,
    /// By frame, which translations move.
    moving: Vec<Vec<usize>>,
    /// By free body: its number, its free coordinates, whether it can be rolled, whether its centre of gravity is its origin.
    bodies: Vec<(usize, Vec<usize>, bool, bool)>,
    faces: Vec<(Place, Vec<bool>)>,
    /// Whether the spring can pull, whether it ends at the origin.
    coils: Vec<(Place, bool, bool)>,
}

/// Where an element sits.
#[derive(Clone, Debug, PartialEq)]
struct Place {
    body: usize,
    on: usize,
    channels: [Option<usize>; 2],
    driven: bool,
    translates: bool,
}

#[derive(Clone, Debug)]
struct FrameRuns {
    /// Of a frame that stands still.
    motion: FrameMotion<Runs>,
    /// Number, and value with rate and second derivative, of each coordinate that moves.
    moves: Vec<(usize, [Runs; 3])>,
}

#[derive(Clone, Debug)]
struct BodyRuns {
    /// Its number among all bodies, its first position.
    number: usize,
    offset: usize,
    free: Vec<usize>,
    rigid: Rigid<Runs>,
    initial: [Runs; 6],
    faces: Vec<usize>,
    coils: Vec<usize>,
}

/// How an element sees the body that it carries.
#[derive(Clone, Debug)]
struct SightRuns {
    place: Place,
    sight: Sight<Runs>,
    translation: Translation<Runs>,
}

#[derive(Clone, Debug)]
struct FaceRuns {
    at: SightRuns,
    grip: Grip<Runs>,
    points: Vec<(Vector<Runs>, Grade<Runs>)>,
    /// Where its points stand among all points.
    own: Range<usize>,
}

#[derive(Clone, Debug)]
struct CoilRuns {
    at: SightRuns,
    seating: Seating<Runs>,
    stiffness: Runs,
    free_length: Runs,
    pulls: bool,
}

impl Abreast {
    /// Room for systems of the shape of this one, which sits in all places; none if such systems cannot sit side by side.
    #[must_use]
    pub fn of(system: &System) -> Option<Self> {
        let shape = Shape::of(system)?;
        let zero = Runs::zero();
        let (none, flat) = (Vector([zero; 3]), Matrix([[zero; 3]; 3]));
        let motion = FrameMotion {
            position: none,
            rotation: flat,
            velocity: none,
            angular_velocity: none,
            acceleration: none,
            angular_acceleration: none,
        };
        let frames = shape.moving.iter().map(|moving| FrameRuns {
            motion,
            moves: moving.iter().map(|&k| (k, [zero; 3])).collect(),
        });
        let bodies = system.free.iter().zip(&shape.bodies);
        let bodies = bodies.map(|(free, (number, coordinates, rolls, central))| BodyRuns {
            number: *number,
            offset: free.offset,
            free: coordinates.clone(),
            rigid: Rigid {
                mass: zero,
                inertia: [zero; 3],
                center_of_gravity: none,
                central: *central,
                free: system.bodies[*number].free,
                rolls: *rolls,
            },
            initial: [zero; 6],
            faces: free.faces.clone(),
            coils: free.coils.clone(),
        });
        let at = |place: &Place| SightRuns {
            place: place.clone(),
            sight: Sight {
                position: none,
                rotation: flat,
                velocity: none,
                angular_velocity: none,
                mount_velocity: none,
                mount_angular_velocity: none,
            },
            translation: Translation {
                rest: none,
                ways: [none; 3],
            },
        };
        let faces = shape.faces.iter().enumerate();
        let faces = faces.map(|(number, (place, points))| FaceRuns {
            at: at(place),
            grip: Grip {
                coefficient: zero,
                law: FrictionLaw::Tanh {
                    reference_speed: zero,
                },
            },
            points: points
                .iter()
                .map(|&damped| {
                    let grade = Grade {
                        stiffness: zero,
                        damping: zero,
                        damped,
                        share: zero,
                    };
                    (none, grade)
                })
                .collect(),
            own: system.points_of(number),
        });
        let coils = shape.coils.iter().map(|(place, pulls, central)| CoilRuns {
            at: at(place),
            seating: Seating {
                end: none,
                acts_at: none,
                damping: zero,
                rotational_damping: zero,
                central: *central,
            },
            stiffness: zero,
            free_length: zero,
            pulls: *pulls,
        });
        let mut this = Self {
            frames: frames.collect(),
            bodies: bodies.collect(),
            faces: faces.collect(),
            coils: coils.collect(),
            x: vec![zero; 2 * shape.speeds],
            dx: vec![zero; shape.states],
            seen: vec![[zero; 3]; system.point_count()],
            travelled: [[f64::NAN; 2]; Runs::COUNT],
            shape,
        };
        for place in 0..Runs::COUNT {
            this.put(place, system);
        }
        Some(this)
    }

    /// Whether a system may sit beside those that there is room for.
    #[must_use]
    pub fn admits(&self, system: &System) -> bool {
        Shape::of(system).is_some_and(|shape| shape == self.shape)
    }
}

impl Shape {
    fn of(system: &System) -> Option<Self> {
        if !system.bounded {
            return None;
        }
        let mut faces = Vec::new();
        for face in &system.faces {
            let points = &face.element.points;
            // A quad of points is damped as a whole.
            let damped = points.chunks(LANES).flat_map(|quad| {
                let damped = quad.iter().any(|point| point.damping > 0.0);
                quad.iter().map(move |_| damped)
            });
            faces.push((Place::of(face), damped.collect()));
        }
        let mut coils = Vec::new();
        for coil in &system.coils {
            let CoilLaw::Linear { .. } = coil.element.law else {
                return None;
            };
            let central = coil.element.seating().central;
            coils.push((Place::of(coil), coil.element.pulls, central));
        }
        let bodies = system
            .free
            .iter()
            .map(|free| (free.body, free.free.clone(), free.rigid.rolls, free.rigid.central));
        Some(Self {
            gravity: system.gravity,
            states: system.layout.len(),
            speeds: system.layout.speeds,
            quadratures: system.layout.quadratures,
            moving: system
                .frames
                .iter()
                .map(|frame| frame.moves.iter().map(|way| way.coordinate).collect())
                .collect(),
            bodies: bodies.collect(),
            faces,
            coils,
        })
    }
}

impl Place {
    fn of<E>(mounted: &Mounted<E>) -> Self {
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
fn put_vector(lanes: &mut Vector<Runs>, lane: usize, value: &Vector<f64>) {
    for (lanes, value) in lanes.0.iter_mut().zip(value.0) {
        lanes.put(lane, value);
    }
}

/// Puts a matrix into a lane.
fn put_matrix(lanes: &mut Matrix<Runs>, lane: usize, value: &Matrix<f64>) {
    for (lanes, value) in lanes.0.as_flattened_mut().iter_mut().zip(value.0.as_flattened()) {
        lanes.put(lane, *value);
    }
}

impl SightRuns {
    fn put<E>(&mut self, lane: usize, mounted: &Mounted<E>) {
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
    fn update(&mut self, frames: &[FrameRuns]) {
        if self.place.translates {
            let jets = frames[self.place.on].moves.iter().map(|(_, jet)| *jet);
            self.translation.update(&mut self.sight, jets);
        }
    }
}

impl FaceRuns {
    fn put(&mut self, lane: usize, mounted: &Mounted<ContactFace<Plane>>) {
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
    fn effect(&self, body: &Kinematics<Runs>, seen: &mut [[Runs; 3]]) -> Effect<Runs> {
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
    fn put(&mut self, lane: usize, mounted: &Mounted<Coil>) {
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
    fn effect(&self, body: &Kinematics<Runs>) -> Effect<Runs> {
        self.seating.effect(&self.at.sight, body, |length| {
            let compression = -length + self.free_length;
            taut(compression * self.stiffness, self.pulls)
        })
    }
}

impl Abreast {
    /// Brings the frames of one system to a time.
    #[inline(always)]
    fn travel(&mut self, place: usize, system: &System, time: f64) {
        let there = [time, system.reference];
        if self.travelled[place] == there {
            return;
        }
        self.travelled[place] = there;
        for (frame, body) in self.frames.iter_mut().zip(&system.bodies) {
            for (k, jet) in &mut frame.moves {
                let values: [f64; 3] = body.frame.motions[*k].evaluate(time, system.reference);
                for (lanes, value) in jet.iter_mut().zip(values) {
                    lanes.put(place, value);
                }
            }
        }
    }

    /// Rates at the states and frames that are in place.
    #[inline(always)]
    fn forces(&mut self) {
        let Shape {
            gravity,
            states,
            speeds,
            quadratures,
            ..
        } = self.shape;
        for at in self
            .faces
            .iter_mut()
            .map(|face| &mut face.at)
            .chain(self.coils.iter_mut().map(|coil| &mut coil.at))
        {
            at.update(&self.frames);
        }
        let (d_positions, rest) = self.dx.split_at_mut(speeds);
        let (d_speeds, rest) = rest.split_at_mut(speeds);
        let powers = &mut rest[states - 2 * speeds - quadratures..];
        d_positions.copy_from_slice(&self.x[speeds..]);
        let mut work = Runs::zero();
        for body in &self.bodies {
            let (mut coordinates, mut rates) = (body.initial, [Runs::zero(); 6]);
            for (j, &k) in body.free.iter().enumerate() {
                coordinates[k] = self.x[body.offset + j];
                rates[k] = self.x[speeds + body.offset + j];
            }
            let kinematics = Kinematics::new(coordinates, rates, body.rigid.rolls);
            let (mut force, mut moment) = (Vector::zero(), Vector::zero());
            let mut add = |effect: &Effect<Runs>, at: &SightRuns| {
                let channels = (&at.place.channels, at.place.driven);
                let powers = (&mut *powers, &mut work);
                add_effect(effect, &at.sight, channels, (&mut force, &mut moment), powers);
            };
            for face in body.faces.iter().map(|face| &self.faces[*face]) {
                let seen = &mut self.seen[face.own.clone()];
                add(&face.effect(&kinematics, seen), &face.at);
            }
            for coil in body.coils.iter().map(|coil| &self.coils[*coil]) {
                add(&coil.effect(&kinematics), &coil.at);
            }
            let frame = (&self.frames[body.number].motion, false);
            let accelerations = accelerate(&kinematics, &body.rigid, frame, gravity, (force, moment));
            let target = &mut d_speeds[body.offset..body.offset + body.free.len()];
            for (target, &k) in target.iter_mut().zip(&body.free) {
                *target = accelerations[k];
            }
        }
        powers[WORK] = work;
    }
}

impl Together for Abreast {
    type Problem = System;

    fn places(&self) -> usize {
        Runs::COUNT
    }

    fn put(&mut self, place: usize, system: &System) {
        self.travelled[place] = [f64::NAN; 2];
        self.travel(place, system, 0.0);
        for (lanes, frame) in self.frames.iter_mut().zip(&system.frames) {
            let own = &frame.motion;
            put_matrix(&mut lanes.motion.rotation, place, &own.rotation);
            for (lanes, value) in [
                (&mut lanes.motion.position, &own.position),
                (&mut lanes.motion.velocity, &own.velocity),
                (&mut lanes.motion.angular_velocity, &own.angular_velocity),
                (&mut lanes.motion.acceleration, &own.acceleration),
                (&mut lanes.motion.angular_acceleration, &own.angular_acceleration),
            ] {
                put_vector(lanes, place, value);
            }
        }
        for (lanes, free) in self.bodies.iter_mut().zip(&system.free) {
            let body = &system.bodies[free.body];
            let (rigid, own) = (&mut lanes.rigid, &free.rigid);
            rigid.mass.put(place, own.mass);
            put_vector(&mut rigid.center_of_gravity, place, &own.center_of_gravity);
            for (lanes, value) in rigid.inertia.iter_mut().zip(own.inertia) {
                lanes.put(place, value);
            }
            for (lanes, value) in lanes.initial.iter_mut().zip(body.initial) {
                lanes.put(place, value);
            }
            for (j, &k) in lanes.free.iter().enumerate() {
                self.x[lanes.offset + j].put(place, body.initial[k]);
            }
        }
        for (lanes, face) in self.faces.iter_mut().zip(&system.faces) {
            lanes.put(place, face);
        }
        for (lanes, coil) in self.coils.iter_mut().zip(&system.coils) {
            lanes.put(place, coil);
        }
    }

    fn derivatives(&mut self, calls: &mut [Option<Call<'_, System>>]) {
        for (place, call) in calls.iter().enumerate() {
            let Some(Call { problem, time, x, .. }) = call else {
                continue;
            };
            self.travel(place, problem, *time);
            for (lanes, value) in self.x.iter_mut().zip(*x) {
                lanes.put(place, *value);
            }
        }
        self.forces();
        for (place, call) in calls.iter_mut().enumerate() {
            let Some(call) = call else { continue };
            for (value, lanes) in call.dx.iter_mut().zip(&self.dx) {
                *value = lanes.at(place);
            }
            let motions = self.seen.iter().map(|motion| motion.map(|part| part.at(place)));
            call.problem.tell(call.time, call.x, motions);
        }
    }
}
