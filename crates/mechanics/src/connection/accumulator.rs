//! Tangential laws of the friction of connections: a force accumulator, a bristle in series with a slider, or
//! a damper up to the limit.

use numerics::scalar::Real;

use crate::friction::Friction as Slip;
use crate::friction::bristle;

/// The tangential law of a friction element.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Accumulator {
    /// A bristle in series with the slider, two states, see [`crate::friction::bristle`].
    Bristle {
        /// Stiffness K_a, N/m.
        stiffness: f64,
        /// Damping C_a, N·s/m; it must be positive.
        damping: f64,
    },
    /// Velocity times a damping, at most the friction limit: no state, creeps under a held load.
    Viscous {
        /// Damping LVB, N·s/m.
        damping: f64,
    },
}

impl Accumulator {
    /// Returns the number of its states.
    #[must_use]
    pub fn states(&self) -> usize {
        match self {
            Self::Bristle { .. } => 2,
            Self::Viscous { .. } => 0,
        }
    }

    /// Returns its stored energy, J.
    #[must_use]
    pub fn energy(&self, deflection: [f64; 2]) -> f64 {
        match self {
            Self::Bristle { stiffness, .. } => {
                0.5 * stiffness * (deflection[0] * deflection[0] + deflection[1] * deflection[1])
            }
            Self::Viscous { .. } => 0.0,
        }
    }

    /// Returns the same with its bristle's damping multiplied.
    pub(crate) fn with_damping(self, factor: f64) -> Self {
        match self {
            Self::Bristle { stiffness, damping } => Self::Bristle {
                stiffness,
                damping: damping * factor,
            },
            viscous => viscous,
        }
    }

    /// Returns its trial force, in the direction of the extension.
    #[inline(always)]
    pub(crate) fn trial<S: Real>(&self, velocity: [S; 2], deflection: [S; 2]) -> [S; 2] {
        match self {
            Self::Bristle { stiffness, damping } => {
                [0, 1].map(|k| deflection[k] * *stiffness + velocity[k] * *damping)
            }
            Self::Viscous { damping } => velocity.map(|v| v * *damping),
        }
    }
}

/// A rule by which friction is evaluated: the law, or a special case.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) enum FrictionRule {
    /// By the law.
    #[default]
    Law,
    /// Every closed element sticks.
    Stuck,
    /// No friction at all.
    Free,
}

impl FrictionRule {
    /// Returns the friction limit of an element with this normal force.
    #[inline(always)]
    pub fn limit<S: Real>(self, limit: S, normal: f64) -> S {
        match self {
            Self::Law => limit,
            Self::Stuck if normal > 0.0 => S::from(f64::INFINITY),
            Self::Stuck | Self::Free => S::zero(),
        }
    }
}

/// Returns the friction of an accumulator.
#[inline(always)]
pub(crate) fn friction_of<S: Real>(
    accumulator: &Accumulator,
    limit: S,
    rule: FrictionRule,
    velocity: [S; 2],
    deflection: [S; 2],
) -> Slip<S> {
    match *accumulator {
        Accumulator::Bristle { stiffness, damping } => {
            bristle::friction(limit, stiffness, damping, velocity, deflection)
        }
        Accumulator::Viscous { damping } => {
            let limit = if rule == FrictionRule::Stuck {
                S::zero()
            } else {
                limit
            };
            viscous(limit, damping, velocity)
        }
    }
}

/// `F = -min(LVB |v|, limit) v/|v|`.
#[inline(always)]
fn viscous<S: Real>(limit: S, damping: f64, velocity: [S; 2]) -> Slip<S> {
    let square = velocity[0] * velocity[0] + velocity[1] * velocity[1];
    let size = square.value().sqrt() * damping;
    let holds = size <= limit.value();
    let factor = if holds {
        S::from(damping)
    } else {
        limit / square.sqrt()
    };
    Slip {
        force: velocity.map(|v| -(v * factor)),
        rate: [S::zero(); 2],
        loss: square * factor,
        load: if size > 0.0 { size / limit.value() } else { 0.0 },
    }
}

/// A force on one coordinate.
#[derive(Clone, Copy, Debug)]
pub(crate) struct AxisForce<S> {
    /// In the direction of the extension, N or N·m.
    pub force: S,
    /// Power that is neither stored nor given back, W.
    pub loss: S,
}

impl<S: Real> AxisForce<S> {
    #[inline(always)]
    pub fn none() -> Self {
        Self {
            force: S::zero(),
            loss: S::zero(),
        }
    }
}

/// Forces, rates and powers of a friction element with three coordinates.
#[derive(Clone, Copy, Debug)]
pub(crate) struct SpatialForce<S> {
    /// In the direction of the extension, N.
    pub force: [S; 3],
    /// Rates of the deflections, m/s.
    pub rate: [S; 2],
    /// Powers of its energy terms, W.
    pub powers: [S; 3],
    /// Its friction.
    pub friction: Friction,
}

/// The friction of an element, for contact states and outputs.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Friction {
    /// Normal force, or coil force of a wedge, N.
    pub normal: f64,
    /// |T| / limit.
    pub load: f64,
    /// Force on body A in the two friction coordinates, N.
    pub force: [f64; 2],
}
