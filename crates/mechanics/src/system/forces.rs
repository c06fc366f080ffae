//! The right-hand side: forces, accelerations, rates of the internal states, powers.

use integrate::scalar::Real;
use std::ops::Mul;

use super::{Mounted, System};
use crate::body::Kinematics;
use crate::coil::Coil;
use crate::contact::ContactFace;
use crate::link::{Mount, Relative, Sight};
use crate::surface::Surface;
use crate::vector::{Matrix, Vector};

/// What an element does to the body that it carries, in mount axes.
#[derive(Clone, Copy, Debug)]
pub(super) struct Action<S> {
    /// Force, N.
    pub force: Vector<S>,
    /// Moment about the body's origin, N·m.
    pub moment: Vector<S>,
    /// Powers of the element's channels, W.
    pub powers: [S; 2],
}

/// An element between two bodies.
pub(super) trait Element {
    /// The action; `rates` receives the rates of the internal states, two at a time.
    fn act<S: Real>(
        &self,
        relative: &Relative<S>,
        internal: &[f64],
        rates: impl FnMut(usize, [S; 2]),
    ) -> Action<S>;
}

impl<F: Surface> Element for ContactFace<F> {
    #[inline(always)]
    fn act<S: Real>(
        &self,
        relative: &Relative<S>,
        internal: &[f64],
        mut rates: impl FnMut(usize, [S; 2]),
    ) -> Action<S> {
        let sum = self.evaluate(relative, internal, |point, contact| {
            if !internal.is_empty() {
                rates(point, contact.friction.rate);
            }
        });
        Action {
            force: sum.force,
            moment: sum.moment,
            powers: [sum.friction_loss, sum.damping_loss],
        }
    }
}

impl Element for Coil {
    #[inline(always)]
    fn act<S: Real>(&self, relative: &Relative<S>, _: &[f64], _: impl FnMut(usize, [S; 2])) -> Action<S> {
        let coil = self.evaluate(relative);
        Action {
            force: coil.force,
            moment: coil.moment,
            powers: [coil.loss, coil.guide_power],
        }
    }
}

impl<S: Real> Action<S> {
    /// Force on the carried body and moment about its origin, in its reference frame's axes.
    #[inline(always)]
    pub fn on_body<T: Real + Mul<S, Output = S>>(&self, sight: &Sight<T>) -> (Vector<S>, Vector<S>) {
        (
            sight.rotation.apply_transposed(self.force),
            sight.rotation.apply_transposed(self.moment),
        )
    }

    /// The moment about the mount's origin, mount axes.
    #[inline(always)]
    pub fn moment_at_mount(&self, relative: &Relative<S>) -> Vector<S> {
        self.moment + relative.position.cross::<S, S>(self.force)
    }

    /// Force on the body that the element stands on and moment about that body's origin, in its frame's axes.
    #[inline(always)]
    pub fn reaction<T: Real + Mul<S, Output = S> + Mul<f64, Output = T>>(
        &self,
        relative: &Relative<S>,
        on: &Kinematics<T>,
        mount: &Mount,
    ) -> (Vector<S>, Vector<S>) {
        let axes: Matrix<T> = on.turn.rotation.times(mount.rotation);
        let arm: Vector<T> = on.turn.rotation.apply(mount.origin);
        let force: Vector<S> = -axes.apply::<S, S>(self.force);
        let moment: Vector<S> = -axes.apply::<S, S>(self.moment_at_mount(relative));
        (force, moment + arm.cross::<S, S>(force))
    }

    /// The power that the prescribed motion of the body under the element delivers, W.
    #[inline(always)]
    pub fn drive_power<T: Real + Mul<S, Output = S>>(&self, relative: &Relative<S>, sight: &Sight<T>) -> S {
        let force: S = sight.mount_velocity.dot(self.force);
        let moment: S = sight.mount_angular_velocity.dot(self.moment_at_mount(relative));
        force + moment
    }
}

impl System {
    /// Accelerations, rates and powers at the state that [`System::place`] was called with.
    #[inline]
    pub(super) fn forces(&mut self, x: &[f64], dx: &mut [f64]) {
        let layout = self.layout;
        let [_, speeds, internal, _] = layout.split(x);
        let [d_positions, d_speeds, d_internal, d_quadratures] = layout.split_mut(dx);
        d_positions.copy_from_slice(speeds);
        d_quadratures.fill(0.0);
        for free in &self.free {
            self.force[free.body] = Vector::zero();
            self.moment[free.body] = Vector::zero();
        }
        for face in &self.faces {
            let internal = &internal[face.first_internal..][..face.internal_count];
            let rates = &mut d_internal[face.first_internal..][..face.internal_count];
            let moments = (&mut self.force[..], &mut self.moment[..]);
            apply(face, &self.kinematics, internal, rates, moments, d_quadratures);
        }
        for coil in &self.coils {
            let moments = (&mut self.force[..], &mut self.moment[..]);
            apply(coil, &self.kinematics, &[], &mut [], moments, d_quadratures);
        }
        for free in &self.free {
            let (body, kinematics) = (&self.bodies[free.body], &self.kinematics[free.body]);
            let frame = &self.frames[free.body];
            let (force, moment) =
                kinematics.inertia(body, &frame.motion, !frame.fixed, self.gravity, &[0.0; 6]);
            let (force, moment) = (self.force[free.body] - force, self.moment[free.body] - moment);
            let accelerations = kinematics.accelerations(body, &force, &moment);
            let target = &mut d_speeds[free.offset..free.offset + free.free.len()];
            for (target, &k) in target.iter_mut().zip(&free.free) {
                *target = accelerations[k];
            }
        }
    }
}

/// Adds what one element does.
#[inline(always)]
fn apply<E: Element>(
    mounted: &Mounted<E>,
    kinematics: &[Kinematics<f64>],
    internal: &[f64],
    internal_rates: &mut [f64],
    (forces, moments): (&mut [Vector<f64>], &mut [Vector<f64>]),
    powers: &mut [f64],
) {
    let relative: Relative<f64> = mounted.sight.relative(&kinematics[mounted.body]);
    let action = mounted.element.act(&relative, internal, |point, rate| {
        internal_rates[2 * point..2 * point + 2].copy_from_slice(&rate);
    });
    let (force, moment) = action.on_body(&mounted.sight);
    forces[mounted.body] += force;
    moments[mounted.body] += moment;
    if mounted.on_free {
        let (force, moment) = action.reaction(&relative, &kinematics[mounted.on], &mounted.mount);
        forces[mounted.on] += force;
        moments[mounted.on] += moment;
    }
    for (channel, power) in mounted.channels.iter().zip(action.powers) {
        if let Some(channel) = channel {
            powers[*channel] += power;
        }
    }
    if mounted.driven {
        powers[0] += action.drive_power(&relative, &mounted.sight);
    }
}
