//! Where a correction of Newton's method that gets across the reversal of a direction comes to rest.
//!
//! Along a correction `d` a problem with friction goes as a jump: outside of the layer in which slip reverses corrections that are still to come
//! have the part `1 - f` along it, inside of it they turn. With the slip `u` along its change, in units of the layer, and `m`, what it
//! misses zero by,
//!
//! ```text
//! s(f) = 1 - f - B (φ(u(f)) - φ(u(0))),   φ(u) = u tanh(r)/r,  r² = u² + m²,
//! ```
//!
//! the law of smoothed Coulomb friction (Steets 2007, eq. 3-8); B is such that s is what was found at one place. Its zero was within the
//! tolerance of the search after 1.2 evaluations on average in a rattling wedge, where regula falsi takes seven or eight: s is 1 at one end and -10 to -40 at the
//! other.

use crate::kinks::{KinkSigns, square};

/// Outside of this size a direction is taken to be out of its layer.
const OUTSIDE: f64 = 4.0;
/// Corrections of the place where it comes to rest, at most; and how small the last one is, in units of the layer.
const ROUNDS: u32 = 10;
const CLOSE: f64 = 0.002;

/// One direction that reverses between both ends of a correction.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Reversal {
    /// Its parts along its change at both ends.
    start: f64,
    end: f64,
    /// Its part across.
    miss: f64,
}

impl Reversal {
    /// The first one along a correction, by what tells kinks at both ends.
    pub fn first(from: &KinkSigns, to: &KinkSigns) -> Option<Self> {
        let mut first: Option<(f64, Self)> = None;
        for (a, b) in from.directions.iter().zip(&to.directions) {
            // not so where one of them is no number
            if a[0] * b[0] + a[1] * b[1] < 0.0 {
                let change = [b[0] - a[0], b[1] - a[1]];
                let length = square(&change).sqrt();
                let along = |d: &[f64; 2]| (d[0] * change[0] + d[1] * change[1]) / length;
                let (start, end) = (along(a), along(b));
                let place = -start / length;
                if first.is_none_or(|(least, _)| place < least) {
                    let miss = (a[0] * change[1] - a[1] * change[0]).abs() / length;
                    first = Some((place, Self { start, end, miss }));
                }
            }
        }
        first.map(|(_, reversal)| reversal)
    }

    /// φ at a part of the correction, and its slope by that part.
    fn force(&self, part: f64) -> (f64, f64) {
        let change = self.end - self.start;
        let u = self.start + part * change;
        let r = square(&[u, self.miss]).sqrt();
        if r == 0.0 {
            return (0.0, change);
        }
        let tanh = libm::tanh(r);
        let (ratio, hold) = (tanh / r, 1.0 - tanh * tanh);
        let along = u / r;
        (u * ratio, (ratio + along * along * (hold - ratio)) * change)
    }

    /// The part of the correction where the next one has no part along it, if it has the part `along` after the part `at`.
    pub fn rest(&self, at: f64, along: f64) -> Option<f64> {
        let change = self.end - self.start;
        let (before, _) = self.force(0.0);
        let jump = (1.0 - at - along) / (self.force(at).0 - before);
        // s(f), and how fast it falls.
        let ahead = |f: f64| {
            let (force, slope) = self.force(f);
            (1.0 - f - jump * (force - before), 1.0 + jump * slope)
        };
        if !jump.is_finite() || ahead(1.0).0 > 0.0 {
            return None;
        }
        let place = |u: f64| ((u - self.start) / change).clamp(0.0, 1.0);
        let (mut low, mut high) = (0.0, 1.0);
        for edge in [place(-OUTSIDE), place(OUTSIDE)] {
            if ahead(edge).0 > 0.0 {
                low = edge;
            } else {
                high = edge;
                break;
            }
        }
        // Newton's method, halving where it leaves the bounds.
        let mut at = 0.5 * (low + high);
        for _ in 0..ROUNDS {
            let (value, falls) = ahead(at);
            if value > 0.0 {
                low = at;
            } else {
                high = at;
            }
            let next = at + value / falls;
            let last = at;
            at = if low < next && next < high {
                next
            } else {
                0.5 * (low + high)
            };
            if ((at - last) * change).abs() < CLOSE {
                break;
            }
        }
        Some(at)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn signs(direction: [f64; 2]) -> KinkSigns {
        KinkSigns {
            values: Vec::new(),
            directions: vec![[f64::NAN; 2], direction],
        }
    }

    /// Slip that a load holds in its layer: `1 - f - B (tanh u - tanh u0)` by hand, from either end.
    #[test]
    fn a_held_slip_is_found_by_one_evaluation() {
        let reversal = Reversal::first(&signs([0.0, -4.6]), &signs([0.0, 3.6])).unwrap();
        let jump = 19.0;
        let along = |f: f64| 1.0 - f - jump * (libm::tanh(8.2 * f - 4.6) - libm::tanh(-4.6));
        for at in [1.0, 0.5] {
            let rest = reversal.rest(at, along(at)).unwrap();
            assert!(along(rest).abs() < 0.06, "{rest}: {}", along(rest));
        }
    }

    /// Slip that turns at some distance from zero is braked along its change only by the part that its direction has there.
    #[test]
    fn a_slip_that_passes_beside_zero_turns() {
        let reversal = Reversal::first(&signs([-30.0, 5.0]), &signs([10.0, 5.0])).unwrap();
        assert!((reversal.miss - 5.0).abs() < 1e-12);
        let along = |f: f64| {
            let force = |f: f64| {
                let u = 40.0 * f - 30.0;
                u / libm::sqrt(u * u + 25.0)
            };
            1.0 - f - 2.0 * (force(f) - force(0.0))
        };
        let rest = reversal.rest(1.0, along(1.0)).unwrap();
        assert!(along(rest).abs() < 0.01, "{rest}: {}", along(rest));
    }

    #[test]
    fn the_first_of_several_reversals_counts_and_nothing_else_does() {
        let signs = |directions: &[[f64; 2]]| KinkSigns {
            values: vec![1.0; directions.len()],
            directions: directions.to_vec(),
        };
        let from = signs(&[[1.0, 0.0], [-70.0, 0.0], [12.0, 0.0], [f64::NAN; 2]]);
        let to = signs(&[[2.0, 0.0], [600.0, 0.0], [-2600.0, 0.0], [1.0, 0.0]]);
        let first = Reversal::first(&from, &to).unwrap();
        assert_eq!((first.start, first.end, first.miss), (-12.0, 2600.0, 0.0));
        assert_eq!(Reversal::first(&from, &from), None);
        // Nothing points back: there is no place to rest.
        assert_eq!(first.rest(1.0, 0.5), None);
    }
}
