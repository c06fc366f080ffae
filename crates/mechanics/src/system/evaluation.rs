//! Evaluation of elements at a state, generic over the scalar: values, and with dual numbers their
//! derivatives.
//!
//! Nothing is allocated after the first use of a [`ElementEvaluation`].

use std::ops::Mul;

use numerics::scalar::Real;

use super::{Mounted, System};
use crate::body::Kinematics;
use crate::element::{Scalar, Wrench};
use crate::frame::FrameMotion;
use crate::link::{RelativeFrame, RelativeMotion};
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
pub struct PointEvaluation<S> {
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
pub struct CoilEvaluation<S> {
    /// Length, m.
    pub length: S,
    /// Spring force along the coil, N: positive when it pushes.
    pub spring: S,
}

/// Forces, contact kinematics, rates and powers of all elements.
#[derive(Clone, Debug)]
pub struct ElementEvaluation<S> {
    /// By body.
    pub loads: Vec<Load<S>>,
    /// By face and point, in the order of the discrete states.
    pub points: Vec<PointEvaluation<S>>,
    /// By coil.
    pub coils: Vec<CoilEvaluation<S>>,
    /// Rates of the internal states.
    pub internal_rates: Vec<S>,
    /// Powers of the energy terms, W.
    pub powers: Vec<S>,
}

impl<S> Default for ElementEvaluation<S> {
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

/// Inputs of the elements: frames, kinematics and internal states.
pub(super) struct EvaluationInputs<'s, S, D> {
    pub frames: &'s dyn Fn(usize) -> FrameMotion<S>,
    pub kinematics: &'s [Kinematics<S>],
    pub internal: &'s [D],
    /// Addend of the spring force of each coil: value 0, with a derivative if the law changes.
    pub coil_change: &'s dyn Fn(usize) -> S,
}

impl System {
    /// Evaluates all elements at `time` and state `x`.
    pub fn evaluate_elements(&mut self, time: f64, x: &[f64], out: &mut ElementEvaluation<f64>) {
        self.update_kinematics(time, x);
        let [_, _, internal, _] = self.layout.split(x);
        let inputs = EvaluationInputs {
            frames: &|body| self.frames[body].motion,
            kinematics: &self.kinematics,
            internal,
            coil_change: &|_| 0.0,
        };
        self.evaluate_elements_at(&inputs, out);
    }

    /// The same for any scalar.
    pub(super) fn evaluate_elements_at<S: Scalar + From<D>, D: Copy>(
        &self,
        inputs: &EvaluationInputs<'_, S, D>,
        out: &mut ElementEvaluation<S>,
    ) where
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
            let motion = inputs.element_kinematics(mounted);
            let face = &mounted.element;
            let internal = &inputs.internal[mounted.first_internal..][..mounted.internal_count];
            let rates = &mut out.internal_rates[mounted.first_internal..][..mounted.internal_count];
            let points = &mut out.points;
            let sum = face.evaluate(&motion.relative, internal, |point, contact| {
                points.push(PointEvaluation {
                    gap: contact.gap,
                    normal: contact.normal,
                    slip: contact.slip,
                    friction: contact.friction.force,
                });
                if !rates.is_empty() {
                    rates[2 * point..2 * point + 2].copy_from_slice(&contact.friction.rate);
                }
            });
            let wrench = Wrench::of_face(&sum);
            inputs.add(mounted, &motion, &wrench, out);
        }
        for (number, mounted) in self.coils.iter().enumerate() {
            let motion = inputs.element_kinematics(mounted);
            let change = (inputs.coil_change)(number);
            let coil = mounted
                .element
                .on_body_with(&motion.relative, |length| mounted.element.spring(length) + change);
            out.coils.push(CoilEvaluation {
                length: coil.length,
                spring: coil.spring,
            });
            let wrench = Wrench::of_coil(&coil);
            inputs.add(mounted, &motion, &wrench, out);
        }
        for mounted in &self.elements {
            let motion = inputs.element_kinematics(mounted);
            let own = mounted.first_internal..mounted.first_internal + mounted.internal_count;
            let states = match inputs.internal[own.clone()] {
                [first, second] => [S::from(first), S::from(second)],
                _ => [S::zero(); 2],
            };
            let (wrench, rates) = mounted.element.on_body(&motion.relative, states);
            if let [first, second] = &mut out.internal_rates[own] {
                [*first, *second] = rates;
            }
            inputs.add(mounted, &motion, &wrench, out);
        }
    }
}

/// Kinematics of one element: the frames of the bodies at its ends, and the motion of body a relative to
/// marker B.
struct ElementKinematics<S> {
    frames: [FrameMotion<S>; 2],
    relative_frame: RelativeFrame<S>,
    relative: RelativeMotion<S>,
}

impl<S: Real, D> EvaluationInputs<'_, S, D>
where
    f64: Mul<S, Output = S>,
{
    fn element_kinematics<E>(&self, mounted: &Mounted<E>) -> ElementKinematics<S> {
        let frames = [mounted.body, mounted.on].map(self.frames);
        let relative_frame = RelativeFrame::new(
            &frames[0],
            &frames[1],
            &self.kinematics[mounted.on],
            &mounted.marker,
        );
        let relative = relative_frame.relative(&self.kinematics[mounted.body]);
        ElementKinematics {
            frames,
            relative_frame,
            relative,
        }
    }

    /// Adds the wrench of one element to the bodies at its ends, and its powers.
    fn add<E>(
        &self,
        mounted: &Mounted<E>,
        motion: &ElementKinematics<S>,
        wrench: &Wrench<S>,
        out: &mut ElementEvaluation<S>,
    ) {
        let [a, b] = &motion.frames;
        let (body, on) = (&self.kinematics[mounted.body], &self.kinematics[mounted.on]);
        let mut load = |number: usize,
                        body: &Kinematics<S>,
                        frame: &FrameMotion<S>,
                        (force, moment): (Vector<S>, Vector<S>)| {
            let load = &mut out.loads[number];
            let moment: Vector<S> = body.orientation.rotation.apply(moment);
            load.force += frame.rotation.apply::<S, S>(force);
            load.moment += frame.rotation.apply::<S, S>(moment);
        };
        load(
            mounted.body,
            body,
            a,
            wrench.on_body(&motion.relative_frame, body),
        );
        let reaction = wrench.reaction(&motion.relative, on, &mounted.marker);
        load(mounted.on, on, b, reaction);
        for (energy_term, power) in mounted.energy_terms.iter().zip(wrench.powers) {
            if let Some(energy_term) = energy_term {
                out.powers[*energy_term] += power;
            }
        }
        if mounted.prescribed {
            out.powers[0] += wrench.prescribed_power(&motion.relative, &motion.relative_frame);
        }
    }
}
