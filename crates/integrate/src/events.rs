//! Recording and timing the changes of discrete switches.

use serde::{Deserialize, Serialize};

use crate::lanes::LANES;
use crate::problem::Problem;
use crate::stages::{Dense, leading_states};
use crate::statistics::Statistics;

/// A switch changed its mode.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Event {
    /// When.
    pub time: f64,
    /// Number of the switch.
    pub index: usize,
    /// The mode before.
    pub from: u8,
    /// The mode after.
    pub to: u8,
}

/// The switches of a problem.
#[derive(Clone, Debug)]
pub(crate) struct Switches {
    pub modes: Vec<u8>,
    pub before: Vec<u8>,
    pub events: Vec<Event>,
    margins: Vec<f64>,
    /// Sizes of the margins in a bracket, to compare them with each other.
    sizes: Vec<f64>,
    /// Switches that are not looked at any more in this step: `next_mode` declined.
    muted: Vec<bool>,
    /// Switches that have changed at the present instant.
    changed: Vec<bool>,
    /// States at a fraction of the step; only the leading ones, padded, are brought up to date.
    x: Vec<f64>,
    dimension: usize,
    leading: usize,
}

impl Switches {
    pub fn new<P: Problem>(problem: &P, modes: Vec<u8>, capacity: usize) -> Self {
        let (dimension, leading) = (problem.dimension(), leading_states(problem));
        let count = modes.len();
        let capacity = if count == 0 { 0 } else { capacity };
        Self {
            before: modes.clone(),
            modes,
            events: Vec::with_capacity(capacity),
            margins: vec![0.0; count],
            sizes: vec![0.0; count],
            muted: vec![false; count],
            changed: vec![false; count],
            x: vec![0.0; dimension.next_multiple_of(LANES)],
            dimension,
            leading,
        }
    }

    /// Evaluates the margins at a fraction of the step.
    #[inline]
    fn evaluate<P: Problem>(&mut self, problem: &mut P, dense: &Dense<'_>, theta: f64) {
        dense.evaluate(theta, &mut self.x[..self.leading]);
        let x = &self.x[..self.dimension];
        problem.margins(dense.time(theta), x, &self.modes, &mut self.margins);
    }

    /// Whether a switch must leave its mode by the margins just evaluated.
    #[inline]
    fn leaving(&self) -> bool {
        self.margins
            .iter()
            .zip(&self.muted)
            .any(|(margin, muted)| *margin <= 0.0 && !muted)
    }

    /// Finds all changes of modes in a step.
    pub fn detect<P: Problem>(
        &mut self,
        problem: &mut P,
        dense: &Dense<'_>,
        maximum: usize,
        statistics: &mut Statistics,
    ) {
        self.events.clear();
        self.before.copy_from_slice(&self.modes);
        self.muted.fill(false);
        let resolution = (4.0 * f64::EPSILON * dense.end.abs() / dense.step).max(1e-12);
        let mut from = 0.0;
        for to in [0.5, 1.0] {
            loop {
                if from > to {
                    break;
                }
                self.evaluate(problem, dense, to);
                if !self.leaving() {
                    break;
                }
                let theta = self.locate(problem, dense, from, to, resolution);
                if self.events.len() >= maximum {
                    statistics.events_unresolved += 1;
                    return;
                }
                self.change(problem, dense, theta, maximum, statistics);
                // A change that leads straight to the next one is told apart by the resolution.
                from = theta + resolution;
            }
        }
    }

    /// The first instant in `from ..= to` at which a switch must leave, given that one must at `to`.
    fn locate<P: Problem>(
        &mut self,
        problem: &mut P,
        dense: &Dense<'_>,
        from: f64,
        to: f64,
        resolution: f64,
    ) -> f64 {
        let (mut low, mut high) = (from, to);
        for (size, margin) in self.sizes.iter_mut().zip(&self.margins) {
            *size = margin.abs();
        }
        self.evaluate(problem, dense, low);
        if self.leaving() {
            return low;
        }
        for (size, margin) in self.sizes.iter_mut().zip(&self.margins) {
            *size = size.max(margin.abs());
        }
        let mut at_low = self.smallest();
        self.evaluate(problem, dense, high);
        let mut at_high = self.smallest();
        // Illinois; bisection where four rounds do not shorten the bracket to an eighth
        let mut width = high - low;
        let (mut round, mut kept_low) = (0, None);
        while high - low > resolution {
            round += 1;
            let mut theta = low + (high - low) * (at_low / (at_low - at_high));
            if round % 4 == 0 {
                if high - low > 0.125 * width {
                    theta = 0.5 * (low + high);
                }
                width = high - low;
            }
            // so near to an end that the bracket collapses if the sign there is as expected
            theta = theta.max(low + 0.25 * resolution).min(high - 0.25 * resolution);
            self.evaluate(problem, dense, theta);
            let value = self.smallest();
            if value > 0.0 {
                (low, at_low) = (theta, value);
                if kept_low == Some(false) {
                    at_high *= 0.5;
                }
                kept_low = Some(false);
            } else {
                (high, at_high) = (theta, value);
                if kept_low == Some(true) {
                    at_low *= 0.5;
                }
                kept_low = Some(true);
            }
        }
        high
    }

    /// The smallest margin relative to its size.
    fn smallest(&self) -> f64 {
        let mut least = f64::INFINITY;
        for ((margin, size), muted) in self.margins.iter().zip(&self.sizes).zip(&self.muted) {
            if !muted {
                let ratio = margin / size.max(f64::MIN_POSITIVE);
                if ratio < least {
                    least = ratio;
                }
            }
        }
        least
    }

    /// Changes the modes of all switches that must leave at an instant, each once.
    fn change<P: Problem>(
        &mut self,
        problem: &mut P,
        dense: &Dense<'_>,
        theta: f64,
        maximum: usize,
        statistics: &mut Statistics,
    ) {
        self.changed.fill(false);
        self.evaluate(problem, dense, theta);
        let time = dense.time(theta);
        while let Some(index) =
            (0..self.modes.len()).find(|&i| self.margins[i] <= 0.0 && !self.muted[i] && !self.changed[i])
        {
            if self.events.len() >= maximum {
                return;
            }
            let from = self.modes[index];
            let to = problem.next_mode(time, &self.x[..self.dimension], index, from);
            if to == from {
                self.muted[index] = true;
                continue;
            }
            self.changed[index] = true;
            self.modes[index] = to;
            self.events.push(Event {
                time,
                index,
                from,
                to,
            });
            statistics.events += 1;
            // the margins of other switches may depend on this mode
            problem.margins(time, &self.x[..self.dimension], &self.modes, &mut self.margins);
        }
    }
}
