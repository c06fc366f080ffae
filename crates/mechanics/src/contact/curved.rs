//! Points on a curved surface, four at a time: contact kinematics, and the tangent.
//!
//! As for the plane ([`super::tangent`]), but the normal turns with the point: with K' the curvatures at its
//! distance, t and e the tangents, τ how these turn about the normal (see [`crate::surface`]), the point
//! moving by δr,
//!
//! ```text
//! (k, l) = K' (t·δr, e·δr),   ω = τ·(k, l),   δn = k t + l e,   δt = -k n + ω e,   δe = -l n - ω t
//! δg = n·δr,   δg' = n·δv + k v_t + l v_e,   δv_t = t·δv - k g' + ω v_e,   δv_e = e·δv - l g' - ω v_t
//! δF = δN n + δT_t t + δT_e e + N δn + T_t δt + T_e δe
//! ```

use numerics::lanes::Lanes;

use super::blocks::{OUTPUTS, PointBlock, PointDerivatives, Points};
use super::motion::FaceMotion;
use super::{PointForce, PointKinematics};
use crate::element::tangent::{Tangent, TangentColumn, TangentColumns, sum};
use crate::link::RelativeMotion;
use crate::surface::{Bend, SurfaceShape, compose, resolve};
use crate::vector::Vector;

/// A curved surface, and the motion of the body with the points.
#[derive(Clone, Copy, Debug)]
pub(crate) struct CurvedMotion<'s> {
    pub shape: &'s SurfaceShape,
    pub relative: &'s RelativeMotion<f64>,
}

impl FaceMotion for CurvedMotion<'_> {
    #[inline(always)]
    fn kinematics(&self, block: &PointBlock, bend: Option<&mut Bend<Lanes>>) -> PointKinematics<Lanes> {
        let relative = self.relative;
        let arm: Vector<Lanes> = relative.rotation.apply(block.position);
        let position = Vector(std::array::from_fn(|k| arm.0[k] + relative.position.0[k]));
        let spin: Vector<Lanes> = relative.angular_velocity.cross(arm);
        let velocity = Vector(std::array::from_fn(|k| spin.0[k] + relative.velocity.0[k]));
        let own = self.shape.bend(position);
        let [gap_rate, first, second] = resolve(&own.axes, velocity);
        if let Some(bend) = bend {
            *bend = own;
        }
        PointKinematics {
            gap: own.gap,
            gap_rate,
            slip: [first, second],
        }
    }

    #[inline(always)]
    fn push(&self, block: &PointBlock, bend: Option<&Bend<Lanes>>, forces: &PointForce<Lanes>) -> [Lanes; 8] {
        let [t1, t2] = forces.friction.force;
        let components = [forces.normal, t1, t2];
        let force = bend.map_or(Vector(components), |bend| compose(&bend.axes, components));
        let own: Vector<Lanes> = self.relative.rotation.transpose().apply(force);
        let moment: Vector<Lanes> = block.position.cross(own);
        let ([f1, f2, f3], [m1, m2, m3]) = (force.0, moment.0);
        [f1, f2, f3, m1, m2, m3, forces.friction.loss, forces.damping_loss]
    }
}

/// Four points where their law was differentiated.
struct Local<'p> {
    derivatives: &'p PointDerivatives,
    bend: &'p Bend<Lanes>,
    at: &'p PointKinematics<Lanes>,
    arm: Vector<Lanes>,
}

impl Local<'_> {
    /// Returns the change of the force (marker axes) and of the law's other outputs along a displacement and
    /// a change of the velocity of the points (marker axes).
    #[inline(always)]
    fn change(&self, moved: Vector<Lanes>, velocity: Vector<Lanes>) -> (Vector<Lanes>, [Lanes; OUTPUTS]) {
        let by = self.derivatives;
        let place = resolve(&self.bend.axes, moved);
        let mut speed = resolve(&self.bend.axes, velocity);
        let (k, l, turn) = self.bend.tilt(place[1], place[2]);
        let ([first, second], rate) = (self.at.slip, self.at.gap_rate);
        speed[0] += k * first + l * second;
        speed[1] += turn * second - k * rate;
        speed[2] -= turn * first + l * rate;
        let out: [Lanes; OUTPUTS] = std::array::from_fn(|o| {
            by.by_gap[o] * place[0]
                + by.by_rate[o] * speed[0]
                + by.by_slip[0][o] * speed[1]
                + by.by_slip[1][o] * speed[2]
        });
        let [normal, t, e] = by.force;
        let force = [
            out[0] - (k * t + l * e),
            out[1] + (k * normal - turn * e),
            out[2] + (l * normal + turn * t),
        ];
        (compose(&self.bend.axes, force), out)
    }

    /// Adds a column: the change of force, moment and losses, where the moment of the forces that there are
    /// changes by `carried`.
    #[inline(always)]
    fn add(
        &self,
        (force, out): (Vector<Lanes>, [Lanes; OUTPUTS]),
        carried: Vector<Lanes>,
        column: &mut TangentColumn,
        rate: &mut TangentColumn,
    ) {
        let moment: Vector<Lanes> = self.arm.cross::<Lanes, Lanes>(force) + carried;
        let ([f0, f1, f2], [m0, m1, m2]) = (force.0, moment.0);
        let own = [
            Lanes::sums([f0, f1, f2, out[3]]),
            Lanes::sums([m0, m1, m2, out[4]]),
        ];
        *column = sum(*column, own);
        *rate = [out[5], out[6]];
    }
}

impl Points {
    /// Returns the tangent of a face with a curved surface; see [`Points::tangent`].
    pub fn curved_tangent(&self, relative: &RelativeMotion<f64>, rates: &mut [TangentColumns]) -> Tangent {
        let mut tangent = Tangent::NONE;
        let (zero, none) = (Lanes::ZERO, Vector([Lanes::ZERO; 3]));
        let mut sums = [zero; 8];
        let blocks = self
            .blocks
            .iter()
            .zip(&self.derivatives)
            .zip(&self.kinematics)
            .zip(&self.bends);
        for (number, (((block, derivatives), at), bend)) in blocks.enumerate() {
            if !derivatives.active {
                continue;
            }
            let arm: Vector<Lanes> = relative.rotation.apply(block.position);
            let local = Local {
                derivatives,
                bend,
                at,
                arm,
            };
            let own = compose(&bend.axes, derivatives.force);
            let ([f0, f1, f2], [m0, m1, m2]) = (own.0, arm.cross::<Lanes, Lanes>(own).0);
            for (sum, term) in sums.iter_mut().zip([f0, f1, f2, m0, m1, m2]) {
                *sum += term;
            }
            let mut nowhere = TangentColumns::NONE;
            let rate = rates.get_mut(number).unwrap_or(&mut nowhere);
            let by = &mut tangent.by;
            let [x, y, z] = arm.0;
            let turned = [[zero, -z, y], [z, zero, -x], [-y, x, zero]];
            for k in 0..3 {
                let mut unit = none;
                unit.0[k] = Lanes::from(1.0);
                let column = local.change(unit, none);
                local.add(column, none, &mut by.position[k], &mut rate.position[k]);
                let column = local.change(none, unit);
                local.add(column, none, &mut by.velocity[k], &mut rate.velocity[k]);
                // e_k × r
                let moved = Vector(turned[k]);
                let carried: Vector<Lanes> = relative.angular_velocity.cross(moved);
                let column = local.change(moved, carried);
                local.add(
                    column,
                    moved.cross(own),
                    &mut by.rotation[k],
                    &mut rate.rotation[k],
                );
                let column = local.change(none, moved);
                let (by, rate) = (&mut by.angular_velocity[k], &mut rate.angular_velocity[k]);
                local.add(column, none, by, rate);
            }
        }
        let [f0, f1, f2, m0, m1, m2, ..] = sums;
        let [f0, f1, f2, m0] = Lanes::sums([f0, f1, f2, m0]).to_array();
        let [m1, m2, ..] = Lanes::sums([m1, m2, zero, zero]).to_array();
        tangent.force = Vector([f0, f1, f2]);
        tangent.moment = Vector([m0, m1, m2]);
        tangent
    }
}
