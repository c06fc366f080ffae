//! Force elements: one law between a marker A on one body and a marker B on another.
//!
//! An element is one file: its parameters, one function over any scalar from the relative motion of its
//! markers to the wrench on A and the power that is lost, and its stored energy. The core ([`crate::system`])
//! does the rest: forces on both bodies, the Jacobian of both ends (from numbers with derivatives), the work
//! of prescribed motions, the energy ledger, observation. `examples/custom_element.rs` adds a bushing.
//!
//! One of its two bodies must have free coordinates, whichever.
//!
//! **Internal states.** An element may have a coordinate of its own and its velocity
//! ([`Element::has_states`]), whose rates it gives with its wrench: the roll of a rail under a wheel, the
//! place of a mass that swings beside a body. The integrator counts both as deflections in m: the velocity
//! comes as the way of 1 ms.
//!
//! Limits: such an element has no events of its own; contact faces have.

mod reversed;
pub(crate) mod tangent;

use std::fmt::Debug;

use numerics::scalar::{Dual, Real};

use self::reversed::Reversed;
use self::tangent::{StateTangent, Tangent};
use crate::link::{Marker, RelativeMotion};
use crate::motion::Motion;
use crate::vector::Vector;

/// The wrench of an element on the body with marker A.
#[derive(Clone, Copy, Debug)]
pub struct Wrench<S> {
    /// Force, axes of marker B, N.
    pub force: Vector<S>,
    /// Moment about marker A, axes of marker B, N·m.
    pub moment: Vector<S>,
    /// Power that the element loses, and power that it puts in ([`Element::does_work`]), W.
    pub powers: [S; 2],
}

/// Inputs of a wrench.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Inputs {
    /// Position and velocity of marker A alone: a force between two points.
    Points,
    /// All of the relative motion.
    Motion,
}

/// A force element.
pub trait Element: Clone + Debug + Send + Sync + 'static {
    /// Returns the name of its loss in the energy ledger.
    fn name(&self) -> &str;

    /// Returns the wrench on marker A and the power lost, at a motion of marker A relative to marker B.
    ///
    /// It must not depend on anything else, so that momentum is conserved: the opposite wrench acts on B.
    fn evaluate<S: Real>(&self, motion: &RelativeMotion<S>) -> Wrench<S>;

    /// Returns whether it has a coordinate of its own and its velocity as internal states.
    fn has_states(&self) -> bool {
        false
    }

    /// Returns the wrench and the powers at a motion and at internal states (m), and the rates of these, m/s.
    fn evaluate_with<S: Real>(&self, motion: &RelativeMotion<S>, _: [S; 2]) -> (Wrench<S>, [S; 2]) {
        (self.evaluate(motion), [S::zero(); 2])
    }

    /// Returns the stored energy at a motion and at internal states (m), J.
    fn energy_with(&self, motion: &RelativeMotion<f64>, _: [f64; 2]) -> f64 {
        self.energy(motion)
    }

    /// Returns the stored energy at a relative motion, J. The power of the wrench must equal minus the rate
    /// of this energy minus the power lost, plus the power put in; otherwise the ledger does not close.
    fn energy(&self, motion: &RelativeMotion<f64>) -> f64;

    /// Returns whether the element puts in work, which the ledger then holds as an entry of its own: a drive,
    /// or a law whose stored energy is not quite a function of the motion.
    fn does_work(&self) -> bool {
        false
    }

    /// Returns the inputs of the wrench. Elements between two points cost less to differentiate.
    fn inputs(&self) -> Inputs {
        Inputs::Motion
    }
}

/// A wrench, and the rates of internal states.
type WithRates<S> = (Wrench<S>, [S; 2]);

/// An element of any kind, by the scalars that the core uses.
pub(crate) trait AnyElement: Debug + Send + Sync {
    fn name(&self) -> &str;
    fn value(&self, motion: &RelativeMotion<f64>, states: [f64; 2]) -> WithRates<f64>;
    fn derivative(&self, motion: &RelativeMotion<Dual<1>>, states: [Dual<1>; 2]) -> WithRates<Dual<1>>;
    fn tangent(&self, motion: &RelativeMotion<f64>) -> Tangent;
    fn tangent_with(&self, motion: &RelativeMotion<f64>, states: [f64; 2]) -> (Tangent, StateTangent);
    fn energy(&self, motion: &RelativeMotion<f64>, states: [f64; 2]) -> f64;
    fn has_states(&self) -> bool;
    fn does_work(&self) -> bool;
    fn boxed(&self) -> Box<dyn AnyElement>;
}

impl<E: Element> AnyElement for E {
    fn name(&self) -> &str {
        Element::name(self)
    }
    fn value(&self, motion: &RelativeMotion<f64>, states: [f64; 2]) -> WithRates<f64> {
        self.evaluate_with(motion, states)
    }
    fn derivative(&self, motion: &RelativeMotion<Dual<1>>, states: [Dual<1>; 2]) -> WithRates<Dual<1>> {
        self.evaluate_with(motion, states)
    }
    fn tangent(&self, motion: &RelativeMotion<f64>) -> Tangent {
        Tangent::of(self.inputs(), motion, self)
    }
    fn tangent_with(&self, motion: &RelativeMotion<f64>, states: [f64; 2]) -> (Tangent, StateTangent) {
        Tangent::with_states(motion, states, self)
    }
    fn energy(&self, motion: &RelativeMotion<f64>, states: [f64; 2]) -> f64 {
        self.energy_with(motion, states)
    }
    fn has_states(&self) -> bool {
        Element::has_states(self)
    }
    fn does_work(&self) -> bool {
        Element::does_work(self)
    }
    fn boxed(&self) -> Box<dyn AnyElement> {
        Box::new(self.clone())
    }
}

/// A scalar over which elements of any kind can be evaluated.
pub(crate) trait Scalar: Real {
    fn evaluate(
        element: &dyn AnyElement,
        motion: &RelativeMotion<Self>,
        states: [Self; 2],
    ) -> WithRates<Self>;
}

impl Scalar for f64 {
    fn evaluate(
        element: &dyn AnyElement,
        motion: &RelativeMotion<Self>,
        states: [Self; 2],
    ) -> WithRates<Self> {
        element.value(motion, states)
    }
}

impl Scalar for Dual<1> {
    fn evaluate(
        element: &dyn AnyElement,
        motion: &RelativeMotion<Self>,
        states: [Self; 2],
    ) -> WithRates<Self> {
        element.derivative(motion, states)
    }
}

/// An element with the marker on the body that it carries: marker A, or marker B of a reversed one.
#[derive(Debug)]
pub(crate) struct Marked {
    pub element: Box<dyn AnyElement>,
    pub marker: Marker,
    /// True if marker A is on the other body, which has no free coordinates.
    pub reversed: bool,
    /// The factor of wrench and powers, and its rate by time.
    pub factor: [f64; 2],
}

impl Clone for Marked {
    fn clone(&self) -> Self {
        Self {
            element: self.element.boxed(),
            ..*self
        }
    }
}

impl Marked {
    /// Returns the motion of marker A by that of its origin.
    pub fn turned<S: Real>(&self, origin: &RelativeMotion<S>) -> RelativeMotion<S> {
        RelativeMotion {
            rotation: origin.rotation.times(self.marker.rotation),
            ..*origin
        }
    }

    /// Returns the motion of marker A by that of the body that carries it.
    pub fn of_marker<S: Scalar>(&self, body: &RelativeMotion<S>) -> RelativeMotion<S> {
        self.turned(&body.at(self.marker.origin))
    }

    /// Returns the wrench about the origin of the body that carries marker A, by the motion of that body,
    /// and the rates of the internal states.
    pub fn on_body<S: Scalar>(&self, body: &RelativeMotion<S>, states: [S; 2]) -> WithRates<S> {
        self.times(self.factor[0], body, states)
    }

    /// Returns the wrench of the law itself times a factor, and the rates of the internal states.
    pub fn times<S: Scalar>(&self, factor: f64, body: &RelativeMotion<S>, states: [S; 2]) -> WithRates<S> {
        if factor == 0.0 && !self.element.has_states() {
            let none = Wrench {
                force: Vector::zero(),
                moment: Vector::zero(),
                powers: [S::zero(); 2],
            };
            return (none, [S::zero(); 2]);
        }
        let (wrench, rates) = S::evaluate(&*self.element, &self.of_marker(body), states);
        let arm: Vector<S> = body.rotation.apply(self.marker.origin);
        let moment = wrench.moment + arm.cross::<S, S>(wrench.force);
        let scaled = |v: Vector<S>| Vector(v.0.map(|own| own * factor));
        let wrench = Wrench {
            force: scaled(wrench.force),
            moment: scaled(moment),
            powers: wrench.powers.map(|own| own * factor),
        };
        (wrench, rates)
    }
}

/// An element between two bodies: the numbers of the bodies with markers A and B, and the markers.
#[derive(Debug)]
pub struct Placement {
    pub(crate) ends: [usize; 2],
    pub(crate) markers: [Marker; 2],
    pub(crate) element: Box<dyn AnyElement>,
    pub(crate) reversed: Box<dyn AnyElement>,
    /// The factor of its wrench over time; none: 1.
    pub(crate) factor: Option<Motion>,
}

impl Clone for Placement {
    fn clone(&self) -> Self {
        Self {
            ends: self.ends,
            markers: self.markers,
            element: self.element.boxed(),
            reversed: self.reversed.boxed(),
            factor: self.factor.clone(),
        }
    }
}

impl Placement {
    /// Returns the bodies with the element's markers: first the one that it carries, which must have free
    /// coordinates. If that with marker A has none, but the other one has, the element is reversed.
    pub(crate) fn mounted(self, is_free: impl Fn(usize) -> bool) -> ([usize; 2], Marker, Marked) {
        let ([a, b], [marker_a, marker_b]) = (self.ends, self.markers);
        let reversed = !is_free(a) && is_free(b);
        let (ends, seat, element, marker) = match reversed {
            false => ([a, b], marker_b, self.element, marker_a),
            true => ([b, a], marker_a, self.reversed, marker_b),
        };
        let marked = Marked {
            element,
            marker,
            reversed,
            factor: self.factor.map_or([1.0, 0.0], |factor| {
                let [value, rate, _] = factor.evaluate(0.0, 0.0);
                [value, rate]
            }),
        };
        (ends, seat, marked)
    }

    /// Returns an element between marker A on body `a` and marker B on body `b`; one of them must have free
    /// coordinates.
    pub fn new(
        element: impl Element,
        (a, marker_a): (usize, Marker),
        (b, marker_b): (usize, Marker),
    ) -> Self {
        Self {
            ends: [a, b],
            markers: [marker_a, marker_b],
            reversed: Box::new(Reversed(element.clone())),
            element: Box::new(element),
            factor: None,
        }
    }

    /// Returns the same with wrench and powers times a factor over time, which may be changed between two
    /// steps ([`crate::system::System::set_factor`]). The law must store no energy.
    #[must_use]
    pub fn over_time(self, factor: Motion) -> Self {
        Self {
            factor: Some(factor),
            ..self
        }
    }
}
