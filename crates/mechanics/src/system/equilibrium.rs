//! Static equilibrium by pseudo-transient continuation.

use integrate::Problem;
use thiserror::Error;

use super::System;
use crate::body::COORDINATES;
use crate::connection::{FrictionRule, FrictionRules};
use crate::motion::Motion;

/// No equilibrium was found.
#[derive(Clone, Debug, PartialEq, Error)]
#[error(
    "no static equilibrium found: after {iterations} iterations {body} still accelerates by \
     {acceleration:.3e} (m/s² or rad/s²) in {coordinate}"
)]
pub struct NoEquilibrium {
    /// Iterations done.
    pub iterations: usize,
    /// The body with the largest acceleration.
    pub body: String,
    /// Its coordinate.
    pub coordinate: &'static str,
    /// The acceleration that is left.
    pub acceleration: f64,
    /// The state that came nearest to rest.
    pub nearest: Vec<f64>,
    /// The largest acceleration there, or rate of a deflection over 1 ms: m/s² or rad/s².
    pub residual: f64,
    /// The last state of the search: it shows where the bodies go.
    pub last: Vec<f64>,
}

/// A run may start from a state whose largest acceleration is this share of gravity (of 1 m/s² without
/// gravity; rad/s² as m/s²): each body lacks a ten thousandth of its weight to rest, as much as the relative
/// tolerance of most runs leaves open.
pub const NEARLY_AT_REST: f64 = 1e-4;

impl NoEquilibrium {
    /// Returns the state that came nearest to rest, if it is nearly at rest: see [`NEARLY_AT_REST`].
    /// `gravity` in m/s².
    #[must_use]
    pub fn nearly_at_rest(&self, gravity: f64) -> Option<&[f64]> {
        let scale = if gravity.abs() > 0.0 { gravity.abs() } else { 1.0 };
        (self.residual <= NEARLY_AT_REST * scale).then_some(&*self.nearest)
    }

    /// Returns the warning of a start from [`NoEquilibrium::nearly_at_rest`].
    #[must_use]
    pub fn warning(&self) -> String {
        format!(
            "the start is nearly at rest, not quite: {} still accelerates by {:.1e} (m/s² or rad/s²) in {}, \
             less than {NEARLY_AT_REST:.0e} of gravity's; the run begins with this motion",
            self.body,
            self.acceleration.abs(),
            self.coordinate
        )
    }
}

/// A start at rest, or nearly so.
#[derive(Clone, Debug, PartialEq)]
pub struct AtRest {
    /// The state.
    pub state: Vec<f64>,
    /// The warning of a state that is nearly at rest: [`NoEquilibrium::warning`].
    pub warning: Option<String>,
}

/// The role of friction in a static equilibrium, where its force is not determined by the positions alone.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum StaticFriction {
    /// None: accumulators and bristles are relaxed to zero. The result depends on positions only, and is what
    /// a vehicle settles to after much shaking. Directions that friction alone holds stay where they are.
    #[default]
    Without,
    /// Accumulators and bristles follow the displacements from their present deflections, sticking up to
    /// their limits: the result depends on the start.
    Following,
}

/// Accelerations below this count as rest, m/s² or rad/s².
const REST: f64 = 1e-7;
/// The time by which rates of the deflections (m/s) are compared with accelerations, s.
const SETTLING: f64 = 1e-3;
const ITERATIONS: usize = 2000;
/// Accelerations that rounding can leave, m/s² or rad/s²: a light body on stiff contacts far from the
/// origin of the fixed frame (1e-15 m on 1e8 N/m at 0.04 kg·m²). They count as rest where so many
/// iterations do not halve them.
const ROUNDING: f64 = 1e-5;
const STAGNANT: usize = 60;

impl System {
    /// Returns the state of rest near `x` at `time`, with all prescribed bodies where they are then.
    /// Quadratures stay as they are.
    ///
    /// Implicit Euler steps from rest, of a length that grows as the accelerations fall: with long steps this
    /// is Newton's method with the Jacobian of the integration. Prescribed bodies with linearized kinematics
    /// are taken at rest; others should not move (their velocity would drag on the friction).
    ///
    /// # Errors
    /// The accelerations do not fall below 1e-7 (m/s², rad/s²).
    pub fn equilibrium(
        &mut self,
        time: f64,
        x: &[f64],
        friction: StaticFriction,
    ) -> Result<Vec<f64>, NoEquilibrium> {
        let before = self.connections.friction_rules;
        let moving: Vec<_> = self.moved.iter().map(|m| m.motions.clone()).collect();
        // Motions are smooth in pieces: the position at `time` is that of the piece which begins there.
        let reference = self.reference;
        self.next_time_discontinuity(time);
        // the prescribed bodies held where they are
        for moved in &mut self.moved {
            for motion in moved.motions.iter_mut() {
                let [value, ..] = motion.evaluate(time, self.reference);
                *motion = Motion::Constant(value);
            }
        }
        self.invalidate_kinematics();
        if friction == StaticFriction::Without {
            self.connections.friction_rules = FrictionRules {
                surfaces: FrictionRule::Free,
                wedges: FrictionRule::Free,
            };
        }
        let found = self.settle(time, x, friction);
        self.connections.friction_rules = before;
        for (moved, motions) in self.moved.iter_mut().zip(moving) {
            moved.motions = motions;
        }
        self.reference = reference;
        self.invalidate_kinematics();
        found
    }

    /// As [`System::equilibrium`], but a state that is nearly at rest serves too, with a warning.
    ///
    /// # Errors
    /// No state is nearly at rest ([`NEARLY_AT_REST`]).
    pub fn start_at_rest(
        &mut self,
        time: f64,
        x: &[f64],
        friction: StaticFriction,
    ) -> Result<AtRest, NoEquilibrium> {
        let gravity = self.gravity.0.iter().fold(0.0, |sum, own| libm::hypot(sum, *own));
        match self.equilibrium(time, x, friction) {
            Ok(state) => Ok(AtRest { state, warning: None }),
            Err(error) => match error.nearly_at_rest(gravity) {
                Some(state) => Ok(AtRest {
                    state: state.to_vec(),
                    warning: Some(error.warning()),
                }),
                None => Err(error),
            },
        }
    }

    fn settle(&mut self, time: f64, x: &[f64], friction: StaticFriction) -> Result<Vec<f64>, NoEquilibrium> {
        let n = self.layout.speeds;
        let states = 2 * n..2 * n + self.layout.internals;
        let mut x = x.to_vec();
        x[n..2 * n].fill(0.0);
        if friction == StaticFriction::Without {
            x[states.clone()].fill(0.0);
        }
        // Velocities of elements' own coordinates stay zero, as the speeds of bodies do.
        let mut moves: Vec<usize> = (0..n).chain(states.clone()).collect();
        for group in self.pairs_of_elements() {
            let velocity = states.start + 2 * group + 1;
            x[velocity] = 0.0;
            moves.retain(|own| *own != velocity);
        }
        let mut dx = vec![0.0; x.len()];
        let mut unused = vec![0.0; x.len()];
        let mut trial = x.clone();
        self.derivative(time, &x, &mut dx);
        let size = |dx: &[f64]| {
            let largest = |part: &[f64]| part.iter().fold(0.0, |m: f64, a| m.max(a.abs()));
            largest(&dx[n..2 * n]).max(largest(&dx[states.clone()]) / SETTLING)
        };
        let mut residual = size(&dx);
        let mut step = 1e-4;
        let (mut least, mut since) = (f64::INFINITY, 0);
        let (mut nearest, mut lowest) = (x.clone(), f64::INFINITY);
        for _ in 0..ITERATIONS {
            if residual < lowest {
                lowest = residual;
                nearest.copy_from_slice(&x);
            }
            if residual < 0.5 * least {
                (least, since) = (residual, 0);
            }
            since += 1;
            if residual < REST || (residual < ROUNDING && since > STAGNANT) {
                return Ok(x);
            }
            unused.fill(0.0);
            self.linearize(time, &x, &dx, &mut unused);
            let mut change = dx.clone();
            let mut next = f64::NAN;
            if self.factor(1.0 / step).is_ok() {
                self.solve(&mut change);
                for &i in &moves {
                    trial[i] = x[i] + change[i];
                }
                self.derivative(time, &trial, &mut dx);
                next = size(&dx);
            }
            if next < 2.0 * residual {
                step *= (residual / next).clamp(0.5, 10.0).max(1.2);
                residual = next;
                x.copy_from_slice(&trial);
            } else {
                step *= 0.25;
                self.derivative(time, &x, &mut dx);
            }
        }
        if residual >= lowest {
            self.derivative(time, &nearest, &mut dx);
        }
        let worst = (0..n).fold(0, |w, i| if dx[n + i].abs() > dx[n + w].abs() { i } else { w });
        let free = self.free.iter().rev().find(|free| free.offset <= worst);
        let (body, coordinate) = free.map_or((String::new(), ""), |free| {
            (
                self.bodies[free.body].name.clone(),
                COORDINATES[free.free[worst - free.offset]],
            )
        });
        Err(NoEquilibrium {
            iterations: ITERATIONS,
            body,
            coordinate,
            acceleration: dx[n + worst],
            residual: size(&dx),
            nearest,
            last: x,
        })
    }
}
