//! A wheelset on track with linear geometry and linear creep, in all six motions: for stability and its
//! benchmarks.
//!
//! Marker A is the wheelset's center with axes forward, along the axle, up; marker B is the origin of the
//! track's fixed axes. In the section of the center line that holds the center, with the lateral shift y at
//! the height of the rails (y of the center plus r times the roll φ), the wheels touch at (0, ±l, ±l φ - (r ±
//! λ y)) from the center, on planes of the slopes ±δ0 + ε y: a rolling radius is measured square to the axle,
//! so that an axle that rolls on what carries it does not creep. At each contact, with the velocity v and the
//! angular velocity ω of the wheelset's material there and the forward speed V,
//!
//! ```text
//! ξx = vx/V,  ξy = vy/V,  φ = ω·n/V
//! Fx = -f11 ξx,   Fy = -f22 ξy - f23 φ,   Mn = f23 ξy - f33 φ
//! ```
//!
//! so that, to first order about steady rolling, ξx = ∓(l ψ'/V + λ y/r) and ξy = y'/V - ψ. Terms with f23,
//! f33 are left out without `spin`. A gravity term stores `W (ε y² - l δ0 ψ²)/2`; an axle load W of zero
//! leaves it out. Two stiff springs carry the wheelset: vertically from the height r, and in roll from σ y
//! with the roll coefficient σ.
//!
//! Limits: no saturation, no flange, no lift-off; on straight track or in gentle curves, without
//! irregularities. The forward speed is `√(v² + v_min²)`; where a wheelset rolls backward, f23 changes its
//! sign.

use std::sync::Arc;

use mechanics::element::{Element, Wrench};
use mechanics::link::RelativeMotion;
use mechanics::vector::Vector;
use numerics::scalar::Real;
use wheelrail::contact::{LinearWheelset, rolling_sense};
use wheelrail::track::{Line, RailLines};

use crate::ahead::ahead;

/// A wheelset with linear geometry and creep on a track.
#[derive(Clone, Debug)]
pub struct LinearOnTrack {
    /// Its name.
    pub name: String,
    /// The track.
    pub lines: Arc<RailLines>,
    /// Geometry, creep coefficients, whether spin and gravity act.
    pub wheelset: LinearWheelset,
    /// Stiffness of what carries it, vertically N/m and in roll N·m/rad.
    pub support: [f64; 2],
    /// Smallest reference speed, m/s.
    pub slowest: f64,
}

/// The position of the wheelset in its section.
struct Seen<S> {
    axes: [[S; 3]; 3],
    /// Shift at the height of the rails, height, m.
    shift: S,
    height: S,
    /// Forward and upward part of the axle: minus the yaw, and the roll.
    forward: S,
    roll: S,
}

impl LinearOnTrack {
    #[inline(always)]
    fn seen<S: Real>(&self, center: [S; 3], axle: [S; 3]) -> Seen<S> {
        let section = self.lines.section(Line::Center, center);
        let [_, y, height] = section.of([0, 1, 2].map(|i| center[i] - section.origin[i]));
        let [forward, _, roll] = section.of(axle);
        Seen {
            axes: section.axes,
            shift: y + roll * self.wheelset.geometry.radius,
            height,
            forward,
            roll,
        }
    }

    /// Returns the deflections of the springs that carry it, up and in roll.
    #[inline(always)]
    fn deflections<S: Real>(&self, seen: &Seen<S>) -> [S; 2] {
        let geometry = &self.wheelset.geometry;
        [
            seen.height - geometry.radius,
            seen.roll - seen.shift * geometry.roll_coefficient,
        ]
    }

    #[inline(always)]
    fn stored<S: Real>(&self, seen: &Seen<S>) -> S {
        let ([up, turned], [vertical, roll]) = (self.deflections(seen), self.support);
        let [centering, turning] = self.gravity();
        (up * up * vertical
            + turned * turned * roll
            + seen.shift * seen.shift * centering
            + seen.forward * seen.forward * turning)
            * 0.5
    }

    /// Stiffnesses of gravity, N/m and N·m/rad; that of yaw is negative.
    fn gravity(&self) -> [f64; 2] {
        let (geometry, load) = (&self.wheelset.geometry, self.wheelset.axle_load);
        [
            load * geometry.contact_angle_rate,
            -load * geometry.half_distance * libm::sin(geometry.contact_angle),
        ]
    }
}

impl Element for LinearOnTrack {
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
        let of = |vector: [S; 3]| seen.axes.map(|axis| Vector(axis).dot::<S, S>(Vector(vector)));
        let (velocity, angular) = (of(motion.velocity.0), of(motion.angular_velocity.0));
        let (geometry, creep) = (&self.wheelset.geometry, &self.wheelset.creep);
        let speed = (velocity[0] * velocity[0] + self.slowest * self.slowest).sqrt();
        let inverse = speed.recip();
        // A wheelset that rolls backward is the mirror image of one that rolls forward.
        let coupling = rolling_sense(velocity[0], self.slowest) * creep.f23;
        let (mut force, mut moment, mut loss) = ([S::zero(); 3], [S::zero(); 3], S::zero());
        for side in [1.0, -1.0] {
            let arm = [
                S::zero(),
                S::from(side * geometry.half_distance),
                seen.roll * (side * geometry.half_distance)
                    - (seen.shift * (side * geometry.conicity) + geometry.radius),
            ];
            let Vector(carried) = Vector(angular).cross::<S, S>(Vector(arm));
            let slip = [velocity[0] + carried[0], velocity[1] + carried[1]];
            let mut tangential = [slip[0] * -creep.f11, slip[1] * -creep.f22];
            let mut about = S::zero();
            let slope = seen.shift * geometry.contact_angle_rate + side * libm::tan(geometry.contact_angle);
            let mut turning = S::zero();
            if self.wheelset.spin {
                turning = angular[2] - angular[1] * slope;
                tangential[1] -= turning * coupling;
                about = slip[1] * coupling - turning * creep.f33;
            }
            let [x, y] = tangential.map(|part| part * inverse);
            let about = about * inverse;
            let own = [x, y, S::zero()];
            let Vector(lever) = Vector(arm).cross::<S, S>(Vector(own));
            let couple = [S::zero(), -(about * slope), about];
            for i in 0..3 {
                force[i] += own[i];
                moment[i] += lever[i] + couple[i];
            }
            loss -= x * slip[0] + y * slip[1] + about * turning;
        }
        let ([up, turned], [vertical, rolling]) = (self.deflections(&seen), self.support);
        let [centering, turning] = self.gravity();
        // Minus the derivatives of what is stored by height, roll, shift and the forward part of the axle.
        let by_roll = -(turned * rolling);
        let by_shift = turned * (rolling * geometry.roll_coefficient) - seen.shift * centering;
        let by_forward = -(seen.forward * turning);
        force[1] += by_shift;
        force[2] -= up * vertical;
        moment[0] += by_roll + by_shift * geometry.radius;
        // The forward part of the axle falls by the yaw.
        moment[2] -= by_forward;
        let fixed = |[x, y, z]: [S; 3]| {
            let [a, b, c] = seen.axes;
            Vector([0, 1, 2].map(|i| a[i] * x + b[i] * y + c[i] * z))
        };
        let (force, moment) = (fixed(force), fixed(moment));
        let power: S = force.dot::<S, S>(motion.velocity) + moment.dot::<S, S>(motion.angular_velocity);
        let [place, direction] = ahead(motion);
        let moving = self.seen(place, direction);
        Wrench {
            force,
            moment,
            powers: [loss, power + loss + self.stored(&moving).derivative[0]],
        }
    }

    fn energy(&self, motion: &RelativeMotion<f64>) -> f64 {
        self.stored(&self.seen(motion.position.0, motion.rotation.column(1).0))
    }
}
