//! On which piece of the right-hand side a place lies.
//!
//! Contact and friction are nearly linear in pieces: while the same points are closed, and friction holds them as it did, derivatives change
//! little. What friction with the slip `u`, in units of its layer, does to derivatives is seen from
//!
//! ```text
//! φ = u/√(1 + u²),   ∂φ/∂u = (1 - φ φᵀ)/√(1 + u²),
//! ```
//!
//! which is near to the law of smoothed Coulomb friction (`u tanh(u)/u` with its length for `u` in it, Steets 2007, eq. 3-8) and costs one root: how a point
//! that sticks is held, from one at rest to none, and where the friction of one that slips points to.

use crate::kinks::{KinkSigns, square};

/// Entries of ∂φ/∂u may differ by this. By 0.2 a sixth of the matrices is saved, but losses of what sticks, which change as fast as its hold, come out
/// worse: ledgers of studies miss 1.5e-3 of the work instead of 0.9e-3.
const NEAR: f64 = 0.1;
/// Parts of φ may differ by this.
const TURNED: f64 = 0.5;

/// A piece.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Piece {
    /// Which of the first 64 values are negative, and of the others.
    first: u64,
    others: Vec<u64>,
    /// By direction: the parts of φ, in units of what they may differ by; the entries of ∂φ/∂u, in units of theirs.
    holds: Vec<[f64; 5]>,
}

impl Piece {
    /// Room for what a problem tells.
    pub fn of(signs: &KinkSigns) -> Self {
        Self {
            first: 0,
            others: vec![0; signs.values.len().div_ceil(64).saturating_sub(1)],
            holds: vec![[0.0; 5]; signs.directions.len()],
        }
    }

    /// Takes what a problem tells of a place.
    pub fn see(&mut self, signs: &KinkSigns) {
        let mut words = signs.values.chunks(64).map(|values| {
            let bit = |word, value: &f64| word << 1 | u64::from(*value < 0.0);
            values.iter().fold(0, bit)
        });
        self.first = words.next().unwrap_or(0);
        for (target, word) in self.others.iter_mut().zip(words) {
            *target = word;
        }
        for (hold, direction) in self.holds.iter_mut().zip(&signs.directions) {
            *hold = hold_of(*direction);
        }
    }

    /// Whether this is about the same piece.
    pub fn is(&self, other: &Self) -> bool {
        self.first == other.first
            && self.others.iter().zip(&other.others).all(|(a, b)| a == b)
            && self.holds.iter().zip(&other.holds).all(|(a, b)| is_near(a, b))
    }
}

#[inline(always)]
fn is_near(a: &[f64; 5], b: &[f64; 5]) -> bool {
    a.iter()
        .zip(b)
        .fold(true, |all, (a, b)| all & ((a - b).abs() <= 1.0))
}

/// Zeros where there is nothing to reverse.
fn hold_of([x, y]: [f64; 2]) -> [f64; 5] {
    let square = square(&[x, y]);
    if square.is_nan() {
        return [0.0; 5];
    }
    let across = 1.0 / (1.0 + square).sqrt();
    let (a, b) = (x * across, y * across);
    let entry = |value: f64| across * value * (1.0 / NEAR);
    [
        a * (1.0 / TURNED),
        b * (1.0 / TURNED),
        entry(1.0 - a * a),
        entry(1.0 - b * b),
        entry(a * b),
    ]
}

#[cfg(test)]
mod tests {
    use super::*;

    const NONE: [f64; 2] = [f64::NAN; 2];

    fn piece(value: f64, direction: [f64; 2]) -> Piece {
        let signs = KinkSigns {
            values: vec![value],
            directions: vec![direction],
        };
        let mut piece = Piece::of(&signs);
        piece.see(&signs);
        piece
    }

    #[test]
    fn a_piece_ends_where_a_point_opens_or_its_slip_turns_or_comes_to_stick() {
        let slips = piece(-1e-4, [100.0, 0.0]);
        let sticks = piece(-1e-4, [0.2, 0.0]);
        for (a, b, one) in [
            (&slips, piece(-2e-4, [30.0, 5.0]), true),
            (&slips, piece(-1e-4, [1e9, 0.0]), true),
            (&slips, piece(-1e-4, [-100.0, 0.0]), false),
            (&slips, piece(-1e-4, [0.0, 100.0]), false),
            (&slips, piece(-1e-4, [2.0, 0.0]), false),
            (&slips, piece(1e-4, NONE), false),
            (&slips, piece(-1e-4, [f64::INFINITY, 0.0]), false),
            (&sticks, piece(-1e-4, [-0.1, 0.1]), true),
            (&sticks, piece(-1e-4, [1.0, 0.0]), false),
            (&piece(1e-4, NONE), piece(1e-5, NONE), true),
            (&piece(-1e-4, NONE), piece(1e-5, NONE), false),
        ] {
            assert_eq!(a.is(&b), one, "{a:?}, {b:?}");
            assert_eq!(b.is(a), one, "{b:?}, {a:?}");
        }
    }

    /// The entries against differences of φ.
    #[test]
    fn holds_are_derivatives() {
        let [x, y] = [0.7, -1.3];
        let step = 1e-6;
        let phi = |x: f64, y: f64| {
            let hold = hold_of([x, y]);
            [hold[0] * TURNED, hold[1] * TURNED]
        };
        let by = |a: [f64; 2], b: [f64; 2]| [0, 1].map(|i| (b[i] - a[i]) / (2.0 * step));
        let by_x = by(phi(x - step, y), phi(x + step, y));
        let by_y = by(phi(x, y - step), phi(x, y + step));
        let [_, _, xx, yy, cross] = hold_of([x, y]);
        // The cross entry is taken without its sign.
        for (entry, difference) in [(xx, by_x[0]), (yy, by_y[1]), (-cross, by_x[1]), (-cross, by_y[0])] {
            assert!((entry * NEAR - difference).abs() < 1e-9, "{entry} {difference}");
        }
    }
}
