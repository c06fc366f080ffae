//! Properties of a face beyond a plane, linear springs and one coefficient of friction: the shape of the
//! surface that its points touch, friction that depends on slip speed, load and place, a pad that hardens.
//!
//! Friction limit of a point with normal force N, slip speed |v|, share w of the face, and factor f of the
//! map (Hess and Soom 1990 for the dependence on speed; both dependences are 1 at rest and without load):
//!
//! ```text
//! μN f (r + (1 - r) / (1 + |v|²/v_s²)) / (1 + N / (w N_h))
//! ```
//!
//! with the ratio r of the coefficients of sliding and of rest, the Stribeck speed v_s, at which half of the
//! difference is gone, and the load N_h of the whole face at which the coefficient is half. A hardening pad
//! has the normal force `k δ (1 + δ²/δ_h²)` at the compression δ.
//!
//! Units: N, m, s. Defects: the limit follows the speed at once (no memory, no lag); with bristles |v| is the
//! speed of the point, of which a part deflects the bristle. With tanh a peak at rest is seen only if v_s is
//! well above the law's reference speed.
//!
//! Friction acts against the whole slip ([`FrictionDirections::Two`]), or along the surface's second tangent
//! alone ([`FrictionDirections::One`]): the law then sees no slip across. Defect of the latter: nothing holds
//! a point across; a bristle does not deflect there.

use numerics::scalar::Number;
use serde::{Deserialize, Serialize};

use super::{ContactFace, PointProperties};
use crate::friction::dot;
use crate::surface::SurfaceShape;

/// The dependence of friction on slip speed and load.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Sliding {
    /// Coefficient of sliding over that of rest.
    pub ratio: f64,
    /// Stribeck speed, m/s.
    pub stribeck_speed: f64,
    /// Load of the whole face at which the coefficient is half of that without load, N; infinite: it does not
    /// depend on the load.
    pub half_load: f64,
}

/// The directions in which friction acts on a face.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum FrictionDirections {
    /// Against the slip, in the plane of the face.
    #[default]
    Two,
    /// Along the second tangent of the surface, on a wedge's faces its line of travel: one tangent a face, as
    /// in Steets 2007, eqs. 3-8, 3-10 and 3-15.
    One,
}

impl FrictionDirections {
    /// Returns the slip that the law of friction sees.
    #[inline(always)]
    pub(crate) fn seen<S: Number>(self, slip: [S; 2]) -> [S; 2] {
        match self {
            Self::Two => slip,
            Self::One => [S::zero(), slip[1]],
        }
    }
}

impl Default for Sliding {
    fn default() -> Self {
        Self {
            ratio: 1.0,
            stribeck_speed: 1.0,
            half_load: f64::INFINITY,
        }
    }
}

/// The refinements of a face; by default there are none.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Interface {
    /// The shape of the surface that the points touch.
    pub shape: SurfaceShape,
    /// The dependence of friction on slip speed and load; the coefficient of the face is that of rest.
    pub sliding: Sliding,
    /// The directions in which friction acts.
    pub directions: FrictionDirections,
    /// A factor of the coefficient for each point; empty: 1 for all.
    pub friction_factors: Vec<f64>,
    /// Compression at which a pad's normal force is twice that of a linear spring, m.
    pub hardening: Option<f64>,
    /// Distance along the normal from the points to where friction along the surface's first tangent acts, m:
    /// its slip is that of the body with the points there. Planes only. So adapters pitch with the side
    /// frame: normal force and friction along pass through the axle, friction across acts at the crown.
    pub first_arm: f64,
}

impl Interface {
    /// Returns whether the laws of force differ from those of a plain face.
    #[must_use]
    pub fn is_refined(&self) -> bool {
        self.sliding != Sliding::default()
            || self.directions != FrictionDirections::default()
            || !self.friction_factors.is_empty()
            || self.hardening.is_some()
    }

    /// Returns the elastic normal force at a gap below zero, N.
    #[inline(always)]
    pub(super) fn elastic<S: Number>(&self, linear: S, gap: S) -> S {
        match self.hardening {
            Some(at) => linear * (gap * gap * (1.0 / (at * at)) + 1.0),
            None => linear,
        }
    }

    /// Returns the energy stored in the normal spring of a point, J.
    pub(super) fn pressed(&self, stiffness: f64, gap: f64) -> f64 {
        let linear = 0.5 * stiffness * gap * gap;
        match self.hardening {
            Some(at) => linear * (1.0 + 0.5 * gap * gap / (at * at)),
            None => linear,
        }
    }

    /// Returns the slip that the law of friction sees.
    #[inline(always)]
    pub(crate) fn seen<S: Number>(&self, slip: [S; 2]) -> [S; 2] {
        self.directions.seen(slip)
    }

    /// Returns the friction limit of a point from that of a plain face, N.
    #[inline(always)]
    pub(super) fn limit<S: Number>(
        &self,
        plain: S,
        properties: &PointProperties<S::Plain>,
        normal: S,
        slip: [S; 2],
    ) -> S {
        let Sliding {
            ratio,
            stribeck_speed,
            half_load,
        } = self.sliding;
        let mut limit = plain.by(properties.factor);
        if ratio != 1.0 {
            let speeds = dot(slip, slip) * (1.0 / (stribeck_speed * stribeck_speed));
            limit = limit * (S::from(1.0 - ratio) / (speeds + 1.0) + ratio);
        }
        if half_load < f64::INFINITY {
            let own = S::Plain::from(1.0 / half_load) / properties.share;
            limit = limit / (normal.by(own) + 1.0);
        }
        limit
    }
}

impl ContactFace<Interface> {
    /// Returns the friction limit (N) at rest of a point with a normal force (N).
    pub(crate) fn limit_at_rest(&self, point: usize, normal: f64) -> f64 {
        let own = &self.points[point];
        let factors = &self.surface.friction_factors;
        let properties = PointProperties {
            stiffness: own.stiffness,
            damping: own.damping,
            damped: own.damping > 0.0,
            share: own.share,
            factor: factors.get(point).copied().unwrap_or(1.0),
        };
        self.surface
            .limit(normal * self.coefficient, &properties, normal, [0.0; 2])
    }
}
