//! The three angles of a body: rotation, angular velocity and acceleration.
//!
//! Orientation (Steets 2007, eqs. 3-3 and 3-6, with roll last): `R = Ry(pitch) · Rz(yaw) · Rx(roll)`. The
//! rotation axes of the angles are y, `Ry z` and `Ry Rz x`, so that
//! `ω = pitch˙ e_pitch + yaw˙ e_yaw + roll˙ e_roll`; with roll held this is (u4 sin q3, u3, u4 cos q3) in the
//! axes of the reference frame, and (u3 sin q4, u3 cos q4, u4) in those of the body, where moments are taken.

use numerics::scalar::Number;

use crate::vector::{Matrix, Vector, rotation_x, rotation_y, rotation_z};

/// A rotation, and the axes of its three angles in the axes of the body.
#[derive(Clone, Copy, Debug)]
pub struct Orientation<S> {
    /// From body axes to reference axes.
    pub rotation: Matrix<S>,
    /// The rotation axes of roll, pitch and yaw, body axes: x, `Rxᵀ (sin yaw, cos yaw, 0)`, `Rxᵀ z`.
    pub axes: [Vector<S>; 3],
}

impl<S: Number> Orientation<S> {
    /// Returns the orientation at the angles roll, pitch, yaw (rad). `rolls` states whether roll may differ
    /// from zero; otherwise its terms are left out.
    #[inline(always)]
    #[must_use]
    pub fn new(angles: [S; 3], rolls: bool) -> Self {
        let [roll, pitch, yaw] = angles;
        let (sp, cp) = pitch.sin_cos();
        let (sy, cy) = yaw.sin_cos();
        let (zero, one) = (S::zero(), S::from(1.0));
        let mut rotation = Matrix([
            [cp * cy, -(cp * sy), sp],
            [sy, cy, zero],
            [-(sp * cy), sp * sy, cp],
        ]);
        let mut axes = [
            Vector([one, zero, zero]),
            Vector([sy, cy, zero]),
            Vector([zero, zero, one]),
        ];
        if rolls {
            let (sr, cr) = roll.sin_cos();
            rotation = rotation.times(rotation_x((sr, cr)));
            axes[1] = Vector([sy, cr * cy, -(sr * cy)]);
            axes[2] = Vector([zero, sr, cr]);
        }
        Self { rotation, axes }
    }

    /// Returns the angular velocity for the rates of roll, pitch, yaw (rad/s), body axes.
    #[inline(always)]
    #[must_use]
    pub fn spin(&self, rates: [S; 3], rolls: bool) -> Vector<S> {
        let [_, pitch, yaw] = self.axes;
        let mut spin = pitch.scale(rates[1]);
        if rolls {
            spin += yaw.scale(rates[2]);
            spin.0[0] += rates[0];
        } else {
            spin.0[2] = rates[2];
        }
        spin
    }

    /// Returns the angular acceleration for rates and accelerations of roll, pitch, yaw, body axes: the rate
    /// of the components of [`Orientation::spin`], `Σ e_k q¨_k + pitch˙ yaw˙ (e_pitch × e_yaw) + roll˙
    /// (pitch˙ e_pitch + yaw˙ e_yaw) × e_roll`.
    #[inline(always)]
    #[must_use]
    pub fn spin_rate(&self, rates: [S; 3], accelerations: [S; 3], rolls: bool) -> Vector<S> {
        let [_, pitch, yaw] = self.axes;
        let product = rates[1] * rates[2];
        if rolls {
            let two = pitch.scale::<S, S>(rates[1]) + yaw.scale(rates[2]);
            let mut rate = pitch.scale::<S, S>(accelerations[1]) + yaw.scale(accelerations[2]);
            rate += pitch.cross::<S, S>(yaw).scale(product);
            rate + Vector([accelerations[0], two.0[2] * rates[0], -(two.0[1] * rates[0])])
        } else {
            let [sine, cosine, _] = pitch.0;
            Vector([
                sine * accelerations[1] + cosine * product,
                cosine * accelerations[1] - sine * product,
                accelerations[2],
            ])
        }
    }
}

/// Returns a fixed rotation by roll, pitch, yaw (rad), in the order of [`Orientation`].
#[must_use]
pub fn fixed(angles: [f64; 3]) -> Matrix<f64> {
    let [roll, pitch, yaw] = angles.map(libm::sincos);
    rotation_y(pitch).times(rotation_z(yaw).times(rotation_x(roll)))
}
