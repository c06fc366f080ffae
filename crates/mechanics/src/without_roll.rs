//! Accelerations of a body that does not roll, in a frame at rest: [`Kinematics::inertia`] and
//! [`Kinematics::accelerations`] without the terms that are zero.
//!
//! Without roll the axes of pitch θ and yaw ψ are `e_θ = (sin ψ, cos ψ, 0)` and `e_ψ = z` in the body's axes,
//! in which inertia does not couple them. At θ¨ = ψ¨ = 0 the angular acceleration is
//! `β = θ˙ψ˙ (cos ψ, -sin ψ, 0)` and the center of gravity at r is accelerated by `b = β × r + ω × (ω × r)`,
//! beside the field (the frame's acceleration less gravity). With force F and moment M at the body's origin,
//! the free translations eliminated:
//!
//! ```text
//! Σ_l J_kl q¨_l = e_k · (M - I β - ω × I ω - r × Rᵀ w),
//! w = F where the body is free to move, m (R b + field) where it is held,
//! J_kl = e_k · I e_l + m Σ_held h_k h_l,   h_k = e_k · (r × Rᵀ e_held),
//! R and e_held: from body axes to the frame's, and the direction there.
//! ```
//!
//! Units: m, rad, s, N.

use crate::body::{Kinematics, Rigid};
use crate::vector::Vector;

impl Kinematics<f64> {
    /// Returns the accelerations of the six coordinates (held ones: zero) under a force at the body's origin
    /// (frame axes) and a moment about it (body axes), where roll is held at zero and the frame rests;
    /// `field` is its acceleration less gravity, in its own axes.
    #[inline(always)]
    pub(crate) fn accelerations_without_roll(
        &self,
        body: &Rigid,
        field: &Vector<f64>,
        force: &Vector<f64>,
        moment: &Vector<f64>,
    ) -> [f64; 6] {
        let (free, rotation, arm) = (&body.free, &self.orientation.rotation, body.center_of_gravity);
        let [sine, cosine, _] = self.orientation.axes[1].0;
        let (zero, one) = (0.0, 1.0);
        let product = self.rates[1] * self.rates[2];
        let axis_rate = Vector([cosine * product, -(sine * product), zero]);
        let ([w1, w2, w3], [i1, i2, i3]) = (self.spin.0, body.inertia);
        let mut right = *moment
            - Vector([
                i1 * axis_rate.0[0] + w2 * w3 * (i3 - i2),
                i2 * axis_rate.0[1] + w3 * w1 * (i1 - i3),
                w1 * w2 * (i2 - i1),
            ]);
        let (mut pitch, mut both, mut yaw) = (i1 * sine * sine + i2 * cosine * cosine, zero, i3);
        // Acceleration of the center of gravity from the field's, body axes.
        let mut own = Vector::zero();
        if !body.central {
            let swing: Vector<f64> = self.spin.cross(arm);
            own = axis_rate.cross::<f64, f64>(arm) + self.spin.cross::<f64, f64>(swing);
            let mut carried = *force;
            for c in 0..3 {
                if free[c] {
                    continue;
                }
                let direction = Vector(rotation.0[c]);
                carried.0[c] = (direction.dot::<f64, f64>(own) + field.0[c]) * body.mass;
                let [lever1, lever2, by_yaw] = arm.cross::<f64, f64>(direction).0;
                let by_pitch = sine * lever1 + cosine * lever2;
                pitch += body.mass * by_pitch * by_pitch;
                both += body.mass * by_pitch * by_yaw;
                yaw += body.mass * by_yaw * by_yaw;
            }
            right = right - arm.cross::<f64, f64>(rotation.apply_transposed(carried));
        }
        let [mut about_pitch, mut about_yaw] = [sine * right.0[0] + cosine * right.0[1], right.0[2]];
        if !free[4] {
            (about_pitch, pitch, both) = (zero, one, zero);
        }
        if !free[5] {
            (about_yaw, yaw, both) = (zero, one, zero);
        }
        let inverse = one / (pitch * yaw - both * both);
        let pitching = (yaw * about_pitch - both * about_yaw) * inverse;
        let yawing = (pitch * about_yaw - both * about_pitch) * inverse;
        let mut out = [zero, zero, zero, zero, pitching, yawing];
        let mut relative = Vector::zero();
        if !body.central {
            own += Vector([sine * pitching, cosine * pitching, yawing]).cross::<f64, f64>(arm);
            relative = rotation.apply(own);
        }
        let inverse = one / body.mass;
        for c in 0..3 {
            if free[c] {
                out[c] = force.0[c] * inverse - field.0[c] - relative.0[c];
            }
        }
        out
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;
    use crate::body::Body;
    use crate::frame::Frame;

    fn numbers<const N: usize>() -> impl Strategy<Value = [f64; N]> {
        prop::array::uniform(-1.0_f64..1.0)
    }

    proptest! {
        /// With any coordinates held, and the center of gravity anywhere.
        #[test]
        fn is_what_the_general_equations_give(
            free in prop::array::uniform6(any::<bool>()),
            coordinates in numbers::<6>(),
            speeds in numbers::<6>(),
            loads in numbers::<6>(),
            arm in numbers::<3>(),
            central in any::<bool>(),
            inertia in prop::array::uniform3(0.1_f64..2.0),
        ) {
            let mut body = Body::prescribed("wedge", Frame::fixed([0.3, 0.0, 0.1], [0.1, -0.2, 0.3]));
            (body.mass, body.inertia) = (1.3, inertia);
            body.center_of_gravity = if central { [0.0; 3] } else { arm };
            body.free = free;
            body.free[3] = false;
            let held = |values: [f64; 6]| std::array::from_fn(|k| if body.free[k] { values[k] } else { 0.0 });
            let kinematics = Kinematics::new(held(coordinates), held(speeds), false);
            let frame = body.frame.evaluate(0.0, 0.0);
            let gravity = Vector([0.0, 0.0, -9.81]);
            let [fx, fy, fz, mx, my, mz] = loads;
            let (force, moment) = (Vector([fx, fy, fz]), Vector([mx, my, mz]));
            let rigid = body.rigid();

            let (inertia, gyroscopic) = kinematics.inertia(&rigid, &frame, false, gravity, &[0.0; 6]);
            let expected = kinematics.accelerations(
                &rigid,
                &(force - inertia),
                kinematics.about_axes(&(moment - gyroscopic)),
            );
            let field: Vector<f64> = frame.rotation.apply_transposed(frame.acceleration - gravity);
            let found = kinematics.accelerations_without_roll(&rigid, &field, &force, &moment);
            for (found, expected) in found.iter().zip(expected) {
                prop_assert!(
                    (found - expected).abs() <= 1e-12 * (10.0 + expected.abs()),
                    "{found} {expected}",
                );
            }
        }
    }
}
