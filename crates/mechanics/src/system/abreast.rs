//! Systems of one shape side by side: the right-hand sides of several runs at once, one run a lane.
//!
//! The lines are those of [`System`]'s own right-hand side ([`super::forces`], [`crate::body`], [`crate::contact`], [`crate::coil`]), with several
//! runs ([`Runs`]) in the place of one number; sums are taken in the same order. So each run has the bits that it has alone, whoever is beside it.
//!
//! Limits: all elements are plain (their neighbours are prescribed and do not turn), friction is by tanh, coils are linear.

mod elements;

use integrate::lanes::{LANES, Runs};
use integrate::scalar::Number;
use integrate::{Call, Together};

use super::System;
use super::forces::{WORK, accelerate, add_effect};
use crate::body::{Kinematics, Rigid};
use crate::coil::{CoilLaw, Seating};
use crate::contact::{Grade, Grip};
use crate::frame::FrameMotion;
use crate::friction::FrictionLaw;
use crate::link::{Effect, Sight, Translation};
use crate::vector::{Matrix, Vector};
use elements::{CoilRuns, FaceRuns, Place, SightRuns, put_matrix, put_vector};

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

    /// Takes time and states of one system into its place.
    #[inline(always)]
    pub(super) fn take(&mut self, place: usize, system: &System, time: f64, x: &[f64]) {
        self.travel(place, system, time);
        for (lanes, value) in self.x.iter_mut().zip(x) {
            lanes.put(place, *value);
        }
    }

    /// Writes the rates in a place.
    #[inline(always)]
    pub(super) fn give(&self, place: usize, dx: &mut [f64]) {
        for (value, lanes) in dx.iter_mut().zip(&self.dx) {
            *value = lanes.at(place);
        }
    }

    /// Rates at the states and frames that are in place.
    #[inline]
    pub(super) fn forces(&mut self) {
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
            if let Some(Call { problem, time, x, .. }) = call {
                self.take(place, problem, *time, x);
            }
        }
        self.forces();
        for (place, call) in calls.iter_mut().enumerate() {
            let Some(call) = call else { continue };
            self.give(place, call.dx);
            let motions = self.seen.iter().map(|motion| motion.map(|part| part.at(place)));
            call.problem.tell(call.time, call.x, motions);
        }
    }
}
