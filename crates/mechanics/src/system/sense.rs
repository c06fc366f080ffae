//! What elements do and feel at a state, generic over the scalar: values, and with dual numbers their derivatives.
//!
//! Nothing is allocated after the first use of a [`Sense`].

use std::ops::Mul;

use integrate::scalar::Real;

use super::{Mounted, System};
use crate::body::Kinematics;
use crate::element::{Action, Scalar};
use crate::frame::FrameMotion;
use crate::link::{Relative, Sight};
use crate::vector::Vector;

/// Force (N) and moment (N·m) of all elements on a body, along fixed axes, about the body's origin.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Load<S> {
    /// The force.
    pub force: Vector<S>,
    /// The moment.
    pub moment: Vector<S>,
}

/// A contact point.
#[derive(Clone, Copy, Debug)]
pub struct PointSense<S> {
    /// Signed distance, m; negative inside.
    pub gap: S,
    /// Normal force, N.
    pub normal: S,
    /// Velocity along the surface, m/s.
    pub slip: [S; 2],
    /// Friction force on the carried body along the surface, N.
    pub friction: [S; 2],
}

/// A coil.
#[derive(Clone, Copy, Debug)]
pub struct CoilSense<S> {
    /// Length, m.
    pub length: S,
    /// Spring force along the coil, N: positive when it pushes.
    pub spring: S,
}

/// What elements do and feel.
#[derive(Clone, Debug)]
pub struct Sense<S> {
    /// By body.
    pub loads: Vec<Load<S>>,
    /// By face and point, in the order of the switches.
    pub points: Vec<PointSense<S>>,
    /// By coil.
    pub coils: Vec<CoilSense<S>>,
    /// Rates of the internal states.
    pub internal_rates: Vec<S>,
    /// Powers of the channels, W.
    pub powers: Vec<S>,
}

impl<S> Default for Sense<S> {
    fn default() -> Self {
        Self {
            loads: Vec::new(),
            points: Vec::new(),
            coils: Vec::new(),
            internal_rates: Vec::new(),
            powers: Vec::new(),
        }
    }
}

/// Where everything is that elements see.
pub(super) struct Stage<'s, S, D> {
    pub frames: &'s dyn Fn(usize) -> FrameMotion<S>,
    pub kinematics: &'s [Kinematics<S>],
    pub internal: &'s [D],
    /// What is added to the spring force of each coil, by coil: value 0, with a derivative where the law changes.
    pub coil_change: &'s dyn Fn(usize) -> S,
}

impl System {
    /// What all elements do and feel at `time` and state `x`.
    pub fn sense(&mut self, time: f64, x: &[f64], out: &mut Sense<f64>) {
        self.place(time, x);
        let [_, _, internal, _] = self.layout.split(x);
        let stage = Stage {
            frames: &|body| self.frames[body].motion,
            kinematics: &self.kinematics,
            internal,
            coil_change: &|_| 0.0,
        };
        self.feel(&stage, out);
    }

    /// The same for any scalar.
    pub(super) fn feel<S: Scalar + From<D>, D: Copy>(&self, stage: &Stage<'_, S, D>, out: &mut Sense<S>)
    where
        f64: Mul<S, Output = S>,
    {
        let zero = Load {
            force: Vector::zero(),
            moment: Vector::zero(),
        };
        for (list, count) in [
            (&mut out.internal_rates, self.layout.internals),
            (&mut out.powers, self.layout.quadratures),
        ] {
            list.clear();
            list.resize(count, S::zero());
        }
        out.loads.clear();
        out.loads.resize(self.bodies.len(), zero);
        out.points.clear();
        out.coils.clear();
        for mounted in &self.faces {
            let seen = stage.seen(mounted);
            let face = &mounted.element;
            let first = out.points.len();
            for point in &face.points {
                let contact = face.geometry(point, &seen.relative);
                out.points.push(PointSense {
                    gap: contact.gap,
                    normal: S::zero(),
                    slip: contact.slip,
                    friction: [S::zero(); 2],
                });
            }
            let internal = &stage.internal[mounted.first_internal..][..mounted.internal_count];
            let rates = &mut out.internal_rates[mounted.first_internal..][..mounted.internal_count];
            let points = &mut out.points[first..];
            let sum = face.evaluate(&seen.relative, internal, |point, contact| {
                points[point].normal = contact.normal;
                points[point].friction = contact.friction.force;
                if !rates.is_empty() {
                    rates[2 * point..2 * point + 2].copy_from_slice(&contact.friction.rate);
                }
            });
            let action = Action::of_face(&sum);
            stage.add(mounted, &seen, &action, out);
        }
        for (number, mounted) in self.coils.iter().enumerate() {
            let seen = stage.seen(mounted);
            let change = (stage.coil_change)(number);
            let coil = mounted
                .element
                .on_body_with(&seen.relative, |length| mounted.element.spring(length) + change);
            out.coils.push(CoilSense {
                length: coil.length,
                spring: coil.spring,
            });
            let action = Action::of_coil(&coil);
            stage.add(mounted, &seen, &action, out);
        }
        for mounted in &self.elements {
            let seen = stage.seen(mounted);
            let action = mounted.element.on_body(&seen.relative);
            stage.add(mounted, &seen, &action, out);
        }
    }
}

/// An element seen on a stage: the frames of the bodies at its ends, and the motion of body a as its mount sees it.
struct Seen<S> {
    frames: [FrameMotion<S>; 2],
    sight: Sight<S>,
    relative: Relative<S>,
}

impl<S: Real, D> Stage<'_, S, D>
where
    f64: Mul<S, Output = S>,
{
    fn seen<E>(&self, mounted: &Mounted<E>) -> Seen<S> {
        let frames = [mounted.body, mounted.on].map(self.frames);
        let sight = Sight::new(
            &frames[0],
            &frames[1],
            &self.kinematics[mounted.on],
            &mounted.mount,
        );
        let relative = sight.relative(&self.kinematics[mounted.body]);
        Seen {
            frames,
            sight,
            relative,
        }
    }

    /// Adds what one element does to the bodies at its ends, and its powers.
    fn add<E>(&self, mounted: &Mounted<E>, seen: &Seen<S>, action: &Action<S>, out: &mut Sense<S>) {
        let [a, b] = &seen.frames;
        let (body, on) = (&self.kinematics[mounted.body], &self.kinematics[mounted.on]);
        let mut load = |number: usize,
                        body: &Kinematics<S>,
                        frame: &FrameMotion<S>,
                        (force, moment): (Vector<S>, Vector<S>)| {
            let load = &mut out.loads[number];
            let moment: Vector<S> = body.turn.rotation.apply(moment);
            load.force += frame.rotation.apply::<S, S>(force);
            load.moment += frame.rotation.apply::<S, S>(moment);
        };
        load(mounted.body, body, a, action.on_body(&seen.sight, body));
        let reaction = action.reaction(&seen.relative, on, &mounted.mount);
        load(mounted.on, on, b, reaction);
        for (channel, power) in mounted.channels.iter().zip(action.powers) {
            if let Some(channel) = channel {
                out.powers[*channel] += power;
            }
        }
        if mounted.driven {
            out.powers[0] += action.drive_power(&seen.relative, &seen.sight);
        }
    }
}
