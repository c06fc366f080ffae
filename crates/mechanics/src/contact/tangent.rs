//! The tangent of a face: the chain rule of points on a rigid body.
//!
//! With a small change d of the body's origin, φ of its rotation, δv and δω of its velocities, all in marker
//! axes, and r from the origin to a point,
//!
//! ```text
//! δr = φ × r,   δg = (d + δr)·n,   δv_P = δv + δω × r + ω × δr,   δM = r × δF + δr × F
//! ```
//!
//! Of a face whose first tangent has an arm a, that slip has `a ω_2` more, and the moment `a T_1` about
//! the second. A plane's forces change neither with a displacement along it nor with one point's friction
//! at another.

use numerics::lanes::Lanes;
use numerics::scalar::Number;

use super::blocks::{OUTPUTS, PointDerivatives, Points};
use crate::element::tangent::{Tangent, TangentColumn, TangentColumns, sum};
use crate::link::RelativeMotion;
use crate::vector::Vector;

/// Adds the derivatives of the law's outputs by the velocity of a point.
#[inline(always)]
fn by_velocity(
    derivatives: &PointDerivatives,
    [normal, first, second]: [Lanes; 3],
    out: &mut [Lanes; OUTPUTS],
) {
    for (o, out) in out.iter_mut().enumerate() {
        // Neither the normal force nor the loss in contact damping depend on slip.
        if o != 0 && o != 4 {
            *out += derivatives.by_slip[0][o] * first + derivatives.by_slip[1][o] * second;
        }
        *out += derivatives.by_rate[o] * normal;
    }
}

impl Points {
    /// Returns the tangent of a face where its law was differentiated, of a plane by itself: with
    /// [`Points::curved_tangent`] runs take 2 to 10 % more instructions. `rates` receives the derivatives of
    /// the rates of internal states, of four points at a time: those of the first state of each, and of the
    /// second; it is empty where there are none.
    #[inline(always)]
    pub fn tangent(&self, relative: &RelativeMotion<f64>, rates: &mut [TangentColumns]) -> Tangent {
        if self.is_curved() {
            return self.curved_tangent(relative, rates);
        }
        let mut tangent = Tangent::NONE;
        let spin = relative.angular_velocity;
        let mut sums = [Lanes::ZERO; 8];
        for (number, (block, derivatives)) in self.blocks.iter().zip(&self.derivatives).enumerate() {
            if !derivatives.active {
                continue;
            }
            let arm: Vector<Lanes> = relative.rotation.apply(block.position);
            let [x, y, z] = arm.0;
            let own = Vector(derivatives.force);
            let ([f0, f1, f2], [m0, m1, m2]) = (own.0, arm.cross::<Lanes, Lanes>(own).0);
            let m2 = m2 + f1 * self.first_arm;
            for (sum, term) in sums.iter_mut().zip([f0, f1, f2, m0, m1, m2]) {
                *sum += term;
            }
            let summed = |out: &[Lanes; OUTPUTS], carried: Vector<Lanes>| -> TangentColumn {
                let force = Vector([out[0], out[1], out[2]]);
                let moment: Vector<Lanes> = arm.cross::<Lanes, Lanes>(force) + carried;
                let ([f0, f1, f2], [m0, m1, m2]) = (force.0, moment.0);
                let m2 = m2 + f1 * self.first_arm;
                [
                    Lanes::sums([f0, f1, f2, out[3]]),
                    Lanes::sums([m0, m1, m2, out[4]]),
                ]
            };
            // Without internal states the derivatives of their rates are discarded.
            let mut nowhere = TangentColumns::NONE;
            let rate = rates.get_mut(number).unwrap_or(&mut nowhere);
            let add = |to: &mut TangentColumn, rate: &mut TangentColumn, out: &[Lanes; OUTPUTS], carried| {
                let column = summed(out, carried);
                *to = sum(*to, column);
                *rate = [out[5], out[6]];
            };
            let (zero, none) = (Lanes::ZERO, Vector([Lanes::ZERO; 3]));
            let by = &mut tangent.by;
            add(
                &mut by.position[0],
                &mut rate.position[0],
                &derivatives.by_gap,
                none,
            );
            add(
                &mut by.velocity[0],
                &mut rate.velocity[0],
                &derivatives.by_rate,
                none,
            );
            for (k, by_slip) in derivatives.by_slip.iter().enumerate() {
                add(&mut by.velocity[1 + k], &mut rate.velocity[1 + k], by_slip, none);
            }
            // e_k × r
            let turned = [[zero, -z, y], [z, zero, -x], [-y, x, zero]];
            for (k, moved) in turned.into_iter().enumerate() {
                let moved = Vector(moved);
                let mut out = derivatives.by_gap.map(|by| by * moved.0[0]);
                let carried: Vector<Lanes> = spin.cross(moved);
                by_velocity(derivatives, carried.0, &mut out);
                add(&mut by.rotation[k], &mut rate.rotation[k], &out, moved.cross(own));
                let mut out = [zero; OUTPUTS];
                let mut velocity = moved.0;
                if k == 2 {
                    velocity[1] += Lanes::from(self.first_arm);
                }
                by_velocity(derivatives, velocity, &mut out);
                let (by, rate) = (&mut by.angular_velocity[k], &mut rate.angular_velocity[k]);
                add(by, rate, &out, none);
            }
        }
        let [f0, f1, f2, m0, m1, m2, ..] = sums;
        let [f0, f1, f2, m0] = Lanes::sums([f0, f1, f2, m0]).to_array();
        let [m1, m2, ..] = Lanes::sums([m1, m2, Lanes::zero(), Lanes::zero()]).to_array();
        tangent.force = Vector([f0, f1, f2]);
        tangent.moment = Vector([m0, m1, m2]);
        tangent
    }
}
