//! A spring and a damper in parallel on one coordinate (the comparison program's types 1, 1.1, 1.3).
//!
//! Equation: `f = clamp(K(s) + C(s˙), compression limit, extension limit)`, K and C piecewise linear,
//! extension positive. Units: N and m, or N·m and rad.
//!
//! Energy: stored is the integral of `clamp(K(s))`, a function of s alone; the rest of the force, f -
//! clamp(K(s)), has the sign of C(s˙), because clamping keeps order, so that its power is never negative for
//! a damper that opposes motion. Both together are the whole power, also at the limits.
//!
//! Source: derived from the numbers of published input files (a bearing spring without tension, a vertical
//! spring whose extension limit is zero). Defect: the limit also cuts the damper's force, with a
//! discontinuous derivative. Limit: coordinates of one group are independent of each other; a coil's shear
//! does not roll it.

use numerics::scalar::Real;

use super::accumulator::AxisForce;
use crate::curve::Curve;

/// A spring and a damper in parallel.
#[derive(Clone, Debug, PartialEq)]
pub struct SpringDamper {
    /// Force by extension.
    pub spring: Option<Curve>,
    /// Force by the extension's rate.
    pub damper: Option<Curve>,
    /// The least force (the most compressive), N or N·m; usually negative.
    pub compression_limit: f64,
    /// The greatest force, N or N·m; zero for a spring that cannot pull.
    pub extension_limit: f64,
}

impl SpringDamper {
    /// Returns a spring without damper and limits.
    #[must_use]
    pub fn spring(curve: Curve) -> Self {
        Self {
            spring: Some(curve),
            damper: None,
            compression_limit: f64::NEG_INFINITY,
            extension_limit: f64::INFINITY,
        }
    }

    /// Returns a damper without spring and limits.
    #[must_use]
    pub fn damper(curve: Curve) -> Self {
        Self {
            spring: None,
            damper: Some(curve),
            compression_limit: f64::NEG_INFINITY,
            extension_limit: f64::INFINITY,
        }
    }
}

/// The law, prepared.
#[derive(Clone, Debug)]
pub(crate) struct Spring {
    free: Option<Curve>,
    held: Curve,
    damper: Option<Curve>,
    limits: [f64; 2],
}

impl Spring {
    /// None, if there is neither spring nor damper.
    pub fn new(law: &SpringDamper) -> Option<Self> {
        let limits = [law.compression_limit, law.extension_limit];
        let spring = law.spring.clone().unwrap_or_else(|| Curve::constant(0.0));
        let damper = law.damper.clone().filter(|curve| !curve.is_zero());
        let held = spring.clamped(limits[0], limits[1]);
        let nothing = held.is_zero() && damper.is_none();
        (!nothing).then_some(Self {
            free: damper.is_some().then_some(spring),
            held,
            damper,
            limits,
        })
    }

    /// Returns whether it loses energy.
    pub fn damps(&self) -> bool {
        self.damper.is_some()
    }

    /// Returns the force at a extension and its rate.
    #[inline(always)]
    pub fn evaluate<S: Real>(&self, extension: S, rate: S) -> AxisForce<S> {
        let held = self.held.evaluate(extension);
        let (Some(damper), Some(free)) = (&self.damper, &self.free) else {
            return AxisForce {
                force: held,
                loss: S::zero(),
            };
        };
        let sum = free.evaluate(extension) + damper.evaluate(rate);
        let force = if sum.value() < self.limits[0] {
            S::from(self.limits[0])
        } else if sum.value() > self.limits[1] {
            S::from(self.limits[1])
        } else {
            sum
        };
        AxisForce {
            force,
            loss: (force - held) * rate,
        }
    }

    /// Returns the stored energy, J; zero at zero extension.
    pub fn energy(&self, extension: f64) -> f64 {
        self.held.integral(extension)
    }
}
