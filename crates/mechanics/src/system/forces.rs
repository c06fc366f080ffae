//! The right-hand side: forces, accelerations, rates of the internal states, powers.

use std::ops::Mul;

use integrate::partitioned::Partitioned;
use integrate::scalar::Real;

use super::chain::Chain;
use super::jacobian::differentiate_internal;
use super::{FreeBody, Mounted, System};
use crate::body::{Kinematics, Rigid};
use crate::coil::{Coil, CoilForce};
use crate::contact::{ContactFace, FaceResultant, Points, View};
use crate::element::{Action, Element, Marked};
use crate::frame::FrameMotion;
use crate::link::{BodyWrench, Mount, Relative, Sight};
use crate::surface::Plane;
use crate::tangent::{Columns, Tangent};
use crate::vector::Vector;

/// An element in its place between two bodies.
pub(super) trait Mountable: Sized {
    /// What it does to the body that it carries; `rates` receives the rates of the internal states.
    fn act(
        &self,
        points: &mut Points,
        relative: &Relative<f64>,
        internal: &[f64],
        rates: &mut [f64],
    ) -> BodyWrench;

    /// The same seen from a mount that does not turn; none if it is nothing.
    fn act_from(
        &self,
        points: &mut Points,
        seen: (&Sight<f64>, &Kinematics<f64>),
        internal: &[f64],
        rates: &mut [f64],
    ) -> Option<BodyWrench>;

    /// Where its marker A is, from the origin of the body that it carries, body axes, m.
    fn marker(&self) -> Vector<f64> {
        Vector::zero()
    }

    /// The tangent by the motion of marker A; `rates` receives the derivatives of the rates of internal states, four pairs at a time.
    fn tangent(&self, points: &Points, relative: &Relative<f64>, rates: &mut [Columns]) -> Tangent;

    /// The derivatives by the internal states.
    fn differentiate_internal(
        _: &Mounted<Self>,
        _: &Chain<'_>,
        _: &Relative<f64>,
        _: &[Option<&FreeBody>; 2],
        _: &mut Partitioned,
    ) {
    }
}

/// The quadrature of the work of all prescribed motions: the first one.
pub(super) const WORK: usize = 0;

impl Mountable for ContactFace<Plane> {
    #[inline(always)]
    fn act(
        &self,
        points: &mut Points,
        relative: &Relative<f64>,
        internal: &[f64],
        rates: &mut [f64],
    ) -> BodyWrench {
        self.effect(points, &View::new(relative), internal, rates)
    }

    #[inline(always)]
    fn act_from(
        &self,
        points: &mut Points,
        (sight, body): (&Sight<f64>, &Kinematics<f64>),
        internal: &[f64],
        rates: &mut [f64],
    ) -> Option<BodyWrench> {
        if points.update_if_open(sight, body) {
            return None;
        }
        Some(self.effect(points, &View::of(sight, body), internal, rates))
    }

    #[inline(always)]
    fn tangent(&self, points: &Points, relative: &Relative<f64>, rates: &mut [Columns]) -> Tangent {
        points.tangent(relative, rates)
    }

    fn differentiate_internal(
        mounted: &Mounted<Self>,
        chain: &Chain<'_>,
        relative: &Relative<f64>,
        ends: &[Option<&FreeBody>; 2],
        jacobian: &mut Partitioned,
    ) {
        differentiate_internal(mounted, chain, relative, ends, jacobian);
    }
}

impl Mountable for Coil {
    #[inline(always)]
    fn act(&self, _: &mut Points, relative: &Relative<f64>, _: &[f64], _: &mut [f64]) -> BodyWrench {
        let coil = self.on_body(relative);
        BodyWrench {
            force: coil.force,
            moment: relative.rotation.apply_transposed(coil.moment),
            powers: [coil.loss, coil.guide_power],
        }
    }

    #[inline(always)]
    fn act_from(
        &self,
        _: &mut Points,
        (sight, body): (&Sight<f64>, &Kinematics<f64>),
        _: &[f64],
        _: &mut [f64],
    ) -> Option<BodyWrench> {
        Some(self.effect(sight, body))
    }

    fn marker(&self) -> Vector<f64> {
        self.end
    }

    #[inline(always)]
    fn tangent(&self, _: &Points, relative: &Relative<f64>, _: &mut [Columns]) -> Tangent {
        Tangent::of(self.inputs(), relative, self)
    }
}

impl Mountable for Marked {
    #[inline(always)]
    fn act(&self, _: &mut Points, relative: &Relative<f64>, _: &[f64], _: &mut [f64]) -> BodyWrench {
        let action = self.on_body(relative);
        BodyWrench {
            force: action.force,
            moment: relative.rotation.apply_transposed(action.moment),
            powers: action.powers,
        }
    }

    #[inline(always)]
    fn act_from(
        &self,
        points: &mut Points,
        (sight, body): (&Sight<f64>, &Kinematics<f64>),
        internal: &[f64],
        rates: &mut [f64],
    ) -> Option<BodyWrench> {
        Some(self.act(points, &sight.relative(body), internal, rates))
    }

    fn marker(&self) -> Vector<f64> {
        self.marker.origin
    }

    #[inline(always)]
    fn tangent(&self, _: &Points, relative: &Relative<f64>, _: &mut [Columns]) -> Tangent {
        self.element.tangent(&self.turned(relative))
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

    /// Force on the carried body (axes of its reference frame) and moment about its origin (body axes).
    #[inline(always)]
    pub fn on_body<T, K>(&self, sight: &Sight<T>, body: &Kinematics<K>) -> (Vector<S>, Vector<S>)
    where
        T: Real + Mul<S, Output = S>,
        K: Real + Mul<S, Output = S>,
    {
        let moment: Vector<S> = sight.rotation.apply_transposed(self.moment);
        (
            sight.rotation.apply_transposed(self.force),
            body.turn.rotation.apply_transposed(moment),
        )
    }

    /// The moment about the mount's origin, mount axes.
    #[inline(always)]
    pub fn moment_at_mount(&self, relative: &Relative<S>) -> Vector<S> {
        self.moment + relative.position.cross::<S, S>(self.force)
    }

    /// Force on the body that the element stands on (axes of its reference frame) and moment about its origin (body axes).
    #[inline(always)]
    pub fn reaction<T: Real + Mul<S, Output = S>>(
        &self,
        relative: &Relative<S>,
        on: &Kinematics<T>,
        mount: &Mount,
    ) -> (Vector<S>, Vector<S>)
    where
        f64: Mul<S, Output = S>,
    {
        let force: Vector<S> = -mount.rotation.apply::<S, S>(self.force);
        let moment: Vector<S> = -mount.rotation.apply::<S, S>(self.moment_at_mount(relative));
        (
            on.turn.rotation.apply(force),
            moment + mount.origin.cross::<S, S>(force),
        )
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
        // Powers are written, not added to what was zero, and rates copied body by body: calls of the system's functions for a few numbers take longer.
        let mut work = 0.0;
        for free in &self.free {
            let kinematics = &self.kinematics[free.body];
            let (mut force, mut moment) = (Vector::zero(), Vector::zero());
            for &face in &free.faces {
                let face = &mut self.faces[face];
                if face.plain {
                    let internal = &internal[face.first_internal..][..face.internal_count];
                    let rates = &mut d_internal[face.first_internal..][..face.internal_count];
                    let load = (&mut force, &mut moment);
                    push(
                        face,
                        kinematics,
                        (internal, rates),
                        load,
                        (d_quadratures, &mut work),
                    );
                }
            }
            for &coil in &free.coils {
                let coil = &mut self.coils[coil];
                if coil.plain {
                    let load = (&mut force, &mut moment);
                    push(coil, kinematics, (&[], &mut []), load, (d_quadratures, &mut work));
                }
            }
            (self.force[free.body], self.moment[free.body]) = (force, moment);
        }
        self.points_updated = true;
        if !self.plain {
            for face in self.faces.iter_mut().filter(|face| !face.plain) {
                let internal = &internal[face.first_internal..][..face.internal_count];
                let rates = &mut d_internal[face.first_internal..][..face.internal_count];
                let loads = (&mut self.force[..], &mut self.moment[..]);
                let powers = (&mut *d_quadratures, &mut work);
                apply(face, &self.kinematics, internal, rates, loads, powers);
            }
            for coil in self.coils.iter_mut().filter(|coil| !coil.plain) {
                let loads = (&mut self.force[..], &mut self.moment[..]);
                let powers = (&mut *d_quadratures, &mut work);
                apply(coil, &self.kinematics, &[], &mut [], loads, powers);
            }
            for element in &mut self.elements {
                let loads = (&mut self.force[..], &mut self.moment[..]);
                let powers = (&mut *d_quadratures, &mut work);
                apply(element, &self.kinematics, &[], &mut [], loads, powers);
            }
        }
        d_quadratures[WORK] = work;
        if !self.connections.is_empty() {
            d_quadratures[self.added.clone()].fill(0.0);
            for free in &self.free {
                self.loads[free.body] = self.given[free.body];
            }
            let (places, loads) = ((&self.positions[..], &self.rates[..]), &mut self.loads[..]);
            self.connections
                .forces(places, internal, d_internal, loads, d_quadratures);
        }
        for free in &self.free {
            if let Some(linear) = &free.linear {
                let own = free.offset..free.offset + free.free.len();
                d_positions[own.clone()].copy_from_slice(&speeds[own.clone()]);
                let load = &self.loads[free.body];
                for (j, target) in d_speeds[own].iter_mut().enumerate() {
                    *target = (load[free.free[j]] + linear.weight[j]) / linear.inertia[j];
                }
                continue;
            }
            let frame = &self.frames[free.body];
            let accelerations = accelerate(
                &self.kinematics[free.body],
                &free.rigid,
                (&frame.motion, !frame.fixed),
                self.gravity,
                (self.force[free.body], self.moment[free.body]),
            );
            let own = free.offset..free.offset + free.free.len();
            let rates = d_positions[own.clone()]
                .iter_mut()
                .zip(&mut d_speeds[own.clone()]);
            for ((rate, target), (speed, &k)) in rates.zip(speeds[own].iter().zip(&free.free)) {
                (*rate, *target) = (*speed, accelerations[k]);
            }
        }
    }
}

/// Adds what a plain element does to its body to force and moment, and writes the powers of its channels; a neighbour that is driven does
/// work.
#[inline(always)]
fn push<E: Mountable>(
    mounted: &mut Mounted<E>,
    kinematics: &Kinematics<f64>,
    (internal, rates): (&[f64], &mut [f64]),
    (force, moment): (&mut Vector<f64>, &mut Vector<f64>),
    (powers, work): (&mut [f64], &mut f64),
) {
    let sight = &mounted.sight;
    let seen = (sight, kinematics);
    let channels = &mounted.channels;
    match mounted
        .element
        .act_from(&mut mounted.points, seen, internal, rates)
    {
        Some(effect) => {
            *force += sight.rotation.apply_transposed::<f64, f64>(effect.force);
            *moment += effect.moment;
            write_powers(channels, effect.powers, powers);
            if mounted.driven {
                *work += sight.mount_velocity.dot::<f64, f64>(effect.force);
            }
        }
        None => write_powers(channels, [0.0; 2], powers),
    }
}

/// The powers of the channels of one element, which are its own.
#[inline(always)]
fn write_powers(channels: &[Option<usize>; 2], own: [f64; 2], powers: &mut [f64]) {
    for (channel, power) in channels.iter().zip(own) {
        if let Some(channel) = channel {
            powers[*channel] = power;
        }
    }
}

/// The accelerations of a body's coordinates under force and moment, in a reference frame that may move.
#[inline(always)]
fn accelerate(
    kinematics: &Kinematics<f64>,
    body: &Rigid,
    (frame, frame_moves): (&FrameMotion<f64>, bool),
    gravity: Vector<f64>,
    (force, moment): (Vector<f64>, Vector<f64>),
) -> [f64; 6] {
    if !body.rolls && !frame_moves {
        let field: Vector<f64> = frame.acceleration - gravity;
        let field: Vector<f64> = frame.rotation.apply_transposed(field);
        return kinematics.accelerations_without_roll(body, &field, &force, &moment);
    }
    let (inertia, turning) = kinematics.inertia(body, frame, frame_moves, gravity, &[0.0; 6]);
    let (force, moment) = (force - inertia, moment - turning);
    kinematics.accelerations(body, &force, kinematics.about_axes(&moment))
}

/// Adds what an element does that is not plain.
#[inline(always)]
fn apply<E: Mountable>(
    mounted: &mut Mounted<E>,
    kinematics: &[Kinematics<f64>],
    internal: &[f64],
    internal_rates: &mut [f64],
    (forces, moments): (&mut [Vector<f64>], &mut [Vector<f64>]),
    (powers, work): (&mut [f64], &mut f64),
) {
    let relative: Relative<f64> = mounted.sight.relative(&kinematics[mounted.body]);
    let effect = mounted
        .element
        .act(&mut mounted.points, &relative, internal, internal_rates);
    let sight = &mounted.sight;
    forces[mounted.body] += sight.rotation.apply_transposed(effect.force);
    moments[mounted.body] += effect.moment;
    write_powers(&mounted.channels, effect.powers, powers);
    let action = Action {
        force: effect.force,
        moment: relative.rotation.apply(effect.moment),
        powers: effect.powers,
    };
    if mounted.on_free {
        let (force, moment) = action.reaction(&relative, &kinematics[mounted.on], &mounted.mount);
        forces[mounted.on] += force;
        moments[mounted.on] += moment;
    }
    if mounted.driven {
        *work += action.drive_power(&relative, sight);
    }
}
