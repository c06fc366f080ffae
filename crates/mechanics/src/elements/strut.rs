//! A spring and a damper along the line between two points: spring, damper, link.
//!
//! With d the way from marker B to marker A, `L = |d|`, the compression `s = L0 - L` from the nominal length
//! L0 and its rate s˙, the strut pushes the points apart by
//!
//! ```text
//! F = clamp(K(s) + C(s˙), -pull, push)
//! ```
//!
//! with K and C piecewise linear curves, so that -pull and push are the largest tension and compression that
//! it can carry. K contains the load in the nominal layout. Energy: the integral of clamp(K); what clamping
//! cuts off the damper is counted with its loss, which is never negative for a damper that opposes motion.
//! With slack, no force acts while `-a < s < b`; beyond, K and C act on what `s` goes further, and the strut
//! only pushes after `b` and only pulls after `-a`. Units: m, N, s.
//!
//! Defects: where the points meet the line has no direction, and no force acts; the force's derivative jumps
//! at the points of the curves and at the limits. A strut has no mass and does not bend.

use numerics::scalar::Real;

use crate::curve::Curve;
use crate::element::{Element, Inputs, Wrench};
use crate::link::RelativeMotion;
use crate::vector::Vector;

/// A spring and a damper along the line between two points.
#[derive(Clone, Debug, PartialEq)]
pub struct Strut {
    /// Its name in results.
    pub name: String,
    /// The nominal length, m.
    length: f64,
    /// The spring's push (N) over the compression (m), within the limits.
    held: Curve,
    /// The same without limits.
    free: Curve,
    /// The damper's push (N) over the rate of compression (m/s).
    damper: Curve,
    /// The least and the greatest push, N.
    limits: [f64; 2],
    /// Slack towards extension and compression, m.
    slack: Option<[f64; 2]>,
}

impl Strut {
    /// Returns a strut with its length in the nominal layout (m), its spring's push over the compression from
    /// there (N by m), its damper's push over the rate of compression (N by m/s), and the largest tension and
    /// compression that it can carry (N, positive, may be infinite).
    #[must_use]
    pub fn new(name: &str, length: f64, spring: Curve, damper: Curve, [pull, push]: [f64; 2]) -> Self {
        let limits = [-pull, push];
        Self {
            name: name.to_owned(),
            length,
            held: spring.clamped(limits[0], limits[1]),
            free: spring,
            damper,
            limits,
            slack: None,
        }
    }

    /// Returns the same strut with slack: how far it extends, and is compressed, without force (m).
    #[must_use]
    pub fn with_slack(self, slack: [f64; 2]) -> Self {
        Self {
            slack: Some(slack),
            ..self
        }
    }

    /// Returns what a compression (m) goes beyond the slack, and the least and the greatest push there (N);
    /// `None` within it.
    #[inline(always)]
    fn beyond<S: Real>(&self, compression: S) -> Option<(S, [f64; 2])> {
        let [low, high] = self.limits;
        match self.slack {
            None => Some((compression, self.limits)),
            Some([_, closed]) if compression.value() > closed => {
                Some((compression - closed, [low.max(0.0), high]))
            }
            Some([open, _]) if compression.value() < -open => {
                Some((compression + open, [low, high.min(0.0)]))
            }
            Some(_) => None,
        }
    }

    /// Returns the nominal length, m.
    #[must_use]
    pub fn length(&self) -> f64 {
        self.length
    }

    /// Returns the push (N) and the power lost (W) at a compression (m) and its rate (m/s).
    #[inline(always)]
    pub fn push<S: Real>(&self, compression: S, rate: S) -> [S; 2] {
        let Some((compression, [low, high])) = self.beyond(compression) else {
            return [S::zero(); 2];
        };
        let sum = self.free.evaluate(compression) + self.damper.evaluate(rate);
        let push = if sum.value() < low {
            S::from(low)
        } else if sum.value() > high {
            S::from(high)
        } else {
            sum
        };
        [push, (push - self.held.evaluate(compression)) * rate]
    }

    /// Returns the compression (m) and its rate (m/s) at a way (m) between its ends and the way's rate.
    #[must_use]
    pub fn compression(&self, way: Vector<f64>, rate: Vector<f64>) -> [f64; 2] {
        let length = way.dot::<f64, f64>(way).sqrt();
        let closing = if length > 0.0 {
            -way.dot::<f64, f64>(rate) / length
        } else {
            0.0
        };
        [self.length - length, closing]
    }
}

impl Element for Strut {
    fn name(&self) -> &str {
        &self.name
    }

    fn inputs(&self) -> Inputs {
        Inputs::Points
    }

    #[inline(always)]
    fn evaluate<S: Real>(&self, motion: &RelativeMotion<S>) -> Wrench<S> {
        let (way, velocity) = (motion.position, motion.velocity);
        let square: S = way.dot(way);
        if square.value() == 0.0 {
            return Wrench {
                force: Vector::zero(),
                moment: Vector::zero(),
                powers: [S::zero(); 2],
            };
        }
        let length = square.sqrt();
        let rate = -way.dot::<S, S>(velocity) / length;
        let [push, loss] = self.push(-length + self.length, rate);
        Wrench {
            force: way.scale(push / length),
            moment: Vector::zero(),
            powers: [loss, S::zero()],
        }
    }

    fn energy(&self, motion: &RelativeMotion<f64>) -> f64 {
        let [compression, _] = self.compression(motion.position, motion.velocity);
        self.beyond(compression)
            .map_or(0.0, |(beyond, _)| self.held.integral(beyond))
    }
}
