//! Recording and timing the changes of discrete switches.

use serde::{Deserialize, Serialize};

use crate::lanes::LANES;
use crate::problem::Problem;
use crate::search::Search;
use crate::stages::{Dense, leading_states};
use crate::statistics::Statistics;
use crate::tableau::Family;

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
    /// Margins with the present modes: at the place that was evaluated last, at the beginning of what is searched, at the end of the step.
    margins: Vec<f64>,
    at_start: Vec<f64>,
    at_end: Vec<f64>,
    /// Whether `at_start` holds them.
    start_known: bool,
    search: Search,
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
            at_start: vec![0.0; count],
            at_end: vec![0.0; count],
            start_known: false,
            search: Search::new(count),
            muted: vec![false; count],
            changed: vec![false; count],
            x: vec![0.0; dimension.next_multiple_of(LANES)],
            dimension,
            leading,
        }
    }

    /// Tells that the margins at the place reached may have changed: those known of it are not used any more.
    pub fn forget(&mut self) {
        self.start_known = false;
    }

    /// Evaluates the margins at the end of a step. Before [`Switches::detect`], and apart from it: right after other functions were
    /// evaluated there it may cost the problem little.
    pub fn look<P: Problem>(&mut self, problem: &mut P, time: f64, x: &[f64]) {
        problem.margins(time, x, &self.modes, &mut self.at_end);
    }

    /// Brings the states to a fraction of the step.
    #[inline]
    fn place(&mut self, dense: &Dense<'_>, theta: f64) {
        dense.evaluate(theta, &mut self.x[..self.leading]);
    }

    /// Evaluates the margins at a fraction of the step.
    #[inline]
    fn evaluate<P: Problem>(&mut self, problem: &mut P, dense: &Dense<'_>, theta: f64) {
        self.place(dense, theta);
        let x = &self.x[..self.dimension];
        problem.margins(dense.time(theta), x, &self.modes, &mut self.margins);
    }

    /// Finds all changes of modes in a step, at whose end [`Switches::look`] was called.
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
        let mut end_known = true;
        // A step by collocation is two to four times as long as others; an explicit one spans a radian or so of the fastest answer at most.
        let looks: &[f64] = match dense.tableau.family {
            Family::Collocation => &[0.25, 0.5, 0.75, 1.0],
            Family::Explicit => &[1.0],
            Family::LinearlyImplicit | Family::DiagonallyImplicit => &[0.5, 1.0],
        };
        for &to in looks {
            while from <= to {
                if to == 1.0 && end_known {
                    self.margins.copy_from_slice(&self.at_end);
                } else {
                    self.evaluate(problem, dense, to);
                }
                if !leaving(&self.margins, &self.muted) {
                    // The search for a change in the second half begins at the start all the same: there may be several.
                    if to == 1.0 {
                        std::mem::swap(&mut self.margins, &mut self.at_start);
                        self.start_known = true;
                    }
                    break;
                }
                let theta = self.locate(problem, dense, from, to, resolution);
                self.start_known = false;
                if self.events.len() >= maximum {
                    statistics.events_unresolved += 1;
                    return;
                }
                let known = self.events.len();
                self.change(problem, dense, theta, maximum, statistics);
                end_known &= self.events.len() == known;
                // A change that leads straight to the next one is told apart by the resolution.
                from = theta + resolution;
            }
        }
    }

    /// The first instant in `from ..= to` at which a switch must leave, given that one must at `to`, by the margins there; those at this
    /// instant.
    fn locate<P: Problem>(
        &mut self,
        problem: &mut P,
        dense: &Dense<'_>,
        from: f64,
        to: f64,
        resolution: f64,
    ) -> f64 {
        self.search.clear();
        self.search.next().copy_from_slice(&self.margins);
        self.search.put_high(to);
        if !self.start_known {
            self.evaluate(problem, dense, from);
            self.at_start.copy_from_slice(&self.margins);
        }
        if leaving(&self.at_start, &self.muted) {
            self.margins.copy_from_slice(&self.at_start);
            return from;
        }
        self.search.next().copy_from_slice(&self.at_start);
        self.search.put_low(from);
        loop {
            let (low, high) = self.search.ends();
            if high - low <= resolution {
                break;
            }
            let theta = self.search.place(self.first_zero(), resolution);
            self.evaluate(problem, dense, theta);
            self.search.next().copy_from_slice(&self.margins);
            if leaving(&self.margins, &self.muted) {
                self.search.put_high(theta);
            } else {
                self.search.put_low(theta);
            }
        }
        self.margins.copy_from_slice(self.search.high());
        self.search.ends().1
    }

    /// Where the first switch is expected to have to leave.
    fn first_zero(&self) -> f64 {
        let mut first = f64::INFINITY;
        for (index, (margin, muted)) in self.search.high().iter().zip(&self.muted).enumerate() {
            if *margin <= 0.0 && !muted {
                first = first.min(self.search.zero(index));
            }
        }
        first
    }

    /// Changes the modes of all switches that must leave at an instant, each once, by the margins there.
    fn change<P: Problem>(
        &mut self,
        problem: &mut P,
        dense: &Dense<'_>,
        theta: f64,
        maximum: usize,
        statistics: &mut Statistics,
    ) {
        self.changed.fill(false);
        self.place(dense, theta);
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

/// Whether a switch must leave its mode by these margins.
#[inline]
fn leaving(margins: &[f64], muted: &[bool]) -> bool {
    margins
        .iter()
        .zip(muted)
        .any(|(margin, muted)| *margin <= 0.0 && !muted)
}
