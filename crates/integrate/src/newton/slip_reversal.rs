//! Model of a line search across a slip reversal.
//!
//! Along a Newton correction `d` that reverses a slip, the component `s` of the next correction along `d`
//! changes like a jump: outside of the regularization zone it is `1 - f` at the fraction `f` of `d`, inside
//! of it changes its sign. With the component `u` of the slip along its change, and `m` the one across (the
//! distance at which it passes zero),
//!
//! ```text
//! s(f) = 1 - f - B (φ(u(f)) - φ(u(0))),   φ(u) = u tanh(r)/r,  r² = u² + m²,
//! ```
//!
//! by the law of regularized Coulomb friction (Steets 2007, eq. 3-8); B follows from the component found at
//! one fraction. The zero of this model is within the tolerance of the line search after 1.2 evaluations on
//! average, where regula falsi takes seven or eight: s is 1 at one end and -10 to -40 at the other. Decision
//! 0033.

use crate::discontinuity::{DiscontinuityFunctions, square};
use crate::tuning::slip_reversal as tuning;

/// A slip that reverses between both ends of a correction.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct SlipReversal {
    /// Components along its change at both ends.
    start: f64,
    end: f64,
    /// Component across.
    miss: f64,
}

impl SlipReversal {
    /// Returns the first reversal along a correction, from the discontinuity functions at both ends.
    pub fn first(from: &DiscontinuityFunctions, to: &DiscontinuityFunctions) -> Option<Self> {
        let mut first: Option<(f64, Self)> = None;
        for (a, b) in from.slips.iter().zip(&to.slips) {
            // False where one of them is not a number.
            if a[0] * b[0] + a[1] * b[1] < 0.0 {
                let change = [b[0] - a[0], b[1] - a[1]];
                let length = square(&change).sqrt();
                let along = |slip: &[f64; 2]| (slip[0] * change[0] + slip[1] * change[1]) / length;
                let (start, end) = (along(a), along(b));
                let fraction = -start / length;
                if first.is_none_or(|(smallest, _)| fraction < smallest) {
                    let miss = (a[0] * change[1] - a[1] * change[0]).abs() / length;
                    first = Some((fraction, Self { start, end, miss }));
                }
            }
        }
        first.map(|(_, reversal)| reversal)
    }

    /// Returns φ at a fraction of the correction, and its derivative by the fraction.
    fn force(&self, fraction: f64) -> (f64, f64) {
        let change = self.end - self.start;
        let u = self.start + fraction * change;
        let r = square(&[u, self.miss]).sqrt();
        if r == 0.0 {
            return (0.0, change);
        }
        let tanh = libm::tanh(r);
        let (ratio, slope) = (tanh / r, 1.0 - tanh * tanh);
        let along = u / r;
        (u * ratio, (ratio + along * along * (slope - ratio)) * change)
    }

    /// Returns the fraction where the next correction has no component along this one, if it has the
    /// component `component` at the fraction `at`. Returns none if the model has no zero.
    pub fn zero(&self, at: f64, component: f64) -> Option<f64> {
        let change = self.end - self.start;
        let (before, _) = self.force(0.0);
        let jump = (1.0 - at - component) / (self.force(at).0 - before);
        // s(f) and -ds/df.
        let model = |f: f64| {
            let (force, slope) = self.force(f);
            (1.0 - f - jump * (force - before), 1.0 + jump * slope)
        };
        if !jump.is_finite() || model(1.0).0 > 0.0 {
            return None;
        }
        let fraction = |u: f64| ((u - self.start) / change).clamp(0.0, 1.0);
        let (mut low, mut high) = (0.0, 1.0);
        for edge in [fraction(-tuning::OUTSIDE_ZONE), fraction(tuning::OUTSIDE_ZONE)] {
            if model(edge).0 > 0.0 {
                low = edge;
            } else {
                high = edge;
                break;
            }
        }
        // Newton's method, or bisection where it leaves the bracket.
        let mut at = 0.5 * (low + high);
        for _ in 0..tuning::MAXIMUM_ITERATIONS {
            let (value, fall) = model(at);
            if value > 0.0 {
                low = at;
            } else {
                high = at;
            }
            let next = at + value / fall;
            let last = at;
            at = if low < next && next < high {
                next
            } else {
                0.5 * (low + high)
            };
            if ((at - last) * change).abs() < tuning::CONVERGED {
                break;
            }
        }
        Some(at)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn functions(slip: [f64; 2]) -> DiscontinuityFunctions {
        DiscontinuityFunctions {
            values: Vec::new(),
            slips: vec![[f64::NAN; 2], slip],
        }
    }

    /// Slip that a load holds in its zone: `1 - f - B (tanh u - tanh u0)` by hand, from either end.
    #[test]
    fn a_held_slip_is_found_by_one_evaluation() {
        let reversal = SlipReversal::first(&functions([0.0, -4.6]), &functions([0.0, 3.6])).unwrap();
        let jump = 19.0;
        let component = |f: f64| 1.0 - f - jump * (libm::tanh(8.2 * f - 4.6) - libm::tanh(-4.6));
        for at in [1.0, 0.5] {
            let zero = reversal.zero(at, component(at)).unwrap();
            assert!(component(zero).abs() < 0.06, "{zero}: {}", component(zero));
        }
    }

    /// Slip that passes zero at a distance is braked along its change only by its component along it.
    #[test]
    fn a_slip_that_passes_beside_zero_turns() {
        let reversal = SlipReversal::first(&functions([-30.0, 5.0]), &functions([10.0, 5.0])).unwrap();
        assert!((reversal.miss - 5.0).abs() < 1e-12);
        let component = |f: f64| {
            let force = |f: f64| {
                let u = 40.0 * f - 30.0;
                u / libm::sqrt(u * u + 25.0)
            };
            1.0 - f - 2.0 * (force(f) - force(0.0))
        };
        let zero = reversal.zero(1.0, component(1.0)).unwrap();
        assert!(component(zero).abs() < 0.01, "{zero}: {}", component(zero));
    }

    #[test]
    fn the_first_of_several_reversals_counts_and_nothing_else_does() {
        let functions = |slips: &[[f64; 2]]| DiscontinuityFunctions {
            values: vec![1.0; slips.len()],
            slips: slips.to_vec(),
        };
        let from = functions(&[[1.0, 0.0], [-70.0, 0.0], [12.0, 0.0], [f64::NAN; 2]]);
        let to = functions(&[[2.0, 0.0], [600.0, 0.0], [-2600.0, 0.0], [1.0, 0.0]]);
        let first = SlipReversal::first(&from, &to).unwrap();
        assert_eq!((first.start, first.end, first.miss), (-12.0, 2600.0, 0.0));
        assert_eq!(SlipReversal::first(&from, &from), None);
        // Nothing points back: the model has no zero.
        assert_eq!(first.zero(1.0, 0.5), None);
    }
}
