//! Contact state (active set): the part of the problem's state that decides whether a Jacobian matrix is
//! valid.
//!
//! Contact and friction are piecewise nearly linear: while the same contacts are closed and friction holds
//! them alike, derivatives change little. How friction with the slip `u` enters derivatives is measured by
//!
//! ```text
//! φ = u/√(1 + u²),   ∂φ/∂u = (1 - φ φᵀ)/√(1 + u²),
//! ```
//!
//! which is near to the law of regularized Coulomb friction (`tanh(|u|) u/|u|`, Steets 2007, eq. 3-8) and
//! costs one square root: φ is the direction of the friction of a sliding contact, ∂φ/∂u the stiffness with
//! which one that sticks is held. Decision 0034.

use crate::discontinuity::{DiscontinuityFunctions, square};
use crate::tuning::contact_state as tuning;

/// A contact state.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct ActiveSet {
    /// Bits of the negative ones among the first 64 values, and among the others.
    first: u64,
    others: Vec<u64>,
    /// For each slip the components of φ and the entries of ∂φ/∂u, in units of their admissible difference.
    friction: Vec<[f64; 5]>,
}

impl ActiveSet {
    /// Returns the memory for so many discontinuity functions.
    pub fn new(functions: &DiscontinuityFunctions) -> Self {
        Self {
            first: 0,
            others: vec![0; functions.values.len().div_ceil(64).saturating_sub(1)],
            friction: vec![[0.0; 5]; functions.slips.len()],
        }
    }

    /// Computes the contact state from the discontinuity functions at a point.
    pub fn set(&mut self, functions: &DiscontinuityFunctions) {
        let mut words = functions.values.chunks(64).map(|values| {
            let bit = |word, value: &f64| word << 1 | u64::from(*value < 0.0);
            values.iter().fold(0, bit)
        });
        self.first = words.next().unwrap_or(0);
        for (target, word) in self.others.iter_mut().zip(words) {
            *target = word;
        }
        for (friction, slip) in self.friction.iter_mut().zip(&functions.slips) {
            *friction = friction_of(*slip);
        }
    }

    /// Returns whether a matrix of one of both contact states is valid in the other.
    pub fn is_near(&self, other: &Self) -> bool {
        self.first == other.first
            && self.others.iter().zip(&other.others).all(|(a, b)| a == b)
            && self
                .friction
                .iter()
                .zip(&other.friction)
                .all(|(a, b)| friction_is_near(a, b))
    }
}

#[inline(always)]
fn friction_is_near(a: &[f64; 5], b: &[f64; 5]) -> bool {
    a.iter()
        .zip(b)
        .fold(true, |all, (a, b)| all & ((a - b).abs() <= 1.0))
}

/// Returns φ and ∂φ/∂u; zeros where there is no friction.
fn friction_of([x, y]: [f64; 2]) -> [f64; 5] {
    let square = square(&[x, y]);
    if square.is_nan() {
        return [0.0; 5];
    }
    let across = 1.0 / (1.0 + square).sqrt();
    let (a, b) = (x * across, y * across);
    let tangent = |value: f64| across * value * (1.0 / tuning::TANGENT_DIFFERENCE);
    [
        a * (1.0 / tuning::FORCE_DIFFERENCE),
        b * (1.0 / tuning::FORCE_DIFFERENCE),
        tangent(1.0 - a * a),
        tangent(1.0 - b * b),
        tangent(a * b),
    ]
}

#[cfg(test)]
mod tests {
    use super::*;

    const NO_FRICTION: [f64; 2] = [f64::NAN; 2];

    fn state(value: f64, slip: [f64; 2]) -> ActiveSet {
        let functions = DiscontinuityFunctions {
            values: vec![value],
            slips: vec![slip],
        };
        let mut state = ActiveSet::new(&functions);
        state.set(&functions);
        state
    }

    #[test]
    fn a_contact_state_ends_where_a_contact_opens_or_its_slip_turns_or_comes_to_stick() {
        let slips = state(-1e-4, [100.0, 0.0]);
        let sticks = state(-1e-4, [0.2, 0.0]);
        for (a, b, near) in [
            (&slips, state(-2e-4, [30.0, 5.0]), true),
            (&slips, state(-1e-4, [1e9, 0.0]), true),
            (&slips, state(-1e-4, [-100.0, 0.0]), false),
            (&slips, state(-1e-4, [0.0, 100.0]), false),
            (&slips, state(-1e-4, [2.0, 0.0]), false),
            (&slips, state(1e-4, NO_FRICTION), false),
            (&slips, state(-1e-4, [f64::INFINITY, 0.0]), false),
            (&sticks, state(-1e-4, [-0.1, 0.1]), true),
            (&sticks, state(-1e-4, [1.0, 0.0]), false),
            (&state(1e-4, NO_FRICTION), state(1e-5, NO_FRICTION), true),
            (&state(-1e-4, NO_FRICTION), state(1e-5, NO_FRICTION), false),
        ] {
            assert_eq!(a.is_near(&b), near, "{a:?}, {b:?}");
            assert_eq!(b.is_near(a), near, "{b:?}, {a:?}");
        }
    }

    /// The tangent against differences of φ.
    #[test]
    fn tangents_are_derivatives() {
        let [x, y] = [0.7, -1.3];
        let step = 1e-6;
        let phi = |x: f64, y: f64| {
            let friction = friction_of([x, y]);
            [0, 1].map(|i| friction[i] * tuning::FORCE_DIFFERENCE)
        };
        let by = |a: [f64; 2], b: [f64; 2]| [0, 1].map(|i| (b[i] - a[i]) / (2.0 * step));
        let by_x = by(phi(x - step, y), phi(x + step, y));
        let by_y = by(phi(x, y - step), phi(x, y + step));
        let [_, _, xx, yy, cross] = friction_of([x, y]);
        // The cross entry is stored without its sign.
        for (entry, difference) in [(xx, by_x[0]), (yy, by_y[1]), (-cross, by_x[1]), (-cross, by_y[0])] {
            let entry = entry * tuning::TANGENT_DIFFERENCE;
            assert!((entry - difference).abs() < 1e-9, "{entry} {difference}");
        }
    }
}
