//! Recording and timing the changes of discrete switches.

use std::ops::Range;

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

/// Switches whose margins are found together, apart from all others.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct SwitchGroup {
    /// Their numbers.
    pub switches: Range<usize>,
    /// The leading states that their margins and modes depend on.
    pub states: Vec<Range<usize>>,
}

/// The switches of a problem.
#[derive(Clone, Debug)]
pub(crate) struct Switches {
    pub modes: Vec<u8>,
    pub before: Vec<u8>,
    pub events: Vec<Event>,
    groups: Vec<Group>,
    /// Margins with the present modes: at the place that was evaluated last, at the beginning of what is searched, at the end of the step.
    margins: Vec<f64>,
    at_start: Vec<f64>,
    at_end: Vec<f64>,
    search: Search,
    /// Switches that are not looked at any more in this step: `next_mode` declined.
    muted: Vec<bool>,
    /// Switches that have changed at the present instant.
    changed: Vec<bool>,
    /// States at a fraction of the step; only those that were asked for are brought up to date.
    x: Vec<f64>,
    dimension: usize,
    leading: usize,
}

/// A group of switches.
#[derive(Clone, Debug)]
struct Group {
    switches: Range<usize>,
    /// The states that they depend on, in ranges that begin and end at multiples of [`LANES`].
    states: Vec<Range<usize>>,
    /// From which fraction of the step on changes are searched.
    from: f64,
    /// Whether `at_start` holds the margins there, and `at_end` those at the end of the step.
    start_known: bool,
    end_known: bool,
}

/// More changes in a step than there may be.
struct TooMany;

impl Switches {
    pub fn new<P: Problem>(problem: &P, modes: Vec<u8>, capacity: usize) -> Self {
        let (dimension, leading) = (problem.dimension(), leading_states(problem));
        let count = modes.len();
        let capacity = if count == 0 { 0 } else { capacity };
        let groups: Vec<Group> = match count {
            0 => Vec::new(),
            _ => problem.switch_groups().into_iter().map(Group::new).collect(),
        };
        let largest = groups.iter().map(|group| group.switches.len()).max();
        Self {
            before: modes.clone(),
            modes,
            events: Vec::with_capacity(capacity),
            groups,
            margins: vec![0.0; count],
            at_start: vec![0.0; count],
            at_end: vec![0.0; count],
            search: Search::new(largest.unwrap_or(0)),
            muted: vec![false; count],
            changed: vec![false; count],
            x: vec![0.0; dimension.next_multiple_of(LANES)],
            dimension,
            leading,
        }
    }

    /// Tells that the margins at the place reached may have changed: those known of it are not used any more.
    pub fn forget(&mut self) {
        for group in &mut self.groups {
            group.start_known = false;
        }
    }

    /// Evaluates the margins at the end of a step. Before [`Switches::detect`], and apart from it: right after other functions were
    /// evaluated there it may cost the problem little.
    pub fn look<P: Problem>(&mut self, problem: &mut P, time: f64, x: &[f64]) {
        problem.margins(time, x, &self.modes, &mut self.at_end);
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
        for group in &mut self.groups {
            (group.from, group.end_known) = (0.0, true);
        }
        if self.follow(problem, dense, maximum).is_err() {
            statistics.events_unresolved += 1;
            self.forget();
        }
        statistics.events += self.events.len() as u64;
        if self.groups.len() > 1 {
            in_order(&mut self.events);
        }
    }

    /// Finds the changes of all groups.
    fn follow<P: Problem>(
        &mut self,
        problem: &mut P,
        dense: &Dense<'_>,
        maximum: usize,
    ) -> Result<(), TooMany> {
        // A step by collocation is two to four times as long as others; an explicit one spans a radian or so of the fastest answer at most.
        let looks: &[f64] = match dense.tableau.family {
            Family::Collocation => &[0.25, 0.5, 0.75],
            Family::Explicit => &[],
            Family::LinearlyImplicit | Family::DiagonallyImplicit => &[0.5],
        };
        for &to in looks {
            dense.evaluate(to, &mut self.x[..self.leading]);
            let x = &self.x[..self.dimension];
            problem.margins(dense.time(to), x, &self.modes, &mut self.margins);
            for number in 0..self.groups.len() {
                self.resolve(problem, dense, number, to, maximum)?;
            }
        }
        // As in most steps: nothing changes, in no group.
        if self.groups.iter().all(|group| group.end_known) && !leaving(&self.at_end, &self.muted) {
            std::mem::swap(&mut self.at_start, &mut self.at_end);
            for group in &mut self.groups {
                group.start_known = true;
            }
            return Ok(());
        }
        for number in 0..self.groups.len() {
            let switches = self.groups[number].switches.clone();
            if self.groups[number].end_known {
                self.margins[switches.clone()].copy_from_slice(&self.at_end[switches.clone()]);
            } else {
                self.evaluate(problem, dense, number, 1.0);
            }
            let known = self.resolve(problem, dense, number, 1.0, maximum)?;
            if known {
                self.at_start[switches.clone()].copy_from_slice(&self.margins[switches]);
            }
            self.groups[number].start_known = known;
        }
        Ok(())
    }

    /// Brings the states that a group depends on to a fraction of the step.
    #[inline]
    fn place(&mut self, dense: &Dense<'_>, number: usize, theta: f64) {
        dense.evaluate_parts(theta, &self.groups[number].states, &mut self.x);
    }

    /// Evaluates the margins of a group at a fraction of the step.
    #[inline]
    fn evaluate<P: Problem>(&mut self, problem: &mut P, dense: &Dense<'_>, number: usize, theta: f64) {
        self.place(dense, number, theta);
        let x = &self.x[..self.dimension];
        problem.group_margins(number, dense.time(theta), x, &self.modes, &mut self.margins);
    }

    /// Whether a switch of a group must leave its mode by the margins evaluated last.
    #[inline]
    fn leaving(&self, number: usize) -> bool {
        let switches = self.groups[number].switches.clone();
        leaving(&self.margins[switches.clone()], &self.muted[switches])
    }

    /// Finds the changes of a group up to a fraction of the step, where `margins` hold its margins; whether they do so still.
    fn resolve<P: Problem>(
        &mut self,
        problem: &mut P,
        dense: &Dense<'_>,
        number: usize,
        to: f64,
        maximum: usize,
    ) -> Result<bool, TooMany> {
        let resolution = (4.0 * f64::EPSILON * dense.end.abs() / dense.step).max(1e-12);
        while self.groups[number].from <= to {
            if !self.leaving(number) {
                // The search for a change behind this place begins where this one began all the same: there may be several.
                return Ok(true);
            }
            let theta = self.locate(problem, dense, number, to, resolution);
            self.groups[number].start_known = false;
            let known = self.events.len();
            self.change(problem, dense, number, theta, maximum)?;
            let group = &mut self.groups[number];
            group.end_known &= self.events.len() == known;
            // A change that leads straight to the next one is told apart by the resolution.
            group.from = theta + resolution;
            if group.from <= to {
                self.evaluate(problem, dense, number, to);
            }
        }
        Ok(false)
    }

    /// The first instant up to `to` at which a switch of a group must leave, given that one must at `to`, by the margins there; those at
    /// this instant.
    fn locate<P: Problem>(
        &mut self,
        problem: &mut P,
        dense: &Dense<'_>,
        number: usize,
        to: f64,
        resolution: f64,
    ) -> f64 {
        let group = &self.groups[number];
        let (switches, from) = (group.switches.clone(), group.from);
        let count = switches.len();
        self.search.clear();
        self.search.next()[..count].copy_from_slice(&self.margins[switches.clone()]);
        self.search.put_high(to);
        if !group.start_known {
            self.evaluate(problem, dense, number, from);
            self.at_start[switches.clone()].copy_from_slice(&self.margins[switches.clone()]);
        }
        let at_start = &self.at_start[switches.clone()];
        if leaving(at_start, &self.muted[switches.clone()]) {
            self.margins[switches].copy_from_slice(at_start);
            return from;
        }
        self.search.next()[..count].copy_from_slice(at_start);
        self.search.put_low(from);
        loop {
            let (low, high) = self.search.ends();
            if high - low <= resolution {
                break;
            }
            let theta = self.search.place(self.first_zero(number), resolution);
            self.evaluate(problem, dense, number, theta);
            self.search.next()[..count].copy_from_slice(&self.margins[switches.clone()]);
            if self.leaving(number) {
                self.search.put_high(theta);
            } else {
                self.search.put_low(theta);
            }
        }
        self.margins[switches].copy_from_slice(&self.search.high()[..count]);
        self.search.ends().1
    }

    /// Where the first switch of a group is expected to have to leave.
    fn first_zero(&self, number: usize) -> f64 {
        let muted = &self.muted[self.groups[number].switches.clone()];
        let mut first = f64::INFINITY;
        for (index, (margin, muted)) in self.search.high().iter().zip(muted).enumerate() {
            if *margin <= 0.0 && !muted {
                first = first.min(self.search.zero(index));
            }
        }
        first
    }

    /// Changes the modes of all switches of a group that must leave at an instant, each once, by the margins there.
    fn change<P: Problem>(
        &mut self,
        problem: &mut P,
        dense: &Dense<'_>,
        number: usize,
        theta: f64,
        maximum: usize,
    ) -> Result<(), TooMany> {
        let switches = self.groups[number].switches.clone();
        self.changed[switches.clone()].fill(false);
        self.place(dense, number, theta);
        let time = dense.time(theta);
        while let Some(index) = switches
            .clone()
            .find(|&i| self.margins[i] <= 0.0 && !self.muted[i] && !self.changed[i])
        {
            if self.events.len() >= maximum {
                return Err(TooMany);
            }
            let x = &self.x[..self.dimension];
            let from = self.modes[index];
            let to = problem.next_mode(time, x, index, from);
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
            // the margins of other switches may depend on this mode
            problem.group_margins(number, time, x, &self.modes, &mut self.margins);
        }
        Ok(())
    }
}

impl Group {
    fn new(group: SwitchGroup) -> Self {
        let mut states: Vec<Range<usize>> = Vec::with_capacity(group.states.len());
        for range in group.states {
            let start = range.start / LANES * LANES;
            let end = range.end.next_multiple_of(LANES);
            match states.last_mut() {
                Some(last) if last.start <= start && start <= last.end => last.end = last.end.max(end),
                _ => states.push(start..end),
            }
        }
        Self {
            switches: group.switches,
            states,
            from: 0.0,
            start_known: false,
            end_known: false,
        }
    }
}

/// Brings the changes of all groups into the order of time; those of the same instant stay as they are. (Few are out of order.)
fn in_order(events: &mut [Event]) {
    for end in 1..events.len() {
        let mut at = end;
        while at > 0 && events[at - 1].time > events[at].time {
            events.swap(at - 1, at);
            at -= 1;
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
