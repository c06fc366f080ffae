//! Friction of a contact point: a tangential force that depends on the normal force and the tangential
//! velocity.

pub mod bristle;
pub mod tanh;

use numerics::scalar::{Blend, Number};
use serde::{Deserialize, Serialize};

/// The friction laws. Every result states the active one.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case", tag = "law")]
pub enum FrictionLaw {
    /// Smoothed Coulomb friction, see [`tanh`]: creeps under a held load.
    Tanh {
        /// Reference speed v0, m/s.
        reference_speed: f64,
    },
    /// An elastic element in series with the slider, see [`bristle`]: holds a load.
    Bristle {
        /// Tangential stiffness of the face, N/m.
        stiffness: f64,
        /// Tangential damping of the face, N·s/m.
        damping: f64,
    },
}

impl FrictionLaw {
    /// Returns the number of internal states of a contact point under this law.
    #[must_use]
    pub fn states_per_point(&self) -> usize {
        match self {
            Self::Tanh { .. } => 0,
            Self::Bristle { .. } => 2,
        }
    }

    /// Returns the speed at which the point creeps when it holds the fraction `load` (0..1) of the friction
    /// limit, m/s.
    #[must_use]
    pub fn creep_speed(&self, load: f64) -> f64 {
        match self {
            Self::Tanh { reference_speed } => reference_speed * libm::atanh(load),
            Self::Bristle { .. } => 0.0,
        }
    }
}

/// Friction of one contact point (or of four in lanes), in two tangential directions.
#[derive(Clone, Copy, Debug)]
pub struct Friction<S: Number> {
    /// Force on the moving body, N.
    pub force: [S; 2],
    /// Rate of the internal states (bristle deflection), m/s; zero for laws that have none.
    pub rate: [S; 2],
    /// Power lost, W: never negative.
    pub loss: S,
    /// Load of the law, which decides between stick and slip: |T| / (μN) with the bristle,
    /// |v| / v0 with tanh.
    pub load: S::Plain,
}

impl<S: Number> Friction<S> {
    /// No friction.
    #[inline(always)]
    #[must_use]
    pub fn none() -> Self {
        Self {
            force: [S::zero(); 2],
            rate: [S::zero(); 2],
            loss: S::zero(),
            load: S::Plain::zero(),
        }
    }
}

impl<S: Number> Blend<S::Mask> for Friction<S> {
    #[inline(always)]
    fn blend(mask: S::Mask, yes: Self, no: Self) -> Self {
        let pair = |yes: [S; 2], no: [S; 2]| [S::blend(mask, yes[0], no[0]), S::blend(mask, yes[1], no[1])];
        Self {
            force: pair(yes.force, no.force),
            rate: pair(yes.rate, no.rate),
            loss: S::blend(mask, yes.loss, no.loss),
            load: S::Plain::blend(mask, yes.load, no.load),
        }
    }
}

/// Returns the scalar product of two plane vectors.
#[inline(always)]
pub(crate) fn dot<S: Number>(a: [S; 2], b: [S; 2]) -> S {
    a[0] * b[0] + a[1] * b[1]
}
