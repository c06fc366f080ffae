//! Unilateral contact of weighted points on one body with a surface on another.
//!
//! Normal force (Steets 2007, eq. 3-7, with optional damping): `N = max(0, -k g - c ġ)` where the gap `g < 0`,
//! else 0. Friction acts against the tangential velocity of the point relative to the surface, which includes
//! ω × r of both bodies. Units: N, m, s.
//!
//! Defects: with `c > 0` the force jumps when a point strikes; the stiffness per point is a model parameter that
//! stands for the elasticity of the faces, not a property of a point. Four corners are the 2 × 2 case of a face.

use integrate::scalar::Real;

use crate::friction::{Friction, FrictionLaw, bristle, tanh};
use crate::link::Relative;
use crate::surface::Surface;
use crate::vector::Vector;

/// A point of a contact face.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ContactPoint {
    /// Where it is on its body, from the body's origin in body axes, m.
    pub position: Vector<f64>,
    /// Normal stiffness k, N/m.
    pub stiffness: f64,
    /// Normal damping c, N·s/m.
    pub damping: f64,
    /// Its share of the face's tangential stiffness and damping; the shares of a face sum to 1.
    pub share: f64,
}

/// Points on one body that meet a surface of another.
#[derive(Clone, Debug)]
pub struct ContactFace<F> {
    /// The face's name, as in results: `column`, `slope`.
    pub name: String,
    /// Its points.
    pub points: Vec<ContactPoint>,
    /// The surface that they meet.
    pub surface: F,
    /// Coefficient of friction μ.
    pub coefficient: f64,
    /// The friction law.
    pub law: FrictionLaw,
}

/// The state of a contact point.
#[derive(Clone, Copy, Debug)]
pub struct PointContact<S> {
    /// From the mount's origin to the point, mount axes, m.
    pub place: Vector<S>,
    /// From the body's origin to the point, mount axes, m.
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

/// The resultant of a face.
#[derive(Clone, Copy, Debug)]
pub struct FaceResultant<S> {
    /// Force on the body that carries the points, mount axes, N.
    pub force: Vector<S>,
    /// Its moment about that body's origin, mount axes, N·m.
    pub moment: Vector<S>,
    /// Power lost in friction, W.
    pub friction_loss: S,
    /// Power lost in contact damping, W.
    pub damping_loss: S,
}

impl<F: Surface> ContactFace<F> {
    /// How many internal states the face has.
    #[must_use]
    pub fn state_count(&self) -> usize {
        self.points.len() * self.law.states_per_point()
    }

    /// The resultant of all points; `each` sees every closed point and every point with internal states.
    ///
    /// `deflections` holds the internal states, two a point, or is empty.
    #[inline(always)]
    pub fn evaluate<S: Real + From<D>, D: Copy>(
        &self,
        relative: &Relative<S>,
        deflections: &[D],
        mut each: impl FnMut(usize, &PointContact<S>),
    ) -> FaceResultant<S> {
        let mut sum = FaceResultant {
            force: Vector::zero(),
            moment: Vector::zero(),
            friction_loss: S::zero(),
            damping_loss: S::zero(),
        };
        let (position, rotation) = (relative.position.value(), relative.rotation.value());
        for (i, point) in self.points.iter().enumerate() {
            let closed = self.surface.gap(position + rotation.apply(point.position)) < 0.0;
            if !closed && deflections.is_empty() {
                continue;
            }
            let deflection = match deflections.get(2 * i..2 * i + 2) {
                Some(e) => [S::from(e[0]), S::from(e[1])],
                None => [S::zero(); 2],
            };
            if !closed {
                each(i, &self.open(point, relative, deflection, &mut sum));
                continue;
            }
            let contact = self.point(point, relative, deflection);
            let [t1, t2] = contact.friction.force;
            let force = self.surface.compose(contact.place, [contact.normal, t1, t2]);
            sum.force += force;
            sum.moment += contact.arm.cross(force);
            sum.friction_loss += contact.friction.loss;
            sum.damping_loss += contact.damping_loss;
            each(i, &contact);
        }
        sum
    }

    /// An open point with a bristle: the bristle relaxes.
    #[inline(always)]
    fn open<S: Real>(
        &self,
        point: &ContactPoint,
        relative: &Relative<S>,
        deflection: [S; 2],
        sum: &mut FaceResultant<S>,
    ) -> PointContact<S> {
        let mut contact = self.geometry(point, relative);
        contact.friction = self.friction(point.share, S::zero(), contact.slip, deflection);
        sum.friction_loss += contact.friction.loss;
        contact
    }

    /// Where a point is and how it moves; no forces yet.
    #[inline(always)]
    pub fn geometry<S: Real>(&self, point: &ContactPoint, relative: &Relative<S>) -> PointContact<S> {
        let arm: Vector<S> = relative.rotation.apply(point.position);
        let place = relative.position + arm;
        let velocity: Vector<S> = relative.velocity + relative.angular_velocity.cross(arm);
        let [gap_rate, s1, s2] = self.surface.resolve(place, velocity);
        PointContact {
            place,
            arm,
            gap: self.surface.gap(place),
            gap_rate,
            slip: [s1, s2],
            normal: S::zero(),
            friction: Friction::none(),
            damping_loss: S::zero(),
        }
    }

    /// The forces at a closed point.
    #[inline(always)]
    fn point<S: Real>(
        &self,
        point: &ContactPoint,
        relative: &Relative<S>,
        deflection: [S; 2],
    ) -> PointContact<S> {
        let mut contact = self.geometry(point, relative);
        let elastic = contact.gap * -point.stiffness;
        contact.normal = elastic;
        if point.damping > 0.0 {
            let damped = elastic - contact.gap_rate * point.damping;
            contact.normal = if damped.value() > 0.0 { damped } else { S::zero() };
            contact.damping_loss = (elastic - contact.normal) * contact.gap_rate;
        }
        contact.friction = self.friction(point.share, contact.normal, contact.slip, deflection);
        contact
    }

    /// How far a closed point is from its law's own change between stick and slip, see [`Friction::load`].
    #[inline(always)]
    pub(crate) fn load(&self, share: f64, normal: f64, slip: [f64; 2], deflection: [f64; 2]) -> f64 {
        match self.law {
            FrictionLaw::Tanh { reference_speed } => {
                (slip[0] * slip[0] + slip[1] * slip[1]).sqrt() / reference_speed
            }
            FrictionLaw::Bristle { .. } => self.friction(share, normal, slip, deflection).load,
        }
    }

    /// Friction of a point that carries `share` of the face's tangential stiffness.
    #[inline(always)]
    pub fn friction<S: Real>(&self, share: f64, normal: S, slip: [S; 2], deflection: [S; 2]) -> Friction<S> {
        let limit = normal * self.coefficient;
        match self.law {
            FrictionLaw::Tanh { reference_speed } => tanh::friction(limit, reference_speed, slip),
            FrictionLaw::Bristle { stiffness, damping } => {
                bristle::friction(limit, stiffness * share, damping * share, slip, deflection)
            }
        }
    }
}
