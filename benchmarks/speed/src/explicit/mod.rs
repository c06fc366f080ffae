//! A freight car by an explicit program of its own: the yardstick of the benchmark of cars.
//!
//! It shares no code with Wedgelab: plain arrays, 19 rigid bodies (car body, two bolsters, four side frames,
//! eight wedges, four wheelsets) with all their six motions, the classical Runge-Kutta method with fixed
//! steps of 8e-5 s. Springs, stops and faces act between a point of one body and another body ([`law`]),
//! wheels roll on rails ([`wheel`]). Dimensions, weights, stiffnesses, dampings and friction are those of the
//! built-in cars of 263,000 lbf, loaded and empty ([`parts`]).
//!
//! Simplified against the built-in cars:
//!
//! - straight track only, in axes that move along it at the given speed; the track's irregularities are a few
//!   waves;
//! - coned wheels (1:20) with a lateral spring as flange, on rails that do not give way; no search of the
//!   contact, one patch of constant shape, no spin moment;
//! - each face of a wedge is flat and bears at its four corners, or at 18 points with a crowned slope as in
//!   the built-in cars ([`parts::Faces`]); a center plate has eight points, not sixteen;
//! - friction by sliders that are set back to their limit after each step: first order where they slip;
//! - no events, no error control, no energy ledger, no statistics, no files.

// Names of the field and their units stand in the comments of the types.
#![allow(missing_docs)]

pub mod law;
pub mod parts;
pub mod vector;
pub mod wheel;

use law::Law;
use std::ops::Range;
use vector::{M, V, add, back, back_product, cross, dot, product, quaternion_rate, rotation, sub, times};
use wheel::{Hertz, Wave, on_rail};

/// in, in m.
pub const INCH: f64 = 0.0254;
/// lbf, in N.
pub const POUND_FORCE: f64 = 4.448_221_615_260_5;
/// lbf/in, in N/m.
pub const POUND_PER_INCH: f64 = POUND_FORCE / INCH;
/// Gravity, m/s².
pub const GRAVITY: f64 = 9.806_65;
/// The step, s.
pub const STEP: f64 = 8e-5;
/// Number of bodies: the car's body, bolsters, side frames, wedges, wheelsets.
pub const BODIES: usize = 19;
/// The first wheelset.
const WHEELSETS: usize = 15;
/// Numbers of a body's state: place (3), quaternion (4), velocity (3), rates (3).
const STATES: usize = 13;
/// Force on the body by what it lacks in speed, N·s/m.
const DRIVE: f64 = 1e5;

/// A rigid body: mass kg, moments of inertia kg·m², center of gravity in the nominal place, m.
#[derive(Clone, Copy, Debug)]
pub struct Body {
    pub mass: f64,
    pub inertia: V,
    pub center: V,
}

/// Points of a body `a` that see a body `b`, in axes of `b` turned by `turn` (columns).
#[derive(Clone, Debug)]
struct Link {
    a: usize,
    b: usize,
    turn: M,
    points: Range<usize>,
}

/// A point: its place in the axes of `a` from its center, and where it is in the nominal place in the axes of
/// the link from the center of `b`, m.
#[derive(Clone, Copy, Debug)]
struct Point {
    at: V,
    rest: V,
    law: Law,
}

/// Place, rotation matrix, velocity (fixed axes) and rates (own axes) of a body.
#[derive(Clone, Copy, Debug, Default)]
struct Pose {
    place: V,
    turned: M,
    velocity: V,
    rates: V,
}

/// A car on straight track.
#[derive(Clone, Debug)]
pub struct Car {
    pub bodies: [Body; BODIES],
    links: Vec<Link>,
    points: Vec<Point>,
    /// Friction of wheels on rails, and whether their contacts damp (1 or 0).
    wheels: [f64; 2],
    hertz: Hertz,
    /// The irregularities of the track.
    pub waves: Vec<Wave>,
    /// Speed, m/s.
    pub speed: f64,
    /// Time, s.
    pub time: f64,
    /// The state: of each body, then of each slider two deflections.
    pub state: Vec<f64>,
    /// Vertical force of the rails on each wheel, left and right, N.
    pub loads: [[f64; 2]; 4],
    /// Acceleration of the car's body, m/s².
    pub acceleration: V,
    /// Normal force at each slider, N.
    normals: Vec<f64>,
    poses: [Pose; BODIES],
    /// Stages of the method.
    stages: [Vec<f64>; 3],
}

impl Car {
    /// Computes the rates of a state, and returns the energy if it is asked for, J.
    fn rates<const ENERGY: bool>(&mut self, time: f64, state: &[f64], rates: &mut [f64]) -> f64 {
        let (mut forces, mut moments) = ([[0.0; 3]; BODIES], [[0.0; 3]; BODIES]);
        let mut energy = 0.0;
        for (number, own) in state.chunks_exact(STATES).take(BODIES).enumerate() {
            self.poses[number] = Pose {
                place: [own[0], own[1], own[2]],
                turned: rotation([own[3], own[4], own[5], own[6]]),
                velocity: [own[7], own[8], own[9]],
                rates: [own[10], own[11], own[12]],
            };
            forces[number][2] = -self.bodies[number].mass * GRAVITY;
        }
        forces[0][0] -= DRIVE * self.poses[0].velocity[0] * self.wheels[1];
        let (deflections, deflection_rates) = (&state[STATES * BODIES..], &mut rates[STATES * BODIES..]);
        for link in &self.links {
            let (a, b) = (&self.poses[link.a], &self.poses[link.b]);
            // Axes of wheelsets do not spin.
            let still = if link.b >= WHEELSETS {
                [b.rates[0], 0.0, b.rates[2]]
            } else {
                b.rates
            };
            let axes = product(&b.turned, &link.turn);
            let turned = back_product(&axes, &a.turned);
            let apart = back(&axes, sub(a.place, b.place));
            let rates_b = back(&link.turn, still);
            let turning = sub(times(&turned, a.rates), rates_b);
            let moving = sub(back(&axes, sub(a.velocity, b.velocity)), cross(rates_b, apart));
            let (mut force, mut moment) = ([0.0; 3], [0.0; 3]);
            for point in &self.points[link.points.clone()] {
                let arm = times(&turned, point.at);
                let displaced = sub(add(apart, arm), point.rest);
                let velocity = add(moving, cross(turning, arm));
                let mut deflection = [0.0; 2];
                if let Law::Face { slider, .. } = point.law {
                    deflection = [deflections[2 * slider], deflections[2 * slider + 1]];
                    deflection_rates[2 * slider] = velocity[0];
                    deflection_rates[2 * slider + 1] = velocity[1];
                }
                let answer = point.law.force(displaced, velocity, deflection);
                if let Law::Face { slider, .. } = point.law {
                    self.normals[slider] = answer.normal;
                }
                force = add(force, answer.force);
                moment = add(moment, cross(arm, answer.force));
                if ENERGY {
                    energy += answer.energy;
                }
            }
            let mut on_b = add(moment, cross(apart, force));
            if link.b >= WHEELSETS {
                // Bearings pass no moment about the axle on.
                on_b[1] = 0.0;
            }
            let fixed = times(&axes, force);
            forces[link.a] = add(forces[link.a], fixed);
            forces[link.b] = sub(forces[link.b], fixed);
            moments[link.a] = add(moments[link.a], back(&turned, moment));
            moments[link.b] = sub(moments[link.b], times(&link.turn, on_b));
        }
        for wheelset in 0..4 {
            let number = WHEELSETS + wheelset;
            let pose = &self.poses[number];
            let spinning = times(&pose.turned, pose.rates);
            for (wheel, side) in [1.0, -1.0].into_iter().enumerate() {
                let answer = on_rail(
                    (&self.hertz, self.wheels[0], self.wheels[1]),
                    &self.waves,
                    side,
                    (pose.place, pose.velocity),
                    (&pose.turned, spinning),
                    (self.speed * time + pose.place[0], self.speed),
                );
                forces[number] = add(forces[number], answer.force);
                let moment = cross(answer.arm, answer.force);
                moments[number] = add(moments[number], back(&pose.turned, moment));
                self.loads[wheelset][wheel] = answer.force[2];
                if ENERGY {
                    energy += answer.energy;
                }
            }
        }
        for (number, body) in self.bodies.iter().enumerate() {
            let pose = &self.poses[number];
            let own = &mut rates[STATES * number..STATES * (number + 1)];
            let mut turning = pose.rates;
            if number >= WHEELSETS {
                turning[1] = 0.0;
            }
            let momentum: V = std::array::from_fn(|k| body.inertia[k] * pose.rates[k]);
            let gyroscopic = cross(turning, momentum);
            let quaternion = &state[STATES * number + 3..STATES * number + 7];
            let quaternion = [quaternion[0], quaternion[1], quaternion[2], quaternion[3]];
            own[..3].copy_from_slice(&pose.velocity);
            own[3..7].copy_from_slice(&quaternion_rate(quaternion, turning));
            for k in 0..3 {
                own[7 + k] = forces[number][k] / body.mass;
                own[10 + k] = (moments[number][k] - gyroscopic[k]) / body.inertia[k];
            }
            if ENERGY {
                let kinetic = body.mass * dot(pose.velocity, pose.velocity) + dot(momentum, pose.rates);
                energy += 0.5 * kinetic + body.mass * GRAVITY * pose.place[2];
            }
        }
        energy
    }

    /// Returns kinetic, stored and potential energy, J.
    pub fn energy(&mut self) -> f64 {
        let state = std::mem::take(&mut self.state);
        let mut rates = std::mem::take(&mut self.stages[0]);
        let energy = self.rates::<true>(self.time, &state, &mut rates);
        self.stages[0] = rates;
        self.state = state;
        energy
    }

    /// Makes one step.
    pub fn step(&mut self) {
        let [mut rates, mut stage, mut sum] = std::mem::take(&mut self.stages);
        let mut state = std::mem::take(&mut self.state);
        sum.copy_from_slice(&state);
        stage.copy_from_slice(&state);
        for (number, (weight, next)) in [
            (1.0 / 6.0, 0.5),
            (1.0 / 3.0, 0.5),
            (1.0 / 3.0, 1.0),
            (1.0 / 6.0, 0.0),
        ]
        .into_iter()
        .enumerate()
        {
            let at = [0.0, 0.5, 0.5, 1.0][number];
            self.rates::<false>(self.time + at * STEP, &stage, &mut rates);
            if number == 0 {
                self.acceleration = [rates[7], rates[8], rates[9]];
            }
            for (((sum, stage), state), rate) in sum.iter_mut().zip(&mut stage).zip(&state).zip(&rates) {
                *sum += weight * STEP * rate;
                *stage = state + next * STEP * rate;
            }
        }
        std::mem::swap(&mut state, &mut sum);
        for own in state.chunks_exact_mut(STATES).take(BODIES) {
            let size = own[3..7].iter().map(|one| one * one).sum::<f64>().sqrt();
            own[3..7].iter_mut().for_each(|one| *one /= size);
        }
        let deflections = &mut state[STATES * BODIES..];
        for point in &self.points {
            if let Law::Face {
                friction,
                slider_stiffness,
                slider,
                ..
            } = point.law
            {
                let own = &mut deflections[2 * slider..2 * slider + 2];
                let limit = friction * self.normals[slider] / slider_stiffness;
                let size = (own[0] * own[0] + own[1] * own[1]).sqrt();
                if size > limit {
                    own.iter_mut().for_each(|one| *one *= limit / size);
                }
            }
        }
        self.time += STEP;
        self.state = state;
        self.stages = [rates, stage, sum];
    }

    /// Comes to rest on perfect track without friction in its joints, its velocities damped, and starts there
    /// at time zero.
    pub fn settle(&mut self, seconds: f64) {
        let waves = std::mem::take(&mut self.waves);
        let points = self.points.clone();
        for point in &mut self.points {
            if let Law::Face { friction, .. } = &mut point.law {
                *friction = 0.0;
            }
        }
        let kept = 1.0 - 15.0 * STEP;
        while self.time < seconds {
            self.step();
            for (number, own) in self.state.chunks_exact_mut(STATES).take(BODIES).enumerate() {
                let spin = own[11];
                own[7..].iter_mut().for_each(|one| *one *= kept);
                if number >= WHEELSETS {
                    own[11] = spin;
                }
            }
        }
        self.points = points;
        self.waves = waves;
        self.time = 0.0;
    }

    /// Returns place and velocity of a body's center of gravity, m and m/s, in axes that move with the car.
    pub fn body(&self, number: usize) -> (V, V) {
        let own = &self.state[STATES * number..];
        ([own[0], own[1], own[2]], [own[7], own[8], own[9]])
    }

    /// Returns the roll of a body, rad, left side up.
    pub fn roll(&self, number: usize) -> f64 {
        let own = &self.state[STATES * number + 3..];
        rotation([own[0], own[1], own[2], own[3]])[2][1].asin()
    }

    /// Moves bodies by a displacement (m).
    pub fn shift(&mut self, bodies: impl IntoIterator<Item = usize>, by: V) {
        for number in bodies {
            for k in 0..3 {
                self.state[STATES * number + k] += by[k];
            }
        }
    }
}

#[cfg(test)]
mod tests;
