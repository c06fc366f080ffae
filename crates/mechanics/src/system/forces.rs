//! The right-hand side: forces, accelerations, rates of the internal states, powers.

use integrate::scalar::{Dual, Real};
use std::ops::Mul;

use super::{Mounted, System};
use crate::body::Kinematics;
use crate::coil::{Coil, CoilForce};
use crate::contact::{Column, ContactFace, FaceResultant, Points};
use crate::link::{Mount, Relative, Sight};
use crate::surface::Plane;
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
pub(super) trait Element: Sized {
    /// The action; `rates` receives the rates of the internal states.
    fn act(
        &self,
        points: &Points,
        relative: &Relative<f64>,
        internal: &[f64],
        rates: &mut [f64],
    ) -> Action<f64>;

    /// The action with its derivatives; `rates` sees those of the rates of two internal states at a time.
    fn change<const N: usize>(
        &self,
        points: &Points,
        relative: &Relative<Dual<N>>,
        rates: impl FnMut(usize, [[f64; 2]; N]),
    ) -> Action<Dual<N>>;

    /// The same for the carried body's own coordinates `free` and their rates.
    #[inline(always)]
    fn change_with_body<const N: usize>(
        &self,
        points: &Points,
        sight: &Sight<f64>,
        seeded: &Kinematics<Dual<N>>,
        _free: &[usize],
        rates: impl FnMut(usize, [[f64; 2]; N]),
    ) -> Action<Dual<N>> {
        self.change(points, &sight.relative(seeded), rates)
    }
}

impl Element for ContactFace<Plane> {
    #[inline(always)]
    fn act(
        &self,
        points: &Points,
        relative: &Relative<f64>,
        internal: &[f64],
        rates: &mut [f64],
    ) -> Action<f64> {
        Action::of_face(&self.resultant(points, relative, internal, rates))
    }

    #[inline(always)]
    fn change<const N: usize>(
        &self,
        points: &Points,
        relative: &Relative<Dual<N>>,
        rates: impl FnMut(usize, [[f64; 2]; N]),
    ) -> Action<Dual<N>> {
        let internal = self.law.states_per_point() > 0;
        Action::of_face(&points.change(&Column::all(relative), internal, rates))
    }

    #[inline(always)]
    fn change_with_body<const N: usize>(
        &self,
        points: &Points,
        sight: &Sight<f64>,
        seeded: &Kinematics<Dual<N>>,
        free: &[usize],
        rates: impl FnMut(usize, [[f64; 2]; N]),
    ) -> Action<Dual<N>> {
        let internal = self.law.states_per_point() > 0;
        Action::of_face(&points.change(&Column::of_body(sight, seeded, free), internal, rates))
    }
}

impl Element for Coil {
    #[inline(always)]
    fn act(&self, _: &Points, relative: &Relative<f64>, _: &[f64], _: &mut [f64]) -> Action<f64> {
        Action::of_coil(&self.evaluate(relative))
    }

    #[inline(always)]
    fn change<const N: usize>(
        &self,
        _: &Points,
        relative: &Relative<Dual<N>>,
        _: impl FnMut(usize, [[f64; 2]; N]),
    ) -> Action<Dual<N>> {
        Action::of_coil(&self.evaluate(relative))
    }
}

impl<S: Real> Action<S> {
    /// That of a face.
    #[inline(always)]
    pub fn of_face(face: &FaceResultant<S>) -> Self {
        Self {
            force: face.force,
            moment: face.moment,
            powers: [face.friction_loss, face.damping_loss],
        }
    }

    /// That of a coil.
    #[inline(always)]
    pub fn of_coil(coil: &CoilForce<S>) -> Self {
        Self {
            force: coil.force,
            moment: coil.moment,
            powers: [coil.loss, coil.guide_power],
        }
    }

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
    let action = mounted
        .element
        .act(&mounted.points, &relative, internal, internal_rates);
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
