//! Couplers: a given force on a car's end along the line of its coupler.
//!
//! The force acts on the car body at the pivot of the coupler (the pin or the butt of its shank), along the
//! line to the pivot of the neighbor's coupler. Positive forces are *buff*: they push the car; negative ones
//! are *draft*: they pull it. They are given over time, or over the distance of the car's middle along the
//! track; where they come from (draft gears, the rest of the train) is not part of the law.
//!
//! **Direction.** A *like neighbor* is a copy of this car on the same track that moves as this one does: its
//! body lies to the chord between its truck centers as the body of this car lies to its own chord now, in
//! all six coordinates. So the car is one cell of a long train of equal cars; what it does in steady running
//! is what each car of that train does. With x_p the distance of the pivots from the middle of the car, c
//! the length of both couplers together, and both bodies on their chords in a curve whose center is R away
//! from the middle of the body, mirror symmetry gives the angle a between coupler and body:
//!
//! ```text
//! R sin a = x_p cos a + c/2,    lateral force F sin a, outward in buff, inward in draft
//! ```
//!
//! A neighbor's place along the track is where pivots of cars on their chords are c apart, by three steps of
//! a fixed-point iteration, which leave less than 1e-6 of c. Instead of a neighbor an *angle* of the coupler
//! to the body can be given, positive where the coupler points to the left of the car.
//!
//! Source: mirror symmetry of the figure (derived). Units: N, m, rad. Marker A is the pivot, with the axes of
//! the nominal layout, on the body; marker B the origin of the track's own axes. The work is the element's:
//! force times velocity of the pivot. Effects of direction belong to it: buff lowers the stiffness in yaw by
//! `4 F x_p²/c` (2 of these for a neighbor that stands still), draft raises it.
//!
//! Limits: neighbors move in phase with the car, so that waves along a train and the delay at the ends of a
//! curve are not in it. Arcs between truck centers are taken for their chords (1 mm in a curve of 10 deg). A
//! neighbor beyond an end of the track stands on the track as it goes on there.

use std::f64::consts::FRAC_PI_2;
use std::sync::Arc;

use mechanics::curve::Curve;
use mechanics::element::{Element, Placement, Wrench};
use mechanics::link::{Marker, RelativeMotion};
use mechanics::motion::Motion;
use mechanics::system::{Model, Observation};
use mechanics::vector::{Matrix, Vector};
use numerics::scalar::Real;
use wheelrail::track::{Line, RailLines};

use crate::assemble::Car;

const INCH: f64 = 0.0254;
/// Steps of the iteration for the neighbor's place.
const STEPS: usize = 3;

/// The couplers of a car.
#[derive(Clone, Debug, PartialEq)]
pub struct Couplers {
    /// Height above the top of rail in the nominal layout, m.
    pub height: f64,
    /// From one pulling face to the other, m.
    pub distance: f64,
    /// From the pivot of a coupler to its pulling face, m.
    pub length: f64,
    /// Angle to the body up to which a coupler swings, rad.
    pub swing: f64,
    /// Leading and trailing end.
    pub ends: [CouplerForce; 2],
    /// True if forces can be added from outside ([`mechanics::system::System::set_factor`]).
    pub are_inputs: bool,
}

/// The force at one end of a car, and its direction.
#[derive(Clone, Debug, PartialEq)]
pub struct CouplerForce {
    /// N, positive in buff.
    pub course: Course,
    /// Its direction.
    pub direction: Direction,
}

/// A force over time or distance, N, positive in buff.
#[derive(Clone, Debug, PartialEq)]
pub enum Course {
    /// Over time.
    Time(Motion),
    /// Over the distance of the car's middle along the track, m.
    Distance(Curve),
}

/// The direction of a coupler.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Direction {
    /// Towards the coupler of a copy of this car that moves as this one does.
    LikeNeighbor,
    /// At this angle to the body (rad), positive where the coupler points to the left of the car.
    Angle(f64),
}

impl Default for CouplerForce {
    fn default() -> Self {
        Self {
            course: Course::Time(Motion::Constant(0.0)),
            direction: Direction::LikeNeighbor,
        }
    }
}

impl CouplerForce {
    /// Returns whether there is a force at any time or place.
    #[must_use]
    pub fn acts(&self) -> bool {
        self.course != Course::Time(Motion::Constant(0.0))
    }
}

impl Default for Couplers {
    /// Returns 637 in between the pulling faces, as coal gondolas of 53 ft 1 in have them, and a height of
    /// 32.5 in: a guess, with which the empty car has the 34.5 in that rules allow at the most (remembered).
    /// Pivots are 29.25 in behind the pulling faces and couplers swing by 13° (both remembered of AAR type
    /// F). No force acts.
    fn default() -> Self {
        Self {
            height: 32.5 * INCH,
            distance: 637.0 * INCH,
            length: 29.25 * INCH,
            swing: 13_f64.to_radians(),
            ends: [CouplerForce::default(), CouplerForce::default()],
            are_inputs: false,
        }
    }
}

impl Couplers {
    /// Returns the distance of the pivots from the middle of the car, m.
    #[must_use]
    pub fn pivot(&self) -> f64 {
        0.5 * self.distance - self.length
    }

    /// Returns the same without forces.
    #[must_use]
    pub fn idle(&self) -> Self {
        Self {
            ends: [CouplerForce::default(), CouplerForce::default()],
            are_inputs: false,
            ..self.clone()
        }
    }

    /// Returns whether a force acts, or can act, at an end (0 leading, 1 trailing).
    #[must_use]
    pub fn acts(&self, end: usize) -> bool {
        self.are_inputs || self.ends[end].acts()
    }
}

/// The place of a coupler on its car.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CouplerPlace {
    /// Place of the pivot along the car from its middle, positive forward, m.
    pub pivot: f64,
    /// Height of the pivot above the top of rail in the nominal layout, m.
    pub height: f64,
    /// From the pivot to the pulling face, m.
    pub length: f64,
    /// From one truck center to the other, m.
    pub truck_distance: f64,
}

/// A coupler as an element.
#[derive(Clone, Debug)]
pub struct Coupler {
    /// Its name.
    pub name: String,
    /// The rails.
    pub lines: Arc<RailLines>,
    /// Its place.
    pub place: CouplerPlace,
    /// Its direction.
    pub direction: Direction,
    /// Force over distance (N, positive in buff); none: 1 N, to be multiplied.
    pub course: Option<Curve>,
}

/// The chord between truck centers: its middle, and axes along it, to the left, and up.
struct Chord<S> {
    origin: Vector<S>,
    axes: [Vector<S>; 3],
}

impl<S: Real> Chord<S> {
    fn of(&self, place: Vector<S>) -> [S; 3] {
        let arm = place - self.origin;
        self.axes.map(|axis| axis.dot(arm))
    }

    fn at(&self, [x, y, z]: [S; 3]) -> Vector<S> {
        let [a, b, c] = self.axes;
        Vector([0, 1, 2].map(|i| self.origin.0[i] + a.0[i] * x + b.0[i] * y + c.0[i] * z))
    }
}

/// Where a coupler is and leads to.
#[derive(Clone, Copy, Debug)]
pub struct CouplerLine<S> {
    /// Distance along the track of the middle of the car, m.
    pub distance: S,
    /// Unit vector from the pivot to the neighbor, axes of marker B.
    pub toward: Vector<S>,
}

impl Coupler {
    /// Returns the line of the coupler at a motion of its pivot against the track.
    pub fn line<S: Real>(&self, motion: &RelativeMotion<S>) -> CouplerLine<S> {
        let pivot = self.place.pivot;
        let along: Vector<S> = motion.rotation.column(0);
        let shifted = |x: f64| Vector([0, 1, 2].map(|i| motion.position.0[i] + along.0[i] * x));
        let distance = self.lines.section(Line::Center, shifted(-pivot).0).distance;
        let toward = match self.direction {
            Direction::Angle(angle) => {
                let (sine, cosine) = libm::sincos(angle);
                let left: Vector<S> = motion.rotation.column(1);
                let forward = cosine * pivot.signum();
                Vector([0, 1, 2].map(|i| along.0[i] * forward + left.0[i] * sine))
            }
            Direction::LikeNeighbor => {
                let own = self.chord(distance);
                let neighbor = self.neighbor(distance, &own);
                // The neighbor's pivot on this side is the one of the car's other end.
                let other = neighbor.at(own.of(shifted(-2.0 * pivot)));
                unit(other - motion.position)
            }
        };
        CouplerLine { distance, toward }
    }

    /// Returns the chord of a car whose middle is at a distance, m.
    fn chord<S: Real>(&self, distance: S) -> Chord<S> {
        let half = 0.5 * self.place.truck_distance;
        let [front, rear] = [half, -half].map(|at| self.lines.section_over(Line::Center, distance + at));
        let along = unit(Vector(front.origin) - Vector(rear.origin));
        let up: Vector<S> = Vector(front.axes[2]) + Vector(rear.axes[2]);
        let left = unit(up.cross::<S, S>(along));
        Chord {
            origin: Vector([0, 1, 2].map(|i| (front.origin[i] + rear.origin[i]) * 0.5)),
            axes: [along, left, along.cross(left)],
        }
    }

    /// Returns the chord of the neighbor at this end, whose pivot is both lengths away from that of a car on
    /// its own chord.
    fn neighbor<S: Real>(&self, distance: S, own: &Chord<S>) -> Chord<S> {
        let CouplerPlace {
            pivot,
            height,
            length,
            ..
        } = self.place;
        let at = |x: f64| [S::from(x), S::zero(), S::from(height)];
        let (from, apart) = (own.at(at(pivot)), 2.0 * length);
        let mut way = S::from(2.0 * (pivot.abs() + length));
        let mut chord = self.chord(distance + way * pivot.signum());
        for _ in 0..STEPS {
            let arm = chord.at(at(-pivot)) - from;
            way -= arm.dot::<S, S>(arm).sqrt() - apart;
            chord = self.chord(distance + way * pivot.signum());
        }
        chord
    }
}

fn unit<S: Real>(v: Vector<S>) -> Vector<S> {
    let inverse = v.dot::<S, S>(v).sqrt().recip();
    Vector(v.0.map(|own| own * inverse))
}

impl Element for Coupler {
    fn name(&self) -> &str {
        &self.name
    }

    fn does_work(&self) -> bool {
        true
    }

    fn evaluate<S: Real>(&self, motion: &RelativeMotion<S>) -> Wrench<S> {
        let line = self.line(motion);
        let force = match &self.course {
            Some(course) => -course.evaluate(line.distance),
            None => S::from(-1.0),
        };
        let force = Vector(line.toward.0.map(|own| own * force));
        Wrench {
            force,
            moment: Vector::zero(),
            powers: [S::zero(), force.dot(motion.velocity)],
        }
    }

    fn energy(&self, _: &RelativeMotion<f64>) -> f64 {
        0.0
    }
}

/// A coupler in a car's system.
#[derive(Clone, Debug)]
pub(crate) struct MountedCoupler {
    law: Coupler,
    /// Marker A, on the car body.
    marker: Marker,
    /// The numbers of its elements among those of the system.
    elements: Vec<usize>,
    /// Those whose factors are inputs: the force along its line (buff positive), and one along the body's
    /// right.
    inputs: Option<[usize; 2]>,
}

/// A coupler at an observation, SI.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct CouplerLoads {
    /// Force along its line, positive in buff, N.
    pub force: f64,
    /// Force on the car body to its left, N.
    pub lateral: f64,
    /// Angle to the body, positive where the coupler points to the left of the car, rad.
    pub angle: f64,
    /// Distance of the pivot along the track, m.
    pub distance: f64,
    /// Speed of the pivot along the track, m/s.
    pub speed: f64,
}

impl MountedCoupler {
    /// Adds what acts at an end (0 leading, 1 trailing) of a car body; `body` is its number and the marker at
    /// the pivot, `track` the ground with the track's own axes.
    pub fn add(
        model: &mut Model,
        couplers: &Couplers,
        law: Coupler,
        end: usize,
        (body, marker): (usize, Marker),
        track: (usize, Marker),
    ) -> Self {
        let mut elements = Vec::new();
        let mut push = |name: String, law: &Coupler, factor: Motion| {
            let own = Coupler { name, ..law.clone() };
            elements.push(model.elements.len());
            let placed = Placement::new(own, (body, marker), track);
            model.elements.push(placed.over_time(factor));
            model.elements.len() - 1
        };
        let name = law.name.clone();
        match &couplers.ends[end].course {
            _ if !couplers.ends[end].acts() => {}
            Course::Time(course) => {
                push(name.clone(), &law, course.clone());
            }
            Course::Distance(course) => {
                let course = Some(course.clone());
                push(
                    name.clone(),
                    &Coupler {
                        course,
                        ..law.clone()
                    },
                    Motion::Constant(1.0),
                );
            }
        }
        let inputs = couplers.are_inputs.then(|| {
            let aside = Coupler {
                direction: Direction::Angle(FRAC_PI_2),
                ..law.clone()
            };
            [
                push(format!("{name}_input"), &law, Motion::Constant(0.0)),
                push(format!("{name}_lateral_input"), &aside, Motion::Constant(0.0)),
            ]
        });
        Self {
            law,
            marker,
            elements,
            inputs,
        }
    }
}

impl Car {
    /// Returns the elements at an end (0 leading, 1 trailing) whose factors are inputs: the force along the
    /// line of the coupler (N, positive in buff), and the force on the body along its right (N).
    #[must_use]
    pub fn coupler_inputs(&self, end: usize) -> Option<[usize; 2]> {
        self.mounted_couplers[end].as_ref()?.inputs
    }

    /// Returns whether a force acts, or can act, at an end (0 leading, 1 trailing).
    #[must_use]
    pub fn is_coupled(&self, end: usize) -> bool {
        self.mounted_couplers[end].is_some()
    }

    /// Returns what acts at an end (0 leading, 1 trailing) at an observation; none where nothing can act.
    #[must_use]
    pub fn coupler(&self, seen: &Observation, end: usize) -> Option<CouplerLoads> {
        let own = self.mounted_couplers[end].as_ref()?;
        let body = &seen.bodies[self.numbers.body_at(end)];
        let arm: Vector<f64> = body.rotation.apply(own.marker.origin);
        let pivot = body.origin + arm;
        let swing: Vector<f64> = body.angular_velocity.cross(arm);
        let turned: Matrix<f64> = body.rotation.times(own.marker.rotation);
        let motion = RelativeMotion {
            position: self.own(pivot),
            rotation: self.axes.transpose().times(turned),
            velocity: self.own(body.velocity + swing),
            angular_velocity: self.own(body.angular_velocity),
        };
        let CouplerLine { toward, .. } = own.law.line::<f64>(&motion);
        let [forward, left, _] = [0, 1, 2].map(|k| motion.rotation.column(k).dot::<f64, f64>(toward));
        let forces = own.elements.iter().map(|number| seen.elements[*number].force);
        let force = self.own(forces.fold(Vector::zero(), |sum, own| sum + own));
        let section = self.section(pivot);
        Some(CouplerLoads {
            force: -force.dot::<f64, f64>(toward),
            lateral: force.dot::<f64, f64>(motion.rotation.column(1)),
            angle: libm::atan2(left, forward * own.law.place.pivot.signum()),
            distance: section.distance,
            speed: section.of(motion.velocity.0)[0],
        })
    }
}
