//! Line search along a correction that leads across a discontinuity.
//!
//! If a correction crosses a discontinuity - slip that reverses, a contact that opens - the next one points
//! back. The zero of its component along the first correction is then located between both ends, and the
//! Jacobian matrix is evaluated there. Without this search Newton's method alternates between both sides of a
//! slip reversal, and steps have to be as short as the regularization zone is thin. Regula falsi with the
//! Illinois modification (M. Dowell, P. Jarratt, BIT 11 (1971) 168). Natural corrections: P. Deuflhard,
//! *Newton Methods for Nonlinear Problems*, Springer 2004, section 3.

use crate::tuning::newton as tuning;

/// A search along a correction: fractions of it, with the component of the next correction along it there.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct LineSearch {
    low: (f64, f64),
    high: (f64, f64),
    fraction: f64,
    /// True if the low end was moved last; the component of an end that stays twice is halved.
    moved_low: Option<bool>,
    evaluations: u32,
}

impl LineSearch {
    /// Starts a search between the start of a correction and its end, where the component is `component`.
    pub fn new(component: f64) -> Self {
        Self {
            low: (0.0, 1.0),
            high: (1.0, component),
            fraction: 1.0,
            ..Self::default()
        }
    }

    /// Returns the next fraction.
    pub fn next_fraction(&mut self) -> f64 {
        let ((a, fa), (b, fb)) = (self.low, self.high);
        self.evaluations += 1;
        self.fraction = (a * fb - b * fa) / (fb - fa);
        self.fraction
    }

    /// Stores the component found at the last fraction; returns whether the search is over.
    pub fn update(&mut self, component: f64) -> bool {
        if component.abs() < tuning::LINE_SEARCH || self.evaluations >= tuning::MAXIMUM_LINE_SEARCH {
            return true;
        }
        let moves_low = component > 0.0;
        if moves_low {
            self.low = (self.fraction, component);
            if self.moved_low == Some(true) {
                self.high.1 *= 0.5;
            }
        } else {
            self.high = (self.fraction, component);
            if self.moved_low == Some(false) {
                self.low.1 *= 0.5;
            }
        }
        self.moved_low = Some(moves_low);
        false
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A component that falls from 1 to -10 within a tenth of the correction.
    #[test]
    fn a_jump_is_located() {
        let component = |fraction: f64| (10.0 * (0.3 - fraction)).clamp(-10.0, 1.0);
        let mut search = LineSearch::new(component(1.0));
        for evaluations in 1.. {
            let fraction = search.next_fraction();
            if search.update(component(fraction)) {
                assert!((fraction - 0.3).abs() < 0.01, "{fraction}");
                assert!(evaluations < tuning::MAXIMUM_LINE_SEARCH, "{evaluations}");
                break;
            }
        }
    }
}
