//! The right-hand side: forces, accelerations, rates of the internal states, powers.

use std::ops::Mul;

use numerics::partitioned::Partitioned;
use numerics::scalar::Real;

use super::chain::Chain;
use super::jacobian::{differentiate_internal, differentiate_states};
use super::{FreeBody, Mounted, System};
use crate::body::{Kinematics, Rigid};
use crate::coil::{Coil, CoilForce};
use crate::contact::{ContactFace, CurvedMotion, FaceResultant, Interface, PlaneMotion, Points};
use crate::element::tangent::{StateTangent, Tangent, TangentColumns};
use crate::element::{Element, Marked, Wrench};
use crate::frame::FrameMotion;
use crate::link::{BodyWrench, Marker, RelativeFrame, RelativeMotion};
use crate::vector::Vector;

/// An element between two bodies.
pub(super) trait Mountable: Sized {
    /// Returns the wrench on the body with marker A; `rates` receives the rates of the internal states.
    fn body_wrench(
        &self,
        points: &mut Points,
        relative: &RelativeMotion<f64>,
        internal: &[f64],
        rates: &mut [f64],
    ) -> BodyWrench;

    /// Returns the same if marker B does not rotate. Without this and its loop over the bodies a wedge
    /// takes 7 to 12 % more instructions, a truck 1 %.
    fn body_wrench_of_frame(
        &self,
        points: &mut Points,
        ends: (&RelativeFrame<f64>, &Kinematics<f64>),
        internal: &[f64],
        rates: &mut [f64],
    ) -> BodyWrench;

    /// Returns the position of marker A from the origin of its body, body axes, m.
    fn marker(&self) -> Vector<f64> {
        Vector::zero()
    }

    /// Returns the tangent by the motion of marker A; the derivatives of the rates of internal states, four
    /// pairs at a time, and those by the states go to `rates`.
    fn tangent(
        &self,
        points: &Points,
        relative: &RelativeMotion<f64>,
        internal: &[f64],
        rates: (&mut [TangentColumns], &mut StateTangent),
    ) -> Tangent;

    /// The derivatives by the internal states.
    fn differentiate_internal(
        _: &Mounted<Self>,
        _: &Chain<'_>,
        _: &RelativeMotion<f64>,
        _: &[Option<&FreeBody>; 2],
        _: &mut Partitioned,
    ) {
    }
}

/// The quadrature of the work of all prescribed motions: the first one.
pub(super) const WORK: usize = 0;

impl Mountable for ContactFace<Interface> {
    #[inline(always)]
    fn body_wrench(
        &self,
        points: &mut Points,
        relative: &RelativeMotion<f64>,
        internal: &[f64],
        rates: &mut [f64],
    ) -> BodyWrench {
        if points.is_curved() {
            let shape = &self.surface.shape;
            return self.wrench_on_body(points, &CurvedMotion { shape, relative }, internal, rates);
        }
        let motion = PlaneMotion::new(relative, self.surface.first_arm);
        self.wrench_on_body(points, &motion, internal, rates)
    }

    #[inline(always)]
    fn body_wrench_of_frame(
        &self,
        points: &mut Points,
        (relative_frame, body): (&RelativeFrame<f64>, &Kinematics<f64>),
        internal: &[f64],
        rates: &mut [f64],
    ) -> BodyWrench {
        if points.is_curved() {
            return self.body_wrench(points, &relative_frame.relative(body), internal, rates);
        }
        if points.update_if_open(relative_frame, body) {
            return BodyWrench::ZERO;
        }
        let motion = PlaneMotion::of(relative_frame, body, self.surface.first_arm);
        self.wrench_on_body(points, &motion, internal, rates)
    }

    #[inline(always)]
    fn tangent(
        &self,
        points: &Points,
        relative: &RelativeMotion<f64>,
        _: &[f64],
        (rates, _): (&mut [TangentColumns], &mut StateTangent),
    ) -> Tangent {
        points.tangent(relative, rates)
    }

    fn differentiate_internal(
        mounted: &Mounted<Self>,
        chain: &Chain<'_>,
        relative: &RelativeMotion<f64>,
        ends: &[Option<&FreeBody>; 2],
        jacobian: &mut Partitioned,
    ) {
        differentiate_internal(mounted, chain, relative, ends, jacobian);
    }
}

impl Mountable for Coil {
    #[inline(always)]
    fn body_wrench(
        &self,
        _: &mut Points,
        relative: &RelativeMotion<f64>,
        _: &[f64],
        _: &mut [f64],
    ) -> BodyWrench {
        let coil = self.on_body(relative);
        BodyWrench {
            force: coil.force,
            moment: relative.rotation.apply_transposed(coil.moment),
            powers: [coil.loss, coil.guide_power],
        }
    }

    #[inline(always)]
    fn body_wrench_of_frame(
        &self,
        _: &mut Points,
        (relative_frame, body): (&RelativeFrame<f64>, &Kinematics<f64>),
        _: &[f64],
        _: &mut [f64],
    ) -> BodyWrench {
        self.wrench_on_body(relative_frame, body)
    }

    fn marker(&self) -> Vector<f64> {
        self.end
    }

    #[inline(always)]
    fn tangent(
        &self,
        _: &Points,
        relative: &RelativeMotion<f64>,
        _: &[f64],
        _: (&mut [TangentColumns], &mut StateTangent),
    ) -> Tangent {
        Tangent::of(self.inputs(), relative, self)
    }
}

impl Mountable for Marked {
    #[inline(always)]
    fn body_wrench(
        &self,
        _: &mut Points,
        relative: &RelativeMotion<f64>,
        internal: &[f64],
        rates: &mut [f64],
    ) -> BodyWrench {
        let (wrench, own) = self.on_body(relative, pair_of(internal));
        if let Some(rates) = rates.first_chunk_mut() {
            *rates = own;
        }
        BodyWrench {
            force: wrench.force,
            moment: relative.rotation.apply_transposed(wrench.moment),
            powers: wrench.powers,
        }
    }

    #[inline(always)]
    fn body_wrench_of_frame(
        &self,
        points: &mut Points,
        (relative_frame, body): (&RelativeFrame<f64>, &Kinematics<f64>),
        internal: &[f64],
        rates: &mut [f64],
    ) -> BodyWrench {
        self.body_wrench(points, &relative_frame.relative(body), internal, rates)
    }

    fn marker(&self) -> Vector<f64> {
        self.marker.origin
    }

    #[inline(always)]
    fn tangent(
        &self,
        _: &Points,
        relative: &RelativeMotion<f64>,
        internal: &[f64],
        (rates, by_states): (&mut [TangentColumns], &mut StateTangent),
    ) -> Tangent {
        let (factor, relative) = (self.factor[0], self.turned(relative));
        if let [rates, ..] = rates {
            let tangent;
            (tangent, *by_states) = self.element.tangent_with(&relative, pair_of(internal));
            *rates = by_states.rates;
            return tangent.times(factor);
        }
        match factor {
            0.0 => Tangent::NONE,
            factor => self.element.tangent(&relative).times(factor),
        }
    }

    fn differentiate_internal(
        mounted: &Mounted<Self>,
        chain: &Chain<'_>,
        relative: &RelativeMotion<f64>,
        ends: &[Option<&FreeBody>; 2],
        jacobian: &mut Partitioned,
    ) {
        differentiate_states(mounted, chain, relative, ends, jacobian);
    }
}

/// Returns the pair of internal states of an element; zeros of one without.
#[inline(always)]
pub(super) fn pair_of<S: Real>(internal: &[S]) -> [S; 2] {
    internal.first_chunk().copied().unwrap_or([S::zero(); 2])
}

impl<S: Real> Wrench<S> {
    /// Returns the wrench of a face.
    #[inline(always)]
    pub fn of_face(face: &FaceResultant<S>) -> Self {
        Self {
            force: face.force,
            moment: face.moment,
            powers: [face.friction_loss, face.damping_loss],
        }
    }

    /// Returns the wrench of a coil.
    #[inline(always)]
    pub fn of_coil(coil: &CoilForce<S>) -> Self {
        Self {
            force: coil.force,
            moment: coil.moment,
            powers: [coil.loss, coil.guide_power],
        }
    }

    /// Returns the force on the carried body (axes of its reference frame) and moment about its origin (body
    /// axes).
    #[inline(always)]
    pub fn on_body<T, K>(
        &self,
        relative_frame: &RelativeFrame<T>,
        body: &Kinematics<K>,
    ) -> (Vector<S>, Vector<S>)
    where
        T: Real + Mul<S, Output = S>,
        K: Real + Mul<S, Output = S>,
    {
        let moment: Vector<S> = relative_frame.rotation.apply_transposed(self.moment);
        (
            relative_frame.rotation.apply_transposed(self.force),
            body.orientation.rotation.apply_transposed(moment),
        )
    }

    /// Returns the moment about the marker's origin, marker axes.
    #[inline(always)]
    pub fn moment_at_marker(&self, relative: &RelativeMotion<S>) -> Vector<S> {
        self.moment + relative.position.cross::<S, S>(self.force)
    }

    /// Returns the force on the body that the element stands on (axes of its reference frame) and moment
    /// about its origin (body axes).
    #[inline(always)]
    pub fn reaction<T: Real + Mul<S, Output = S>>(
        &self,
        relative: &RelativeMotion<S>,
        on: &Kinematics<T>,
        marker: &Marker,
    ) -> (Vector<S>, Vector<S>)
    where
        f64: Mul<S, Output = S>,
    {
        let force: Vector<S> = -marker.rotation.apply::<S, S>(self.force);
        let moment: Vector<S> = -marker.rotation.apply::<S, S>(self.moment_at_marker(relative));
        (
            on.orientation.rotation.apply(force),
            moment + marker.origin.cross::<S, S>(force),
        )
    }

    /// Returns the power that the prescribed motion of the body under the element delivers, W.
    #[inline(always)]
    pub fn prescribed_power<T: Real + Mul<S, Output = S>>(
        &self,
        relative: &RelativeMotion<S>,
        relative_frame: &RelativeFrame<T>,
    ) -> S {
        let force: S = relative_frame.marker_velocity.dot(self.force);
        let moment: S = relative_frame
            .marker_angular_velocity
            .dot(self.moment_at_marker(relative));
        force + moment
    }
}

impl System {
    /// Writes the deflections of all bristles at the end of an implicit stage of this duration (s) that
    /// begins from those of `base`, at the positions and velocities of the last
    /// [`System::update_kinematics`].
    pub(super) fn settle_bristles(&mut self, duration: f64, base: &[f64], x: &mut [f64]) {
        let layout = self.layout;
        let [_, _, base, _] = layout.split(base);
        let [_, _, internal, _] = layout.split_mut(x);
        for face in self.faces.iter_mut().filter(|face| face.internal_count > 0) {
            let range = face.first_internal..face.first_internal + face.internal_count;
            let own = &mut internal[range.clone()];
            own.copy_from_slice(&base[range]);
            let relative: RelativeMotion<f64> = face.relative_frame.relative(&self.kinematics[face.body]);
            let (element, points) = (&face.element, &mut face.points);
            let surface = &element.surface;
            if points.is_curved() {
                let shape = &surface.shape;
                let motion = CurvedMotion {
                    shape,
                    relative: &relative,
                };
                element.settle(points, &motion, own, duration);
            } else {
                let motion = PlaneMotion::new(&relative, surface.first_arm);
                element.settle(points, &motion, own, duration);
            }
        }
    }

    /// Writes accelerations, rates and powers at the state of the last [`System::update_kinematics`].
    #[inline]
    pub(super) fn forces(&mut self, x: &[f64], dx: &mut [f64]) {
        let layout = self.layout;
        let [_, speeds, internal, _] = layout.split(x);
        let [d_positions, d_speeds, d_internal, d_quadratures] = layout.split_mut(dx);
        // Powers are written instead of added, and rates are copied body by body: calls of library functions
        // for a few numbers take longer.
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
            if let Some(carrier) = free.carrier {
                (self.force[carrier], self.moment[carrier]) = (Vector::zero(), Vector::zero());
            }
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
                let internal = &internal[element.first_internal..][..element.internal_count];
                let rates = &mut d_internal[element.first_internal..][..element.internal_count];
                let loads = (&mut self.force[..], &mut self.moment[..]);
                let powers = (&mut *d_quadratures, &mut work);
                apply(element, &self.kinematics, internal, rates, loads, powers);
            }
        }
        for free in self.free.iter().filter(|free| free.loaded) {
            self.loads[free.body] = self.given[free.body];
            if let Some(carrier) = free.carrier {
                let force = self.force[carrier];
                self.force[free.body] += force;
                let [_, pitch, yaw] = self.kinematics[carrier].about_axes(&self.moment[carrier]);
                self.loads[free.body][4] += pitch;
                self.loads[free.body][5] += yaw;
            }
        }
        for load in &self.applied {
            let [value, ..] = load.jet;
            self.loads[load.applied.body][load.applied.coordinate] += value;
            work += value * speeds[load.speed];
        }
        d_quadratures[WORK] = work;
        if !self.connections.is_empty() {
            d_quadratures[self.added.clone()].fill(0.0);
            let (coordinates, loads) = ((&self.positions[..], &self.rates[..]), &mut self.loads[..]);
            self.connections
                .forces(coordinates, internal, d_internal, loads, d_quadratures);
        }
        for free in &self.free {
            let kinematics = &self.kinematics[free.body];
            let (force, moment) = (self.force[free.body], self.moment[free.body]);
            let loads = free.loaded.then(|| &self.loads[free.body]);
            if let Some(linear) = &free.linear {
                let own = free.offset..free.offset + free.free.len();
                d_positions[own.clone()].copy_from_slice(&speeds[own.clone()]);
                for (j, target) in d_speeds[own].iter_mut().enumerate() {
                    let k = free.free[j];
                    let mut load = loads.map_or(0.0, |loads| loads[k]) + linear.weight[j];
                    if free.touched {
                        load += kinematics.generalized(k, &force, &moment);
                    }
                    *target = load / linear.inertia[j];
                }
                continue;
            }
            let frame = &self.frames[free.body];
            let accelerations = accelerate(
                kinematics,
                &free.rigid,
                (&frame.motion, !frame.fixed),
                self.gravity,
                (force, moment),
                loads,
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

/// Adds the wrench of a plain element on its body to force and moment, and writes the powers of its energy
/// terms; a prescribed neighbor does work.
#[inline(always)]
fn push<E: Mountable>(
    mounted: &mut Mounted<E>,
    kinematics: &Kinematics<f64>,
    (internal, rates): (&[f64], &mut [f64]),
    (force, moment): (&mut Vector<f64>, &mut Vector<f64>),
    (powers, work): (&mut [f64], &mut f64),
) {
    let relative_frame = &mounted.relative_frame;
    let ends = (relative_frame, kinematics);
    let wrench = mounted
        .element
        .body_wrench_of_frame(&mut mounted.points, ends, internal, rates);
    *force += relative_frame.rotation.apply_transposed::<f64, f64>(wrench.force);
    *moment += wrench.moment;
    write_powers(&mounted.energy_terms, wrench.powers, powers);
    if mounted.prescribed {
        *work += relative_frame.marker_velocity.dot::<f64, f64>(wrench.force);
    }
}

/// Writes the powers of one element's energy terms.
#[inline(always)]
fn write_powers(energy_terms: &[Option<usize>; 2], own: [f64; 2], powers: &mut [f64]) {
    for (energy_term, power) in energy_terms.iter().zip(own) {
        if let Some(energy_term) = energy_term {
            powers[*energy_term] = power;
        }
    }
}

/// Returns the accelerations of a body's coordinates under force, moment, and loads on its coordinates, in a
/// reference frame that may move.
#[inline(always)]
fn accelerate(
    kinematics: &Kinematics<f64>,
    body: &Rigid,
    (frame, frame_moves): (&FrameMotion<f64>, bool),
    gravity: Vector<f64>,
    (force, moment): (Vector<f64>, Vector<f64>),
    loads: Option<&[f64; 6]>,
) -> [f64; 6] {
    if !body.rolls && !frame_moves && loads.is_none() {
        let field: Vector<f64> = frame.acceleration - gravity;
        let field: Vector<f64> = frame.rotation.apply_transposed(field);
        return kinematics.accelerations_without_roll(body, &field, &force, &moment);
    }
    let (inertia, gyroscopic) = kinematics.inertia(body, frame, frame_moves, gravity, &[0.0; 6]);
    let (mut force, moment) = (force - inertia, moment - gyroscopic);
    let mut moments = kinematics.about_axes(&moment);
    if let Some(loads) = loads {
        for k in 0..3 {
            force.0[k] += loads[k];
            moments[k] += loads[3 + k];
        }
    }
    kinematics.accelerations(body, &force, moments)
}

/// Adds the wrenches and powers of an element that is not plain.
#[inline(always)]
fn apply<E: Mountable>(
    mounted: &mut Mounted<E>,
    kinematics: &[Kinematics<f64>],
    internal: &[f64],
    internal_rates: &mut [f64],
    (forces, moments): (&mut [Vector<f64>], &mut [Vector<f64>]),
    (powers, work): (&mut [f64], &mut f64),
) {
    let relative: RelativeMotion<f64> = mounted.relative_frame.relative(&kinematics[mounted.body]);
    let wrench = mounted
        .element
        .body_wrench(&mut mounted.points, &relative, internal, internal_rates);
    let relative_frame = &mounted.relative_frame;
    forces[mounted.body] += relative_frame.rotation.apply_transposed(wrench.force);
    moments[mounted.body] += wrench.moment;
    write_powers(&mounted.energy_terms, wrench.powers, powers);
    let wrench = Wrench {
        force: wrench.force,
        moment: relative.rotation.apply(wrench.moment),
        powers: wrench.powers,
    };
    if mounted.on_free {
        let (force, moment) = wrench.reaction(&relative, &kinematics[mounted.on], &mounted.marker);
        forces[mounted.on] += force;
        moments[mounted.on] += moment;
    }
    if mounted.prescribed {
        *work += wrench.prescribed_power(&relative, relative_frame);
    }
}
