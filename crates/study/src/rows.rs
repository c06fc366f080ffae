//! The output times of a run.

use integrate::{Integrator, Problem};

/// The rows of a run: at multiples of the output interval, and at the end.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Rows {
    /// Their number.
    pub count: u64,
    /// The end of the run, s.
    pub end: f64,
    /// The time between two of them, s.
    pub interval: f64,
}

impl Rows {
    /// Returns those of a run that ends at `end` (s), each `interval` (s).
    pub fn new(end: f64, interval: f64) -> Self {
        let whole = (end / interval * (1.0 + 1e-12)).floor();
        let rest = end - whole * interval > 1e-9 * interval;
        let count = whole as u64 + 1 + u64::from(rest);
        Self { count, end, interval }
    }

    /// Returns the time of a row, s; the last one is the end.
    pub fn time(&self, row: u64) -> f64 {
        if row + 1 == self.count {
            self.end
        } else {
            (row as f64 * self.interval).min(self.end)
        }
    }

    /// Returns the latest end of an integrator's next step, s, if this row is the next one.
    pub fn limit<P: Problem>(&self, next: u64, integrator: &Integrator<P>) -> f64 {
        integrator.step_limit(self.time(next), self.end)
    }
}
