//! The three angles of a body: rotation, angular velocity and acceleration.
//!
//! Orientation (Steets 2007, eqs. 3-3 and 3-6, with roll last): `R = Ry(pitch) · Rz(yaw) · Rx(roll)`. The axes about which
//! the angles turn are y, `Ry z` and `Ry Rz x`, so that
//! `ω = pitch˙ e_pitch + yaw˙ e_yaw + roll˙ e_roll`; with roll held this is (u4 sin q3, u3, u4 cos q3).

use integrate::scalar::Real;

use crate::vector::{Matrix, Vector, rotation_x, rotation_y, rotation_z};

/// Rotation and the axes of its three angles, in the axes of the reference frame.
#[derive(Clone, Copy, Debug)]
pub struct Turn<S> {
    /// From body axes to reference axes.
    pub rotation: Matrix<S>,
    /// The axes about which roll, pitch and yaw turn.
    pub axes: [Vector<S>; 3],
}

impl<S: Real> Turn<S> {
    /// The turn by the angles roll, pitch, yaw (rad). `rolls` tells whether roll may differ from zero: without it,
    /// nothing is spent on it.
    #[inline(always)]
    #[must_use]
    pub fn new(angles: [S; 3], rolls: bool) -> Self {
        let [roll, pitch, yaw] = angles;
        let (sp, cp) = pitch.sin_cos();
        let (sy, cy) = yaw.sin_cos();
        let zero = S::zero();
        let mut rotation = Matrix([
            [cp * cy, -(cp * sy), sp],
            [sy, cy, zero],
            [-(sp * cy), sp * sy, cp],
        ]);
        let axes = [
            rotation.column(0),
            Vector([zero, S::from(1.0), zero]),
            Vector([sp, zero, cp]),
        ];
        if rolls {
            rotation = rotation.times(rotation_x(roll.sin_cos()));
        }
        Self { rotation, axes }
    }

    /// Angular velocity for the rates of roll, pitch, yaw (rad/s), reference axes.
    #[inline(always)]
    #[must_use]
    pub fn angular_velocity(&self, rates: [S; 3], rolls: bool) -> Vector<S> {
        let [_, pitch, yaw] = self.axes;
        let mut omega = Vector([yaw.0[0] * rates[2], rates[1] * pitch.0[1], yaw.0[2] * rates[2]]);
        if rolls {
            omega += self.axes[0].scale(rates[0]);
        }
        omega
    }

    /// Angular acceleration for rates and accelerations of roll, pitch, yaw, reference axes:
    /// `Σ e_k q¨_k + yaw˙ (pitch˙ e_pitch × e_yaw) + roll˙ ((pitch˙ e_pitch + yaw˙ e_yaw) × e_roll)`.
    #[inline(always)]
    #[must_use]
    pub fn angular_acceleration(&self, rates: [S; 3], accelerations: [S; 3], rolls: bool) -> Vector<S> {
        let [roll, pitch, yaw] = self.axes;
        let mut alpha = pitch.scale(accelerations[1]) + yaw.scale(accelerations[2]);
        // e_pitch × e_yaw = y × (sin, 0, cos) = (cos, 0, -sin)
        let product = rates[1] * rates[2];
        alpha += Vector([yaw.0[2] * product, S::zero(), -(yaw.0[0] * product)]);
        if rolls {
            let two = self.angular_velocity([S::zero(), rates[1], rates[2]], false);
            alpha += roll.scale(accelerations[0]) + two.cross(roll).scale(rates[0]);
        }
        alpha
    }
}

/// A fixed rotation by roll, pitch, yaw (rad), in the order of [`Turn`].
#[must_use]
pub fn fixed(angles: [f64; 3]) -> Matrix<f64> {
    let [roll, pitch, yaw] = angles.map(libm::sincos);
    rotation_y(pitch).times(rotation_z(yaw).times(rotation_x(roll)))
}
