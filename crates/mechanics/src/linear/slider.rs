//! A bristle with a slider under a harmonic motion: equivalent stiffness and damping.
//!
//! A spring k in series with a slider that slips at F, moved harmonically with the amplitude A and the
//! angular frequency ω: while `k A <= F` it is a spring. Beyond, its force over a cycle is a parallelogram;
//! the parts of its first harmonic in phase with displacement and with velocity are
//!
//! ```text
//! k_eq = k (t - sin t cos t)/π,   cos t = 1 - 2F/(k A)
//! c_eq = W/(π ω A²),              W = 4 F (A - F/k)     (the loss in a cycle)
//! ```
//!
//! (Iwan and Gates 1979 and textbooks of describing functions, remembered; the integrals are derived again in
//! the tests.) With `A -> 0` both go to `k` and `0`, with `A -> ∞` to zero. The bristle's own damping C
//! counts with the share of the cycle in which it deflects: `C k_eq/k`, an approximation of a small term.
//!
//! In the plane of a face both directions share one limit: A is the larger semi-axis of the ellipse that the
//! slip describes, and stiffness and damping are taken the same in both directions. Exact where the slip goes
//! to and fro along a line, as it mostly does. Limits: the normal force is that of the state, and the first
//! harmonic stands for the whole force.

use std::f64::consts::PI;

/// A bristle with its slider.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Slider {
    /// Stiffness k of the bristle, N/m.
    pub stiffness: f64,
    /// Its damping C, N·s/m.
    pub damping: f64,
    /// Friction F at which it slips, N.
    pub limit: f64,
}

/// Stiffness and damping that stand for it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Equivalent {
    /// N/m.
    pub stiffness: f64,
    /// N·s/m.
    pub damping: f64,
}

impl Equivalent {
    /// No friction.
    pub const NONE: Self = Self {
        stiffness: 0.0,
        damping: 0.0,
    };
}

impl Slider {
    /// Returns what it is while it sticks.
    #[must_use]
    pub fn stuck(&self) -> Equivalent {
        Equivalent {
            stiffness: self.stiffness,
            damping: self.damping,
        }
    }

    /// Returns what stands for it at an amplitude (m; infinite: it slides freely) and an angular frequency
    /// (rad/s, positive).
    #[must_use]
    pub fn equivalent(&self, amplitude: f64, frequency: f64) -> Equivalent {
        let Self {
            stiffness,
            damping,
            limit,
        } = *self;
        let held = limit / stiffness;
        if amplitude <= held {
            return self.stuck();
        }
        if amplitude == f64::INFINITY {
            return Equivalent::NONE;
        }
        let cosine = 1.0 - 2.0 * held / amplitude;
        let angle = libm::acos(cosine);
        let sine = (1.0 - cosine * cosine).max(0.0).sqrt();
        let share = (angle - sine * cosine) / PI;
        let loss = 4.0 * limit * (amplitude - held);
        Equivalent {
            stiffness: stiffness * share,
            damping: damping * share + loss / (PI * frequency * amplitude * amplitude),
        }
    }
}
