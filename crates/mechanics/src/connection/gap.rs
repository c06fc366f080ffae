//! A spring and a damper in parallel behind a gap (the comparison program's type 1.2).
//!
//! Equation: no force while `low < s < high`; outside `f = K(s) + C(s˙)`, beyond the lower end not above
//! zero, beyond the upper end not below zero ([`GapTension::Never`], the default). The curves take the
//! extension itself, not the distance from the gap's end. Units: N and m, or N·m and rad.
//!
//! Energy: stored is the integral of K from the gap's end, a function of s alone; the rest of the force has
//! the damper's sign or, where the limit holds, takes away the spring's energy that the damper eats while it
//! retreats slower than the body: never negative either.
//!
//! Source: derived from published input files, where such a damper acts in a bearing while the bearing spring
//! of another connection is loaded. Defect: force jumps from zero where the gap closes at speed. Limit: it
//! knows its own spring only, not that of a neighbouring connection.

use numerics::scalar::Real;

use super::accumulator::AxisForce;
use super::options::{GapTension, Options};
use crate::curve::Curve;

/// A spring and a damper that act outside a gap.
#[derive(Clone, Debug, PartialEq)]
pub struct GapDamper {
    /// Force by extension.
    pub spring: Option<Curve>,
    /// Force by the extension's rate.
    pub damper: Option<Curve>,
    /// Lower end of the gap, m or rad: at smaller extensions the element acts.
    pub low: f64,
    /// Upper end of the gap, m or rad: at larger extensions the element acts.
    pub high: f64,
}

/// The law, prepared.
#[derive(Clone, Debug)]
pub(crate) struct Gap {
    spring: Option<Curve>,
    /// The spring's force beyond each end, as far as it may act.
    held: Option<[Curve; 2]>,
    damper: Option<Curve>,
    ends: [f64; 2],
    pulls: bool,
}

impl Gap {
    pub fn new(law: &GapDamper, options: &Options) -> Self {
        let pulls = options.gap_tension == GapTension::Allowed;
        let spring = law.spring.clone().filter(|curve| !curve.is_zero());
        let held = spring.as_ref().map(|curve| match pulls {
            true => [curve.clone(), curve.clone()],
            false => [
                curve.clamped(f64::NEG_INFINITY, 0.0),
                curve.clamped(0.0, f64::INFINITY),
            ],
        });
        Self {
            spring,
            held,
            damper: law.damper.clone().filter(|curve| !curve.is_zero()),
            ends: [law.low, law.high],
            pulls,
        }
    }

    /// Returns the force at a extension and its rate.
    #[inline(always)]
    pub fn evaluate<S: Real>(&self, extension: S, rate: S) -> AxisForce<S> {
        let at = extension.value();
        let pushes = at <= self.ends[0];
        if !pushes && at < self.ends[1] {
            return AxisForce::none();
        }
        let spring = match &self.spring {
            Some(curve) => curve.evaluate(extension),
            None => S::zero(),
        };
        let held = if self.wrong(pushes, spring.value()) {
            S::zero()
        } else {
            spring
        };
        let mut force = spring;
        if let Some(curve) = &self.damper {
            force += curve.evaluate(rate);
        }
        if self.wrong(pushes, force.value()) {
            force = S::zero();
        }
        AxisForce {
            force,
            loss: (force - held) * rate,
        }
    }

    /// Returns whether a force would pull where the element only pushes, or push where it only pulls.
    #[inline(always)]
    fn wrong(&self, pushes: bool, force: f64) -> bool {
        !self.pulls && if pushes { force > 0.0 } else { force < 0.0 }
    }

    /// Returns the stored energy, J; zero inside the gap.
    pub fn energy(&self, extension: f64) -> f64 {
        let side = if extension <= self.ends[0] {
            0
        } else if extension >= self.ends[1] {
            1
        } else {
            return 0.0;
        };
        self.held.as_ref().map_or(0.0, |held| {
            held[side].integral(extension) - held[side].integral(self.ends[side])
        })
    }
}
