//! Recording and timing the changes of discrete switches.

use std::ops::Range;

use serde::{Deserialize, Serialize};

use crate::lanes::LANES;
use crate::methods::tableau::Family;
use crate::problem::Problem;
use crate::search::Search;
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

/// Switches whose margins are found together, apart from all others.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct SwitchGroup {
    /// Their numbers.
    pub switches: Range<usize>,
    /// Their signs among those of all groups: what tells margins and following modes, see [`Problem::signs`].
    pub signs: Range<usize>,
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
    /// Signs: at the place that was evaluated last, at the beginning of the step, at the place up to which changes are searched, at the end
    /// of the step, at the upper end of what is searched.
    signs: Vec<f64>,
    at_start: Vec<f64>,
    looked: Vec<f64>,
    at_end: Vec<f64>,
    at_high: Vec<f64>,
    /// Whether `at_start` holds the signs there.
    start_known: bool,
    /// Margins by signs evaluated last, with the present modes.
    margins: Vec<f64>,
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
    signs: Range<usize>,
    /// The states that they depend on, in ranges that begin and end at multiples of [`LANES`].
    states: Vec<Range<usize>>,
    /// From which fraction of the step on changes are searched.
    from: f64,
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
        let signs = vec![0.0; groups.last().map_or(0, |group| group.signs.end)];
        Self {
            before: modes.clone(),
            modes,
            events: Vec::with_capacity(capacity),
            groups,
            at_start: signs.clone(),
            looked: signs.clone(),
            at_end: signs.clone(),
            at_high: signs.clone(),
            signs,
            start_known: false,
            margins: vec![0.0; count],
            search: Search::new(largest.unwrap_or(0)),
            muted: vec![false; count],
            changed: vec![false; count],
            x: vec![0.0; dimension.next_multiple_of(LANES)],
            dimension,
            leading,
        }
    }

    /// Tells that the signs at the place reached may have changed: those known of it are not used any more.
    pub fn forget(&mut self) {
        self.start_known = false;
    }

    /// Evaluates the signs at the end of a step. Before [`Switches::detect`], and apart from it: right after other functions were
    /// evaluated there it may cost the problem little.
    pub fn look<P: Problem>(&mut self, problem: &mut P, time: f64, x: &[f64]) {
        problem.signs(time, x, &mut self.at_end);
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
            group.from = 0.0;
        }
        if self.follow(problem, dense, maximum).is_err() {
            statistics.events_unresolved += 1;
        }
        std::mem::swap(&mut self.at_start, &mut self.at_end);
        self.start_known = true;
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
        // An explicit step spans a radian or so of the fastest answer at most.
        let looks: &[f64] = match dense.tableau.family {
            Family::Explicit => &[],
            Family::LinearlyImplicit | Family::DiagonallyImplicit => &[0.5],
        };
        for &to in looks {
            dense.evaluate(to, &mut self.x[..self.leading]);
            let x = &self.x[..self.dimension];
            problem.signs(dense.time(to), x, &mut self.looked);
            self.resolve_all(problem, dense, to, maximum)?;
        }
        self.looked.copy_from_slice(&self.at_end);
        self.resolve_all(problem, dense, 1.0, maximum)
    }

    /// Finds the changes of all groups up to a fraction of the step, where `looked` holds the signs.
    fn resolve_all<P: Problem>(
        &mut self,
        problem: &mut P,
        dense: &Dense<'_>,
        to: f64,
        maximum: usize,
    ) -> Result<(), TooMany> {
        for number in 0..self.groups.len() {
            // The search for a change behind this place begins where this one began all the same: there may be several.
            while self.groups[number].from <= to && self.ends(problem, number) {
                self.resolve(problem, dense, number, to, maximum)?;
            }
        }
        Ok(())
    }

    /// Whether a switch of a group must leave its mode where `looked` holds the signs; the margins there.
    #[inline(always)]
    fn ends<P: Problem>(&mut self, problem: &mut P, number: usize) -> bool {
        let group = &self.groups[number];
        let looked = &self.looked[group.signs.clone()];
        group.weigh(problem, number, looked, &self.modes, &mut self.margins);
        self.leaving(number)
    }

    /// Evaluates the signs of a group at a fraction of the step, and the margins by them.
    #[inline]
    fn evaluate<P: Problem>(&mut self, problem: &mut P, dense: &Dense<'_>, number: usize, theta: f64) {
        let group = &self.groups[number];
        dense.evaluate_parts(theta, &group.states, &mut self.x);
        let x = &self.x[..self.dimension];
        let own = &mut self.signs[group.signs.clone()];
        problem.group_signs(number, dense.time(theta), x, own);
        group.weigh(problem, number, own, &self.modes, &mut self.margins);
    }

    /// Whether a switch of a group must leave its mode by the margins found last.
    #[inline]
    fn leaving(&self, number: usize) -> bool {
        let switches = self.groups[number].switches.clone();
        leaving(&self.margins[switches.clone()], &self.muted[switches])
    }

    /// Finds the next change of a group up to a fraction of the step, where `looked` holds the signs and [`Switches::ends`] has found one.
    #[inline(never)]
    fn resolve<P: Problem>(
        &mut self,
        problem: &mut P,
        dense: &Dense<'_>,
        number: usize,
        to: f64,
        maximum: usize,
    ) -> Result<(), TooMany> {
        let resolution = (4.0 * f64::EPSILON * dense.end.abs() / dense.step).max(1e-12);
        let theta = self.locate(problem, dense, number, to, resolution);
        self.change(problem, dense.time(theta), number, maximum)?;
        // A change that leads straight to the next one is told apart by the resolution.
        self.groups[number].from = theta + resolution;
        Ok(())
    }

    /// The first instant up to `to` at which a switch of a group must leave, given that one must at `to`, by the margins there; the signs at
    /// this instant, in `at_high`, and the margins.
    fn locate<P: Problem>(
        &mut self,
        problem: &mut P,
        dense: &Dense<'_>,
        number: usize,
        to: f64,
        resolution: f64,
    ) -> f64 {
        let group = &self.groups[number];
        let (switches, own, from) = (group.switches.clone(), group.signs.clone(), group.from);
        let count = switches.len();
        self.search.clear();
        self.search.next()[..count].copy_from_slice(&self.margins[switches.clone()]);
        self.search.put_high(to);
        if from == 0.0 && self.start_known {
            let start = &self.at_start[own.clone()];
            self.signs[own.clone()].copy_from_slice(start);
            group.weigh(problem, number, start, &self.modes, &mut self.margins);
        } else {
            self.evaluate(problem, dense, number, from);
        }
        if self.leaving(number) {
            self.at_high[own.clone()].copy_from_slice(&self.signs[own]);
            return from;
        }
        self.at_high[own.clone()].copy_from_slice(&self.looked[own.clone()]);
        self.search.next()[..count].copy_from_slice(&self.margins[switches.clone()]);
        self.search.put_low(from);
        loop {
            let (low, high) = self.search.ends();
            if high - low <= resolution {
                break;
            }
            let (expected, doubt) = self.first_zero(number);
            let settled = self.search.settle(expected, doubt, resolution);
            let theta = settled.unwrap_or_else(|| self.search.place(expected, resolution));
            self.evaluate(problem, dense, number, theta);
            self.search.next()[..count].copy_from_slice(&self.margins[switches.clone()]);
            if self.leaving(number) {
                self.search.put_high(theta);
                self.at_high[own.clone()].copy_from_slice(&self.signs[own.clone()]);
                if settled.is_some() && self.confirmed(number, resolution) {
                    break;
                }
            } else {
                self.search.put_low(theta);
            }
        }
        self.margins[switches].copy_from_slice(&self.search.high()[..count]);
        self.search.ends().1
    }

    /// The switches that must leave at the upper end of what is searched, by their numbers in a group.
    #[inline]
    fn crossing(&self, number: usize) -> impl Iterator<Item = usize> {
        let muted = &self.muted[self.groups[number].switches.clone()];
        let all = self.search.high().iter().zip(muted).enumerate();
        all.filter(|(_, (margin, muted))| **margin <= 0.0 && !**muted)
            .map(|(index, _)| index)
    }

    /// Where the first switch of a group is expected to have to leave, and how much this is in doubt.
    fn first_zero(&self, number: usize) -> (f64, f64) {
        self.crossing(number)
            .map(|index| self.search.zero_and_doubt(index))
            .fold((f64::INFINITY, f64::INFINITY), |first, next| {
                if next.0 < first.0 { next } else { first }
            })
    }

    /// Whether a switch has come to leave at the place where the search has settled.
    fn confirmed(&self, number: usize, resolution: f64) -> bool {
        self.crossing(number)
            .any(|index| self.search.confirms(index, resolution))
    }

    /// Changes the modes of all switches of a group that must leave at an instant, each once, by the signs `at_high` and the margins there.
    fn change<P: Problem>(
        &mut self,
        problem: &mut P,
        time: f64,
        number: usize,
        maximum: usize,
    ) -> Result<(), TooMany> {
        let group = &self.groups[number];
        let switches = group.switches.clone();
        let signs = &self.at_high[group.signs.clone()];
        self.changed[switches.clone()].fill(false);
        while let Some(index) = switches
            .clone()
            .find(|&i| self.margins[i] <= 0.0 && !self.muted[i] && !self.changed[i])
        {
            if self.events.len() >= maximum {
                return Err(TooMany);
            }
            let from = self.modes[index];
            let to = problem.next_mode(number, signs, index - switches.start, from);
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
            group.weigh(problem, number, signs, &self.modes, &mut self.margins);
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
            signs: group.signs,
            states,
            from: 0.0,
        }
    }

    /// Writes the margins by signs of this group.
    #[inline]
    fn weigh<P: Problem>(
        &self,
        problem: &mut P,
        number: usize,
        signs: &[f64],
        modes: &[u8],
        margins: &mut [f64],
    ) {
        let own = self.switches.clone();
        problem.group_margins(number, signs, &modes[own.clone()], &mut margins[own]);
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
