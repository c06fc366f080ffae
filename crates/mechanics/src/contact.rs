//! Unilateral contact of weighted points on one body with a surface on another.
//!
//! Normal force (Steets 2007, eq. 3-7, with optional damping): `N = max(0, -k g - c ġ)` where the gap
//! `g < 0`, else 0. Friction acts against the tangential velocity of the point relative to the surface, which
//! includes ω × r of both bodies. Units: N, m, s.
//!
//! Curved surfaces, friction by speed, load and place, and pads that harden: [`Interface`].
//!
//! Defects: with `c > 0` the force jumps at an impact; the stiffness per point is a model parameter that
//! stands for the elasticity of the faces, not a property of a point. Four corners are the 2 × 2 case of a
//! face.

mod blocks;
mod curved;
mod interface;
mod motion;
mod tangent;

use numerics::scalar::{Number, Real};

pub(crate) use blocks::Points;
pub(crate) use curved::CurvedMotion;
pub use interface::{FrictionDirections, Interface, Sliding};
pub(crate) use motion::PlaneMotion;

use crate::friction::{Friction, FrictionLaw, bristle, tanh};
use crate::link::RelativeMotion;
use crate::surface::Plane;
use crate::vector::Vector;

/// A point of a contact face.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ContactPoint {
    /// Its position on its body, from the body's origin in body axes, m.
    pub position: Vector<f64>,
    /// Normal stiffness k, N/m.
    pub stiffness: f64,
    /// Normal damping c, N·s/m.
    pub damping: f64,
    /// Its share of the face's tangential stiffness and damping; the shares of a face sum to 1.
    pub share: f64,
}

/// Points on one body that touch a surface of another.
#[derive(Clone, Debug, PartialEq)]
pub struct ContactFace<F> {
    /// The face's name, as in results: `column`, `slope`.
    pub name: String,
    /// Its points.
    pub points: Vec<ContactPoint>,
    /// The surface that they touch: a [`Plane`], or an [`Interface`] in an assembled system.
    pub surface: F,
    /// Coefficient of friction μ.
    pub coefficient: f64,
    /// The friction law.
    pub law: FrictionLaw,
}

/// The state of a contact point.
#[derive(Clone, Copy, Debug)]
pub struct PointContact<S: Number> {
    /// From the marker's origin to the point, marker axes, m.
    pub position: Vector<S>,
    /// From the body's origin to the point, marker axes, m.
    pub arm: Vector<S>,
    /// Signed distance, m.
    pub gap: S,
    /// Rate of the gap, m/s.
    pub gap_rate: S,
    /// Tangential velocity relative to the surface, m/s.
    pub slip: [S; 2],
    /// Normal force, N.
    pub normal: S,
    /// Friction.
    pub friction: Friction<S>,
    /// Power lost in contact damping, W.
    pub damping_loss: S,
}

/// Parameters of one point (or of four in lanes).
#[derive(Clone, Copy, Debug)]
pub(crate) struct PointProperties<P> {
    pub stiffness: P,
    pub damping: P,
    /// True if there is any damping; if it always counted, runs would take up to 2 % more instructions.
    pub damped: bool,
    pub share: P,
    /// Factor of the coefficient of friction.
    pub factor: P,
}

/// Contact kinematics of a point (or of four), on which the law depends.
#[derive(Clone, Copy, Debug)]
pub(crate) struct PointKinematics<S> {
    pub gap: S,
    pub gap_rate: S,
    pub slip: [S; 2],
}

/// The forces at a point (or at four).
#[derive(Clone, Copy, Debug)]
pub(crate) struct PointForce<S: Number> {
    normal: S,
    friction: Friction<S>,
    damping_loss: S,
}

/// The resultant of a face.
#[derive(Clone, Copy, Debug)]
pub struct FaceResultant<S> {
    /// Force on the body that carries the points, marker axes, N.
    pub force: Vector<S>,
    /// Its moment about that body's origin, marker axes, N·m.
    pub moment: Vector<S>,
    /// Power lost in friction, W.
    pub friction_loss: S,
    /// Power lost in contact damping, W.
    pub damping_loss: S,
}

impl ContactFace<Plane> {
    /// Returns the same face with refinements.
    #[must_use]
    pub fn refined(self, interface: Interface) -> ContactFace<Interface> {
        ContactFace {
            name: self.name,
            points: self.points,
            surface: interface,
            coefficient: self.coefficient,
            law: self.law,
        }
    }
}

impl<F> ContactFace<F> {
    /// Returns the number of internal states of the face.
    #[must_use]
    pub fn state_count(&self) -> usize {
        self.points.len() * self.law.states_per_point()
    }
}

impl ContactFace<Interface> {
    /// Returns the same face without its refinements.
    #[must_use]
    pub fn plain(&self) -> ContactFace<Plane> {
        ContactFace {
            name: self.name.clone(),
            points: self.points.clone(),
            surface: Plane,
            coefficient: self.coefficient,
            law: self.law,
        }
    }

    /// Returns the resultant of all points; `each` is called for every point.
    ///
    /// `deflections` holds the internal states, two a point, or is empty.
    #[inline(always)]
    pub fn evaluate<S: Real + From<D>, D: Copy>(
        &self,
        relative: &RelativeMotion<S>,
        deflections: &[D],
        mut each: impl FnMut(usize, &PointContact<S>),
    ) -> FaceResultant<S> {
        let mut sum = FaceResultant {
            force: Vector::zero(),
            moment: Vector::zero(),
            friction_loss: S::zero(),
            damping_loss: S::zero(),
        };
        for (i, point) in self.points.iter().enumerate() {
            let mut contact = self.geometry(point, relative);
            let closed = contact.gap.value() < 0.0;
            // An open point with a bristle: the bristle relaxes.
            if !closed && deflections.is_empty() {
                each(i, &contact);
                continue;
            }
            let deflection = match deflections.get(2 * i..2 * i + 2) {
                Some(e) => [S::from(e[0]), S::from(e[1])],
                None => [S::zero(); 2],
            };
            let properties = self.properties(i);
            let forces = self.point_force(&properties, closed, &contact.kinematics(), deflection);
            contact.normal = forces.normal;
            contact.friction = forces.friction;
            contact.damping_loss = forces.damping_loss;
            sum.friction_loss += contact.friction.loss;
            if closed {
                let [t1, t2] = contact.friction.force;
                let force = self
                    .surface
                    .shape
                    .compose(contact.position, [contact.normal, t1, t2]);
                sum.force += force;
                sum.moment += contact.arm.cross(force);
                sum.moment.0[2] += t1 * self.surface.first_arm;
                sum.damping_loss += contact.damping_loss;
            }
            each(i, &contact);
        }
        sum
    }

    /// Returns the energies stored at a point: in its normal spring, and in its bristle by its share of the
    /// face's stiffness, J.
    pub(crate) fn stored(&self, point: &ContactPoint, gap: f64, deflection: Option<&[f64]>) -> [f64; 2] {
        let pressed = if gap < 0.0 {
            self.surface.pressed(point.stiffness, gap)
        } else {
            0.0
        };
        let bristle = match (self.law, deflection) {
            (FrictionLaw::Bristle { stiffness, .. }, Some(e)) => {
                0.5 * stiffness * point.share * (e[0] * e[0] + e[1] * e[1])
            }
            _ => 0.0,
        };
        [pressed, bristle]
    }

    /// Returns the contact kinematics of a point, without forces.
    #[inline(always)]
    pub fn geometry<S: Real>(&self, point: &ContactPoint, relative: &RelativeMotion<S>) -> PointContact<S> {
        let arm: Vector<S> = relative.rotation.apply(point.position);
        let position = relative.position + arm;
        let velocity: Vector<S> = relative.velocity + relative.angular_velocity.cross::<S, S>(arm);
        let [gap_rate, s1, s2] = self.surface.shape.resolve(position, velocity);
        PointContact {
            position,
            arm,
            gap: self.surface.shape.gap(position),
            gap_rate,
            slip: [s1 + relative.angular_velocity.0[2] * self.surface.first_arm, s2],
            normal: S::zero(),
            friction: Friction::none(),
            damping_loss: S::zero(),
        }
    }

    /// Returns the properties of a point.
    fn properties(&self, point: usize) -> PointProperties<f64> {
        let own = &self.points[point];
        PointProperties {
            stiffness: own.stiffness,
            damping: own.damping,
            damped: own.damping > 0.0,
            share: own.share,
            factor: self.surface.friction_factors.get(point).copied().unwrap_or(1.0),
        }
    }

    /// Returns the forces at a point: no normal force if it is open.
    #[inline(always)]
    pub(crate) fn point_force<S: Number>(
        &self,
        properties: &PointProperties<S::Plain>,
        closed: S::Mask,
        at: &PointKinematics<S>,
        deflection: [S; 2],
    ) -> PointForce<S> {
        let (normal, damping_loss) = self.pressed_by(properties, closed, at);
        PointForce {
            normal,
            friction: self.friction(properties, normal, at.slip, deflection),
            damping_loss,
        }
    }

    /// Returns the normal force at a point, and the power lost in contact damping.
    #[inline(always)]
    fn pressed_by<S: Number>(
        &self,
        properties: &PointProperties<S::Plain>,
        closed: S::Mask,
        at: &PointKinematics<S>,
    ) -> (S, S) {
        let elastic = self.surface.elastic(at.gap.by(-properties.stiffness), at.gap);
        let elastic = S::blend(closed, elastic, S::zero());
        if !properties.damped {
            return (elastic, S::zero());
        }
        let damped = elastic - at.gap_rate.by(properties.damping);
        let pressed = S::blend(S::Plain::zero().below(damped.plain()), damped, S::zero());
        let normal = S::blend(closed, pressed, S::zero());
        (normal, (elastic - normal) * at.gap_rate)
    }

    /// Returns the deflection of a point's bristle at the end of an implicit stage of this duration (s) that
    /// begins from `base` ([`bristle::settled`]); `base` itself where the law has none.
    #[inline(always)]
    pub(crate) fn settled<S: Number>(
        &self,
        properties: &PointProperties<S::Plain>,
        closed: S::Mask,
        at: &PointKinematics<S>,
        (base, duration): ([S; 2], f64),
    ) -> [S; 2] {
        let FrictionLaw::Bristle { stiffness, damping } = self.law else {
            return base;
        };
        let (normal, _) = self.pressed_by(properties, closed, at);
        let slip = self.surface.seen(at.slip);
        let limit = self
            .surface
            .limit(normal * self.coefficient, properties, normal, slip);
        let share = properties.share;
        bristle::settled(limit, share * stiffness, share * damping, slip, base, duration)
    }

    /// Returns the friction of a point.
    #[inline(always)]
    fn friction<S: Number>(
        &self,
        properties: &PointProperties<S::Plain>,
        normal: S,
        slip: [S; 2],
        deflection: [S; 2],
    ) -> Friction<S> {
        let slip = self.surface.seen(slip);
        let plain = normal * self.coefficient;
        let limit = self.surface.limit(plain, properties, normal, slip);
        let share = properties.share;
        match self.law {
            FrictionLaw::Tanh { reference_speed } => tanh::friction(limit, reference_speed, slip),
            FrictionLaw::Bristle { stiffness, damping } => {
                bristle::friction(limit, share * stiffness, share * damping, slip, deflection)
            }
        }
    }
}

impl<S: Number> PointContact<S> {
    #[inline(always)]
    fn kinematics(&self) -> PointKinematics<S> {
        PointKinematics {
            gap: self.gap,
            gap_rate: self.gap_rate,
            slip: self.slip,
        }
    }
}
