//! Rigid bodies in absolute coordinates, each with its own set of free coordinates.
//!
//! A body has six coordinates x, y, z, roll, pitch, yaw, measured from its reference frame along that frame's
//! axes. Some are free, the others are held. There are no algebraic constraints: a joint is a held coordinate
//! or a stiff element. So the mass matrix is block diagonal, one block a body.
//!
//! Equations of motion (Kane's method, generalized speeds = rates of the free coordinates): `M q¨ = Q - b`,
//! `M = m J_vᵀJ_v + J_ωᵀ I J_ω`, with J_v the velocity Jacobian of the center of gravity, J_ω that of the
//! angular velocity, Q the generalized forces and b the bias `m J_vᵀ a_b + J_ωᵀ (I α_b + ω × I ω)`, where a_b
//! and α_b are the accelerations at q¨ = 0 (Steets 2007, eq. 3-9, derived anew).

use std::ops::{Add, Mul};

use numerics::scalar::Number;
use serde::{Deserialize, Serialize};

use crate::frame::{Frame, FrameMotion};
use crate::link::Marker;
use crate::motion::Motion;
use crate::orientation::Orientation;
use crate::vector::{Matrix, Vector};

/// The names of a body's coordinates, in their order.
pub const COORDINATES: [&str; 6] = ["x", "y", "z", "roll", "pitch", "yaw"];

/// A rigid body.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Body {
    /// Its name, as in results.
    pub name: String,
    /// Mass, kg; of no effect on a body without free coordinates.
    pub mass: f64,
    /// Principal moments of inertia about the center of gravity, body axes, kg·m².
    pub inertia: [f64; 3],
    /// Center of gravity from the body's origin, body axes, m.
    pub center_of_gravity: [f64; 3],
    /// The frame of its coordinates.
    pub frame: Frame,
    /// The free coordinates among x, y, z, roll, pitch, yaw.
    pub free: [bool; 6],
    /// The values of all coordinates at the start; held coordinates keep them. m, rad.
    pub initial: [f64; 6],
    /// True if its kinematics are linearized: displacements of its center of gravity and small rotations
    /// about x, y, z, along the axes of a frame at rest; its mass matrix is constant and diagonal, and there
    /// are no gyroscopic terms. Force elements use its exact pose at these coordinates. If it is
    /// prescribed, its frame's motions are its coordinates.
    #[serde(default)]
    pub linearized: bool,
}

impl Body {
    /// Returns a body whose motion is prescribed: its origin rides on the frame.
    #[must_use]
    pub fn prescribed(name: &str, frame: Frame) -> Self {
        Self {
            name: name.to_owned(),
            mass: 0.0,
            inertia: [0.0; 3],
            center_of_gravity: [0.0; 3],
            frame,
            free: [false; 6],
            initial: [0.0; 6],
            linearized: false,
        }
    }

    /// Returns a body with six free coordinates, measured from the fixed frame, its center of gravity at its
    /// origin: mass (kg), principal moments of inertia (kg·m²), coordinates at the start (m, rad).
    #[must_use]
    pub fn free(name: &str, mass: f64, inertia: [f64; 3], initial: [f64; 6]) -> Self {
        Self {
            mass,
            inertia,
            free: [true; 6],
            initial,
            ..Self::prescribed(name, Frame::fixed([0.0; 3], [0.0; 3]))
        }
    }

    /// Returns a body with linearized kinematics: its center of gravity in the drawn layout (m), which
    /// coordinates are free, mass (kg) and principal moments of inertia (kg·m²). The other coordinates stay
    /// at zero.
    #[must_use]
    pub fn linearized(
        name: &str,
        center_of_gravity: [f64; 3],
        free: [bool; 6],
        mass: f64,
        inertia: [f64; 3],
    ) -> Self {
        Self {
            mass,
            inertia,
            free,
            linearized: true,
            ..Self::prescribed(name, Frame::fixed(center_of_gravity, [0.0; 3]))
        }
    }

    /// Returns a body with linearized kinematics and prescribed motions of its center of gravity (x, y, z, m)
    /// and of its rotations (roll, pitch, yaw, rad) from the drawn layout.
    #[must_use]
    pub fn linearized_prescribed(name: &str, center_of_gravity: [f64; 3], motions: [Motion; 6]) -> Self {
        let mut frame = Frame::fixed(center_of_gravity, [0.0; 3]);
        frame.motions = motions;
        Self {
            linearized: true,
            ..Self::prescribed(name, frame)
        }
    }

    /// Returns a body with linearized kinematics that does not move, at the origin.
    #[must_use]
    pub fn ground() -> Self {
        Self::linearized("ground", [0.0; 3], [false; 6], 0.0, [0.0; 3])
    }

    /// Returns the marker at a place (m) of the nominal layout, in which the body's frame stands at its
    /// origin, turned by roll, pitch, yaw (rad), both along the fixed axes. The frame may be turned.
    #[must_use]
    pub fn marker(&self, place: [f64; 3], angles: [f64; 3]) -> Marker {
        let origin = self.frame.origin;
        let along = Marker::new(std::array::from_fn(|k| place[k] - origin[k]), angles);
        if self.frame.orientation == [0.0; 3] {
            return along;
        }
        let axes = crate::orientation::fixed(self.frame.orientation).transpose();
        Marker {
            origin: axes.apply(along.origin),
            rotation: axes.times(along.rotation),
        }
    }

    /// Returns whether no coordinate is free.
    #[must_use]
    pub fn is_prescribed(&self) -> bool {
        !self.free.contains(&true)
    }

    /// Returns whether the body is prescribed and moves.
    #[must_use]
    pub fn is_moving_prescribed(&self) -> bool {
        self.is_prescribed() && !self.frame.is_fixed()
    }

    /// Returns the number of free coordinates.
    #[must_use]
    pub fn free_count(&self) -> usize {
        self.free.iter().filter(|free| **free).count()
    }

    /// Returns whether roll can differ from zero.
    pub(crate) fn rolls(&self) -> bool {
        self.free[3] || self.initial[3] != 0.0
    }

    /// Returns its mass properties and free coordinates, on which its motion depends.
    #[inline(always)]
    pub(crate) fn rigid(&self) -> Rigid {
        Rigid {
            mass: self.mass,
            inertia: self.inertia,
            center_of_gravity: Vector(self.center_of_gravity),
            central: self.center_of_gravity == [0.0; 3],
            free: self.free,
            rolls: self.rolls(),
        }
    }
}

/// The mass properties and free coordinates of a body, on which its motion depends.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Rigid {
    pub mass: f64,
    pub inertia: [f64; 3],
    pub center_of_gravity: Vector<f64>,
    /// True if the center of gravity is the origin.
    pub central: bool,
    pub free: [bool; 6],
    /// True if roll can differ from zero.
    pub rolls: bool,
}

/// Position and velocity of a body relative to its reference frame, in that frame's axes (SI).
#[derive(Clone, Copy, Debug)]
pub struct Kinematics<S> {
    /// Position of the body's origin.
    pub position: Vector<S>,
    /// Velocity of the body's origin.
    pub velocity: Vector<S>,
    /// Rotation and axes of the angles.
    pub orientation: Orientation<S>,
    /// Rates of roll, pitch, yaw.
    pub rates: [S; 3],
    /// Angular velocity, body axes.
    pub spin: Vector<S>,
}

impl<S: Number> Kinematics<S> {
    /// Makes it from all six coordinates and their rates.
    #[inline(always)]
    #[must_use]
    pub fn new(coordinates: [S; 6], speeds: [S; 6], rolls: bool) -> Self {
        let [x, y, z, roll, pitch, yaw] = coordinates;
        let rates = [speeds[3], speeds[4], speeds[5]];
        let orientation = Orientation::new([roll, pitch, yaw], rolls);
        let spin = orientation.spin(rates, rolls);
        Self {
            position: Vector([x, y, z]),
            velocity: Vector([speeds[0], speeds[1], speeds[2]]),
            orientation,
            rates,
            spin,
        }
    }

    /// Returns the angular velocity, axes of the reference frame.
    #[inline(always)]
    #[must_use]
    pub fn angular_velocity(&self) -> Vector<S> {
        self.orientation.rotation.apply(self.spin)
    }

    /// Returns the generalized force of coordinate `k` by a force at the body's origin (frame axes) and a
    /// moment about it (body axes).
    #[inline(always)]
    #[must_use]
    pub fn generalized(&self, k: usize, force: &Vector<S>, moment: &Vector<S>) -> S {
        match k {
            0..=2 => force.0[k],
            3 => moment.0[0],
            _ => self.orientation.axes[k - 3].dot(*moment),
        }
    }

    /// Returns the force at the body's origin (frame axes) and the moment about it (body axes) that give the
    /// body the accelerations `accelerations` of its six coordinates: inertia `m a` at the center of gravity
    /// and `I α + ω × I ω`, less gravity.
    ///
    /// `frame` is the motion of the reference frame, `gravity` the field in fixed axes (m/s²).
    #[inline(always)]
    pub(crate) fn inertia<T>(
        &self,
        body: &Rigid,
        frame: &FrameMotion<T>,
        frame_moves: bool,
        gravity: Vector<f64>,
        accelerations: &[f64; 6],
    ) -> (Vector<S>, Vector<S>)
    where
        S: Add<T, Output = S>,
        T: Number + Mul<S, Output = S>,
    {
        let a = accelerations;
        let orientation = &self.orientation;
        let angle_accelerations = [S::from(a[3]), S::from(a[4]), S::from(a[5])];
        let (mut omega, mut alpha) = (
            self.spin,
            orientation.spin_rate(self.rates, angle_accelerations, body.rolls),
        );
        let field: Vector<T> = frame.acceleration - Vector::<T>::lift(gravity);
        let own: Vector<T> = frame.rotation.apply_transposed(field);
        let mut force = Vector([S::from(a[0]), S::from(a[1]), S::from(a[2])]) + own;
        if frame_moves {
            // Transport, centripetal and Coriolis parts of a turning frame, in its own axes.
            let spin: Vector<T> = frame.rotation.apply_transposed(frame.angular_velocity);
            let spin_rate: Vector<T> = frame.rotation.apply_transposed(frame.angular_acceleration);
            let transport: Vector<S> = spin_rate.cross(self.position);
            let swing: Vector<S> = spin.cross(self.position);
            let centripetal: Vector<S> = spin.cross(swing);
            let coriolis: Vector<S> = spin.cross(self.velocity);
            force += transport + centripetal + coriolis + coriolis;
            let drag: Vector<S> = spin.cross(self.angular_velocity());
            alpha += orientation.rotation.apply_transposed::<S, S>(drag + spin_rate);
            omega += orientation
                .rotation
                .apply_transposed::<S, S>(Vector::<S>::zero() + spin);
        }
        if !body.central {
            let arm = body.center_of_gravity;
            let swing: Vector<S> = omega.cross(arm);
            let own: Vector<S> = alpha.cross::<f64, S>(arm) + omega.cross(swing);
            force += orientation.rotation.apply::<S, S>(own);
        }
        let force = force.scale::<f64, S>(body.mass);
        // Euler's equations.
        let ([w1, w2, w3], [e1, e2, e3]) = (omega.0, alpha.0);
        let [i1, i2, i3] = body.inertia;
        let mut moment = Vector([
            e1 * i1 + w2 * w3 * (i3 - i2),
            e2 * i2 + w3 * w1 * (i1 - i3),
            e3 * i3 + w1 * w2 * (i2 - i1),
        ]);
        if !body.central {
            let [x, y, z] = body.center_of_gravity.0;
            let [f1, f2, f3] = orientation.rotation.apply_transposed::<S, S>(force).0;
            moment += Vector([f3 * y - f2 * z, f1 * z - f3 * x, f2 * x - f1 * y]);
        }
        (force, moment)
    }
}

impl Kinematics<f64> {
    /// Returns the parts of a moment (body axes) about the axes of roll, pitch, yaw.
    #[inline(always)]
    pub(crate) fn about_axes(&self, moment: &Vector<f64>) -> [f64; 3] {
        [0, 1, 2].map(|k| self.orientation.axes[k].dot::<f64, f64>(*moment))
    }

    /// Returns the accelerations of the six coordinates (held ones: zero) under a force at the body's origin
    /// (frame axes) and moments about the axes of its angles ([`Kinematics::about_axes`]), bias and gravity
    /// already taken off.
    ///
    /// Solves `M q¨ = Q` by eliminating the translations, whose block of M is m times the unit matrix: the
    /// remainder is the inertia of the free rotations about the center of gravity, plus that of the mass in
    /// the held directions. A body that cannot be accelerated (no inertia) gives infinite or undefined
    /// values.
    #[inline(always)]
    #[must_use]
    pub(crate) fn accelerations(&self, body: &Rigid, force: &Vector<f64>, moments: [f64; 3]) -> [f64; 6] {
        let (free, axes, rotation) = (&body.free, &self.orientation.axes, &self.orientation.rotation);
        let (arm, central) = (body.center_of_gravity, body.central);
        let (zero, one) = (0.0, 1.0);
        // By the angles' rates: the angular velocity, and the center of gravity's velocity in held
        // directions.
        let mut spin = [Vector::<f64>::zero(); 3];
        let mut held = [[zero; 3]; 3];
        let mut right = [zero; 3];
        let mut torque = Vector::zero();
        if !central {
            let mut carried = *force;
            for c in (0..3).filter(|c| !free[*c]) {
                carried.0[c] = zero;
                let length: Vector<f64> = arm.cross(Vector(rotation.0[c]));
                held[c] = [0, 1, 2].map(|k| axes[k].dot::<f64, f64>(length));
            }
            torque = arm.cross::<f64, f64>(rotation.apply_transposed(carried));
        }
        for k in (0..3).filter(|k| free[3 + k]) {
            spin[k] = axes[k];
            right[k] = moments[k] - axes[k].dot::<f64, f64>(torque);
        }
        let entry = |k: usize, l: usize| {
            let mut value = if k == l && !free[3 + k] { one } else { zero };
            for c in 0..3 {
                value += body.inertia[c] * spin[k].0[c] * spin[l].0[c];
            }
            if !central && free[3 + k] && free[3 + l] {
                for c in (0..3).filter(|c| !free[*c]) {
                    value += body.mass * held[c][k] * held[c][l];
                }
            }
            value
        };
        let turns = if free[3] {
            // L D Lᵀ of the 3 × 3 matrix.
            let d0 = entry(0, 0);
            let (l10, l20) = (entry(1, 0) / d0, entry(2, 0) / d0);
            let d1 = entry(1, 1) - l10 * l10 * d0;
            let l21 = (entry(2, 1) - l20 * l10 * d0) / d1;
            let d2 = entry(2, 2) - l20 * l20 * d0 - l21 * l21 * d1;
            let y1 = right[1] - l10 * right[0];
            let y2 = right[2] - l20 * right[0] - l21 * y1;
            let yaw = y2 / d2;
            let pitch = y1 / d1 - l21 * yaw;
            [right[0] / d0 - l10 * pitch - l20 * yaw, pitch, yaw]
        } else {
            let (a, b, c) = (entry(1, 1), entry(2, 1), entry(2, 2));
            let inverse = one / (a * c - b * b);
            [
                zero,
                (c * right[1] - b * right[2]) * inverse,
                (a * right[2] - b * right[1]) * inverse,
            ]
        };
        let mut out = [zero; 6];
        let inverse = one / body.mass;
        let mut swing = Vector::zero();
        if !central {
            let alpha = spin[0].scale::<f64, f64>(turns[0])
                + spin[1].scale::<f64, f64>(turns[1])
                + spin[2].scale::<f64, f64>(turns[2]);
            swing = rotation.apply(alpha.cross::<f64, f64>(arm));
        }
        for c in 0..3 {
            if free[c] {
                out[c] = force.0[c] * inverse - swing.0[c];
            }
            out[3 + c] = turns[c];
        }
        out
    }
}

/// The free angles of a body: their axes, the derivatives of the angular velocity by them at fixed rates, and
/// the angular velocity (body axes). Slots beyond the number of free angles have no meaning.
#[derive(Clone, Copy, Debug)]
pub(crate) struct RotationAxes {
    pub axes: [Vector<f64>; 3],
    pub axis_rates: [Vector<f64>; 3],
    pub spin: Vector<f64>,
}

impl RotationAxes {
    /// Of a body without free angles.
    pub const NONE: Self = Self {
        axes: [Vector([0.0; 3]); 3],
        axis_rates: [Vector([0.0; 3]); 3],
        spin: Vector([0.0; 3]),
    };
}

impl Kinematics<f64> {
    /// Returns the axes of the free angles, their rates and the angular velocity (body axes).
    pub(crate) fn rotation_axes(&self, free: &[usize]) -> RotationAxes {
        let [roll, pitch, yaw] = self.orientation.axes;
        let before_yaw = pitch.scale::<f64, f64>(self.rates[1]);
        let before_roll = before_yaw + yaw.scale::<f64, f64>(self.rates[2]);
        // An axis turns with the angles behind it: pitch comes first, then yaw, then roll.
        let axis_rates = [before_roll.cross(roll), Vector::zero(), before_yaw.cross(yaw)];
        let mut rotation_axes = RotationAxes {
            axes: self.orientation.axes,
            axis_rates,
            spin: self.spin,
        };
        for (slot, k) in free.iter().filter(|k| **k >= 3).enumerate() {
            rotation_axes.axes[slot] = self.orientation.axes[k - 3];
            rotation_axes.axis_rates[slot] = axis_rates[k - 3];
        }
        rotation_axes
    }

    /// Returns the velocity of the center of gravity by the rate of angle `k` (roll, pitch, yaw), frame axes.
    #[inline(always)]
    fn lever(&self, body: &Body, k: usize) -> Vector<f64> {
        let own: Vector<f64> = self.orientation.axes[k].cross(Vector(body.center_of_gravity));
        self.orientation.rotation.apply(own)
    }

    /// The block of the mass matrix for the free coordinates, row-major `n × n`.
    #[inline(always)]
    pub fn mass_matrix(&self, body: &Body, free: &[usize], mass: &mut [f64]) {
        let mut velocity = [Vector::zero(); 6];
        let mut spin = [Vector::zero(); 6];
        for &k in free {
            if k < 3 {
                velocity[k].0[k] = 1.0;
            } else {
                velocity[k] = self.lever(body, k - 3);
                spin[k] = self.orientation.axes[k - 3];
            }
        }
        let n = free.len();
        for (row, &i) in free.iter().enumerate() {
            for (column, &j) in free.iter().enumerate().take(row + 1) {
                let mut value: f64 = body.mass * velocity[i].dot::<f64, f64>(velocity[j]);
                if i >= 3 && j >= 3 {
                    for (axis, inertia) in body.inertia.iter().enumerate() {
                        value += inertia * spin[i].0[axis] * spin[j].0[axis];
                    }
                }
                mass[row * n + column] = value;
                mass[column * n + row] = value;
            }
        }
    }

    /// Returns the kinetic energy in the fixed frame, J.
    #[must_use]
    pub fn kinetic_energy(&self, body: &Body, frame: &FrameMotion<f64>) -> f64 {
        let (velocity, omega) = self.absolute(frame, Vector(body.center_of_gravity));
        let w: Vector<f64> = self.orientation.rotation.apply_transposed(omega);
        let spin: f64 = (0..3).map(|k| body.inertia[k] * w.0[k] * w.0[k]).sum();
        0.5 * (body.mass * velocity.dot::<f64, f64>(velocity) + spin)
    }

    /// Returns the velocity of a point of the body and its angular velocity in the fixed frame, along the
    /// reference frame's axes.
    #[must_use]
    pub fn absolute(&self, frame: &FrameMotion<f64>, point: Vector<f64>) -> (Vector<f64>, Vector<f64>) {
        let arm: Vector<f64> = self.orientation.rotation.apply(point);
        let offset: Vector<f64> = self.position + arm;
        let spin: Vector<f64> = frame.rotation.apply_transposed(frame.angular_velocity);
        let origin: Vector<f64> = frame.rotation.apply_transposed(frame.velocity);
        let angular_velocity = self.angular_velocity();
        let own: Vector<f64> = angular_velocity.cross(arm);
        let carried: Vector<f64> = spin.cross(offset);
        (origin + self.velocity + own + carried, angular_velocity + spin)
    }

    /// Returns the position of a point of the body in the fixed frame.
    #[must_use]
    pub fn point_position(&self, frame: &FrameMotion<f64>, point: Vector<f64>) -> Vector<f64> {
        let arm: Vector<f64> = self.orientation.rotation.apply(point);
        frame.position + frame.rotation.apply::<f64, f64>(self.position + arm)
    }

    /// Returns the rotation from body axes to fixed axes.
    #[must_use]
    pub fn orientation(&self, frame: &FrameMotion<f64>) -> Matrix<f64> {
        frame.rotation.times(self.orientation.rotation)
    }
}
