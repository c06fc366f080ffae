//! A friction draft gear between the pivots of two couplers.
//!
//! With the compression s of the line between the points from its nominal length (as of a
//! [strut](super::Strut)) and slack a towards extension, b towards compression, the gear is compressed in
//! buff and in draft alike, by `x = s - b` where s > b, by `x = -s - a` where s < -a. It follows a
//! loading curve L(x) on the way in and the share r of it on the way out:
//!
//! ```text
//! F = L(x) ((1 + r)/2 + (1 - r)/2 tanh(x˙/v))
//! ```
//!
//! It pushes in buff and pulls in draft, and bears as a solid stop where L turns steep. Over a slow cycle the
//! share 1 - r of the work on the way in is lost. Stored energy: `(1 + r)/2 ∫ L`; loss: `(1 - r)/2 L x˙
//! tanh(x˙/v)`, never negative.
//!
//! Source: the velocity-switched loading and unloading curves of friction gears are the usual model of train
//! dynamics, reviewed by Wu, Cole, Luo and Spiryagin, Vehicle System Dynamics 52 (2014), 733 (abstract read);
//! the blend by tanh is a choice. Units: m, N, s. Defects: at rest the gear comes to the mean curve, since
//! the friction does not lock below v; impact stiffening of wedges is not in it; where the points meet no
//! force acts.

use numerics::scalar::Real;

use super::Strut;
use crate::curve::Curve;
use crate::element::{Element, Inputs, Wrench};
use crate::link::RelativeMotion;
use crate::vector::Vector;

/// A friction draft gear.
#[derive(Clone, Debug, PartialEq)]
pub struct DraftGear {
    /// Its name in results.
    pub name: String,
    /// Length in the nominal layout, m.
    pub length: f64,
    /// Slack towards extension and towards compression, m.
    pub slack: [f64; 2],
    /// The loading curve: force (N) over the compression of the gear (m), zero at zero, rising.
    pub loading: Curve,
    /// The share of the loading curve that it returns.
    pub returned: f64,
    /// Speed over which loading turns to unloading, m/s.
    pub reference_speed: f64,
}

impl DraftGear {
    /// Returns the compression of the gear (m) at one of its line, and 1 in buff, -1 in draft; none in the
    /// slack.
    fn compressed<S: Real>(&self, compression: S) -> Option<(S, f64)> {
        let [open, closed] = self.slack;
        if compression.value() > closed {
            return Some((compression - closed, 1.0));
        }
        (compression.value() < -open).then(|| (-compression - open, -1.0))
    }

    /// Returns the push (N) and the power lost (W) at a compression of the line (m) and its rate (m/s).
    #[must_use]
    pub fn push<S: Real>(&self, compression: S, rate: S) -> [S; 2] {
        let Some((own, sign)) = self.compressed(compression) else {
            return [S::zero(); 2];
        };
        let loading = self.loading.evaluate(own);
        let switch = (rate * (sign / self.reference_speed)).tanh();
        let friction = loading * switch * (0.5 * (1.0 - self.returned));
        let elastic = loading * (0.5 * (1.0 + self.returned));
        [(elastic + friction) * sign, friction * rate * sign]
    }

    /// Returns the compression of its line (m) and its rate (m/s) at a way (m) between its ends and the
    /// way's rate.
    #[must_use]
    pub fn compression(&self, way: Vector<f64>, rate: Vector<f64>) -> [f64; 2] {
        let nothing = Curve::constant(0.0);
        Strut::new("", self.length, nothing.clone(), nothing, [0.0; 2]).compression(way, rate)
    }
}

impl Element for DraftGear {
    fn name(&self) -> &str {
        &self.name
    }

    fn inputs(&self) -> Inputs {
        Inputs::Points
    }

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
        let own = self.compressed(compression).map_or(0.0, |(own, _)| own);
        0.5 * (1.0 + self.returned) * self.loading.integral(own)
    }
}
