//! Friction on a surface that a spring presses together (the comparison program's type 6.5).
//!
//! Equations: normal force `N = max(0, -K(s_n))` from a piecewise linear curve of the normal extension
//! (extension positive, so that the curve is negative where the surfaces press), with an optional damper that
//! never pulls; in the two other coordinates a force accumulator with the limit `μN`, one circle for both
//! (see [`crate::friction::bristle`]). Forces in the direction of the extension: the normal one is `-N`.
//! Units: N, m, s.
//!
//! A clamped surface lies between two others that press from both sides: their normal forces cancel, and
//! friction alone acts.
//!
//! Friction acts against the whole slip, or along the second of the two other coordinates alone
//! ([`FrictionDirections::One`]). That coordinate may then be the normal one: a clamped surface whose limit
//! follows the extension along which it slips, as the hysteresis of an elastomer that must not pull.
//!
//! Energy: the integral of K (not of a clamped one), the accumulator's `K_a e²/2`, its losses, and those of
//! the damper.
//!
//! Source: the form is read from published input files, the accumulator's name and numbers from the wedge
//! elements beside it. Defect: under a held load it deflects by F/K_a. Limit: the limit of friction is taken
//! from the spring's force, without the damper's.

use numerics::scalar::Real;

use super::accumulator::{Accumulator, Friction, FrictionRule, SpatialForce, friction_of};
use crate::contact::FrictionDirections;
use crate::curve::Curve;
use crate::friction::Friction as Slip;

/// Friction on a surface.
#[derive(Clone, Debug, PartialEq)]
pub struct SurfaceFriction {
    /// The normal coordinate and the two of the surface (0 to 2: x, y, z), each once. With friction in one
    /// direction the last one may be the first.
    pub coordinates: [usize; 3],
    /// The directions in which friction acts: in both, or along the last coordinate alone.
    pub directions: FrictionDirections,
    /// Force by the normal extension, N by m; negative where the surfaces press.
    pub spring: Curve,
    /// Force by the normal extension's rate, N by m/s.
    pub damper: Option<Curve>,
    /// Coefficient of friction.
    pub coefficient: f64,
    /// The force accumulator.
    pub accumulator: Accumulator,
    /// True if the surface is clamped between two others, whose normal forces cancel: friction alone acts.
    pub clamped: bool,
}

/// The law, prepared.
#[derive(Clone, Debug)]
pub(crate) struct Surface {
    normal: Curve,
    damper: Option<Curve>,
    coefficient: f64,
    directions: FrictionDirections,
    pub accumulator: Accumulator,
    clamped: bool,
}

impl Surface {
    pub fn new(law: &SurfaceFriction, damping: f64) -> Self {
        Self {
            normal: law.spring.scaled(-1.0, 0.0).clamped(0.0, f64::INFINITY),
            damper: law.damper.clone().filter(|curve| !curve.is_zero()),
            coefficient: law.coefficient,
            directions: law.directions,
            accumulator: law.accumulator.with_damping(damping),
            clamped: law.clamped,
        }
    }

    pub fn damps(&self) -> bool {
        self.damper.is_some() && !self.clamped
    }

    /// Returns the friction at extensions and rates (normal, first, second) and deflections.
    #[inline(always)]
    pub fn evaluate<S: Real>(
        &self,
        extensions: [S; 3],
        rates: [S; 3],
        deflection: [S; 2],
        rule: FrictionRule,
    ) -> SpatialForce<S> {
        let normal = self.normal.evaluate(extensions[0]);
        let mut push = normal;
        if let Some(curve) = &self.damper {
            if normal.value() > 0.0 {
                push -= curve.evaluate(rates[0]);
            }
            if push.value() < 0.0 {
                push = S::zero();
            }
        }
        let slip: Slip<S> = friction_of(
            &self.accumulator,
            rule.limit(normal * self.coefficient, normal.value()),
            rule,
            self.directions.seen([rates[1], rates[2]]),
            deflection,
        );
        let (across, lost) = match self.clamped {
            true => (S::zero(), S::zero()),
            false => (-push, (normal - push) * rates[0]),
        };
        SpatialForce {
            force: [across, -slip.force[0], -slip.force[1]],
            rate: slip.rate,
            powers: [slip.loss, lost, S::zero()],
            friction: Friction {
                normal: normal.value(),
                load: slip.load,
                force: [slip.force[0].value(), slip.force[1].value()],
            },
        }
    }

    /// Returns the energy of the normal spring, J; zero at zero extension.
    pub fn energy(&self, extension: f64) -> f64 {
        match self.clamped {
            true => 0.0,
            false => -self.normal.integral(extension),
        }
    }
}
